"""Within the static limit nothing creeps; beyond it slip follows the closed form."""

import numpy as np
import pytest

import polhode as ph
from oracles.blocks import Shaken, Tilted
from simulate.contact.blocks import numbers, on_plane, rocked, shaken, tilted

G, OMEGA = 9.81, 30.0
PASSED = 1e-9


def reach_at(mu_static: float, ratio: float) -> float:
    """Of a sheet that accelerates by so much of the static limit."""
    return mu_static * G * ratio / OMEGA**2


def creep(run) -> float:
    """Motion over the sheet, relative to the sheet's."""
    moved = run["x"] - run["X"]
    return float(np.abs(moved - moved[0]).max() / np.abs(run["X"]).max())


@pytest.mark.parametrize("ratio", [0.2, 0.9, 1 - PASSED])
def test_shaken_within_the_limit_it_does_not_creep(ratio: float) -> None:
    reach = reach_at(0.3, ratio)
    run = shaken(0.25, 0.3, reach, OMEGA, 300 * 2 * np.pi / OMEGA)
    assert [event.kind for event in run.events] == ["start", "end"]
    assert creep(run) < 1e-14


def test_tilted_within_the_limit_it_does_not_move_at_all() -> None:
    run = ph.simulate(
        on_plane(),
        numbers(0.3, 0.3),
        {"x": 0.1, "y": 0.2},
        40.0,
        forcing={"beta": ph.sin(5 * ph.time) / 8},
    )
    assert [event.kind for event in run.events] == ["start", "end"]
    assert np.all(run["x"] == 0.1)
    assert np.all(run["y"] == 0.2)


def test_shaken_and_tilted_at_once_it_does_not_creep() -> None:
    run = rocked(0.4, 2e-3, 0.1, OMEGA, 200 * 2 * np.pi / OMEGA)
    assert [event.kind for event in run.events] == ["start", "end"]
    assert creep(run) < 1e-14
    assert np.all(run["y"] == 0.0)


@pytest.mark.parametrize("ratio", [1.2, 1 + PASSED])
def test_shaken_beyond_the_limit_it_slips(ratio: float) -> None:
    block = Shaken(reach_at(0.36, ratio), OMEGA, 0.3, 0.36, G)
    run = shaken(0.3, 0.36, block.reach, OMEGA, block.sticks * 1.02, samples=2)
    slips, sticks = run.events[1:3]
    assert (slips.kind, sticks.kind) == ("slips", "sticks")
    # near the crest of the acceleration an instant is known to the root of the rounding
    assert abs(slips.time - block.slips) < (1e-13 if ratio > 1.1 else 1e-11)
    assert abs(sticks.time - block.sticks) < (1e-12 if ratio > 1.1 else 1e-10)
    moved = run.final["x"] - block.reach * np.sin(OMEGA * run.duration)
    assert abs(moved - block.shift) < 1e-11
    assert run.drift.energy < 1e-12


@pytest.mark.parametrize("excess", [PASSED, 1e-6])
def test_shaken_a_little_too_much_with_one_coefficient(excess: float) -> None:
    """With δ = √(2ε) before the crest it slips, for 3 δ of phase: at less than 1e-13 m/s."""
    block = Shaken(reach_at(0.3, 1 + excess), OMEGA, 0.3, 0.3, G)
    run = shaken(0.3, 0.3, block.reach, OMEGA, 0.9 * 2 * np.pi / OMEGA, samples=2)
    kinds = [(event.kind, float(event.time)) for event in run.events[1:-1]]
    assert [kind for kind, _ in kinds] == ["slips", "sticks"] * 2
    half = np.pi / OMEGA
    for k, (_, time) in enumerate(kinds):
        expected = (block.sticks if k % 2 else block.slips) + half * (k // 2)
        assert abs(time - expected) < 1e-12
    assert abs(block.lasts / np.sqrt(2 * excess) - 3) < 1e-5
    moved = run.table(["x", "X"], block.sticks * 1.01)
    assert abs(moved["x"] - moved["X"] - block.shift) < 1e-17


@pytest.mark.parametrize("rate", [0.1, 1.5])
def test_tilted_beyond_the_limit_it_slips(rate: float) -> None:
    block = Tilted(rate, 0.2, 0.3, 0.4, G)
    run = tilted(0.4, rate, 0.3, block.slips * 1.3)
    slips = run.events[1]
    assert slips.kind == "slips"
    assert abs(slips.time - block.slips) < 1e-12
    assert run.final["y"] < 0.3


@pytest.mark.parametrize("ratio", [1 - PASSED, 1 + PASSED])
def test_slope_at_the_limit(ratio: float) -> None:
    """tan β = μ_s holds it; a billionth more does not, and it accelerates by g(s − μ c)."""
    beta = float(np.arctan(0.5 * ratio))
    run = ph.simulate(
        on_plane(), numbers(0.4, 0.5), {}, 2.0, forcing={"beta": ph.Expr.of(0) + beta}, samples=2
    )
    if ratio < 1:
        assert run.mode == "rolling"
        assert run.final["y"] == 0.0
    else:
        down = G * (np.sin(beta) - 0.4 * np.cos(beta))
        assert run.mode == "sliding"
        assert abs(run.final["y"] + 2 * down) < 1e-12


def test_pushed_it_comes_to_rest() -> None:
    run = shaken(0.3, 0.3, 1e-9, 1.0, 3.0, samples=2)
    assert run.mode == "rolling"
    still = ph.simulate(
        on_plane(), numbers(0.3, 0.3), {"v_x": 3.0, "v_y": 4.0}, 3.0, forcing={"beta": 0}, samples=2
    )
    stops = 5.0 / (0.3 * G)
    assert [event.kind for event in still.events] == ["start", "sticks", "end"]
    assert abs(still.events[1].time - stops) < 1e-13
    assert abs(np.hypot(still.final["x"], still.final["y"]) - 2.5 * stops) < 1e-12


def test_a_ball_that_rolls_on_a_shaken_sheet_keeps_its_share_of_the_velocity() -> None:
    """k/(1 + k) of the sheet's, with no rounding gathered over thousands of periods."""
    lab = ph.Frame("lab")
    m, a, g = ph.symbols("m a g", positive=True)
    paper = ph.Sheet(lab, motion=(*ph.functions("X"), 0))
    touch = ph.Coulomb(ph.sphere("ball", mass=m, radius=a, axes=lab), on=paper, mu=0.3)
    run = ph.simulate(
        ph.System(touch, ph.Gravity(g)),
        {"m": 0.05, "a": 0.02, "g": G},
        {"v_x": 0.1},
        8192.0,
        forcing={"X": ph.sin(3 * ph.time) / 20},
        samples=1025,  # at times, and angles, without rounding
    )
    assert run.mode == "rolling"
    expected = 0.1 + 2 / 7 * 3 / 20 * (np.cos(3 * run.t) - 1)
    assert np.abs(run["v_x"] - expected).max() < 1e-15
    assert run.drift.energy < 1e-13
