"""Ours: the benchmark bicycle, declared, derived, linearised about straight running; eigenvalues.

Meijaard, Papadopoulos, Ruina and Schwab, Proc. R. Soc. A 463 (2007) 1955. The cache is empty, as in
the first process: a later one takes half as long.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
from pathlib import Path
from time import process_time

import polhode as ph

sys.path.append(str(Path(__file__).parents[2] / "tests"))

SPEED = 5.0


def main() -> None:
    from derive.bicycles import BENCHMARK, bicycle

    assert ph.linearise  # imports NumPy and SciPy, as the peer does before it starts
    began = process_time()
    upright = {"phi": 0, "delta": 0, "omega_y_R": SPEED / BENCHMARK["r_R"]}
    found = ph.linearise(bicycle(), BENCHMARK, upright).exponents
    seconds = process_time() - began
    parts = {f"re {i}": float(z.real) for i, z in enumerate(found)}
    parts |= {f"im {i}": float(z.imag) for i, z in enumerate(found)}
    print(json.dumps({"seconds": seconds, "answer": parts}))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as cache:
        os.environ["POLHODE_CACHE"] = cache
        main()
