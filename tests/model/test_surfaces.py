"""Surfaces whose centre is not the centre of mass."""

import random

import numpy as np
import pytest

import polhode as ph

LAB = ph.Frame("lab")
m, g, A, B, C, R, h = ph.symbols("m g A B C R h", positive=True)
PHI, THETA, PSI = ph.coordinates("phi theta psi")
AXES = LAB.rotated(PHI, "z").rotated(THETA, "x").rotated(PSI, "z", labels="1 2 3")


def _rolling(surface):
    body = ph.Body("body", mass=m, inertia=(A, B, C), axes=AXES, surface=surface)
    return ph.derive(ph.System(ph.Rolling(body, on=ph.Plane(LAB)), ph.Gravity(g)))


def test_an_ellipsoid_with_equal_half_axes_is_a_sphere_beside_the_centre_of_mass():
    ellipsoid = _rolling(ph.Ellipsoidal((R, R, R), offset=(0, 0, h)))
    sphere = _rolling(ph.Round(R, "3", h))
    assert ellipsoid.potential_energy == sphere.potential_energy
    assert (ellipsoid.kinetic_energy - sphere.kinetic_energy).is_zero
    for one, other in zip(ellipsoid.rows, sphere.rows, strict=True):
        assert (one - other).is_zero


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_the_lowest_point_of_an_ellipsoid_is_the_lowest_of_all(seed):
    """Against the points of a fine net on the ellipsoid."""
    drawn = random.Random(seed)
    halves = [drawn.uniform(0.5, 2) for _ in range(3)]
    centre = [drawn.uniform(-1, 1) for _ in range(3)]
    up = np.array([drawn.gauss(0, 1) for _ in range(3)])
    up /= np.linalg.norm(up)
    names = ph.symbols("a b c p q r"), dict(zip("abcpqr", [*halves, *centre], strict=True))
    first, second, third, *offset = names[0]
    normal = ph.symbols("u v w")
    surface = ph.Ellipsoidal((first, second, third), offset=tuple(offset))
    lowest = surface.lowest(LAB, LAB.vector(*normal))
    values = {**names[1], **dict(zip("uvw", up, strict=True))}
    table = {ph.symbol(name): ph.Expr.of(value) for name, value in values.items()}
    found = np.array([float(ph.to_sympy(c.subs(table))) for c in lowest.components])
    assert np.sum(((found - centre) / halves) ** 2) == pytest.approx(1, rel=1e-12)
    turns, heights = np.meshgrid(np.linspace(0, 2 * np.pi, 400), np.linspace(0, np.pi, 400))
    net = np.array(
        [
            halves[0] * np.cos(turns) * np.sin(heights) + centre[0],
            halves[1] * np.sin(turns) * np.sin(heights) + centre[1],
            halves[2] * np.cos(heights) + centre[2],
        ]
    )
    assert found @ up == pytest.approx(np.tensordot(up, net, 1).min(), abs=1e-3)
    assert found @ up <= np.tensordot(up, net, 1).min() + 1e-12


def test_a_spheroid_beside_the_centre_of_mass_may_spin_about_the_axis_through_both():
    upright = LAB.rotated(PHI, "z").rotated(THETA, "x", labels="1 2 3")
    fields = {"mass": m, "inertia": (A, A, C), "axes": upright, "spin_about": "3"}
    egg = ph.Body("egg", surface=ph.Ellipsoidal((R, R, 2 * R), offset=(0, 0, h)), **fields)
    equations = ph.derive(ph.System(ph.Rolling(egg, on=ph.Plane(LAB)), ph.Gravity(g)))
    assert equations.rate(equations.energy).is_zero
    with pytest.raises(ph.DeclarationError, match="surface to be symmetric about that axis"):
        ph.Body("egg", surface=ph.Ellipsoidal((R, R, 2 * R), offset=(h, 0, 0)), **fields)


def test_a_base_below_the_centre_of_mass_rocks_at_the_frequency_of_its_curvature():
    """About the minor axis the base has the radius of curvature ρ = a²/c at the lowest point.

    With the centre of mass at the height d = c - offset: ω² = m g (ρ - d)/(I + m d²).
    """
    axes = LAB.rotated(THETA, "y", labels="1 2 3")
    a, c = ph.symbols("a c", positive=True)
    surface = ph.Ellipsoidal((a, a, c), offset=(0, 0, h))
    rocker = ph.Body("rocker", mass=m, inertia=(A, B, C), axes=axes, surface=surface)
    equations = ph.derive(
        ph.System(ph.Rolling(rocker, on=ph.Plane(LAB)), ph.Hinge(rocker, axis="2"), ph.Gravity(g))
    )
    height = c - h
    stiffness = m * g * (a**2 / c - height)
    swing = equations.on_shell(THETA.dt().dt())
    slope = swing.diff(THETA.symbol).subs({THETA.symbol: 0, THETA.dt().symbol: 0})
    assert (slope + stiffness / (B + m * height**2)).is_zero


def test_an_ellipsoid_beside_the_centre_of_mass_is_drawn_there_and_saved(tmp_path):
    half_axes = ph.symbols("a b c", positive=True)  # the motion does not depend on b
    body = ph.ellipsoid(
        "stone",
        mass=m,
        half_axes=half_axes,
        axes=LAB.rotated(THETA, "y"),
        inertia=(A, B, C),
        surface=ph.Ellipsoidal(half_axes, offset=(0, 0, h)),
    )
    system = ph.System(ph.Rolling(body, on=ph.Plane(LAB)), ph.Gravity(g))
    numbers = {"m": 1, "g": 9.81, "B": 1.6e-3, "h": 0.005, "a": 0.2, "b": 0.1, "c": 0.02}
    run = ph.simulate(system, numbers, {"theta": 0.01}, 0.1)
    assert run.drift.energy < 1e-12
    (drawn,) = ph.scene(run).bodies
    assert drawn.shape.centre == (0, 0, 0.005)
    assert drawn.shape.size == (0.2, 0.1, 0.02)
    run.save(tmp_path / "stone.h5")
    assert ph.load(tmp_path / "stone.h5").system == system


@pytest.mark.parametrize("shape", ["rim", "ellipsoid"])
def test_what_always_lies_flat_has_no_lowest_point(shape):
    """It ended with a division by zero."""
    m, a, g = ph.symbols("m a g", positive=True)
    lab = ph.Frame("lab")
    axes = lab.rotated(ph.coordinate("phi"), "z")
    surface = ph.Rim(a, "z") if shape == "rim" else ph.Ellipsoidal((a, a, 0))
    coin = ph.Body("coin", mass=m, inertia=(a, a, a), axes=axes, surface=surface)
    system = ph.System(ph.Smooth(coin, on=ph.Plane(lab)), ph.Gravity(g))
    with pytest.raises(
        ph.DeclarationError, match=r"always lies flat .* surface=ph\.Face\(height\)"
    ):
        ph.derive(system)
