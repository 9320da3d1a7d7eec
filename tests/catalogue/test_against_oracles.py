"""Every catalogue system against Newton and Euler with multipliers, numbers only.

The oracles share no code with polhode: bodies in inertial coordinates, constraints as rows of a
linear system, solved by least squares.
"""

from __future__ import annotations

from functools import cache

import pytest

from derive.numeric import agree, motion_at
from oracles import balls, disks, gyroscopes
from oracles.draws import BALL, COMPASS, DISK, FREE, SHEET, TABLE, TOP, draw
from polhode.algebra import Expr, Kind, Symbol
from polhode.catalogue import CATALOGUE
from polhode.derive import Equations, derive

seeds = pytest.mark.parametrize("seed", range(12))


@cache
def equations(name: str) -> Equations:
    return derive(CATALOGUE[name].build())


def thin_disk(numbers: dict[str, float]) -> dict[str, float]:
    across = numbers["m"] * numbers["a"] ** 2 / 4
    return numbers | {"I_1": across, "I_3": 2 * across}


@seeds
def test_spinning_coin(seed):
    numbers = thin_disk(draw(DISK + " v_x v_y x y", seed))
    found = motion_at(equations("spinning-coin"), numbers)
    names = "theta_ddot phi_ddot omega_3_dot v_x_dot v_y_dot F_z"
    agree(found, disks.spinning_coin(**numbers), names)


@seeds
def test_rolling_disk(seed):
    numbers = thin_disk(draw(DISK, seed))
    found = motion_at(equations("rolling-disk"), numbers)
    names = "theta_ddot phi_ddot omega_3_dot F_x F_y F_z"
    agree(found, disks.rolling_disk(**numbers), names)


@seeds
def test_marble_on_a_level_turntable(seed):
    numbers = draw(TABLE, seed, alpha=0.0, Omega_dot=0.0)
    level = numbers | {
        "x": -numbers["x_3"],
        "y": numbers["x_2"],
        "v_x": -numbers["v_3"],
        "v_y": numbers["v_2"],
        "omega_z": numbers["omega_1"],
    }
    found = motion_at(equations("marble-on-turntable"), level)
    expected = balls.tilted_turntable(**numbers)
    turned = {
        "v_x_dot": -expected["v_3_dot"],
        "v_y_dot": expected["v_2_dot"],
        "omega_z_dot": expected["omega_1_dot"],
        "F_x": -expected["F_3"],
        "F_y": expected["F_2"],
        "F_z": expected["F_1"],
    }
    agree(found, turned, " ".join(turned))


@seeds
def test_marble_on_a_tilted_turntable(seed):
    numbers = draw(TABLE, seed, Omega_dot=0.0)
    found = motion_at(equations("marble-on-turntable/tilted"), numbers)
    agree(found, balls.tilted_turntable(**numbers), "v_2_dot v_3_dot omega_1_dot F_1 F_2 F_3")


@seeds
def test_gyrocompass(seed):
    numbers = draw(COMPASS + " m", seed)
    found = motion_at(equations("gyrocompass"), numbers)
    expected = gyroscopes.free_rotor_compass(**{k: numbers[k] for k in COMPASS.split()})
    agree(found, expected, "theta_ddot omega_dot tau_2")
    assert found["F_1"] == found["F_2"] == found["F_3"] == 0


@seeds
def test_gyrocompass_with_a_motor(seed):
    numbers = draw(COMPASS + " m", seed)
    driven = numbers | {"omega_0": numbers["omega"]}
    found = motion_at(equations("gyrocompass/motor"), driven)
    expected = gyroscopes.motor_driven_compass(**{k: numbers[k] for k in COMPASS.split()})
    agree(found, expected, "theta_ddot tau_2")
    assert found["tau_3"] == pytest.approx(expected["tau_motor_3"], rel=1e-12, abs=1e-12)


@seeds
def test_tennis_racquet(seed):
    numbers = draw(FREE, seed)
    found = motion_at(equations("tennis-racquet"), numbers | {"m": 1.0})
    agree(found, gyroscopes.free_body(**numbers), "omega_1_dot omega_2_dot omega_3_dot")


@seeds
def test_ball_on_paper(seed):
    numbers = draw(f"{BALL} {SHEET}", seed)
    ours = dict(numbers, r=numbers["a"])
    ours |= {f"chi{rate}": numbers[f"angle{rate}"] for rate in ("", "_dot", "_ddot")}
    found = motion_at(equations("ball-on-paper"), ours)
    names = "v_x_dot v_y_dot omega_z_dot F_x F_y F_z"
    agree(found, balls.rolling_on_paper(**numbers), names)


@seeds
def test_gyroscope(seed):
    numbers = draw(TOP + " theta_dot phi_dot", seed)
    found = motion_at(equations("gyroscope"), numbers)
    names = "theta_ddot phi_ddot omega_1_dot F_rho F_phi F_z"
    agree(found, gyroscopes.gyroscope(**numbers), names)


@seeds
def test_gyroscope_held_by_the_least_forces(seed):
    numbers = draw(TOP, seed)
    found = motion_at(equations("gyroscope/held"), numbers)
    names = "F_rho F_phi F_z Fprime_rho Fprime_phi Fprime_z"
    agree(found, gyroscopes.held_gyroscope(**numbers), names)


@seeds
def test_gyroscope_in_a_vertical_plane(seed):
    numbers = draw(TOP + " theta_dot", seed)
    found = motion_at(equations("gyroscope/vertical-plane"), numbers)
    names = "theta_ddot omega_1_dot F_rho F_phi F_z Fprime_phi"
    agree(found, gyroscopes.gyroscope_in_vertical_plane(**numbers), names)


@pytest.mark.parametrize("name", CATALOGUE)
def test_energy_changes_by_the_power_supplied(name):
    derived = equations(name)
    assert derived.rate(derived.energy) == derived.on_shell(derived.power)


HOLONOMIC = ["spinning-coin", "gyroscope", "gyroscope/upright"]


@pytest.mark.parametrize("name", HOLONOMIC)
def test_lagranges_equations_say_the_same(name):
    """d/dt ∂L/∂q̇ = ∂L/∂q for all coordinates, along the derived motion."""
    derived = equations(name)
    lagrangian = derived.lagrangian.subs(_speeds_by_rates(derived))
    for coordinate in derived.coordinates:
        momentum = lagrangian.diff(coordinate.derivative())
        slope = lagrangian.diff(coordinate)
        assert derived.rate(momentum) == derived.kinetics.on_speeds(slope)


def _speeds_by_rates(derived: Equations) -> dict[Symbol, Expr]:
    """Every speed that is no rate, in terms of rates: ω₃ = ψ̇ + φ̇ cos θ."""
    found = {}
    for rate, value in derived.kinematics.items():
        for speed in value.symbols() & set(derived.speeds):
            if speed.kind is Kind.SPEED:
                u = Expr.generator(speed)
                found[speed] = Expr.generator(rate) - (value - u)
    return found
