# Error against step size for fixed steps, one panel per family and one line per method, with the slopes of the
# theoretical orders.
#   gnuplot -e "data='results/order'; out='error'; block='nonlinear'; families='radau_iia gauss'" error_vs_step.gp
# Reads runs.csv, and orders.csv, if there is one, for the window of the fit. Options: block or scene and settings,
# formulation, scalar, component ('x' selects the column error_x, '' the column error), families (one panel each), stages_shown,
# only (quoted words column=value that all rows must have).
# Thins by h error error_u error_v error_x error_z
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("formulation")) formulation = ''
if (!exists("scalar")) scalar = ''
if (!exists("component")) component = 'x'
if (!exists("only")) only = ''
if (!exists("families")) families = 'radau_iia gauss'
if (!exists("stages_shown")) stages_shown = '1 2 3 4 5 6 7 8 10 12 15 20'
file = data.'/runs.csv'
fits = data.'/orders.csv'
# The rows of orders.csv do not have all the columns that `only` may name.
has_fits = only eq '' && int(system("test -f '".fits."' && echo 1 || echo 0"))
quantity = component eq '' ? 'error' : 'error_'.component
n = words(families)

chosen(d) = ofCase(0) && allowed(only) && has("formulation", formulation) \
            && has("scalar", scalar) && position(families, strcol("family")) \
            && position(stages_shown, sprintf("%d", column("stages")))
row(family, w) = chosen(0) && is("family", family) && isMethod(w)
failed(family) = chosen(0) && is("family", family) && !succeeded(0) ? column("h") : outside
error(d) = succeeded(0) ? positive(column(quantity)) : NaN

stats file using (chosen(0) ? 1 : 0) name "N" nooutput
if (!exists("N_sum") || N_sum == 0) { eval absence(caseName." in ".file) }
stats file using (chosen(0) ? (collect(methodWord(0)), column("h")) : NaN) name "H" nooutput
stats file using (chosen(0) && succeeded(0) && !absent(quantity) ? 1 : 0) name "N" nooutput
rows = N_sum
if (rows > 0) { stats file using (chosen(0) ? error(0) : NaN) name "E" nooutput }
methods = sortedMethods(collected)
method(k) = word(methods, k)
# Round-off of the numbers of the runs.
round_offs = "double 2.2e-16 mp50 5e-51 mp100 6e-101"
scalars = ""
stats file using (chosen(0) && succeeded(0) ? (position(scalars, strcol("scalar")) ? 0 : strlen(scalars = scalars." ".strcol("scalar"))) : 0) nooutput
mantissa(x) = x[1 : strstrt(x, 'e') - 1] + 0
roundOff(name) = mantissa(word(round_offs, position(round_offs, name) + 1)) * 10.0 ** int(word(round_offs, position(round_offs, name) + 1)[strstrt(word(round_offs, position(round_offs, name) + 1), 'e') + 1 : *])
if (rows > 0) { y_max = 10 * E_max; y_min = E_min / 3; fail_at = 0.4 * y_max }

# The theoretical slope, drawn through the middle of the points that the fit used.
fit_row(family, w) = ofCase(0) && is("power_of", 'h') && has("formulation", formulation) \
                     && has("component", component) && is("family", family) && isMethod(w)
slots = n * words(methods) + 1
array Lower[slots]; array Upper[slots]; array Level[slots]; array Slope[slots]; array Fitted[slots]; array Count[slots]
slot(i, k) = (i - 1) * words(methods) + k
do for [i = 1 : n] { do for [k = 1 : words(methods)] {
  f = word(families, i); w = method(k); m = slot(i, k)
  Slope[m] = NaN; Fitted[m] = NaN
  stats file using (row(f, w) && succeeded(0) && !absent(quantity) && column(quantity) > 0 ? 1 : 0) name "N" nooutput
  Count[m] = N_sum
  if (has_fits) { stats fits using (fit_row(f, w) ? (Fitted[m] = column("order"), Slope[m] = column("theory"), \
    Lower[m] = column("h_min"), Upper[m] = column("h_max"), 0) : 0) nooutput }
  if (Fitted[m] == Fitted[m] && Slope[m] == Slope[m]) {  # without a theory there is no slope to draw
    undefine L_*
    stats file using (row(f, w) && column("h") >= 0.999 * Lower[m] && column("h") <= 1.001 * Upper[m] \
      ? log10(error(0)) - Slope[m] * log10(column("h")) : NaN) name "L" nooutput
    Level[m] = exists("L_median") ? 10 ** L_median : NaN
  }
} }
fitted(m) = Slope[m] == Slope[m] && Fitted[m] == Fitted[m]
fittedIn(i, k) = k == 0 ? "" : fittedIn(i, k - 1).when(fitted(slot(i, k)), sprintf("%d ", k))
linesIn(i, k) = k == 0 ? "" : linesIn(i, k - 1).when(Count[slot(i, k)] > 0, sprintf("%d ", k))
predicted(m, family, w) = fitted(m) && row(family, w) && column("h") >= 0.999 * Lower[m] \
  && column("h") <= 1.001 * Upper[m] ? Level[m] * column("h") ** Slope[m] : NaN
