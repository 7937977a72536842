"""Figures in the suite's style, from its tables. What they show is computed by the program."""
import math

from .program import Misuse

# Okabe and Ito: distinguishable by colour-blind readers. As in plots/style.gp.
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#8C6D1F", "#555555")
_MARKS = "os^vDP*X"
_INK, _GRID = "#333333", "#d8d8d8"


def _require(frame, columns, table):
    missing = [column for column in columns if column not in frame.columns]
    if missing:
        raise Misuse(f"no column {', '.join(missing)}: {table} is expected")


def _require_one_each(frame, key, first_result, hint):
    """Refuses several rows for one mark; names the settings, the columns before `first_result`, in which they differ."""
    twice = frame[frame.duplicated(key, keep=False)]
    if twice.empty:
        return
    some = twice[(twice[key] == twice[key].iloc[0]).all(axis=1)]
    settings = frame.columns[: frame.columns.get_loc(first_result)]
    differ = [name for name in settings if name not in key and name != "key" and some[name].nunique() > 1]
    place = ", ".join(f"{name} = {some[name].iloc[0]}" for name in key if str(some[name].iloc[0]))
    raise Misuse(f"{len(some)} rows for {place}; they differ in {', '.join(differ) or 'nothing'}: {hint}")


def _panels(count, columns, height):
    from matplotlib.figure import Figure
    columns = min(columns, count)
    lines = math.ceil(count / columns)
    legend = 0.7  # inches, below the panels
    figure = Figure(figsize=(max(4.2 * columns, 6), height * lines + legend))
    figure.set_layout_engine("tight", rect=(0, legend / (height * lines + legend), 1, 1))
    axes = figure.subplots(lines, columns, squeeze=False).ravel()
    for unused in axes[count:]:
        unused.remove()
    for panel in axes[:count]:
        panel.spines[["top", "right"]].set_visible(False)
        panel.tick_params(colors=_INK)
        panel.grid(color=_GRID, linewidth=0.6)
    return figure, axes[:count]


def _finish(figure, axes, frame):
    shown = {name: handle for panel in axes for handle, name in zip(*panel.get_legend_handles_labels())}
    figure.legend(shown.values(), shown.keys(), loc="lower center", ncol=max(1, min(4, len(shown))), frameon=False, fontsize=8)
    if "quick" in frame.attrs.get("head", {}):
        figure.text(0.004, 0.995, "quick run: no verdict", fontsize=8, color="#8a5a00", va="top")


def _curves(runs, by):
    """The solver of each run: another library's integrator, else method and configuration; then the columns `by`."""
    def name(row):
        if not row["family"]:
            solver = row["integrator"]
        elif row["configuration"] == "default":
            solver = row["method"]
        else:
            solver = f"{row['configuration']}:{row['method']}"
        return ", ".join([solver] + [str(row[column]) for column in by])
    return runs.apply(name, axis=1)


def work_precision(runs, *, error="error", cost="cpu_s", by=()):
    """CPU time (or another column: residuals, …) over the error of the successful runs of a runs.csv: a panel per scene
    and its parameters, a curve per solver in the order of tolerances. `by`: further columns that tell curves apart, as
    ["formulation"]. Of several ends the last one is drawn. Crosses at the upper edge: runs that failed, at their
    tolerance. Refused runs are left out. Returns a matplotlib Figure."""
    needed = ["scene", "settings", "t_end", "method", "configuration", "integrator", "family", "outcome", "rtol",
              "atol", "h"]
    _require(runs, [*needed, error, cost, *by], "the table runs.csv of a study with errors")
    runs_to_end = runs[runs.t_end == runs.groupby(["scene", "settings"]).t_end.transform("max")]
    drawn = runs_to_end[runs_to_end.outcome != "refused"].copy()
    drawn.attrs = runs.attrs
    if drawn.empty:
        raise Misuse("no runs to draw")
    drawn["curve"] = _curves(drawn, by)
    _require_one_each(drawn, ["scene", "settings", "curve", "rtol", "atol", "h"], "outcome",
                      "select some of them, or tell the curves apart with by=[…]")
    colours = {curve: i for i, curve in enumerate(dict.fromkeys(drawn.curve))}
    groups = list(drawn.groupby(["scene", "settings"], sort=False))
    figure, axes = _panels(len(groups), 3, 3.0)
    for panel, ((scene, settings), here) in zip(axes, groups):
        for curve, i in colours.items():
            of = here[here.curve == curve].sort_values("rtol", ascending=False)
            style = {"color": _COLOURS[i % len(_COLOURS)], "marker": _MARKS[i % len(_MARKS)], "markersize": 4}
            good = of[(of.outcome == "success") & (of[error] > 0) & (of[cost] > 0)]
            panel.loglog(good[error], good[cost], linewidth=1, label=curve, **style)
            failed = of[of.outcome != "success"]
            panel.plot(failed.rtol, [0.98] * len(failed), "x", color=style["color"], markersize=5,
                       transform=panel.get_xaxis_transform())
        if not panel.xaxis_inverted():  # accuracy grows to the right
            panel.invert_xaxis()
        panel.set_title(f"{scene} {settings}".strip(), fontsize=10, color=_INK)
        panel.set_xlabel("error")
    axes[0].set_ylabel("CPU time in s" if cost == "cpu_s" else cost)
    _finish(figure, axes, drawn)
    return figure


def orders(table):
    """Observed orders (marks, with their confidence) and theory (lines) over the number of stages: a panel per family, a
    mark per component. `table`: orders.csv of a study, which the program's analysis writes. Returns a matplotlib
    Figure."""
    _require(table, ["family", "stages", "component", "order", "confidence", "theory"], "the table orders.csv of a study")
    _require_one_each(table, ["family", "stages", "component"], "order", "select some of them")
    families = list(dict.fromkeys(table.family))
    figure, axes = _panels(len(families), 4, 2.6)
    components = [one for one in ("u", "v", "x", "z") if one in set(table.component)]
    for panel, family in zip(axes, families):
        for i, component in enumerate(components):
            of = table[(table.family == family) & (table.component == component)].sort_values("stages")
            measured = of.dropna(subset=["order", "confidence"])
            style = {"color": _COLOURS[i], "markersize": 4}
            theory = of.dropna(subset=["theory"]).drop_duplicates("stages")
            panel.plot(theory.stages, theory.theory, linewidth=1, color=_COLOURS[i])
            if not measured.empty:
                panel.errorbar(measured.stages, measured.order, yerr=measured.confidence, fmt=_MARKS[i], linewidth=1,
                               label=component, **style)
        panel.set_title(family, fontsize=10, color=_INK)
        panel.set_xlabel("stages s")
        panel.xaxis.get_major_locator().set_params(integer=True)
    axes[0].set_ylabel("order of convergence")
    _finish(figure, axes, table)
    return figure
