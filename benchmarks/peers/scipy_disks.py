"""Peer: the same rolling disks, one after the other by SciPy's DOP853, written by hand."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from time import perf_counter

import numpy as np
from scipy.integrate import solve_ivp

sys.path.insert(0, str(Path(__file__).parents[1] / "ours"))
from ensemble_disk import DURATION, NUMBERS, STATES, starts, told


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--members", type=int, default=8)
    parser.add_argument("--tolerance", type=float, default=1e-13)
    choice = parser.parse_args()
    given = starts(2048)
    start = np.array([given.get(name, np.zeros(2048)) for name in STATES])[:, : choice.members]
    began = perf_counter()
    ends = [end(one, choice.tolerance) for one in start.T]
    seconds = perf_counter() - began
    print(
        json.dumps(told(seconds, choice.members, dict(zip(STATES, np.array(ends).T, strict=True))))
    )


def end(start: np.ndarray, tolerance: float) -> np.ndarray:
    solution = solve_ivp(rates, (0.0, DURATION), start, method="DOP853", rtol=tolerance, atol=1e-14)
    return solution.y[:, -1]


def rates(_: float, state: np.ndarray) -> tuple[float, ...]:
    from math import cos, sin

    theta, theta_dot, phi_dot, omega = state
    s, c, a, g = sin(theta), cos(theta), NUMBERS["a"], NUMBERS["g"]
    return (
        theta_dot,
        (phi_dot * phi_dot * s * c - 6 * omega * phi_dot * s - 4 * g / a * c) / 5,
        2 * theta_dot * (omega - phi_dot * c) / s,
        2 * theta_dot * phi_dot * s / 3,
    )


if __name__ == "__main__":
    main()
