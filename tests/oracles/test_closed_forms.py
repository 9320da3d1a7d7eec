"""The text's systems against closed forms worked by hand, most of them its own components."""

from __future__ import annotations

from collections.abc import Callable
from math import cos, hypot, sin, sqrt

import numpy as np
import pytest

from . import balls, disks, gyroscopes
from .draws import (
    BALL,
    COMPASS,
    DISK,
    FREE,
    SHEET,
    TABLE,
    TOP,
    draw,
    near,
    seeds,
    sheet_velocity,
    sliding_contact,
)
from .scenario import Numbers

Oracle = Callable[..., dict[str, float]]


@seeds
def test_spinning_coin_has_lagranges_equations(seed: int) -> None:
    q = Numbers(**draw(DISK + " v_x v_y", seed))
    found = disks.spinning_coin(**vars(q))
    s, c, ma2 = sin(q.theta), cos(q.theta), q.m * q.a**2
    torque = s * (q.I_1 * q.phi_dot**2 * c - q.I_3 * q.omega_3 * q.phi_dot) - q.m * q.g * q.a * c
    theta_ddot = (torque + ma2 * q.theta_dot**2 * s * c) / (q.I_1 + ma2 * c**2)
    phi_ddot = (q.I_3 * q.omega_3 - 2 * q.I_1 * q.phi_dot * c) * q.theta_dot / (q.I_1 * s)
    assert found["theta_ddot"] == near(theta_ddot)
    assert found["phi_ddot"] == near(phi_ddot)
    assert [found[n] for n in ("omega_3_dot", "v_x_dot", "v_y_dot")] == near([0, 0, 0])
    lift = q.a * (theta_ddot * c - q.theta_dot**2 * s)
    assert found["F_z"] == near(q.m * (q.g + lift))


@seeds
def test_rolling_disk_has_the_components_of_its_vector_equation(seed: int) -> None:
    q = Numbers(**draw(DISK, seed))
    found = disks.rolling_disk(**vars(q))
    s, c, ma2 = sin(q.theta), cos(q.theta), q.m * q.a**2
    gyro = q.I_1 * q.phi_dot * c - (q.I_3 + ma2) * q.omega_3
    about_1 = gyro * q.phi_dot * s - q.m * q.g * q.a * c
    about_2 = (q.I_3 * q.omega_3 - 2 * q.I_1 * q.phi_dot * c) * q.theta_dot
    about_3 = ma2 * q.theta_dot * q.phi_dot * s
    assert found["theta_ddot"] == near(about_1 / (q.I_1 + ma2))
    assert found["phi_ddot"] == near(about_2 / (q.I_1 * s))
    assert found["omega_3_dot"] == near(about_3 / (q.I_3 + ma2))


def test_uniform_disk_rolls_steadily_at_the_rates_of_eq_6() -> None:
    theta, omega_3, g, a = 1.1, 2.0, 9.8, 0.3
    b, c = -6 * omega_3 * sin(theta), -4 * g / a * cos(theta)
    lead = sin(theta) * cos(theta)
    for sign in (1, -1):
        phi_dot = (-b + sign * sqrt(b * b - 4 * lead * c)) / (2 * lead)
        found = disks.rolling_disk(
            m=1.0, a=a, g=g, I_1=a**2 / 4, I_3=a**2 / 2, theta=theta, theta_dot=0.0,
            phi_dot=phi_dot, omega_3=omega_3,
        )  # fmt: skip
        accelerations = [found[n] for n in ("theta_ddot", "phi_ddot", "omega_3_dot")]
        assert accelerations == pytest.approx([0, 0, 0], abs=1e-10)


@seeds
def test_marble_turns_at_two_sevenths_and_the_slope_adds_five_sevenths(seed: int) -> None:
    q = Numbers(**draw(TABLE, seed, Omega_dot=0.0))
    q.I = 2 / 5 * q.m * q.a**2
    found = balls.tilted_turntable(**vars(q))
    down = 5 / 7 * q.g * sin(q.alpha)
    assert found["v_2_dot"] == near(-2 / 7 * q.Omega * q.v_3 - down)
    assert found["v_3_dot"] == near(2 / 7 * q.Omega * q.v_2)
    assert found["omega_1_dot"] == near(0)
    assert found["F_1"] == near(q.m * q.g * cos(q.alpha))


@seeds
def test_level_turntable_is_the_tilted_one_in_lab_names(seed: int) -> None:
    q = Numbers(**draw("m a I g Omega Omega_dot x y v_x v_y omega_z", seed))
    found = balls.level_turntable(**vars(q))
    share = q.I / (q.I + q.m * q.a**2)
    assert found["v_x_dot"] == near(share * (-q.Omega * q.v_y - q.Omega_dot * q.y))
    assert found["v_y_dot"] == near(share * (q.Omega * q.v_x + q.Omega_dot * q.x))
    assert [found["F_z"], found["omega_z_dot"]] == near([q.m * q.g, 0])


@seeds
def test_ball_on_paper_takes_its_share_of_the_sheets_acceleration(seed: int) -> None:
    q = Numbers(**draw(f"{BALL} {SHEET}", seed))
    found = balls.rolling_on_paper(**vars(q))
    away = np.array([q.x - q.X, q.y - q.Y])
    apart = np.array([q.v_x - q.X_dot, q.v_y - q.Y_dot])
    quarter = np.array([[0, -1], [1, 0]])
    sheet = np.array([q.X_ddot, q.Y_ddot])
    sheet = sheet + q.angle_ddot * quarter @ away + q.angle_dot * quarter @ apart
    share = q.k / (1 + q.k)
    assert [found["v_x_dot"], found["v_y_dot"]] == near(share * sheet)
    assert found["omega_z_dot"] == near(0)


