"""Values of parameters at run time: signs that a symbol hides in the declaration."""

from math import pi

import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE

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


# -- formulas of other parameters ------------------------------------------------------------------


@pytest.mark.parametrize("name", CATALOGUE)
def test_the_defaults_of_the_catalogue_are_values_that_simulate_takes(name):
    entry = CATALOGUE[name]
    defaults = {parameter.name: parameter.default for parameter in entry.parameters}
    forcing = dict(entry.forcing)
    run = ph.simulate(
        entry.build(), defaults, dict(entry.start), "10 ms", forcing=forcing, samples=2
    )
    assert run.final.keys() >= set(entry.start)


def test_a_formula_follows_the_values_in_it():
    """The moment m a²/2 of 0.2 kg and 30 mm; the radius is no parameter of the compass itself."""
    entry = CATALOGUE["gyrocompass"]
    values = {p.name: p.default for p in entry.parameters} | {"m": "0.2 kg", "a": "30 mm"}
    run = ph.simulate(entry.build(), values, dict(entry.start), "10 ms", samples=2)
    assert run.parameters["I_1"] == pytest.approx(0.2 * 0.03**2 / 2, rel=1e-15)
    fine = ph.simulate(
        entry.build(), values, dict(entry.start), "10 ms", samples=2, precision="quadruple"
    )
    for name, value in run.segments[0].state(0.01).items():
        assert float(fine.final[name]) == pytest.approx(value, rel=1e-11, abs=1e-11)


def test_formulas_in_a_circle_or_of_unknown_values_are_refused():
    system = CATALOGUE["rolling-disk"].build()
    start, m = {"theta": 1.3}, ph.symbol("m")
    values = {"m": 1, "g": 9.81}
    with pytest.raises(ph.DeclarationError, match="depend on one another"):
        ph.simulate(system, {"m": "2*a", "a": "m/2", "g": 9.81}, start, 1)
    with pytest.raises(ph.DeclarationError, match="no value for r"):
        ph.simulate(system, values | {"a": ph.symbol("r") / 2}, start, 1)
    with pytest.raises(ph.UnitError, match=r"a: .r/2. is not a"):
        ph.simulate(system, values | {"a": "r/2"}, start, 1)
    with pytest.raises(ph.DeclarationError, match="'b' is no parameter"):
        ph.simulate(system, values | {"a": 1, "b": 2}, start, 1)
    run = ph.simulate(system, values | {"a": m / 10}, start, 0.01, samples=2)
    assert run.parameters["a"] == 0.1
    with pytest.raises(ph.DeclarationError, match="values given as a NoneType"):
        ph.simulate(system, None, start, 1)
