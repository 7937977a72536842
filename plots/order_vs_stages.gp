# Observed order of convergence against the number of stages, one panel per family; the line of theory goes through every
# number of stages, measured or not.
#   gnuplot -e "data='results/order'; out='order_ode'; block='nonlinear'; components='x'" order_vs_stages.gp
# Reads orders.csv, and order_theory.csv if there is one. Options: block or scene and settings, formulation, components ('u v z': several in one panel).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("formulation")) formulation = ''
if (!exists("components")) components = 'x'
file = data.'/orders.csv'
theories = data.'/order_theory.csv'
has_theories = int(system("test -f '".theories."' && echo 1 || echo 0"))
parts = words(components)
part(k) = word(components, k)
partPoint(k) = word("7 5 9 13", k) + 0
partDash(k) = k == 1 ? 1 : k + 1
partTitle(c) = c eq 'u' ? 'position u' : c eq 'v' ? 'velocity v' : c eq 'z' ? 'multiplier z' : 'state x'

chosen(d) = ofCase(0) && is("power_of", 'h') && has("formulation", formulation) \
            && position(components, strcol("component"))
row(family, k) = chosen(0) && group(0) eq family && is("component", part(k))
is_measured(d) = strcol("verdict") ne 'not_measurable'
measured(family, k) = row(family, k) && is_measured(0) ? column("order") : outside
pairOfPart(family, k) = family.':'.part(k)
theory(family, k) = !row(family, k) ? NaN : !absent("theory") ? column("theory") \
                    : position(with_theory, pairOfPart(family, k)) ? NaN : outside
remember(d) = absent("theory") ? 0 : collect(group(0).':'.strcol("component"))
theoryFile(family, k) = position(with_all, pairOfPart(family, k)) ? theories : file
# A tableau of a file has one number of stages, and no line.
theoryOfOne(family, k) = !known(family) && row(family, k) && !absent("theory") ? column("theory") : outside
differing(family, k) = row(family, k) && is("verdict", 'differs') ? column("order") : outside
unmeasured(family, k) = row(family, k) && !is_measured(0) ? y_min + 0.026 * (y_max - y_min) : outside
place(k) = column("stages") + (k - 0.5 * (parts + 1)) * 0.22     # side by side, so that marks do not overlap

eval clashes(file)
stats file using (chosen(0) ? 1 : 0) name "N" nooutput
if (!exists("N_sum") || N_sum == 0) { eval absence(caseName." in ".file) }
stats file using (chosen(0) ? (collect(group(0)), column("stages")) : NaN) name "S" nooutput
found = collected
collected = ""
stats file using (chosen(0) ? remember(0) : 0) nooutput
with_theory = collected
collected = ""
if (has_theories) { stats theories using (chosen(0) ? remember(0) : 0) nooutput }
with_all = collected
# Which marks the legend explains: only those that are drawn.
seen = ""
stats file using (chosen(0) ? (position(seen, strcol("verdict")) ? 0 : strlen(seen = seen." ".strcol("verdict"))) : 0) nooutput
present = ""
do for [f in families_known.found] { present = present.(position(found, f) && !position(present, f) ? " ".f : "") }
n = words(present)
columns = n <= 4 ? n : (n + 1) / 2
lines = (n + columns - 1) / columns
stats file using (chosen(0) && is_measured(0) ? column("order") : 0) name "O" nooutput
y_max = ceil(1.12 * O_max + 1)
y_min = floor(O_min) - 0.07 * y_max
y_step = y_max > 24 ? 8 : y_max > 12 ? 4 : y_max > 6 ? 2 : 1
margin_left = n <= 2 ? 0.1 : 0.07
margin_bottom = lines == 1 ? 0.28 : 0.17; margin_top = lines == 1 ? 0.1 : 0.07
gap_y = 0.13; gap_x = 0.02; margin_right = 0.01
width = n <= 2 ? 820 : n <= 3 ? 860 : 1080
height = lines == 1 ? 340 : 560

do for [format in formats] {
  eval open(format, width, height)
  unset key
  set multiplot
  set xrange [S_min - 0.7 : S_max + 0.7]; set yrange [y_min : y_max]
  x_step = S_max > 12 ? 5 : S_max > 8 ? 2 : 1
  set xtics x_step; set ytics y_step
  do for [i = 1 : n] {
    f = word(present, i)
    eval panel(i, columns, lines)
    set title groupTitle(f) noenhanced offset 0,-0.5
    set format y when((i - 1) % columns == 0, '%g')
    set ylabel when((i - 1) % columns == 0, 'order of convergence') offset 0.3,0
    set xlabel when(i > n - columns, 'stages s') offset 0,0.5
    plot for [k = 1 : parts] theoryFile(f, k) using (place(k)):(theory(f, k)) smooth unique \
           with lines lw 1.3 dt partDash(k) lc rgb familyColour(f) notitle, \
         for [k = 1 : parts] file using (place(k)):(measured(f, k)):(column("confidence")) \
           with yerrorbars pt partPoint(k) ps 0.75 lw 1.2 lc rgb familyColour(f) notitle, \
         for [k = 1 : parts] file using (place(k)):(differing(f, k)) \
           with points pt failure_point ps 1.6 lw 2 lc rgb failure_colour notitle, \
         for [k = 1 : parts] file using (place(k)):(unmeasured(f, k)) \
           with points pt 10 ps 0.8 lc rgb 0x777777 notitle, \
         for [k = 1 : parts] file using (place(k) - 0.3):(theoryOfOne(f, k)):(0.6):(0) \
           with vectors nohead lw 1.3 dt partDash(k) lc rgb familyColour(f) notitle
  }
  eval legend(lines == 1 ? 0.13 : 0.07)
  entries = "plot 2 notitle, for [k = 1 : parts] keyentry with linespoints lw 1.3 dt partDash(k) pt partPoint(k) ps 0.75 " \
    ."lc rgb ink title (parts > 1 ? partTitle(part(k)) : 'theory (line), observed (mark)')"
  if (position(seen, 'differs')) { entries = entries.", keyentry with points pt failure_point ps 1.4 lw 2 " \
    ."lc rgb failure_colour title 'differs from theory'" }
  if (position(seen, 'not_measurable')) { entries = entries.", keyentry with points pt 10 ps 0.8 lc rgb 0x777777 title 'not measurable'" }
  if (position(seen, 'no_theory')) { entries = entries.", keyentry with dots lc rgb 'white' title 'without a line: no theory'" }
  eval entries
  unset multiplot
  unset output
  eval framed
}
