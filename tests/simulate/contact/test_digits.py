"""The ball on its sheet, and the oracle of it, against power series in twenty-two digits."""

import numpy as np
import pytest
from flint import arb

from oracles import ball_on_paper, ball_on_paper_digits
from simulate.contact.paper import NAMES, Case, case

# Slip begins at once, at 0.1829 s, with 130 times the acceleration that friction can follow.
ABRUPT = 100_250


def in_digits(one: Case, times: np.ndarray) -> np.ndarray:
    """Place and velocity, shape (times, 4)."""
    own = one.ball
    k, mu, mu_static, g = (arb(float(value)) for value in (own.k, own.mu, own.mu_static, own.g))
    ball = ball_on_paper_digits.Ball(k, mu, mu_static, g)
    tables = [one.forcing[name].coefficients for name in NAMES]
    sheet = ball_on_paper_digits.pieces(one.forcing["X"].knots, tables)
    velocity = [arb(float(v)) for v in one.velocity]
    course = ball_on_paper_digits.follow(ball, sheet, velocity, times)
    rows = zip(course.places, course.velocities, strict=True)
    return np.array([[float(value) for value in (*place, *v)] for place, v in rows])


def errors(one: Case, times: np.ndarray) -> tuple[float, float]:
    """Of ours, and of the oracle in doubles."""
    right = in_digits(one, times)
    ours = np.array(list(one.run().table(["x", "y", "v_x", "v_y"], times).values())).T
    course = ball_on_paper.follow(one.ball, one.sheet, np.zeros(2), one.velocity, times)
    oracle = np.hstack([course.places, course.velocities])
    return float(np.abs(ours - right).max()), float(np.abs(oracle - right).max())


@pytest.mark.parametrize(("seed", "until"), [(1, 0.5), (ABRUPT, 0.25)])
def test_the_beginning_of_slip(seed: int, until: float) -> None:
    ours, oracle = errors(case(seed), np.array([0.19, until]))
    assert ours < 1e-14
    assert oracle < 1e-11
