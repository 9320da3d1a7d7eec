"""Friction that grows with the slip and has no dry part: it never sticks, and never reverses."""

import numpy as np

import polhode as ph
from polhode.derive import Automaton, automaton

M, A, K, G, C, ALPHA = ph.symbols("m a k g c alpha", positive=True)
NUMBERS = {"m": 0.05, "a": 0.02, "k": 0.4, "g": 9.81, "c": 0.1}


def on(support: type[ph.Plane], **more: object) -> Automaton:
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=M, radius=A, inertia=K * M * A**2, axes=lab)
    touch = ph.Coulomb(ball, on=support(lab, **more), mu=0, viscous=C)
    return automaton(ph.System(touch, ph.Gravity(G)))


def slip(run: ph.Trajectory, time: float) -> float:
    at = run.table(["v_x", "v_y", "omega_x", "omega_y"], time)
    return float(np.hypot(at["v_x"] - 0.02 * at["omega_y"], at["v_y"] + 0.02 * at["omega_x"]))


def test_slip_dies_out_exponentially() -> None:
    run = ph.simulate(on(ph.Plane), NUMBERS, {"v_x": 1.0, "omega_y": 0.0}, 3.0, samples=2)
    assert [event.kind for event in run.events] == ["start", "end"]
    rate = 3.5 * 0.1 * 9.81
    for time in (0.5, 1.0, 2.0):
        assert abs(slip(run, time) - np.exp(-rate * time)) < 1e-15
    assert run.drift.energy < 1e-14


def test_once_it_is_rounding_it_rolls() -> None:
    run = ph.simulate(on(ph.Plane), NUMBERS, {"v_x": 1.0, "omega_y": 0.0}, 60.0, samples=2)
    assert run.mode == "rolling"
    assert abs(run.final["v_x"] - 5 / 7) < 1e-14


def test_down_a_slope_from_rest_it_tends_to_a_constant_slip() -> None:
    run = ph.simulate(on(ph.Plane, tilt=ALPHA), NUMBERS | {"alpha": 0.2}, {}, 3.0, samples=2)
    rate = 3.5 * 0.1 * 9.81 * np.cos(0.2)
    last = 9.81 * np.sin(0.2) / rate
    for time in (0.1, 1.0, 3.0):
        assert abs(slip(run, time) - last * -np.expm1(-rate * time)) < 1e-13
    assert run.drift.energy < 1e-14


def test_on_a_shaken_sheet_slip_follows_the_closed_form() -> None:
    """ṡ = −λ s − Ẍ; it passes through zero heads-on, again and again."""
    (x,) = ph.functions("X")
    shaken = on(ph.Sheet, motion=(x, 0))
    run = ph.simulate(shaken, NUMBERS, {"v_x": 0.3}, 3.0, forcing={"X": ph.sin(3 * ph.time) / 10})
    assert {event.after for event in run.events[1:-1]} == {"sliding"}
    rate, w, amplitude = 3.5 * 0.1 * 9.81, 3.0, 0.9
    t = run.t
    at = run.table(["v_x", "omega_y"], t)
    moved = at["v_x"] - 0.02 * at["omega_y"] - 0.3 * np.cos(w * t)
    forced = amplitude * (rate * np.sin(w * t) - w * np.cos(w * t)) / (rate**2 + w**2)
    own = amplitude * w / (rate**2 + w**2) * np.exp(-rate * t)
    assert np.abs(moved - forced - own).max() < 1e-13
