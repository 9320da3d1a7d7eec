"""Values of parameters at run time: signs that a symbol hides in the declaration."""

from math import pi

import pytest

import polhode as ph

lab = ph.Frame("lab")
m, g, R, k, l, h, I = ph.symbols("m g R k l h I")
theta, phi = ph.coordinates("theta phi")
swinging = lab.rotated(theta, "x")


def _run(
    *parts: object, values: dict[object, object], start: dict[object, object]
) -> ph.Trajectory:
    return ph.simulate(ph.System(*parts, ph.Gravity(g)), {m: 1, g: 9.81, **values}, start, "2 s")


def _ball(radius: float) -> ph.Trajectory:
    ball = ph.sphere("ball", mass=m, radius=R, axes=lab)
    return _run(ph.Rolling(ball, on=ph.Plane(lab)), values={R: radius}, start={"v_x": 1})


def _sprung(length: float) -> ph.Trajectory:
    bob = ph.point_mass("bob", mass=m, axes=lab)
    spring = ph.Spring(bob.point(), lab.zero, stiffness=k, length=l)
    return _run(bob, spring, values={k: 40, l: length}, start={"z": -1})


def _disk(radius: float) -> ph.Trajectory:
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    disk = ph.disk("disk", mass=m, radius=R, axes=axes)
    start = {theta: 1.2, "omega_3": 5}
    return _run(ph.Rolling(disk, on=ph.Plane(lab)), values={R: radius}, start=start)


def _sledge(height: float) -> ph.Trajectory:
    block = ph.Body("block", mass=m, axes=lab, inertia=(I, I, I), surface=ph.Face(h))
    contact = ph.Smooth(block, on=ph.Plane(lab))
    return _run(contact, values={h: height, I: 0.01}, start={"v_x": 1})


@pytest.mark.parametrize(
    ("run", "size", "told"),
    [
        (_ball, 0.1, "radius of a sphere: R = -0.1"),
        (_disk, 0.1, "radius of a rim: R = -0.1"),
        (_sprung, 0.5, "length of 'spring': l = -0.5"),
        (_sledge, 0.2, "height above the face: h = -0.2"),
    ],
)
def test_a_length_that_no_body_can_have_is_refused_when_its_value_is_known(run, size, told):
    run(size)
    with pytest.raises(ph.DeclarationError) as refused:
        run(-size)
    assert told in str(refused.value)


def _pendulum(length: float, angle: float) -> ph.Trajectory:
    bob = ph.Body("bob", mass=m, inertia=(I, I, I), axes=swinging)
    rod = ph.Pivot(bob, at=swinging["z"] * l)
    return _run(rod, values={l: length, I: 0.01}, start={theta: angle})


def test_a_rod_of_negative_length_points_the_other_way():
    """A component of a vector has a sign: the pendulum is the one turned by half a turn."""
    back, ahead = _pendulum(-0.7, 0.4), _pendulum(0.7, 0.4 + pi)
    assert back.final["theta"] + pi == pytest.approx(ahead.final["theta"], abs=1e-12)


def test_a_length_declared_positive_is_refused_wherever_it_stands():
    (length,) = ph.symbols("L", positive=True)
    bob = ph.Body("bob", mass=m, inertia=(I, I, I), axes=swinging)
    with pytest.raises(ph.DeclarationError, match="L = -1"):
        _run(ph.Pivot(bob, at=swinging["z"] * length), values={length: -1, I: 0.01}, start={})
