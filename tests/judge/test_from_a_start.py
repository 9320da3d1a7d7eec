"""Lines about a motion from a start: a rod that falls over on smooth ice, and a ladder.

Its centre falls straight down. By energy, θ̇² (1/3 + sin²θ) = 2 (g/l)(1 - cos θ), so that θ̇² is
3g/2l where it lies flat, with its middle moving at l θ̇.
"""

import runpy
from functools import cache
from pathlib import Path

import pytest

import polhode as ph
from judge import textbook_systems as systems
from judge.marking import blamed
from polhode.judge import Answer

TRUE, ERROR, FOLLOWS = ph.Mark.TRUE, ph.Mark.ERROR, ph.Mark.FOLLOWS

TEXT = r"""
Energy, starting from rest at $\theta=0$:
$$ \tfrac12 m l^2\sin^2\theta\,\dot\theta^2 + \tfrac16 m l^2\dot\theta^2 = mgl(1-\cos\theta) $$
so that
$$ \dot\theta^2 = \frac{%s g}{l}\,\frac{1-\cos\theta}{1+3\sin^2\theta} . $$
Just before the rod hits the floor, $\theta = \pi/2$:
$$ \dot\theta = %s, \qquad v = %s, \qquad N = \frac{mg}{4}. $$
"""


@cache
def rod() -> ph.Equations:
    m, l, g = ph.symbols("m l g", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "y", labels="1 2 3")
    body = ph.rod("rod", mass=m, length=2 * l, axes=axes, axis="3")
    floor = ph.Pivot(body, at=axes["3"] * -l, only="y z", name="floor", force="N")
    return ph.derive(ph.System(floor, ph.Gravity(g), name="falling rod"))


def marks(*values: str) -> list[ph.Mark]:
    found = ph.review(TEXT % values, rod(), format=".md", seconds=0.0).lines
    return [blamed(line) for line in found if blamed(line) is not ph.Mark.NOT_JUDGED]


def test_what_energy_gives_for_a_motion_out_of_equilibrium_is_true():
    assert marks("6", r"\sqrt{\frac{3g}{2l}}", r"\sqrt{\frac{3gl}{2}}") == [TRUE] * 5


def test_a_wrong_factor_is_named_and_what_is_put_into_it_follows():
    found = marks("3", r"\sqrt{\frac{3g}{4l}}", r"\sqrt{\frac{3gl}{2}}")
    assert found == [TRUE, ERROR, FOLLOWS, TRUE, TRUE]


@pytest.mark.parametrize(("factor", "answer"), [("6", Answer.HOLDS), ("3", Answer.UNREAD)])
def test_that_nothing_moves_in_equilibrium_proves_no_equation(factor, answer):
    claim = rf"\dot\theta^2 = \frac{{{factor} g}}{{l}}\,\frac{{1-\cos\theta}}{{1+3\sin^2\theta}}"
    start = (r"\theta = 0", r"\dot\theta = 0")
    verdict = ph.check(claim, rod(), context="launch", given=start)
    assert verdict.answer is answer
    if answer is Answer.UNREAD:
        assert "fails for a motion that leaves it" in verdict.reason


# A ladder of length 2l from rest at θ₀ to the vertical: θ̇² = (3g/2l)(cos θ₀ - cos θ). The wall's
# force, proportional to sin θ (3 cos θ - 2 cos θ₀), vanishes where cos θ = (2/3) cos θ₀.
LADDER = r"""\[ T = \tfrac12 m l^2\dot\theta^2 + \tfrac12\cdot\tfrac1{%s} m l^2\dot\theta^2
= %s ml^2\dot\theta^2, \qquad V = mgl\cos\theta . \]
The ladder is released from rest at $\theta=\theta_0$. Conservation of energy gives
\[ \dot\theta^2 = \frac{%s g}{l}(\cos\theta_0-\cos\theta), \] and differentiating
\[ \ddot\theta = \frac{%s g}{2l}\sin\theta . \]"""
WALL = r"""The ladder is released from rest at $\theta=\theta_0$. It leaves the wall when
\[ \cos\theta = %s\cos\theta_0 . \]"""


def ladder_marks(text: str) -> list[ph.Mark]:
    system = Path(__file__).parents[2] / "docs/examples/solutions/sliding_ladder.py"
    equations = ph.derive(runpy.run_path(str(system))["sliding_ladder"])
    return [blamed(line) for line in ph.review(text, equations, format=".tex", seconds=0.0).lines]


