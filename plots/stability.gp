# Stability regions |R(z)| <= 1 and order stars |R(z)| > |e^z|, one panel per family, or per view of some methods.
#   gnuplot -e "data='results/tableaus'; out='regions'; families='gauss radau_iia'; stages='1 2 3'" stability.gp
#   gnuplot -e "table='mine.csv'; out='mine'; views='region star'" stability.gp
# Reads stability.csv, the zeros and poles of R(z) = prod (1 - z / zero) / prod (1 - z / pole); `table` names another
# file of this form. Options: families and stages (panels and curves), or views (panels: region, star; all methods of
# the table), view (region or star, with families), columns, extent (of the window, from 0).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("table")) table = data.'/stability.csv'
if (!exists("families")) families = ''
if (!exists("stages")) stages = '1 2 3 4 5'
if (!exists("view")) view = 'region'
if (!exists("views")) views = 'region star'
if (!exists("columns")) columns = 4
if (!exists("extent")) extent = 0

stats table using (1) name "N" nooutput
if (!exists("N_records") || N_records == 0) { eval absence(table) }
rows = int(N_records)
array Q[rows]; array W[rows]; array M[rows]
collected = ""
stats table using (row = int($0) + 1, collect(strcol("method")), M[row] = strcol("method"), \
  W[row] = strcol("root") eq 'zero' ? 1 : -1, Q[row] = column("re") + {0,1} * column("im"), abs(Q[row])) name "Root" nooutput
all = collected
set datafile separator whitespace; unset datafile columnheaders   # for the blocks below
first(m) = (found = 0, sum [i = 1:rows] (found == 0 && M[i] eq m ? (found = i, 0) : 0), found)
last(m) = (found = 0, sum [i = 1:rows] (M[i] eq m ? (found = i, 0) : 0), found)

# log|R(z)| as a sum over the factors of R, which avoids cancellation.
from = 1; to = 1
logR(z) = sum [i = from:to] W[i] * log(abs(1 - z / Q[i]) + 1e-300)
stagesOf(m) = int(system("echo '".m."' | sed 's/.*_//'"))
inPanel(p) = families eq '' ? all : listed(word(families, p))
listed(f) = (names = '', sum [i = 1 : words(stages)] (candidate = f.'_'.word(stages, i), \
  position(all, candidate) ? (names = names.' '.candidate, 0) : 0), names)
viewOf(p) = families eq '' ? word(views, p) : view
level(p, x, y) = logR(x + {0,1} * y) - (viewOf(p) eq 'star' ? x : 0)
panels = families eq '' ? words(views) : words(families)
columns = panels < columns ? panels : columns
lines = (panels + columns - 1) / columns
if (extent == 0) { extent = 1.6 * (Root_max > 2 ? Root_max : 2) }
colourOf(m) = families eq '' ? curveColour(position(all, m)) : stageColour(stagesOf(m))
baseName(m) = m[strstrt(m, '/') ? strlen(system("dirname '".m."'")) + 2 : 1 : strlen(m)]
curveTitle(m) = families eq '' ? baseName(m) : 's = '.sprintf("%d", stagesOf(m))
panelTitle(p) = families ne '' ? familyTitle(word(families, p)) : viewOf(p) eq 'star' ? 'order star: |R| > |e^z| shaded' : 'stability: |R| ≤ 1 shaded'

# For each method the upper half plane and its contour; for the shading, the number of methods that contain each
# point.
width = families eq '' ? 161 : 101; rise = (width + 1) / 2
array Count[width * rise]
set xrange [-extent : extent]; set yrange [0 : extent]
do for [p = 1 : panels] {
  names = inPanel(p)
  do for [i = 1 : width * rise] { Count[i] = 0 }
  do for [k = 1 : words(names)] {
    from = first(word(names, k)); to = last(word(names, k))
    set samples width, width; set isosamples width, rise
    set table $Level
    splot level(p, x, y)
    unset table
    stats $Level using (Count[int($0) + 1] = Count[int($0) + 1] + (viewOf(p) eq 'star' ? $3 > 0 : $3 <= 1e-9), 0) nooutput
    set contour base; set cntrparam levels discrete 0; unset surface
    eval sprintf("set table $Contour_%d_%d", p, k)
    splot $Level using 1:2:3
    unset table
    unset contour; set surface
  }
  eval sprintf("set table $Share_%d", p)
  splot $Level using 1:2:(Count[int($0) + 1] / real(words(names)))
  unset table
}

margin_left = columns == 1 ? 0.14 : 0.062; margin_right = 0.015
height = 90 + (columns == 1 ? 460 : 1080 / columns - 20) * lines
margin_top = 34.0 / height; margin_bottom = 96.0 / height; gap_x = 0.03; gap_y = 62.0 / height
legend_names = families eq '' ? all : listed(word(families, 1))
starred = words(legend_names) == 1 && (families eq '' ? position(views, 'star') > 0 : view eq 'star')
legend_height = 36.0 / height
marks = ", for [i = first(word(names, 1)) : last(word(names, 1))] '+' using (real(Q[i])):(imag(Q[i])) every ::0::0 " \
        ."with points pt (W[i] > 0 ? 6 : 2) ps 0.8 lc rgb ink notitle"
set palette defined (0 '#FFFFFF', 1 '#BCD5EA'); set cbrange [0 : 1]; unset colorbox
do for [format in formats] {
  eval open(format, columns == 1 ? 520 : columns == 2 ? 960 : 1080, columns == 2 ? height - 60 : height)
  set multiplot
  unset key; unset grid; set border 15 lw 1 lc rgb 0x666666; set tics scale 0.6 out; set mxtics 1; set mytics 1
  set size ratio -1
  do for [p = 1 : panels] {
    names = inPanel(p)
    eval panel(p, columns, lines)
    set xrange [-extent : extent]; set yrange [-extent : extent]; set xtics nomirror; set ytics nomirror
    if (families ne '') { set xtics extent / 2; set ytics extent / 2 }
    set title panelTitle(p) offset 0,-0.6
    set xlabel when(p > panels - columns, 'Re z') offset 0,0.6
    set ylabel when(p % columns == 1 || columns == 1, 'Im z') offset 1.2,0
    set arrow 1 from 0, graph 0 to 0, graph 1 nohead lw 0.7 lc rgb 0x999999 front
    set arrow 2 from graph 0, first 0 to graph 1, first 0 nohead lw 0.7 lc rgb 0x999999 front
    shown = viewOf(p) eq 'star' && words(names) == 1
    curves = ''
    do for [k = 1 : words(names)] { curves = curves.sprintf( \
      ", for [side in '1 -1'] $Contour_%d_%d using 1:($2 * side) with lines lw 1.5 lc rgb %d notitle", p, k, \
      colourOf(word(names, k))) }
    eval sprintf("plot for [side in '1 -1'] $Share_%d using 1:($2 * side):3 with image notitle", p).curves.(shown ? marks : '')
  }
  if (legend_height > 0) {
    unset arrow; set size noratio
    eval legend(legend_height)
    plot 2 notitle, for [m in legend_names] keyentry with lines lw 2 lc rgb colourOf(m) title curveTitle(m), \
      for [k = 1 : 2 * starred] keyentry with points pt (k == 1 ? 6 : 2) lc rgb ink title word("zeros poles", k)
  }
  unset arrow
  unset multiplot
  unset output
}
