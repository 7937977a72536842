# Where a method works: correct digits over stages and step (or tolerance, or stiffness), one panel per family. A
# failed run has no colour and a mark for its cause; a grey column is a method that does not exist.
#   gnuplot -e "data='results/failure_constraints'; out='map'; block='usual_steps'; only='formulation=index3'" failure_map.gp
# Reads runs.csv. Options: block or scene; only (quoted words column=value that all rows must have); y (h, rtol, or a
# parameter of the scene: the magnitude of its number in the column settings, or y_default where it is missing);
# y_label; panel_by (a column); panels (its values to show, in this order); quantity (error, error_u, ...);
# quantity_label; y_min; y_max.
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("only")) only = ''
if (!exists("y")) y = 'h'
if (!exists("y_label")) y_label = y eq 'h' ? 'step h' : y eq 'rtol' ? 'tolerance' : y
if (!exists("y_default")) y_default = NaN
if (!exists("panel_by")) panel_by = 'family'
if (!exists("panels")) panels = ''
if (!exists("quantity")) quantity = 'error'
if (!exists("quantity_label")) quantity_label = 'correct digits'
if (!exists("y_min")) y_min = 0
if (!exists("y_max")) y_max = 1e300
file = data.'/runs.csv'

# Causes of failure: name in the table, mark, label.
causes = "newton_failed step_too_small max_steps timeout singular not_finite inconsistent_start chattering stalled drift no_event inaccurate refused"
cause_points = "2 1 8 10 4 6 12 3 14 9 11 13 0"
cause_titles = "'Newton fails' 'step too small' 'too many steps' 'too slow' 'singular' 'not finite' 'inconsistent start' 'chattering' 'steps stay tiny' 'drift' 'no such event' 'errors add up' 'not allowed'"
causeTitle(k) = word(cause_titles, k)
causePoint(k) = k > 0 ? int(word(cause_points, k)) : 0

# The number behind "name=" in the settings; settings omit parameters at their defaults.
scientific(x) = (exponent = strstrt(x, 'e'), exponent == 0 ? real(x) : real(x[1 : exponent - 1]) * 10.0 ** int(x[exponent + 1 : strlen(x)]))
behind(name) = (found = strstrt(' '.strcol("settings"), ' '.name.'='), found == 0 ? y_default : \
  scientific(word(strcol("settings")[found + strlen(name) + 1 : strlen(strcol("settings"))], 1)))
level(d) = y eq 'h' || y eq 'rtol' ? column(y) : abs(behind(y))
row(d) = ofScene(0) && allowed(only) && level(0) >= y_min && level(0) <= y_max
good(d) = row(0) && succeeded(0) && !absent(quantity)
# An error of 100 % or more has no correct digit; one below round-off counts as 16.
digits(d) = column(quantity) <= 1e-16 ? 16 : column(quantity) >= 1 ? 0 : -log10(column(quantity))

eval clashes(file)
panelValue(d) = panel_by eq 'family' ? group(0) : strcol(panel_by)
undefine N_*
stats file using (row(0) ? 1 : 0) name "N" nooutput
if (!exists("N_sum") || N_sum == 0) { eval absence(caseName." in ".file) }
stats file using (row(0) ? (collect(sprintf("%.6f", log10(level(0)))), 1) : NaN) name "L" nooutput
levels = sorted(collected)
collected = ""
stats file using (row(0) ? (collect(sprintf("%d", column("stages"))), 1) : NaN) name "L" nooutput
stages = sorted(collected)
collected = ""
stats file using (row(0) ? (collect(panelValue(0)), 1) : NaN) name "L" nooutput
if (words(panels) == 0) { panels = collected }
collected = ""
stats file using (row(0) && !succeeded(0) ? (collect(strcol("outcome")), 1) : 0) name "L" nooutput
seen = collected
n = words(panels)
panelTitle(i) = panel_by eq 'family' ? groupTitle(word(panels, i)) : panel_by.' '.word(panels, i)

# Each pair of stages and level has a cell; its coordinates are the positions in the sorted lists.
stageNumber(d) = sum [k = 1 : words(stages)] (int(word(stages, k)) == column("stages") ? k : 0)
levelNumber(d) = sum [k = 1 : words(levels)] (abs(real(word(levels, k)) - log10(level(0))) < 1e-5 ? k : 0)
inPanel(i) = row(0) && panelValue(0) eq word(panels, i)
levelText(x) = abs(x - floor(x + 0.5)) < 1e-4 ? sprintf("10^{%d}", floor(x + 0.5)) \
  : sprintf("%.2g·10^{%d}", 10 ** (x - floor(x)), floor(x))
# A label of two digits needs the width of two cells; the last label is always drawn.
crowded = words(stages) > 9
stage_tics = "set xtics ("; do for [k = 1 : words(stages)] {
  text = crowded && strlen(word(stages, k)) > 1 && (words(stages) - k) % 2 ? '' : word(stages, k)
  stage_tics = stage_tics.sprintf("%s'%s' %d", k == 1 ? '' : ', ', text, k) }
