# What more processors gain: the speed-up over the number of processors, one run on several threads beside several runs at
# a time; one curve per scene, settings and storage.
#   gnuplot -e "data='results/parallel'; out='parallel'" times/parallel.gp
# Reads parallel.csv. Options: titles (quoted words, one per curve in the order of the table).
load system('dirname "'.ARG0.'"')."/../style.gp"
file = data.'/parallel.csv'
ways = 'threads runs'
way_titles = "'one run on several threads' 'several runs at a time'"
curve(d) = oneWord(strcol("scene").' '.strcol("settings").' '.strcol("storage"))
stats file using (collect(curve(0)), column("processors")) name "P" nooutput
if (!exists("P_records") || P_records == 0) { eval absence(file) }
curves = collected
if (!exists("titles")) titles = curves
stats file using (column("speedup")) name "S" nooutput
most = S_max > P_max ? S_max : P_max
at(way, c) = is("way", way) && curve(0) eq c
margin_left = 0.09; margin_top = 0.09; margin_bottom = 0.27; gap_x = 0.05
do for [format in formats] {
  eval open(format, 760, 420)
  set multiplot
  unset key
  set logscale x 2; set logscale y 2; set format '%g'
  set xrange [0.9 : P_max * 1.1]; set yrange [(S_min < 1 ? 0.9 * S_min : 0.9) : most * 1.1]
  do for [i = 1 : words(ways)] {
    eval panel(i, words(ways), 1)
    set title word(way_titles, i) offset 0,-0.5
    set xlabel 'processors' offset 0,0.3
    set ylabel when(i == 1, 'speed-up') offset 1,0
    if (i > 1) { set format y '' }
    plot x with lines lw 1 dt 3 lc rgb 0x888888 notitle, \
      for [k = 1 : words(curves)] file using (at(word(ways, i), word(curves, k)) ? column("processors") : NaN):(column("speedup")) \
      with linespoints lw 1.4 pt curvePoint(k) ps 0.7 lc rgb curveColour(k) notitle
  }
  eval legend(0.12)
  plot 2 notitle, for [k = 1 : words(curves)] keyentry with linespoints lw 1.4 pt curvePoint(k) ps 0.7 lc rgb curveColour(k) \
    title word(titles, k), keyentry with lines lw 1 dt 3 lc rgb 0x888888 title 'ideal'
  unset multiplot
  unset output
  eval framed
  unset logscale; set xrange [*:*]; set yrange [*:*]; set format
}
