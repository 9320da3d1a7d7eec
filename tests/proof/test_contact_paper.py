"""Thousands of random sheets under a ball, of sheets with an edge, and of balls that slide."""

import numpy as np
import pytest

from oracles.ball_on_paper import follow
from polhode.base import PolhodeError
from proof.ledger import Ledger
from simulate.contact import edges
from simulate.contact import test_sliding_ball as sliding
from simulate.contact.paper import case
from simulate.contact.test_paper import GRID, check

FIRST, EACH, BATCHES = 100_000, 210, 10
EDGES = 100  # sheets with an edge, of every kind
GRAZES = 1e-7  # an acceleration so near the static limit may pass it or not


@pytest.mark.parametrize("batch", range(BATCHES))
def test_ball_on_paper(batch: int, ledger: Ledger) -> None:
    for seed in range(FIRST + batch * EACH, FIRST + (batch + 1) * EACH):
        one = case(seed)
        ledger.part = ("analytic", "jerks", "noisy splines", "reversals")[seed % 4]
        ledger.cases += 1
        try:
            run = one.run()
        except PolhodeError as error:
            ledger.failures.append(f"seed {seed} is lost: {error}")
            continue
        course = follow(one.ball, one.sheet, np.zeros(2), one.velocity, GRID)
        for name, size in check(one, run, course).items():
            if name == "switches" and course.nearest_limit < GRAZES:
                ledger.aside += 1
                continue
            ledger.error(float(size), 1.0, 1.0, f"{name}, seed {seed}")


@pytest.mark.parametrize("kind", edges.KINDS)
def test_over_the_edge(kind: str, ledger: Ledger) -> None:
    ledger.part = kind
    for seed in range(FIRST, FIRST + EDGES):
        one = edges.case(seed, kind)
        ledger.cases += 1
        course = one.course()
        try:
            run = one.run()
        except PolhodeError as error:
            ledger.failures.append(f"seed {seed} is lost: {error}")
            continue
        for name, size in edges.check(one, run, course).items():
            if name == "modes" and course.nearest_limit < GRAZES:
                ledger.aside += 1
                continue
            ledger.error(float(size), 1.0, 1.0, f"{name}, seed {seed}")


def test_sliding_ball(ledger: Ledger) -> None:
    for seed in range(FIRST, FIRST + 500):
        ledger.cases += 1
        for name, size in sliding.check(sliding.random_slide(seed)).items():
            ledger.error(size, sliding.EXACT, 1.0, f"{name}, seed {seed}")
