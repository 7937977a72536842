"""The program's tables as DataFrames, and studies."""
import csv
import functools
import warnings
from pathlib import Path

from .program import Failure, Misuse, call, message_of, option, text

# Columns that may look like numbers and are none.
_TEXTS = {"key", "environment", "cpu_environment", "code", "commit", "settings", "detail", "date"}


def head_and_rows(file):
    """The lines `# key: value` at the head of a table, its columns, and its rows as texts."""
    head = {}
    with open(file, newline="", encoding="utf-8") as lines:
        for line in lines:
            if not line.startswith("# "):
                break
            name, _, value = line[2:].rstrip("\n").partition(": ")
            head[name] = value
        else:
            return head, [], []
        columns = next(csv.reader([line]))
        return head, columns, [row for row in csv.reader(lines) if len(row) == len(columns)]


@functools.lru_cache(maxsize=1)
def _described():
    """table -> column -> (unit, meaning), as `irk list columns` prints them."""
    tables, table = {}, None
    for line in call("list", "columns")[1].splitlines():
        if line.startswith("## "):
            table = tables.setdefault(line[3:].split("/")[-1], {})
        elif table is not None and line.startswith("| `"):
            name, unit, meaning = (cell.strip() for cell in line.strip("| \n").split(" | ", 2))
            table[name.strip("`")] = (unit, meaning)
    return tables


def _typed(cells, name, numpy, pandas):
    """Numbers where every cell is one; an empty cell is nan then."""
    filled = [cell for cell in cells if cell]
    if name in _TEXTS or not filled:
        return pandas.Series(cells, dtype=object)
    try:
        numbers = [float(cell) for cell in filled]
    except ValueError:
        return pandas.Series(cells, dtype=object)
    if len(filled) == len(cells) and all(cell.lstrip("-").isdigit() for cell in filled):
        return pandas.Series([int(cell) for cell in cells])
    if len(filled) < len(cells):
        numbers = [float(cell) if cell else numpy.nan for cell in cells]
    return pandas.Series(numbers)


def read(path):
    """A table of results as a DataFrame with numbers where a column holds numbers. `path`: a CSV file, or the folder of
    a study, whose runs.csv is read. `attrs` has `head` (version, code, machine, …), `units` and `meanings` by column."""
    import numpy
    import pandas
    file = Path(path)
    if file.is_dir():
        file = file / "runs.csv"
    if not file.is_file():
        raise Misuse(f"{path}: a table, or the folder of a study with runs.csv, is expected")
    head, columns, rows = head_and_rows(file)
    if not columns:
        raise Misuse(f"{file}: it has no columns")
    cells = zip(*rows) if rows else [()] * len(columns)
    frame = pandas.DataFrame({name: _typed(list(column), name, numpy, pandas) for name, column in zip(columns, cells)})
    texts = {**_described().get("runs.csv", {}), **_described().get(file.name, {})}
    frame.attrs = {"head": head, "file": str(file),
                   "units": {name: texts[name][0] for name in columns if name in texts},
                   "meanings": {name: texts[name][1] for name in columns if name in texts}}
    return frame


def run(study, *, results="results", quick=False, **options):
    """Makes the runs of a study, by its name or its TOML file, and returns its runs.csv as `read` does. `options` are
    those of `irk run`: jobs=2, fresh=True, peers=[…]. What the program doubts is a warning."""
    arguments = ["run", study, "--results", results] + (["--quick"] if quick else [])
    for name, value in options.items():
        if value is not None and value is not False:
            arguments += [option(name)] if value is True else [option(name), text(value)]
    status, _, err = call(*arguments, accept=(0, 1))
    if status and message_of(err):
        raise Failure(message_of(err))
    if status:
        warnings.warn(err.strip().splitlines()[-1] if err.strip() else "irk run: doubts", stacklevel=2)
    folder = Path(results) / "quick" if quick else Path(results)
    return read(folder / Path(study).stem)
