# Work against accuracy: CPU time or counters over the error reached, one line per number of stages (and method).
# The error, the largest at the runs' reference times, decreases to the right. A failed run is drawn above the lines, at
# the tolerance that was requested; a ring marks a success with an error above 1000 tolerances. An error that is too small
# for its reference stands at ten times the reference's accuracy.
#   gnuplot -e "data='results/cpu_time'; out='work'; block='crank'; family='radau_iia'" work_precision.gp
# Reads runs.csv. Options: block or scene and settings, family, formulation, stages_shown,
# only (quoted words column=value that all rows must have), quantity (error, error_u, error_v, error_x, error_z), at_end
# (1: the error at the end, whatever the reference times), costs ('cpu_s', or several counters: one panel each).
# With variant (a column; its values are the curves) work_by.gp draws the figure, with variants and only.
# Thins by quantity costs rtol atol
load system('dirname "'.ARG0.'"')."/style.gp"
here = system('dirname "'.ARG0.'"')
if (!exists("only")) only = ''
if (!exists("variant")) variant = ''
if (!exists("variants")) variants = ''
if (variant ne '') {
  cases = (block eq '' ? scene.when(settings ne '', ':'.settings) : 'block='.block.when(scene ne '', ':'.scene))
  if (strlen(cases)) { cases = '"'.cases.'"' }
  if (exists("family")) { only = only.' family='.family }
  if (exists("formulation")) { only = only.' formulation='.formulation }
}
if (variant ne '') load here."/work_by.gp"; exit
if (!exists("family")) family = 'radau_iia'
if (!exists("formulation")) formulation = ''
if (!exists("stages_shown")) stages_shown = '1 2 3 5 7 10 15 20'
if (!exists("quantity")) quantity = 'error'
if (!exists("costs")) costs = 'cpu_s'
if (!exists("at_end")) at_end = 0
file = data.'/runs.csv'
eval errors(file, at_end)
n = words(costs)
cost_title(c) = c eq 'cpu_s' ? 'CPU time in s' : c eq 'newton_iterations' ? 'Newton iterations' \
  : c eq 'residuals' ? 'residual evaluations' : c eq 'jacobians' ? 'Jacobians' : c eq 'steps_accepted' ? 'steps' : c

chosen(d) = ofCase(0) && allowed(only) && is("family", family) \
            && has("formulation", formulation) && position(stages_shown, sprintf("%d", column("stages")))
row(k) = chosen(0) && isMethod(word(curves, k))
error(d) = errorOrBound(quantity)
reached(k) = row(k) ? error(0) : NaN
asked(d) = absent("rtol") ? column("atol") : column("rtol") > 0 ? column("rtol") : column("atol")
failed(k) = row(k) && !succeeded(0) ? asked(0) : outside

stats file using (chosen(0) ? 1 : 0) name "N" nooutput
if (!exists("N_sum") || N_sum == 0) { eval absence(caseName." in ".file) }
stats file using (chosen(0) ? (collect(methodWord(0)), asked(0)) : NaN) name "T" nooutput
drawable(d) = error(0) > 0 && !absent(word(costs, 1))
stats file using (chosen(0) && drawable(0) ? 1 : 0) name "N" nooutput
rows = N_sum
if (rows > 0) { stats file using (chosen(0) && drawable(0) ? error(0) : NaN) name "E" nooutput }
stats file using (chosen(0) && !succeeded(0) ? 1 : 0) name "F" nooutput
times = 1
stats file using (chosen(0) && error(0) > 0 && timesOf(0) > times ? (times = timesOf(0)) : 0) nooutput
stats file using (chosen(0) && drawable(0) && isWrong(0) ? 1 : 0) name "W" nooutput
curves = sortedMethods(collected)
count = words(curves)
failures = F_sum
finest = rows > 0 ? E_min : 0
if (failures > 0) {
  stats file using (chosen(0) && !succeeded(0) ? asked(0) : NaN) name "F" nooutput
  finest = F_min < finest ? F_min : finest
}

columns = n == 1 ? 1 : 2
lines = (n + columns - 1) / columns
# The names of twins need room beside the panels.
longest = 0
do for [k = 1 : count] { length = strlen(methodTitle(curves, k)); longest = length > longest ? length : longest }
longest = W_sum > 0 && longest < strlen(wrong_title) + 2 ? strlen(wrong_title) + 2 : longest
room = longest > 6 ? 7.5 * (longest - 6) : 0
usual = n == 1 ? 640.0 : 1080.0
width = usual + room
margin_left = (n == 1 ? 0.12 : 0.075) * usual / width; margin_right = ((n == 1 ? 0.17 : 0.1) * usual + room) / width
margin_bottom = lines == 1 ? 0.14 : 0.09; gap_x = 0.1
do for [format in formats] {
  eval open(format, width, lines == 1 ? 420 : 640)
  if (rows == 0) { eval nothing(caseName) } else {
    set multiplot
    eval decades("x"); eval decades("y")
    do for [i = 1 : n] {
      c = word(costs, i)
      set xrange [*:*]; set yrange [*:*]   # stats uses only values inside the ranges
      stats file using (chosen(0) && error(0) > 0 ? positive(column(c)) : NaN) name "C" nooutput
      eval logTics('y', C_min, C_max)
      # Failures: a strip above all lines, fewer stages lower.
      strip = C_max * (C_max / C_min) ** 0.06
      level(k) = strip * (C_max / C_min) ** (0.02 * k)
      set xrange [2 * (E_max > T_max ? E_max : T_max) : finest / 2]
      set yrange [C_min / 1.5 : failures > 0 ? level(count + 1) : 1.5 * C_max]
      eval panel(i, columns, lines)
      set xlabel when(i > n - columns, errorTitle(quantity, times))
      set ylabel cost_title(c) offset 1,0
      unset key
      if (i == columns || n == 1) { set key at graph 1.03, graph 1 left top Left reverse title 'stages' left }
      plot for [k = 1 : count] file using (reached(k)):(positive(column(c))) \
             with linespoints lw 1.2 dt methodDash(curves, k) pt methodPoint(curves, k) ps 0.7 \
             lc rgb methodColour(curves, k) title methodTitle(curves, k), \
           for [k = 1 : count] file using (failed(k)):(level(k)) \
             with points pt failure_point ps 1 lw 2.8 lc rgb methodColour(curves, k) notitle, \
           for [k = 1 : W_sum > 0] file using (chosen(0) && isWrong(0) ? error(0) : outside):(positive(column(c))) \
             with points pt wrong_point ps ring_size lw ring_width lc rgb failure_colour title wrong_title, \
           for [k = 1 : failures > 0] keyentry with points pt failure_point ps 1 lw 2.8 lc rgb ink title 'failed'
    }
    unset multiplot
  }
  unset output
  unset logscale; set xrange [*:*]; set yrange [*:*]
}
