# The style of all figures: fonts, colours, marks, panels, and the selection of rows by column name. Each script
# begins with  load here."/style.gp"  and draws everything once per output format.

set encoding utf8
set datafile separator ','
set datafile commentschars '#'
set datafile columnheaders
set datafile missing NaN        # a row that a filter sets to NaN does not break a line

# --- Output: out.svg and out.png of the same size in points, the PNG with twice the pixels.
if (!exists("data")) data = 'results'
if (!exists("out")) out = 'figure'
formats = "svg png"
open(format, width, height) = sprintf( \
  format eq "svg" ? "set terminal svg size %d,%d font 'sans-serif,12' enhanced background 'white'" \
                  : "set terminal pngcairo size 2*%d,2*%d font 'sans-serif,12' fontscale 1.5 " \
                    ."linewidth 2 pointscale 2 enhanced background 'white'", width, height) \
  . sprintf("; set output '%s.%s'", out, format) . quick_mark

# `quick=1` says that the runs are those of --quick: the figure bears a mark. Panels after the first do not repeat it.
quick_mark = exists("quick") ? "; set label 9999 'quick run: no verdict' at screen 0.004, screen 0.984 left " \
  ."font ',10' textcolor rgb 0x8a5a00 noenhanced front" : ""
once(k) = k > 1 ? "; unset label 9999" : ""

# --- Axes, grid. `eval bare` removes everything but the key, for a legend below several panels.
ink = 0x333333
framed = "set border 3 lw 1 lc rgb 0x666666; set tics scale 0.6 textcolor rgb ink; " \
         ."set xtics nomirror; set ytics nomirror; " \
         ."set grid lw 1 lc rgb 0xd8d8d8 dt 1"
bare = "unset border; unset tics; unset grid; set title ''; set xlabel ''; set ylabel ''"
eval framed
set xlabel textcolor rgb ink
set ylabel textcolor rgb ink
set title textcolor rgb ink font ',12'
set key samplen 2.2 spacing 1.05 textcolor rgb ink font ',11' noenhanced
set errorbars small
set style textbox opaque border lc rgb 0xcccccc

decades(axis) = sprintf("set logscale %s; set format %s '10^{%%L}'; set m%stics 1", axis, axis, axis)

# A logarithmic axis of less than two decades has too few labels at the decades alone; it gets labels at 1, 2, 5, and if
# its numbers are almost equal at more of them.
digitLabel(digit, e) = digit eq '1' ? sprintf("10^{%d}", e) : sprintf("%s·10^{%d}", digit, e)
digitTics(digits, axis, low, high) = (tics = '', sum [e = int(floor(log10(low))) : int(ceil(log10(high)))] sum [k = 1 : words(digits)] \
  (strlen(tics = tics.sprintf("%s'%s' %g", strlen(tics) ? ', ' : '', digitLabel(word(digits, k), e), real(word(digits, k)) * 10.0 ** e))), \
  sprintf("set %stics (%s) nomirror", axis, tics))
logTics(axis, low, high) = high / low < 2.5 ? digitTics('1 1.5 2 3 4 5 6 8', axis, low, high) \
  : high / low < 99 ? digitTics('1 2 5', axis, low, high) : sprintf("set %stics autofreq nomirror", axis)

# Labels of a horizontal axis of so many decades and points: at every decade, every second, fourth, ..., so that they stay
# apart. An axis of few decades keeps gnuplot's.
label_points = 46.0
decadeStep(decades, points) = decades * label_points <= points ? 1 : decades * label_points <= 2 * points ? 2 \
  : 4 * ceil(decades * label_points / points / 4)
decadeTics(decades, points) = decades < 5 ? "set xtics autofreq nomirror" : (step = decadeStep(decades, points), tics = '', \
  sum [e = -324 / step : 308 / step] (strlen(tics = tics.sprintf("%s'10^{%d}' 1e%d", strlen(tics) ? ', ' : '', e * step, e * step))), \
  sprintf("set xtics (%s) nomirror", tics))

# --- Families: each has its colour (Okabe and Ito, distinguishable by colour-blind readers), mark and dash.
families_known = "gauss radau_ia radau_iia lobatto_iiia lobatto_iiib lobatto_iiic lobatto_iiics lobatto_iiid"
family_titles  = "'Gauss' 'Radau IA' 'Radau IIA' 'Lobatto IIIA' 'Lobatto IIIB' 'Lobatto IIIC' 'Lobatto IIIC*' 'Lobatto IIID'"
family_colours = "0x0072B2 0xE69F00 0xD55E00 0x009E73 0x56B4E9 0xCC79A7 0x8C6D1F 0x555555"
family_points  = "7 4 5 9 8 11 10 13"
position(list, item) = sum [i = 1:words(list)] (word(list, i) eq item ? i : 0)
known(f) = position(families_known, f)
familyTitle(f) = known(f) ? word(family_titles, known(f)) : f
familyColour(f) = known(f) ? int(word(family_colours, known(f))) : 0x000000
familyPoint(f) = known(f) ? int(word(family_points, known(f))) : 6
familyDash(f) = known(f) % 2 + 1

