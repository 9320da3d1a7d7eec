"""Bodies that roll and slide, against Newton and Euler by rotation matrices and closed forms.

The oracles know no angles: a body's attitude is a matrix, and forces follow from the accelerations
of the point of contact.
"""

from math import cos, sin, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import polhode as ph

LAB = ph.Frame("lab")
GRAVITY = 9.81
UP = np.array([0, 0, 1.0])


def cross(vector):
    x, y, z = vector
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def turned(sequence, angles):
    matrix = np.eye(3)
    for axis, angle in zip(sequence, angles, strict=True):
        i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
        one = np.eye(3)
        one[i, i] = one[j, j] = cos(angle)
        one[j, i], one[i, j] = sin(angle), -sin(angle)
        matrix = matrix @ one
    return matrix


def solved(rates, start, duration):
    found = solve_ivp(rates, (0, duration), start, method="DOP853", rtol=3e-14, atol=1e-15)
    return found.y[:, -1]


def test_an_ellipsoid_of_three_axes_rolls():
    """J. Walker's celt without its asymmetry: −r = H² n/√(n·H² n) from the centre to the floor."""
    m, a, b, c, g = ph.symbols("m a b c g", positive=True)
    axes = LAB
    for name, axis in (("phi", "z"), ("theta", "x"), ("psi", "y")):
        axes = axes.rotated(ph.coordinate(name), axis)
    body = ph.ellipsoid("egg", mass=m, half_axes=(a, b, c), axes=axes, spin=ph.Components())
    system = ph.System(ph.Rolling(body, on=ph.Plane(LAB)), ph.Gravity(g))
    half, mass = np.array([0.1, 0.15, 0.08]), 0.6
    moments = mass / 5 * (np.sum(half**2) - half**2)

    def rates(time, y):
        matrix, w = y[:9].reshape(3, 3), y[9:12]
        normal = matrix.T @ UP
        changing = -np.cross(w, normal)
        size = sqrt(np.sum((half * normal) ** 2))
        arm = -(half**2) * normal / size
        slope = np.sum(half**2 * normal * changing) / size**2
        moving = -(half**2) * changing / size - arm * slope
        velocity = -np.cross(w, arm)
        # F = m (−ω̇ × r − ω × ṙ + ω × v) + m g n, and J ω̇ = −ω × J ω + r × F
        rest = mass * (np.cross(w, velocity) - np.cross(w, moving) + GRAVITY * normal)
        turning = np.cross(arm, rest) - np.cross(w, moments * w)
        spinning = np.linalg.solve(np.diag(moments) - mass * cross(arm) @ cross(arm), turning)
        return [*(matrix @ cross(w)).ravel(), *spinning, *(matrix @ velocity)[:2]]

    angles, omega = (0.2, 0.5, 0.3), (1.0, 2.0, -1.5)
    exact = solved(rates, [*turned("zxy", angles).ravel(), *omega, 0, 0], 1)
    start = dict(zip(("phi", "theta", "psi"), angles, strict=True))
    start |= dict(zip(("omega_x", "omega_y", "omega_z"), omega, strict=True))
    numbers = {"m": mass, "a": 0.1, "b": 0.15, "c": 0.08, "g": GRAVITY}
    run = ph.simulate(system, numbers, start, "1 s")
    found = turned("zxy", [run.final[name] for name in ("phi", "theta", "psi")])
    assert found.ravel() == pytest.approx(exact[:9], abs=1e-11)
    assert [run.final["x"], run.final["y"]] == pytest.approx(exact[12:], abs=1e-11)


