# All scenes at a glance: the first panel of each scene's solution, each curve over its own range, without numbers.
#   gnuplot -e "data='results/scenes'; out='gallery'" scenes/scene_gallery.gp
# Reads the tables <scene>.<method>.csv of the folder, but not those with other settings. Options: method, log_time and
# log_values (the scenes that are drawn over a logarithmic time, from the first step on, and with logarithmic values).
load system('dirname "'.ARG0.'"')."/../style.gp"
if (!exists("method")) method = 'radau_iia_5'
if (!exists("log_time")) log_time = ''
if (!exists("log_values")) log_values = ''
least_value = 1e-24  # on a logarithmic axis
most_points = 150  # of a curve: more are not seen in a small panel

path(name) = data.'/'.name.'.'.method.'.csv'
isPlain(name) = fromHead(path(name), 'study') eq 'trajectory of '.name
plain(list, k) = k == 0 ? "" : plain(list, k - 1).(isPlain(word(list, k)) ? ' '.word(list, k) : '')
found = system("cd '".data."' 2>/dev/null && ls | sed -n 's/\\.".method."\\.csv$//p'")
files = plain(found, words(found))
n = words(files)
if (n == 0) { eval absence("trajectories in ".data) }
between(text, first) = (cut = text[first : strlen(text)], strstrt(cut, '|') ? cut[1 : strstrt(cut, '|') - 1] : cut)
contentOf(p) = between(p, strstrt(p, '|') + 1)

columns = 6
lines = (n + columns - 1) / columns
top = exists("quick") ? 40 : 24  # the mark of quick runs stands above the titles
height = top + 16.0 + 110 * lines
margin_left = 0.015; margin_right = 0.015; margin_top = top / height; margin_bottom = 8 / height
gap_x = 0.02; gap_y = 30 / height
do for [format in formats] {
  eval open(format, 960, height)
  set multiplot
  unset key; unset grid; unset xlabel; unset ylabel
  do for [i = 1 : n] {
    name = word(files, i)
    file = path(name)
    list = contentOf(word(fromHead(file, 'panels'), 1))
    orbit = strstrt(list, ':') > 0
    with_log = position(log_time, name) && !orbit
    stats file using 1 name "W" nooutput
    valueOf(y) = position(log_values, name) ? (y > least_value ? log10(y) : NaN) : y
    every_row = W_records > most_points ? W_records / most_points : 1
    eval panel(i, columns, lines)
    set border 3 lw 0.6 lc rgb 0x999999
    unset xtics; unset ytics; unset logscale
    set xrange [*:*] noextend; set yrange [*:*]
    set size noratio
    if (orbit) { set xrange [*:*] extend; set size ratio -1 }
    if (with_log) { set logscale x }
    shown = words(list) < 4 ? words(list) : 4
    array low[shown]; array high[shown]
    do for [k = 1 : shown] {  # kept as they are: paths in a plane with equal scales
      stats file using (valueOf(column(of(word(list, k))))) name "V" nooutput
      low[k] = orbit ? 0 : V_min; high[k] = orbit ? 1 : V_max > V_min ? V_max : V_min + 1
    }
    if (!orbit) { set yrange [-0.04:1.04] }
    set title name offset 0,-0.9 font ',10' noenhanced
    plot for [k = 1 : shown] file every every_row \
      using (with_log ? positive(column('t')) : column(over(word(list, k)))):((valueOf(column(of(word(list, k)))) - low[k]) / (high[k] - low[k])) \
      with lines lw 1.2 dt seriesDash(k) lc rgb seriesColour(k) notitle
    unset label 9999
  }
  unset multiplot
  unset output
}
