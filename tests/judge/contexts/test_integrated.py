"""Relations that a text integrates, true but for the constant of integration."""

import numpy as np
import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.judge import Answer, CheckRequest

ON_EDGE = ("epsilon = theta - pi/2",)
SMALL = ("epsilon:1", "phi_dot:1")


@pytest.fixture(scope="module")
def disk():
    return ph.derive(PROBLEM_SET["rolling-disk"].build())


def judged(equations, latex, context, given=(), small=SMALL):
    return CheckRequest(latex, context, ON_EDGE, tuple(given), small).judged(equations)


def test_the_steering_of_a_disk_on_edge_is_true_but_for_a_constant(disk):
    verdict = judged(disk, r"\dot\phi = 2\epsilon\omega_3", "limit")
    assert verdict.answer is Answer.AMBIGUOUS
    assert "constant of integration" in verdict.reason


@pytest.mark.parametrize(
    "start", [("theta = pi/2", "phi_dot = 0"), (r"\dot\phi = 2\epsilon\omega_3",)]
)
@pytest.mark.parametrize("sign", ["=", r"\approx"])
def test_it_holds_along_motions_that_start_where_it_is_true(disk, start, sign):
    verdict = judged(disk, rf"\dot\phi {sign} 2\epsilon\omega_3", "launch", start)
    assert verdict.answer is Answer.APPROXIMATE
    assert verdict.order == 2  # the remainder is odd in the departure


def test_its_remainder_shrinks_as_the_cube_of_the_departure(disk):
    """By integrating motions with departures in the ratio of two."""
    parameters = {"m": 0.2, "a": 0.03, "g": 9.81}
    left = []
    for size in (0.02, 0.01):
        start = {"theta": np.pi / 2, "theta_dot": size, "phi_dot": 0.0, "omega_3": 20.0}
        run = ph.simulate(disk, parameters, start, 1.0)
        remainder = run["phi_dot"] - 2 * (run["theta"] - np.pi / 2) * run["omega_3"]
        left.append(np.max(np.abs(remainder)))
    assert left[0] / left[1] == pytest.approx(8, rel=0.01)


@pytest.mark.parametrize(
    ("latex", "given"),
    [
        (r"\dot\phi = 3\epsilon\omega_3", ("theta = pi/2", "phi_dot = 0")),
        (r"\dot\phi = 2\epsilon\omega_3", ("theta = pi/2", "phi_dot = 1")),
        (r"\dot\phi = 2\epsilon\omega_3", ("theta = 2", "phi_dot = 0")),
        (r"\dot\phi = 2\epsilon\omega_3", ("theta = 2", r"\dot\phi = 2\epsilon\omega_3")),
    ],
)
def test_another_factor_or_another_start_is_refuted(disk, latex, given):
    assert judged(disk, latex, "launch", given).answer is Answer.FAILS


def test_what_is_small_must_stay_small():
    """A gyroscope released from rest does not stay at rest: φ̇ = 0 at the start says nothing."""
    top = ph.derive(PROBLEM_SET["gyroscope"].build())
    small = ("phi_dot:1", "theta_dot:1")
    assert judged(top, r"\dot\phi = 0", "limit", small=small).answer is Answer.FAILS
    start = ("theta = pi/3", "theta_dot = 0", "phi_dot = 0")
    assert judged(top, r"\dot\phi = 0", "launch", start, small).answer is Answer.FAILS


def test_a_wrong_constant_is_wrong():
    """ω₁ is constant, but sides that differ in the limit itself lack more than a small constant."""
    top = ph.derive(PROBLEM_SET["gyroscope"].build())
    verdict = judged(top, r"\omega_1 = 2\omega_1", "limit", small=("theta_dot:1",))
    assert verdict.answer is Answer.FAILS
