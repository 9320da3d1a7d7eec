"""Motions whose exact course is known, by either integrator."""

import numpy as np
import pytest
from scipy.special import ellipj, ellipk

from polhode.algebra import sin, time
from polhode.base import NumericError
from polhode.simulate import simulate
from simulate.examples import (
    ByHand,
    four_bar,
    free_body,
    free_body_invariants,
    oscillator,
    pendulum,
    wheel,
)

CLOSE, STEADY = 2e-13, 5e-14
UNITS = {"m": 1, "l": 1, "g": 1}


def test_a_swinging_pendulum_follows_jacobi(integrator):
    amplitude, t = 2.0, np.linspace(0, 50, 301)
    modulus = np.sin(amplitude / 2) ** 2
    run = simulate(pendulum(), UNITS, {"theta": amplitude}, 50, samples=t)
    sn = ellipj(ellipk(modulus) - t, modulus)[0]
    assert run["theta"] == pytest.approx(2 * np.arcsin(np.sqrt(modulus) * sn), abs=CLOSE)
    assert run.drift.energy < STEADY


def test_a_whirling_pendulum_keeps_its_energy_however_often_it_turns(integrator):
    t = 3000.0
    run = simulate(pendulum(), UNITS, {"theta_dot": 3}, t)
    period = 2 * 2 / 3 * ellipk(4 / 9)
    assert run.final["theta"] == pytest.approx(2 * np.pi * t / period, abs=2)
    assert run.evaluate("theta", period * 20) == pytest.approx(40 * np.pi, abs=2e-12 * 40 * np.pi)
    assert run.drift.energy < STEADY


def test_a_free_body_follows_jacobi(integrator):
    moments, t = {"I_1": 1, "I_2": 2, "I_3": 3}, np.linspace(0, 40, 201)
    run = simulate(
        free_body(),
        moments,
        {"omega_1": 1, "omega_3": 0.9},
        40,
        samples=t,
        invariants=free_body_invariants(),
    )
    # L² < 2 T I_2 is false here: the motion is about axis 3; Landau and Lifshitz §37.
    twice_t, square = 1 + 3 * 0.9**2, 1 + 9 * 0.9**2
    rate = np.sqrt((3 - 2) * (square - twice_t * 1) / 6)
    modulus = (2 - 1) * (twice_t * 3 - square) / ((3 - 2) * (square - twice_t * 1))
    sn, cn, dn, _ = ellipj(rate * t, modulus)
    assert run["omega_1"] == pytest.approx(cn, abs=CLOSE)
    assert run["omega_3"] == pytest.approx(0.9 * dn, abs=CLOSE)
    largest = np.sqrt((twice_t * 3 - square) / 2)
    assert np.abs(run["omega_2"]) == pytest.approx(np.abs(largest * sn), abs=CLOSE)
    assert run.drift.energy < STEADY
    assert run.drift.invariants["L^2"] < STEADY


def test_a_driven_oscillator_balances_its_power(integrator):
    drive = {"X": sin(3 * time) / 2}
    run = simulate(oscillator(), {"m": 2, "k": 8}, {"x": 0.25}, 20, forcing=drive)
    # x'' + 4 x = 2 sin 3t
    expected = 0.25 * np.cos(2 * run.t) + 0.6 * np.sin(2 * run.t) - 0.4 * np.sin(3 * run.t)
    assert run["x"] == pytest.approx(expected, abs=CLOSE)
    assert run["energy"] - run["energy"][0] == pytest.approx(run["work"], abs=CLOSE)
    assert np.ptp(run["work"]) > 1
    assert run.drift.energy < CLOSE


def test_a_wrong_power_shows():
    right = oscillator()
    wrong = ByHand(**{**vars(right), "power": right.power * 2})
    drive = {"X": sin(3 * time) / 2}
    with pytest.raises(NumericError, match=r"the energy balance is off by 3\.3e-01"):
        simulate(wrong, {"m": 2, "k": 8}, {"x": 0.25}, 20, forcing=drive)


def test_a_push_as_a_polynomial_of_time_starts_at_zero(integrator):
    run = simulate(oscillator(), {"m": 1, "k": 1}, {}, 2, forcing={"X": time**3 / 10})
    expected = (run.t**3 - 6 * run.t + 6 * np.sin(run.t)) / 10
    assert run["x"] == pytest.approx(expected, abs=1e-14)


def test_quadratures_are_resolved_where_the_core_stands_still(integrator):
    """In steady turning the speeds are constant, and only the path shows that time passes."""
    run = simulate(wheel(), {"a": 0.1}, {"Omega": 100, "u": 1}, 10)
    assert run["x"] == pytest.approx(np.sin(100 * run.t) / 100, abs=1e-12)
    assert run["psi"] == pytest.approx(10 * run.t - np.sin(100 * run.t), abs=1e-10)
    assert run["v_y"] == pytest.approx(np.sin(100 * run.t), abs=1e-12 * 1000)


def test_reactions_follow_from_the_accelerations(integrator):
    run = simulate(pendulum(), UNITS, {"theta": 1.0}, 10)
    energy = -np.cos(1.0)
    tension = 2 * energy + 3 * np.cos(run["theta"])
    assert run["N"] == pytest.approx(tension, abs=1e-12)
    assert run["S"] == pytest.approx(0, abs=1e-14)
    assert run["theta_ddot"] == pytest.approx(-np.sin(run["theta"]), abs=1e-14)


def test_a_closed_loop_stays_closed(integrator):
    rods = {"p": 1, "q": 3, "r": 2.5, "d": 3, "I": 1}
    run = simulate(four_bar(), rods, {"alpha": "30 deg", "alpha_dot": 2}, 20)
    assert run.drift.constraint < STEADY
    assert not run.assumed
    assert np.ptp(run["gamma"]) > 0.5


def test_both_integrators_agree(monkeypatch):
    pytest.importorskip("heyoka")
    runs = []
    for name in ("heyoka", "kernel"):
        monkeypatch.setenv("POLHODE_INTEGRATOR", name)
        runs.append(simulate(pendulum(), UNITS, {"theta": 2}, 30))
    assert [run.integrator for run in runs] == ["heyoka", "kernel"]
    assert runs[0]["theta"] == pytest.approx(runs[1]["theta"], abs=1e-12)
    assert runs[0]["N"] == pytest.approx(runs[1]["N"], abs=1e-12)


def test_a_looser_tolerance_takes_fewer_steps(integrator):
    tight, loose = (
        simulate(pendulum(), UNITS, {"theta": 1}, 20, tolerance=tolerance)
        for tolerance in (None, 1e-6)
    )
    assert loose["theta"] == pytest.approx(tight["theta"], abs=1e-3)
    assert abs(loose["theta"] - tight["theta"]).max() > 1e-13
    assert loose["energy"] == pytest.approx(-np.cos(1.0), abs=1e-4)
