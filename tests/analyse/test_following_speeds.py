"""Values of speeds that follow from others restrict steady motions, or are refused by name."""

from itertools import product
from math import cos, sin, sqrt

import numpy as np
import pytest

import polhode as ph
from analyse.systems import equations
from polhode.algebra import compile_program
from polhode.analyse import departures, stability, steady, steady_values
from polhode.base import NumericError
from polhode.catalogue import PROBLEM_SET
from polhode.cli import main
from polhode.judge import check

THETA, PHI_DOT = ph.coordinate("theta"), ph.coordinate("phi").dt()
NUMBERS = {"M": 0.5, "a": 0.06, "g": 9.81, "I_1": 6e-3, "I_2": 3.5e-4}


def disk_steady(theta, phi_dot, omega_3, a=1.0, g=9.81):
    """The condition (40) of the problem set, typed in."""
    return (
        phi_dot**2 * sin(theta) * cos(theta)
        - 6 * omega_3 * phi_dot * sin(theta)
        - 4 * g / a * cos(theta)
    )


def test_a_disk_that_does_not_turn_in_its_axes_can_only_spin_on_edge():
    (family,) = steady(equations("rolling-disk"), {"psi_dot": 0})
    assert str(family) == "psi_dot = 0, omega_3 = 0, theta = pi/2"
    # No other inclination satisfies (40) at omega_3 = phi_dot cos(theta), at any rate.
    signs = {
        theta: {np.sign(disk_steady(theta, w, w * cos(theta))) for w in np.linspace(0, 60, 601)}
        for theta in np.linspace(0.01, np.pi - 0.01, 400)
    }
    assert all(found == {-np.sign(cos(theta))} for theta, found in signs.items())
    assert disk_steady(np.pi / 2, 7.0, 0.0) == pytest.approx(0, abs=1e-14)


def test_a_gyroscope_whose_wheel_rests_in_its_axes_precesses_as_a_rigid_pendulum():
    top = equations("gyroscope")
    family = next(f for f in steady(top, {"psi_dot": 0}) if f.relations)
    about_pivot = NUMBERS["I_2"] + NUMBERS["M"] * NUMBERS["a"] ** 2
    weight, theta = NUMBERS["M"] * NUMBERS["g"] * NUMBERS["a"], np.pi / 3
    # (124) with omega_1 = phi_dot cos(theta): (I_1 - I_2p) cos(theta) phi_dot^2 = M g a
    rate = sqrt(weight / ((NUMBERS["I_1"] - about_pivot) * cos(theta)))
    found = steady_values(family, {**NUMBERS, "theta": "60 deg"})
    assert found.values == pytest.approx([-rate, rate])

    # Small nutations, by the second derivative of the effective potential at the two momenta.
    p_psi = NUMBERS["I_1"] * rate * cos(theta)
    p_phi = about_pivot * rate * sin(theta) ** 2 + p_psi * cos(theta)

    def potential(at):
        return (p_phi - p_psi * cos(at)) ** 2 / (2 * about_pivot * sin(at) ** 2) + weight * cos(at)

    h = 1e-4
    slope = (potential(theta + h) - potential(theta - h)) / (2 * h)
    assert slope == pytest.approx(0, abs=1e-6)
    bend = (potential(theta + h) - 2 * potential(theta) + potential(theta - h)) / h**2
    (frequency,) = stability(family).frequencies
    symbols = tuple(sorted(frequency.symbols(), key=str))
    values = {**NUMBERS, "theta": theta, "phi_dot": rate}
    arguments = [values[symbol.published] for symbol in symbols]
    (number,) = compile_program([frequency], symbols).function()(*arguments)
    assert number == pytest.approx(sqrt(bend / about_pivot), rel=1e-6)


@pytest.mark.parametrize("name", ["v_x", "x_dot", "v_y", "y_dot"])
def test_a_speed_that_depends_on_a_free_coordinate_is_refused(name):
    with pytest.raises(NumericError, match=f"a value of {name} .* depends on phi"):
        steady(equations("rolling-disk"), {name: 0})


def test_a_speed_given_twice_must_agree():
    disk = equations("rolling-disk")
    (family,) = steady(disk, {"psi_dot": 3, "omega_3": 3})
    assert family.fixed[PHI_DOT.symbol].is_zero
    with pytest.raises(NumericError, match="contradict one another"):
        steady(disk, {"psi_dot": 3, "phi_dot": 0, "omega_3": 2})


@pytest.mark.parametrize("command", [stability, departures, steady_values])
def test_a_family_takes_no_value_of_a_speed_that_follows(command):
    family = next(f for f in steady(equations("gyroscope")) if f.relations)
    with pytest.raises(NumericError, match="psi_dot = omega_1 - phi_dot"):
        command(family, {"psi_dot": 0})


@pytest.mark.parametrize(
    ("command", "given"),
    [
        (["vectors"], "psi_dot=0"),
        (["fictitious", "--frame", "axes"], "psi_dot=0"),
        (["lagrangian"], "omega_1=0"),
        (["solve"], "psi_dot=0"),
    ],
)
def test_commands_that_would_print_the_same_refuse_it(command, given, capsys):
    assert main([*command, "gyroscope", "--at", given]) == 2
    assert given.partition("=")[0] in capsys.readouterr().err


def test_no_family_has_a_value_that_is_refused():
    """`--at omega_3=0` must not give what `--at theta=-pi/2` refuses."""
    tried = 0
    for name in ("rolling-disk", "spinning-coin", "gyroscope", "gyrocompass"):
        found = equations(name)
        for speed, value in product(found.speeds, (0, 1)):
            try:
                families = steady(found, {speed: value})
            except NumericError:
                continue
            for family in families:
                numbers = {
                    s: v for s, v in family.fixed.items() if not v.symbols() - {ph.pi.symbol}
                }
                assert steady(found, numbers)
                tried += 1
    assert tried > 15


def test_the_mirror_image_of_a_disk_on_edge_is_no_steady_motion():
    for given in ({"omega_3": 0}, {"phi_dot": 0}):
        families = steady(equations("rolling-disk"), given)
        assert all(family.fixed.get(THETA.symbol) != -ph.pi / 2 for family in families)


@pytest.mark.parametrize(
    ("latex", "given", "holds"),
    [
        (r"\omega_1 = \dot\phi\cos\theta", "psi_dot = 0", True),
        (r"\omega_1 = 2\dot\phi\cos\theta", "psi_dot = 0", False),
        (r"\dot\phi = \pm\sqrt{\frac{Mga}{(I_1-I_2-Ma^2)\cos\theta}}", "psi_dot = 0", True),
        (r"\dot\phi = \pm\sqrt{\frac{Mga}{(I_1-I_2+Ma^2)\cos\theta}}", "psi_dot = 0", False),
        (r"\omega_1 = \dot\phi\cos\theta + 3", "psi_dot = 3", True),
    ],
)
def test_claims_about_steady_motions_use_it(latex, given, holds):
    verdict = check(latex, equations("gyroscope"), context="steady", given=[given])
    assert verdict.answer.value == ("holds" if holds else "fails")


def test_a_claim_that_steady_motion_cannot_meet_is_not_judged():
    verdict = check(
        r"\omega_3 = 0", equations("rolling-disk"), context="steady", given=["x_dot = 0"]
    )
    assert verdict.answer.value == "unread"
    assert "depends on phi" in verdict.reason


def test_the_catalogue_has_these_systems():
    assert {"rolling-disk", "spinning-coin", "gyroscope", "gyrocompass"} <= set(PROBLEM_SET)
