# Performance profiles (Dolan and More): the fraction of the problems given to a solver on which its time is at most a
# ratio times that of the best solver. One panel per target error. The legend gives the number of problems given to
# each solver and of all problems, over all errors.
#   gnuplot -e "data='results/work_precision'; out='profile'; targets='-4 -8'" profile.gp
# Reads profile.csv. Options: collection (of scenes; all if not given), targets (powers of ten, or all), integrators (in
# this order).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("targets")) targets = 'all'
if (!exists("integrators")) integrators = ''
if (!exists("collection")) collection = 'all'
file = data.'/profile.csv'
undefine N_*
columns = words(targets)
isOurs(d) = strcol("collection") eq collection
ofTarget(i) = isOurs(0) && (word(targets, i) eq 'all' ? strcol("target_error") eq 'all' : strcol("target_error") ne 'all' && \
  abs(log10(column("target_error")) - int(word(targets, i))) < 0.01)
array Rows[columns]
tried = 0
do for [i = 1 : columns] {
  undefine N_*
  stats file using (ofTarget(i) ? (collect(strcol("integrator")), 1) : 0) name "N" nooutput
  Rows[i] = exists("N_sum") ? N_sum : 0
  tried = tried + Rows[i]
}
if (tried == 0) { eval absence(collection.', '.targets." in ".file) }
# The legend lists only solvers with a curve.
in_data = ""
do for [w in (withGiven(integrators, collected))] { in_data = in_data.(position(collected, w) ? " ".w : "") }
integrators = in_data
count = words(integrators)
at(i, k) = ofTarget(i) && strcol("integrator") eq word(integrators, k)
targetTitle(i) = word(targets, i) eq 'all' ? 'all errors' : 'error 10^{'.word(targets, i).'}'
# Over all errors: "45/60" for a solver that was given 45 of 60 problems.
collected = ""
stats file using (isOurs(0) && strcol("target_error") eq 'all' ? \
  (collect(strcol("integrator").'='.strcol("given").'/'.strcol("problems")), 1) : 0) name "N" nooutput
givenOf(name, i) = i > words(collected) ? '' : word(collected, i)[1 : strlen(name) + 1] eq name.'=' ? \
  ' '.word(collected, i)[strlen(name) + 2 : *] : givenOf(name, i + 1)
legend_height = 0.08 * (1 + (count > 4) + (count > 8))
margin_left = columns == 1 ? 0.13 : 0.075; margin_right = 0.03; margin_bottom = legend_height + 0.16; gap_x = 0.03
do for [format in formats] {
  eval open(format, columns == 1 ? 640 : 1080, 460)
  set multiplot
  unset key
  do for [i = 1 : columns] {
    eval panel(i, columns, 1)
    eval decades("x")
    set xrange [1 : 100]; set yrange [0 : 1]
    set title targetTitle(i) offset 0,-0.5
    set xlabel 'time over that of the best solver'
    set ylabel when(i == 1, 'part of the problems given to it') offset 1,0
    if (i > 1) { set format y '' } else { set format y '%.1f' }
    if (Rows[i] == 0) { set label 1 "no run was asked\nfor this error" at graph 0.5, graph 0.5 center textcolor rgb ink }
    if (Rows[i] == 0) { plot 2 notitle } else {
      plot for [k = 1 : count] file using (at(i, k) ? column("ratio") : NaN):(column("fraction")) \
        with steps lw 1.8 dt curveDash(k) lc rgb curveColour(k) notitle
    }
    unset label 1
  }
  eval legend(legend_height)
  set key noenhanced maxrows (count > 8 ? 3 : count > 4 ? 2 : 1)
  plot 2 notitle, for [k = 1 : count] keyentry with lines lw 1.8 dt curveDash(k) lc rgb curveColour(k) title word(integrators, k).givenOf(word(integrators, k), 1)
  unset multiplot
  unset output
  eval framed
  unset logscale; set xrange [*:*]; set yrange [*:*]
}
