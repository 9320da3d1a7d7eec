"""Equations that hold only where their gradient vanishes are refused, with what to write."""

from __future__ import annotations

import numpy as np
import pytest

import polhode as ph
from polhode.algebra import as_symbol

LAB = ph.Frame("lab")
M, J, G, A = ph.symbols("m J g a", positive=True)
THETA, PHI = ph.coordinates("theta phi")
X, Y, Z = ph.coordinates("x y z")
WHEEL = ph.Body("wheel", mass=M, inertia=(J, J, J), axes=LAB.rotated(THETA, "y"))
BEAD = ph.point_mass("bead", mass=M, axes=LAB)


def wheel(equation: ph.Expr) -> ph.System:
    """A wheel on an axle, and an equation for its angle."""
    held = ph.Pivot(WHEEL), ph.Hinge(WHEEL, axis="y")
    pull = ph.Force(WHEEL.point(WHEEL.axes["x"] * A), LAB["z"] * G, name="pull")
    return ph.System(*held, ph.Constraint(equation, on=WHEEL, name="stop"), pull)


def bead(equation: ph.Expr) -> ph.System:
    return ph.System(ph.Constraint(equation, on=BEAD, name="wire"), ph.Gravity(G))


@pytest.mark.parametrize(
    ("equation", "instead"),
    [
        (1 - ph.cos(THETA), "theta = 0"),
        (A * (1 + ph.cos(THETA)), "theta = pi"),
        (ph.sin(THETA) - 1, "theta = pi/2"),
        (THETA**2, "theta = 0"),
    ],
)
def test_a_wheel_that_is_held_by_a_square(equation: ph.Expr, instead: str) -> None:
    with pytest.raises(ph.DeclarationError, match=f"'stop': .* gradient .* write {instead} inst"):
        ph.derive(wheel(equation))


def test_the_equation_to_write_instead_gives_the_reaction() -> None:
    """A couple about y against that of the pull at the rim, a x̂ × g ẑ = −a g ŷ."""
    equations = ph.derive(wheel(THETA))
    assert equations.components["Q"].subs({as_symbol(THETA): 0}) == A * G


@pytest.mark.parametrize("equation", [X**2, X**3, (X - Y) ** 2, (1 + X**2) * (X - Y) ** 2])
def test_a_bead_on_a_squared_plane(equation: ph.Expr) -> None:
    with pytest.raises(ph.DeclarationError, match=r"'wire': .* gradient vanishes.* write x"):
        ph.derive(bead(equation))


def test_a_bead_at_zero_distance() -> None:
    """Absolute values and lengths have corners where they vanish."""
    with pytest.raises(ph.DeclarationError, match=r"'wire': .* gradient .* write x = 0 instead"):
        ph.derive(bead(ph.absolute(X)))
    with pytest.raises(ph.DeclarationError, match=r"sum of squares .* a Constraint for each"):
        ph.derive(bead(ph.sqrt(X**2 + Z**2)))
    assert len(ph.derive(bead(ph.sqrt(X**2 + Z**2) - A)).speeds) == 2


@pytest.mark.parametrize("equation", [X**2 + Z**2, X**2 + A * (2 - 2 * ph.cos(THETA))])
def test_a_sum_of_squares(equation: ph.Expr) -> None:
    body = WHEEL if THETA in {ph.Expr.generator(s) for s in equation.symbols()} else BEAD
    system = ph.System(ph.Constraint(equation, on=body))
    with pytest.raises(ph.DeclarationError, match=r"sum of squares .* a Constraint for each"):
        ph.derive(system)


def test_equal_angles_written_as_a_cosine() -> None:
    other = ph.Body("other", mass=M, inertia=(J, J, J), axes=LAB.rotated(PHI, "y"), tag="2")
    held = [p for b in (WHEEL, other) for p in (ph.Pivot(b), ph.Hinge(b, axis="y"))]
    pair = ph.Constraint(1 - ph.cos(THETA - PHI), on=(WHEEL, other))
    with pytest.raises(ph.DeclarationError, match=r"gradient .* not squared"):
        ph.derive(ph.System(*held, pair))


