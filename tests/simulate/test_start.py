"""Start values and parameters: what is accepted, and the errors for what is not."""

import numpy as np
import pytest

import polhode as ph
from polhode.algebra import Matrix, coordinates, pi, sin, symbols, time
from polhode.base import (
    ConstraintError,
    DeclarationError,
    Dimension,
    NumericError,
    UnitError,
)
from polhode.simulate import simulate
from polhode.study import linearise
from simulate.examples import ByHand, four_bar, oscillator, pendulum, wheel

UNITS = {"m": 1, "l": 1, "g": 1}
RODS = {"p": 1, "q": 3, "r": 2.5, "d": 3, "I": 1}


def started(equations, parameters, start):
    return simulate(equations, parameters, start, 0.1)


def test_names_symbols_and_expressions_all_serve():
    (theta,) = coordinates("theta")
    m, length, g = symbols("m l g")
    by_expression = started(
        pendulum(), {m: 1, length: "100 cm", g: (9810, "mm/s^2")}, {theta: pi / 3, theta.dt(): -1}
    )
    by_name = started(
        pendulum(), {"m": 1, "l": 1, "g": 9.81}, {"theta": "60 deg", "theta_dot": "-1 rad/s"}
    )
    assert by_expression.final == pytest.approx(by_name.final)
    assert by_name.at(0.0)["theta"] == pytest.approx(np.pi / 3)


def test_start_values_may_use_parameters():
    (a,) = symbols("a")
    run = started(wheel(), {"a": 0.25}, {"x": 2 * a, "u": 1})
    assert run.at(0.0)["x"] == 0.5


def test_what_is_not_given_starts_at_zero_and_is_reported():
    run = started(pendulum(), UNITS, {"theta": 1})
    assert run.assumed == {"theta_dot": 0.0}
    assert started(pendulum(), UNITS, {"theta": 1, "theta_dot": 2}).assumed == {}


@pytest.mark.parametrize(
    ("start", "u", "steer"),
    [
        ({"v_x": 1, "phi_dot": 3}, 1, 3),
        ({"psi_dot": 10}, 1, 0),
        ({"psi_dot": 10, "u": 0}, 0, -10),
        ({"phi": "90 deg", "y_dot": 2}, 2, 0),
        ({"v_x": 1, "x_dot": 1, "u": 1}, 1, 0),
    ],
)
def test_any_sufficient_set_of_rates_will_do(start, u, steer):
    begun = started(wheel(), {"a": 0.1}, start).at(0.0)
    assert begun["u"] == pytest.approx(u, abs=1e-12)
    assert begun["Omega"] == pytest.approx(steer, abs=1e-12)


@pytest.mark.parametrize(
    ("start", "culprit", "cause"),
    [
        ({"u": 1, "v_x": 2}, "v_x = 2", "u"),
        ({"v_y": 1}, "v_y = 1", "constraints"),
        ({"u": 1, "phi_dot": 1, "psi_dot": 1}, "psi_dot = 1", "u, phi_dot"),
    ],
)
def test_contradictions_are_named(start, culprit, cause):
    with pytest.raises(ConstraintError) as caught:
        started(wheel(), {"a": 0.1}, start)
    assert culprit in str(caught.value)
    assert cause in str(caught.value)


def test_a_loop_is_closed_for_the_coordinates_that_are_left_out():
    begun = started(four_bar(), RODS, {"alpha": "90 deg"}).at(0.0)
    alpha, beta, gamma = (begun[name] for name in ("alpha", "beta", "gamma"))
    assert np.cos(alpha) + 3 * np.cos(beta) == pytest.approx(2.5 * np.cos(gamma) + 3)
    assert np.sin(alpha) + 3 * np.sin(beta) == pytest.approx(2.5 * np.sin(gamma))


def test_a_free_choice_in_a_loop_is_reported():
    run = started(four_bar(), RODS, {"alpha_dot": 1})
    assert set(run.assumed) == {"alpha", "beta", "gamma"}


