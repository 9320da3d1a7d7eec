"""A ball on random moved sheets, against slip variables with switches of their own."""

import numpy as np
import pytest

from oracles.ball_on_paper import follow
from simulate.contact.paper import LAST, RADIUS, Case, case

GRID = np.linspace(0.31, LAST, 12)
#: The first of the thousands of `tests/proof/test_contact_paper.py`, at least one of every kind,
#: and one in which slip ends where no step from its beginning on is short enough.
SEEDS = [*range(100_000, 100_007), 101_184]


def switches(run) -> list[tuple[float, str]]:
    changes = [e for e in run.events if e.before and e.after and e.before != e.after]
    return [(float(e.time), e.after) for e in changes]


def expected_switches(course) -> list[tuple[float, str]]:
    """Changes between rolling and sliding; a reversal of slip in no time is none."""
    found = []
    names = {"slips": "sliding", "sticks": "rolling"}
    listed = [(t, names[kind]) for t, kind in course.switches]
    i = 0
    while i < len(listed):
        if i + 1 < len(listed) and listed[i + 1][0] == listed[i][0]:
            i += 2
            continue
        found.append(listed[i])
        i += 1
    return [change for change in found if change[0] > 0 and change[0] < LAST]


def check(case: Case, run, course) -> dict[str, float]:
    """Everything the theory says of one run: errors by name, each over what is allowed."""
    ball, times = case.ball, every_instant(run)
    v_x, v_y, omega_x, omega_y = run.table(["v_x", "v_y", "omega_x", "omega_y"], times).values()
    kept = np.array([v_x + ball.k * RADIUS * omega_y, v_y - ball.k * RADIUS * omega_x])
    scale = max(1.0, float(np.abs([v_x, v_y]).max()), float(np.abs([omega_x, omega_y]).max()) / 50)
    at = run.table(["x", "y", "v_x", "v_y"], GRID)
    places, velocities = np.array(course.places).T, np.array(course.velocities).T
    gained = np.array([at["v_x"][-1], at["v_y"][-1]]) - case.velocity
    found = {
        "final velocity": float(np.hypot(*gained)) / 1e-12,
        "conserved": float(np.abs(kept - kept[:, :1]).max()) / (1e-13 * scale),
        "places": float(np.abs([at["x"] - places[0], at["y"] - places[1]]).max()) / 1e-9,
        "velocities": float(np.abs([at["v_x"] - velocities[0], at["v_y"] - velocities[1]]).max())
        / 1e-8,
        "guards": broken_guards(case, run) / 1e-9,
        "energy": run.drift.energy / 1e-12,
    }  # fmt: skip
    got, wanted = switches(run), expected_switches(course)
    found["switches"] = float("inf")
    if [after for _, after in got] == [after for _, after in wanted]:
        gaps = [abs(a[0] - b[0]) for a, b in zip(got, wanted, strict=True)]
        found["switches"] = max(gaps, default=0.0) / 1e-9
    return found


def every_instant(run) -> np.ndarray:
    ends = [segment.end for segment in run.segments]
    steps = [part for segment in run.segments for part in segment.steps]
    return np.unique(np.concatenate([steps, ends, np.linspace(0.0, run.duration, 400)]))


def broken_guards(case: Case, run) -> float:
    """By how much friction exceeds its limit, or does not oppose the slip, in any segment.

    All from positions, velocities and the sheet alone, and never from the guards of polhode.
    """
    worst, ball = 0.0, case.ball
    for segment in run.segments:
        inner = segment.begin + (segment.end - segment.begin) * np.linspace(0.003, 0.997, 60)
        names = ["x", "y", "v_x", "v_y", "omega_x", "omega_y", "F_x", "F_y", "F_z"]
        x, y, v_x, v_y, w_x, w_y, *force = run.table(names, inner).values()
        force = np.array(force) / (np.array(force[2]))
        instants = zip(inner, x, y, strict=True)
        below = np.array([sheet_velocity(case, t, a, b) for t, a, b in instants]).T
        slip = np.array([v_x - RADIUS * w_y - below[0], v_y + RADIUS * w_x - below[1]])
        size = np.hypot(*slip)
        speed = 1.0 + float(np.abs(below).max())
        if segment.mode == "rolling":
            friction = np.hypot(*force[:2])
            worst = max(worst, float(size.max()) / speed, float((friction - ball.mu_static).max()))
        else:
            assert segment.mode == "sliding"
            against = force[:2] * size + ball.mu * slip
            worst = max(worst, float(np.abs(against).max(initial=0.0)) / speed)
            assert size.min() > 0
    return worst


def sheet_velocity(case: Case, t: float, x: float, y: float) -> np.ndarray:
    stretch = next(s for s in reversed(case.sheet) if s.begin <= t)
    place, rate, _ = stretch.moves(t)
    return rate[:2] + rate[2] * np.array([-(y - place[1]), x - place[0]])


@pytest.mark.parametrize("seed", SEEDS)
def test_random_sheet(seed: int) -> None:
    one = case(seed)
    course = follow(one.ball, one.sheet, np.zeros(2), one.velocity, GRID)
    errors = check(one, one.run(), course)
    assert max(errors.values()) <= 1, {n: f"{e:.2g}" for n, e in errors.items() if not e <= 1}


def test_a_ball_at_rest_comes_to_rest() -> None:
    for seed in (1, 2):
        one = case(seed)
        one.velocity[:] = 0.0
        final = one.run().final
        assert np.hypot(final["v_x"], final["v_y"]) < 1e-13
        assert final["mode"] == "rolling"
