"""A ball that falls into a groove and lands on both of its sides at the same time."""

from math import cos, pi, sin, sqrt

import pytest

import polhode as ph

LAB = ph.Frame("lab")
m, R, g, beta = ph.symbols("m R g beta", positive=True)
BALL = ph.sphere("ball", mass=m, radius=R, axes=LAB)
HEIGHT = 0.4  # of the centre of the ball above the bottom of the groove, m


def groove(kind, **law):
    left = kind(BALL, on=ph.Plane(LAB, tilt=beta), name="left", force="P", **law)
    right = kind(BALL, on=ph.Plane(LAB, tilt=-beta), name="right", force="Q", **law)
    return ph.System(left, right, ph.Gravity(g))


def drop(system, tilt, aside=0.0):
    start = {"y": HEIGHT * sin(tilt) + aside, "z": HEIGHT * cos(tilt)}
    return ph.simulate(system, {m: 1, R: 0.1, g: 9.81, beta: tilt}, start, 1)


@pytest.mark.parametrize("tilt", [0.2, pi / 6, 1.0])
@pytest.mark.parametrize("law", [{}, {"restitution": 0.5}, {"restitution": 1}])
@pytest.mark.parametrize(("kind", "more"), [(ph.Smooth, {}), (ph.Coulomb, {"mu": 0.2})])
def test_bounces_in_no_order(kind, more, law, tilt):
    """Rounding decided which side came first, and the ball went on to one side."""
    with pytest.raises(ph.NumericError, match=r"left lands at t = 0\.\d+ s, and the contact right"):
        drop(groove(kind, **law, **more), tilt)


def test_a_right_angle_uncouples_the_sides():
    """The impulse of one side has no component along the other: both bounce, straight up."""
    run = drop(groove(ph.Smooth, restitution=1), pi / 4)
    fall = sqrt(2 * (HEIGHT - 0.1 * sqrt(2)) / 9.81)  # until the distance to both sides is R
    lands = [event.time for event in run.events if event.kind == "bounces"]
    assert lands == pytest.approx([fall, fall, 3 * fall, 3 * fall], rel=1e-12)
    assert run["y"] == pytest.approx(run["z"], abs=1e-12)


def test_lands_one_after_the_other():
    run = drop(groove(ph.Smooth, restitution=1), 0.2, aside=0.02)
    assert [event.kind for event in run.events][1:3] == ["bounces", "bounces"]
    assert run.drift.energy < 1e-13
