"""A disk that rolls, slips, lifts off, lands and goes flat on a table with friction."""

import numpy as np
import pytest

import polhode as ph
from oracles.sliding_disk import follow, slip
from simulate.contact.disks import (
    frictionless,
    in_the_lab,
    numbers,
    oracle_disk,
    plain,
    rolling,
    with_friction,
)

NAMES = ["x", "y", "v_x", "v_y", "theta", "phi", "theta_dot", "phi_dot", "omega_3"]
LEANING = {"theta": 1.2, "phi_dot": 2.0, "omega_3": 15.0}


def test_with_friction_enough_it_only_rolls() -> None:
    without_restitution = {name: plain()[name] for name in "mag"}
    run = ph.simulate(with_friction(), numbers(5.0), LEANING, 1.5, samples=50)
    only = ph.simulate(rolling(), without_restitution, LEANING, 1.5, samples=50)
    assert [event.kind for event in run.events] == ["start", "end"]
    for name in (*NAMES, "F_x", "F_y", "F_z"):
        scale = 1 + np.abs(only[name]).max()
        assert np.abs(run[name] - only[name]).max() < 1e-12 * scale


def check_segments(run, mu: float, mu_static: float) -> None:
    """Forces, slip and gaps of every segment, from states alone."""
    disk = oracle_disk(mu)
    for segment in run.segments:
        inner = segment.begin + (segment.end - segment.begin) * np.linspace(0.02, 0.98, 25)
        table = run.table([*NAMES, "z", "v_z", "F_x", "F_y", "F_z"], inner)
        for i in range(len(inner)):
            now = {name: values[i] for name, values in table.items()}
            state = in_the_lab(now)
            velocity = np.array([state[2], state[3], now["v_z"]])
            moving = slip(disk, velocity, state[4:7], state[7:])
            gap = now["z"] - disk.a * np.sin(now["theta"])
            force = np.array([now["F_x"], now["F_y"]])
            if segment.mode == "flight":
                assert gap > 0
                assert now["F_z"] == 0
                continue
            assert abs(gap) < 1e-13
            assert abs(moving[2]) < 1e-12
            assert now["F_z"] > 0
            if segment.mode == "rolling":
                assert np.hypot(*moving[:2]) < 1e-12
                assert np.hypot(*force) <= mu_static * now["F_z"] * (1 + 1e-9)
            elif segment.mode == "sliding":
                size = np.hypot(*moving[:2])
                assert size > 0
                assert np.abs(force * size + mu * now["F_z"] * moving[:2]).max() < 1e-11


@pytest.mark.parametrize(("mu", "ratio"), [(0.25, 1.0), (0.2, 1.2), (0.05, 1.0)])
def test_slips_and_rolls_again(mu: float, ratio: float) -> None:
    start = {"theta": 1.0, "phi_dot": 3.0, "omega_3": 20.0}
    run = ph.simulate(with_friction(), numbers(mu, mu * ratio), start, 0.9, samples=200)
    assert any(event.after == "sliding" for event in run.events)
    assert run.drift.energy < 1e-12
    energy = run["energy"]
    sliding = np.array([run_mode(run, t) == "sliding" for t in run.t])
    both = sliding[:-1] & sliding[1:]
    assert np.all(np.diff(energy)[both] < 0)
    rests = ~sliding[:-1] & ~sliding[1:]
    assert np.abs(np.diff(energy)[rests]).max(initial=0.0) < 1e-3 * (energy[0] - energy[-1])
    check_segments(run, mu, mu * ratio)


def run_mode(run, t: float) -> str:
    return next(s.mode for s in reversed(run.segments) if s.begin <= t)


@pytest.mark.parametrize("mu", [0.1, 0.25])
def test_against_smooth_friction(mu: float) -> None:
    """Errors of the smoothed friction are in proportion to ε: extrapolated, it is ours."""
    start = {"theta": 1.2, "omega_3": 5.0, "phi_dot": 1.0, "v_x": 0.4, "v_y": -0.3}
    run = ph.simulate(with_friction(), numbers(mu), start, 0.3, samples=2)
    begin, end = (in_the_lab(run.table(NAMES, t)) for t in (0.0, 0.3))
    assert run.segments[0].mode == "sliding"
    coarse, fine = (follow(oracle_disk(mu), begin, 0.3, eps) for eps in (2e-5, 1e-5))
    scale = 1 + np.abs(end)
    assert np.max(np.abs(2 * fine - coarse - end) / scale) < 2e-6
    assert np.max(np.abs(fine - end) / scale) < 2e-3


