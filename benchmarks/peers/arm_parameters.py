"""The arms of the peers: numbers and states, as in ours/families.py."""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable, Sequence
from time import process_time

LENGTH, CENTRE, MASS, MOMENTS = 0.5, 0.2, 1.0, (0.02, 0.03, 0.01)
GRAVITY = 9.81
EVALUATIONS = 20000


def report(description: str, prepare: Callable[[int], Callable[[], Sequence[float]]]) -> None:
    """Time one evaluation of the accelerations of an arm whose size is given.

    Args:
        description: of the script.
        prepare: returns, for a number of links, a function that evaluates the accelerations.
    """
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("links", type=int)
    links = parser.parse_args().links
    evaluate = prepare(links)
    answer = {f"q_{k + 1}_ddot": float(value) for k, value in enumerate(evaluate())}
    began = process_time()
    for _ in range(EVALUATIONS):
        evaluate()
    seconds = (process_time() - began) / EVALUATIONS
    print(json.dumps({"seconds": seconds, "answer": answer}))


def state(links: int) -> tuple[list[float], list[float]]:
    """Angles and rates."""
    return [0.1 * k for k in range(1, links + 1)], [0.2 * k for k in range(1, links + 1)]
