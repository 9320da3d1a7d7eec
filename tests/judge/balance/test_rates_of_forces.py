"""Rates of reactions: along the motion they change as the motion has it."""

from __future__ import annotations

import pytest

from catalogue.systems import equations
from judge.judged import uncorrected
from polhode.judge import Answer


def judged(system, latex):
    return uncorrected(latex, equations(system))


@pytest.mark.parametrize("system", ["rolling-disk", "spinning-coin"])
def test_a_force_that_changes_is_not_constant(system):
    """The second opinion differentiates forces of its own along a motion of its own."""
    verdict = judged(system, r"\dot F_z = 0")
    assert verdict.answer is Answer.FAILS
    assert verdict.confirmation is not None
    assert verdict.confirmation.agrees


def test_a_force_that_is_constant_has_no_rate():
    assert judged("ball-on-paper", r"\frac{d F_z}{d t} = 0").answer is Answer.HOLDS


def test_the_rate_of_a_force_is_that_of_newtons_second_law():
    """F_z is what gravity leaves of the acceleration of the centre of mass."""
    law = r"F_z = M g + M \frac{d^2}{d t^2}(a \cos\theta)"
    rate = r"\dot F_z = M a \frac{d^3 \cos\theta}{d t^3}"
    assert judged("gyroscope", law).answer is Answer.HOLDS
    assert judged("gyroscope", rate).answer is Answer.HOLDS
    assert judged("gyroscope", rate.replace("M a", "2 M a")).answer is Answer.FAILS


def test_forces_that_share_a_load_somehow_share_its_rate():
    """How the two pivots share the weight is left open, and so is its rate; their sum is not."""
    assert judged("gyroscope/held", r"\dot F'_z = -\dot F_z").answer is Answer.HOLDS
    assert judged("gyroscope/held", r"\dot F'_z = \dot F_z").answer is Answer.FAILS
