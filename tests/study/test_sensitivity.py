"""Derivatives against differences of runs, and fits against what the data were made with."""

import numpy as np
import pytest

from polhode.base import DeclarationError, NumericError
from polhode.catalogue import CATALOGUE
from polhode.derive import derive
from polhode.simulate import simulate
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
    with pytest.raises(NumericError, match="contact s"):
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
