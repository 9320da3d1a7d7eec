"""Instants at which several things happen: jerks and ends of slip at once, heads-on reversals."""

import numpy as np
import pytest

import polhode as ph
from polhode.simulate.forcing._pieces import Pieces
from simulate.contact.paper import paper

MU, G, K = 0.1, 10.0, 0.4
SLOWING = (1 + 1 / K) * MU * G  # of a slip along a line, m/s²


def path(knots: list[float], table: list[list[float]]) -> Pieces:
    """Polynomials between knots; the rate jumps at every one."""
    return Pieces(np.array(knots), np.array(table), tuple(range(1, len(knots) - 1)))


def ball(x: object, start: dict[str, float], duration: float = 2.0) -> ph.Trajectory:
    numbers = {"m": 0.05, "r": 0.02, "k": K, "g": G, "mu": MU, "mu_s": MU}
    forcing = {"X": x, "Y": 0, "chi": 0}
    return ph.simulate(paper(), numbers, start, duration, forcing=forcing, samples=2)


def kinds(run: ph.Trajectory) -> list[str]:
    return [event.kind for event in run.events[1:-1]]


SLIDING = {"v_x": 1.0, "omega_y": 0.0}


def test_slip_that_ends_as_the_sheet_jumps() -> None:
    """Slip of 1 m/s ends at 2/7 s, when the sheet sets off at 0.5 m/s: it slips on, backwards."""
    run = ball(path([0.0, 1 / SLOWING, 1.0], [[0.0, 0.0], [0.0, 0.5]]), SLIDING)
    assert kinds(run) == ["jerk", "sticks", "jerk", "sticks"]
    assert abs(run.events[2].time - 1.5 / SLOWING) < 1e-15
    assert abs(run.final["v_x"] - 5 / 7) < 1e-15
    assert run.drift.energy < 1e-14


def test_a_sheet_that_jumps_to_and_fro_and_stops_as_slip_ends() -> None:
    shaken = path([0.0, 0.1, 0.2, 0.3], [[0.0, 1.0], [0.1, -1.0], [0.0, 1.0]])
    run = ball(shaken, {"v_x": 0.0})
    assert kinds(run) == ["jerk", "jerk", "jerk", "sticks"]
    assert abs(run.final["v_x"] + 2 / 7) < 1e-15
    assert run.drift.energy < 1e-14


@pytest.mark.parametrize("jump", [-1e-3, 0.0, 1e-3])
def test_a_jump_that_ends_the_slip(jump: float) -> None:
    """To the velocity of the ball's lowest point, or a little beside it."""
    slip = 1 - SLOWING * 0.2
    run = ball(path([0.0, 0.2, 1.0], [[0.0, 0.0], [0.0, slip + jump]]), SLIDING)
    assert kinds(run)[:1] == ["jerk"]
    assert run.events[1].after == ("sliding" if jump else "rolling")
    assert abs(run.final["v_x"] - 5 / 7) < 1e-15
    assert run.drift.energy < 1e-14


def test_slip_turns_round_heads_on_in_no_time() -> None:
    """A sheet that gathers speed at 5 m/s² catches up with the ball, and leaves it behind."""
    run = ball(5 * ph.time**2 / 2, SLIDING, 1.0)
    (event,) = run.events[1:-1]
    assert (event.kind, event.before, event.after) == ("turns round", "sliding", "sliding")
    assert abs(event.time - 1 / (SLOWING + 5)) < 1e-16
    late = 1.0 - event.time
    assert abs(run.final["v_x"] - (1 - MU * G * event.time + MU * G * late)) < 1e-14


@pytest.mark.parametrize("bend", [-5.0, 5.0])
def test_a_sheet_that_sets_off_as_slip_ends(bend: float) -> None:
    run = ball(Pieces(np.array([0, 2 / 7, 1.0]), np.array([[0, 0, 0], [0, 0, bend / 2]])), SLIDING)
    assert kinds(run)[0] == "turns round"
    assert abs(run.final["v_x"] - 5 / 7) < 1e-14


