# The step size over time, one curve per method; lines mark the discontinuities.
#   gnuplot -e "data='results/steps'; out='steps'; cases='SCENE SCENE_NAME_VALUE'" step_size.gp
# Reads <case>.<method>.csv. Options: cases (file names without the method; one panel each), titles (quoted words),
# methods, marks (quoted words, one per case: times of discontinuities).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("cases")) cases = ''
if (!exists("titles")) titles = ''
if (!exists("methods")) methods = 'radau_iia_2 radau_iia_5 radau_iia_9'
if (!exists("marks")) marks = ''
n = words(cases)
count = words(methods)
file(i, k) = data.'/'.word(cases, i).'.'.word(methods, k).'.csv'
there(i, k) = int(system("test -f '".file(i, k)."' && echo 1 || echo 0"))
any = 0
do for [i = 1 : n] { do for [k = 1 : count] { any = any + there(i, k) } }
if (any == 0) { eval absence(cases." in ".data) }
stagesIn(method) = int(system("echo '".method."' | sed 's/.*_//'"))
array Colour[count]; array Stages[count]
do for [k = 1 : count] { Stages[k] = stagesIn(word(methods, k)); Colour[k] = stageColour(Stages[k]) }
least = 1e300; most = 0
array Last[n]
array First[n * count]
slot(i, k) = (i - 1) * count + k
# The step of at most six labels from 0 to `end`.
power(x) = 10 ** floor(log10(x))
fewTics(end) = (unit = power(end / 5), end <= 5.001 * unit ? unit : end <= 10.001 * unit ? 2 * unit : end <= 25.001 * unit ? 5 * unit : 10 * unit)
do for [i = 1 : n] { Last[i] = 0; do for [k = 1 : count] { if (there(i, k)) {
  undefine H_*; undefine T_*
  First[slot(i, k)] = NaN
  stats file(i, k) using (column("h") > 0 && !(First[slot(i, k)] > 0) ? (First[slot(i, k)] = column("h")) : 0) nooutput
  stats file(i, k) using "t" name "T" nooutput
  Last[i] = exists("T_max") && T_max > Last[i] ? T_max : Last[i]
  stats file(i, k) using (column("h") > 0 ? log10(column("h")) : NaN) name "H" nooutput
  if (exists("H_min")) { least = 10 ** H_min < least ? 10 ** H_min : least; most = 10 ** H_max > most ? 10 ** H_max : most }
} } }
# The row of the start has no step: the first step is drawn from there on.
stepOf(i, k) = absent("h") ? First[slot(i, k)] : positive(column("h"))
jumps(i) = words(marks) >= i ? word(marks, i) : ''

margin_left = n == 1 ? 0.12 : 0.075; margin_right = 0.02; margin_bottom = 0.25; gap_x = 0.03
do for [format in formats] {
  eval open(format, n == 1 ? 640 : 1080, 400)
  set multiplot
  eval decades("y")
  unset key
  set xrange [*:*] noextend; set yrange [least / 2 : most * 2]
  do for [i = 1 : n] {
    eval panel(i, n, 1)
    set title when(words(titles) >= i, word(titles, i)) offset 0,-0.5
    set xlabel 't in s'
    set ylabel when(i == 1, 'step size in s') offset 1,0
    if (i > 1) { set format y '' }
    # Wide numbers, as 0.05, have room at every second mark that gnuplot would choose.
    set format x '%g'; set xtics autofreq
    if (n > 2 && Last[i] > 0) { set xtics fewTics(Last[i]) }
    do for [j = 1 : words(jumps(i))] {
      set arrow j from first real(word(jumps(i), j)), graph 0 to first real(word(jumps(i), j)), graph 1 nohead \
        back lw 5 lc rgb 0xF3D9D9
    }
    here = ""
    do for [k = 1 : count] { here = here.(there(i, k) ? sprintf(" %d", k) : "") }
    if (words(here) > 0) {
      plot for [k in here] file(i, number(k)) using "t":(stepOf(i, number(k))) \
        with fsteps lw 1.4 lc rgb Colour[number(k)] notitle
    } else {
      set label 1 'no run' at graph 0.5, graph 0.5 center textcolor rgb ink
      plot least / 10 notitle  # below the panel
    }
    unset arrow; unset label 1
  }
  eval legend(0.1)
  plot 2 notitle, for [k = 1 : count] keyentry with lines lw 1.6 lc rgb Colour[k] \
         title word(methods, k), \
       keyentry with lines lw 5 lc rgb 0xF3D9D9 title 'discontinuity'
  unset multiplot
  unset output
  eval framed
  unset logscale; set xrange [*:*]; set yrange [*:*]
}
