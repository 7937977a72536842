# Ratio of the true error of a step to its estimate: the fraction of all steps above a ratio, one curve per group of
# components, one panel per kind of estimate.
#   gnuplot -e "data='results/estimate'; out='ratio'" estimate_ratio.gp
# Reads estimates.csv. Options: estimates (columns; one panel each), titles (quoted words), safety (a line).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("estimates")) estimates = 'doubling richardson'
if (!exists("titles")) titles = "'divided by 2^p − 1 for every component (paper)' 'divided by 2^q − 1, q of the component'"
if (!exists("safety")) safety = 4
file = data.'/estimates.csv'
n = words(estimates)
groups = "u v x z"
group_titles = "positions velocities 'first-order states' multipliers"
group_colours = "0x0072B2 0x009E73 0xE69F00 0xD55E00"
colour(g) = int(word(group_colours, g))
undefine N_*
stats file using 0 name "N" nooutput
if (!exists("N_records") || N_records == 0) { eval absence(file) }
usable(e, g) = is("group", word(groups, g)) && !absent(e) && column(e) > 0
array Count[n * 4]
do for [i = 1 : n] { do for [g = 1 : 4] {
  stats file using (usable(word(estimates, i), g) ? 1 : 0) name "N" nooutput
  Count[(i - 1) * 4 + g] = N_sum
} }

# Sums from the largest ratio downwards. gnuplot sums from left to right, so the axis is minus the logarithm.
tic_list = ''
do for [x = -2 : 4] { tic_list = tic_list.sprintf("%s'10^{%d}' %d", x == -2 ? '' : ', ', x, -x) }
margin_left = 0.085; margin_right = 0.02; margin_bottom = 0.27; gap_x = 0.03
do for [format in formats] {
  eval open(format, n == 1 ? 640 : 1080, 420)
  set multiplot
  unset key
  set xrange [2 : -4]; set yrange [1e-3 : 1.3]
  do for [i = 1 : n] {
    e = word(estimates, i)
    eval panel(i, n, 1)
    set logscale y; unset mytics
    eval 'set xtics ('.tic_list.')'
    set ytics (when(i == 1, '100 %%') 1, when(i == 1, '10 %%') 0.1, when(i == 1, '1 %%') 0.01, when(i == 1, '0.1 %%') 0.001)
    set title word(titles, i) offset 0,-0.5
    set xlabel 'true error / estimate'
    set ylabel when(i == 1, 'steps with a larger ratio') offset 1,0
    set arrow 1 from -log10(safety), graph 0 to -log10(safety), graph 1 nohead back lw 5 lc rgb 0xE4E4E4
    set label 1 sprintf('s_{min} = %g', safety) at -log10(safety) - 0.15, graph 0.95 textcolor rgb ink font ',10'
    plot for [g = 1 : 4] file using (usable(e, g) ? -log10(column(e)) : NaN):(1.0 / Count[(i - 1) * 4 + g]) \
      smooth cumulative with lines lw 1.8 dt g lc rgb colour(g) notitle
    unset arrow 1; unset label 1
  }
  eval legend(0.1)
  plot 2 notitle, for [g = 1 : 4] keyentry with lines lw 1.8 dt g lc rgb colour(g) title word(group_titles, g)
  unset multiplot
  unset output
  eval framed
  unset logscale; set xrange [*:*]; set yrange [*:*]
}