@pytest.mark.parametrize("bend", [-0.5, 0.5])
def test_a_sheet_that_sets_off_gently_as_slip_ends(bend: float) -> None:
    run = ball(Pieces(np.array([0, 2 / 7, 1.0]), np.array([[0, 0, 0], [0, 0, bend / 2]])), SLIDING)
    assert kinds(run)[0] == "sticks"
    assert abs(run.final["v_x"] - 5 / 7) < 1e-14


@pytest.mark.parametrize("apart", [np.spacing(0.5), 1e-13, 1e-9])
def test_jerks_hardly_apart(apart: float) -> None:
    table = [[0.0, 1.0], [0.4, -3.0], [0.4, 0.5]]
    run = ball(path([0.1, 0.5, 0.5 + apart, 0.9], table), {"v_x": 0.0})
    assert kinds(run) == ["jerk", "sticks", "jerk", "jerk", "sticks", "jerk", "sticks"]
    assert abs(run.final["v_x"]) < 1e-14
    assert abs(run.events[5].time - (0.5 + 0.5 / SLOWING)) < 1e-8


@pytest.mark.parametrize("first", [5e-324, 1e-18, 1e-9])
def test_a_jerk_as_good_as_at_the_start(first: float) -> None:
    run = ball(path([first, 0.5], [[0.0, 1.0]]), {"v_x": 0.0})
    assert kinds(run) == ["jerk", "sticks", "jerk", "sticks"]
    assert abs(run.final["v_x"]) < 1e-14


def test_at_the_start_the_sheet_moves_as_it_does_just_after() -> None:
    """The jump at t = 0 is part of the start: the ball begins rolling on the moving sheet."""
    moved = path([0.0, 0.5], [[0.0, 1.0]])
    assert moved.jumps[0].velocity == (0.0, 1.0)
    run = ball(moved, {"v_x": 0.0})
    assert kinds(run) == ["jerk", "sticks"]
    assert abs(run.final["v_x"] + 2 / 7) < 1e-15


def test_a_path_that_begins_before_the_start() -> None:
    run = ball(path([-0.5, 0.5, 1.0], [[0.0, 1.0], [1.0, 0.5]]), {"v_x": 0.0})
    assert kinds(run) == ["jerk", "sticks", "jerk", "sticks"]
    assert abs(run.final["v_x"] + 2 / 7) < 1e-15


def test_a_jerk_at_the_very_end_is_not_felt() -> None:
    run = ball(path([0.1, 0.5, 1.0], [[0.0, 1.0], [0.4, 0.5]]), {"v_x": 0.0}, 0.5)
    assert kinds(run) == ["jerk", "sticks"]
    assert abs(run.final["v_x"] - 2 / 7) < 1e-15


def test_a_function_may_set_off_at_the_start_under_one_mode() -> None:
    """Equations of one mode cannot follow jerks; at both ends of the motion there is none."""
    equations = paper().together.equations
    numbers = {"m": 0.05, "r": 0.02, "k": K, "g": G}
    forcing = {"X": lambda t: float(np.sin(3 * t)) / 20, "Y": 0, "chi": 0}
    run = ph.simulate(equations, numbers, {"v_x": 0.1}, 1.0, forcing=forcing, samples=2)
    assert abs(run.final["v_x"] - 0.1 - 2 / 7 * 0.15 * (np.cos(3.0) - 1)) < 1e-13
    with pytest.raises(ph.DeclarationError, match=r"jerks at t = 0\.5 s"):
        ph.simulate(equations, numbers, {}, 1.0, forcing=forcing | {"X": path([0, 0.5], [[0, 1]])})


def test_a_sheet_that_gathers_speed_at_once_slips_at_that_instant() -> None:
    """What the forces allow up to a knot and forbid from there on ends at the knot."""
    table = np.array([[0.0, 0.0, 1.0], [0.04, 0.4, 3.0], [0.55, 2.2, -0.1]])
    run = ball(Pieces(np.array([0.0, 0.2, 0.5, 0.9]), table), {"v_x": 0.0}, 0.6)
    assert [(event.kind, event.time) for event in run.events[1:2]] == [("slips", 0.2)]
    assert run.drift.energy < 1e-13
