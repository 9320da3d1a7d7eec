"""Ours: one system of a family, from its declaration to a second of its motion.

Seconds of processor time of each step. Compiling is what the first run takes beyond a second one,
with an empty cache: parameters and start are read, and programs written.
"""

from __future__ import annotations

import argparse
import json
import os
import tempfile
from collections.abc import Callable
from time import process_time
from typing import TypeVar

Made = TypeVar("Made")


def timed(make: Callable[[], Made]) -> tuple[Made, float]:
    began = process_time()
    made = make()
    return made, process_time() - began


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("family")
    parser.add_argument("size", type=int)
    choice = parser.parse_args()
    with tempfile.TemporaryDirectory() as cache:
        os.environ["POLHODE_CACHE"] = cache
        print(json.dumps(measured(choice.family, choice.size)))


def measured(family: str, size: int) -> dict[str, float]:
    from families import FAMILIES

    import polhode as ph
    import polhode.simulate  # imported before anything is timed

    member = FAMILIES[family](size)
    equations, derive = timed(lambda: ph.derive(member.system))
    _, reactions = timed(lambda: equations.components)
    _, printing = timed(lambda: str(equations))

    def second() -> ph.Trajectory:
        return ph.simulate(equations, member.parameters, member.start, 1.0)

    _, first = timed(second)
    run, again = timed(second)
    return {
        "derive": derive + reactions,
        "print": printing,
        "compile": first - again,
        "run": again,
        "drift": float(run.drift.energy),
    }


if __name__ == "__main__":
    main()