# --- Curves of one panel, as of solvers: each its own colour and mark.
curve_colours = "0x0072B2 0xD55E00 0x009E73 0xCC79A7 0xE69F00 0x56B4E9 0x555555 0x8C6D1F 0x7B2FBE 0x000000 0x7FB800 0x9E1B32 0x00A6A6 0xF08080"
curve_points = "7 5 9 11 4 6 8 10 13 12 15 14 1 3"
curveColour(k) = int(word(curve_colours, (k - 1) % words(curve_colours) + 1))
curvePoint(k) = int(word(curve_points, (k - 1) % words(curve_points) + 1))
curveDash(k) = (k - 1) % 4 + 1

# --- Solutions over time: series k of a panel, and what the table of a solution says of itself and of its panels. An item of
# a panel is a column, or `over:of`, a column over another one.
seriesColour(k) = int(word(family_colours, k == 2 ? 3 : k == 3 ? 4 : k % 8 == 0 ? 8 : k % 8))
seriesDash(k) = (k - 1) % 4 + 1
fromHead(file, key) = system("sed -n 's/^# ".key.": //p' '".file."' 2>/dev/null")
over(item) = strstrt(item, ':') ? item[1 : strstrt(item, ':') - 1] : 't'
of(item) = strstrt(item, ':') ? item[strstrt(item, ':') + 1 : strlen(item)] : item

# --- Stages: more stages are darker, from orange over violet and blue to black; hollow marks turn into filled ones.
stage_shades = "0xF59E2A 0xE2553D 0xBE2A78 0x7B2FBE 0x2F4BCB 0x14307A 0x101018 0x101018"
shadeAt(s) = 6.0 * (s > 20 ? 1 : log(s) / log(20))
channel(a, b, w, shift) = int((1 - w) * ((a >> shift) & 255) + w * ((b >> shift) & 255)) << shift
blend(a, b, w) = channel(a, b, w, 16) + channel(a, b, w, 8) + channel(a, b, w, 0)
shadeNumber(i) = int(word(stage_shades, i))
stageColour(s) = blend(shadeNumber(1 + int(shadeAt(s))), shadeNumber(2 + int(shadeAt(s))), \
                       shadeAt(s) - int(shadeAt(s)))
stages_marked = "1 2 3 4 5 6 7 8 9 10 12 15 20"
stage_points  = "6 4 8 10 12 14 7 13 15 5 3 9 11"
marked(s) = position(stages_marked, sprintf("%d", s))
stagePoint(s) = marked(s) ? int(word(stage_points, marked(s))) : 1
stageDash(s) = s <= 3 ? 5 - s : 1   # 1, 2, 3: dash-dot, dots, dashes; more: solid

# --- Failures are red and crossed in all figures.
failure_colour = 0xB00020
failure_point = 2

# --- Judged runs: right, honest failure, wrong, not judged.
judged_colours = "0x9CCFE7 0xE6C27A 0xC8102E 0xC9C9C9"
judgedColour(k) = int(word(judged_colours, k))

# --- Rows. In `using`:  has("scene", scene) ? column("h") : NaN ; an empty value accepts every row. A cell without a
# value is empty or nan; column() cannot detect it, because `missing NaN` drops the row first.
absent(name) = strcol(name) eq "" || strcol(name) eq 'nan'
is(name, value) = value eq "" ? absent(name) : strcol(name) eq value
has(name, wish) = wish eq "" || strcol(name) eq wish
positive(x) = x > 0 ? x : NaN      # logarithmic axes
succeeded(dummy) = strcol("outcome") eq "success"
# A refused run is no failure: the solver cannot be applied to the scene, or not in this way.
failedHere(dummy) = !succeeded(0) && strcol("outcome") ne "refused"

# Tables of older programs have fewer columns.
hasColumn(file, name) = strlen(system("grep -m1 -v '^#' '".file."' | tr ',' '\\n' | grep -x '".name."'")) > 0

