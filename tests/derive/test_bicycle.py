"""A bicycle in named parts: against the numeric oracle, and as a motion."""

from functools import cache

import numpy as np
import pytest

import polhode as ph
from derive.bicycles import BENCHMARK, bicycle
from derive.states import Numeric, agree
from oracles import bicycles as oracle

ANYWHERE = {"x_R": 0.4, "y_R": -0.3, "chi_R": 0.5, "chi_F": -0.7}


@cache
def numeric() -> Numeric:
    return Numeric(bicycle())


def state(seed: int) -> dict[str, float]:
    """The benchmark bicycle, its lengths and masses changed somewhat, anywhere, at any speed."""
    random = np.random.default_rng(seed)
    varied = {n: v * random.uniform(0.95, 1.05) for n, v in BENCHMARK.items()}
    angles = {"psi": random.uniform(-3, 3), "phi": random.uniform(-0.5, 0.5)}
    steered = {"delta": random.uniform(-0.8, 0.8)}
    speeds = {"phi_dot": random.normal(), "delta_dot": random.normal()}
    return varied | angles | steered | speeds | {"omega_y_R": random.uniform(-30, 30)}


@pytest.mark.parametrize("seed", range(6))
def test_accelerations_and_forces_of_the_ground_are_the_oracles(seed: int) -> None:
    given = state(seed)
    expected = oracle.bicycle(**given)
    found = numeric().at(**given, **ANYWHERE, theta=expected["theta"])
    agree(found, expected, ["phi_ddot", "delta_ddot", "omega_y_R_dot"], 1e-10)
    agree(found, expected, [f"F_{i}_{wheel}" for i in "xyz" for wheel in "RF"], 1e-10)
    agree(found, expected, ["T_dot", "V_dot"], 1e-10)


def test_nothing_is_special_about_a_heading() -> None:
    """Along the axes of the ground some entries vanish that serve as pivots elsewhere."""
    given = state(0)
    expected = oracle.bicycle(**given)
    for heading in (0.0, np.pi / 2, np.pi):
        turned = {**given, "psi": heading, "theta": expected["theta"]}
        found = numeric().at(**turned, **ANYWHERE)
        agree(found, expected, ["phi_ddot", "delta_ddot", "omega_y_R_dot"], 1e-10)
        agree(found, expected, ["F_z_R", "F_z_F"], 1e-10)


def test_it_prints_in_a_few_lines() -> None:
    equations = bicycle()
    assert equations.in_parts
    assert len(str(equations)) < 1500
    assert len(equations.latex()) < 500
    assert not equations.undetermined


def test_what_needs_a_closed_form_is_refused() -> None:
    for analysis in (ph.steady, ph.linear_integrals):
        with pytest.raises(ph.NumericError, match=r"named parts; .*linearise"):
            analysis(bicycle())
    with pytest.raises(ph.NumericError, match="written out"):
        ph.to_sympy(bicycle().motion[0])


def test_its_energy_is_constant_whatever_the_state() -> None:
    equations = bicycle()
    assert equations.rate(equations.energy).is_zero
    assert equations.on_shell(equations.power).is_zero
    assert not equations.rate(equations.kinetic_energy).is_zero


def test_uncontrolled_it_steers_itself_upright_and_keeps_its_energy() -> None:
    """The start of figure 4 of the benchmark, at a speed between weave and capsize."""
    start = {"phi": 0, "delta": 0, "phi_dot": 0.5, "omega_y_R": 4.6 / BENCHMARK["r_R"]}
    run = ph.simulate(bicycle(), BENCHMARK, start, 10)
    assert run.drift.energy < 1e-13
    assert run.drift.constraint < 1e-13
    assert abs(run["phi"][-1]) < 0.003 < 0.05 < np.max(np.abs(run["phi"]))
    assert run["omega_y_R"][-1] > start["omega_y_R"]
    weight = sum(BENCHMARK[f"m_{body}"] for body in "RBHF") * BENCHMARK["g"]
    assert run["F_z_R"][-1] + run["F_z_F"][-1] == pytest.approx(weight, rel=1e-3)
