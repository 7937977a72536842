# The time of a step over the number of unknowns: one panel per method, one curve per way of solving. With one thread it is
# the CPU time, which other programs of the machine do not disturb; with several the time that passes.
#   gnuplot -e "data='results/scaling'; out='scaling'; scene='SCENE'" scaling.gp
# Reads scaling.csv. Options: block or scene, methods (one panel each), ways (solver:storage:threads, quoted words).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("methods")) methods = 'radau_iia_3 radau_iia_5 radau_iia_10'
if (!exists("ways")) ways = 'schur:sparse:1 schur:automatic:2 schur:dense:1 coupled_sparse:automatic:1'
if (!exists("titles")) titles = "'decoupled, sparse' 'decoupled, sparse, 2 threads' 'decoupled, dense' 'coupled, sparse'"
file = data.'/scaling.csv'
way_colours = "0x0072B2 0x56B4E9 0xE69F00 0xD55E00"
way_points = "7 6 5 9"
at(i, k) = ofScene(0) && is("method", word(methods, i)) \
  && strcol("solver").':'.strcol("storage").':'.strcol("threads") eq word(ways, k)
has_cpu = hasColumn(file, 'step_cpu_s')
stepTime(d) = has_cpu && is("threads", '1') ? column("step_cpu_s") : column("step_s")
isDrawn(d) = ofScene(0) && position(methods, strcol("method")) \
  && position(ways, strcol("solver").':'.strcol("storage").':'.strcol("threads")) && stepTime(0) > 0
undefine N_*; undefine T_*
stats file using (isDrawn(0) ? stepTime(0) : NaN) name "T" nooutput
if (!exists("T_records") || T_records == 0) { eval absence(caseName." in ".file) }
stats file using (isDrawn(0) ? column("n") : NaN) name "N" nooutput
kept = ""
do for [m in methods] { undefine C_*
  stats file using (ofScene(0) && is("method", m) ? 1 : 0) name "C" nooutput
  if (exists("C_sum") && C_sum > 0) { kept = kept.' '.m } }
methods = kept
columns = words(methods)
# A way with a single point is no curve; the legend lists only ways that are drawn.
curves = ""
do for [k = 1 : words(ways)] {
  most = 0
  do for [i = 1 : columns] { undefine C_*
    stats file using (at(i, k) ? 1 : 0) name "C" nooutput
    if (exists("C_sum") && C_sum > most) { most = C_sum } }
  if (most > 1) { curves = curves.sprintf(" %d", k) }
}
stagesIn(method) = system("echo '".method."' | sed 's/.*_//'")
margin_left = columns == 1 ? 0.14 : 0.08; margin_top = 0.09; margin_bottom = columns == 1 ? 0.31 : 0.27; gap_x = 0.03
do for [format in formats] {
  eval open(format, columns == 1 ? 560 : 1080, 420)
  set multiplot
  eval decades("x"); eval decades("y")
  unset key
  set xrange [N_min / 1.3 : N_max * 1.3]; set yrange [T_min / 2 : T_max * 2]
  do for [i = 1 : columns] {
    eval panel(i, columns, 1)
    set title 's = '.stagesIn(word(methods, i)) offset 0,-0.5
    set xlabel 'unknowns n of one stage' offset 0,0.3
    set ylabel when(i == 1, 'time of a step in s') offset 1,0
    eval logTics('x', N_min, N_max); eval logTics('y', T_min, T_max)
    if (i > 1) { set format y '' }
    plot T_min * x / N_min with lines lw 1 dt 3 lc rgb 0x888888 notitle, \
      for [k in curves] file using (at(i, number(k)) ? column("n") : NaN):(stepTime(0)) \
      with linespoints lw 1.4 pt int(word(way_points, number(k))) ps 0.7 lc rgb int(word(way_colours, number(k))) notitle
  }
  eval legend(columns == 1 ? 0.17 : 0.12)
  plot 2 notitle, for [k in curves] keyentry with linespoints lw 1.4 pt int(word(way_points, number(k))) ps 0.7 \
      lc rgb int(word(way_colours, number(k))) title word(titles, number(k)), keyentry with lines lw 1 dt 3 lc rgb 0x888888 title 'slope 1'
  unset multiplot
  unset output
  eval framed
  unset logscale; set xrange [*:*]; set yrange [*:*]
}
