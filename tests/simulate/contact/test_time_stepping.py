"""Moreau and Jean's scheme, that knows neither events nor modes, tends to our motions."""

import math

import numpy as np
import pytest

import polhode as ph
from oracles.ball_on_paper import Stretch
from oracles.time_stepping import Disk, Slider, State, Support
from simulate.contact import blocks
from simulate.contact.disks import in_the_lab, numbers, oracle_disk, with_friction
from simulate.contact.paper import RADIUS, Case, case

NAMES = ["x", "y", "z", "v_x", "v_y", "v_z", "theta", "phi", "theta_dot", "phi_dot", "omega_3"]

THROWN = {"theta": 1.45, "omega_3": 20.0, "phi_dot": 1.0, "v_x": -0.8, "v_y": -0.05}


def halved(errors: list[float]) -> bool:
    """Whether errors go down with the step: by two as the step is halved."""
    ratios = np.array(errors[:-1]) / np.array(errors[1:])
    return bool(np.all((ratios > 1.6) & (ratios < 2.5)))


def check_ball(seed: int, duration: float, steps: tuple[float, ...]) -> list[float]:
    one = case(seed)
    run = one.run()
    names = ["x", "y", "v_x", "v_y", "omega_x", "omega_y"]
    x, y, v_x, v_y, w_x, w_y = (float(v) for v in run.table(names, duration).values())
    ours = np.array([x + 1j * y, v_x + 1j * v_y, RADIUS * (w_y - 1j * w_x)])
    ends = (stepped_ball(one, duration, step) for step in steps)
    return [float(np.abs(np.array(end) - ours).max()) for end in ends]


def stepped_ball(one: Case, duration: float, step: float) -> State:
    """With steps that end where the sheet jerks."""
    ball = Slider(one.ball.k, one.ball.mu, one.ball.g)
    velocity = complex(*one.velocity)
    state = (0j, velocity, velocity)
    for stretch in one.sheet:
        span = min(stretch.end, duration) - stretch.begin
        if span > 0:
            state = ball.follow(beneath(stretch), state, span, math.ceil(span / step))
    return state


def beneath(stretch: Stretch) -> Support:
    def velocity(since: float, place: complex) -> complex:
        (x, y, _), (v_x, v_y, turn), _ = stretch.moves(stretch.begin + since)
        return complex(v_x, v_y) + 1j * turn * (place - complex(x, y))

    return velocity


def check_block(ratio: float, duration: float, counts: tuple[int, ...]) -> list[float]:
    mu, w, g = 0.3, 30.0, 9.81
    reach = ratio * mu * g / w**2
    run = blocks.shaken(mu, mu, reach, w, duration, samples=2)
    ours = np.array([run.final["x"], run.final["v_x"]])
    block = Slider(np.inf, mu, g)
    start = (0j, complex(reach * w), 0j)
    ends = [
        block.follow(lambda t, _: complex(reach * w * np.cos(w * t)), start, duration, count)
        for count in counts
    ]
    return [float(np.abs(np.array([place.real, v.real]) - ours).max()) for place, v, _ in ends]


def check_disk(
    mu: float, start: dict[str, float], duration: float, counts: tuple[int, ...]
) -> tuple[list[float], list[str]]:
    run = ph.simulate(with_friction(), numbers(mu), start, duration, samples=2)
    begin, end = (full_state(run, t) for t in (0.0, duration))
    known = oracle_disk(mu)
    disk = Disk(known.m, known.a, known.across, known.about, mu, known.g)
    found = [disk.follow(begin, duration, count) for count in counts]
    scale = 1 + np.abs(end)
    kinds = [event.kind for event in run.events]
    return [float((np.abs(state - end) / scale).max()) for state in found], kinds


def full_state(run, t: float) -> np.ndarray:
    table = run.table(NAMES, t)
    x, y, v_x, v_y, *rest = in_the_lab(table)
    return np.array([x, y, float(table["z"]), v_x, v_y, float(table["v_z"]), *rest])


@pytest.mark.parametrize("seed", [1, 2, 5, 8])
def test_ball_on_a_sheet(seed: int) -> None:
    errors = check_ball(seed, 2.0, (8e-4, 4e-4, 2e-4))
    assert halved(errors), errors


@pytest.mark.parametrize("ratio", [1.2, 1.7])
def test_block_on_a_shaken_sheet(ratio: float) -> None:
    errors = check_block(ratio, 1.0, (2000, 4000, 8000))
    assert halved(errors), errors


def test_disk_that_slips_and_grips() -> None:
    errors, kinds = check_disk(0.25, THROWN, 0.1, (250, 500, 1000))
    assert kinds == ["start", "sticks", "end"]
    assert halved(errors), errors


def test_disk_that_slips_as_it_falls() -> None:
    start = {"theta": 1.0, "phi_dot": 3.0, "omega_3": 20.0}
    errors, kinds = check_disk(0.25, start, 0.2, (250, 500, 1000))
    assert kinds == ["start", "end"]
    assert halved(errors), errors
