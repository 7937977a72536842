# What the choices of an axis cost at equal errors, over the first choice: one curve per other value of a column, one
# panel per case or per cost. Below 1 a choice is cheaper than the first one. A cross marks an error that the first choice
# reaches and this one does not.
#   gnuplot -e "data='results/control'; out='ratio'; variant='norm'; cases='block=norm_pendulums:pendulum'" cost_ratio.gp
# Reads cpu_at_error.csv. Options: variant (a column; its values are the curves), variants (the first one is that of the
# comparison; by default in the order of the table), cases (block=NAME, block=NAME:SCENE, SCENE or SCENE:SETTINGS, in
# quotes if they contain blanks), titles (quoted words, one per case), costs (columns; with one case several costs: one
# panel each), only (quoted words column=value that all rows must have).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("variant")) variant = 'control'
if (!exists("variants")) variants = ''
if (!exists("cases")) cases = ''
if (!exists("titles")) titles = ''
if (!exists("costs")) costs = 'cpu_s'
if (!exists("only")) only = ''
file = data.'/cpu_at_error.csv'
cost_title(c) = c eq 'cpu_s' ? 'CPU time' : c eq 'newton_iterations' ? 'Newton iterations' \
  : c eq 'residuals' ? 'residuals' : c eq 'jacobians' ? 'Jacobians' : c
n = words(cases) > 1 ? words(cases) : words(costs)
caseOf(i) = words(cases) > 1 ? word(cases, i) : word(cases, 1)
costOf(i) = words(cases) > 1 ? word(costs, 1) : word(costs, i)
titleOf(i) = words(cases) <= 1 ? cost_title(costOf(i)) : words(titles) >= i ? word(titles, i) : nameOf(caseOf(i))
curveOf(d) = oneWord(strcol(variant))
chosen(i) = isCase(caseOf(i)) && allowed(only) && (words(variants) == 0 || position(variants, curveOf(0)))

tried = 0
do for [i = 1 : n] {
  undefine N_*
  stats file using (chosen(i) ? (collect(curveOf(0)), 1) : 0) name "N" nooutput
  tried = tried + (exists("N_sum") ? N_sum : 0)
}
if (tried == 0) { eval absence(cases." in ".file) }
if (words(variants) == 0) { variants = collected }
count = words(variants)
collected = ""
stats file using (collect(sprintf("%.2f", log10(column("target_error")))), 1) name "N" nooutput
exponents = sorted(collected)
targets = words(exponents)
target(k) = 10 ** real(word(exponents, k))

# Costs by panel, value and target; 0: not reached.
array Cost[n * count * targets]
slot(i, v, k) = ((i - 1) * count + v - 1) * targets + k
targetHere(d) = sum [k = 1 : targets] (abs(log10(column("target_error")) - real(word(exponents, k))) < 0.01 ? k : 0)
do for [k = 1 : n * count * targets] { Cost[k] = 0 }
do for [i = 1 : n] {
  stats file using (chosen(i) && !absent(costOf(i)) && column(costOf(i)) > 0 \
    ? (Cost[slot(i, position(variants, curveOf(0)), targetHere(0))] = column(costOf(i)), 1) : 0) nooutput
}
base(i, k) = Cost[slot(i, 1, k)]
cost(i, v, k) = Cost[slot(i, v, k)]
ratio(i, v, k) = base(i, k) > 0 && cost(i, v, k) > 0 ? cost(i, v, k) / base(i, k) : NaN
isLost(i, v, k) = base(i, k) > 0 && cost(i, v, k) == 0
least = 1; most = 1; lost = 0; rows = 0
do for [i = 1 : n] { do for [v = 2 : count] { do for [k = 1 : targets] {
  lost = lost || isLost(i, v, k)
  if (base(i, k) > 0 && cost(i, v, k) > 0) {
    r = ratio(i, v, k); rows = rows + 1
    least = r < least ? r : least; most = r > most ? r : most
  }
} } }

wordOf(v) = word(variants, v)
# Tables write numbers with all their digits; labels are shortened.
valueTitle(v) = strlen(wordOf(v)) > 10 && wordOf(v)[1:2] eq '0.' ? sprintf("%.3g", real(wordOf(v))) : wordOf(v)
reaches(v) = sum [i = 1 : n] sum [k = 1 : targets] (base(i, k) > 0 && (cost(i, v, k) > 0 || isLost(i, v, k)))
seen = ""
do for [v = 2 : count] { seen = seen.(reaches(v) > 0 ? sprintf(" %d", v) : "") }

columns = n > 3 ? 2 : n
lines = (n + columns - 1) / columns
width = columns == 1 ? 640.0 : 1080.0
height = 120.0 + 280 * lines
legend_height = 44.0 / height
margin_left = columns == 1 ? 0.13 : 0.075; margin_right = 0.02; margin_top = 36 / height
margin_bottom = legend_height + 60 / height; gap_x = words(cases) > 1 ? 0.03 : 0.06; gap_y = 70 / height
do for [format in formats] {
  eval open(format, width, height)
  if (rows == 0) { eval nothing(cases) } else {
    set multiplot
    eval decades("x"); set logscale y
    unset key
    span = most / least > 1.5 ? most / least : 1.5
    top = most * span ** 0.12
    set xrange [2 * target(targets) : target(1) / 2]
    set yrange [least / span ** 0.08 : lost ? top * span ** (0.04 * count) : top]
    set ytics (0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1, 1.5, 2, 3, 5, 10, 20, 50, 100) nomirror
    if (span < 5) { set ytics add (0.6, 0.8, 1.25, 1.75, 2.5) }
    if (span < 2) { set ytics add (0.9, 1.1) }
    do for [i = 1 : n] {
      eval panel(i, columns, lines)
      eval decadeTics(log10(4 * target(targets) / target(1)), width * cellWidth(columns))
      set title titleOf(i) offset 0,-0.5 noenhanced
      set xlabel when(i > n - columns, 'error')
      inner = words(cases) > 1 && i % columns != 1 && columns > 1
      set format y (inner ? '' : '%g')
      set ylabel when(i % columns == 1 || columns == 1, when(words(cases) > 1, cost_title(costOf(i)).' ').'over those of '.wordOf(1)) \
        offset 1,0 noenhanced
      plot 1 with lines lw 1.6 lc rgb 0x888888 notitle, \
        for [v in seen] '+' using (target(int($0) + 1)):(ratio(i, number(v), int($0) + 1)) every ::0::(targets - 1) \
          with linespoints lw 1.3 dt curveDash(number(v)) pt curvePoint(number(v)) ps 0.8 lc rgb curveColour(number(v)) notitle, \
        for [v in seen] '+' using (isLost(i, number(v), int($0) + 1) ? target(int($0) + 1) : outside): \
          (top * span ** (0.04 * (number(v) - 1))) every ::0::(targets - 1) \
          with points pt failure_point ps 0.9 lw 2.4 lc rgb curveColour(number(v)) notitle
    }
    eval legend(legend_height)
    set key noenhanced
    entries = "plot 2 notitle, for [v in seen] keyentry with linespoints lw 1.3 dt curveDash(number(v)) pt curvePoint(number(v)) ps 0.8 " \
      ."lc rgb curveColour(number(v)) title valueTitle(number(v)), keyentry with lines lw 1.6 lc rgb 0x888888 title wordOf(1)"
    if (lost) { entries = entries.", keyentry with points pt failure_point ps 0.9 lw 2.4 lc rgb ink title 'not reached'" }
    eval entries
    eval framed
    set title; unset multiplot
  }
  unset output
  unset logscale; set xrange [*:*]; set yrange [*:*]
}
