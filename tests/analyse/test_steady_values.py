"""Roots for given numbers: all of them, and none below a condition of existence."""

from fractions import Fraction
from math import cos, pi, sin, sqrt

import pytest

import polhode as ph
from analyse.systems import equations, symbols
from polhode.analyse import contact_forces, steady, steady_values


def precession(spin: Fraction):
    derived = equations("gyroscope")
    s = symbols(derived)
    (family,) = (f for f in steady(derived) if f.relations)
    numbers = {"M": 1, "a": 1, "I_1": 1, "I_2": 1, "g": 10, "theta": ph.pi / 3, "omega_1": spin}
    return steady_values(family, {s[name]: value for name, value in numbers.items()})


def test_both_precessions_above_the_condition_and_none_below():
    """I₁²ω₁² = 4 M g a I₂ₚ cos θ at ω₁ = √40 for these numbers."""
    above = precession(Fraction(7)).values
    assert above == pytest.approx(sorted((7 + s * 3) / 2 for s in (1, -1)))
    assert precession(Fraction(6)).values == ()
    assert precession(Fraction(7)).degree == 2


def test_every_tilt_of_a_precessing_top():
    derived = equations("gyroscope")
    s = symbols(derived)
    (family,) = (f for f in steady(derived) if f.relations)
    numbers = {"M": 1, "a": 1, "I_1": 1, "I_2": 1, "g": 10, "phi_dot": 5, "omega_1": 3}
    found = steady_values(family, {s[name]: value for name, value in numbers.items()})
    assert found.values == pytest.approx([-x for x in found.values][::-1])
    assert all(15 - 2 * 25 * cos(x) - 10 == pytest.approx(0, abs=1e-9) for x in found.values)


def test_more_than_one_unknown_is_refused():
    derived = equations("gyroscope")
    (family,) = (f for f in steady(derived) if f.relations)
    with pytest.raises(ph.NumericError, match=r"I_1.* left open"):
        steady_values(family, {})


def test_friction_needed_by_a_marble_on_a_turntable():
    """(2/7)Ωv over g, the centripetal acceleration of its circle."""
    derived = equations("marble-on-turntable")
    forces = contact_forces(derived, "table")
    values = {"m": 1, "a": 0.01, "I": 2 * 0.01**2 / 5, "g": 9.81, "Omega": 3, "v_x": 0.3, "v_y": 0}
    used = sorted(forces.friction_needed.symbols(), key=lambda s: s.published)
    (needed,) = ph.compile_program([forces.friction_needed], used).function()(
        *(values[s.published] for s in used)
    )
    assert needed == pytest.approx(2 / 7 * 3 * 0.3 / 9.81)


def test_friction_needed_by_a_disk_on_a_circle():
    """Steady rolling needs |F_h| = m times the centripetal acceleration of the centre."""
    derived = equations("rolling-disk")
    forces = contact_forces(derived, "ground")
    theta, rate, g, a = 1.2, 3.0, 9.81, 0.03
    spin = (rate**2 * sin(theta) * cos(theta) - 4 * g / a * cos(theta)) / (6 * rate * sin(theta))
    values = {"theta": theta, "theta_dot": 0, "phi_dot": rate, "omega_3": spin}
    values |= {"m": 0.2, "a": a, "g": g}
    used = sorted(forces.friction_needed.symbols(), key=lambda s: s.published)
    (needed,) = ph.compile_program([forces.friction_needed], used).function()(
        *(values[s.published] for s in used)
    )
    assert needed == pytest.approx(abs(a * spin * rate) / g)
    with pytest.raises(ph.DeclarationError, match="not a contact"):
        contact_forces(equations("gyroscope"), "pivot")
    assert pi > sqrt(2)
