# Reliability of `success`: stacked bars with the shares of right runs, honest failures, wrong successes and runs set
# aside, and the number of wrong ones beside each bar.
#   gnuplot -e "data='results/audit'; out='audit'" audit.gp
# Reads audit_summary.csv.
load system('dirname "'.ARG0.'"')."/style.gp"
file = data.'/audit_summary.csv'
parts = "right failed wrong set_aside"
part_titles = "'right' 'honest failure' 'wrong success' 'set aside'"
share(k) = k == 4 ? (column("ill_conditioned") + column("unjudged")) / column("runs") \
                  : column(word(parts, k)) / column("runs")
below(k) = k == 1 ? 0 : sum [j = 1 : k - 1] share(j)
# A share too small to be visible is drawn with the width of a line.
least = 0.006
upTo(k) = below(k) + (k == 3 && column("wrong") > 0 && share(k) < least ? least : share(k))

# Panels: the grouping, its title, and its position (fractions of the figure).
groupings = "scene configuration treatment family"
titles = "'by scene' 'by configuration' 'by treatment of switches' 'by family of methods'"
lefts = "0.035 0.515 0.515 0.515"
undefine N_*
stats file using (is("by", 'all') ? column("runs") : NaN) name "N" nooutput
if (!exists("N_sum") || N_sum == 0) { eval absence(file) }
array n[4]
do for [g = 1 : 4] {
  stats file using (is("by", word(groupings, g)) ? 1 : NaN) name "G" nooutput
  n[g] = int(G_records)
}
row_height = 20.0; head = 34.0; foot = 62.0; between = 56.0
right_rows = n[2] + n[3] + n[4]
inner = n[1] * row_height > right_rows * row_height + 2 * between ? n[1] * row_height : right_rows * row_height + 2 * between
height = head + inner + foot
top(g) = g == 1 ? 1 - head / height : 1 - (head + (g > 2 ? n[2] * row_height + between : 0) + (g > 3 ? n[3] * row_height + between : 0)) / height
next(d) = (y = y + 1, y)
at(g) = is("by", word(groupings, g)) ? next(0) : NaN
size(d) = sprintf("n = %d", column("runs"))
only(g, text) = is("by", word(groupings, g)) ? text : ''
number(d) = sprintf("%d", column("wrong"))

do for [format in formats] {
  eval open(format, 1080, height)
  set multiplot
  unset key; unset grid; set border 0; set tics scale 0
  set xrange [-1.1 : 1.2]
  set xtics ('0' 0, '50 %%' 0.5, '100 %%' 1) nomirror textcolor rgb ink offset 0,0.4
  unset ytics
  do for [g = 1 : 4] {
    left = real(word(lefts, g))
    set lmargin at screen left; set rmargin at screen left + 0.455
    set tmargin at screen top(g); set bmargin at screen top(g) - n[g] * row_height / height
    set yrange [n[g] + 0.5 : 0.5]
    set label 1 word(titles, g) at first 0.5, graph 1 offset 0,0.7 center textcolor rgb ink
    set label 2 'wrong' at first 1.03, graph 1 offset 0,0.7 left textcolor rgb judgedColour(3)
    plot for [k = 1 : 4] y = 0, file using (at(g) > 0 ? below(k) : NaN):(y):(below(k)):(upTo(k)):(y - 0.38):(y + 0.38) \
        with boxxyerror fs solid noborder lc rgb judgedColour(k) notitle, \
      y = 0, file using (at(g) > 0 ? below(3) : NaN):(y):(below(3)):(upTo(3)):(y - 0.38):(y + 0.38) \
        with boxxyerror fs solid noborder lc rgb judgedColour(3) notitle, \
      y = 0, file using (at(g) > 0 ? -0.4 : NaN):(y):(only(g, strcol("group"))) \
        with labels right noenhanced textcolor rgb ink notitle, \
      y = 0, file using (at(g) > 0 ? -0.03 : NaN):(y):(only(g, size(0))) \
        with labels right textcolor rgb 0x777777 font ',11' notitle, \
      y = 0, file using (at(g) > 0 ? 1.03 : NaN):(y):(only(g, column("wrong") > 0 ? number(0) : '')) \
        with labels left textcolor rgb judgedColour(3) notitle, \
      y = 0, file using (at(g) > 0 ? 1.03 : NaN):(y):(only(g, column("wrong") > 0 ? '' : '0')) \
        with labels left textcolor rgb 0x777777 notitle
    unset label
  }
  eval legend(0.05)
  plot 2 notitle, for [k = 1 : 4] keyentry with boxes fs solid noborder lc rgb judgedColour(k) title word(part_titles, k)
  unset multiplot
  unset output
  eval framed
  set xrange [*:*]; set yrange [*:*]
}
