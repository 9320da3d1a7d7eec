"""Integrals: the ones mechanics promises are found, and all of them hold along motions."""

import numpy as np
import pytest

import polhode as ph
from analyse.systems import equations, symbols
from polhode.algebra import Expr, cos, sin, time
from polhode.analyse import Ansatz, invariants

EXPECTED = {
    "spinning-coin": {"E", "omega_3", "v_x", "v_y", "L_cm_z"},
    "rolling-disk": {"E"},
    "gyroscope": {"E", "omega_1", "L_pivot_z"},
    "gyroscope/vertical-plane": {"E", "omega_1"},
    "tennis-racquet": {"E", "L_cm_x", "L_cm_y", "L_cm_z"},
    "ball-on-paper": {"omega_z", "L_sheet_x", "L_sheet_y"},
    "gyrocompass": {"L_cm_3"},
}


@pytest.mark.parametrize("name", EXPECTED)
def test_integrals_with_names(name):
    found = invariants(equations(name))
    assert EXPECTED[name] <= {i.name for i in found}
    assert found.ansatz


@pytest.mark.parametrize("name", [*EXPECTED, "marble-on-turntable", "marble-on-turntable/tilted"])
def test_every_integral_is_one(name):
    derived = equations(name)
    assert all(derived.rate(i.expression) == 0 for i in invariants(derived))


def test_marble_keeps_its_speed_and_its_centre():
    derived = equations("marble-on-turntable")
    s = symbols(derived)
    found = [i.expression for i in invariants(derived)]
    ratio = s["I"] / (s["I"] + s["m"] * s["a"] ** 2)
    centre = s["x"] - s["v_y"] / (ratio * s["Omega"])
    assert any((e / centre).diff(s["x"]) == 0 for e in found if e.diff(s["x"]))
    assert any(e == s["v_x"] ** 2 + s["v_y"] ** 2 for e in found)


def test_tilted_marble_keeps_the_centre_of_a_drifting_circle():
    derived = equations("marble-on-turntable/tilted")
    found = [i.expression for i in invariants(derived)]
    assert any(time.symbol in e.symbols() for e in found)


def test_gyrocompass_has_an_energy_in_its_turning_frame():
    derived = equations("gyrocompass")
    s = symbols(derived)
    rate = s["Omega"] * sin(s["lambda_"])
    axial = s["I_3"] * (s["omega"] + rate * cos(s["theta"]))
    jacobi = s["I_1"] * s["theta"].dt() ** 2 - s["I_1"] * rate**2 * sin(s["theta"]) ** 2
    jacobi = jacobi - 2 * rate * axial * cos(s["theta"])
    assert derived.rate(jacobi) == 0
    assert len(invariants(derived)) == 2


def test_any_friction_keeps_the_balls_combination():
    """Sliding with Coulomb friction on a sheet that is pulled and turned."""
    m, r, k, g, mu = ph.symbols("m r k g mu", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=r, inertia=k * m * r**2, axes=lab)
    x, y, chi = ph.functions("X Y chi")
    sheet = ph.Sheet(lab, motion=(x, y), angle=chi)
    derived = ph.derive(ph.System(ph.Coulomb(ball, on=sheet, mu=mu), ph.Gravity(g)))
    momentum = derived.angular_momentum()
    assert derived.rate(momentum.dot(lab["x"])) == 0
    assert derived.rate(momentum.dot(lab["y"])) == 0


def test_integrals_hold_along_a_simulated_motion():
    derived = equations("gyroscope")
    numbers = {"M": 0.5, "a": 0.06, "I_1": 6.25e-4, "I_2": 3.5e-4, "g": 9.81}
    start = {"theta": 1.0, "omega_1": 150.0, "phi_dot": 2.0}
    run = ph.simulate(derived, numbers, start, 5.0)
    for invariant in invariants(derived):
        values = run.evaluate(invariant.expression)
        assert np.ptp(values) <= 1e-12 * np.abs(values).max()


def test_a_wider_ansatz_says_what_it_searched():
    found = invariants(equations("marble-on-turntable"), Ansatz(speeds=1, lengths=1))
    assert "degree 1 in the speeds" in found.ansatz
    assert isinstance(found["omega_z"].expression, Expr)


def test_only_what_was_searched_is_reported():
    assert "nothing else in driven equations" in invariants(equations("ball-on-paper")).ansatz


def _kepler() -> ph.Equations:
    """A point mass drawn to the origin by k/r²."""
    m, k = ph.symbols("m k", positive=True)
    x, y, z = ph.coordinates("x y z")
    lab = ph.Frame("lab")
    planet = ph.point_mass("planet", mass=m, axes=lab)
    place = lab.vector(x, y, z)
    pull = place * (-k / place.norm() ** 3)
    return ph.derive(ph.System(planet, ph.Force(planet.point(), pull), name="Kepler"))


