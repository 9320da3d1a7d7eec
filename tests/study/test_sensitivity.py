"""Derivatives against differences of runs, and fits against what the data were made with."""

from math import sin

import numpy as np
import pytest

from polhode.algebra import symbol
from polhode.base import DeclarationError, NumericError, UnitError
from polhode.catalogue import CATALOGUE
from polhode.derive import automaton, derive
from polhode.model import with_friction
from polhode.simulate import Pieces, sampled, simulate
from polhode.study import fit, sensitivities
from study.examples import NUMBERS, disk

START = {"theta": 1.2, "phi_dot": 1.0, "omega_3": 20.0}
TIMES = np.array([0.0, 0.1, 0.4])
QUANTITIES = ("theta", "x", "F_z", "energy")


@pytest.fixture(params=["heyoka", "kernel"])
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


SLID = {"m": 0.05, "r": 0.02, "k": 0.4, "g": 9.81, "mu": 0.2}
REST = {"X": 0, "Y": 0, "chi": 0}


def rough_ball():
    return with_friction(CATALOGUE["ball-on-paper"].build(), symbol("mu"))


def test_a_ball_slides_and_then_rolls():
    """Without spin it rolls from t = kv/((1 + k)μg) on, at v/(1 + k)."""
    mu, g, k, v = SLID["mu"], SLID["g"], SLID["k"], 0.7
    until = k * v / ((1 + k) * mu * g)
    times, start = np.array([0.05, 0.2]), {"v_x": v, "omega_y": 0}
    assert times[0] < until < times[1]
    by = ["mu", "k", "v_x", "y"]
    found = sensitivities(
        rough_ball(), SLID, start, 0.2, of=["x", "v_x"], by=by, times=times, forcing=REST
    )
    t = times[0]
    way = v * until - mu * g * until**2 / 2
    along = way + v / (1 + k) * (times[1] - until)
    assert found.values["x"] == pytest.approx([v * t - mu * g * t**2 / 2, along], rel=1e-12)
    # x = v t/(1 + k) + k² v²/(2 (1 + k)² μ g), once it rolls
    after = k**2 * v**2 / (2 * (1 + k) ** 2 * mu * g)
    expected = {
        ("x", "mu"): [-g * t**2 / 2, -after / mu],
        ("x", "v_x"): [t, times[1] / (1 + k) + 2 * after / v],
        ("x", "k"): [0, -v * times[1] / (1 + k) ** 2 + 2 * after / (k * (1 + k))],
        ("x", "y"): [0, 0],
        ("v_x", "mu"): [-g * t, 0],
        ("v_x", "v_x"): [1, 1 / (1 + k)],
        ("v_x", "k"): [0, -v / (1 + k) ** 2],
    }
    for (quantity, name), slopes in expected.items():
        assert found.derivatives[quantity][name] == pytest.approx(slopes, rel=1e-9, abs=1e-10)
        assert np.all(found.errors[quantity][name] < 1e-8)


def test_the_instant_of_a_switch_shows_in_the_error():
    mu, g, k, v = SLID["mu"], SLID["g"], SLID["k"], 0.7
    until = k * v / ((1 + k) * mu * g)
    found = sensitivities(
        rough_ball(), SLID, {"v_x": v, "omega_y": 0}, 0.2,
        of=["v_x"], by=["mu"], times=[until], forcing=REST,
    )  # fmt: skip
    assert found.derivatives["v_x"]["mu"][0] == pytest.approx(-g * until / 2, rel=1e-6)
    assert found.errors["v_x"]["mu"][0] == pytest.approx(g * until / 2, rel=1e-6)


def test_what_the_least_change_alters_has_no_derivative():
    """The sheet jerks at the very instant at which the ball would stick."""
    mu, g, k, v = SLID["mu"], SLID["g"], SLID["k"], 0.7
    until = k * v / ((1 + k) * mu * g)
    jerk = Pieces(np.array([until, until + 0.01]), np.array([[0.0, 0.01]]))
    with pytest.raises(NumericError, match="order of events"):
        sensitivities(
            rough_ball(), SLID, {"v_x": v, "omega_y": 0}, 0.2,
            of=["v_x"], by=["v_x"], forcing={**REST, "X": jerk},
        )  # fmt: skip


