"""Every check fails when what it checks is wrong, and holds when it is right."""

from dataclasses import replace

import pytest

from polhode.catalogue import PROBLEM_SET
from polhode.simulate import simulate
from polhode.tour._checks import (
    ALLOWED,
    appell,
    decided,
    displacement_balance,
    exact_checks,
    is_holonomic,
    lagrange,
    measured,
    numeric_checks,
)

ROLLING = ["rolling-disk", "marble-on-turntable", "marble-on-turntable/tilted", "ball-on-paper"]
HOLONOMIC = [name for name in PROBLEM_SET if name not in ROLLING]


def outcome(checks):
    return {check.name: check.passed for check in checks}


def exact(equations):
    return outcome(exact_checks(equations))


def numeric(run, equations):
    return outcome(numeric_checks(run, equations, displacement_balance(run, equations)))


@pytest.mark.parametrize("name", list(PROBLEM_SET))
def test_all_hold(worked_out, name):
    equations, run = worked_out(name)
    assert set(exact(equations).values()) == {True}
    assert set(numeric(run, equations).values()) == {True}


@pytest.mark.parametrize("name", HOLONOMIC)
def test_lagrange_serves_holonomic_systems(worked_out, name):
    equations, _ = worked_out(name)
    assert is_holonomic(equations)
    assert "Lagrange's equations" in exact(equations)


@pytest.mark.parametrize("name", ROLLING)
def test_gibbs_and_appell_serve_rolling_ones(worked_out, name):
    equations, _ = worked_out(name)
    assert not is_holonomic(equations)
    assert "Gibbs–Appell equations" in exact(equations)


@pytest.mark.parametrize("name", HOLONOMIC)
def test_both_formulations_agree_where_both_serve(worked_out, name):
    equations, _ = worked_out(name)
    assert all(residual.is_zero for residual in (*lagrange(equations), *appell(equations)))


@pytest.mark.parametrize("name", ["spinning-coin", "gyrocompass", "gyroscope"])
def test_wrong_accelerations_are_found_by_lagrange_and_the_power(worked_out, name):
    equations, _ = worked_out(name)
    wrong = replace(equations, forcing=tuple(2 * force for force in equations.forcing))
    found = exact(wrong)
    assert not found["Lagrange's equations"]
    assert not found["Power balance"]


@pytest.mark.parametrize("name", ROLLING)
def test_wrong_rows_are_found_by_appell(worked_out, name):
    equations, _ = worked_out(name)
    *right, last = equations.rows
    assert not exact(replace(equations, rows=(*right, 2 * last + 1)))["Gibbs–Appell equations"]


@pytest.mark.parametrize("name", ["rolling-disk", "gyroscope", "ball-on-paper"])
def test_a_wrong_velocity_breaks_the_constraints(worked_out, name):
    equations, run = worked_out(name)
    motion = equations.kinetics
    shifted = {body: (v * 2, w) for body, (v, w) in motion.velocities.items()}
    wrong = replace(equations, kinetics=replace(motion, velocities=shifted))
    assert not exact(wrong)["Constraints"]
    assert not numeric(run, wrong)["Constraints of the run"]


@pytest.mark.parametrize("name", ["spinning-coin", "rolling-disk", "ball-on-paper", "gyroscope"])
def test_a_wrong_reaction_breaks_the_momentum(worked_out, name):
    equations, run = worked_out(name)
    assert not numeric(run, with_wrong_forces(equations))["Momentum of the run"]


@pytest.mark.parametrize("name", ["rolling-disk", "gyrocompass", "ball-on-paper", "gyroscope"])
def test_a_wrong_reaction_breaks_the_angular_momentum(worked_out, name):
    equations, run = worked_out(name)
    found = numeric(run, with_wrong_forces(equations))
    assert not found["Angular momentum of the run"]


def with_wrong_forces(equations):
    """The same equations with every reaction a little too large."""
    wrong = replace(equations)
    vars(wrong)["least"] = {name: value * 1.001 for name, value in equations.least.items()}
    return wrong


def test_a_coarse_integration_is_found(worked_out):
    equations, run = worked_out("rolling-disk")
    coarse = simulate(
        equations,
        dict(run.parameters),
        {"theta": 1.4, "phi_dot": 1, "omega_3": 40},
        10,
        tolerance=1e-4,
    )
    assert not numeric(coarse, equations)["Energy of the run"]


def test_a_quantity_that_is_not_conserved_is_found(worked_out):
    equations, run = worked_out("rolling-disk")
    watched = replace(run, invariants={"F_z": run.quantities["theta"]})
    assert not numeric(watched, equations)["Conserved quantities of the run"]


def test_a_failed_decision_shows_what_is_left(worked_out):
    equations, _ = worked_out("gyroscope")
    check = decided("name", "how", [equations.rows[2] * 0, equations.rows[2]])
    assert not check.passed
    assert check.found == equations.rows[2].pretty()


def test_not_a_number_never_passes():
    assert not measured("name", "how", float("nan")).passed
    assert not measured("name", "how", 2 * ALLOWED).passed
    assert measured("name", "how", 1e-15).found == "1.0 × 10⁻¹⁵"
