# CPU time at a fixed error against the number of stages: one line per error, one panel per case. A mark above the
# lines stands for a number of stages that did not reach the error.
#   gnuplot -e "data='results/cpu_time'; out='cpu'; cases='block=crank block=crank_torque_off'" cpu_vs_stages.gp
# Reads cpu_at_error.csv. Options: cases (block=NAME, block=NAME:SCENE, SCENE or SCENE:SETTINGS, in quotes if they
# contain blanks; one panel each), family, cost (a column: cpu_s, residuals, newton_iterations), titles (quoted words,
# one per case).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("cases")) cases = ''
if (!exists("family")) family = 'radau_iia'
if (!exists("cost")) cost = 'cpu_s'
if (!exists("titles")) titles = ''
file = data.'/cpu_at_error.csv'
n = words(cases)
caseTitle(i) = words(titles) >= i ? word(titles, i) : nameOf(word(cases, i))

row(case) = isCase(case) && is("family", family)
at(case, error) = row(case) && abs(log10(column("target_error")) - log10(error)) < 0.01
reached(case, error) = at(case, error) && !absent(cost) ? column(cost) : outside
# A line joins neighbours that both reach the error; it is drawn as a vector from the previous row to this one.
# The line is broken at several methods of one number of stages.
from(case, error) = ($0 == 0 ? (this_y = 0) : 0, !at(case, error) ? outside : \
  (last_x = this_x, last_y = this_y, this_x = column("stages"), this_y = absent(cost) || position(clashing, pairWord(0)) ? 0 : column(cost), \
   last_y > 0 && this_y > 0 ? last_x : outside))
last_x = 1; last_y = 0; this_x = 1; this_y = 0
missed(case, error) = at(case, error) && absent(cost) ? column("stages") : outside

eval clashes(file)
rows = 0; tried = 0; most = 0; least = 1e300; s_max = 1
do for [i = 1 : n] {
  undefine N_*
  stats file using (row(word(cases, i)) ? 1 : 0) name "N" nooutput
  tried = tried + (exists("N_sum") ? N_sum : 0)
  stats file using (row(word(cases, i)) && !absent(cost) ? 1 : 0) name "N" nooutput
  if (exists("N_sum") && N_sum > 0) {
    stats file using (row(word(cases, i)) ? (collect(sprintf("%.2f", log10(column("target_error")))), \
      s_max = column("stages") > s_max ? column("stages") : s_max, positive(column(cost))) : NaN) name "C" nooutput
    rows = rows + N_sum
    most = C_max > most ? C_max : most
    least = C_min < least ? C_min : least
  }
}
if (tried == 0) { eval absence(cases." in ".file) }
exponents = sorted(collected)
count = words(exponents)
target(k) = 10 ** real(word(exponents, count + 1 - k))   # the largest error first
errorColour(k) = stageColour(1 + (k - 1) * 19.0 / (count > 1 ? count - 1 : 1))
errorPoint(k) = int(word("6 4 9 7 5 11 13 15", (k - 1) % 8 + 1))
errorDash(k) = k <= 3 ? 5 - k : 1

# Labels 1, 2, 5 are wider than decades, and all panels have them.
few = rows > 0 && most / least < 99
margin_left = n == 1 ? 0.14 : few ? 0.1 : 0.075; margin_right = n == 1 ? 0.24 : 0.14
margin_bottom = 0.14; gap_x = few ? 0.085 : 0.03
do for [format in formats] {
  eval open(format, n == 1 ? 640 : 1080, 400)
  if (rows == 0) { eval nothing(cases) } else {
    set multiplot
    eval decades("y")
    set logscale x
    set mytics (most / least < 1e3 ? 10 : 1)
    eval logTics('y', least, most)
    set xtics (1, 2, 3, 4, 5, 7, 10, 15, 20, 30, 50, 100) nomirror
    unset mxtics
    level(k) = most * (most / least) ** (0.05 + 0.03 * k)
    set xrange [0.9 : s_max * 1.12]; set yrange [least / 1.5 : level(count + 1)]
    do for [i = 1 : n] {
      case = word(cases, i)
      eval panel(i, n, 1)
      set title caseTitle(i) noenhanced offset 0,-0.5
      set xlabel 'stages s'
      if (i > 1) { set format y '' }
      set ylabel when(i == 1, cost eq 'cpu_s' ? 'CPU time in s' : cost) offset 1,0 noenhanced
      unset key
      if (i == n) { set key at graph 1.03, graph 1 left top Left reverse enhanced title 'error' left }
      plot for [k = 1 : count] file using "stages":(reached(case, target(k))) \
             with points pt errorPoint(k) ps 0.8 lc rgb errorColour(k) notitle, \
           for [k = 1 : count] file \
             using (from(case, target(k))):(last_y):(this_x - last_x):(this_y - last_y) \
             with vectors nohead lw 1.2 dt errorDash(k) lc rgb errorColour(k) notitle, \
           for [k = 1 : count] file using (missed(case, target(k))):(level(k)) \
             with points pt failure_point ps 0.9 lw 2.4 lc rgb errorColour(k) notitle, \
           for [k = 1 : count] keyentry with linespoints lw 1.2 dt errorDash(k) pt errorPoint(k) ps 0.8 \
             lc rgb errorColour(k) title sprintf("10^{%.0f}", log10(target(k))), \
           keyentry with points pt failure_point ps 0.9 lw 2.4 lc rgb ink title 'not reached'
    }
    unset multiplot
  }
  unset output
  unset logscale; set xrange [*:*]; set yrange [*:*]
}
