# How fast Newton's residuals fall: the contractivity of each iteration, its median and quartiles over all solves of at
# least four iterations, one panel per scene.
#   gnuplot -e "data='results/contraction'; out='contraction'" contraction.gp
# Reads contractions.csv. Options: limit (a line).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("limit")) limit = 0.7
file = data.'/contractions.csv'
iterations = 6
least_iterations = 4

caseOfRow(d) = strcol("scene").(strcol("settings") eq "" ? "" : ':'.oneWord(strcol("settings")))
collected = ""
undefine N_*
stats file using (column("iterations") >= least_iterations ? (collect(caseOfRow(0)), 1) : 0) name "N" nooutput
if (!exists("N_sum") || N_sum == 0) { eval absence(file) }
cases = collected
n = words(cases)
of(i, k) = column("iterations") >= least_iterations && caseOfRow(0) eq word(cases, i) && !absent(sprintf("c%d", k))

# Values below the panel are drawn at its lower edge.
least = 1e-4
array Count[n * iterations]; array Median[n * iterations]; array Low[n * iterations]; array High[n * iterations]
slot(i, k) = (i - 1) * iterations + k
do for [i = 1 : n] { do for [k = 1 : iterations] {
  undefine N_*
  stats file using (of(i, k) ? 1 : 0) name "N" nooutput
  Count[slot(i, k)] = N_sum
  Median[slot(i, k)] = NaN; Low[slot(i, k)] = NaN; High[slot(i, k)] = NaN
  if (Count[slot(i, k)] > 0) {
    stats file using (of(i, k) ? (column(sprintf("c%d", k)) > least ? column(sprintf("c%d", k)) : least) : NaN) name "C" nooutput
    Median[slot(i, k)] = C_median; Low[slot(i, k)] = C_lo_quartile; High[slot(i, k)] = C_up_quartile
  }
} }

columns = n < 4 ? n : 4
lines = (n + columns - 1) / columns
width = columns == 1 ? 560.0 : columns == 2 ? 820.0 : 1080.0
height = (exists("quick") ? 128.0 : 110.0) + 220 * lines
legend_height = 40.0 / height
margin_left = 66 / width; margin_right = 0.02; margin_top = (exists("quick") ? 54 : 36) / height
margin_bottom = legend_height + 56 / height; gap_x = 0.02; gap_y = 68 / height
do for [format in formats] {
  eval open(format, width, height)
  set multiplot
  unset key
  set xrange [0.5 : iterations + 0.5]; set xtics 1 nomirror; set yrange [least : 10]
  do for [i = 1 : n] {
    eval panel(i, columns, lines)
    eval decades("y")
    if (i % columns != 1 && columns > 1) { set format y '' }
    set title nameOf(word(cases, i)) offset 0,-0.5 noenhanced
    set xlabel when(i > n - columns, 'iteration')
    set ylabel when(i % columns == 1 || columns == 1, 'contractivity') offset 1,0
    plot limit with lines lw 1.6 lc rgb 0x888888 notitle, \
      '+' using (int($0) + 1):(Median[slot(i, int($0) + 1)]):(Low[slot(i, int($0) + 1)]):(High[slot(i, int($0) + 1)]) \
        every ::0::(iterations - 1) with yerrorbars pt 7 ps 0.7 lw 1.2 lc rgb 0xD55E00 notitle, \
      '+' using (int($0) + 1):(Median[slot(i, int($0) + 1)]) every ::0::(iterations - 1) with lines lw 1.4 lc rgb 0xD55E00 notitle
  }
  eval legend(legend_height)
  plot 2 notitle, keyentry with yerrorbars pt 7 ps 0.7 lw 1.2 lc rgb 0xD55E00 title 'median and quartiles', \
    keyentry with lines lw 1.6 lc rgb 0x888888 title sprintf('limit of the paper, %g', limit)
  eval framed
  set title; unset multiplot
  unset output
  unset logscale; set xrange [*:*]; set yrange [*:*]
}
