"""Bodies on surfaces given by their height: against Newton's laws in Cartesian components, against
the same surface declared otherwise, and closed forms."""

import math

import numpy as np
import pytest
import sympy as sp

import polhode as ph
from oracles.ball_on_a_surface import BallOnSurface, X, Y
from polhode.base import ConstraintError, DeclarationError

LAB = ph.Frame("lab")
m, a, g, R, p, q, h, mu, e = ph.symbols("m a g R p q h mu e", positive=True)
u, v = ph.coordinates("u v")
BALL = ph.sphere("ball", mass=m, radius=a, axes=LAB)
NUMBERS = {"m": 0.5, "a": 0.02, "g": 9.81}
SIZES = {"R": 0.2, "p": 0.3, "q": 0.5, "h": 0.04}
TIMES = np.linspace(0.0, 2.0, 21)

GRAPHS = {
    "paraboloid": ((u**2 + v**2) / (2 * p), (X**2 + Y**2) / (2 * sp.Float(0.3))),
    "two curvatures": (
        u**2 / (2 * p) + v**2 / (2 * q) + u * v / (5 * p),
        X**2 / 0.6 + Y**2 / 1.0 + X * Y / 1.5,
    ),
    "quartic": (u**4 / p**3 + v**2 / q, X**4 / 0.027 + Y**2 / 0.5),
    "waves": (h * ph.cos(u / R) * ph.cos(v / p), 0.04 * sp.cos(X / 0.2) * sp.cos(Y / 0.3)),
    "sphere": (R - ph.sqrt(R**2 - u**2 - v**2), 0.2 - sp.sqrt(0.04 - X**2 - Y**2)),
    "incline": (u / 3 + v / 5, X / 3 + Y / 5),
}


def system(contact, *more):
    return ph.System(contact, *more, ph.Gravity(g))


def numbers_for(equations, **more):
    known = {**NUMBERS, **SIZES, **more}
    return {s.published: known[s.published] for s in equations.parameters}


@pytest.mark.parametrize("name", GRAPHS)
@pytest.mark.parametrize("seed", [1, 2])
def test_a_ball_rolls_as_newton_says(name, seed):
    ours, theirs = GRAPHS[name]
    rng = np.random.default_rng(seed)
    x, y, x_dot, y_dot, turning = rng.uniform(-1, 1, 5) * [0.08, 0.08, 0.3, 0.3, 20]
    equations = ph.derive(system(ph.Rolling(BALL, on=ph.Graph(LAB, ours))))
    oracle = BallOnSurface(theirs, 0.02, m=0.5)
    omega = oracle.spin(x, y, x_dot, y_dot, turning)
    start = {"u": x, "v": y, "u_dot": x_dot, "v_dot": y_dot, "omega_z": omega[2]}
    run = ph.simulate(equations, numbers_for(equations), start, TIMES[-1])
    expected = oracle.rolls((x, y), omega, TIMES)
    names = ("u", "v", "omega_x", "omega_y", "omega_z")
    found = np.array([run.evaluate(n, TIMES) for n in names])
    scale = np.max(np.abs(expected), axis=1)[:, None]
    assert np.max(np.abs(found - expected) / scale) < 2e-10
    for k in (0, 7, 20):
        force = oracle.force(expected[:, k])
        assert run.evaluate("F_n", TIMES)[k] == pytest.approx(
            force @ oracle.at(*expected[:2, k])[0], rel=1e-9
        )
    assert run.drift.energy < 1e-13


def test_a_sphere_is_a_graph_is_a_surface_of_revolution():
    """The same bowl three times: the centre moves alike."""
    height = R - ph.sqrt(R**2 - v**2)
    supports = {
        "graph": (ph.Graph(LAB, GRAPHS["sphere"][0]), {"u": 0.06, "v": 0.03}),
        "revolution": (
            ph.Revolution(LAB, height),
            {"u": math.atan2(0.03, 0.06), "v": math.hypot(0.06, 0.03)},
        ),
    }
    paths = {}
    oracle = BallOnSurface(GRAPHS["sphere"][1], 0.02, m=0.5)
    omega = oracle.spin(0.06, 0.03, 0.2, -0.1, 7.0)
    for name, (on, place) in supports.items():
        equations = ph.derive(system(ph.Rolling(BALL, on=on)))
        spin = dict(zip(("omega_x", "omega_y", "omega_z"), omega, strict=True))
        run = ph.simulate(equations, numbers_for(equations), place | spin, TIMES[-1])
        us, vs = run.evaluate("u", TIMES), run.evaluate("v", TIMES)
        paths[name] = [us, vs] if name == "graph" else [vs * np.cos(us), vs * np.sin(us)]
    expected = oracle.rolls((0.06, 0.03), omega, TIMES)[:2]
    for path in paths.values():
        assert np.array(path) == pytest.approx(expected, abs=1e-10)


