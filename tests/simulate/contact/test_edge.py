"""A ball on sheets with an edge, against slip variables with switches of their own."""

import math

import numpy as np
import pytest

import polhode as ph
from oracles.ball_on_paper import Stretch
from oracles.time_stepping import Slider, State
from polhode.simulate.forcing._pieces import Pieces
from simulate.contact.edges import KINDS, Edged, case, check, edged

#: One of every kind, of which `tests/proof/test_contact_paper.py` has a hundred, and where an edge
#: is crossed 3e-14 s after slip has ended, 3e-15 s after it has turned round, and 1e-15 s after it
#: has begun.
CASES = [
    *((seed, KINDS[seed % len(KINDS)]) for seed in range(len(KINDS))),
    *((seed, "many rows") for seed in range(100, 102)),
    *((seed, "instants") for seed in (14, 390, 574)),
    (1121, "to and fro"),  # a jerk that was passed over by the last digit of its instant
]
MU, G, K = 0.1, 10.0, 0.4


@pytest.mark.parametrize(("seed", "kind"), CASES)
def test_random_sheet(seed: int, kind: str) -> None:
    one = case(seed, kind)
    errors = check(one, one.run(), one.course())
    assert max(errors.values()) <= 1, {n: f"{e:.2g}" for n, e in errors.items() if not e <= 1}


@pytest.mark.parametrize("seed", [13, 5, 14])
def test_the_oracle_is_what_time_stepping_tends_to(seed: int) -> None:
    """Moreau's scheme knows no events; only the velocity of what is below it."""
    one, errors = case(seed), []
    place, velocity = one.course().places[-1], one.course().velocities[-1]
    for step in (4e-4, 1e-4):
        x, v, _ = stepped(one, 4.0, step)
        errors.append(max(abs(x - complex(*place)), abs(v - complex(*velocity))))
    assert errors[1] < 1e-3
    assert errors[1] < 0.6 * errors[0]


def stepped(one: Edged, duration: float, step: float) -> State:
    """With steps that end where the sheet jerks."""
    ball, velocity = Slider(one.ball.k, one.ball.mu, one.ball.g), complex(*one.velocity)
    state = (0j, velocity, velocity)
    below = beneath(one, one.sheet[0])
    state = (0j, velocity, velocity - below(0.0, 0j))
    for stretch in one.sheet:
        span = min(stretch.end, duration) - stretch.begin
        if span > 0:
            state = ball.follow(beneath(one, stretch), state, span, math.ceil(span / step))
    return state


def beneath(one: Edged, stretch: Stretch):
    def velocity(since: float, place: complex) -> complex:
        (x, y, _), (v_x, v_y, turn), _ = stretch.moves(stretch.begin + since)
        on_sheet = place.real - x < one.edge
        return complex(v_x, v_y) + 1j * turn * (place - complex(x, y)) if on_sheet else 0j

    return velocity


# -- chosen ones -----------------------------------------------------------------------------------


def pulled(x: object, start: dict[str, float], edge: float, duration: float = 2.0, y: object = 0):
    numbers = {"m": 0.05, "r": 0.02, "k": K, "g": G, "mu": MU, "mu_s": MU, "edge": edge}
    forcing = {"X": x, "Y": y, "chi": 0}
    return ph.simulate(edged(), numbers, start, duration, forcing=forcing, samples=2)


def steady(speed: float, until: float = 10.0, begin: float = 0.0) -> Pieces:
    return Pieces(np.array([begin, until]), np.array([[0.0, speed]]))


def rolling(v: float, below: float = 0.0) -> dict[str, float]:
    """On what moves below at some speed."""
    return {"v_x": v, "omega_y": (v - below) / 0.02}


def listed(run: ph.Trajectory) -> list[tuple[str, str]]:
    return [(event.kind, event.after) for event in run.events[1:-1]]


@pytest.mark.parametrize("ahead", [1e-17, 1e-15, 1e-12, 1e-9, 1e-6])
def test_an_edge_just_ahead_is_as_one_beneath(ahead: float) -> None:
    """A sheet that is pulled away from under a ball at rest beside its edge leaves it there."""
    run = pulled(-(ph.time**2) / 2, {"v_x": 0.0}, ahead)
    assert run.mode == "rolling on the table"
    assert abs(run.final["x"]) < 2 * ahead
    assert abs(run.final["v_x"]) < 1e-15


def test_at_the_edge_there_is_no_sheet() -> None:
    """The sheet is where x − X < edge."""
    run = pulled(steady(-1.0), {"v_x": 0.0, "x": 0.25}, 0.25)
    assert (run.events[0].after, listed(run)) == ("rolling on the table", [])


def test_a_ball_that_rolls_along_the_edge_of_a_sheet_at_rest() -> None:
    run = pulled(0, {"v_x": 0.0, "v_y": 1.0, "x": 0.25}, 0.25)
    assert listed(run) == []
    assert abs(run.final["y"] - 2.0) < 1e-15


