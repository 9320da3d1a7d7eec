"""Peer: the contact tasks by Moreau and Jean's fixed-step scheme, without events.

It is the one of tests/oracles/time_stepping.py: floats and complex numbers for the ball, NumPy for
the disk.
"""

from __future__ import annotations

import math
import sys
from itertools import pairwise
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
sys.path.insert(0, str(Path(__file__).parents[2] / "tests"))
import contact_tasks as tasks

from oracles.time_stepping import Disk, Slider

STEPS = {
    "sheet": (1e-2, 1e-3, 1e-4, 1e-5),
    "slide": (1e-2, 1e-3, 1e-4, 1e-5),
    "disk": (1e-2, 1e-3, 1e-4),
}


def main() -> None:
    tasks.tell(__doc__, {"sheet": sheet, "slide": slide, "disk": disk}, STEPS, " s")


def slider() -> Slider:
    return Slider(tasks.BALL["k"], tasks.BALL["mu"], tasks.G)


def told(name: str, place: complex, velocity: complex) -> dict[str, float]:
    values = (place.real, place.imag, velocity.real, velocity.imag)
    return dict(zip(tasks.ANSWERS[name], values, strict=True))


def sheet(step: float) -> dict[str, float]:
    ball, velocity = slider(), complex(*tasks.SHEET_START)
    state = (0j, velocity, velocity)
    ends = [0.0, *tasks.KNOTS.tolist(), tasks.SHEET_DURATION]
    for piece, (begin, end) in enumerate(pairwise(ends), start=-1):

        def beneath(since: float, place: complex, i: int = piece, t: float = begin) -> complex:
            (x, y, _), (v_x, v_y, turn), _ = tasks.sheet(i, t + since)
            return complex(v_x, v_y) + 1j * turn * (place - complex(x, y))

        state = ball.follow(beneath, state, end - begin, math.ceil((end - begin) / step))
    return told("sheet", *state[:2])


def slide(step: float) -> dict[str, float]:
    begin, r = tasks.SLIDE_START, tasks.BALL["r"]
    velocity = complex(begin["v_x"], begin["v_y"])
    rim = r * complex(begin["omega_y"], -begin["omega_x"])
    count = math.ceil(tasks.SLIDE_DURATION / step)
    state = slider().follow(lambda t, place: 0j, (0j, velocity, rim), tasks.SLIDE_DURATION, count)
    return told("slide", *state[:2])


def disk(step: float) -> dict[str, float]:
    m, a, begin = tasks.DISK["m"], tasks.DISK["a"], tasks.DISK_START
    body = Disk(m, a, m * a**2 / 4, m * a**2 / 2, tasks.DISK["mu"], tasks.G)
    s, c = math.sin(begin["theta"]), math.cos(begin["theta"])
    axis = np.array([0.0, -s, c])
    omega = begin["phi_dot"] * s * np.array([0.0, c, s]) + begin["omega_3"] * axis
    start = np.array([0.0, 0.0, a * s, begin["v_x"], begin["v_y"], 0.0, *axis, *omega])
    count = math.ceil(tasks.DISK_DURATION / step)
    end = body.follow(start, tasks.DISK_DURATION, count)
    theta = math.acos(end[8])
    return {"x": end[0], "y": end[1], "theta": theta, "omega_3": float(end[6:9] @ end[9:])}


if __name__ == "__main__":
    main()
