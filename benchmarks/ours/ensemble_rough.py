"""Ours: balls of all frictions on a shaken sheet, each slipping and sticking several times.

`--alone` follows the same members one by one, each through the scalar automaton. Seconds are
processor time, of members after the first few: nothing is compiled in them.
"""

from __future__ import annotations

import argparse
import json
from time import process_time

import numpy as np

NUMBERS = {"m": 0.05, "r": 0.02, "k": 0.4, "g": 9.81}
DURATION = 1.0
STATES = ("x", "y", "v_x", "v_y")
WARM = 16


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--members", type=int, default=512)
    parser.add_argument("--alone", action="store_true")
    choice = parser.parse_args()
    print(json.dumps((alone if choice.alone else ours)(choice.members)))


def case(members: int):
    """The system, its motion, and numbers and starts of so many members."""
    from polhode.algebra import sin, symbol, time
    from polhode.catalogue import CATALOGUE
    from polhode.derive import automaton
    from polhode.model import with_friction

    # rows of draws, so that the first members are the same however many there are
    frictions = np.random.default_rng(1).uniform(0.05, 0.35, members)
    speeds = np.random.default_rng(2).normal(0, 0.3, (members, 2))
    mu = symbol("mu")
    modes = automaton(with_friction(CATALOGUE["ball-on-paper"].build(), mu, 1.2 * mu))
    sheet = {"X": sin(10 * time) ** 3 / 30, "Y": sin(4 * time) ** 2 / 30, "chi": 0}
    numbers = {**NUMBERS, "mu": frictions}
    starts = {"v_x": speeds[:, 0], "v_y": speeds[:, 1]}
    return modes, sheet, numbers, starts


def told(seconds: float, members: int, ends: dict[str, np.ndarray]) -> dict[str, object]:
    answer = {f"{name} {k}": float(ends[name][k]) for name in STATES for k in range(4)}
    return {"seconds": seconds / members, "answer": answer}


def ours(members: int) -> dict[str, object]:
    from polhode.study import EnsembleRunner, EnsembleSpec, Final, members_of

    modes, sheet, numbers, starts = case(members)
    order = EnsembleSpec(
        modes, DURATION, {name: Final(name) for name in STATES}, {"forcing": sheet}
    )
    crew = EnsembleRunner(order)
    everybody = members_of(numbers, starts, None, 0)
    crew.follow(everybody.rows(slice(0, WARM)), lambda count: None)
    began = process_time()
    block = crew.follow(everybody, lambda count: None)
    return told(process_time() - began, members, dict(block.values))


def alone(members: int) -> dict[str, object]:
    from polhode.simulate import Experiment

    modes, sheet, numbers, starts = case(members)
    experiment = Experiment(modes, DURATION, samples=2, forcing=sheet)
    ends = {name: np.empty(members) for name in STATES}
    began = 0.0
    for i in range(-2, members):
        began = process_time() if i == 0 else began
        start = {name: float(values[i]) for name, values in starts.items()}
        run = experiment.run({**numbers, "mu": float(numbers["mu"][i])}, start)
        for name in STATES:
            ends[name][i] = run.final[name]
    return told(process_time() - began, members, ends)


if __name__ == "__main__":
    main()
