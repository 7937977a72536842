# The least cost of an error over all numbers of stages: one curve per family (or per value of another column), one
# panel per scene.
#   gnuplot -e "data='results/families'; out='families'; cases='block=pendulum block=crank'" best_cost.gp
# Reads cpu_at_error.csv. Options: cases (block=NAME, block=NAME:SCENE, SCENE or SCENE:SETTINGS, in quotes if they
# contain blanks), by (a column), values (the values to show), cost (cpu_s, residuals, ...), titles (quoted words, one
# per case).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("cases")) cases = ''
if (!exists("by")) by = 'family'
if (!exists("values")) values = ''
if (!exists("cost")) cost = 'cpu_s'
if (!exists("titles")) titles = ''
file = data.'/cpu_at_error.csv'
n = words(cases)
caseTitle(i) = words(titles) >= i ? word(titles, i) : nameOf(word(cases, i))
inCase(i) = isCase(word(cases, i))

tried = 0
do for [i = 1 : n] {
  undefine N_*
  stats file using (inCase(i) ? (collect(strcol(by)), 1) : 0) name "N" nooutput
  tried = tried + (exists("N_sum") ? N_sum : 0)
}
if (tried == 0) { eval absence(cases." in ".file) }
if (words(values) == 0) { values = collected }
count = words(values)
collected = ""
stats file using (collect(sprintf("%.2f", log10(column("target_error")))), 1) name "N" nooutput
exponents = sorted(collected)
targets = words(exponents)
target(k) = 10 ** real(word(exponents, k))
at(i, v, k) = inCase(i) && strcol(by) eq word(values, v) && abs(log10(column("target_error")) - real(word(exponents, k))) < 0.01 && !absent(cost)
array Best[n * count * targets]
slot(i, v, k) = ((i - 1) * count + v - 1) * targets + k
least = 1e300; most = 0
do for [i = 1 : n] { do for [v = 1 : count] { do for [k = 1 : targets] {
  best = 1e300
  stats file using (at(i, v, k) ? (best = column(cost) < best ? column(cost) : best, 1) : 0) nooutput
  Best[slot(i, v, k)] = best
  if (best < 1e300) { least = best < least ? best : least; most = best > most ? best : most }
} } }
colour(v) = by eq 'family' ? familyColour(word(values, v)) : curveColour(v)
pointOf(v) = by eq 'family' ? familyPoint(word(values, v)) : curvePoint(v)
dash(v) = by eq 'family' ? familyDash(word(values, v)) : curveDash(v)
titleOf(v) = by eq 'family' ? familyTitle(word(values, v)) : word(values, v)

# Three panels in a row have no room for every decade.
wide_tics = 'set xtics ('
do for [e = -8 : 0] { wide_tics = wide_tics.sprintf("%s'10^{%d}' %g", e == -8 ? '' : ', ', 2 * e, 10.0 ** (2 * e)) }
wide_tics = wide_tics.') nomirror'
margin_left = n == 1 ? 0.13 : 0.085; margin_right = 0.02; margin_bottom = 0.27; gap_x = 0.06
do for [format in formats] {
  eval open(format, n == 1 ? 640 : 1080, 430)
  set multiplot
  unset key
  eval decades("x"); eval decades("y")
  set xrange [2 * target(targets) : target(1) / 2]
  do for [i = 1 : n] {
    low = 1e300; high = 0; have = ""
    do for [v = 1 : count] { do for [k = 1 : targets] {
      b = Best[slot(i, v, k)]
      if (b < 1e300) { low = b < low ? b : low; high = b > high ? b : high; have = have.(position(have, sprintf("%d", v)) ? "" : sprintf(" %d", v)) }
    } }
    empty = high == 0
    if (empty) { low = 1; high = 10 }
    set yrange [low / 1.5 : high * 1.5]
    if (empty) { set ytics ('' 1); set label 1 "no run reaches an error\nof the table" at graph 0.5, graph 0.5 center textcolor rgb ink } else { eval logTics('y', low, high) }
    if (n > 2 && targets > 5) { eval wide_tics }
    eval panel(i, n, 1)
    set title caseTitle(i) offset 0,-0.5 noenhanced
    set xlabel 'error'
    set ylabel when(i == 1, cost eq 'cpu_s' ? 'CPU time in s' : cost) offset 1,0 noenhanced
    best_at(v, j) = Best[slot(i, v, j + 1)] < 1e300 ? Best[slot(i, v, j + 1)] : NaN
    if (empty) { plot 2 * high notitle } else {
      plot for [v in have] '+' using (target(int($0) + 1)):(best_at(number(v), int($0))) every ::0::(targets - 1) \
        with linespoints lw 1.4 dt dash(number(v)) pt pointOf(number(v)) ps 0.8 lc rgb colour(number(v)) notitle
    }
    unset label 1
  }
  eval legend(0.11)
  plot 2 notitle, for [v = 1 : count] keyentry with linespoints lw 1.4 dt dash(v) pt pointOf(v) ps 0.8 lc rgb colour(v) title titleOf(v)
  unset multiplot
  unset output
  eval framed
  unset logscale; set xrange [*:*]; set yrange [*:*]
}
