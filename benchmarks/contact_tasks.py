"""Motions with dry friction that the sides of the contact benchmark have to find.

One ball on a sheet of paper that jerks, turns and stops; one ball that slides and then rolls; one
disk that is thrown slipping, grips, and rolls on. Every side gives the numbers of `ANSWERS`.
"""

from __future__ import annotations

import argparse
import json
from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from time import process_time
from typing import Any

import numpy as np

G = 9.81
BALL = {"m": 0.05, "r": 0.02, "k": 0.4, "mu": 0.2}

SHEET_DURATION = 2.0
SHEET_START = (0.3, 0.1)  # m/s, rolling at the origin of the sheet
#: When the polynomials begin, and the last one ends, s.
KNOTS = np.array([0.2, 0.5, 1.1])
#: X, Y, angle: rising powers of the time since the knot.
TABLES = np.array(
    [
        [[0, 0, 2, 6], [0.342, 0.2, -1, 0]],
        [[0, 0, 1.5, 0], [0.135, 0.3, -2, 2]],
        [[0, 0, 2, 0], [0.18, -0.5, 0.5, 0]],
    ],
    dtype=float,
)

SLIDE_DURATION = 1.0
SLIDE_START = {"v_x": 1.0, "v_y": 0.3, "omega_x": 20.0, "omega_y": -30.0}

DISK = {"m": 0.1, "a": 0.05, "mu": 0.25}
DISK_DURATION = 0.3
DISK_START = {"theta": 1.45, "phi_dot": 1.0, "omega_3": 20.0, "v_x": -0.8, "v_y": -0.05}

ANSWERS = {
    "sheet": ("x", "y", "v_x", "v_y"),
    "slide": ("x", "y", "v_x", "v_y"),
    "disk": ("x", "y", "theta", "omega_3"),
}
TASKS = tuple(ANSWERS)


def sheet(piece: int, t: float) -> tuple[list[float], list[float], list[float]]:
    """X, Y, angle; their rates; their second rates: of one polynomial, or at rest."""
    if piece < 0:
        return [0.0] * 3, [0.0] * 3, [0.0] * 3
    rest = piece == len(KNOTS) - 1
    i = min(piece, len(KNOTS) - 2)
    u = (KNOTS[-1] if rest else t) - KNOTS[i]
    rows = TABLES[:, i].tolist()
    places = [a + u * (b + u * (c + u * d)) for a, b, c, d in rows]
    if rest:
        return places, [0.0] * 3, [0.0] * 3
    rates = [b + u * (2 * c + 3 * u * d) for _, b, c, d in rows]
    return places, rates, [2 * c + 6 * u * d for _, _, c, d in rows]


def piece_at(t: float) -> int:
    return bisect_right(KNOTS.tolist(), t) - 1


def slide_answer() -> dict[str, float]:
    """The closed form: a parabola until the slip has gone, then a straight line."""
    k, r, decay = BALL["k"], BALL["r"], BALL["mu"] * G
    velocity = complex(SLIDE_START["v_x"], SLIDE_START["v_y"])
    rim = r * complex(SLIDE_START["omega_y"], -SLIDE_START["omega_x"])
    slip = velocity - rim
    lasts = abs(slip) / ((1 + 1 / k) * decay)
    final = (velocity + k * rim) / (1 + k)
    place = velocity * lasts - slip / abs(slip) * decay * lasts**2 / 2
    place += final * (SLIDE_DURATION - lasts)
    return {"x": place.real, "y": place.imag, "v_x": final.real, "v_y": final.imag}


def measured(setting: str, run: Callable[[], dict[str, float]], repeats: int = 5) -> dict[str, Any]:
    """The first run and the quickest of some more, processor seconds of each, and the answer.

    Runs that take long are not repeated as often.
    """
    begun = process_time()
    answer = run()
    first = process_time() - begun
    times = []
    for _ in range(repeats if first < 2 else 1):
        begun = process_time()
        run()
        times.append(process_time() - begun)
    return {"setting": setting, "answer": answer, "first": first, "seconds": min(times)}


def tell(
    description: str | None,
    runs: Mapping[str, Callable[[float], dict[str, float]]],
    settings: Mapping[str, Sequence[float]],
    unit: str = "",
) -> None:
    """Print the document of a side that has a setting: every task, or those of `--task`."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--task", choices=TASKS, action="append")
    choice = parser.parse_args()
    document = {
        name: [measured(f"{s:g}{unit}", partial(runs[name], s)) for s in settings[name]]
        for name in choice.task or TASKS
    }
    print(json.dumps(document | single(document)))


def single(document: dict[str, list[dict[str, Any]]]) -> dict[str, Any]:
    """Of a document about one task: the seconds and the answer of its most exact run."""
    if len(document) != 1:
        return {}
    ((*_, best),) = document.values()
    return {"seconds": best["seconds"], "answer": best["answer"]}