# `eval errors(file, at_end)` defines the error of a run: the largest at its reference times, if the table has it and
# at_end is 0, else that at the end; the number of these times; and which successes are wrong: an error of
# u, v or x at the end above 1000 tolerances + 1e-9, the bar of the audit (experiments/audit/judge.h) for all methods alike. Fixed steps have no
# tolerance.
errors(file, at_end) = sprintf("has_times = !%d && hasColumn('%s', 'error_over_time'); ", at_end, file) \
  .sprintf("has_control = hasColumn('%s', 'control'); has_accuracy = hasColumn('%s', 'reference_accuracy'); ", file, file) \
  .sprintf("has_scalar = hasColumn('%s', 'scalar')", file)
has_times = 0; has_control = 0; has_accuracy = 0; has_scalar = 0
timed(name) = name[1 : 5] eq 'error' && has_times ? !absent(name.'_over_time') : 0
# Smaller errors in double are those of components that have all but vanished; they are drawn at this one.
least_error(d) = has_scalar ? (is("scalar", 'double') ? 1e-17 : 0) : 0
drawnError(x) = x > 0 && x < least_error(0) ? least_error(0) : positive(x)
errorOf(name) = !succeeded(0) ? NaN : timed(name) ? drawnError(column(name.'_over_time')) \
  : absent(name) ? NaN : drawnError(column(name))
# The same, and where the error is too small for its reference the bound that is known, ten times the reference's accuracy.
isBelow(d) = has_accuracy && succeeded(0) ? absent("error") && !timed("error") && !absent("reference_accuracy") : 0
errorOrBound(name) = name eq 'error' && isBelow(0) ? drawnError(10 * column("reference_accuracy")) : errorOf(name)
timesOf(d) = has_times ? column("reference_times") : 1
bar(d) = 1000 * (column("rtol") > column("atol") ? column("rtol") : column("atol")) + 1e-9
isFixed(d) = has_control ? is("control", 'fixed') : 0
isVague(d) = has_accuracy ? (absent("reference_accuracy") ? 0 : column("reference_accuracy") > 0.1 * bar(0)) : 0
isAbove(name) = absent(name) ? 0 : column(name) > bar(0)
isWrong(d) = succeeded(0) && !isFixed(0) && !isVague(0) ? isAbove("error_u") || isAbove("error_v") || isAbove("error_x") : 0
wrong_point = 6; ring_size = 1.25; ring_width = 0.9; wrong_title = 'error above 1000 tolerances'
errorTitle(name, times) = name eq 'invariant_change' ? 'largest change of an invariant' \
  : (name eq 'error' ? 'error' : name eq 'error_u' ? 'error of the positions' \
  : name eq 'error_v' ? 'error of the velocities' : name eq 'error_z' ? 'error of the multipliers' : 'error of the states') \
  .when(times > 1, sprintf(', largest at %d times', times))

# Distinct values: words in order of appearance, numbers ascending (as words without exponents, which gnuplot cannot
# read).
collected = ""
collect(item) = (position(collected, item) ? 0 : strlen(collected = collected." ".item))
smallest(list, above) = (low = 1e300, sum [i = 1:words(list)] \
  (real(word(list, i)) > above && real(word(list, i)) < low ? (low = real(word(list, i)), 0) : 0), low)
ascending(list, above, n) = n == 0 ? "" : \
  sprintf("%.10g ", smallest(list, above)).ascending(list, smallest(list, above), n - 1)
sorted(list) = ascending(list, -1e300, words(list))

# --- Integrators of other libraries. One that the program does not have is the user's (irk run --peers): a figure that names
# curves of other libraries shows it as well, if it is in the data.
program_peers = 'arkode_dirk cvode_bdf gsl_bsimp gsl_msbdf gsl_rk4imp ida_bdf'
isGiven(w) = !strstrt(w, ':') && !position('default embedded paper variable', w) && !position(program_peers, w)
namesPeers(list) = sum [i = 1 : words(program_peers)] (position(list, word(program_peers, i)) > 0)
given(list, found, k) = k == 0 ? '' : given(list, found, k - 1) \
  .(isGiven(word(found, k)) && !position(list, word(found, k)) ? ' '.word(found, k) : '')
withGiven(list, found) = namesPeers(list) ? list.given(list, found, words(found)) : words(list) == 0 ? found : list