@pytest.mark.parametrize("spins", ["axis", "components"])
def test_a_tippe_top_slides(spins):
    """Before it sticks, with N from the height of the centre, R − h cos θ."""
    m, R, h, A, C, g = ph.symbols("m R h A C g", positive=True)
    axes = LAB.rotated(ph.coordinate("phi"), "z").rotated(
        ph.coordinate("theta"), "x", labels="1 2 3"
    )
    more = {"spin_about": "3"}
    if spins == "components":
        axes, more = axes.rotated(ph.coordinate("psi"), "3"), {"spin": ph.Components()}
    top = ph.Body("top", mass=m, inertia=(A, A, C), axes=axes, surface=ph.Round(R, "3", h), **more)
    system = ph.System(ph.Coulomb(top, on=ph.Plane(LAB), mu=0.3), ph.Gravity(g))
    numbers = {"m": 0.006, "R": 0.015, "h": 0.003, "A": 8e-7, "C": 7e-7, "g": GRAVITY}
    mass, radius, height = (numbers[name] for name in ("m", "R", "h"))
    moments = np.array([numbers["A"], numbers["A"], numbers["C"]])

    def rates(time, y):
        matrix, w, velocity = y[:9].reshape(3, 3), y[9:12], y[14:16]
        axis, omega = matrix[:, 2], matrix @ w
        arm = height * axis - radius * UP
        inertia = matrix @ np.diag(moments) @ matrix.T
        climbing = -height * np.cross(omega, axis)[2]
        slip = (np.array([*velocity, climbing]) + np.cross(omega, arm))[:2]
        force = np.array([*(-0.3 * slip / np.linalg.norm(slip)), 1.0])  # per unit of N
        per_unit = np.linalg.solve(inertia, np.cross(arm, force))
        rest = -np.linalg.solve(inertia, np.cross(omega, inertia @ omega))
        centripetal = np.cross(omega, np.cross(omega, axis))
        rising = -height * np.cross(per_unit, axis)[2]
        falling = -height * (np.cross(rest, axis) + centripetal)[2]
        normal = mass * (falling + GRAVITY) / (1 - mass * rising)
        spinning = matrix.T @ (per_unit * normal + rest)
        return [
            *(matrix @ cross(w)).ravel(),
            *spinning,
            *velocity,
            *(normal * force[:2] / mass),
        ]

    tilt, turning, spin = 0.1, 200.0, 199.0
    before = [*turned("x", [tilt]).ravel(), 0, turning * sin(tilt), spin, 0, 0, 0, 0]
    exact = solved(rates, before, 0.1)
    start = {"theta": tilt, "omega_3": spin, "v_x": 0, "v_y": 0}
    start |= {"phi_dot": turning} if spins == "axis" else {"omega_2": turning * sin(tilt)}
    run = ph.simulate(system, numbers, start, "0.1 s")
    assert [event.kind for event in run.events] == ["start", "end"]
    theta, phi = run.final["theta"], run.final["phi"]
    axis = [sin(theta) * sin(phi), -sin(theta) * cos(phi), cos(theta)]
    assert axis == pytest.approx(exact[[2, 5, 8]], abs=1e-11)
    assert [run.final["x"], run.final["y"]] == pytest.approx(exact[12:14], abs=1e-12)


def test_a_ball_in_a_vertical_cylinder_rises_again():
    """Ju. Neimark, N. Fufaev, Dynamics of nonholonomic systems (1972): it does not fall out.

    While it circles at the rate φ̇ its height oscillates with √(2/7) φ̇.
    """
    m, a, R, g = ph.symbols("m a R g", positive=True)
    polar = LAB.rotated(ph.coordinate("phi"), "z", labels="r t z")
    ball = ph.sphere("ball", mass=m, radius=a, axes=polar)
    wall = ph.Pivot(ball, along=polar, only="r t", to=polar["r"] * (R - a), name="wall")
    grip = ph.Hold(ball, at=polar["r"] * a, only="t z", along=polar, name="grip", force="G")
    numbers = {"m": 0.2, "a": 0.02, "R": 0.3, "g": GRAVITY}
    run = ph.simulate(ph.System(wall, grip, ph.Gravity(g)), numbers, {"phi_dot": 6}, "4 s")
    rate = sqrt(2 / 7) * 6
    fall = -5 * GRAVITY / 7 / rate**2 * (1 - cos(rate * 4))
    assert run.final["z"] == pytest.approx(fall, abs=1e-12)
    assert run.final["phi"] == pytest.approx(24, abs=1e-12)


def test_a_torque_about_the_vertical_does_not_drive_a_rolling_cone():
    """It turns about the line of contact, which is level."""
    m, h, alpha, A, C, tau = ph.symbols("m h alpha A C tau", positive=True)
    level = LAB.rotated(ph.coordinate("phi"), "z")
    slanted = level.rotated(-alpha, "y")
    axes = slanted.rotated(ph.coordinate("psi"), "x")
    cone = ph.Body("cone", mass=m, inertia=(C, A, A), axes=axes)
    line = slanted["x"] * -h + level["x"] * h
    system = ph.System(
        ph.Pivot(cone, at=axes["x"] * -h, name="apex"),
        ph.Hold(cone, at=line, along=level, only="y z", name="line", force="L"),
        ph.Torque(cone, LAB["z"] * tau),
    )
    numbers = {"m": 1, "h": 0.2, "alpha": 0.4, "A": 0.05, "C": 0.01, "tau": 0.02}
    run = ph.simulate(system, numbers, {"phi_dot": 0.3}, "2 s")
    assert run.final["phi_dot"] == pytest.approx(0.3, abs=1e-14)
    assert run.final["psi"] == pytest.approx(-0.6 / sin(0.4), abs=1e-13)
