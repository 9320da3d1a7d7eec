"""Declarations print as lines that can be read."""

import pytest

import polhode as ph
from model.parts import PARTS


@pytest.mark.parametrize("part", PARTS.values(), ids=PARTS)
def test_every_line_is_short_and_none_is_raw(part):
    lines = str(part).splitlines()
    assert lines[0].startswith(f"{type(part).__name__} {part.name!r}")
    assert max(map(len, lines)) < 110
    assert not any("=" in line or "None" in line for line in lines)


def test_a_contact_names_what_touches_what():
    lab = ph.Frame("lab")
    m, a = ph.symbols("m a", positive=True)
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    table = ph.Turntable(lab, ph.symbol("Omega"))
    assert str(ph.Coulomb(ball, on=table, mu=0.3, name="felt")).splitlines() == [
        "Coulomb 'felt'",
        "  body         ball",
        "  on           Turntable in lab (x y z), z up",
        "  force        F",
        "  restitution  0",
        "  mu           3/10",
        "  mu static    3/10",
        "  viscous      0",
    ]
    assert str(table).splitlines()[-1].split() == ["Omega", "Omega"]
    assert str(ball.point(lab["z"] * a)).startswith("point (0, 0, a) along lab (x y z) of ball")


m, a, g = ph.symbols("m a g", positive=True)
theta, phi = ph.coordinates("theta phi")
lab = ph.Frame("lab")
turned = lab.rotated(phi, "z", name="turned")
axes = turned.rotated(theta, "x", labels="1 2 3", name="axes")
disk = ph.disk("disk", mass=m, radius=a, axes=axes)
rolls = ph.System(ph.Rolling(disk, on=ph.Plane(lab)), ph.Gravity(g), name="roll")


def test_symbols_and_frames() -> None:
    assert repr(ph.derive(rolls).speeds) == "(phi_dot, theta_dot, omega_3)"
    assert repr(lab) == "Frame lab (x y z)"
    assert repr(axes) == "Frame axes (1 2 3): turned turned by theta about x"


def test_vectors_and_bodies() -> None:
    assert repr(axes["3"] * a) == "(0, 0, a) along axes (1 2 3)"
    assert repr(disk) == (
        "Body 'disk': mass m, inertia (m*a**2/4, m*a**2/4, m*a**2/2) along axes (1 2 3)"
    )


def test_a_full_inertia_is_shown_by_rows() -> None:
    stone = ph.Body("stone", mass=m, inertia=((3, 1, 0), (1, 3, 0), (0, 0, 3)), axes=axes)
    assert "[[3, 1, 0], [1, 3, 0], [0, 0, 3]]" in repr(stone)


def test_systems_and_what_is_found() -> None:
    assert repr(rolls) == "System 'roll': Body 'disk', Rolling 'contact', Gravity 'gravity'"
    families = ph.steady(ph.derive(rolls), {theta: ph.pi / 2})
    assert repr(families[0]) == "SteadyMotion: theta = pi/2, phi_dot = 0"
    assert str(ph.invariants(ph.derive(rolls))).startswith("E = ")


def test_a_motion() -> None:
    run = ph.simulate(rolls, {m: 1, a: 1, g: 9.81}, {theta: 1, "omega_3": 20}, 0.1)
    assert repr(run) == "Trajectory of 'roll' over 0.1 s: rolling; 2 events"


def test_a_pivot_is_at_rest_only_where_it_holds_a_point_that_does_not_move():
    """One carried round in time moves, though no coordinate says so."""
    b, Omega = ph.symbols("b Omega")
    rod = ph.rod("rod", mass=m, length=a, axes=axes, axis="3")
    other = ph.rod("other", mass=m, length=a, axes=axes, axis="3", tag="2")
    carried = lab.rotated(Omega * ph.time, "z", name="carried")
    at = axes["3"] * (a / 2)
    assert ph.Pivot(rod, at=at).is_at_rest
    assert ph.Pivot(rod, at=at, to=lab["x"] * b).is_at_rest
    assert not ph.Pivot(rod, at=at, to=carried["x"] * b).is_at_rest
    assert not ph.Pivot(rod, at=at, to=turned["x"] * b).is_at_rest
    assert not ph.Pivot(rod, at=at, to=other.point(at)).is_at_rest
    assert not ph.Pivot(rod, at=at, only="z").is_at_rest