def test_a_sheet_that_is_pushed_under_a_ball_beyond_its_edge() -> None:
    """Speed U from the start: the edge is below the ball after d/(U − v), and drags it along."""
    u, v, d = 1.0, 0.2, 0.1
    run = pulled(steady(u), {"v_x": v, "x": 0.3 + d}, 0.3)
    assert listed(run) == [("crosses the edge", "sliding"), ("sticks", "rolling")]
    assert abs(run.events[1].time - d / (u - v)) < 1e-15
    assert abs(run.events[2].time - d / (u - v) - u / (3.5 * MU * G)) < 1e-14
    assert abs(run.final["v_x"] - (v + K / (1 + K) * u)) < 1e-14


def test_overtaken_again_and_again_it_comes_back_where_slip_ends() -> None:
    """Rolling on the sheet it is faster than the edge, rolling on the table slower.

    With C = v + k u kept, the excess w = v − U at the edge is lost and won back at μ g, so that
    slip on the sheet ends as the edge is crossed: both at one instant, every 4 w/(μ g).
    """
    u, w = 0.5, 0.06
    run = pulled(steady(u), rolling(u + w, u), 0.05, 3.0)
    times = [e.time for e in run.events if e.before == "rolling" and e.kind == "crosses the edge"]
    assert abs(times[0] - 0.05 / w) < 1e-13
    assert np.abs(np.diff(times) - 4 * w / (MU * G)).max() < 1e-12
    assert len(times) == math.ceil((3.0 - 0.05 / w) / (4 * w / (MU * G)))
    assert run.drift.energy < 1e-13


@pytest.mark.parametrize("ahead", [-1e-9, -1e-12, -1e-16, 0.0, 1e-16, 1e-12, 1e-10, 1e-6])
def test_a_sheet_whose_edge_comes_up_to_the_ball_and_turns_back(ahead: float) -> None:
    """It is ahead − (t − 1)² beyond a ball at rest, which is hardly moved by it."""
    run = pulled(-((ph.time - 1) ** 2), rolling(0.0) | {"x": 0.25}, 0.25 + ahead)
    crossings = [event for event in run.events if event.kind == "crosses the edge"]
    assert len(crossings) in ((0,) if ahead < -1e-15 else (0, 2) if ahead < 1e-15 else (2,))
    assert run.mode == "rolling on the table"
    assert abs(run.final["v_x"]) < 1e-12
    if ahead < 1e-11:
        return
    # in units of w = √ahead: dragged at μ g = 1 until slip ends at −1 + 2/5.5, then rolling, by
    # k/(1 + k) of the way of the sheet, until that is back
    w, slips, part = math.sqrt(ahead), 2 / 5.5, K / (1 + K)
    back = (1 - slips**2 / 2 - part * (1 - slips) ** 2) / (1 - part)
    for event, wanted in zip(crossings, (-1.0, math.sqrt(back)), strict=True):
        assert abs((event.time - 1) / w - wanted) < 1e-15 / ahead


def test_a_sheet_that_stops_as_its_edge_passes_under_the_ball() -> None:
    """It stops at 0.5 s with the edge beneath a ball at rest, which then is on the table."""
    knots, table = np.array([0.0, 0.5, 2.0]), np.array([[0.0, 0.5], [0.25, 0.0]])
    run = pulled(Pieces(knots, table, (1,)), rolling(0.0) | {"x": 0.5}, 0.25)
    assert listed(run) == [("jerk", "rolling on the table")]
    assert abs(run.final["x"] - 0.5) < 1e-15


def test_a_sheet_that_turns_back_with_its_edge_beneath_the_ball() -> None:
    """A velocity that jumps as the edge arrives, so that the ball never gets on the sheet."""
    knots, table = np.array([0.0, 0.5, 2.0]), np.array([[0.0, 0.5], [0.25, -0.5]])
    run = pulled(Pieces(knots, table, (1,)), rolling(0.0) | {"x": 0.5}, 0.25)
    assert listed(run) == [("jerk", "rolling on the table")]
    assert abs(run.final["x"] - 0.5) < 1e-15


def test_a_sheet_that_is_shifted_from_under_the_ball() -> None:
    """To another place in no time: the ball is on the table, which takes its speed from it."""
    knots, table = np.array([0.0, 0.5, 2.0]), np.array([[0.0, 0.0], [-1.0, 0.0]])
    run = pulled(Pieces(knots, table, (1,)), {"v_x": 0.2}, 0.5)
    assert listed(run) == [("jerk", "rolling on the table")]
    assert abs(run.final["x"] - 0.4) < 1e-15


def test_unlimited_friction_at_an_edge_is_refused_with_advice() -> None:
    """Rolling without limit, the ball would be thrown from either side to the other."""
    lab = ph.Frame("lab")
    m, r, k, g = ph.symbols("m r k g", positive=True)
    ball = ph.sphere("ball", mass=m, radius=r, inertia=k * m * r**2, axes=lab)
    (x,) = ph.functions("X")
    sheet = ph.Sheet(lab, motion=(x, 0), edge=ph.symbol("edge"))
    system = ph.System(ph.Rolling(ball, on=sheet, name="sheet"), ph.Gravity(g))
    numbers = {"m": 0.05, "r": 0.02, "k": K, "g": G, "edge": 0.05}
    with pytest.raises(ph.NumericError, match=r"use Coulomb friction \(a coefficient mu\)"):
        ph.simulate(system, numbers, {"v_x": 0.55}, 2.0, forcing={"X": steady(0.5)}, samples=2)