def test_a_disk_slips_and_sticks():
    """By differences of fourth order, over steps of another size."""
    mu = symbol("mu")
    disk_on = automaton(with_friction(disk(), mu, 1.2 * mu))
    starts = {"theta": 1.0, "phi_dot": 3.0, "omega_3": 10.0}
    runs = {
        k: simulate(disk_on, {**NUMBERS, "mu": 0.25 + k * 1e-5}, starts, 0.35) for k in range(-2, 3)
    }
    assert len(runs[0].events) > 3
    weights = {-2: 1 / 12, -1: -2 / 3, 1: 2 / 3, 2: -1 / 12}
    found = sensitivities(
        disk_on, {**NUMBERS, "mu": 0.25}, starts, 0.35, of=["theta", "x"], by=["mu"]
    )
    for name in ("theta", "x"):
        expected = sum(w * runs[k].final[name] for k, w in weights.items()) / 1e-5
        assert found.derivatives[name]["mu"][0] == pytest.approx(expected, rel=1e-6)


def test_times_after_the_end_are_refused():
    with pytest.raises(NumericError, match="ends at t"):
        sensitivities(disk(), NUMBERS, {"theta": 0.3}, 5.0, of=["theta"], by=["theta"])


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


def test_a_jerk_is_crossed():
    """The jump of the sheet's velocity moves the ball's by the same share whatever its start."""
    forcing = {"X": sampled(KNOTS, 0.05 * np.sin(8 * KNOTS) ** 2, starts=(3,)), "Y": 0, "chi": 0}
    ball = CATALOGUE["ball-on-paper"].build()
    found = sensitivities(
        ball, BALL, THROWN, 0.6, of=["x", "v_x"], by=["k", "v_x"], forcing=forcing
    )
    assert found.derivatives["v_x"]["v_x"][0] == pytest.approx(1.0, rel=1e-9)
    assert found.derivatives["x"]["v_x"][0] == pytest.approx(0.6, rel=1e-9)
    assert found.derivatives["v_x"]["k"][0] == pytest.approx(0.0, abs=1e-9)


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
    guess = {**NUMBERS, "a": "3.1 cm"}
    found = fit(equations, guess, START, times, {"theta": theta}, vary=vary)
    known = fit(
        equations, NUMBERS, START, times, {"theta": theta}, vary=vary, deviation={"theta": noise}
    )
    for name, truth in (("a", 0.03), ("omega_3", 20.0)):
        assert abs(found.values[name] - truth) < 4 * found.uncertainties[name]
        assert found.uncertainties[name] == pytest.approx(known.uncertainties[name], rel=0.3)
    assert found.scatter == pytest.approx(noise, rel=0.2)
    assert known.scatter == pytest.approx(1.0, rel=0.2)
    assert np.isnan(found.residuals["theta"][5])


def test_what_cannot_be_determined_is_reported():
    equations, times, theta = measured(0.0)
    with pytest.raises(NumericError, match="do not determine"):
        fit(equations, NUMBERS, START, times, {"theta": theta}, vary=["m", "omega_3"])
    with pytest.raises(DeclarationError, match="119 measurements"):
        fit(equations, NUMBERS, START, times, {"theta": theta[1:]}, vary=["a"])
    with pytest.raises(UnitError, match="a = '3 s' is a quantity in s"):
        fit(equations, {**NUMBERS, "a": "3 s"}, START, times, {"theta": theta}, vary=["a"])
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


def test_a_fit_of_friction():
    """To a ball that slides and then rolls; the measurements are the closed form."""
    k, v, mu, g, times = 0.4, 0.7, 0.2, 9.81, np.linspace(0.0, 0.3, 31)
    until = k * v / ((1 + k) * mu * g)
    slid = v * times - mu * g * times**2 / 2
    rolled = v / (1 + k) * times + (k * v / (1 + k)) ** 2 / (2 * mu * g)
    x = np.where(times < until, slid, rolled)
    found = fit(
        rough_ball(), {**SLID, "mu": 0.15}, {"v_x": 0.6, "omega_y": 0}, times, {"x": x},
        vary=["mu", "v_x"], forcing=REST,
    )  # fmt: skip
    assert found.values == pytest.approx({"mu": mu, "v_x": v}, rel=1e-8)
