"""A bouncing ball with spin on a moving table: infinitely many bounces in a finite time."""

import numpy as np
import pytest

import polhode as ph
from oracles.sliding_ball import Bounces
from simulate.contact.balls import on_belt

RADIUS = 0.05


def run_of(ball: Bounces, duration: float, *, belt: float = 0.3, spin: float = 0.0, **more):
    """With its slip along x; ω_y = spin."""
    parameters = {"m": 0.2, "a": RADIUS, "k": ball.k, "g": ball.g, "mu": ball.mu}
    parameters |= {"e": ball.restitution, "U": belt}
    start = {
        "z": RADIUS + ball.height,
        "v_z": ball.rise,
        "v_x": ball.slip + belt + RADIUS * spin,
        "omega_y": spin,
    }
    return ph.simulate(on_belt(), parameters, start, duration, samples=2, **more)


def ball_of(seed: int) -> Bounces:
    rng = np.random.default_rng(seed)
    return Bounces(
        k=float(rng.uniform(0.1, 0.8)),
        mu=float(rng.uniform(0.02, 0.3)),
        g=9.81,
        restitution=float(rng.uniform(0.1, 0.8)),
        height=float(rng.uniform(0.0, 0.5)) + 0.01,
        rise=float(rng.uniform(0.0, 2.0)),
        slip=float(rng.uniform(0.0, 3.0)),
    )


def check(ball: Bounces) -> dict[str, float]:
    duration = ball.end * 1.3 + 0.1
    run = run_of(ball, duration, spin=4.0)
    bounces = [event for event in run.events if event.kind == "bounces"]
    (last,) = [event for event in run.events if event.kind == "touches down"]
    assert len(bounces) >= 8
    errors = {
        "landings": max(abs(e.time - ball.landing(n)) for n, e in enumerate(bounces[:12])),
        "end": abs(last.time - ball.end),
    }
    for n in (1, 2, 4):
        t = (ball.landing(n - 1) + ball.landing(n)) / 2
        v, w = (float(run.evaluate(q, t)) for q in ("v_x", "omega_y"))
        errors[f"slip after {n}"] = abs(v - RADIUS * w - 0.3 - ball.slip_after(n))
    kept = ball.slip + 0.3 + RADIUS * 4.0 + ball.k * RADIUS * 4.0
    final = run.final
    errors["kept"] = abs(final["v_x"] + ball.k * RADIUS * final["omega_y"] - kept)
    errors["sideways"] = abs(final["y"]) + abs(final["v_y"]) + abs(final["omega_x"])
    errors["energy"] = run.drift.energy
    assert run.mode in ("rolling", "sliding")
    return errors


@pytest.mark.parametrize("seed", range(6))
def test_closed_form(seed: int) -> None:
    errors = check(ball_of(seed))
    assert max(errors.values()) <= 1e-12, errors


def test_total_time() -> None:
    """Thrown up from the table with speed c it rests after 2c/(g (1 − e))."""
    c, e, g = 1.7, 0.6, 9.81
    run = run_of(Bounces(0.4, 0.1, g, e, 0.0, c, 0.0), 3.0)
    (rests,) = [event.time for event in run.events if event.kind == "touches down"]
    assert abs(rests - 2 * c / (g * (1 - e))) < 1e-12
    assert run.final["mode"] == "rolling"


def test_no_restitution_lands_once() -> None:
    ball = Bounces(0.4, 0.1, 9.81, 0.0, 0.3, 0.0, 1.0)
    run = run_of(ball, 2.0)
    assert [event.kind for event in run.events] == ["start", "touches down", "sticks", "end"]
    assert abs(run.events[1].time - ball.first) < 1e-13
    # the shock takes part of the slip, and friction the rest as the ball slides
    left = ball.slip_after(1)
    assert abs(run.events[2].time - ball.first - left / (3.5 * 0.1 * 9.81)) < 1e-12


def test_all_restitution_bounces_for_ever() -> None:
    ball = Bounces(0.4, 0.0, 9.81, 1.0, 0.2, 0.0, 1.0)
    run = run_of(ball, 5.0)
    bounces = [event.time for event in run.events if event.kind == "bounces"]
    period = 2 * np.sqrt(2 * 0.2 / 9.81)
    assert len(bounces) == int((5.0 - period / 2) / period) + 1
    times = period / 2 + period * np.arange(len(bounces))
    assert np.abs(np.array(bounces) - times).max() < 1e-12
    assert run.drift.energy < 1e-13


def test_energy_is_lost_in_every_bounce() -> None:
    ball = ball_of(3)
    run = run_of(ball, ball.end, belt=0.0)
    after = [float(run.evaluate("energy", (s.begin + s.end) / 2)) for s in run.segments[:20]]
    assert np.all(np.diff(after) < 0)


def test_start_above_the_table_at_rest_falls() -> None:
    ball = Bounces(0.4, 0.1, 9.81, 0.5, 0.2, 0.0, 0.0)
    run = run_of(ball, 0.1, belt=0.0)
    assert run.mode == "flight"
    assert abs(run.final["z"] - (RADIUS + 0.2 - 9.81 * 0.005)) < 1e-15
