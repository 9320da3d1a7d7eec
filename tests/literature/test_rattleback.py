"""A rattleback turns round when it is spun one way and hardly when it is spun the other.

An ellipsoid whose principal axes of inertia are turned against its half-axes, after T. R. Kane and
D. A. Levinson, Realistic mathematical modeling of the rattleback, Int. J. Non-Linear Mechanics 17
(1982) 175-186. Compared with Newton's and Euler's equations on rotation matrices.
"""

from functools import cache
from math import radians

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import polhode as ph

HALF_AXES = np.array([0.2, 0.03, 0.02])
INERTIA = np.array([[2e-4, 2e-5, 0], [2e-5, 1.6e-3, 0], [0, 0, 1.7e-3]])
G = 9.81
TILT = radians(0.5)
LAST = 5.0
TIMES = np.linspace(0.0, LAST, 101)


@cache
def stone() -> ph.System:
    lab = ph.Frame("lab")
    psi, phi, theta = ph.coordinates("psi phi theta")
    g, m, *moments = ph.symbols("g m A B C D")
    a, b, c, d = moments
    body = ph.ellipsoid(
        "stone",
        mass=m,
        half_axes=ph.symbols("a b c", positive=True),
        axes=lab.rotated(psi, "z").rotated(phi, "x").rotated(theta, "y"),
        inertia=((a, d, 0), (d, b, 0), (0, 0, c)),
    )
    return ph.System(ph.Rolling(body, on=ph.Plane(lab)), ph.Gravity(g), name="rattleback")


@cache
def spun(rate: float) -> ph.Trajectory:
    """The motion of the stone spun about the vertical, integrated once for all tests."""
    numbers = dict(zip("abc", HALF_AXES.tolist(), strict=True))
    numbers |= {"A": INERTIA[0, 0], "B": INERTIA[1, 1], "C": INERTIA[2, 2], "D": INERTIA[0, 1]}
    start = {"phi": TILT, "theta": TILT, "psi_dot": rate}
    return ph.simulate(stone(), {**numbers, "m": 1.0, "g": G}, start, LAST)


def spin(run):
    """The vertical part of the angular velocity."""
    psi_dot, theta_dot, phi = run.table(["psi_dot", "theta_dot", "phi"], TIMES).values()
    return psi_dot + theta_dot * np.sin(phi)


def cross(a, b):
    """`numpy.cross` takes ten times as long for single vectors."""
    return np.array(
        (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
    )


def oracle(rate):
    """The same by forces and moments, in axes of the body, on which `up` is the third of the lab's.

    Mass 1; r from the centre of mass to the contact, where the body is at rest.
    """

    def lowest(up):
        return -(HALF_AXES**2) * up / np.sqrt(np.sum((HALF_AXES * up) ** 2))

    def rates(_, state):
        omega, up = state[:3], state[3:]
        turning = -cross(omega, up)
        reach = np.sqrt(np.sum((HALF_AXES * up) ** 2))
        r = lowest(up)
        r_dot = -(HALF_AXES**2) * turning / reach - r * np.sum(HALF_AXES**2 * up * turning) / (
            reach**2
        )
        velocity = -cross(omega, r)
        steady = -cross(omega, r_dot) + cross(omega, velocity) + G * up
        moment = cross(r, steady) - cross(omega, INERTIA @ omega)
        about_contact = INERTIA + np.sum(r * r) * np.eye(3) - np.outer(r, r)
        return np.concatenate([np.linalg.solve(about_contact, moment), turning])

    tilted = np.array(
        [[np.cos(TILT), 0, -np.sin(TILT)], [0, 1, 0], [np.sin(TILT), 0, np.cos(TILT)]]
    ) @ np.array([0.0, np.sin(TILT), np.cos(TILT)])
    start = np.concatenate([rate * tilted, tilted])
    found = solve_ivp(
        rates, (0, LAST), start, method="DOP853", t_eval=TIMES, rtol=1e-12, atol=1e-14
    )
    return np.sum(found.y[:3] * found.y[3:], axis=0)


@pytest.mark.parametrize("rate", [5.0, -5.0])
def test_as_newton_and_euler_have_it(rate):
    run = spun(rate)
    assert spin(run) == pytest.approx(oracle(rate), abs=1e-8)
    assert run.drift.energy < 1e-13


def test_it_turns_round_one_way_only():
    assert spin(spun(5.0))[-1] < -3.5
    assert spin(spun(-5.0))[-1] < -4.5