# --- Methods. A tableau file's method is its path, and its family what the file says: two of them can have the same
# family and number of stages. A word of a list has no blanks.
oneWord(text) = strstrt(text, ' ') ? text[1 : strstrt(text, ' ') - 1].'_'.oneWord(text[strstrt(text, ' ') + 1 : *]) : text
withoutFolder(path) = strstrt(path, '/') ? withoutFolder(path[strstrt(path, '/') + 1 : *]) : path
withoutEnding(file) = file[strlen(file) - 3 : *] eq '.txt' ? file[1 : strlen(file) - 4] : file
# 'configuration:' stays in front of a tableau's name.
shortName(method) = strstrt(method, ':') && strstrt(method, '/') > strstrt(method, ':') \
  ? method[1 : strstrt(method, ':')].shortName(method[strstrt(method, ':') + 1 : *]) : withoutEnding(withoutFolder(method))
# The short name of item k if no other item has it.
label(list, k) = (sum [i = 1 : words(list)] (shortName(word(list, i)) eq shortName(word(list, k)))) > 1 \
  ? word(list, k) : shortName(word(list, k))

# Curves of methods: words 'stages:family:method', sorted by stages. Methods that share stages and family are twins; from
# the second on they have other colours, marks and dashes, and all of them have their names in the legend.
pairWord(d) = sprintf("%d:", column("stages")).oneWord(strcol("family"))
methodWord(d) = pairWord(0).':'.oneWord(strcol("method"))
afterColon(w) = w[strstrt(w, ':') + 1 : *]
stagesOf(w) = int(w[1 : strstrt(w, ':') - 1])
methodOf(w) = afterColon(afterColon(w))
pairOf(w) = w[1 : strlen(w) - strlen(methodOf(w)) - 1]
isMethod(w) = methodWord(0) eq w
stageNumbers(list, k) = k == 0 ? "" : (numbers = stageNumbers(list, k - 1), \
  position(numbers, sprintf("%d", stagesOf(word(list, k)))) ? numbers : numbers.sprintf(" %d", stagesOf(word(list, k))))
withStages(list, s, k) = k == 0 ? "" : \
  withStages(list, s, k - 1).(stagesOf(word(list, k)) == s ? ' '.word(list, k) : '')
byStages(list, stages, k) = k == 0 ? "" : \
  byStages(list, stages, k - 1).withStages(list, int(word(stages, k)), words(list))
sortedMethods(list) = (in_order = sorted(stageNumbers(list, words(list))), byStages(list, in_order, words(in_order)))
twinsBefore(list, k, last) = sum [i = 1 : last] (pairOf(word(list, i)) eq pairOf(word(list, k)))
twins(list, k) = twinsBefore(list, k, words(list))
twin(list, k) = twinsBefore(list, k, k)
methodNames(list, k) = k == 0 ? "" : methodNames(list, k - 1).' '.methodOf(word(list, k))
methodTitle(list, k) = sprintf("%d", stagesOf(word(list, k))) \
  .(twins(list, k) > 1 ? ' '.label(methodNames(list, words(list)), k) : '')
twin_colours = "0x0072B2 0x009E73 0xCC79A7 0x56B4E9 0x8C6D1F 0x555555"
methodColour(list, k) = twin(list, k) == 1 ? stageColour(stagesOf(word(list, k))) \
  : int(word(twin_colours, (twin(list, k) - 2) % 6 + 1))
methodPoint(list, k) = twin(list, k) == 1 ? stagePoint(stagesOf(word(list, k))) \
  : int(word(stage_points, (marked(stagesOf(word(list, k))) + 4 * twin(list, k)) % 13 + 1))
methodDash(list, k) = (stageDash(stagesOf(word(list, k))) + twin(list, k) - 2) % 5 + 1

# Panels of families: twins get a panel each. `eval clashes(file)` finds them.
clashing = ""
isOwnMethod(d) = strcol("method") ne strcol("family").sprintf("_%d", column("stages"))
withPair(list, pair) = sum [i = 1 : words(list)] (pairOf(word(list, i)) eq pair)
clashesIn(list, k) = k == 0 ? "" : clashesIn(list, k - 1).(twins(list, k) > 1 ? ' '.pairOf(word(list, k)) : '')
clashes(file) = sprintf("collected = ''; " \
  ."stats '%s' using (isOwnMethod(0) ? (collect(methodWord(0)), 1) : 0) nooutput; own = collected; " \
  ."if (strlen(own)) { stats '%s' using (!isOwnMethod(0) && withPair(own, pairWord(0)) ? " \
  ."(collect(methodWord(0)), 1) : 0) nooutput }; " \
  ."clashing = clashesIn(collected, words(collected)); collected = ''", file, file)
group(d) = position(clashing, pairWord(0)) ? oneWord(strcol("method")) : oneWord(strcol("family"))
groupTitle(g) = known(g) ? familyTitle(g) : shortName(g)

