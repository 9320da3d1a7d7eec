"""Forces between points of bodies in any attitude, whose distance is too long to divide by.

Oracle: Newton's and Euler's laws on rotation matrices, by SciPy.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import polhode as ph
from oracles.parts import skew, turn_x, turn_y

LAB = ph.Frame("lab")
m, M, A, B, C, a, h, k, K, l, g = ph.symbols("m M A B C a h k K l g", positive=True)
NUMBERS = {m: 1, M: 2, A: 0.5, B: 0.6, C: 0.7, a: 0.3, h: 0.4, k: 1.0}


def free_body(tag, mass, moments):
    phi, theta, psi = ph.coordinates(f"phi_{tag} theta_{tag} psi_{tag}")
    axes = LAB.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    return ph.Body(
        f"body {tag}", mass=mass, inertia=moments, axes=axes, spin=ph.Components(), tag=tag
    )


ONE, OTHER = free_body("1", m, (A, B, C)), free_body("2", M, (B, C, A))
ENDS = ONE.point(ONE.axes["1"] * a), OTHER.point(OTHER.axes["2"] * h)
d = ph.symbol("d", positive=True)
FORCES = {
    "central force": (
        ph.CentralForce(*ENDS, energy=-k / d + K * d**2 / 2, distance=d),
        {K: 0.5},
        lambda distance: -1 / distance**2 - 0.5 * distance,
    ),
    "spring": (
        ph.Spring(*ENDS, stiffness=k, length=l),
        {l: 1.5},
        lambda distance: 1.5 - distance,
    ),
}


@pytest.mark.parametrize("name", FORCES)
def test_two_free_bodies_attract_each_other_at_points_off_their_centres(name):
    load, more, push = FORCES[name]
    start = {"theta_1": 1.0, "theta_2": 1.2, "x_2": 2, "y_2": 0.3}
    start |= {"omega_1_1": 0.5, "omega_3_2": -0.7, "v_y_1": 0.2}
    run = ph.simulate(ph.System(load), NUMBERS | more, start, 2)

    masses, inertias = (1, 2), (np.diag([0.5, 0.6, 0.7]), np.diag([0.6, 0.7, 0.5]))
    arms = np.array([0.3, 0, 0]), np.array([0, 0.4, 0])

    def laws(_, state):
        places, velocities, turning = state[:18].reshape(3, 2, 3)
        attitudes = state[18:].reshape(2, 3, 3)
        points = [p + R @ arm for p, R, arm in zip(places, attitudes, arms, strict=True)]
        apart = points[0] - points[1]
        distance = np.linalg.norm(apart)
        force = push(distance) * apart / distance
        accelerations, spins = np.empty((2, 3)), np.empty((2, 3))
        for i, f in enumerate((force, -force)):
            R, w = attitudes[i], turning[i]
            couple = R.T @ np.cross(R @ arms[i], f)
            accelerations[i] = f / masses[i]
            spins[i] = np.linalg.solve(inertias[i], couple - np.cross(w, inertias[i] @ w))
        rates = [R @ skew(w) for R, w in zip(attitudes, turning, strict=True)]
        return np.concatenate([x.ravel() for x in (velocities, accelerations, spins, *rates)])

    begin = [0, 0, 0, 2, 0.3, 0, 0, 0.2, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, -0.7]
    begin = [*begin, *turn_x(1.0).ravel(), *turn_x(1.2).ravel()]
    found = solve_ivp(laws, (0, 2), begin, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    names = [
        *(f"{q}_{t}" for t in "12" for q in "xyz"),
        *(f"v_{q}_{t}" for t in "12" for q in "xyz"),
    ]
    names += [f"omega_{i}_{t}" for t in "12" for i in "123"]
    assert [run.final[name] for name in names] == pytest.approx(found[:18], abs=1e-9)
    assert run.drift.energy < 1e-11


def test_a_rope_through_an_eye_of_a_pendulum_on_universal_joints():
    """Accelerations at the start by one linear system in maximal coordinates."""
    R, z_0 = ph.symbols("R z_0")
    angles = ph.coordinates("alpha beta gamma delta")
    alpha, beta, gamma, delta = angles
    upper_axes = LAB.rotated(alpha, "x").rotated(beta, "y")
    lower_axes = upper_axes.rotated(gamma, "x").rotated(delta, "y")
    upper = ph.Body("upper", mass=m, inertia=(A, B, C), axes=upper_axes, tag="1")
    lower = ph.Body("lower", mass=M, inertia=(B, A, C), axes=lower_axes, tag="2")
    bob = ph.point_mass("bob", mass=K, axes=LAB, tag="b")
    system = ph.System(
        ph.Pivot(upper, at=upper_axes["z"] * l, name="top", force="P"),
        ph.Universal(upper, arm=upper_axes["y"], other_arm=LAB["x"], torque="sigma"),
        ph.Pivot(
            lower, at=lower_axes["z"] * l, to=upper.point(upper_axes["z"] * -l), name="middle"
        ),
        ph.Universal(lower, arm=lower_axes["y"], other_arm=upper_axes["x"], to=upper),
        ph.Rope([bob.point(), lower.point(lower_axes["x"] * a), LAB["x"] * R + LAB["z"] * z_0]),
        ph.Gravity(g),
    )
    numbers = {
        m: 1,
        M: 1.5,
        K: 0.7,
        A: 0.05,
        B: 0.06,
        C: 0.02,
        l: 0.4,
        a: 0.2,
        R: 1,
        z_0: 0.3,
        g: 9.81,
    }
    start = dict(zip(angles, (0.3, -0.2, 0.4, 0.3), strict=True))
    run = ph.simulate(system, numbers, start | {"x_b": 0.6, "y_b": 0.3, "z_b": -2.0}, 1e-3)

    # from rest: M q̈ + Jᵀ λ = Q and J q̈ = 0, in the velocities and rotations of three bodies
    first = turn_x(0.3) @ turn_y(-0.2)
    second = first @ turn_x(0.4) @ turn_y(0.3)
    up = np.array([0, 0, 0.4])
    joint = -2 * first @ up
    centre = joint - second @ up
    eye = second @ np.array([0.2, 0, 0])
    one, two = centre + eye - np.array([0.6, 0.3, -2.0]), np.array([1, 0, 0.3]) - centre - eye
    one, two = one / np.linalg.norm(one), two / np.linalg.norm(two)
    zero, unit = np.zeros((3, 3)), np.eye(3)
    rows = [
        np.hstack([unit, -skew(first @ up), zero, zero, zero]),
        np.hstack([-unit, -skew(first @ up), unit, -skew(second @ up), zero]),
        np.hstack([np.zeros(3), np.cross(first[:, 1], unit[0]), np.zeros(9)]),
        np.hstack(
            [
                np.zeros(3),
                -np.cross(second[:, 1], first[:, 0]),
                np.zeros(3),
                np.cross(second[:, 1], first[:, 0]),
                np.zeros(3),
            ]
        ),
        np.hstack([np.zeros(6), one - two, np.cross(eye, one - two), -one]),
    ]
    table = np.vstack(rows)
    mass = np.zeros((15, 15))
    for at, value in ((0, 1), (6, 1.5), (12, 0.7)):
        mass[at : at + 3, at : at + 3] = value * unit
    mass[3:6, 3:6] = first @ np.diag([0.05, 0.06, 0.02]) @ first.T
    mass[9:12, 9:12] = second @ np.diag([0.06, 0.05, 0.02]) @ second.T
    loads = np.zeros(15)
    loads[[2, 8, 14]] = -9.81 * np.array([1, 1.5, 0.7])
    whole = np.block([[mass, table.T], [table, np.zeros((len(table), len(table)))]])
    solved = np.linalg.solve(whole, np.concatenate([loads, np.zeros(len(table))]))
    found = [run.evaluate(f"{q}_b_ddot", 0.0) for q in "xyz"]
    assert found == pytest.approx(solved[12:15], rel=1e-10)
    assert run.evaluate("S_b", 0.0) == pytest.approx(solved[-1], rel=1e-10)
