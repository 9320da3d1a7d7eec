"""Derivatives against differences of runs, and fits against what the data were made with."""

from math import sin

import numpy as np
import pytest

from polhode.base import DeclarationError, NumericError
from polhode.catalogue import CATALOGUE
from polhode.derive import derive
from polhode.simulate import sampled, simulate
from polhode.study import fit, sensitivities
from study.examples import NUMBERS, disk, rough_disk

START = {"theta": 1.2, "phi_dot": 1.0, "omega_3": 20.0}
TIMES = np.array([0.0, 0.1, 0.4])
QUANTITIES = ("theta", "x", "F_z", "energy")


@pytest.fixture(params=["heyoka", "scipy"])
def integrator(request, monkeypatch):
    monkeypatch.setenv("POLHODE_INTEGRATOR", request.param)
    return request.param


def difference(system, name, step):
    """Central differences of fourth order of single runs."""
    weights = {-2: 1 / 12, -1: -2 / 3, 1: 2 / 3, 2: -1 / 12}
    total = {quantity: np.zeros(len(TIMES)) for quantity in QUANTITIES}
    for k, weight in weights.items():
        numbers, start = dict(NUMBERS), dict(START)
        given = numbers if name in numbers else start
        given[name] = given.get(name, 0.0) + k * step
        run = simulate(system, numbers, start, TIMES[-1])
        for quantity in QUANTITIES:
            total[quantity] += weight * run.evaluate(quantity, TIMES) / step
    return total


def test_derivatives_are_those_of_the_motion(integrator):
    equations = derive(disk())
    by = ["a", "m", "theta", "theta_dot", "omega_3"]
    found = sensitivities(equations, NUMBERS, START, TIMES[-1], of=QUANTITIES, by=by, times=TIMES)
    run = simulate(equations, NUMBERS, START, TIMES[-1])
    for quantity in QUANTITIES:
        assert found.values[quantity] == pytest.approx(run.evaluate(quantity, TIMES), rel=1e-9)
    for name, step in (("a", 1e-5), ("theta", 1e-3)):
        expected = difference(equations, name, step)
        for quantity in QUANTITIES:
            size = np.max(np.abs(expected[quantity]))
            apart = found.derivatives[quantity][name] - expected[quantity]
            assert np.max(np.abs(apart)) < 1e-6 * size, (quantity, name)
    assert found.derivatives["theta"]["m"] == pytest.approx(0.0, abs=1e-9)
    assert found.derivatives["energy"]["m"] == pytest.approx(found.values["energy"] / 0.2)
    assert found.derivatives["theta"]["theta"][0] == 1.0


def test_contact_modes_are_not_crossed():
    starts = {"theta": 1.0, "phi_dot": 3.0, "omega_3": 10.0}
    with pytest.raises(NumericError, match="a contact slides"):
        sensitivities(rough_disk(), NUMBERS, starts, 0.35, of=["theta"], by=["theta"])


def test_a_system_that_only_rolls_is_followed_through_its_modes():
    found = sensitivities(disk(), NUMBERS, START, 0.1, of=["theta"], by=["theta"])
    other = sensitivities(derive(disk()), NUMBERS, START, 0.1, of=["theta"], by=["theta"])
    expected = other.derivatives["theta"]["theta"]
    assert found.derivatives["theta"]["theta"] == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize(("of", "by"), [(["thete"], ["theta"]), (["theta"], ["psi_dot"])])
def test_unknown_names_are_refused(of, by):
    with pytest.raises(DeclarationError):
        sensitivities(derive(disk()), NUMBERS, START, 0.1, of=of, by=by)


KNOTS = np.linspace(0.0, 0.5, 6)
BALL = {"m": 0.05, "r": 0.02, "k": 0.4, "g": 9.81}
THROWN = {"v_x": 0.1, "omega_z": 3.0}
SHEETS = {
    "samples": {"X": sampled(KNOTS, 0.05 * np.sin(8 * KNOTS) ** 2), "Y": 0, "chi": 0},
    "function": {"X": lambda t: 0.03 * sin(9 * t) ** 2, "Y": lambda t: t**3, "chi": 0},
}