# Which rows: quoted words column=value that all must have.
equals(pair) = strstrt(pair, '=')
holds(pair) = is(pair[1 : equals(pair) - 1], pair[equals(pair) + 1 : strlen(pair)])
allowed(only) = words(only) == 0 ? 1 : (sum [i = 1 : words(only)] holds(word(only, i))) == words(only)

number(word) = strlen(word) ? int(word) : 1   # gnuplot evaluates the body of an empty iteration, too

# --- Which runs: those of a block (its name is in the column block), of a scene, or of both; by default all. A scene
# without a block selects runs with exactly the given settings.
if (!exists("block")) block = ''
if (!exists("scene")) scene = ''
if (!exists("settings")) settings = ''
inBlock(name) = position(strcol("block"), name) > 0
ofScene(d) = (block eq '' || inBlock(block)) && has("scene", scene)
ofCase(d) = ofScene(0) && (block.scene eq '' || (block ne '' ? has("settings", settings) : is("settings", settings)))

# Titles for scenes with their settings: "SCENE (NAME=VALUE)".
sceneTitle(scene, settings) = settings eq "" ? scene : scene." (".settings.")"
caseName = block eq '' ? sceneTitle(scene, settings) : 'block '.block.(scene eq '' ? '' : ', '.scene)

# The same selection as one word, for several panels: 'block=NAME', 'block=NAME:SCENE', 'SCENE' or 'SCENE:SETTINGS'.
colon(case) = strstrt(case, ':')
before(case) = colon(case) ? case[1 : colon(case) - 1] : case
behindColon(case) = colon(case) ? case[colon(case) + 1 : strlen(case)] : ''
hasBlock(case) = case[1:6] eq 'block='
sceneOf(case) = hasBlock(case) ? behindColon(case) : before(case)
settingsOf(case) = hasBlock(case) ? '' : behindColon(case)
shortSettings(case) = strlen(settingsOf(case)) > 24 ? '' : settingsOf(case)
isCase(case) = case eq '' || (hasBlock(case) ? inBlock(before(case)[7:*]) && has("scene", sceneOf(case)) \
                              : is("scene", sceneOf(case)) && is("settings", settingsOf(case)))
nameOf(case) = !hasBlock(case) ? sceneTitle(sceneOf(case), shortSettings(case)) \
  : sceneOf(case) eq '' ? before(case)[7:*] : sceneOf(case)

when(condition, text) = condition ? text : ''

# For marks that only some rows have, with fixed ranges: other rows get a position outside the panel.
outside = -1e9

# --- Panels: panel k = 1, 2, ... of a grid; margins as fractions of the figure.
margin_left = 0.08; margin_right = 0.02; margin_top = 0.07; margin_bottom = 0.13
gap_x = 0.03; gap_y = 0.12
cellWidth(columns) = (1.0 - margin_left - margin_right - (columns - 1) * gap_x) / columns
cellHeight(rows) = (1.0 - margin_top - margin_bottom - (rows - 1) * gap_y) / rows
panelLeft(k, columns) = margin_left + ((k - 1) % columns) * (cellWidth(columns) + gap_x)
panelTop(k, columns, rows) = 1 - margin_top - ((k - 1) / columns) * (cellHeight(rows) + gap_y)
panel(k, columns, rows) = sprintf( \
  "set lmargin at screen %.4f; set rmargin at screen %.4f; set tmargin at screen %.4f; set bmargin at screen %.4f", \
  panelLeft(k, columns), panelLeft(k, columns) + cellWidth(columns), \
  panelTop(k, columns, rows), panelTop(k, columns, rows) - cellHeight(rows)) . once(k)

# A legend of one or more rows below the panels, with `height` as fraction of the figure; plot keyentries after it.
legend(height) = sprintf("unset label 9999; unset logscale; set format '%%g'; set lmargin at screen 0; set rmargin at screen 1; " \
  ."set bmargin at screen 0; set tmargin at screen %.3f; set xrange [0:1]; set yrange [0:1]; " \
  ."set key at screen 0.5, screen %.3f center center horizontal samplen 2.2 width 1; ", height, 0.5 * height) \
  .bare

# If no row can be drawn, the figure says so; without any row there is no figure.
nothing(what) = sprintf("unset border; unset tics; unset key; unset grid; unset logscale; set xrange [0:1]; " \
  ."set yrange [0:1]; set label 1 'no run with a known error: %s' at 0.5,0.5 center noenhanced; plot 2 notitle; " \
  ."unset label 1; set border; set tics", what)
absence(what) = sprintf("system \"rm -f '%s.svg' '%s.png'\"; print 'no rows for %s'; exit", out, out, what)
