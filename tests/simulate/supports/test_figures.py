"""Balls on curved supports against the closed forms of textbooks."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import polhode as ph

M, G, A, R, I, ALPHA = ph.symbols("m g a R I alpha")
NUMBERS = {M: 0.1, G: 9.81, A: 0.02, R: 0.2}
U, V = ph.coordinates("u v")


def ball(support, contact, inertia=None, *, axes=None, **law):
    body = ph.sphere("ball", mass=M, radius=A, axes=axes or support.axes, inertia=inertia)
    return ph.System(body, contact(body, on=support, **law), ph.Gravity(G))


def first(run: ph.Trajectory, kind: str) -> float:
    return next(event.time for event in run.events if event.kind == kind)


@pytest.mark.parametrize("share", [0, 2 / 5, 2 / 3, 1])
def test_a_ball_leaves_a_sphere(share):
    """With I = k m a², rolling from rest: cos θ = 2 cos θ₀/(3 + k); without friction k = 0."""
    lab = ph.Frame("N")
    sphere = ph.Sphere(lab, radius=R)
    if share:
        system = ball(sphere, ph.Rolling, I)
        numbers = {**NUMBERS, I: share * 0.1 * 0.02**2}
    else:
        system, numbers = ball(sphere, ph.Smooth), NUMBERS
    run = ph.simulate(system, numbers, {U: 0.01}, "2 s")
    there = np.cos(run.evaluate(U, first(run, "lifts off")))
    assert there == pytest.approx(2 * np.cos(0.01) / (3 + share), rel=1e-13)


def test_small_oscillations_in_a_bowl():
    """ω² = 5g/(7(R − a)): 6.2392765148349875 rad/s, design sheet on surfaces."""
    system = ball(ph.Sphere(ph.Frame("N"), radius=R, inside=True), ph.Rolling)
    run = ph.simulate(system, NUMBERS, {U: 1e-7}, "10 s", events={"bottom": U})
    times = [event.time for event in run.events if event.kind == "bottom"]
    assert np.pi / np.diff(times) == pytest.approx(6.2392765148349875, rel=1e-13)


def test_equations_of_a_ball_in_a_bowl():
    """(7/5)(R − a) ü + g sin u = 0 in the vertical plane; F_n = m (R − a) u̇² + m g cos u."""
    equations = ph.derive(ball(ph.Sphere(ph.Frame("N"), radius=R, inside=True), ph.Rolling))
    plane = {V: 0, V.dt(): 0, V.dt().dt(): 0}
    row = equations.rows[0].subs(plane)
    pendulum = (R - A) * (7 * (R - A) * U.dt().dt() + 5 * G * ph.sin(U))
    assert (row / row.diff(U.dt().dt()) - pendulum / pendulum.diff(U.dt().dt())).is_zero
    pressed = equations.components["F_n"].subs(plane)
    assert (pressed - M * (R - A) * U.dt() ** 2 - M * G * ph.cos(U)).is_zero


def test_a_ball_rests_at_the_bottom_and_passes_through_it():
    """The bottom of a bowl is an ordinary point."""
    system = ball(ph.Sphere(ph.Frame("N"), radius=R, inside=True), ph.Coulomb, mu=0.5)
    still = ph.simulate(system, NUMBERS, {}, "10 s")
    assert still.evaluate(U, 10.0) == still.evaluate(V, 10.0) == 0
    through = ph.simulate(system, NUMBERS, {U: 0.3, V: 0.4, "u_dot": 0.5}, "10 s")
    assert through.drift.energy < 1e-13
    assert through.doubt == ""


def test_a_ball_in_a_vertical_drum():
    """It oscillates vertically √(2/7) times for each turn, down to 5g/Ω² below its start.

    Started level at Ω without spin about the normal: 0.122625 m for Ω = 20 rad/s. (Littlewood, A
    Mathematician's Miscellany; Gualtieri et al., Am. J. Phys. 74 (6), 497, 2006.)
    """
    drum = ph.Cylinder(ph.Frame("N"), radius=R, inside=True, axis="z")
    system = ball(drum, ph.Rolling)
    period = 2 * np.pi / 20 * np.sqrt(7 / 2)
    run = ph.simulate(system, NUMBERS, {"u_dot": 20}, period)
    # u is about the axis by the right-hand rule, and v along it
    assert run.evaluate(V, period / 2) == pytest.approx(-0.122625, rel=1e-12)
    assert run.evaluate(V, period) == pytest.approx(0, abs=1e-14)
    assert run.evaluate(U, period) == pytest.approx(20 * period, rel=1e-14)


def test_a_ball_in_a_funnel_keeps_its_circle():
    """Without friction r Ω² = g cot α, with r the radius of the circle of its centre."""
    alpha, distance = 0.6, 0.4
    cone = ph.Cone(ph.Frame("N"), half_angle=ALPHA, inside=True)
    system = ball(cone, ph.Smooth)
    radius = distance * np.sin(alpha) - 0.02 * np.cos(alpha)
    rate = np.sqrt(9.81 / np.tan(alpha) / radius)
    run = ph.simulate(system, {**_plain(), ALPHA: alpha}, {V: distance, "u_dot": rate}, "5 s")
    assert run.evaluate(V, run.t) == pytest.approx(distance, rel=1e-12)


def _plain() -> dict:
    return {M: 0.1, G: 9.81, A: 0.02}


def test_slipping_off_a_sphere():
    """Rolls, slips, leaves: as two planar equations for the angle and the spin, by SciPy."""
    mu, radius, reach = 0.3, 0.02, 0.22
    system = ball(ph.Sphere(ph.Frame("N"), radius=R), ph.Coulomb, mu=mu)
    run = ph.simulate(system, NUMBERS, {U: 0.02}, "2 s")
    slips, leaves = first(run, "slips"), first(run, "lifts off")

    def rolling(t, y):
        return [y[1], 5 / 7 * 9.81 * np.sin(y[0]) / reach]

    def grip(t, y):
        pressed = 9.81 * np.cos(y[0]) - reach * y[1] ** 2
        return mu * pressed - 2 / 7 * 9.81 * np.sin(y[0])

    def sliding(t, y):
        pressed = 9.81 * np.cos(y[0]) - reach * y[1] ** 2
        return [y[1], (9.81 * np.sin(y[0]) - mu * pressed) / reach, 5 / 2 * mu * pressed / radius]

    def pressed(t, y):
        return 9.81 * np.cos(y[0]) - reach * y[1] ** 2

    grip.terminal = pressed.terminal = True
    best = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-15}
    one = solve_ivp(rolling, (0, 2), [0.02, 0.0], events=grip, **best)
    begin, state = one.t_events[0][0], one.y_events[0][0]
    spin = reach * state[1] / radius
    two = solve_ivp(sliding, (begin, 2), [*state, spin], events=pressed, **best)
    assert slips == pytest.approx(begin, rel=1e-10)
    assert leaves == pytest.approx(two.t_events[0][0], rel=1e-10)
    assert run.evaluate(U, leaves) == pytest.approx(two.y_events[0][0][0], rel=1e-10)
    assert run.evaluate("omega_v", leaves) == pytest.approx(two.y_events[0][0][2], rel=1e-10)


def test_flight_from_wall_to_wall():
    """A particle's parabola between two points of a bowl, in the coordinates of the surface."""
    system = ball(ph.Sphere(ph.Frame("N"), radius=R, inside=True), ph.Smooth)
    run = ph.simulate(system, NUMBERS, {"u_dot": 13}, "1 s")
    leaves, lands = first(run, "lifts off"), first(run, "touches down")
    reach = 0.18

    def place(time):
        u = run.evaluate(U, time)
        return reach * np.array([np.sin(u), -np.cos(u)])

    u, rate = run.evaluate(U, leaves), run.evaluate("u_dot", leaves)
    begin, velocity = place(leaves), reach * rate * np.array([np.cos(u), np.sin(u)])
    passed = lands - leaves
    there = begin + velocity * passed + np.array([0, -9.81 / 2 * passed**2])
    assert place(lands) == pytest.approx(there, rel=1e-11)
    assert np.linalg.norm(there) == pytest.approx(reach, rel=1e-12)
    # it leaves where the normal force vanishes: (R − a) u̇² = −g cos u
    assert reach * rate**2 == pytest.approx(-9.81 * np.cos(u), rel=1e-11)


def test_the_frame_of_the_ball_does_not_matter():
    """With the ball's angular velocity along the laboratory's axes the motion is the same."""
    lab = ph.Frame("N")
    bowl = ph.Sphere(lab, radius=R, inside=True)
    runs = []
    for axes, spin in ((bowl.axes, "omega_n"), (lab, "omega_z")):
        system = ball(bowl, ph.Rolling, axes=axes)
        start = {U: 0.0, V: 0.0, "u_dot": 4.0, "v_dot": 1.0, spin: 30.0}
        runs.append(ph.simulate(system, NUMBERS, start, "2 s"))
    one, other = runs
    for name in ("u", "v", "F_n", "F_u", "F_v"):
        assert one.evaluate(name, one.t) == pytest.approx(other.evaluate(name, other.t), abs=1e-10)
