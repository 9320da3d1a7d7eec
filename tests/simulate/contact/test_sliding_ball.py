"""A ball with backspin and sidespin: a parabola, then a straight line."""

import numpy as np
import pytest

import polhode as ph
from oracles.sliding_ball import Slide
from simulate.contact.balls import on_slope, on_table

EXACT = 1e-13


def run_of(slide: Slide, duration: float, **more):
    parameters = {"m": 0.3, "a": slide.a, "k": slide.k, "g": slide.g, "mu": slide.mu}
    parameters |= {"mu_s": slide.mu, "e": 0}
    start = {
        "v_x": slide.velocity[0],
        "v_y": slide.velocity[1],
        "omega_x": slide.spin[0],
        "omega_y": slide.spin[1],
        "omega_z": 7.0,
    }
    return ph.simulate(on_table(), parameters, start, duration, samples=2, **more)


def random_slide(seed: int) -> Slide:
    rng = np.random.default_rng(seed)
    k, mu = float(rng.uniform(0.05, 1.0)), float(rng.uniform(0.05, 1.0))
    velocity = rng.normal(size=2) * 2
    return Slide(k, 0.05, mu, 9.81, velocity, rng.normal(size=2) * 2 / 0.05)


def check(slide: Slide) -> dict[str, float]:
    """Errors, relative to the sizes of what they are errors of."""
    end = 2.5 * slide.time
    run = run_of(slide, end)
    sticks = [event for event in run.events if event.kind == "sticks"]
    assert [event.after for event in run.events] == ["sliding", "rolling", None]
    speed = float(max(np.hypot(*slide.velocity), np.hypot(*slide.rim)))
    way = speed * end
    at_switch = np.array([float(run.evaluate(q, sticks[0].time)) for q in ("x", "y")])
    half = np.array([float(run.evaluate(q, slide.time / 2)) for q in ("x", "y")])
    final = run.final
    turned = (final["omega_x"] * slide.a + final["v_y"], final["omega_y"] * slide.a - final["v_x"])
    return {
        "time": abs(sticks[0].time - slide.time) / slide.time,
        "place": float(np.abs(at_switch - slide.place(slide.time)).max()) / way,
        "parabola": float(np.abs(half - slide.place(slide.time / 2)).max()) / way,
        "line": float(np.abs([final["x"], final["y"]] - slide.place(end)).max()) / way,
        "velocity": float(np.abs([final["v_x"], final["v_y"]] - slide.final).max()) / speed,
        "rolls": float(np.abs(turned).max()) / speed,
        "spin": abs(final["omega_z"] - 7.0) / 7.0,
        "energy": run.drift.energy,
    }


@pytest.mark.parametrize("seed", range(8))
def test_closed_form(seed: int) -> None:
    errors = check(random_slide(seed))
    assert max(errors.values()) <= EXACT, errors


def test_pure_sliding_ends_at_five_sevenths() -> None:
    slide = Slide(0.4, 0.05, 0.2, 9.81, np.array([1.4, 0.0]), np.zeros(2))
    assert abs(run_of(slide, 2.0).final["v_x"] - 1.0) < EXACT


def test_enough_backspin_brings_it_back() -> None:
    slide = Slide(0.4, 0.05, 0.2, 9.81, np.array([1.0, 0.0]), np.array([0.0, -100.0]))
    run = run_of(slide, 4.0)
    assert run.final["v_x"] < 0
    turns = run_of(slide, 4.0, events={"turns": ph.speed("v_x")}).events
    (turn,) = [event.time for event in turns if event.kind == "turns"]
    assert abs(turn - 1.0 / (0.2 * 9.81)) < EXACT


def test_exact_cancelling_of_velocity_and_spin_stops_it_dead() -> None:
    slide = Slide(0.5, 0.1, 0.3, 9.81, np.array([1.0, 0.0]), np.array([0.0, -20.0]))
    final = run_of(slide, 2.0).final
    assert abs(final["v_x"]) < EXACT
    assert abs(final["omega_y"]) < 10 * EXACT


def test_rolling_start_stays_rolling() -> None:
    slide = Slide(0.4, 0.05, 0.2, 9.81, np.array([1.0, 2.0]), np.array([-40.0, 20.0]))
    run = run_of(slide, 5.0)
    assert [event.kind for event in run.events] == ["start", "end"]
    assert run.mode == "rolling"
    assert abs(run.final["x"] - 5.0) < EXACT
    assert abs(run.final["y"] - 10.0) < EXACT


@pytest.mark.parametrize("steepness", [0.999999999, 1.000000001])
def test_slope_that_is_just_too_steep(steepness: float) -> None:
    """It rolls down while tan α is at most μ (1 + k)/k, and slips beyond it."""
    k, mu = 0.4, 0.2
    alpha = np.arctan(mu * (1 + k) / k * steepness)
    parameters = {"m": 1, "a": 0.1, "k": k, "g": 9.81, "mu": mu, "alpha": alpha}
    run = ph.simulate(on_slope(), parameters, {}, 1.0, samples=2)
    assert run.mode == ("rolling" if steepness < 1 else "sliding")
    down = 9.81 * (np.sin(alpha) / (1 + k) if steepness < 1 else np.sin(alpha) - mu * np.cos(alpha))
    assert abs(np.hypot(run.final["v_x"], run.final["v_y"]) - down) < 1e-12


def test_steep_slope_both_ways() -> None:
    """Pushed up a slope too steep to roll on it slides up, and then down, never rolling."""
    k, mu, alpha = 0.4, 0.1, 0.9
    parameters = {"m": 1, "a": 0.1, "k": k, "g": 9.81, "mu": mu, "alpha": alpha}
    run = ph.simulate(on_slope(), parameters, {"v_y": 3.0, "v_x": 0.5}, 2.0, samples=2)
    assert {segment.mode for segment in run.segments} == {"sliding"}
    assert run.drift.energy < 1e-13