interval(i, k) = 1 + Count[slot(i, k)] / 24   # draws a mark only at some of the points if there are many
seriesTitle(i, k) = sprintf("%s%s", methodTitle(methods, k), \
  Fitted[slot(i, k)] == Fitted[slot(i, k)] ? sprintf(": %.2f", Fitted[slot(i, k)]) : "")

columns = n == 1 ? 1 : 2
lines = (n + columns - 1) / columns
# The names of twins need room beside each panel.
longest = 0
do for [i = 1 : n] { do for [k = 1 : words(methods)] { length = strlen(seriesTitle(i, k)); longest = length > longest ? length : longest } }
room = longest > 9 ? 7.0 * (longest - 9) : 0
usual = columns == 1 ? 640.0 : 1080.0
width = usual + columns * room
height = 60.0 + 360 * lines
margin_left = (columns == 1 ? 0.12 : 0.075) * usual / width; margin_right = ((columns == 1 ? 0.2 : 0.125) * usual + room) / width
margin_top = 30 / height; margin_bottom = 60 / height; gap_y = 80 / height; gap_x = columns == 1 ? 0 : (0.17 * usual + room) / width
do for [format in formats] {
  eval open(format, width, height)
  if (rows == 0) { eval nothing(caseName) } else {
    set multiplot
    eval decades("x"); eval decades("y")
    set xrange [H_min / 1.4 : H_max * 1.4]; set yrange [y_min : y_max]
    do for [i = 1 : n] {
      f = word(families, i)
      eval panel(i, columns, lines)
      set title familyTitle(f) offset 0,-0.5 noenhanced
      set xlabel when(i > n - columns, 'step h')
      set ylabel when(columns == 1 || i % columns == 1, 'error') offset 0,0
      set key at graph 1.02, graph 1 left top Left reverse title (has_fits ? 's: order' : 'stages') left
      unset arrow; unset label
      do for [s in scalars] { if (position(round_offs, s) && 100 * roundOff(s) > y_min && roundOff(s) < y_max && rows > 0) {
        set arrow from graph 0, first roundOff(s) to graph 1, first roundOff(s) nohead dt 2 lw 1 lc rgb 0x888888 back
        if (log10(roundOff(s) / y_min) > 0.1 * log10(y_max / y_min)) {
          set label 'round-off, '.s at graph 0.02, first roundOff(s) left offset 0,-0.6 font ',9' textcolor rgb 0x666666
        } else {   # below it stand the labels of the axis
          set label 'round-off, '.s at graph 0.98, first roundOff(s) right offset 0,0.6 font ',9' textcolor rgb 0x666666
        } } }
      plot for [k in fittedIn(i, words(methods))] file using "h":(predicted(slot(i, number(k)), f, method(number(k)))) \
             smooth unique with lines lw 4 lc rgb 0xD0D0D0 notitle, \
           for [k in linesIn(i, words(methods))] file using "h":(row(f, method(number(k))) ? error(0) : NaN) \
             smooth unique with linespoints lw 1 dt methodDash(methods, number(k)) pt methodPoint(methods, number(k)) \
             ps 0.6 pi interval(i, number(k)) lc rgb methodColour(methods, number(k)) \
             title seriesTitle(i, number(k)), \
           file using (failed(f)):(fail_at) with points pt failure_point ps 1 lw 2.4 lc rgb failure_colour notitle
    }
    unset multiplot; unset arrow; unset label
  }
  unset output
  unset logscale
}
