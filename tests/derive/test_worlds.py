"""Rotating the world, moving its origin, or telling things in another order changes nothing."""

from fractions import Fraction
from functools import cache

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polhode as ph
from derive import declarations as declared
from derive.declarations import LAB
from polhode.derive import Equations

BUILDERS = [declared.rolling, declared.sliding, declared.marble, declared.top]

angles = st.one_of(
    st.integers(-23, 23).map(lambda n: ph.pi * n / 12),
    st.just(ph.symbol("beta")),
    st.just(2 * ph.symbol("gamma") - ph.pi / 3),
)
directions = st.one_of(
    st.sampled_from(["x", "y", "z"]),
    st.tuples(st.integers(-3, 3), st.integers(-3, 3)).map(
        lambda pair: unit(Fraction(pair[0], 2), Fraction(pair[1], 3))
    ),
)
worlds = st.lists(st.tuples(angles, directions), min_size=1, max_size=2)


def unit(p: Fraction, q: Fraction) -> tuple[Fraction, Fraction, Fraction]:
    """A unit vector with rational components, by stereographic projection."""
    below = 1 + p * p + q * q
    return 2 * p / below, 2 * q / below, (p * p + q * q - 1) / below


def turned(steps: list[tuple[ph.Expr, object]]) -> ph.Frame:
    """A world turned out of the laboratory by constant angles."""
    world = LAB
    for angle, about in steps:
        world = world.rotated(angle, about)
    return world


@cache
def at_home(build) -> Equations:
    return build(LAB)


@pytest.mark.parametrize("build", BUILDERS)
@settings(max_examples=6)
@given(steps=worlds)
def test_a_world_turned_as_a_whole_looks_the_same(build, steps) -> None:
    home, away = at_home(build), build(turned(steps))
    assert away.rows == home.rows
    assert away.components == home.components
    assert away.energy == home.energy
    assert away.kinematics == home.kinematics


def test_a_support_turned_without_gravity_does_not() -> None:
    world = LAB.rotated(ph.symbol("beta"), "x")
    contact = ph.Rolling(declared.wheel(declared.following(world)), on=ph.Plane(world))
    tilted = ph.derive(ph.System(contact, declared.gravity(LAB)))
    assert tilted.rows != at_home(declared.rolling).rows


def test_directions_of_the_turning_earth_may_be_named_as_one_likes() -> None:
    """The x-axis of one is the z-axis of the other: the same compass by other names."""
    first, second = compass("up east north", "x", "y", "z"), compass("north up east", "y", "z", "x")
    assert first.rows == second.rows
    assert first.least["tau_2"] == second.least["tau_2"]


def compass(directions: str, up: str, east: str, north: str) -> Equations:
    """An axle in the horizontal plane of the turning Earth, whose directions have these labels."""
    ground = ph.earth(ph.symbol("Omega"), colatitude=ph.symbol("lambda_"), directions=directions)
    labels = {up: "1", east: "2", north: "3"}
    axes = ground.rotated(
        -declared.theta, up, labels=" ".join(labels[label] for label in ground.labels)
    )
    moments = {"1": declared.I_1, "2": declared.I_1, "3": declared.I_3}
    rotor = ph.Body(
        "rotor",
        mass=declared.m,
        inertia=[moments[label] for label in axes.labels],
        axes=axes,
        spin=ph.Relative("3"),
    )
    guide = ph.Guide(rotor, axis="3", normal=ground[up], label="2")
    return ph.derive(ph.System(ph.Pivot(rotor), guide))


def test_the_origin_may_be_anywhere() -> None:
    where = LAB.vector(*ph.symbols("c_1 c_2 c_3"))
    home, away = at_home(declared.top), declared.top(LAB, at=where)
    assert away.rows == home.rows
    assert away.components == home.components
    assert away.kinetic_energy == home.kinetic_energy
    raised = declared.m * declared.g * ph.symbol("c_3")
    assert away.potential_energy == home.potential_energy + raised
    assert away.angular_momentum(where).components == home.angular_momentum().components


def test_angular_momentum_moves_with_the_point_it_is_about() -> None:
    equations = at_home(declared.top)
    where = LAB.vector(*ph.symbols("c_1 c_2 c_3"))
    shifted = equations.angular_momentum() - where.cross(equations.linear_momentum)
    assert equations.angular_momentum(where).components == shifted.components


@given(order=st.permutations(range(4)))
def test_the_parts_of_a_system_may_come_in_any_order(order) -> None:
    lab, axes = LAB, declared.following(LAB)
    rod = ph.rod("rod", mass=declared.m, length=declared.a, axes=axes, axis="3")
    bob = ph.point_mass("bob", mass=declared.I_2, axes=axes)
    parts = [
        ph.Pivot(rod, at=axes["3"] * (declared.a / 2)),
        ph.Pivot(bob, to=rod.point(axes["3"] * (-declared.a / 2)), name="tip", force="G"),
        ph.Gravity(declared.g),
        ph.Force(bob.point(axes.zero), lab["x"] * ph.symbol("P")),
    ]
    straight = ph.derive(ph.System(*parts))
    mixed = ph.derive(ph.System(*(parts[i] for i in order)))
    assert set(mixed.speeds) == set(straight.speeds)
    assert dict(zip(mixed.speeds, mixed.rows, strict=True)) == dict(
        zip(straight.speeds, straight.rows, strict=True)
    )
    assert mixed.components == straight.components


@pytest.mark.parametrize("build", [declared.rolling, declared.marble, declared.top])
def test_forces_are_the_same_along_any_directions(build) -> None:
    """Naming the components of a reaction along other axes changes the names, not the force."""
    equations = at_home(build)
    (reaction,) = equations.reactions.values()
    frame = LAB.rotated(ph.symbol("beta"), "y").rotated(declared.phi, "x")
    there = reaction.force.express(frame)
    assert there.express(LAB).components == reaction.force.express(LAB).components
    assert there.dot(there) == reaction.force.dot(reaction.force)


def test_a_pivot_named_along_other_axes_pushes_the_same() -> None:
    axes = declared.following(LAB)
    body = ph.Body(
        "top", mass=declared.m, inertia=(declared.I_1,) * 2 + (declared.I_3,), axes=axes,
        spin_about="3",
    )  # fmt: skip
    pivot = ph.Pivot(body, at=axes["3"] * -declared.a, along=axes)
    named = ph.derive(ph.System(pivot, ph.Gravity(declared.g)))
    home = at_home(declared.top)
    assert set(named.components) == {"F_1", "F_2", "F_3"}
    assert named.rows == home.rows
    forces = (e.reactions["pivot"].force.express(LAB).components for e in (named, home))
    assert next(forces) == next(forces)