def test_a_wrong_moment_of_inertia_is_carried_on_by_the_energy_since_the_start():
    start, energy = [ph.Mark.NOT_JUDGED], r"\tfrac32"
    right = (3, r"\tfrac23", energy, energy)
    assert ladder_marks(LADDER % right) == [TRUE, TRUE, *start, TRUE, TRUE]
    wrong = r"\tfrac{24}{13}"
    found = ladder_marks(LADDER % (12, r"\tfrac{13}{24}", wrong, wrong))
    assert found == [ERROR, TRUE, *start, FOLLOWS, FOLLOWS]
    other = ladder_marks(LADDER % (12, r"\tfrac{13}{24}", r"\tfrac{23}{13}", wrong))
    assert other[3] is ERROR


@pytest.mark.parametrize(
    ("factor", "mark"), [(r"\tfrac23", TRUE), (r"\tfrac13", ph.Mark.NOT_JUDGED)]
)
def test_a_condition_is_true_at_which_a_reaction_vanishes(factor, mark):
    assert ladder_marks(WALL % factor)[-1] is mark


# A body with I₂ about its hinge. With another moment θ̇² differs, although θ̇ vanishes at the start.
RELEASED = r"""Released from rest at $\theta_0$:
$\dot\theta^2 = \frac{2mgl}{I_%s+ml^2}(\cos\theta-\cos\theta_0)$."""


@pytest.mark.parametrize(("index", "mark"), [("2", TRUE), ("1", ERROR)])
def test_what_vanishes_at_the_start_is_not_true_of_it_alone(index, mark):
    system = Path(__file__).parents[2] / "docs/examples/solutions/physical_pendulum.py"
    equations = ph.derive(runpy.run_path(str(system))["physical_pendulum"])
    (line,) = ph.review(RELEASED % index, equations, format=".md", seconds=0.0).lines
    assert blamed(line) is mark


# A rod of length 2l on a hinge at its end: θ̈ = -(3g/4l) sin θ, and by energy the pivot carries
# 5/2 of the weight below, 1/4 of it where the rod is level and at rest.
SWING = r"""It is released from rest at $\theta_0 = \pi/2$.
At the moment of release, $\theta = \pi/2$, the acceleration is $\ddot\theta = -\frac{3g}{%sl}$,
and the pivot carries $N = \frac14 mg$."""


@cache
def swinging_rod() -> ph.Equations:
    m, l, g = ph.symbols("m l g", positive=True)
    axes = ph.Frame("lab").rotated(-ph.coordinate("theta"), "y", labels="1 2 3")
    body = ph.rod("rod", mass=m, length=2 * l, axes=axes, axis="3")
    pivot = ph.Pivot(body, at=axes["3"] * l, name="pivot", force="F")
    hinge = ph.Hinge(body, axis="2")
    return ph.derive(ph.System(pivot, hinge, ph.Gravity(g), name="swinging rod"))


@pytest.mark.parametrize(("factor", "mark"), [("4", TRUE), ("2", ERROR)])
def test_what_holds_at_the_moment_of_release(factor, mark):
    found = ph.review(SWING % factor, swinging_rod(), format=".tex", seconds=0.0).lines
    marks = [blamed(line) for line in found if blamed(line) is not ph.Mark.NOT_JUDGED]
    assert marks == [mark, TRUE]


# Billiards along a line: v = v₀ - μgt and Rω = 5μgt/2 until they are equal, at t = 2v₀/7μg.
BILLIARDS = r"""A ball, $I=\frac25MR^2$, slides with $v_x=v_0$ and no rotation at first. Friction is
\[ F_x = -\mu Mg, \qquad I\dot\omega_y = %s\mu MgR . \] It rolls after
\[ t = \frac{2v_0}{7\mu g} . \]"""


@pytest.mark.parametrize(("factor", "mark"), [("", ph.Mark.NEEDS), ("2", ERROR)])
def test_sliding_along_a_line_needs_that_nothing_else_moves(factor, mark):
    lines = ph.review(BILLIARDS % factor, systems.sliding_ball(), seconds=0.0).lines
    assert [blamed(line) for line in lines if blamed(line) is not ph.Mark.NOT_JUDGED] == [
        TRUE,
        ph.Mark.NEEDS,
        mark,
    ]
    friction = lines[2]
    assert friction.needs.endswith(r"R \omega_y - v_x < 0")
    assert r"v_y = 0" in friction.needs
