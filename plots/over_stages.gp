# Properties of the tableaus against the number of stages, one curve per family, one panel per quantity.
#   gnuplot -e "data='results/tableaus'; out='conditions'; quantities='condition_A condition_eigenvectors'" over_stages.gp
# Reads tableaus.csv. Options: quantities (columns; their magnitudes are drawn), titles (quoted words, one per quantity).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("quantities")) quantities = 'condition_A condition_eigenvectors'
if (!exists("titles")) titles = quantities
file = data.'/tableaus.csv'
n = words(quantities)
stats file using (collect(strcol("family")), column("stages")) name "S" nooutput
if (!exists("S_records") || S_records == 0) { eval absence(file) }
shown = ''
do for [f in families_known] { if (position(collected, f)) { shown = shown.' '.f } }
sized(f, q) = is("family", f) && abs(column(q)) < 1e300 ? positive(abs(column(q))) : NaN

margin_left = n == 1 ? 0.15 : 0.085; margin_right = 0.02; margin_top = 0.08; margin_bottom = 0.25; gap_x = 0.09
do for [format in formats] {
  eval open(format, n == 1 ? 560 : 540 * n, 440)
  set multiplot
  unset key
  eval decades("y")
  set xrange [0.5 : S_max + 0.5]; set yrange [*:*]; set xtics 2
  do for [i = 1 : n] {
    q = word(quantities, i)
    eval panel(i, n, 1)
    set title word(titles, i) offset 0,-0.5
    set xlabel 'stages s' offset 0,0.4
    plot for [f in shown] file using (column("stages")):(sized(f, q)) with linespoints lw 1.3 dt familyDash(f) \
      pt familyPoint(f) ps 0.7 lc rgb familyColour(f) notitle
  }
  eval legend(0.13)
  plot 2 notitle, for [f in shown] keyentry with linespoints lw 1.3 dt familyDash(f) pt familyPoint(f) ps 0.7 \
    lc rgb familyColour(f) title familyTitle(f)
  unset multiplot
  unset output
  eval framed
  unset logscale; set xrange [*:*]
}
