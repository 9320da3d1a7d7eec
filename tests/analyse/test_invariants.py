"""Integrals: the ones mechanics promises are found, and all of them hold along motions."""

import numpy as np
import pytest

import polhode as ph
from analyse.systems import equations, symbols
from polhode.algebra import Expr, cos, sin, time
from polhode.analyse import Ansatz, invariants

EXPECTED = {
    "spinning-coin": {"E", "omega_3", "v_x", "v_y", "S_z"},
    "rolling-disk": {"E"},
    "gyroscope": {"E", "omega_1", "L_z"},
    "gyroscope/vertical-plane": {"E", "omega_1"},
    "tennis-racquet": {"E", "S_x", "S_y", "S_z"},
    "ball-on-paper": {"omega_z", "L_x", "L_y"},
    "gyrocompass": {"L_3"},
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
