"""Friction that depends on the slip speed, against closed forms and quadratures."""

from functools import cache

import numpy as np
import pytest

import polhode as ph
from oracles.speed_friction import Sliding
from polhode.derive import Automaton, automaton
from polhode.model import Body, Face

M, A, K, J, H, G, W = ph.symbols("m a k J h g w", positive=True)
MU, MU_S, C = ph.symbols("mu mu_s c")
GRAVITY, RADIUS = 9.81, 0.05
EXACT = 1e-13


def on_table(body: Body, lab: ph.Frame) -> Automaton:
    touch = ph.Coulomb(body, on=ph.Plane(lab), mu=MU, mu_static=MU_S, viscous=C, stribeck=W)
    return automaton(ph.System(touch, ph.Gravity(G)))


@cache
def block() -> Automaton:
    lab = ph.Frame("lab")
    return on_table(Body("block", mass=M, inertia=(J, J, J), axes=lab, surface=Face(H)), lab)


@cache
def ball() -> Automaton:
    lab = ph.Frame("lab")
    return on_table(ph.sphere("ball", mass=M, radius=A, inertia=K * M * A**2, axes=lab), lab)


def law(sliding: Sliding) -> dict[str, float]:
    static = sliding.mu + sliding.surplus
    own = {"mu": sliding.mu, "mu_s": static, "c": sliding.viscous, "w": sliding.stribeck}
    return own | {"m": 2.0, "g": GRAVITY}


def slid_block(sliding: Sliding, duration: float) -> ph.Trajectory:
    along = np.array([0.6, -0.8])
    start = {"v_x": sliding.slip * along[0], "v_y": sliding.slip * along[1]}
    numbers = law(sliding) | {"J": 0.1, "h": 0.2}
    return ph.simulate(block(), numbers, start, duration, samples=2)


def stopped(run: ph.Trajectory) -> float:
    assert [event.kind for event in run.events] == ["start", "sticks", "end"]
    return float(run.events[1].time)


def check_block(sliding: Sliding) -> dict[str, float]:
    end = sliding.time(0.0)
    run = slid_block(sliding, 1.2 * end)
    errors = {"end": abs(stopped(run) - end) / end, "energy": run.drift.energy}
    for left in (0.9, 0.5, 0.1):
        slip = left * sliding.slip
        at = run.table(["x", "y", "v_x", "v_y"], sliding.time(slip))
        errors[f"speed at {left}"] = abs(np.hypot(at["v_x"], at["v_y"]) - slip) / sliding.slip
        errors[f"way at {left}"] = abs(np.hypot(at["x"], at["y"]) / sliding.way(slip) - 1)
    errors["way"] = abs(np.hypot(run.final["x"], run.final["y"]) / sliding.way(0.0) - 1)
    lost = 2.0 * sliding.slip**2 / 2
    errors["lost"] = abs(run.evaluate("work", run.duration) + lost) / lost
    return {name: float(size) for name, size in errors.items()}


def test_viscous_block_is_an_exponential() -> None:
    sliding = Sliding(2.0, 0.2, GRAVITY, viscous=0.5)
    assert abs(sliding.time(0.0) / sliding.viscous_end - 1) < 1e-14
    run = slid_block(sliding, 1.2 * sliding.viscous_end)
    assert abs(stopped(run) - sliding.viscous_end) < EXACT
    for time in (0.1, 0.2, 0.3):
        speed = np.hypot(*run.table(["v_x", "v_y"], time).values())
        assert abs(speed - sliding.viscous_slip(time)) < EXACT
    assert run.drift.energy < EXACT


def test_stribeck_block_stops_when_its_logarithm_says() -> None:
    sliding = Sliding(1.5, 0.2, GRAVITY, surplus=0.3, stribeck=0.25)
    run = slid_block(sliding, 1.2 * sliding.stribeck_end)
    assert abs(stopped(run) - sliding.stribeck_end) < EXACT


@pytest.mark.parametrize(
    "sliding",
    [
        Sliding(2.0, 0.2, GRAVITY, viscous=0.5),
        Sliding(1.5, 0.2, GRAVITY, surplus=0.3, stribeck=0.25),
        Sliding(1.5, 0.3, GRAVITY, viscous=0.2, surplus=0.4, stribeck=0.1),
        Sliding(0.02, 0.1, GRAVITY, viscous=1.0, surplus=0.1, stribeck=0.01),
    ],
)
def test_block_by_quadrature(sliding: Sliding) -> None:
    errors = check_block(sliding)
    assert max(errors.values()) < EXACT, errors


@pytest.mark.parametrize(("viscous", "surplus"), [(0.4, 0.0), (0.0, 0.2), (0.3, 0.1)])
def test_sliding_ball(viscous: float, surplus: float) -> None:
    """Its slip keeps its direction; v + k u is kept, and v moves by k/(1 + k) of the slip's."""
    k = 0.4
    sliding = Sliding(2.5, 0.15, GRAVITY, viscous, surplus, 0.3, 1 + 1 / k)
    velocity, along = np.array([0.7, -0.4]), np.array([0.28, 0.96])
    rim = velocity - sliding.slip * along
    spin = {"omega_x": -rim[1] / RADIUS, "omega_y": rim[0] / RADIUS}
    start = {"v_x": velocity[0], "v_y": velocity[1]} | spin
    end = sliding.time(0.0)
    run = ph.simulate(ball(), law(sliding) | {"a": RADIUS, "k": k}, start, 1.5 * end, samples=2)
    assert abs(stopped(run) - end) < EXACT
    final = velocity - k / (1 + k) * sliding.slip * along
    for slip in (1.2, 0.3, 0.0):
        t = sliding.time(slip)
        at = run.table(["x", "y", "v_x", "v_y"], t)
        place = final * t + k / (1 + k) * sliding.way(slip) * along
        assert np.abs(np.array([at["x"], at["y"]]) - place).max() < EXACT
        speed = final + k / (1 + k) * slip * along
        assert np.abs(np.array([at["v_x"], at["v_y"]]) - speed).max() < 10 * EXACT
    assert run.drift.energy < EXACT
