# The share of each part of an integration in its time, over the number of unknowns: one panel per number of stages,
# one row per stage solver.
#   gnuplot -e "data='results/phases'; out='phases'; scene='SCENE'" shares.gp
# Reads phases.csv. Options: block or scene, derivatives, solvers (one row of panels each), methods (one column each),
# n_least (fewer unknowns are left out: their parts are as short as a call of the clock).
load system('dirname "'.ARG0.'"')."/style.gp"
if (!exists("derivatives")) derivatives = 'difference_forward'
if (!exists("solvers")) solvers = 'coupled_dense schur'
if (!exists("methods")) methods = 'radau_iia_3 radau_iia_5 radau_iia_10'
if (!exists("n_least")) n_least = 0
file = data.'/phases.csv'
parts = "residual jacobian factorization solve filter update step start"
part_titles = "'residuals' 'Jacobians' 'factorizations' 'solves' 'filter of errors' 'rest of iterations' 'rest of steps' 'start'"
part_colours = "0x9CCFE7 0x0072B2 0xD55E00 0xF2B78B 0xCC79A7 0x8FBF9F 0x4C8C6B 0xBBBBBB"
row(d) = ofScene(0) && is("derivatives", derivatives) && column("n") >= n_least
undefine N_*
stats file using (row(0) ? (collect(sprintf("%d", column("n"))), 1) : 0) name "N" nooutput
if (!exists("N_sum") || N_sum == 0) { eval absence(caseName." in ".file) }
sizes = sorted(collected)
collected = ""
stats file using (row(0) ? (collect(strcol("method")), 1) : 0) name "N" nooutput
kept = ""
do for [m in methods] { if (position(collected, m)) { kept = kept.' '.m } }
methods = kept
columns = words(methods); lines = words(solvers)
place(d) = sum [k = 1 : words(sizes)] (int(word(sizes, k)) == column("n") ? k : 0)
at(solver, method) = row(0) && is("solver", solver) && is("method", method)
shareOf(part) = column('share_'.part)
share(k) = word(parts, k) eq 'filter' ? shareOf('filter_factorization') + shareOf('filter_solve') : shareOf(word(parts, k))
below(k) = k == 1 ? 0 : sum [j = 1 : k - 1] share(j)
size_tics = "set xtics ("; do for [k = 1 : words(sizes)] {
  size_tics = size_tics.sprintf("%s'%s' %d", k == 1 ? '' : ', ', word(sizes, k), k) }
size_tics = size_tics.")"
solverTitle(s) = s eq 'coupled_dense' ? 'coupled, dense' : s eq 'schur' ? 'decoupled (Schur)' : s
stagesIn(method) = system("echo '".method."' | sed 's/.*_//'")

margin_left = columns == 1 ? 0.19 : 0.085; margin_right = 0.02; margin_top = 0.07; margin_bottom = columns == 1 ? 0.27 : 0.2; gap_x = 0.025; gap_y = 0.05
do for [format in formats] {
  eval open(format, columns == 1 ? 520 : 1080, 120 + 210 * lines)
  set multiplot
  unset key; unset grid; set border 3 lc rgb 0x666666; set tics scale 0
  set xrange [0.4 : words(sizes) + 0.6]; set yrange [0 : 1]
  do for [j = 1 : lines] { do for [i = 1 : columns] {
    eval panel((j - 1) * columns + i, columns, lines)
    eval size_tics." nomirror textcolor rgb ink"
    if (j < lines) { unset xtics }
    if (i == 1) { set ytics ('0' 0, '25 %%' 0.25, '50 %%' 0.5, '75 %%' 0.75, '100 %%' 1) nomirror textcolor rgb ink } else { unset ytics }
    set title when(j == 1, 's = '.stagesIn(word(methods, i))) offset 0,-0.5
    set xlabel when(j == lines, 'unknowns n of one stage') offset 0,0.3
    set ylabel when(i == 1, solverTitle(word(solvers, j))) offset 0.5,0 noenhanced
    plot for [k = 1 : words(parts)] file using (at(word(solvers, j), word(methods, i)) ? place(0) : outside):(below(k) + share(k) / 2):(0.38):(share(k) / 2) \
      with boxxyerror fs solid noborder lc rgb int(word(part_colours, k)) notitle
  } }
  eval legend(columns == 1 ? 0.16 : 0.1)
  set key maxrows (columns == 1 ? 4 : 1)
  plot 2 notitle, for [k = 1 : words(parts)] keyentry with boxes fs solid noborder lc rgb int(word(part_colours, k)) title word(part_titles, k)
  unset multiplot
  unset output
  eval framed
  set xrange [*:*]; set yrange [*:*]
}
