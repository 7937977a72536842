# How runs end: for each collection a panel, for each solver a row, for each tolerance a bar with the shares of right
# runs, honest failures, successes with an error above 1000 tolerances, and runs that cannot be judged. A number in a
# bar counts those above; the number beside a row says of how many runs each of its bars is made.
#   gnuplot -e "data='results/robustness'; out='robustness'" robustness.gp
# Reads robustness.csv. Options: collections (panels in this order), integrators (rows in this order).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("collections")) collections = 'ivp multibody switching probes'
if (!exists("integrators")) integrators = ''
file = data.'/robustness.csv'
parts = "right failed wrong unjudged"
part_titles = "'right' 'honest failure' 'success, but error above 1000 tolerances (number: how many)' 'not judged'"
single(d) = strcol("tolerance") ne 'all' && position(collections, strcol("collection"))
undefine N_*
stats file using (single(0) ? (collect(strcol("integrator")), 1) : NaN) name "N" nooutput
if (!exists("N_records") || N_records == 0) { eval absence(collections." in ".file) }
solvers = ""
do for [w in (withGiven(integrators, collected))] { solvers = solvers.(position(collected, w) ? " ".w : "") }
collected = ""
stats file using (single(0) ? (collect(sprintf("%.6f", log10(column("tolerance")))), 1) : NaN) name "N" nooutput
levels = sorted(collected)
many = words(levels)
collected = ""
stats file using (single(0) ? (collect(strcol("collection")), 1) : NaN) name "N" nooutput
shown = ""
do for [w in collections] { shown = shown.(position(collected, w) ? " ".w : "") }
panels = words(shown)

# The largest tolerance is on the left.
place(d) = sum [k = 1 : many] (abs(real(word(levels, k)) - log10(column("tolerance"))) < 1e-5 ? many + 1 - k : 0)
share(k) = column(word(parts, k)) / column("runs")
below(k) = k == 1 ? 0 : sum [j = 1 : k - 1] share(j)
least = 0.03   # a share too small to be visible is drawn with this width
upTo(k) = below(k) + (k == 3 && column("wrong") > 0 && share(k) < least ? least : share(k))
line(i) = single(0) && strcol("collection") eq word(shown, i) ? position(solvers, strcol("integrator")) : 0
width = 0.84
left(i, x) = line(i) > 0 ? place(0) - width / 2 + width * x : outside
number_place = many + 0.75
# The number of wrong successes stands in their part of the bar, or where that is too narrow beside it.
isWide(d) = share(3) >= 0.2
numberPlace(d) = isWide(0) ? below(3) + share(3) / 2 : below(3) > 0.2 ? below(3) - 0.12 : upTo(3) + 0.12
numberColour(d) = isWide(0) ? 0xFFFFFF : judgedColour(3)
# A row's number of runs is that of its largest tolerance.
isFirst(i) = line(i) > 0 && place(0) == 1
levelText(x) = sprintf("10^{%d}", floor(x + 0.5))
tolerance_tics = "set xtics ("; do for [k = 1 : many] {
  tolerance_tics = tolerance_tics.sprintf("%s'%s' %d", k == 1 ? '' : ', ', levelText(real(word(levels, k))), many + 1 - k) }
tolerance_tics = tolerance_tics.sprintf(", 'runs' %g) nomirror scale 0 textcolor rgb ink offset 0,0.3", number_place)
solver_tics = "set ytics ("; do for [k = 1 : words(solvers)] {
  solver_tics = solver_tics.sprintf("%s'%s' %d", k == 1 ? '' : ', ', word(solvers, k), k) }
solver_tics = solver_tics.") nomirror scale 0 noenhanced textcolor rgb ink"

columns = panels == 1 ? 1 : 2
lines = (panels + columns - 1) / columns
legend_rows = columns == 1 ? words(parts) : 2
legend_height = 12.0 + 18 * legend_rows
height = 68 + legend_height + lines * (60 + 22 * words(solvers))
longest = 0   # letters of the longest name, about 6.6 px each
do for [w in solvers] { longest = longest > strlen(w) ? longest : strlen(w) }
margin_left = columns == 1 ? (20 + 6.6 * longest) / 640 : 0.19; margin_right = 0.02; margin_top = 30.0 / height; margin_bottom = (52.0 + legend_height) / height
gap_x = 0.03; gap_y = 50.0 / height
do for [format in formats] {
  eval open(format, columns == 1 ? 640 : 1080, height)
  set multiplot
  unset key; unset grid; set border 0
  set xrange [0.5 : many + 1]; set yrange [words(solvers) + 0.5 : 0.5]
  do for [i = 1 : panels] {
    eval panel(i, columns, lines)
    eval tolerance_tics
    if ((i - 1) % columns == 0) { eval solver_tics } else { unset ytics }
    set title (word(shown, i) eq 'all' ? 'all scenes' : word(shown, i)) offset 0,-0.6 noenhanced
    set xlabel when(i > panels - columns, 'tolerance') offset 0,0.3
    plot for [k = 1 : 4] file using (left(i, below(k))):(line(i)):(left(i, below(k))):(left(i, upTo(k))):(line(i) - 0.38):(line(i) + 0.38) \
        with boxxyerror fs solid noborder lc rgb judgedColour(k) notitle, \
      file using (column("wrong") > 0 ? left(i, numberPlace(0)) : outside):(line(i)):(sprintf("%d", column("wrong"))):(numberColour(0)) \
        with labels textcolor rgb variable font ',11' notitle, \
      file using (isFirst(i) ? number_place : outside):(line(i)):(sprintf("%d", column("runs"))) \
        with labels textcolor rgb ink font ',11' notitle
  }
  eval legend(legend_height / height)
  set key maxrows legend_rows
  plot 2 notitle, for [k = 1 : 4] keyentry with boxes fs solid noborder lc rgb judgedColour(k) title word(part_titles, k)
  unset multiplot
  unset output
  eval framed
  set xrange [*:*]; set yrange [*:*]
}
