"""Bodies on surfaces given point by point: against Newton's laws in Cartesian components, and
against the same surfaces declared otherwise."""

import numpy as np
import pytest
import sympy as sp

import polhode as ph
from oracles.ball_on_a_surface import BallOnSurface, X, Y
from polhode.base import DeclarationError

LAB = ph.Frame("lab")
m, a, g, R, p, q = ph.symbols("m a g R p q", positive=True)
u, v = ph.coordinates("u v")
BALL = ph.sphere("ball", mass=m, radius=a, axes=LAB)
KNOWN = {"m": 0.5, "a": 0.02, "g": 9.81, "R": 0.2, "p": 0.3, "q": 0.5}
TIMES = np.linspace(0.0, 1.5, 16)

# a place, its counterpart, whether the ball is inside, and where it starts
SURFACES = {
    "ellipsoid": (
        (p * ph.cos(v) * ph.cos(u), q * ph.cos(v) * ph.sin(u), R * ph.sin(v)),
        (0.3 * sp.cos(Y) * sp.cos(X), 0.5 * sp.cos(Y) * sp.sin(X), 0.2 * sp.sin(Y)),
        True,
        (0.4, -1.1),
    ),
    "hyperboloid": (
        (R * ph.cosh(v) * ph.cos(u), R * ph.cosh(v) * ph.sin(u), p * ph.sinh(v)),
        (0.2 * sp.cosh(Y) * sp.cos(X), 0.2 * sp.cosh(Y) * sp.sin(X), 0.3 * sp.sinh(Y)),
        True,
        (-2.5, 0.2),
    ),
    "helicoid": (
        (v * ph.cos(u), v * ph.sin(u), R * u),
        (Y * sp.cos(X), Y * sp.sin(X), 0.2 * X),
        False,
        (0.3, -0.4),
    ),
    "tilted trough": (
        (u, v + u / 3, u**2 / p + v / 2),
        (X, Y + X / 3, X**2 / 0.3 + Y / 2),
        False,
        (0.02, 0.1),
    ),
}


@pytest.mark.parametrize("name", SURFACES)
def test_a_ball_rolls_as_newton_says(name):
    ours, theirs, inside, place = SURFACES[name]
    on = ph.Parametric(LAB, ours, inside=inside)
    equations = ph.derive(ph.System(ph.Rolling(BALL, on=on), ph.Gravity(g)))
    oracle = BallOnSurface(theirs, 0.02, m=0.5, side=-1 if inside else 1)
    omega = oracle.spin(*place, 0.3, 0.2, 5.0)
    known = {s.published: KNOWN[s.published] for s in equations.parameters}
    start = dict(zip("uv", place, strict=True))
    start |= dict(zip(("omega_x", "omega_y", "omega_z"), omega, strict=True))
    run = ph.simulate(equations, known, start, TIMES[-1])
    expected = oracle.rolls(place, omega, TIMES)
    names = ("u", "v", "omega_x", "omega_y", "omega_z")
    found = np.array([run.evaluate(n, TIMES) for n in names])
    scale = np.max(np.abs(expected), axis=1)[:, None]
    assert np.max(np.abs(found - expected) / scale) < 1e-9
    force, normal = oracle.force(expected[:, -1]), oracle.at(*expected[:2, -1])[0]
    assert run.final["F_n"] == pytest.approx(force @ normal, rel=1e-8)
    assert run.drift.energy < 2e-12


def test_a_torus_is_one():
    """With its formula it is ph.Torus: the same coordinates, the same motion."""
    tube = ph.symbol("r", positive=True)
    around = R + tube * ph.cos(v)
    ring = ph.Parametric(LAB, (around * ph.cos(u), around * ph.sin(u), tube * ph.sin(v)))
    known = {"m": 0.5, "a": 0.02, "g": 9.81, "R": 0.2, "r": 0.05}
    start = {"u": 0.3, "v": 1.2, "u_dot": 1.0, "v_dot": -0.5}
    runs = [
        ph.simulate(ph.System(ph.Smooth(BALL, on=on), ph.Gravity(g)), known, start, 0.1)
        for on in (ring, ph.Torus(LAB, radius=R, tube=tube))
    ]
    for name in ("u", "v", "F_n"):
        one, other = (run.evaluate(name, TIMES[:2]) for run in runs)
        assert one == pytest.approx(other, abs=1e-12)


@pytest.mark.parametrize(
    ("place", "message"),
    [
        ((u, v), "expected three components"),
        ("uvw", "expected three components"),
        ((u, v, ph.time), "as a function of t"),
        ((u, u, u), "move in two directions"),
        ((u + v, 2 * (u + v), 0), "move in two directions"),
        ((p * ph.cos(v), p * ph.sin(v), u), "exchange u and v"),
    ],
)
def test_other_places_are_refused(place, message):
    with pytest.raises(DeclarationError, match=message):
        ph.Parametric(LAB, place)
