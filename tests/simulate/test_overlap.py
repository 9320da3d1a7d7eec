"""Bodies that meet without a contact: an event and a doubt, at times known in closed form."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import polhode as ph
from polhode.simulate import Experiment

M, A, G, K, L = ph.symbols("m a g k L", positive=True)
LAB = ph.Frame("lab")
X, Y, Z = LAB["x"], LAB["y"], LAB["z"]
FLOOR = ph.Plane(LAB)
ONE, TWO = (ph.point_mass(n, mass=M, axes=LAB, tag=n[0]) for n in ("one", "two"))
BALL, OTHER = (
    ph.sphere(n, mass=M, radius=A, axes=LAB, tag=t) for n, t in (("ball", "1"), ("other", "2"))
)
NUMBERS = {M: 1.0, A: 0.1, G: 9.81}


def on_a_wire(body: ph.Body) -> ph.Pivot:
    return ph.Pivot(body, only="y z", name=f"wire of {body.name}", force=f"N{body.tag}")


def run(system: ph.System, numbers: dict, start: dict, duration: float = 2.0) -> ph.Trajectory:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ph.DriftWarning)
        return ph.simulate(system, numbers, start, duration)


def meetings(motion: ph.Trajectory) -> list[tuple[float, str]]:
    return [(e.time, e.kind) for e in motion.events if " meets " in e.kind]


# -- pairs that meet -------------------------------------------------------------------------------


@pytest.mark.parametrize("other", [-0.5, 0.25])
def test_beads_on_one_wire(other: float) -> None:
    system = ph.System(on_a_wire(ONE), on_a_wire(TWO))
    start = {"x_o": 0.0, "x_t": 1.0, "v_x_o": 1.0, "v_x_t": other}
    with pytest.warns(ph.DriftWarning, match="one meets two at t = .* no contact"):
        motion = ph.simulate(system, {M: 1.0}, start, 2.0)
    ((time, _),) = meetings(motion)
    assert time == pytest.approx(1 / (1 - other), rel=1e-15)
    assert "pass through each other" in motion.doubt
    assert float(motion.final["x_o"]) == pytest.approx(2.0, rel=1e-15)  # the motion goes on


@pytest.mark.parametrize("beside", [0.0, 0.05, 0.199])
def test_billiard_balls(beside: float) -> None:
    """Centres come to a distance of 2a: x = 1 - √(4a² − b²)."""
    system = ph.System(ph.Smooth(BALL, on=FLOOR), ph.Smooth(OTHER, on=FLOOR), ph.Gravity(G))
    start = {"x_1": 0, "x_2": 1, "v_x_1": 1, "y_2": beside}
    ((time, kind),) = meetings(run(system, NUMBERS, start))
    assert kind == "ball meets other"
    assert time == pytest.approx(1 - np.sqrt(0.04 - beside**2), rel=1e-13)


@pytest.mark.parametrize("beside", [0.2, 0.2001, 1.0])
def test_billiard_balls_that_miss(beside: float) -> None:
    system = ph.System(ph.Smooth(BALL, on=FLOOR), ph.Smooth(OTHER, on=FLOOR), ph.Gravity(G))
    motion = run(system, NUMBERS, {"x_1": 0, "x_2": 1, "v_x_1": 1, "y_2": beside})
    assert not meetings(motion)
    assert not motion.doubt


def test_a_quick_graze_within_one_step() -> None:
    """Free flight is a single step; the overlap lasts a thousandth of it."""
    system = ph.System(BALL, OTHER)
    depth = 1e-7
    start = {"x_1": -500, "x_2": 0, "v_x_1": 1, "y_2": 0.2 - depth}
    ((time, _),) = meetings(run(system, {M: 1.0, A: 0.1}, start, 1000.0))
    half = np.sqrt(0.04 - (0.2 - depth) ** 2)
    assert time == pytest.approx(500 - half, rel=1e-12)


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_a_ball_falls_onto_another_through_its_bounces(restitution: float) -> None:
    """One bounces on the floor, the other falls from 2 m beside it; both are looked at."""
    bouncing = ph.Smooth(BALL, on=FLOOR, restitution=restitution)
    system = ph.System(bouncing, OTHER, ph.Gravity(G))
    start = {"z_1": 0.3, "x_1": 0, "x_2": 5, "z_2": 2.0}
    ((time, kind),) = meetings(run(system, NUMBERS, start, 1.0))
    assert kind == "other meets the support of ball"
    assert time == pytest.approx(np.sqrt(2 * 1.9 / 9.81), rel=1e-14)


def test_a_particle_thrown_from_the_floor_of_another() -> None:
    system = ph.System(ph.Smooth(BALL, on=FLOOR), ONE, ph.Gravity(G))
    start = {"x_1": 3, "z_o": 0, "v_z_o": 3.0}
    ((time, _),) = meetings(run(system, NUMBERS, start))
    assert time == pytest.approx(2 * 3.0 / 9.81, rel=1e-8)


@pytest.mark.parametrize("pushing", [True, False])
def test_balls_that_touch_at_the_start(pushing: bool) -> None:
    system = ph.System(ph.Smooth(BALL, on=FLOOR), ph.Smooth(OTHER, on=FLOOR), ph.Gravity(G))
    velocity = {"v_x_1": 1 / 3, "v_x_2": 0.0 if pushing else 1 / 3}
    motion = run(system, NUMBERS, {"x_1": 0.1, "x_2": 0.1 + 0.2, **velocity})
    assert [time for time, _ in meetings(motion)] == ([0.0] if pushing else [])


def test_two_pendulums_from_one_pivot() -> None:
    """On one circle, released at ±0.1 rad, they meet at the bottom: a quarter of the period."""
    bobs = []
    for name in ("p", "q"):
        axes = LAB.rotated(ph.coordinate(name), "y")
        bob = ph.point_mass(f"bob {name}", mass=M, axes=axes, tag=name)
        bobs.append(ph.Pivot(bob, at=axes["z"] * L, name=f"pivot {name}", force=f"F{name}"))
    start = {"p": 0.1, "q": -0.1}
    motion = run(ph.System(*bobs, ph.Gravity(G)), {M: 1.0, G: 9.81, L: 1.0}, start)
    ((time, _),) = meetings(motion)
    # T/4 = √(L/g) K(sin(0.05))
    k, mean = np.cos(0.05), 1.0
    for _ in range(6):
        mean, k = (mean + k) / 2, np.sqrt(mean * k)
    assert time == pytest.approx(np.pi / 2 / mean / np.sqrt(9.81), rel=1e-12)


def test_in_quadruple_precision() -> None:
    system = ph.System(on_a_wire(ONE), on_a_wire(TWO))
    start = {"x_o": 0, "x_t": 1, "v_x_o": 1, "v_x_t": 0.25}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ph.DriftWarning)
        motion = ph.simulate(system, {M: 1.0}, start, 2.0, precision="quadruple")
    ((time, _),) = meetings(motion)
    assert float(time) == pytest.approx(4 / 3, rel=1e-15)
    assert motion.doubt


# -- pairs that are left out -----------------------------------------------------------------------


def test_what_a_joint_links_may_overlap() -> None:
    """A small ball pivoted at the surface of a large one turns into it."""
    theta = ph.coordinate("theta")
    turning = LAB.rotated(theta, "y")
    small = ph.sphere("small", mass=M, radius=A, axes=turning, spin=ph.WithAxes(), tag="s")
    hinged = (
        ph.Pivot(small, at=turning["z"] * (3 * A), to=BALL.point(Z * 0), name="arm", force="H"),
        ph.Hinge(small, axis="y"),
        ph.Pivot(BALL),
    )
    motion = run(ph.System(*hinged, ph.Gravity(G)), NUMBERS, {"theta": 1.0})
    assert not meetings(motion)


def test_what_overlaps_at_the_start_may_go_on() -> None:
    system = ph.System(BALL, OTHER)
    motion = run(system, {M: 1.0, A: 0.1}, {"x_1": 0, "x_2": 0.05, "v_x_2": -1.0})
    assert not meetings(motion)
    assert not motion.doubt


def test_a_potential_between_two_says_how_they_act() -> None:
    """Two particles drawn together in proportion to their distance pass through each other."""
    x_o, x_t = ph.coordinates("x_o x_t")
    law = ph.Potential(K * (x_o - x_t) ** 2 / 2, on=(ONE, TWO), name="attraction")
    system = ph.System(on_a_wire(ONE), on_a_wire(TWO), law)
    motion = run(system, {M: 1.0, K: 1.0}, {"x_o": -1, "x_t": 1}, 5.0)
    assert float(motion.final["x_o"]) == pytest.approx(-np.cos(np.sqrt(2) * 5), rel=1e-11)
    assert not meetings(motion)
    assert not motion.doubt


def test_a_bead_at_the_rim_touches_the_floor_once_a_turn() -> None:
    """A wheel that carries a particle at its rim rolls without a meeting."""
    theta = ph.coordinate("theta")
    axes = LAB.rotated(theta, "y")
    wheel = ph.sphere("wheel", mass=M, radius=A, axes=axes, spin=ph.WithAxes())
    bead = ph.point_mass("bead", mass=M, axes=axes, tag="b")
    system = ph.System(
        ph.Rolling(wheel, on=FLOOR),
        ph.Pivot(bead, to=wheel.point(axes["x"] * A), name="weld", force="W"),
        ph.Gravity(G),
    )
    motion = run(system, NUMBERS, {"theta_dot": 5.0}, 5.0)
    assert not meetings(motion)
    assert not motion.doubt


def test_other_shapes_are_listed() -> None:
    def disk(tag: str) -> ph.Body:
        phi, theta = ph.coordinates(f"phi{tag} theta{tag}")
        axes = LAB.rotated(phi, "z").rotated(theta, "x")
        return ph.disk(f"disk {tag}", mass=M, radius=A, axes=axes, tag=tag)

    one, two = disk("1"), disk("2")
    system = ph.System(ph.Rolling(one, on=FLOOR), ph.Rolling(two, on=FLOOR), ph.Gravity(G))
    start = {"theta1": 1.4, "theta2": 1.3, "omega_3_1": 20, "omega_3_2": 20}
    motion = run(system, NUMBERS, start, 0.1)
    assert motion.assumed["overlap of disk 1 and disk 2"] == 0.0
    assert not any("support" in name for name in motion.assumed)
    assert not motion.doubt


def test_links_of_one_mechanism_are_not_listed() -> None:
    alpha, beta = ph.coordinates("alpha beta")
    upper_axes = LAB.rotated(alpha, "y")
    lower_axes = upper_axes.rotated(beta, "y")
    upper = ph.rod("upper", mass=M, length=L, axes=upper_axes, axis="z", tag="1")
    lower = ph.rod("lower", mass=M, length=L, axes=lower_axes, axis="z", tag="2")
    shoulder = ph.Pivot(upper, at=upper_axes["z"] * (L / 2), name="shoulder")
    elbow = ph.Pivot(
        lower,
        at=lower_axes["z"] * (L / 2),
        to=upper.point(upper_axes["z"] * (-L / 2)),
        name="elbow",
    )
    motion = run(ph.System(shoulder, elbow, ph.Gravity(G)), {M: 1.0, L: 1.0, G: 9.81}, {"beta": 1})
    assert not any("overlap" in name for name in motion.assumed)


@pytest.mark.parametrize("falls", [True, False])
def test_members_of_an_ensemble_in_which_bodies_meet_fail(falls: bool) -> None:
    """Those that pass within 2a; the others are as they are alone."""
    touch = ph.Smooth(BALL, on=FLOOR), ph.Smooth(OTHER, on=FLOOR), ph.Gravity(G)
    system = ph.System(*touch) if falls else ph.System(BALL, OTHER)
    numbers = NUMBERS if falls else {M: 1.0, A: 0.1}
    beside = np.linspace(-0.41, 0.41, 21)
    start = {"x_1": 0, "x_2": 1, "v_x_1": 1, "y_2": beside}
    found = ph.ensemble(system, numbers, start, 2.0, outputs=["x_1"])
    assert sorted(found.failures) == np.flatnonzero(np.abs(beside) < 0.2).tolist()
    assert all("ball meets other" in reason for reason in found.failures.values())
    assert np.nanmax(np.abs(found["x_1"] - 2.0)) < 1e-13


# -- against looking at every instant --------------------------------------------------------------


SWARM = ph.System(
    *(ph.sphere(f"ball {k}", mass=M, radius=A, axes=LAB, tag=f"{k}") for k in range(4)),
)
FREE = Experiment(SWARM, 4.0)


@pytest.mark.parametrize("seed", range(12))
def test_balls_in_straight_flight(seed: int) -> None:
    """|r + v t| = 2a is a quadratic equation for every pair."""
    rng = np.random.default_rng(seed)
    places, velocities = rng.uniform(-1, 1, (4, 3)), rng.uniform(-1, 1, (4, 3))
    start = {
        f"{'' if kind == 'x' else 'v_'}{q}_{k}": float(values[k, i])
        for kind, values in (("x", places), ("v", velocities))
        for k in range(4)
        for i, q in enumerate("xyz")
    }
    motion = FREE.run({M: 1.0, A: 0.15}, start)
    expected = []
    for i in range(4):
        for j in range(i + 1, 4):
            r, v = places[j] - places[i], velocities[j] - velocities[i]
            b, c = r @ v, r @ r - 0.3**2
            root = b * b - v @ v * c
            if c > 0 > b and root > 0 and (when := (-b - np.sqrt(root)) / (v @ v)) < 4.0:
                expected.append((when, f"ball {i} meets ball {j}"))
    found = meetings(motion)
    assert [kind for _, kind in found] == [kind for _, kind in sorted(expected)]
    assert [t for t, _ in found] == pytest.approx([t for t, _ in sorted(expected)], rel=1e-12)
    assert bool(motion.doubt) == bool(expected)
