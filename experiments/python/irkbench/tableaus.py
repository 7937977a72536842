"""Coefficients of methods."""
import numpy as np

from .program import call


class Tableau:
    """A: (s, s), b: (s,), c: (s,) in double precision; `head`: family, stages, order, stage_order, digits, …; `text`:
    the tableau file with all digits."""

    def __init__(self, text):
        self.text = text
        self.head, blocks, block = {}, {"A": [], "b": [], "c": []}, None
        for line in text.splitlines():
            if line.strip() in blocks:
                block = blocks[line.strip()]
            elif block is not None and line.strip():
                block.append([float(number) for number in line.split()])
            elif ":" in line and not line.startswith("#"):
                name, _, value = line.partition(":")
                self.head[name.strip()] = value.strip()
        self.A, (self.b,), (self.c,) = np.array(blocks["A"]), np.array(blocks["b"]), np.array(blocks["c"])

    def __repr__(self):
        return f"{self.head['family']}, {self.head['stages']} stages, order {self.head['order']}"


def tableau(method):
    """The coefficients of a method, by its id (`radau_iia_3`) or its tableau file. Raises Misuse as the program does."""
    return Tableau(call("tableau", "export", method)[1])
