# Work against accuracy, one curve per value of a column: a term of the Jacobian, a formulation, a method. The error, the
# largest at the runs' reference times, decreases to the right. A failed run is drawn above the lines, at the tolerance
# that was requested; with fixed steps, at the left. A ring marks a success with an error above 1000
# tolerances. An error that is too small for its reference stands at ten times the reference's accuracy.
#   gnuplot -e "data='results/jacobian'; out='jacobian'; variant='jacobian'; cases='block=terms_crank'" work_by.gp
# Reads runs.csv. Options:
#   variant (columns; each combination of their values is a curve), variants (the values to show, in this order),
#   cases (block=NAME, block=NAME:SCENE, SCENE or SCENE:SETTINGS, in quotes if they contain blanks; one panel each),
#   titles (quoted words, one per case),
#   costs (columns; with one case several costs: one panel each), quantity (error, error_u, ...), at_end (1: the error at the end, whatever the reference times),
#   only (quoted words column=value that all rows must have), columns (of panels).
# Thins by quantity costs rtol atol
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("variant")) variant = 'jacobian'
if (!exists("variants")) variants = ''
if (!exists("cases")) cases = ''
if (!exists("titles")) titles = ''
if (!exists("costs")) costs = 'cpu_s'
if (!exists("quantity")) quantity = 'error'
if (!exists("only")) only = ''
if (!exists("at_end")) at_end = 0
file = data.'/runs.csv'
eval errors(file, at_end)
cost_title(c) = c eq 'cpu_s' ? 'CPU time in s' : c eq 'newton_iterations' ? 'Newton iterations' \
  : c eq 'residuals' ? 'residual evaluations' : c eq 'jacobians' ? 'Jacobians' : c eq 'steps_accepted' ? 'steps' : c eq 'drift' ? 'drift |g|' : c

inCase(case) = isCase(case) && allowed(only)
valueFrom(i) = i > words(variant) ? '' : (i > 1 ? ':' : '').oneWord(strcol(word(variant, i))).valueFrom(i + 1)
curveOf(d) = valueFrom(1)
shown(d) = words(variants) == 0 || position(variants, curveOf(0)) \
  || (variant eq 'integrator' && namesPeers(variants) && isGiven(curveOf(0)))
chosen(case) = inCase(case) && shown(0)
error(d) = errorOrBound(quantity)
asked(d) = absent("rtol") ? column("atol") : column("rtol") > 0 ? column("rtol") : column("atol")

panels = words(cases) > 1 ? words(cases) : words(costs)
caseOf(i) = words(cases) > 1 ? word(cases, i) : word(cases, 1)
costOf(i) = words(cases) > 1 ? word(costs, 1) : word(costs, i)
caseTitle(i) = words(titles) >= i ? word(titles, i) : nameOf(caseOf(i))

# Ranges: for the errors over all panels, for the costs per panel.
tried = 0; rows = 0; failures = 0; coarsest = 1e-300; finest = 1e300; top = 1
array Least[panels]; array Most[panels]; array Marks[panels]; array Runs[panels]
do for [i = 1 : panels] {
  undefine N_*; undefine E_*; undefine C_*; undefine F_*
  stats file using (chosen(caseOf(i)) ? (collect(curveOf(0)), 1) : 0) name "N" nooutput
  Runs[i] = exists("N_sum") ? N_sum : 0; tried = tried + Runs[i]
  stats file using (chosen(caseOf(i)) && error(0) > 0 ? 1 : 0) name "N" nooutput
  Least[i] = 1; Most[i] = 10; Marks[i] = exists("N_sum") ? N_sum : 0
  if (exists("N_sum") && N_sum > 0) {
    rows = rows + N_sum
    stats file using (chosen(caseOf(i)) ? error(0) : NaN) name "E" nooutput
    stats file using (chosen(caseOf(i)) && error(0) > 0 ? positive(column(costOf(i))) : NaN) name "C" nooutput
    coarsest = E_max > coarsest ? E_max : coarsest
    finest = E_min < finest ? E_min : finest
    if (exists("C_min")) { Least[i] = C_min; Most[i] = C_max }
  }
  stats file using (chosen(caseOf(i)) && failedHere(0) ? 1 : 0) name "N" nooutput
  if (exists("N_sum") && N_sum > 0) {
    failures = failures + N_sum; Marks[i] = Marks[i] + N_sum
    stats file using (chosen(caseOf(i)) && failedHere(0) && !isFixed(0) ? 1 : 0) name "N" nooutput
    if (N_sum > 0) {
      stats file using (chosen(caseOf(i)) && failedHere(0) && !isFixed(0) ? asked(0) : NaN) name "F" nooutput
      finest = F_min < finest ? F_min : finest
      coarsest = F_max > coarsest ? F_max : coarsest
    }
  }
}
if (tried == 0) { eval absence(cases." in ".file) }
# The legend lists only curves with a mark.
collected = ""
do for [i = 1 : panels] {
  stats file using (chosen(caseOf(i)) && (error(0) > 0 || failedHere(0)) ? collect(curveOf(0)) : 0) nooutput
}
drawn = collected
wrong = 0; times = 1
do for [i = 1 : panels] {
  stats file using (chosen(caseOf(i)) && position(drawn, curveOf(0)) && error(0) > 0 \
    ? (wrong = wrong || isWrong(0), times = timesOf(0) > times ? timesOf(0) : times) : 0) nooutput
}
in_data = ""
do for [w in (withGiven(variants, drawn))] { in_data = in_data.(position(drawn, w) ? " ".w : "") }
variants = in_data
count = words(variants)
name(k) = word(variants, k)
# Tables write numbers with all their digits; labels are shortened.
titleOf(k) = strlen(name(k)) > 10 && name(k)[1:2] eq '0.' ? sprintf("%.3g", real(name(k))) : label(variants, k)
coarsest = coarsest > 1 ? 1 : coarsest   # an error of 100 % or more has no correct digit
at(case, k) = chosen(case) && curveOf(0) eq name(k)

