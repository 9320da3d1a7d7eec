"""Ours: the contact tasks, each through its modes to rounding; `--task` for one of them.

Nothing is compiled in what is called seconds; `first` derives and compiles, or finds that kept.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path
from typing import Any

import polhode as ph
from polhode.simulate import Experiment

sys.path.insert(0, str(Path(__file__).parents[1]))
import contact_tasks as tasks
import numpy as np

Run = Callable[[], dict[str, float]]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--task", choices=tasks.TASKS, action="append")
    choice = parser.parse_args()
    document = {name: [measure(name)] for name in choice.task or tasks.TASKS}
    print(json.dumps(document | tasks.single(document)))


def measure(name: str) -> dict[str, object]:
    found: list[Run] = []

    def run() -> dict[str, float]:
        if not found:
            found.append({"sheet": sheet, "slide": slide, "disk": disk}[name]())
        return found[0]()

    return tasks.measured("to rounding", run)


def ball(lab: ph.Frame) -> ph.Body:
    m, r, k = ph.symbols("m r k", positive=True)
    return ph.sphere("ball", mass=m, radius=r, inertia=k * m * r**2, axes=lab)


def sheet() -> Run:
    g, mu = ph.symbols("g mu", positive=True)
    lab = ph.Frame("lab")
    x, y, chi = ph.functions("X Y chi")
    paper = ph.Sheet(lab, motion=(x, y), angle=chi)
    system = ph.System(ph.Coulomb(ball(lab), on=paper, mu=mu), ph.Gravity(g))
    times = np.concatenate([np.linspace(a, b, 4) for a, b in pairwise(tasks.KNOTS)])
    samples = np.array([tasks.sheet(i // 4, t)[0] for i, t in enumerate(times)]).T
    forcing = {
        name: ph.sampled(times, row, starts=(4,))
        for name, row in zip(("X", "Y", "chi"), samples, strict=True)
    }
    v_x, v_y = tasks.SHEET_START
    start = {"v_x": v_x, "v_y": v_y}
    return followed(system, tasks.BALL | {"g": tasks.G}, start, "sheet", forcing)


def slide() -> Run:
    g, mu = ph.symbols("g mu", positive=True)
    lab = ph.Frame("lab")
    system = ph.System(ph.Coulomb(ball(lab), on=ph.Plane(lab), mu=mu), ph.Gravity(g))
    return followed(system, tasks.BALL | {"g": tasks.G}, tasks.SLIDE_START, "slide", {})


def disk() -> Run:
    m, a, g, mu = ph.symbols("m a g mu", positive=True)
    theta, phi = ph.coordinates("theta phi")
    lab = ph.Frame("lab")
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3", name="axes")
    body = ph.disk("disk", mass=m, radius=a, axes=axes)
    system = ph.System(ph.Coulomb(body, on=ph.Plane(lab), mu=mu), ph.Gravity(g))
    return followed(system, tasks.DISK | {"g": tasks.G}, tasks.DISK_START, "disk", {})


DURATIONS = {
    "sheet": tasks.SHEET_DURATION,
    "slide": tasks.SLIDE_DURATION,
    "disk": tasks.DISK_DURATION,
}


def followed(
    system: ph.System,
    numbers: Mapping[str, float],
    start: Mapping[str, float],
    name: str,
    forcing: Mapping[str, Any],
) -> Run:
    experiment = Experiment(system, DURATIONS[name], forcing=forcing, samples=2)

    def run() -> dict[str, float]:
        final = experiment.run(numbers, start).final
        return {key: float(final[key]) for key in tasks.ANSWERS[name]}

    return run


if __name__ == "__main__":
    main()