def test_a_loop_that_cannot_be_closed_is_named():
    with pytest.raises(ConstraintError, match="closes the loop"):
        started(four_bar(), {**RODS, "q": 0.1}, {"alpha": "90 deg"})
    with pytest.raises(ConstraintError, match=r"alpha = 1, beta = 1, gamma = 1"):
        started(four_bar(), RODS, {"alpha": 1, "beta": 1, "gamma": 1})


@pytest.mark.parametrize(
    ("parameters", "start", "error", "message"),
    [
        ({"m": 1, "l": 1}, {}, DeclarationError, "no value for g"),
        ({**UNITS, "mass": 1}, {}, DeclarationError, "'mass' is no parameter"),
        ({**UNITS, "m": -1}, {}, DeclarationError, "m = -1"),
        ({**UNITS, "m": 0}, {}, DeclarationError, "m = 0"),
        ({**UNITS, "m": float("nan")}, {}, UnitError, "m: nan"),
        ({**UNITS, "m": "one"}, {}, UnitError, "m: 'one'"),
        ({**UNITS, "m": "1 s"}, {}, UnitError, "m = '1 s'"),
        (UNITS, {"theta": "inf"}, UnitError, "theta"),
        (UNITS, {"theta": float("inf")}, UnitError, "theta: inf"),
        (UNITS, {"thet": 1}, DeclarationError, "did you mean theta"),
        (UNITS, {"theta_ddot": 1}, DeclarationError, "'theta_ddot' is no coordinate"),
    ],
)
def test_bad_values_are_refused(parameters, start, error, message):
    kilogram = Dimension(mass=1)
    equations = pendulum()
    mass = next(s for s in equations.parameters if s.name == "m")
    with pytest.raises(error) as caught:
        started(ByHand(**{**vars(equations), "dimensions": {mass: kilogram}}), parameters, start)
    assert message in str(caught.value)


def test_a_value_given_twice_is_refused():
    (theta,) = coordinates("theta")
    with pytest.raises(DeclarationError, match="theta is given twice"):
        started(pendulum(), UNITS, {"theta": 1, theta: 1})


def test_a_mass_matrix_that_is_not_positive_is_refused():
    right = pendulum()
    wrong = ByHand(**{**vars(right), "mass": Matrix.of([[-1]])})
    with pytest.raises(NumericError, match="not positive definite"):
        started(wrong, UNITS, {"theta": 1})


def test_the_side_that_the_equations_were_derived_for_is_held():
    (theta,) = coordinates("theta")
    one_sided = ByHand(**{**vars(pendulum()), "assumed_positive": (sin(theta),)})
    started(one_sided, UNITS, {"theta": 1})
    with pytest.raises(ConstraintError, match="at the start"):
        started(one_sided, UNITS, {"theta": -1})


@pytest.mark.parametrize(
    ("forcing", "message"),
    [
        ({}, "no motion for X"),
        ({"Y": time}, "did you mean X|one of X"),
        ({"X": coordinates("x")[0]}, "depends on x"),
    ],
)
def test_prescribed_motions_are_checked(forcing, message):
    with pytest.raises(DeclarationError, match=message):
        simulate(oscillator(), {"m": 1, "k": 1}, {}, 1, forcing=forcing)


@pytest.mark.parametrize("duration", [0, -1, "1 m", float("nan"), "soon"])
def test_a_duration_must_be_a_positive_time(duration):
    with pytest.raises(UnitError):
        simulate(pendulum(), UNITS, {}, duration)


def test_samples_and_tolerance_are_checked():
    for wrong in ({"samples": 1}, {"samples": [0.0, 2.0]}, {"tolerance": -1.0}):
        with pytest.raises(NumericError):
            simulate(pendulum(), UNITS, {}, 1, **wrong)


def test_an_integrator_that_is_not_there_is_named(monkeypatch):
    monkeypatch.setenv("POLHODE_INTEGRATOR", "abacus")
    with pytest.raises(DeclarationError, match="abacus"):
        started(pendulum(), UNITS, {})


