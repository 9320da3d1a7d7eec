"""The systems beyond the text against closed forms worked by hand."""

from __future__ import annotations

from math import cos, sin, sqrt

import numpy as np

from . import disks, extras, gyroscopes, linkages
from .draws import DISK, ELLIPSOID, GIMBALS, PENDULUM, WHEELS, draw, near, seeds
from .parts import turn_x, turn_z
from .scenario import Numbers


@seeds
def test_gimbals_without_inertia_leave_a_top(seed: int) -> None:
    s = draw(GIMBALS, seed, C_o=0.0, A_i=0.0, B_i=0.0, C_i=0.0)
    q, found = Numbers(**s), extras.gimballed_gyroscope(**s)
    top = gyroscopes.gyroscope(
        M=q.m, a=q.a, g=q.g, I_1=q.I_3, I_2=q.I_1, theta=q.theta, theta_dot=q.theta_dot,
        phi_dot=q.phi_dot, omega_1=q.omega_3,
    )  # fmt: skip
    assert found["theta_ddot"] == near(top["theta_ddot"])
    assert found["phi_ddot"] == near(top["phi_ddot"])
    assert found["F_z"] == near(top["F_z"])


@seeds
def test_flat_round_ellipsoid_is_a_disk(seed: int) -> None:
    s = draw(DISK, seed)
    q, disk = Numbers(**s), disks.rolling_disk(**s)
    flat = extras.rolling_ellipsoid(
        m=q.m, g=q.g, b_1=q.a, b_2=q.a, b_3=0.0, I_1=q.I_1, I_2=q.I_1, I_3=q.I_3, theta=q.theta,
        phi=q.phi, psi=0.0, omega_1=q.theta_dot, omega_2=q.phi_dot * sin(q.theta),
        omega_3=q.omega_3,
    )  # fmt: skip
    assert [flat[f"F_{i}"] for i in "xyz"] == near([disk[f"F_{i}"] for i in "xyz"])
    assert flat["omega_3_dot"] == near(disk["omega_3_dot"])


@seeds
def test_double_pendulum_has_lagranges_equations(seed: int) -> None:
    q = Numbers(**draw(PENDULUM, seed))
    found = linkages.double_pendulum(**vars(q))
    apart = q.theta_1 - q.theta_2
    across = q.m_2 * q.l_1 * q.l_2 / 2
    mass = [
        [(q.m_1 / 3 + q.m_2) * q.l_1**2, across * cos(apart)],
        [across * cos(apart), q.m_2 * q.l_2**2 / 3],
    ]
    torque = [
        -across * sin(apart) * q.theta_2_dot**2
        - (q.m_1 / 2 + q.m_2) * q.g * q.l_1 * sin(q.theta_1),
        across * sin(apart) * q.theta_1_dot**2 - q.m_2 * q.g * q.l_2 / 2 * sin(q.theta_2),
    ]
    expected = np.linalg.solve(mass, torque)
    assert [found["theta_1_ddot"], found["theta_2_ddot"]] == near(expected)


def test_parallelogram_translates_its_coupler() -> None:
    found = linkages.four_bar(
        m_1=0.0, m_2=1.5, m_3=0.0, l_1=0.6, l_2=1.1, l_3=0.6, d=1.1, g=9.8, branch=1.0,
        theta_1=0.9, theta_1_dot=1.7,
    )  # fmt: skip
    assert found["theta_3"] == near(0.9)
    assert [found["theta_2"], found["theta_2_dot"], found["theta_2_ddot"]] == near([0, 0, 0])
    assert found["theta_1_ddot"] == near(-9.8 / 0.6 * cos(0.9))


@seeds
def test_wheels_on_an_axle_turn_as_the_axles_offset_makes_them(seed: int) -> None:
    """With v = forward speed of the middle and Omega = phi_dot; e is along the axle."""
    q = Numbers(**draw(WHEELS, seed))
    found = extras.wheels_on_axle(**vars(q))
    spin, turning = q.psi_1_dot + q.psi_2_dot, found["phi_dot"]
    total, v = q.M + 2 * q.m, q.a * spin / 2
    v_dot = q.a * (found["psi_1_ddot"] + found["psi_2_ddot"]) / 2
    axle_dot = v_dot - q.c * found["phi_ddot"]
    pull = -q.g * sin(q.alpha) * sin(q.phi)
    assert q.M * axle_dot + 2 * (q.m + q.I_3 / q.a**2) * v_dot == near(total * pull)

    wheels = 2 * q.I_1 + 2 * q.b**2 * (q.m + q.I_3 / q.a**2)
    yaw = (q.J + wheels) * found["phi_ddot"] - q.c * q.M * axle_dot
    assert yaw == near(-q.c * q.M * pull)

    weight = total * q.g * cos(q.alpha)
    assert found["N_1"] + found["N_2"] == near(weight)
    sideways = q.M * (v - q.c * turning) * turning + 2 * q.m * v * turning
    sideways += total * q.g * sin(q.alpha) * cos(q.phi)
    overturning = q.c * q.M * q.g * cos(q.alpha) - q.a * sideways - q.I_3 * spin * turning
    assert q.b * (found["N_1"] - found["N_2"]) == near(overturning)


@seeds
def test_gimbals_add_their_inertia_to_lagranges_equations(seed: int) -> None:
    q = Numbers(**draw(GIMBALS, seed))
    found = extras.gimballed_gyroscope(**vars(q))
    s, c, I_p = sin(q.theta), cos(q.theta), q.I_1 + q.m * q.a**2
    across, axial = q.B_i + I_p, q.I_3 * q.omega_3
    about_1 = (across - q.C_i) * q.phi_dot**2 * s * c - axial * q.phi_dot * s + q.m * q.g * q.a * s
    about_z = q.theta_dot * s * (axial - 2 * (across - q.C_i) * q.phi_dot * c)
    assert found["theta_ddot"] == near(about_1 / (q.A_i + I_p))
    assert found["phi_ddot"] == near(about_z / (q.C_o + across * s**2 + q.C_i * c**2))
    assert found["omega_3_dot"] == near(0)


@seeds
def test_rolling_ellipsoid_obeys_its_support_function_and_euler(seed: int) -> None:
    """Height h² = Σ (b_i n_i)², where n, the vertical in the body's axes, turns by n × omega."""
    q = Numbers(**draw(ELLIPSOID, seed))
    found = extras.rolling_ellipsoid(**vars(q))
    up = np.array([sin(q.theta) * sin(q.psi), sin(q.theta) * cos(q.psi), cos(q.theta)])
    omega = np.array([q.omega_1, q.omega_2, q.omega_3])
    omega_dot = np.array([found[f"omega_{i}_dot"] for i in (1, 2, 3)])
    up_dot = np.cross(up, omega)
    up_ddot = np.cross(up_dot, omega) + np.cross(up, omega_dot)
    squares = np.array([q.b_1, q.b_2, q.b_3]) ** 2
    height = sqrt(squares @ up**2)
    climb = squares @ (up * up_dot) / height
    lift = (squares @ (up_dot**2 + up * up_ddot) - climb**2) / height
    assert found["F_z"] == near(q.m * (q.g + lift))

    attitude = turn_z(q.phi) @ turn_x(q.theta) @ turn_z(q.psi)
    force = np.array([found["F_x"], found["F_y"], found["F_z"]]) @ attitude
    moments = np.array([q.I_1, q.I_2, q.I_3])
    torque = np.cross(-squares * up / height, force)
    assert moments * omega_dot + np.cross(omega, moments * omega) == near(torque)
