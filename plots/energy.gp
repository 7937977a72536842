# The error of a conserved energy over time: one panel per scene and method, one line per summation.
#   gnuplot -e "data='results/round_off'; out='energy'; cases='SCENE:METHOD SCENE:METHOD'" energy.gp
# Reads energy.csv. Options: cases (scene:method), titles, unit (the axes show multiples of it, e.g. 1e-16).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("cases")) cases = ''
if (!exists("titles")) titles = ""
if (!exists("unit")) unit = 1e-16
file = data.'/energy.csv'
summations = "plain compensated"
summation_titles = "'plain summation' 'compensated summation'"
summation_colours = "0xE69F00 0x0072B2"
panelScene(i) = before(word(cases, i))
methodOf(i) = behindColon(word(cases, i))
at(i, k) = is("scene", panelScene(i)) && is("method", methodOf(i)) && is("summation", word(summations, k))
undefine N_*
stats file using (is("scene", panelScene(1)) ? 1 : 0) name "N" nooutput
if (!exists("N_sum") || N_sum == 0) { eval absence(panelScene(1)." in ".file) }
columns = words(cases)
caseTitle(i) = words(titles) >= i ? word(titles, i) : panelScene(i).', '.methodOf(i)
scatter = ""
do for [i = 1 : columns] { do for [k = 1 : 2] {
  found = 0
  stats file using (at(i, k) ? (found = column("scatter")) : 0) name "S" nooutput
  scatter = scatter.sprintf(found / unit < 10 ? " %.1f" : " %.0f", found / unit)
} }
margin_left = columns == 1 ? 0.13 : 0.075; margin_top = 0.1; margin_bottom = 0.27; gap_x = 0.08
do for [format in formats] {
  eval open(format, columns == 1 ? 560 : 1080, 400)
  set multiplot
  unset key
  do for [i = 1 : columns] {
    eval panel(i, columns, 1)
    set title caseTitle(i) noenhanced offset 0,-0.5
    set xlabel 't in s' offset 0,0.3
    set ylabel when(i == 1, 'error of the energy / 10^{-16}') offset 0.5,0
    set label 1 sprintf('RMS about the trend: %s plain, %s compensated', word(scatter, 2 * i - 1), word(scatter, 2 * i)) \
      at graph 0.03, graph 0.95 left textcolor rgb ink font ',10' noenhanced
    set xrange [*:*] noextend; set yrange [*:*]; set offsets 0, 0, graph 0.12, 0
    plot for [k = 1 : 2] file using (at(i, k) ? column("t") : NaN):(column("energy_error") / unit) \
      with lines lw 1 lc rgb int(word(summation_colours, k)) notitle
    unset label 1; set offsets 0, 0, 0, 0
  }
  eval legend(0.12)
  plot 2 notitle, for [k = 1 : 2] keyentry with lines lw 2 lc rgb int(word(summation_colours, k)) title word(summation_titles, k)
  unset multiplot
  unset output
  eval framed
}