def test_a_slot_that_a_bar_touches_at_its_highest() -> None:
    """A bar of length a about the origin, its end kept at the height a: it can only stand."""
    turning = LAB.rotated(THETA, "y")
    bar = ph.rod("bar", mass=M, length=A, axes=turning, axis="z")
    pivot = ph.Pivot(bar, at=turning["z"] * (-A / 2), name="foot")
    slot = ph.Pivot(
        bar, at=turning["z"] * (A / 2), to=LAB["z"] * A, only="z", name="slot", force="G"
    )
    with pytest.raises(ph.DeclarationError, match=r"'slot': .* gradient vanishes"):
        ph.derive(ph.System(pivot, slot, ph.Gravity(G)))
    level = ph.Pivot(bar, at=turning["z"] * (A / 2), to=LAB["z"] * (A / 2), only="z", force="G")
    assert not ph.derive(ph.System(pivot, level, ph.Gravity(G))).speeds


@pytest.mark.parametrize(
    "equation",
    [X * Y, X**2 + Y**2 - A**2, X**2 * Y, (X - Y) * (X - A) ** 2, X**2 - Y**3, ph.cos(X / A) - Z],
)
def test_simple_zeros_are_derived(equation: ph.Expr) -> None:
    assert len(ph.derive(bead(equation)).speeds) == 2


# -- gradients that vanish with some values only ---------------------------------------------------


def test_a_wheel_held_by_a_cosine_of_one() -> None:
    k = ph.symbol("k")
    system, numbers = wheel(ph.cos(THETA) - k), {M: 1, J: 1, A: 1, G: 9.81}
    with pytest.raises(ph.ConstraintError, match=r"'stop': .* gradient vanishes at the start"):
        ph.simulate(system, {**numbers, k: 1}, {}, 1.0)
    run = ph.simulate(system, {**numbers, k: 0.5}, {"theta": np.pi / 3}, 1.0)
    assert float(run.final["theta"]) == pytest.approx(np.pi / 3, rel=1e-12)


def test_a_bead_where_two_planes_meet() -> None:
    """On either plane it slides freely; on their line it does not know on which."""
    system, numbers = bead(X * Y), {M: 1, G: 9.81}
    with pytest.raises(ph.ConstraintError, match=r"'wire': .* gradient vanishes at the start"):
        ph.simulate(system, numbers, {"x": 0, "y": 0, "v_z": 1}, 1.0)
    run = ph.simulate(system, numbers, {"x": 0, "y": 1, "v_y": 0.5}, 1.0)
    assert float(run.final["y"]) == pytest.approx(1.5, rel=1e-12)


def test_a_rate_without_a_coefficient_at_the_start() -> None:
    system = wheel(ph.sin(THETA) * THETA.dt())
    with pytest.raises(ph.ConstraintError, match=r"'stop': .* gradient vanishes at the start"):
        ph.simulate(system, {M: 1, J: 1, A: 1, G: 9.81}, {"theta": 0}, 1.0)


@pytest.mark.parametrize("size", [1e-6, 1.0, 1e6])
def test_a_ring_of_any_size_has_a_gradient(size: float) -> None:
    system = ph.System(ph.Constraint(X**2 + Z**2 - A**2, on=BEAD))
    run = ph.simulate(
        system, {M: 1, A: size}, {"x": 0.6 * size, "z": -0.8 * size, "v_x": 0.8 * size}, 0.5
    )
    assert float(run.final["x"]) / size == pytest.approx(np.sin(np.arcsin(0.6) + 0.5), rel=1e-12)


def test_a_coordinate_at_its_largest_leaves_the_other_zero() -> None:
    """At the bottom of a ring x² = 0: a double zero, which Newton's method misses by 1e-9."""
    system = ph.System(ph.Constraint(X**2 + Z**2 - A**2, on=BEAD))
    run = ph.simulate(system, {M: 1, A: 1}, {"z": -1, "v_x": 1}, 1.0)
    assert float(run.final["x"]) == pytest.approx(np.sin(1.0), rel=1e-14)
