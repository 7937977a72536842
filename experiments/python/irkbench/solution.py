"""irk solve: one integration, or all combinations of lists."""
import json
import tempfile
from pathlib import Path

import numpy as np

from .program import Failure, Misuse, RunFailed, call, message_of, option, text
from .tables import head_and_rows

_KINDS = ("u", "v", "x", "z")


def _array(values):
    return np.array([np.nan if value is None else value for value in values], dtype=float)


class Solution:
    """The solution over time. `t`: (n,), `values`: name -> (n,) of each component and output, `bars` likewise (empty
    if not asked for), `units`: name -> text, `columns`: all columns of the program's table as texts."""

    def __init__(self, file):
        head, names, rows = head_and_rows(file)
        self.head = head
        self.columns = {name: [row[i] for row in rows] for i, name in enumerate(names)}
        units = dict(zip(names, head["units"].split(",")))
        fixed = {"t", "h", "error", "newton_iterations", "switches"}
        numbers = {name: np.array(cells, dtype=float) for name, cells in self.columns.items() if name not in fixed}
        self.t = np.array(self.columns["t"], dtype=float)
        self.values = {name: cells for name, cells in numbers.items() if not name.startswith("bar ")}
        self.bars = {name[4:]: cells for name, cells in numbers.items() if name.startswith("bar ")}
        self.units = {name: units[name] for name in self.values}

    def __getitem__(self, name):
        return self.values[name]


class Result:
    """One integration. `u`, `v`, `x`, `z`: the state at the end, each (n,); `names`, `units`, `error_bar`: by kind, as
    result.names["u"], the last one empty if not measured; `outcome`, `t`, `error` (against the reference, nan without),
    `cpu_s`, `steps`, `counters`, `spec` (all settings) and `data`, the program's JSON object. `solution`: over time,
    if `points` or `over_time` was given."""

    def __init__(self, data, solution=None):
        self.data = data
        self.solution = solution
        self.outcome = data["outcome"]
        self.detail = data.get("detail", "")
        self.t = np.nan if data["t"] is None else data["t"]
        self.u, self.v, self.x, self.z = (_array(data[kind]) for kind in _KINDS)
        self.names = {kind: data["names"][kind] for kind in _KINDS}
        self.units = {kind: data["units"][kind] for kind in _KINDS}
        self.error = np.nan if data.get("error") is None else data["error"]
        bars = data.get("error_bar") or {}
        self.error_bar = {kind: _array(bars[kind]) for kind in _KINDS if kind in bars}
        self.cpu_s = data.get("cpu_s", np.nan)
        self.steps, self.counters, self.spec = data.get("steps", {}), data.get("counters", {}), data["spec"]

    @property
    def success(self):
        return self.outcome == "success"

    def state(self):
        """(name, value, bar, unit) of each component; the bar is nan if it was not measured."""
        rows = []
        for kind in _KINDS:
            values = getattr(self, kind)
            bars = self.error_bar.get(kind, np.full(len(values), np.nan))
            rows += zip(self.names[kind], values, bars, self.units[kind])
        return rows

    def __repr__(self):
        lines = [f"{self.spec['scene']} {self.spec['method']}: {self.outcome}, t = {self.t:g}"]
        lines += [f"  {name} = {value:.10g} +- {bar:.2g} {unit}" for name, value, bar, unit in self.state()[:10]]
        return "\n".join(lines + ([f"  error {self.error:.3g}"] if np.isfinite(self.error) else []))


class Results(list):
    """Several integrations, in the order in which the program makes them: the last list changes fastest."""

    def frame(self):
        """A DataFrame with a row per run: settings, outcome, errors, steps, counters and time."""
        import pandas
        rows = []
        for one in self:
            row = {**one.spec, "outcome": one.outcome, "error": one.error, "cpu_s": one.cpu_s, **one.counters}
            row.update({"steps_" + name: count for name, count in one.steps.items()})
            settings = row.pop("settings")
            row["settings"] = " ".join(f"{name}={value}" for name, value in settings.items())
            row["error_bar_tolerances"] = one.data.get("error_bar_tolerances")
            rows.append(row)
        return pandas.DataFrame(rows)


def _arguments(scene, options):
    arguments = ["solve", scene, "--json"]
    for name, value in options.items():
        if value is None or value is False:
            continue
        if name == "set":
            for parameter, of in value.items():
                arguments += ["--set", f"{parameter}={text(of)}"]
        elif name == "load":
            for file in [value] if isinstance(value, (str, Path)) else value:
                arguments += ["--load", file]
        elif value is True:
            arguments.append(option(name))
        else:
            arguments += [option(name), text(value)]
    return arguments


def solve(scene, *, over_time=False, check=True, **options):
    """Integrates a scene, by its name or its file (`my_mechanism.cpp`).

    `options` are those of `irk solve`, with underscores: method="radau_iia_5", tol=1e-8, formulation="ggl",
    reference=True, set={"m": 2.0}. A list makes all combinations and returns Results; otherwise one Result.
    `points=200` gives the solution at so many times, `over_time=True` at the accepted steps, `bars=True` error bars
    there. Raises Misuse for wrong arguments and, of a single run with `check`, RunFailed if it is no success; of
    several runs a failure is one of the results."""
    if not over_time and options.get("points") is None:
        if options.get("bars"):
            raise Misuse("bars belong to a solution over time: give points or over_time")
        status, out, err = call(*_arguments(scene, options), accept=(0, 1))
        return _checked(out, err, status, check, None)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "solution.csv"
        status, out, err = call(*_arguments(scene, {**options, "out": file}), accept=(0, 1))
        return _checked(out, err, status, check, Solution(file) if file.exists() else None)


def _checked(out, err, status, check, solution):
    if not out.strip():
        raise Failure(message_of(err) or f"exit status {status}")
    if not out.startswith("{\n"):  # one line per run
        return Results(Result(json.loads(line)) for line in out.splitlines())
    result = Result(json.loads(out), solution)
    if check and not result.success:
        raise RunFailed(message_of(err) or result.detail, result)
    return result
