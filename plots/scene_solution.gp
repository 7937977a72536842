# A scene's solution over time, one panel per kind of quantity.
#   gnuplot -e "data='results/scenes'; out='solution'; scene='SCENE'" scene_solution.gp
# Reads <scene>.<method>.csv: t and the components by name. Options: scene, method, file_name, panels, time_label, log_time
# (1: a logarithmic time axis, from the first step on), log_values (> 0: logarithmic values, from this one on).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("method")) method = 'radau_iia_5'
if (!exists("log_time")) log_time = 0
if (!exists("log_values")) log_values = 0
if (!exists("file_name")) file_name = scene.'.'.method
file = data.'/'.file_name.'.csv'

# A panel is "label|columns|factor", with a factor for conversion to another unit; a column a:b draws b over a with
# equal scales (an orbit). The program writes the scene's panels and the label of the time axis into the table's head.
if (!exists("panels")) panels = fromHead(file, 'panels')
if (!exists("time_label")) time_label = fromHead(file, 'time')
panels_note = fromHead(file, 'panels_note')
if (time_label eq '') time_label = 't'

# The table's own column names.
unset datafile columnheaders
stats file using 1 name "W" nooutput
header = ""
if (exists("W_columns")) {
  stats file using ($0 == 0 ? sum [c = 1 : W_columns] strlen(header = header.' '.strcol(c)) : 0) nooutput
}
first_step = 1e300
if (exists("W_columns")) { stats file using ($1 > 0 && $1 < first_step ? (first_step = $1) : 0) nooutput }
set datafile columnheaders
timeOrBase(x, orbit) = log_time && !orbit ? positive(x) : x
valueOf(y, orbit) = log_values > 0 && !orbit ? (y >= log_values ? y : NaN) : y
# The step of ticks for two to five of them along an axis.
tickFloor(side) = 10**floor(log10(side / 2))
tickStep(side) = tickFloor(side) * (side / tickFloor(side) < 5 ? 1 : side / tickFloor(side) < 10 ? 2 : 5)

# Switches: dashed lines over the whole height; where there are many, short ones at the foot of the panel.
jumps = ""; kinds = ""
if (position(header, 'switches')) {
  stats file using (strcol('switches') eq '' || strcol('switches') eq '0' ? 0 \
    : (strlen(jumps = jumps.sprintf(' %.8g', column('t'))), strstrt(kinds.',', ', '.strcol('switches').',') ? 0 : strlen(kinds = kinds.', '.strcol('switches')))) nooutput
}
many_jumps = words(jumps) > 16
jump_height = many_jumps ? 0.04 : 1; jump_dash = many_jumps ? 1 : 2; jump_width = many_jumps ? 0.5 : 0.8
jump_name = many_jumps ? 'short lines: ' : 'dashed lines: '
jump_note = jump_name.(strlen(kinds) > 60 ? 'switches' : kinds[3 : *])

if (panels eq '') {  # a table of an older program
  do for [c in header] { if (!position("t h error newton_iterations switches", c) && words(panels) < 8) { panels = panels.sprintf(' "%s|%s"', c, c) } }
}
there(c) = position(header, over(c)) && position(header, of(c))
label(p) = p[1 : strstrt(p, '|') - 1]
behind(p) = p[strstrt(p, '|') + 1 : strlen(p)]
unit(p) = strstrt(label(p), ' in ') ? label(p)[strstrt(label(p), ' in ') : *] : ''
content(p) = strstrt(behind(p), '|') ? label(behind(p)) : behind(p)
factor(p) = strstrt(behind(p), '|') ? behind(behind(p)) : '1'
# Text of a table's head is evaluated only if it consists of the characters of a number.
strange(s) = strlen(s) == 0 ? 1 : sum [k = 1 : strlen(s)] (strstrt('0123456789.eE+-', s[k : k]) == 0)
number(s) = strange(s) ? 'NaN' : s
only(list, k) = k == 0 ? "" : only(list, k - 1).when(there(word(list, k)), ' '.word(list, k))
shown(p) = only(content(p), words(content(p)))
kept = ""
do for [i = 1 : words(panels)] {
  p = word(panels, i)
  if (words(shown(p)) > 0) { kept = kept.sprintf(' "%s|%s|%s"', label(p), shown(p), factor(p)) }
}
n = words(kept)

