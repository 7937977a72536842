# Order reduction: observed order against the stiffness, one panel per family, one line per number of stages. Grey
# bars show the theoretical orders where they are known. Where the order is not measurable the line is broken, and a
# plus sign stands on the axis.
#   gnuplot -e "data='results/order'; out='order_reduction'; parameter='lambda'" order_vs_stiffness.gp
# Reads orders.csv. Options: block or scene, parameter (the setting that is the stiffness), parameter_default,
# stages_shown.
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("parameter")) parameter = 'lambda'
if (!exists("parameter_default")) parameter_default = '-1e8'
if (!exists("stages_shown")) stages_shown = '1 2 3 4 5'
file = data.'/orders.csv'

wide(settings) = strstrt(settings, '/h') > 0   # the setting is divided by the step: no single stiffness
chosen(d) = ofScene(0) && is("component", 'x') && !wide(strcol("settings")) \
            && position(stages_shown, sprintf("%d", column("stages")))
is_measured(d) = strcol("verdict") ne 'not_measurable'
# gnuplot reads no exponents in text, so mantissa and exponent are read separately.
textOf(settings) = settings eq '' ? parameter_default : settings[strlen(parameter) + 2 : *]
magnitude(text) = text[1:1] eq '-' ? text[2:*] : text
valueOf(text) = strstrt(text, 'e') == 0 ? text + 0 \
                : (text[1 : strstrt(text, 'e') - 1] + 0) * 10.0 ** (text[strstrt(text, 'e') + 1 : *] + 0)
stiffness(d) = valueOf(magnitude(textOf(strcol("settings"))))
row(family, s) = chosen(0) && group(0) eq family && column("stages") == s

eval clashes(file)
stats file using (chosen(0) ? 1 : 0) name "N" nooutput
if (!exists("N_sum") || N_sum == 0) { eval absence(caseName." in ".file) }
stats file using (chosen(0) ? (collect(group(0)), stiffness(0)) : NaN) name "X" nooutput
found = collected
collected = ""
# Without numbers of stages that were measured at the largest stiffness only.
isCurve(d) = chosen(0) && (stiffness(0) < 0.99 * X_max || X_min > 0.99 * X_max)
stats file using (isCurve(0) ? (collect(sprintf("%d", column("stages"))), 0) : NaN) nooutput
stages = sorted(collected)
collected = ""
stats file using (chosen(0) ? (collect(sprintf("%.6f", log10(stiffness(0)))), 0) : NaN) nooutput
levels = sorted(collected)
levelNumber(d) = sum [k = 1 : words(levels)] (abs(real(word(levels, k)) - log10(stiffness(0))) < 1e-5 ? k : 0)

# Writes lines `stiffness,order,theory,not measurable` to $D, one block per number of stages of one family.
array orders[words(levels)]
array theories[words(levels)]
array lost[words(levels)]
clear(d) = sum [j = 1 : words(levels)] (orders[j] = NaN, theories[j] = NaN, lost[j] = NaN, 0)
take(j) = (orders[j] = is_measured(0) ? column("order") : NaN, \
           theories[j] = absent("theory") ? NaN : column("theory"), lost[j] = is_measured(0) ? NaN : 1, 1)
present = ""
do for [f in families_known.found] { present = present.(position(found, f) && !position(present, f) ? " ".f : "") }
n = words(present)
columns = n <= 4 ? n : (n + 1) / 2
lines = (n + columns - 1) / columns
stats file using (chosen(0) && is_measured(0) ? column("order") : NaN) name "O" nooutput
y_min = O_min - 0.9
margin_left = 0.07; margin_bottom = lines == 1 ? 0.28 : 0.17; margin_top = lines == 1 ? 0.1 : 0.07; gap_y = 0.13; gap_x = 0.02; margin_right = 0.01

do for [format in formats] {
  eval open(format, 1080, lines == 1 ? 340 : 560)
  unset key
  set multiplot
  eval decades("x")
  set ytics 2; set xtics 100
  do for [i = 1 : n] {
    f = word(present, i)
    eval panel(i, columns, lines)
    set title groupTitle(f) noenhanced offset 0,-0.5
    set format y when((i - 1) % columns == 0, '%g')
    set ylabel when((i - 1) % columns == 0, 'order of convergence') offset 0.3,0
    set xlabel when(i > n - columns, 'stiffness |λ| in 1/s') offset 0,0.5
    set xrange [*:*]; set yrange [*:*]   # stats uses only values inside the ranges
    collected = ""
    stats file using (isCurve(0) && group(0) eq f ? (collect(sprintf("%d", column("stages"))), 1) : NaN) nooutput
    here = sorted(collected)
    set print $D
    do for [k in here] {
      dummy = clear(0)
      stats file using (row(f, int(k)) ? take(levelNumber(0)) : NaN) nooutput
      # gnuplot warns about blocks without a valid point, so each block starts with a point outside the panel.
      print sprintf("%g,%g,%g,0", X_min, outside, outside)
      print ""
      do for [j = 1 : words(levels)] {
        print sprintf("%g,%g,%g,%g", 10 ** real(word(levels, j)), orders[j], theories[j], lost[j])
      }
      print ""
      print ""
    }
    unset print
    set datafile nocolumnheaders; set datafile missing
    stage(k) = int(word(here, k))
    set xrange [X_min / 3 : X_max * 3]; set yrange [y_min : O_max + 0.8]
    plot for [k = 1 : words(here)] $D index k - 1 using ($1 / 2.5):3:($1 * 5.25 / 2.5):(0) \
           with vectors nohead lw 4 lc rgb 0xc8c8c8 notitle, \
         for [k = 1 : words(here)] $D index k - 1 using 1:2 \
           with linespoints lw 1.2 dt stageDash(stage(k)) pt stagePoint(stage(k)) ps 0.8 lc rgb stageColour(stage(k)) notitle, \
         for [k = 1 : words(here)] $D index k - 1 using ($1 * 1.5 ** (k - 0.5 * (words(here) + 1))):($4 == 1 ? y_min + 0.3 : outside) \
           with points pt 1 ps 0.9 lw 1.6 lc rgb stageColour(stage(k)) notitle
    set datafile columnheaders; set datafile missing NaN
    undefine $D
  }
  eval legend(lines == 1 ? 0.13 : 0.07)
  plot 2 notitle, for [s in stages] keyentry with linespoints lw 1.2 dt stageDash(int(s)) pt stagePoint(int(s)) ps 0.8 \
         lc rgb stageColour(int(s)) title 's = '.s, \
       keyentry with lines lw 4 lc rgb 0xc8c8c8 title 'theory', \
       keyentry with points pt 1 ps 0.9 lw 1.6 lc rgb ink title 'not measurable'
  unset multiplot
  unset output
  unset logscale
  eval framed
}