@seeds
def test_sliding_ball_is_braked_at_mu_g_against_its_slip(seed: int) -> None:
    s = draw(f"{BALL} mu omega_x omega_y {SHEET}", seed)
    q, found = Numbers(**s), balls.sliding_on_paper(**s)
    slip = sliding_contact(s) - sheet_velocity(s)
    braking = -q.mu * q.g * slip / hypot(*slip)
    assert [found["v_x_dot"], found["v_y_dot"]] == near(braking)
    spin = np.array([found["omega_x_dot"], found["omega_y_dot"]])
    assert spin == near(np.array([braking[1], -braking[0]]) / (q.k * q.a))


@seeds
@pytest.mark.parametrize("oracle", [gyroscopes.free_rotor_compass, gyroscopes.motor_driven_compass])
def test_compass_has_the_components_of_eq_72(oracle: Oracle, seed: int) -> None:
    q = Numbers(**draw(COMPASS, seed))
    found = oracle(**vars(q))
    up, north = q.Omega * cos(q.lambda_), q.Omega * sin(q.lambda_)
    east, along = north * sin(q.theta), north * cos(q.theta)
    turning, spin = up - q.theta_dot, q.omega + along
    theta_ddot = east * (q.I_1 * along - q.I_3 * spin) / q.I_1
    guide = -q.I_1 * q.theta_dot * along + (q.I_1 * along - q.I_3 * spin) * turning
    about_3 = q.I_3 * (found["omega_dot"] - q.theta_dot * east)
    assert found["theta_ddot"] == near(theta_ddot)
    assert [found["tau_1"], found["tau_2"], found["tau_3"]] == near([0, guide, 0])
    assert found.get("tau_motor_3", 0.0) == near(about_3)
    if "tau_motor_3" in found:
        assert found["omega_dot"] == near(0)


@seeds
def test_free_body_obeys_eulers_equations(seed: int) -> None:
    q = Numbers(**draw(FREE, seed))
    found = gyroscopes.free_body(**vars(q))
    assert found["omega_1_dot"] == near((q.I_2 - q.I_3) * q.omega_2 * q.omega_3 / q.I_1)
    assert found["omega_2_dot"] == near((q.I_3 - q.I_1) * q.omega_3 * q.omega_1 / q.I_2)
    assert found["omega_3_dot"] == near((q.I_1 - q.I_2) * q.omega_1 * q.omega_2 / q.I_3)
    assert [found[f"L_{i}_dot"] for i in "xyz"] == near([0, 0, 0])


@seeds
def test_gyroscope_has_the_torque_about_its_pivot(seed: int) -> None:
    q = Numbers(**draw(TOP + " theta_dot phi_dot", seed))
    found = gyroscopes.gyroscope(**vars(q))
    s, c, I_p = sin(q.theta), cos(q.theta), q.I_2 + q.M * q.a**2
    about_2 = q.M * q.g * q.a * s + q.phi_dot * s * (I_p * q.phi_dot * c - q.I_1 * q.omega_1)
    about_3 = q.theta_dot * (q.I_1 * q.omega_1 - 2 * I_p * q.phi_dot * c)
    theta_ddot, phi_ddot = about_2 / I_p, about_3 / (I_p * s)
    assert found["theta_ddot"] == near(theta_ddot)
    assert found["phi_ddot"] == near(phi_ddot)
    assert found["omega_1_dot"] == near(0)
    inward = (q.theta_dot**2 + q.phi_dot**2) * s
    assert found["F_rho"] == near(q.M * q.a * (theta_ddot * c - inward))
    assert found["F_phi"] == near(q.M * q.a * (phi_ddot * s + 2 * q.phi_dot * q.theta_dot * c))
    assert found["F_z"] == near(q.M * (q.g - q.a * (theta_ddot * s + q.theta_dot**2 * c)))


@seeds
def test_held_gyroscope_is_carried_half_and_half(seed: int) -> None:
    s = draw(TOP, seed)
    found = gyroscopes.held_gyroscope(**s)
    for force in ("F", "Fprime"):
        components = [found[f"{force}_{axis}"] for axis in ("rho", "phi", "z")]
        assert components == near([0, 0, s["M"] * s["g"] / 2])


@seeds
def test_gyroscope_in_a_vertical_plane_falls_as_if_it_did_not_spin(seed: int) -> None:
    q = Numbers(**draw(TOP + " theta_dot", seed))
    found = gyroscopes.gyroscope_in_vertical_plane(**vars(q))
    s, c = sin(q.theta), cos(q.theta)
    theta_ddot = q.M * q.g * q.a * s / (q.I_2 + q.M * q.a**2)
    guide = -q.I_1 * q.omega_1 * q.theta_dot / (2 * q.a)
    assert found["theta_ddot"] == near(theta_ddot)
    assert [found["Fprime_phi"], found["F_phi"]] == near([guide, -guide])
    assert found["F_rho"] == near(q.M * q.a * (theta_ddot * c - q.theta_dot**2 * s))
    assert found["F_z"] == near(q.M * (q.g - q.a * (theta_ddot * s + q.theta_dot**2 * c)))
