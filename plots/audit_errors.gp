# Meaning of the tolerance: error divided by tolerance for every judged success, over the tolerance, with the bar
# above which a success is wrong; one panel per configuration (other libraries have none).
#   gnuplot -e "data='results/audit'; out='audit_errors'" audit_errors.gp
# Reads audit.csv. Tolerances are powers of ten; marks are spread around them so that they do not overlap.
load system('dirname "'.ARG0.'"')."/style.gp"
file = data.'/audit.csv'
configurations = "default paper embedded variable"
of(i) = is("integrator", word(configurations, i)) && (is("judgement", 'right') || is("judgement", 'wrong'))
undefine N_*
stats file using (of(1) || of(2) || of(3) || of(4) ? 1 : NaN) name "N" nooutput
if (!exists("N_sum") || N_sum == 0) { eval absence(file) }
# Errors of exactly zero and infinite errors are drawn at the edges.
low = 1e-7; high = 1e14
clipped(r) = r < low ? low : r > high ? high : r
golden = 0.6180339887
spread(d) = 10 ** (0.6 * (column("run") * golden - floor(column("run") * golden)) - 0.3)
place(i) = of(i) ? column("tolerance") * spread(0) : NaN
ratio(d) = clipped(strcol("error") eq 'inf' ? high : column("error") / column("tolerance"))
promised(d) = is("treatment", 'default') || is("treatment", 'locate') || is("treatment", 'no switches')
right(d) = is("judgement", 'right') ? ratio(0) : NaN
wrong(promise) = is("judgement", 'wrong') && promised(0) == promise ? ratio(0) : NaN
bar(t) = (1000 * t + 1e-9) / t
good = 0x0072B2; bad = judgedColour(3)

# Count before axes are set, because their ranges would exclude the counts.
array successes[4]; array wrongs[4]; array broken[4]
do for [i = 1 : 4] {
  stats file using (of(i) ? 1 : 0) name "A" nooutput
  stats file using (of(i) && is("judgement", 'wrong') ? 1 : 0) name "W" nooutput
  stats file using (of(i) && is("judgement", 'wrong') && promised(0) ? 1 : 0) name "P" nooutput
  successes[i] = A_sum; wrongs[i] = W_sum; broken[i] = P_sum
}
margin_left = 0.075; margin_bottom = 0.18; margin_top = 0.06; gap_x = 0.02; gap_y = 0.075
do for [format in formats] {
  eval open(format, 1080, 720)
  set multiplot
  unset key
  eval decades("x"); eval decades("y")
  set xrange [10 ** -1.4 : 10 ** -13.6]; set yrange [low / 2 : high * 2]
  do for [i = 1 : 4] {
    eval panel(i, 2, 2)
    set title sprintf("%s: %d of %d successes wrong", word(configurations, i), wrongs[i], successes[i]) offset 0,-0.5
    set xlabel when(i > 2, 'tolerance')
    set ylabel when(i % 2 == 1, 'error / tolerance') offset 1,0
    if (i > 2) { set format x '10^{%L}' } else { set format x '' }
    if (i % 2 == 1) { set format y '10^{%L}' } else { set format y '' }
    plot for [k = 1 : successes[i] > wrongs[i]] file using (place(i)):(right(0)) with points pt 7 ps 0.25 lc rgb good notitle, \
      for [k = 1 : wrongs[i] > broken[i]] file using (place(i)):(wrong(0)) with points pt 6 ps 0.7 lw 1.3 lc rgb bad notitle, \
      for [k = 1 : broken[i] > 0] file using (place(i)):(wrong(1)) with points pt 7 ps 0.7 lc rgb bad notitle, \
      bar(x) with lines lw 2 lc rgb ink notitle
  }
  eval legend(0.085)
  plot 2 notitle, keyentry with points pt 7 ps 0.5 lc rgb good title 'right', \
    keyentry with points pt 7 ps 0.9 lc rgb bad title 'wrong: switches by default, located or none', \
    keyentry with points pt 6 ps 0.9 lw 1.3 lc rgb bad title 'wrong: another treatment', \
    keyentry with lines lw 2 lc rgb ink title 'bar: 1000 tol + 10⁻⁹'
  unset multiplot
  unset output
  eval framed
  unset logscale; set xrange [*:*]; set yrange [*:*]
}