def test_lifts_off_and_lands() -> None:
    """Falling over fast, the disk leaves the table: its centre would sink faster than it falls."""
    start = {"theta": 0.9, "theta_dot": 15.5, "omega_3": 5.0}
    run = ph.simulate(with_friction(), numbers(0.3), start, 0.25, samples=60)
    kinds = [event.kind for event in run.events]
    assert kinds.index("lifts off") < kinds.index("touches down")
    assert "flight" in {segment.mode for segment in run.segments}
    assert run.drift.energy < 1e-11
    check_segments(run, 0.3, 0.3)


def test_a_landing_disk_loses_energy() -> None:
    start = {"z": 0.2, "v_z": 0.0, "theta": 0.9, "omega_3": 10.0, "v_x": 0.3}
    run = ph.simulate(with_friction(), numbers(0.2, e=0.5), start, 0.25, samples=60)
    assert run.segments[0].mode == "flight"
    assert run.events[1].kind in ("bounces", "touches down")
    fall = np.sqrt(2 * (0.2 - 0.05 * np.sin(0.9)) / 9.81)
    assert abs(run.events[1].time - fall) < 1e-13
    assert run.final["energy"] < run["energy"][0]
    assert run.drift.energy < 1e-11
    check_segments(run, 0.2, 0.2)


def test_goes_flat() -> None:
    """Released leaning on a frictionless table it falls flat, which ends the motion."""
    run = ph.simulate(frictionless(), plain(), {"theta": 1.0}, 2.0, samples=2)
    last = run.events[-2]
    assert (last.kind, last.after) == ("goes flat", "near-flat")
    assert run.mode == "near-flat"
    assert run.duration < 2.0
    assert abs(np.sin(run.evaluate("theta", run.duration)) - 1e-3) < 1e-12
    # energy: m v²/2 + I θ̇²/2 with v = a cos θ θ̇ (the centre falls straight down)
    m, a, g = 0.1, 0.05, 9.81
    theta, rate = (float(run.evaluate(q, run.duration)) for q in ("theta", "theta_dot"))
    fallen = m * g * a * (np.sin(1.0) - np.sin(theta))
    moving = m * (a * np.cos(theta) * rate) ** 2 / 2 + m * a * a / 8 * rate**2
    assert abs(moving - fallen) < 1e-12 * fallen


@pytest.mark.parametrize("factor", [1.05, 0.95])
def test_coin_spinning_on_edge(factor: float) -> None:
    """Upright spin about a diameter is stable on a frictionless table if φ̇² > 4 g/a.

    The tilt x obeys, to first order, (I + m a² 0) ẍ = (m g a − I φ̇²) x with I = m a²/4.
    """
    threshold = np.sqrt(4 * 9.81 / 0.05)
    nudge = 1e-6
    start = {"theta": np.pi / 2 - nudge, "phi_dot": factor * threshold}
    run = ph.simulate(frictionless(), plain(), start, 2.0, samples=400)
    if factor > 1:
        assert run.mode == "frictionless"
        assert np.abs(run["theta"] - np.pi / 2).max() < 1.01 * nudge
    else:
        assert np.abs(run["theta"] - np.pi / 2).max() > 0.05
        early = run.t < 0.2
        rate = threshold * np.sqrt(1 - factor**2)
        grown = nudge * np.cosh(rate * run.t[early])
        assert np.abs((np.pi / 2 - run["theta"][early]) / grown - 1).max() < 1e-6
    assert run.drift.energy < 1e-12


def test_frictionless_motion_runs_backwards() -> None:
    start = {"theta": 1.0, "phi_dot": 20.0, "omega_3": 7.0, "theta_dot": 1.0, "v_x": 0.3}
    run = ph.simulate(frictionless(), plain(), start, 0.7, samples=2)
    there = {name: float(v) for name, v in run.table(NAMES, 0.7).items()}
    back = {n: (-v if n.endswith("_dot") or n[0] in "vo" else v) for n, v in there.items()}
    end = ph.simulate(frictionless(), plain(), back, 0.7, samples=2)
    for name in NAMES:
        sign = -1 if name.endswith("_dot") or name[0] in "vo" else 1
        assert abs(sign * end.final[name] - float(run.evaluate(name, 0.0))) < 1e-10