stage_tics = stage_tics.")"
level_tics = "set ytics ("; do for [k = 1 : words(levels)] {
  level_tics = level_tics.sprintf("%s'%s' %d", k == 1 ? '' : ', ', levelText(real(word(levels, k))), k) }
level_tics = level_tics.")"

# Numbers of stages without any row in a panel: the family has no such member.
absent_stages = ""
do for [i = 1 : n] {
  collected = ""
  stats file using (inPanel(i) ? (collect(sprintf("%d", stageNumber(0))), 1) : NaN) name "L" nooutput
  do for [k = 1 : words(stages)] { if (!position(collected, sprintf("%d", k))) { absent_stages = absent_stages.sprintf(" %d:%d", i, k) } }
}
panelOf(pair) = int(pair[1 : strstrt(pair, ':') - 1]); stageOf(pair) = int(pair[strstrt(pair, ':') + 1 : *])
absent_colour = 0xe4e4e4

columns = n <= 3 ? n : n == 4 ? 2 : n <= 6 ? 3 : 4
lines = (n + columns - 1) / columns
width = columns == 1 ? 560 : columns == 2 ? 860 : 1080
# Room for the longest label of the levels, and for the name of the axis left of it.
longest = 0
do for [k = 1 : words(levels)] { length = strlen(levelText(real(word(levels, k)))); longest = length > longest ? length : longest }
margin_left = (44.0 + 7.5 * longest) / width; margin_right = columns == 1 ? 0.16 : 0.09
margin_top = lines == 1 ? 0.1 : 0.06
height = 110 + 42 * lines + lines * (words(levels) < 9 ? 200 : 20 * words(levels))
legend_height = 34.0 / height
margin_bottom = legend_height + 52.0 / height
gap_x = 0.02; gap_y = 40.0 / height
do for [format in formats] {
  eval open(format, width, height)
  set multiplot
  set palette defined (0 '#7f0d1d', 0.06 '#c4452f', 0.12 '#f0a35e', 0.25 '#fbe3a6', 0.45 '#b9dcc4', 0.7 '#4a9fb5', 1 '#123c69')
  set cbrange [0 : 16]; set cbtics 4 scale 0
  set xrange [0.5 : words(stages) + 0.5]; set yrange [0.5 : words(levels) + 0.5]
  set border 15 lc rgb 0x999999; unset grid; set tics scale 0 textcolor rgb ink
  do for [i = 1 : n] {
    eval panel(i, columns, lines)
    eval stage_tics." nomirror scale 0 textcolor rgb ink"
    eval level_tics." nomirror scale 0 textcolor rgb ink"
    if ((i - 1) % columns > 0) { unset ytics }
    if (i <= n - columns) { unset xtics }
    set title panelTitle(i) offset 0,-0.6 noenhanced
    set xlabel when(i > n - columns, 'stages s') offset 0,0.4
    set ylabel when((i - 1) % columns == 0, y_label) offset 0,0 textcolor rgb ink
    unset key
    unset object
    do for [pair in absent_stages] {
      if (panelOf(pair) == i) { set object rectangle from stageOf(pair) - 0.5, 0.5 to stageOf(pair) + 0.5, words(levels) + 0.5 \
        behind fs solid noborder fc rgb absent_colour }
    }
    if (i == n) { set colorbox user origin 1 - margin_right + 0.015, margin_bottom size 0.015, 1 - margin_top - margin_bottom
      set cblabel quantity_label textcolor rgb ink } else { unset colorbox }
    plot file using (inPanel(i) && good(0) ? stageNumber(0) : outside):(levelNumber(0)):(0.5):(0.5):(digits(0)) \
           with boxxyerror fs solid noborder palette notitle, \
         for [k = 1 : words(seen)] file using (inPanel(i) && is("outcome", word(seen, k)) ? stageNumber(0) : outside):(levelNumber(0)) \
           with points pt causePoint(position(causes, word(seen, k))) ps 0.9 lw 2 \
           lc rgb (word(seen, k) eq 'refused' ? 0x999999 : failure_colour) notitle
  }
  unset object
  if (words(seen) + words(absent_stages) > 0) {
    eval legend(legend_height)
    unset colorbox
    plot 2 notitle, for [k = 1 : words(absent_stages) > 0] keyentry with points pt 5 ps 1.4 lc rgb absent_colour title (panel_by eq 'family' ? 'no such method' : 'no run'), \
      for [k = 1 : words(seen)] keyentry with points pt causePoint(position(causes, word(seen, k))) ps 0.9 lw 2 \
      lc rgb (word(seen, k) eq 'refused' ? 0x999999 : failure_colour) title causeTitle(position(causes, word(seen, k)))
  }
  unset multiplot
  unset output
  eval framed
  set xrange [*:*]; set yrange [*:*]
}