def test_small_oscillations_about_the_lowest_point():
    """ω² = (5/7) g κ/(1 − a κ) along each principal direction, κ the curvature there."""
    equations = ph.derive(
        system(ph.Rolling(BALL, on=ph.Graph(LAB, u**2 / (2 * p) + v**2 / (2 * q))))
    )
    found = ph.linearise(equations, numbers_for(equations), {"u": 0, "v": 0})
    expected = [5 / 7 * 9.81 / (size - 0.02) for size in (0.5, 0.3)]
    frequencies = sorted(x.imag for x in found.exponents if x.imag > 1e-6)
    assert frequencies == pytest.approx(np.sqrt(expected), rel=1e-12)


def test_it_passes_through_the_lowest_point_and_rests_there():
    on = ph.Graph(LAB, GRAPHS["paraboloid"][0])
    equations = ph.derive(system(ph.Rolling(BALL, on=on)))
    known = numbers_for(equations)
    through = ph.simulate(equations, known, {"u": -0.05, "v": 0}, "2 s")
    assert np.min(through["u"]) < 0 < np.max(through["u"])
    assert np.max(np.abs(through["v"])) < 1e-15
    still = ph.simulate(equations, known, {"u": 0, "v": 0}, "100 s")
    assert not np.any(still["u"])


@pytest.mark.parametrize("on", ["graph", "sphere"])
def test_a_ball_dropped_into_a_bowl_comes_to_rest(on):
    """Along the axis it bounces as on a plane: in all for (1 + 2 e/(1 − e)) √(2 h/g)."""
    support = (
        ph.Graph(LAB, GRAPHS["paraboloid"][0])
        if on == "graph"
        else ph.Sphere(LAB, radius=p, inside=True)
    )
    contact = ph.Coulomb(BALL, on=support, mu=mu, restitution=e)
    known = {**NUMBERS, "p": 0.3, "mu": 0.2, "e": 0.5}
    run = ph.simulate(system(contact), known, {"u": 0, "v": 0, "gap": 0.1}, "2 s")
    fall = math.sqrt(0.2 / 9.81)
    landed = [event.time for event in run.events if event.kind == "bounces"]
    assert landed[:3] == pytest.approx([fall, 2 * fall, 2.5 * fall], abs=1e-12)
    assert landed[-1] == pytest.approx(3 * fall, abs=1e-6)
    assert run.mode == "rolling"
    assert abs(run.final["u"]) < 1e-12


def test_a_cylinder_that_is_a_graph_lets_the_ball_go_where_it_should():
    """Off a fixed cylinder a ball that rolls from rest leaves at cos θ = 10/17."""
    hill = ph.Graph(LAB, ph.sqrt(R**2 - u**2))
    contact = ph.Coulomb(BALL, on=hill, mu=mu)
    known = {**NUMBERS, "R": 0.2, "mu": 1000.0}
    theta = 1e-3
    run = ph.simulate(system(contact), known, {"u": 0.2 * math.sin(theta), "v": 0}, "3 s")
    (event,) = [event for event in run.events if event.kind == "lifts off"]
    leaves = 10 / 17 * math.cos(theta)
    assert event.state_before["u"] == pytest.approx(0.2 * math.sqrt(1 - leaves**2), rel=1e-5)


def test_below_a_surface_it_is_pressed_by_upward_gravity():
    """Turned upside down, the world is the same."""
    above = ph.Graph(LAB, GRAPHS["two curvatures"][0])
    below = ph.Graph(LAB, -GRAPHS["two curvatures"][0], inside=False)
    upwards = ph.System(ph.Rolling(BALL, on=below), ph.Gravity(g, up=-LAB["z"]))
    start = {"u": 0.05, "v": -0.02, "u_dot": 0.1, "v_dot": 0.2}
    first = ph.derive(system(ph.Rolling(BALL, on=above)))
    known = numbers_for(first)
    one = ph.simulate(first, known, start, "2 s")
    other = ph.simulate(upwards, known, start, "2 s")
    for name in ("u", "v", "F_n"):
        assert one.evaluate(name, TIMES) == pytest.approx(other.evaluate(name, TIMES), abs=1e-12)


