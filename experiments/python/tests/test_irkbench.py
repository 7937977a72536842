"""Tests of the Python package with the program itself. IRK_PROGRAM names it, or it is that of the sources.

    PYTHONPATH=experiments/python python3 -m unittest discover experiments/python/tests
"""
import json
import os
import tempfile
import unittest
from pathlib import Path

import matplotlib
import numpy as np

import irkbench as irk
from irkbench.program import text

matplotlib.use("Agg")
SOURCES = Path(__file__).resolve().parents[3]

STUDY = """
title = "Small"
orders = true
[defaults]
reference = "auto"
[[block]]
scene = "kepler"
t_end = 1.0
methods = ["radau_iia_2", "radau_iia_3", "cvode_bdf"]
tolerances = [1e-4, 1e-6]
"""


class InAFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)


class Solve(InAFolder):
    def test_a_result_has_arrays_names_units_and_bars(self):
        result = irk.solve("slider_crank", method="radau_iia_5", tol=1e-8, reference=True)
        self.assertTrue(result.success)
        self.assertEqual(result.names["u"], ["theta", "phi"])
        self.assertEqual(result.units["v"], ["rad/s", "rad/s"])
        np.testing.assert_allclose(result.u, [55.0724437718, 0.3382574493], rtol=1e-8)
        self.assertEqual(result.error_bar["z"].shape, (1,))
        self.assertLess(result.error, 1e-6)
        self.assertEqual(result.spec["method"], "radau_iia_5")
        self.assertIn("theta = 55.07", repr(result))

    def test_a_solution_over_time(self):
        result = irk.solve("slider_crank", tol=1e-6, points=5, bars=True)
        np.testing.assert_allclose(result.solution.t, [0, 0.5, 1, 1.5, 2])
        self.assertAlmostEqual(result.solution["theta"][-1], result.u[0])
        self.assertEqual(result.solution.units["x3"], "m")
        self.assertEqual(set(result.solution.bars), set(result.solution.values))
        self.assertGreater(len(irk.solve("slider_crank", tol=1e-6, over_time=True).solution.t), 50)

    def test_lists_make_all_combinations(self):
        results = irk.solve("kepler", set={"e": [0.1, 0.3]}, tol=(1e-4, 1e-6), t_end=1.0)
        self.assertEqual([(one.spec["settings"]["e"], one.spec["rtol"]) for one in results],
                         [("0.1", 1e-4), ("0.1", 1e-6), ("0.3", 1e-4), ("0.3", 1e-6)])
        frame = results.frame()
        self.assertEqual(list(frame.settings), ["e=0.1", "e=0.1", "e=0.3", "e=0.3"])
        self.assertTrue((frame.residuals > 0).all())

    def test_numbers_keep_their_digits(self):
        self.assertEqual(text(0.1 + 0.2), "0.30000000000000004")
        self.assertEqual(text(np.array([1.5, 2.0])), "1.5,2.0")
        self.assertEqual(text(np.float64(0.1)), "0.1")


class Errors(InAFolder):
    def test_the_programs_messages(self):
        for call, message in ((lambda: irk.solve("slidercrank"), "did you mean 'slider_crank'"),
                              (lambda: irk.solve("kepler", tol=-1.0), "--tol = -1"),
                              (lambda: irk.solve("kepler", mehtod="gauss_2"), "did you mean '--method'"),
                              (lambda: irk.solve("kepler", bars=True), "points or over_time"),
                              (lambda: irk.tableau("radau_iia_x"), "radau_iia"),
                              (lambda: irk.run("nosuch.toml"), "nosuch.toml"),
                              (lambda: irk.read("nosuch"), "nosuch")):
            with self.subTest(message), self.assertRaises(irk.Misuse) as raised:
                call()
            self.assertIn(message, str(raised.exception))

    def test_a_failed_integration(self):
        with self.assertRaises(irk.RunFailed) as raised:
            irk.solve("slider_crank", max_steps=3)
        self.assertIn("max_steps", str(raised.exception))
        self.assertEqual(raised.exception.result.outcome, "max_steps")
        self.assertEqual(irk.solve("slider_crank", max_steps=3, check=False).outcome, "max_steps")
        outcomes = [one.outcome for one in irk.solve("slider_crank", max_steps=[3, 100000])]
        self.assertEqual(outcomes, ["max_steps", "success"])

    def test_a_program_that_is_not_there(self):
        self.addCleanup(os.environ.__setitem__, "IRK_PROGRAM", irk.program())
        os.environ["IRK_PROGRAM"] = "/nosuch/irk"
        with self.assertRaisesRegex(irk.Failure, "/nosuch/irk"):
            irk.solve("kepler")