@pytest.mark.parametrize("sheet", SHEETS)
@pytest.mark.parametrize("by", ["k", "v_x", "x"])
def test_a_sheet_may_be_known_by_samples_or_as_a_function(integrator, sheet, by):
    """The speeds are linear in their start and x is not in k: differences of runs tell."""
    ball, times, d = CATALOGUE["ball-on-paper"].build(), np.array([0.0, 0.2, 0.33, 0.5]), 1e-5
    forcing, of = SHEETS[sheet], ("v_x", "x", "energy", "F_x")
    run = simulate(ball, BALL, THROWN, 0.5, forcing=forcing)
    found = sensitivities(ball, BALL, THROWN, 0.5, of=of, by=[by], times=times, forcing=forcing)
    ends = []
    for step in (-d, d):
        numbers, start = dict(BALL), dict(THROWN)
        given = numbers if by in numbers else start
        given[by] = given.get(by, 0.0) + step
        ends.append(simulate(ball, numbers, start, 0.5, forcing=forcing))
    for quantity in of:
        assert found.values[quantity] == pytest.approx(run.evaluate(quantity, times), abs=1e-9)
        before, after = (end.evaluate(quantity, times) for end in ends)
        expected = (after - before) / (2 * d)
        assert found.derivatives[quantity][by] == pytest.approx(expected, rel=1e-5, abs=1e-7)


def test_a_jerk_is_not_crossed():
    forcing = {"X": sampled(KNOTS, 0.05 * np.sin(8 * KNOTS) ** 2, starts=(3,)), "Y": 0, "chi": 0}
    ball = CATALOGUE["ball-on-paper"].build()
    with pytest.raises(NumericError, match="jerk"):
        sensitivities(ball, BALL, THROWN, 0.5, of=["x"], by=["k"], forcing=forcing)


# -- fits ------------------------------------------------------------------------------------------


def measured(noise, count=120):
    equations = derive(CATALOGUE["rolling-disk"].build())
    times = np.linspace(0.0, 0.5, count)
    run = simulate(equations, NUMBERS, START, 0.5)
    errors = np.random.default_rng(3).normal(0, noise, count) if noise else 0.0
    return equations, times, run.evaluate("theta", times) + errors


def test_a_fit_finds_what_the_motion_was_made_with():
    equations, times, theta = measured(0.0)
    guess = {**NUMBERS, "a": 0.031}
    found = fit(
        equations, guess, {**START, "omega_3": 19.5}, times, {"theta": theta}, vary=["a", "omega_3"]
    )
    assert found.values["a"] == pytest.approx(0.03, rel=1e-9)
    assert found.values["omega_3"] == pytest.approx(20.0, rel=1e-9)
    assert found.scatter < 1e-10


def test_uncertainties_are_those_of_the_noise():
    noise = 1e-3
    equations, times, theta = measured(noise)
    theta[5] = np.nan
    vary = ["a", "omega_3"]
    found = fit(equations, NUMBERS, START, times, {"theta": theta}, vary=vary)
    known = fit(
        equations, NUMBERS, START, times, {"theta": theta}, vary=vary, deviation={"theta": noise}
    )
    for name, truth in (("a", 0.03), ("omega_3", 20.0)):
        assert abs(found.values[name] - truth) < 4 * found.uncertainties[name]
        assert found.uncertainties[name] == pytest.approx(known.uncertainties[name], rel=0.3)
    assert found.scatter == pytest.approx(noise, rel=0.2)
    assert known.scatter == pytest.approx(1.0, rel=0.2)
    assert np.isnan(found.residuals["theta"][5])


def test_what_cannot_be_determined_is_told():
    equations, times, theta = measured(0.0)
    with pytest.raises(NumericError, match="do not determine"):
        fit(equations, NUMBERS, START, times, {"theta": theta}, vary=["m", "omega_3"])
    with pytest.raises(DeclarationError, match="119 measurements"):
        fit(equations, NUMBERS, START, times, {"theta": theta[1:]}, vary=["a"])
    with pytest.raises(DeclarationError, match="first guess"):
        fit(equations, {**NUMBERS, "a": "3 cm"}, START, times, {"theta": theta}, vary=["a"])
    with pytest.raises(DeclarationError, match="increasing times"):
        fit(equations, NUMBERS, START, times[::-1], {"theta": theta}, vary=["a"])


def test_a_fit_with_a_sampled_sheet():
    """The ball's own inertia from where a sheet of known motion takes it."""
    ball, times = CATALOGUE["ball-on-paper"].build(), np.linspace(0.0, 0.5, 26)
    forcing = SHEETS["samples"]
    x = simulate(ball, BALL, THROWN, 0.5, forcing=forcing).evaluate("x", times)
    guess = {**BALL, "k": 0.6}
    found = fit(ball, guess, THROWN, times, {"x": x}, vary=["k", "v_x"], forcing=forcing)
    assert found.values == pytest.approx({"k": 0.4, "v_x": 0.1}, rel=1e-8)
