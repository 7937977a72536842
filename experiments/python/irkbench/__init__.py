"""The program irk from Python: integrations, studies, tables and figures.

    import irkbench as irk
    result = irk.solve("slider_crank", method="radau_iia_5", tol=1e-8)

Everything is computed by the program; this package starts it and reads what it writes. It needs numpy; `read`, `run`
and `frame` need pandas, figures matplotlib as well.
"""
from .figures import orders, work_precision
from .program import Failure, IrkError, Misuse, RunFailed, call, program
from .solution import Result, Results, Solution, solve
from .tables import read, run
from .tableaus import Tableau, tableau

__all__ = ["Failure", "IrkError", "Misuse", "Result", "Results", "RunFailed", "Solution", "Tableau", "call", "orders",
           "program", "read", "run", "solve", "tableau", "work_precision"]