def test_kepler():
    """Energy, angular momentum and one component of Laplace's vector, of which the others are
    functions: five for six unknowns (Goldstein, Poole and Safko, 3.9)."""
    derived = _kepler()
    found = invariants(derived)
    assert len(found) == 5
    assert {"L_O_x", "L_O_y", "L_O_z"} <= {i.name for i in found}
    m, k = ph.symbols("m k", positive=True)
    place = ph.coordinates("x y z")
    speed = [ph.speed(f"v_{label}") for label in "xyz"]
    r = ph.sqrt(sum(q * q for q in place))
    energy = m * sum(v * v for v in speed) / 2 - k / r
    assert any((i.expression / energy).symbols() <= {m.symbol, k.symbol} for i in found)
    assert all(derived.rate(i.expression) == 0 for i in found)


def test_kepler_along_a_simulated_ellipse():
    run = ph.simulate(_kepler(), {"m": 2, "k": 3}, {"x": 1, "v_y": 1.1, "v_z": 0.4}, 10)
    for invariant in invariants(_kepler()):
        values = run.evaluate(invariant.expression)
        assert np.ptp(values) <= 1e-11 * max(1, np.abs(values).max())


def test_a_torque_that_is_a_springs_has_its_energy_found():
    """I θ̈ + kθ = 0: the load says nothing of a potential, and the angle is in no sine."""
    m, moment, k = ph.symbols("m I k", positive=True)
    theta = ph.coordinate("theta")
    axes = ph.Frame("lab").rotated(theta, "z")
    wheel = ph.Body("wheel", mass=m, inertia=(moment, moment, moment), axes=axes)
    wound = ph.Torque(wheel, axes["z"] * (-k * theta))
    (energy,) = invariants(ph.derive(ph.System(wheel, ph.Pivot(wheel), wound, name="torsion")))
    assert energy.expression == moment * theta.dt() ** 2 + k * theta**2


def test_two_springs_across_one_another_keep_three():
    """An isotropic oscillator in a plane: both energies, and the angular momentum."""
    m, k = ph.symbols("m k", positive=True)
    x, y = ph.coordinates("x y")
    lab = ph.Frame("lab")
    bob = ph.point_mass("bob", mass=m, axes=lab)
    pull = ph.Force(bob.point(), lab.vector(-k * x, -k * y, 0))
    found = invariants(ph.derive(ph.System(bob, pull, name="oscillator")))
    assert {"v_z", "L_O_z"} <= {i.name for i in found}
    assert len(found) == 4


#: The same heavy top with its axis e, by the rotations that lead to the body's axes.
TURNS = {
    "z-x-z": ("zxz", "z", "+++"),
    "z-x-y": ("zxy", "y", "+++"),
    "z-y-x": ("zyx", "x", "+++"),
    "x-y-z": ("xyz", "z", "+++"),
    "y-x-z": ("yxz", "z", "+++"),
    "negated": ("zxz", "z", "-+-"),
    "axis first": ("xyz", "x", "+++"),
}


def _top(turns: str, along: str, signs: str, up: str = "z") -> ph.Equations:
    M, a, A, C, g = ph.symbols("M a I_2 I_1 g", positive=True)
    axes = lab = ph.Frame("lab")
    for angle, about, sign in zip(ph.coordinates("a_1 a_2 a_3"), turns, signs, strict=True):
        axes = axes.rotated(-angle if sign == "-" else angle, about)
    moments = [C if label == along else A for label in "xyz"]
    body = ph.Body("top", mass=M, inertia=tuple(moments), axes=axes)
    pivot = ph.Pivot(body, at=axes[along] * -a)
    return ph.derive(ph.System(body, pivot, ph.Gravity(g, up=lab[up]), name="top"))


@pytest.mark.parametrize("turns", TURNS)
@pytest.mark.parametrize("up", "zx")
def test_a_top_keeps_three_in_any_angles(turns, up):
    """Energy, and the momenta about its axis and about the vertical."""
    derived = _top(*TURNS[turns], up)
    found = invariants(derived)
    assert len(found) == 3
    expected = ("energy", f"about its axis {TURNS[turns][1]}", f"about pivot along {up}")
    assert all(i.meaning.endswith(end) for i, end in zip(found, expected, strict=True))


def test_a_slanting_vertical_and_a_slanting_axis():
    """Gravity and the axis of symmetry along no axis that has a name."""
    M, A, C, g, l = ph.symbols("M A C g l", positive=True)
    alpha, beta = ph.symbols("alpha beta")
    lab = ph.Frame("lab")
    axes = lab
    for angle, about in zip(ph.coordinates("a_1 a_2 a_3"), "zxy", strict=True):
        axes = axes.rotated(angle, about)
    own = axes.rotated(beta, "y")
    turned = own.rotation_to(axes)
    inertia = turned @ ph.Matrix.diagonal([A, A, C]) @ turned.T
    body = ph.Body("top", mass=M, inertia=inertia, axes=axes)
    pivot = ph.Pivot(body, at=own["z"].express(axes) * -l)
    up = lab.rotated(alpha, "x")["z"]
    found = invariants(ph.derive(ph.System(body, pivot, ph.Gravity(g, up=up), name="top")))
    assert [i.meaning for i in found] == [
        "energy",
        "angular momentum of top about its axis of symmetry",
        "angular momentum about pivot along the vertical",
    ]