if (n == 0) { eval absence(scene." in ".file) }

columns = n <= 3 ? n : 2
lines = (n + columns - 1) / columns
width = n <= 1 ? 560 : n == 3 ? 1080 : 820
margin_right = n <= 1 ? 0.04 : 0.03
margin_left = n <= 1 ? 0.17 : n == 3 ? 0.09 : 0.12
margin_bottom = lines == 1 ? 0.15 : lines > 2 ? 0.06 : 0.09; margin_top = words(jumps) ? (lines == 1 ? 0.17 : lines == 2 ? 0.1 : 0.08) : lines > 1 ? 0.06 : 0.1
if (lines == 1 && (sum [i = 1 : n] words(content(word(kept, i))) > 3)) { margin_top = margin_top + 0.06 }  # legends of two rows
gap_x = n == 3 ? 0.085 : 0.12; gap_y = lines > 2 ? 0.24 / lines : 0.12
do for [format in formats] {
  eval open(format, width, 60 + 270 * lines)
  set multiplot
  if (words(jumps)) { set label 99 jump_note at screen 0.985, screen 1 right offset 0,-0.6 font ',10' textcolor rgb ink noenhanced }
  if (panels_note ne '') { set label 98 panels_note at screen 0.015, screen 1 left offset exists("quick") ? 20 : 0,-0.6 font ',10' textcolor rgb ink noenhanced }
  do for [i = 1 : n] {
    p = word(kept, i)
    list = content(p)
    eval 'scale = '.number(factor(p))
    eval panel(i, columns, lines)
    set ylabel label(p) offset 0,0 noenhanced
    orbit = strstrt(list, ':') > 0
    set xlabel when(i > n - columns || orbit, orbit ? over(word(list, 1)).unit(p) : time_label) offset 0,0.3 noenhanced
    unset key
    if (words(list) > 1) { set key at graph 0, graph 1.02 left bottom horizontal Left reverse samplen 1.2 maxrows 1 font ',10' }
    set xrange [*:*] noextend
    if (log_time && !orbit) { set xrange [first_step : W_max] }
    set yrange [*:*]
    set size noratio; set xtics autofreq
    if (log_time && !orbit) { eval decades("x"); set xtics autofreq; if (W_max / first_step > 1e8) { set xtics 1e4 } }
    set ytics autofreq
    if (log_values > 0 && !orbit) { eval decades("y"); set ytics autofreq }
    if (W_max < 0.01 && !log_time && !orbit) { set xtics tickStep(W_max) }  # long labels
    if (orbit) {  # equal scales: ticks of one step
      stats file using (scale * column(over(word(list, 1)))):(scale * column(of(word(list, 1)))) name "O" nooutput
      side = (O_max_x - O_min_x > O_max_y - O_min_y ? O_max_x - O_min_x : O_max_y - O_min_y) + 1e-300
      set xrange [*:*] extend; set size ratio -1; set xtics tickStep(side); set ytics tickStep(side)
    }
    unset arrow
    if (!orbit) {
      do for [j = 1 : words(jumps)] { set arrow from first real(word(jumps, j)), graph 0 to first real(word(jumps, j)), graph jump_height \
        nohead dt jump_dash lw jump_width lc rgb 0xa0a0a0 back }
    }
    plot for [k = 1 : words(list)] file using (timeOrBase(column(over(word(list, k))), orbit)):(valueOf(scale * column(of(word(list, k))), orbit)) \
      with lines lw 1.4 dt seriesDash(k) lc rgb seriesColour(k) title of(word(list, k))
    unset label 99; unset label 98; unset logscale; set format '%g'
  }
  unset multiplot
  unset output
}
