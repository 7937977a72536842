# Quantities over the step size for fixed steps, one curve per formulation and scaling of the constraints.
#   gnuplot -e "data='results/small_steps'; out='small'; block='known_multiplier'; quantities='error_z error_v'" over_step.gp
# Reads runs.csv. Options: block or scene, method, newton, quantities (columns, or iterations and new_jacobians for
# Newton iterations and Jacobians per step; one panel each), by (two columns; each pair of their values is a curve).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("method")) method = 'radau_iia_3'
if (!exists("newton")) newton = ''
if (!exists("quantities")) quantities = 'error_z error_v iterations'
if (!exists("by")) by = 'formulation scaling'
file = data.'/runs.csv'
title_of(q) = q eq 'error_z' ? 'error of the multiplier' : q eq 'error_v' ? 'error of the velocities' : q eq 'error_u' \
  ? 'error of the positions' : q eq 'iterations' ? 'Newton iterations per step' : q eq 'new_jacobians' ? 'Jacobians per step' : q eq 'drift' ? 'drift |g|' : q

row(d) = ofScene(0) && is("method", method) && has("newton", newton)
curve(d) = strcol(word(by, 1)).':'.strcol(word(by, 2))
valueOf(q) = q eq 'iterations' ? column("newton_iterations") / column("steps_accepted") \
  : q eq 'new_jacobians' ? positive(column("jacobians") / column("steps_accepted")) : positive(column(q))
undefine N_*
stats file using (row(0) ? (collect(curve(0)), 1) : 0) name "N" nooutput
if (!exists("N_sum") || N_sum == 0) { eval absence(caseName." in ".file) }
stats file using (row(0) ? column("h") : NaN) name "H" nooutput
curves = collected
stats file using (row(0) && !succeeded(0) ? 1 : 0) name "F" nooutput
failures = exists("F_sum") ? F_sum : 0
n = words(quantities)
count = words(curves)
first(c) = c[1 : strstrt(c, ':') - 1]
second(c) = c[strstrt(c, ':') + 1 : strlen(c)]
# One colour per formulation; dashed lines and hollow marks without scaling of the constraints.
colours = "index3 0xD55E00 index2 0x0072B2 index1 0x009E73 ggl 0xCC79A7 index2_projected 0xE69F00"
colourOf(c) = position(colours, first(c)) ? int(word(colours, position(colours, first(c)) + 1)) : 0x000000
off(c) = second(c) eq 'off'
sizeOf(c) = off(c) ? 1.5 : 0.7   # a ring around the filled mark where both coincide
pointOf(c) = position("index3 index2 index1 ggl index2_projected", first(c)) * 2 + 3 - (off(c) ? 1 : 0)
dashOf(c) = off(c) ? 3 : 1
titleOf(c) = first(c).(by eq 'formulation scaling' ? (off(c) ? ', unscaled' : ', scaled') : ' '.second(c))
at(k) = row(0) && curve(0) eq word(curves, k)

margin_left = n == 1 ? 0.13 : 0.07; margin_right = 0.02; margin_bottom = 0.27; gap_x = 0.075
do for [format in formats] {
  eval open(format, n == 1 ? 600 : n == 2 ? 860 : 1080, 430)
  set multiplot
  unset key
  do for [i = 1 : n] {
    q = word(quantities, i)
    eval panel(i, n, 1)
    eval decades("x")
    set yrange [*:*]
    if (q eq 'iterations') { unset logscale y; set format y '%g'; set yrange [0:*] } else { eval decades("y") }
    set xrange [2 * H_max : H_min / 2]
    undefine Q_*
    stats file using (row(0) && succeeded(0) && valueOf(q) > 0 ? valueOf(q) : NaN) name "Q" nooutput
    lost = exists("Q_max") ? Q_max : 1
    lost = q eq 'iterations' ? lost * 1.08 : lost * 10
    set xlabel 'step h (smaller to the right)'
    set ylabel title_of(q) offset 1,0
    plot for [k = 1 : count] file using (at(k) && succeeded(0) ? column("h") : NaN):(valueOf(q)) \
           smooth unique with linespoints lw 1.3 dt dashOf(word(curves, k)) pt pointOf(word(curves, k)) ps sizeOf(word(curves, k)) \
           lc rgb colourOf(word(curves, k)) notitle, \
         for [k = 1 : count] file using (at(k) && !succeeded(0) ? column("h") : outside):(lost * (q eq 'iterations' ? 1 + 0.03 * k : 2.0 ** k)) \
           with points pt failure_point ps 1 lw 2.4 lc rgb colourOf(word(curves, k)) notitle
  }
  eval legend(0.12)
  plot 2 notitle, for [k = 1 : count] keyentry with linespoints lw 1.3 dt dashOf(word(curves, k)) \
         pt pointOf(word(curves, k)) ps sizeOf(word(curves, k)) lc rgb colourOf(word(curves, k)) title titleOf(word(curves, k)), \
       for [k = 1 : failures > 0] keyentry with points pt failure_point ps 1 lw 2.4 lc rgb ink title 'failed'
  unset multiplot
  unset output
  eval framed
  unset logscale; set xrange [*:*]; set yrange [*:*]
}
