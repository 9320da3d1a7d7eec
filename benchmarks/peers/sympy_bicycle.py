"""Peer: the benchmark bicycle by SymPy's own example of it, with its eigenvalues.

The example is SymPy's test of its KanesMethod on this bicycle, as installed with SymPy: it derives
and linearises the equations and puts in the published numbers. Its last matrix, still a function of
the forward speed, is taken from it to compute the eigenvalues.
"""

from __future__ import annotations

import json
from time import process_time

import numpy as np
import sympy as sm
from sympy.physics.mechanics.tests.test_kane3 import test_bicycle

SPEED = 5.0


def main() -> None:
    matrices = []
    extract = sm.MutableDenseMatrix.extract

    def recorded(matrix: sm.Matrix, rows: list[int], columns: list[int]) -> sm.Matrix:
        matrices.append(extract(matrix, rows, columns))
        return matrices[-1]

    sm.MutableDenseMatrix.extract = recorded
    began = process_time()
    test_bicycle()
    last = next(m for m in reversed(matrices) if m.shape == (4, 4) and sm.Symbol("v") in m.atoms())
    found = np.linalg.eigvals(np.array(last.subs({sm.Symbol("v"): SPEED}), float)).astype(complex)
    seconds = process_time() - began
    found = found[np.lexsort((-found.imag, -found.real))]
    parts = {f"re {i}": float(z.real) for i, z in enumerate(found)}
    parts |= {f"im {i}": float(z.imag) for i, z in enumerate(found)}
    print(json.dumps({"seconds": seconds, "answer": parts}))


if __name__ == "__main__":
    main()