if (!exists("columns")) columns = panels == 1 ? 1 : panels == 3 ? 3 : 2
lines = (panels + columns - 1) / columns
height = 100.0 + 340 * lines
legend_height = (40 + 18 * (count > 5) + 18 * (count > 8)) / height
margin_left = columns == 1 ? 0.13 : 0.085; margin_right = 0.02; margin_top = lines == 1 ? 0.08 : 40 / height
margin_bottom = legend_height + 66 / height
gap_x = words(cases) > 1 ? 0.065 : 0.09; gap_y = 100 / height
width = columns == 1 ? 640.0 : 1080.0
if (rows > 0) { decade_tics = decadeTics(log10(4 * coarsest / finest), width * cellWidth(columns)) }
do for [format in formats] {
  eval open(format, width, height)
  if (rows == 0) { eval nothing(cases) } else {
    set multiplot
    eval decades("x"); eval decades("y")
    unset key
    do for [i = 1 : panels] {
      case = caseOf(i); c = costOf(i)
      span = Most[i] / Least[i] > 10 ? Most[i] / Least[i] : 10
      level(k) = Most[i] * span ** (0.05 + 0.025 * k)   # failures: a strip above all lines
      eval logTics('y', Least[i], Most[i])
      eval decade_tics
      set xrange [2 * coarsest : finest / 2]
      set yrange [Least[i] / 1.5 : level(count + 1)]
      eval panel(i, columns, lines)
      set title when(words(cases) > 1 || words(costs) == 1 || words(titles) > 0, caseTitle(i)) offset 0,-0.5 noenhanced
      set xlabel when(i > panels - columns, errorTitle(quantity, times))
      set ylabel when(words(costs) > 1 || i % columns == 1 || columns == 1, cost_title(c)) offset 1,0 noenhanced
      if (Marks[i] == 0) {
        unset ytics; set label 1 (Runs[i] == 0 ? 'no runs in this table' : 'no run with a known error') at graph 0.5, graph 0.5 center textcolor rgb ink
        plot 2 * level(count + 1) notitle   # outside
      } else {
        plot for [k = 1 : count] file using (at(case, k) ? error(0) : NaN):(positive(column(c))) \
               with linespoints lw 1.3 dt curveDash(k) pt curvePoint(k) ps 0.7 lc rgb curveColour(k) notitle, \
             for [k = 1 : count] file using (at(case, k) && failedHere(0) ? (isFixed(0) ? 1.5 * coarsest : asked(0)) : outside):(level(k)) \
               with points pt failure_point ps 0.9 lw 2.4 lc rgb curveColour(k) notitle, \
             for [k = 1 : wrong] file using (chosen(case) && position(variants, curveOf(0)) && isWrong(0) ? error(0) : outside):(positive(column(c))) \
               with points pt wrong_point ps ring_size lw ring_width lc rgb failure_colour notitle
      }
      unset label 1
    }
    eval legend(legend_height)
    set key noenhanced maxrows (count > 8 ? 3 : count > 5 ? 2 : 1)
    # An iteration without turns would still widen the legend by its title.
    entries = "plot 2 notitle, for [k = 1 : count] keyentry with linespoints lw 1.3 dt curveDash(k) pt curvePoint(k) ps 0.7 " \
      ."lc rgb curveColour(k) title titleOf(k)"
    if (failures > 0) { entries = entries.", keyentry with points pt failure_point ps 0.9 lw 2.4 lc rgb ink title 'failed'" }
    if (wrong) { entries = entries.", keyentry with points pt wrong_point ps ring_size lw ring_width lc rgb failure_colour title wrong_title" }
    eval entries
    eval framed
    set title; unset multiplot
  }
  unset output
  unset logscale; set xrange [*:*]; set yrange [*:*]
}