def test_a_singular_start_and_a_singular_end_are_reported(integrator):
    (x,) = coordinates("x")
    right = oscillator()
    falling = ByHand(
        **{**vars(right), "forcing": (-1 / x**2,), "functions": (), "power": right.energy * 0}
    )
    falling = ByHand(**{**vars(falling), "energy": x.dt() ** 2 / 2 - 1 / x})
    with pytest.raises(NumericError, match="no finite solution at the start"):
        simulate(falling, {"m": 1, "k": 1}, {}, 1)
    with pytest.raises(NumericError, match=r"cannot be continued|steps become too short"):
        simulate(falling, {"m": 1, "k": 1}, {"x": 1}, 2)


def test_what_has_no_equations_of_motion_is_refused():
    for attempt in (
        lambda: simulate("rolling-disk", {}, {}, 1),
        lambda: linearise("rolling-disk", {}, at={}),
    ):
        with pytest.raises(DeclarationError, match="'rolling-disk'"):
            attempt()


def test_parameters_that_occur_in_reactions_alone_may_be_given():
    """The force that holds a thrust at a distance d depends on d; the motion does not."""
    m, I, d, F = ph.symbols("m I d F", positive=True)
    lab = ph.Frame("lab")
    axes = lab.rotated(ph.coordinate("theta"), "z")
    body = ph.Body("body", mass=m, inertia=(I, I, I), axes=axes)
    push = ph.Force(body.point(lab["z"] * d), lab["x"] * F, name="push")
    system = ph.System(ph.Pivot(body), ph.Hinge(body, axis="z"), push)
    run = ph.simulate(system, {"F": 2.0, "d": 0.3, "m": 1.0, "I": 0.1}, {"theta_dot": 1.0}, "1 s")
    assert run["tau_y"][0] == pytest.approx(-0.6, abs=1e-12)
    with pytest.raises(ph.DeclarationError, match="'q' is no parameter"):
        ph.simulate(system, {"F": 2.0, "q": 0.3, "I": 0.1}, {"theta_dot": 1.0}, "1 s")


@pytest.mark.parametrize("distance", [0.3, 3 * 0.1])
def test_a_brake_that_locks_to_rounding_is_refused(distance):
    """c − e μ vanishes, or is the rounding of 3 · 0.1 alone: then it would stop within 1e-15 s."""
    m, I, c, e, F, mu = ph.symbols("m I c e F mu", positive=True)
    lab = ph.Frame("lab")
    drum = ph.Body(
        "drum", mass=m, inertia=(I, I, I), axes=lab.rotated(ph.coordinate("phi"), "z"), tag="d"
    )
    lever = ph.Body("lever", mass=m, inertia=(I, I, I), axes=lab, tag="l")
    reaction, shoe = ph.reaction("N_y_l"), lab["x"] * c - lab["y"] * e
    brake = ph.System(
        ph.Pivot(drum),
        ph.Hinge(drum, axis="z"),
        ph.Pivot(lever, force="P"),
        ph.Hinge(lever, axis="z"),
        ph.Hold(lever, at=shoe, only="y", force="N"),
        ph.Force(lever.point(lab["x"] * e), lab["y"] * -F, name="hand"),
        ph.Force(lever.point(shoe), lab["x"] * (-mu * reaction), name="friction"),
        ph.Torque(drum, lab["z"] * (-mu * e * reaction), name="friction on the drum"),
    )
    numbers = {"I": 0.1, "c": distance, "e": 1, "F": 1, "mu": 0.3}
    with pytest.raises(ph.NumericError, match="brake that its own friction locks"):
        ph.simulate(brake, numbers, {"phi_dot": 10}, "0.1 s")
    run = ph.simulate(brake, numbers | {"c": 0.4}, {"phi_dot": 10}, "0.1 s")
    # N = F e/(c − e μ)
    assert run.final["phi_dot"] == pytest.approx(10 - 0.3 * 10 / 0.1 * 0.1, abs=1e-12)
