"""Starts that a text states by initial values, and what it draws from them.

A bead in a straight tube that turns freely: (J + m r²) θ̇ is conserved, and so is the energy,
(m/2) ṙ² + (1/2)(J + m r²) θ̇². From ṙ = 0 at r = b they give ṙ² in closed form.
"""

from functools import cache

import pytest

import polhode as ph
from judge.marking import blamed

TRUE, ERROR, STATED = ph.Mark.TRUE, ph.Mark.ERROR, ph.Mark.NOT_JUDGED


@cache
def bead() -> ph.Equations:
    m, J, M, g = ph.symbols("m J M g", positive=True)
    lab = ph.Frame("lab")
    axes = lab.rotated(ph.coordinate("theta"), "z", labels="1 2 3")
    tube = ph.Body("tube", mass=M, inertia=(J, J, J), axes=axes, spin=ph.WithAxes(), tag="t")
    pearl = ph.point_mass("bead", mass=m, axes=axes)
    return ph.derive(
        ph.System(
            ph.Pivot(tube, name="axle"),
            ph.Hinge(tube, axis="3", name="bearing"),
            ph.Slider(pearl, axis="1", to=tube.point(), distance="r", name="guide", force="N"),
            ph.Gravity(g),
            name="bead in a tube",
        )
    )


def marks(text: str) -> list[ph.Mark]:
    return [blamed(line) for line in ph.review(text, bead(), format=".md", seconds=5.0).lines]


TEXT = r"""The angular momentum is a constant, $(J + m r^2)\dot\theta = C$.

%s so that
$$ C = %s(J + mb^2)\omega_0 . $$
It turns ever more slowly, at the rate
$$ \dot\theta = \frac{(J + mb^2)\omega_0}{J + mr^2} , $$
and by energy
$$ \dot r^2 = \frac{\omega_0^2(J + mb^2)(r^2 - b^2)}{J + %smr^2} . $$
"""
STARTS = (
    r"Initially $r = b$, $\dot r = 0$ and $\dot\theta = \omega_0$,",
    r"With the initial conditions $r = b$, $\dot r = 0$ and $\dot\theta = \omega_0$,",
    r"At $t = 0$ we have $r = b$, $\dot r = 0$ and $\dot\theta = \omega_0$,",
)


@pytest.mark.parametrize("start", STARTS)
def test_letters_of_a_start_stand_in_what_is_drawn_from_it(start: str) -> None:
    found = marks(TEXT % (start, "", ""))
    assert found[-3:] == [TRUE, TRUE, TRUE]
    assert found[0] is TRUE  # that it is conserved
    assert set(found[1:-3]) == {STATED}


def test_a_wrong_value_of_a_constant_of_the_motion_is_named() -> None:
    assert marks(TEXT % (STARTS[0], "2", ""))[-3:] == [ERROR, TRUE, TRUE]


def test_a_slip_behind_a_start_is_no_truth() -> None:
    assert marks(TEXT % (STARTS[0], "", "2"))[-3:-1] == [TRUE, TRUE]
    assert marks(TEXT % (STARTS[0], "", "2"))[-1] is not TRUE


AT_ZERO = r"""From $r(0) = b$, $\dot r(0) = 0$ and $\dot\theta(0) = \omega_0$ follows
$$ (J + m r^2)\dot\theta = %s(J + mb^2)\omega_0 . $$
As $r(0) = b$ we have
$$ \dot r^2 = \frac{\omega_0^2(J + mb^2)(r^2 - b^2)}{J + mr^2} . $$"""


def test_values_at_zero_are_a_start() -> None:
    assert marks(AT_ZERO % "") == [STATED, STATED, STATED, TRUE, STATED, TRUE]
    assert marks(AT_ZERO % "2")[3] is not TRUE


def test_several_letters_are_set_to_zero_at_once() -> None:
    text = r"""At rest at first, $r(0) = \dot r(0) = \dot\theta(0) = 0$, it stays there:
$$ (J + mr^2)\dot\theta = 0 . $$"""
    assert marks(text) == [STATED, TRUE]
    odd = ph.check(r"\dot\theta = r = 0", bead())
    assert not odd.holds
    assert not odd.at_odds


def test_a_condition_that_no_body_meets_is_a_claim() -> None:
    """The moment of inertia of a ball about a diameter is 2/5 of its mass and radius squared."""
    m, a, g = ph.symbols("m a g", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    equations = ph.derive(ph.System(ph.Rolling(ball, on=ph.Plane(lab)), ph.Gravity(g)))
    for number, mark in (("2", TRUE), ("3", ERROR)):
        text = rf"It has $T_{{\rm rot}} = \frac12 I\omega^2$, where $I = \frac{number}{{5}}ma^2$."
        lines = ph.review(text, equations, format=".md", seconds=5.0).lines
        assert blamed(lines[-1]) is mark, lines[-1]


@cache
def rolling_inside() -> ph.Equations:
    """A cylinder of radius r that rolls in one of radius R: its closed loop is (R - r) θ = r φ."""
    m, R, r, g = ph.symbols("m R r g", positive=True)
    lab = ph.Frame("lab")
    theta, phi = ph.coordinates("theta phi")
    line = lab.rotated(-theta, "y")
    moments = (m * r**2, m * r**2 / 2, m * r**2)
    cylinder = ph.Body("cylinder", mass=m, inertia=moments, axes=lab.rotated(phi, "y"))
    return ph.derive(
        ph.System(
            ph.Pivot(cylinder, to=line["z"] * (r - R), along=line, name="wall", force="N"),
            ph.Hinge(cylinder, axis="y", name="level axis"),
            ph.Constraint((R - r) * theta - r * phi, on=cylinder, name="rolling", force="f"),
            ph.Gravity(g),
        )
    )


@pytest.mark.parametrize(
    ("share", "marks_due"),
    [("34", {ph.Mark.TRUE, ph.Mark.NEEDS}), ("12", {ph.Mark.ERROR, ph.Mark.DOUBT})],
)
def test_energy_between_two_places_of_a_body_in_a_closed_loop(share, marks_due) -> None:
    """Where θ = 0 so is φ, and not the radius: I = m r²/2, so that T = (3/4) m v²."""
    text = rf"""It starts from rest at $\theta = \theta_0$. At $\theta = 0$ by energy
    $$ \frac{share} mv^2 = mg(R - r)(1 - \cos\theta_0) . $$"""
    lines = ph.review(text, rolling_inside(), format=".md", seconds=5.0).lines
    assert blamed(lines[-1]) in marks_due, lines[-1]