class Studies(InAFolder):
    def test_a_study_its_tables_and_figures(self):
        Path("small.toml").write_text(STUDY, encoding="utf-8")
        runs = irk.run("small.toml", jobs=1)
        self.assertEqual(len(runs), 6)
        self.assertEqual(runs.residuals.dtype.kind, "i")
        self.assertEqual(runs.error.dtype.kind, "f")
        self.assertEqual(runs.attrs["units"]["cpu_s"], "s")
        self.assertEqual(runs.attrs["head"]["study"], "small")
        self.assertEqual(runs.key.dtype.kind, "O")
        figure = irk.work_precision(runs, cost="residuals")
        (panel,) = [axes for axes in figure.axes if axes.get_title()]
        curves = {line.get_label(): line for line in panel.lines if len(line.get_xdata())}
        self.assertEqual(set(curves), {"radau_iia_2", "radau_iia_3", "cvode_bdf"})
        good = runs[runs.method == "radau_iia_3"]
        np.testing.assert_array_equal(np.sort(curves["radau_iia_3"].get_xdata()), np.sort(good.error))
        self.assertTrue(panel.xaxis_inverted())
        figure.savefig("figure.png")

    def test_figures_refuse_what_they_cannot_tell_apart(self):
        Path("small.toml").write_text(STUDY.replace(', "cvode_bdf"', "") + "estimate = ['richardson', 'embedded']\n",
                                      encoding="utf-8")
        runs = irk.run("small.toml", jobs=1)
        with self.assertRaisesRegex(irk.Misuse, "differ in estimate"):
            irk.work_precision(runs)
        irk.work_precision(runs, by=["estimate"])
        with self.assertRaisesRegex(irk.Misuse, "orders.csv"):
            irk.orders(runs)


class Tableaus(InAFolder):
    def test_coefficients(self):
        radau = irk.tableau("radau_iia_2")
        np.testing.assert_allclose(radau.A, [[5 / 12, -1 / 12], [3 / 4, 1 / 4]], rtol=1e-15)
        np.testing.assert_allclose(radau.b, [3 / 4, 1 / 4], rtol=1e-15)
        np.testing.assert_allclose(radau.c, [1 / 3, 1], rtol=1e-15)
        self.assertEqual(radau.head["order"], "3")
        Path("mine.txt").write_text(radau.text, encoding="utf-8")
        np.testing.assert_array_equal(irk.tableau("mine.txt").A, radau.A)


class Pages(InAFolder):
    """The notebooks, and the Python in the guide's page, as they stand there."""

    def test_the_notebooks(self):
        for name in ("my_mechanism", "my_tableau"):
            notebook = json.loads((SOURCES / "experiments/python/notebooks" / f"{name}.ipynb").read_text("utf-8"))
            cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
            self.assertGreater(len(cells), 4)
            names = {}
            for number, cell in enumerate(cells):
                with self.subTest(name, cell=number):
                    exec(compile(cell, f"{name}, cell {number}", "exec"), names)

    def test_the_page(self):
        page = (SOURCES / "experiments/guide/python.md").read_text("utf-8")
        blocks = [block.split("```")[0] for block in page.split("```python\n")[1:]]
        self.assertGreaterEqual(len(blocks), 3)
        names = {}
        for number, block in enumerate(blocks):
            exec(compile(block, f"python.md, block {number}", "exec"), names)
        self.assertTrue(Path("costs.svg").exists())


if __name__ == "__main__":
    unittest.main()