def test_a_wheel_rolls_on_a_corrugated_road():
    """A hoop-like ball, turned by an angle of its own: its path is that of Newton's ball."""
    axes = LAB.rotated(ph.coordinate("phi"), "y")
    wheel = ph.Body(
        "wheel", mass=m, inertia=(m * a**2, m * a**2, m * a**2), axes=axes, surface=ph.Round(a)
    )
    road = ph.Graph(LAB, h * ph.cos(u / R))
    equations = ph.derive(system(ph.Rolling(wheel, on=road)))
    run = ph.simulate(equations, numbers_for(equations), {"u": 0.05, "v": 0, "u_dot": 0.5}, "2 s")
    oracle = BallOnSurface(0.04 * sp.cos(X / 0.2), 0.02, k=1.0, m=0.5)
    expected = oracle.rolls((0.05, 0.0), oracle.spin(0.05, 0.0, 0.5, 0.0, 0.0), TIMES)
    assert run.evaluate("u", TIMES) == pytest.approx(expected[0], abs=1e-10)
    assert run.drift.energy < 1e-13


def test_a_ball_too_large_for_the_hollow_is_refused():
    equations = ph.derive(system(ph.Rolling(BALL, on=ph.Graph(LAB, GRAPHS["paraboloid"][0]))))
    with pytest.raises(ConstraintError, match="too large for the hollow"):
        ph.simulate(equations, {**numbers_for(equations), "a": 0.4}, {"u": 0.01}, "1 s")


def test_a_hollow_that_becomes_too_narrow_ends_the_motion():
    """u⁴/p³ is flat in the middle and curves more and more."""
    on = ph.Graph(LAB, u**4 / p**3)
    equations = ph.automaton(system(ph.Rolling(BALL, on=on)))
    known = {**NUMBERS, "a": 0.16, "p": 0.3}
    run = ph.simulate(equations, known, {"u": 0.0, "v": 0, "u_dot": 2.0}, "3 s")
    assert [event.kind for event in run.events] == ["start", "no longer fits", "end"]
    # just before the centre of curvature of u⁴/p³ is that of the ball
    x = run.final["u"]
    slope, bend = 4 * x**3 / 0.3**3, 12 * x**2 / 0.3**3
    assert (1 + slope**2) ** 1.5 / bend == pytest.approx(0.16, rel=2e-3)


@pytest.mark.parametrize(
    ("height", "message"),
    [
        (
            ph.coordinate("w") ** 2,
            "a Graph as a function of w; expected an expression of the coordinates u and v",
        ),
        (ph.time * u, "as a function of t"),
        (u.dt() * u, "as a function of u_dot"),
    ],
)
def test_other_heights_are_refused(height, message):
    with pytest.raises(DeclarationError, match=message):
        ph.Graph(LAB, height)


def test_a_surface_of_revolution_has_no_axis():
    """Its polar angle is not defined there."""
    on = ph.Revolution(LAB, v**2 / (2 * p))
    run = ph.simulate(
        system(ph.Smooth(BALL, on=on)), {**NUMBERS, "p": 0.3}, {"u": 0.0, "v": 0.1}, "1 s"
    )
    assert [event.kind for event in run.events] == ["start", "reaches a pole", "end"]


def test_frictionless_the_moment_about_the_axis_is_kept():
    on = ph.Revolution(LAB, v**2 / (2 * p))
    equations = ph.derive(system(ph.Smooth(BALL, on=on)))
    run = ph.simulate(equations, {**NUMBERS, "p": 0.3}, {"u": 0.0, "v": 0.1, "u_dot": 5.0}, "3 s")
    r = run["v"] - 0.02 * run["v"] / np.sqrt(0.3**2 + run["v"] ** 2)
    assert 0.5 * r**2 * run["u_dot"] == pytest.approx(0.5 * r[0] ** 2 * 5.0, rel=1e-12)
