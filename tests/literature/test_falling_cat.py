"""A falling cat: two bodies at a bend without twist turn without angular momentum.

T. Kane, M. Scher, A dynamical explanation of the falling cat phenomenon, International Journal of
Solids and Structures 5 (1969); R. Montgomery, Gauge theory of the falling cat (1993): with zero
angular momentum the turn after a cycle of shape is the holonomy of a connection, ω = −Λ⁻¹ h, with
the moment of inertia Λ of the locked shape and the angular momentum h of its change alone.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import polhode as ph

NUMBERS = {"m": 1.0, "I": 0.06, "J": 0.02, "l": 0.25}
BEND, RATE = 0.9, 2.0


def turn(axis, angle):
    """The matrix of a rotation about a coordinate axis."""
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = np.eye(3)
    matrix[i, i] = matrix[j, j] = np.cos(angle)
    matrix[j, i], matrix[i, j] = np.sin(angle), -np.sin(angle)
    return matrix


def cross(vector):
    x, y, z = vector
    return np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])


def shape(time):
    """Angles of the joint, and their rates: the bend goes round once in every period."""
    angle = RATE * time
    angles = BEND * np.array([np.cos(angle), np.sin(angle)])
    return angles, BEND * RATE * np.array([-np.sin(angle), np.cos(angle)])


def turning(time):
    """Angular velocity and velocity of the front half, along its axes, without any momentum."""
    (p, q), (p_dot, q_dot) = shape(time)
    middle = turn("x", p)
    rear = middle @ turn("y", q)
    relative = p_dot * np.array([1.0, 0, 0]) + q_dot * middle[:, 1]
    apart = NUMBERS["l"] * (np.array([0, 0, 1.0]) + rear[:, 2])  # from the rear to the front centre
    changing = NUMBERS["l"] * np.cross(relative, rear[:, 2])
    own = np.diag([NUMBERS["I"], NUMBERS["I"], NUMBERS["J"]])
    other, reduced = rear @ own @ rear.T, NUMBERS["m"] / 2
    locked = own + other - reduced * cross(apart) @ cross(apart)
    momentum = other @ relative + reduced * np.cross(apart, changing)
    omega = -np.linalg.solve(locked, momentum)
    return omega, (np.cross(omega, apart) + changing) / 2


def test_it_turns_without_angular_momentum():
    m, I, J, l = ph.symbols("m I J l", positive=True)
    p, q = ph.functions("p q")
    axes = ph.Frame("lab")
    for angle, axis in (("phi", "z"), ("theta", "x"), ("psi", "y")):
        axes = axes.rotated(ph.coordinate(angle), axis)
    bent = axes.rotated(p, "x")
    tail = bent.rotated(q, "y")
    moments = {"mass": m, "inertia": (I, I, J)}
    front = ph.Body("front", axes=axes, spin=ph.Components(), tag="a", **moments)
    link = ph.Body("joint", mass=0, axes=bent, tag="c")
    rear = ph.Body("rear", axes=tail, tag="b", **moments)
    cat = ph.System(
        front,
        ph.Pivot(link, to=front.point(axes["z"] * -l), name="waist"),
        ph.Hinge(link, axis="x", to=front, name="first hinge"),
        ph.Motor(link, axis="x", rate=p.dt(), relative_to=axes, to=front, torque="sigma"),
        ph.Pivot(rear, at=tail["z"] * l, to=link.point(), name="spine"),
        ph.Hinge(rear, axis="y", to=link, name="second hinge"),
        ph.Motor(rear, axis="y", rate=q.dt(), relative_to=bent, to=link, torque="nu"),
    )

    def rates(time, matrix):
        return (matrix.reshape(3, 3) @ cross(turning(time)[0])).ravel()

    upright = turn("x", 0.4)
    period = 2 * np.pi / RATE
    exact = solve_ivp(
        rates, (0, period), upright.ravel(), method="DOP853", rtol=3e-14, atol=1e-15
    ).y[:, -1]
    omega, velocity = turning(0.0)
    start = {"theta": 0.4}
    start |= {f"omega_{axis}_a": w for axis, w in zip("xyz", omega, strict=True)}
    start |= {f"v_{axis}_a": v for axis, v in zip("xyz", upright @ velocity, strict=True)}
    angle = RATE * ph.time
    forcing = {p: BEND * ph.cos(angle), q: BEND * ph.sin(angle)}
    run = ph.simulate(cat, NUMBERS, start, period, forcing=forcing, samples=3)
    angles = zip("zxy", ("phi", "theta", "psi"), strict=True)
    found = np.linalg.multi_dot([turn(axis, run.final[name]) for axis, name in angles])
    assert found.ravel() == pytest.approx(exact, abs=1e-12)
    # the shape is what it was, but the cat has turned
    assert np.trace(upright.T @ found) < 2.999
