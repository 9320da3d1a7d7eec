"""Random sheets with an edge, over which a ball that rolls on them gets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np

import polhode as ph
from oracles import ball_on_paper, ball_on_paper_edge
from oracles.ball_on_paper import Ball, Stretch
from polhode.derive import Automaton, automaton
from polhode.simulate.forcing._samples import sampled
from simulate.contact import paper
from simulate.contact.paper import LAST, MASS, RADIUS, pieces

KINDS = (
    "random",
    "jerks",
    "noisy",
    "many rows",
    "pulled away",
    "to and fro",
    "grazing",
    "instants",
    "on edge",
)
GRID = np.linspace(0.31, LAST, 12)


@cache
def edged() -> Automaton:
    """The ball of `paper` on a sheet that ends where x − X(t) = edge."""
    m, r, k, g, mu, mu_static = ph.symbols("m r k g mu mu_s", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=r, inertia=k * m * r**2, axes=lab)
    x, y, chi = ph.functions("X Y chi")
    sheet = ph.Sheet(lab, motion=(x, y), angle=chi, edge=ph.symbol("edge"))
    touch = ph.Coulomb(ball, on=sheet, mu=mu, mu_static=mu_static, name="sheet")
    return automaton(ph.System(touch, ph.Gravity(g), name="ball on paper"))


@dataclass(frozen=True)
class Edged:
    """A sheet with an edge, for polhode and for the oracle, and a ball that rolls on it."""

    kind: str
    ball: Ball
    edge: float
    velocity: np.ndarray
    spin: float
    forcing: Mapping[str, Any]
    shape: Mapping[Any, float]
    sheet: list[Stretch]

    def run(self, **more: Any) -> ph.Trajectory:
        ball, (v_x, v_y) = self.ball, self.velocity
        numbers = {"m": MASS, "r": RADIUS, "k": ball.k, "g": ball.g, "edge": self.edge}
        numbers |= {"mu": ball.mu, "mu_s": ball.mu_static} | dict(self.shape)
        start = {"v_x": v_x, "v_y": v_y, "omega_z": self.spin}
        return ph.simulate(edged(), numbers, start, LAST, forcing=self.forcing, samples=2, **more)

    def course(self) -> ball_on_paper_edge.Course:
        args = self.ball, self.sheet, self.edge, np.zeros(2), self.velocity, GRID
        return ball_on_paper_edge.follow(*args)


def case(seed: int, kind: str = "") -> Edged:
    """A random one, of a kind or of the one that the seed says."""
    rng = np.random.default_rng([seed, 17])
    kind = kind or KINDS[seed % len(KINDS)]
    make = {"pulled away": _pulled, "to and fro": _to_and_fro, "many rows": _many_rows}.get(kind)
    if make is not None:
        return make(rng, kind)
    # sheets of the campaign without an edge, under a ball that goes towards one
    which = {"random": 0, "jerks": 1, "noisy": 2}.get(kind, int(rng.integers(4)))
    plain = paper.case(4 * int(rng.integers(1 << 20)) + which)
    velocity = np.array([rng.uniform(0.1, 0.6), rng.uniform(-0.3, 0.3)])
    course = paper_course(plain, velocity)
    edge = _edge(rng, kind, plain, velocity, course)
    return Edged(
        kind, plain.ball, edge, velocity, plain.spin, plain.forcing, plain.shape, plain.sheet
    )


def paper_course(plain: paper.Case, velocity: np.ndarray) -> tuple[np.ndarray, np.ndarray, Any]:
    """Instants, how far to the right on the sheet the ball is without an edge, and what it did."""
    times = np.linspace(0.0, LAST, 161)[1:]
    course = ball_on_paper.follow(plain.ball, plain.sheet, np.zeros(2), velocity, times)
    return times, _on_sheet(plain, times, np.array(course.places)[:, 0]), course


def _on_sheet(plain: paper.Case, times: np.ndarray, x: np.ndarray) -> np.ndarray:
    moved = [_stretch(plain.sheet, t).moves(t)[0, 0] for t in times]
    return np.asarray(x - np.array(moved))


def _stretch(sheet: list[Stretch], t: float) -> Stretch:
    return next(s for s in reversed(sheet) if s.begin <= t)


def _edge(rng: np.random.Generator, kind: str, plain: paper.Case, velocity: np.ndarray,
          course: Any) -> float:  # fmt: skip
    times, along, declared = course
    if kind == "grazing":  # where the ball turns back on the sheet, if it does, or hardly so
        tops = [i for i in range(1, len(along) - 1) if along[i - 1] < along[i] > along[i + 1]]
        if tops:
            top = float(along[int(rng.choice(tops))])
            return top + float(rng.choice([0.0, 1e-3, -1e-3, 1e-4, -1e-4]))
    if kind == "instants" and declared.switches:  # at an end or beginning of slip, or a jerk
        times = [t for t, _ in declared.switches] + [s.begin for s in plain.sheet if s.begin > 0]
        time = float(rng.choice(times))
        fresh = ball_on_paper.follow(
            plain.ball, plain.sheet, np.zeros(2), velocity, np.array([time])
        )
        return float(_on_sheet(plain, np.array([time]), fresh.places[-1][:1])[0])
    if kind == "on edge":
        return float(rng.choice([0.0, 1e-5, 1e-4, 1e-3]))
    low, high = float(along.min()), float(along.max())
    return float(rng.uniform(max(low, 0.0), max(high, 0.05)))


def _many_rows(rng: np.random.Generator, kind: str) -> Edged:
    """Two seconds of a smooth path that sets off gently, read every few milliseconds."""
    times = np.linspace(0.0, 2.0, int(rng.choice([101, 201, 401])))
    eased = times**2 / (0.1 + times**2)
    sizes, rates, angles = (
        rng.uniform(low, high, (4, 1)) for low, high in ((0.01, 0.12), (0.5, 9.0), (0.0, 6.3))
    )
    waves = eased * sizes * np.sin(rates * times + angles)
    x, y = (sampled(times, path) for path in (waves[:2].sum(axis=0), waves[2:].sum(axis=0)))
    tables = [x.coefficients, y.coefficients, np.zeros((len(times) - 1, 4))]
    forcing, shape, sheet = pieces(times, tables, ())
    velocity = np.array([rng.uniform(0.2, 0.6), rng.uniform(-0.3, 0.3)])
    ball, edge = Ball(0.4, 0.2, 0.2), float(rng.uniform(0.05, 0.4))
    return Edged(kind, ball, edge, velocity, 3.0, forcing, shape, sheet)


def _ball(rng: np.random.Generator) -> Ball:
    mu = float(rng.uniform(0.05, 0.5))
    return Ball(float(rng.choice([0.2, 0.4, 2 / 3])), mu, mu * float(rng.choice([1.0, 1.0, 1.3])))


def _pulled(rng: np.random.Generator, kind: str) -> Edged:
    """Like a tablecloth: a pull, a steady speed, and a stop with a jump or by braking."""
    ball = _ball(rng)
    heading = rng.choice([0.0, np.pi]) + rng.normal() * float(rng.choice([0.0, 0.3, 1.0]))
    pull = ball.alpha * float(rng.choice([0.5, 2.0, 10.0])) * rng.uniform(0.7, 1.4)
    spans = rng.uniform([0.05, 0.3, 0.1], [0.2, 1.2, 0.4])
    knots = np.cumsum(np.concatenate([[0.1], spans]))
    top = pull * spans[0]
    brake = float(rng.choice([0.0, -top / spans[2]]))
    along = np.array(
        [
            [0.0, 0.0, pull / 2],
            [pull * spans[0] ** 2 / 2, top, 0.0],
            [pull * spans[0] ** 2 / 2 + top * spans[1], top, brake / 2],
        ]
    )
    velocity = np.array([rng.uniform(0.1, 1.0), rng.normal() * 0.2])
    tables = [along * np.cos(heading), along * np.sin(heading), np.zeros((3, 3))]
    forcing, shape, sheet = pieces(knots, tables, ())
    edge = float(rng.uniform(0.0, 0.3))
    return Edged(kind, ball, edge, velocity, float(rng.normal()), forcing, shape, sheet)


def _to_and_fro(rng: np.random.Generator, kind: str) -> Edged:
    """An edge that is swept to and fro under the ball while it goes about as fast as the ball."""
    ball = _ball(rng)
    v = float(rng.uniform(0.1, 0.6))
    count = 12
    knots = np.concatenate([[0.0], np.cumsum(rng.uniform(0.08, 0.3, count))])
    rates = v * (1 + rng.uniform(0.0, 0.4)) + (-1.0) ** np.arange(count) * rng.uniform(
        0.1, 1.5, count
    ) * float(rng.choice([0.1, 0.3]))
    smooth = bool(rng.integers(2))
    steps = np.diff(knots)
    if smooth:  # the speed changes steadily from one value to the next
        ends = np.append(rates[1:], rates[-1])
        along = np.column_stack([np.zeros(count), rates, (ends - rates) / steps / 2])
        corners: tuple[int, ...] = ()
    else:
        along = np.column_stack([np.zeros(count), rates, np.zeros(count)])
        corners = tuple(range(1, count))
    moved = along[:, 1] * steps + along[:, 2] * steps**2
    along[1:, 0] = np.cumsum(moved)[:-1]
    aside = np.zeros_like(along)
    drift = float(rng.choice([0.0, 0.0, 0.3])) * rng.normal()
    aside[:, 1] = drift
    aside[:, 0] = drift * knots[:-1]
    tables = [along, aside, np.zeros_like(along)]
    forcing, shape, sheet = pieces(knots, tables, corners)
    velocity = np.array([v, rng.normal() * float(rng.choice([0.0, 0.1]))])
    edge = float(rng.uniform(0.0, 0.03))
    return Edged(kind, ball, edge, velocity, float(rng.normal()), forcing, shape, sheet)


def check(one: Edged, run: ph.Trajectory, course: ball_on_paper_edge.Course) -> dict[str, float]:
    """Everything that the theory says of a run: errors by name, each over what is allowed."""
    ball = one.ball
    ends = [segment.end for segment in run.segments]
    steps = [part for segment in run.segments for part in segment.steps]
    times = np.unique(np.concatenate([steps, ends, np.linspace(0.0, run.duration, 400)]))
    v_x, v_y, w_x, w_y = run.table(["v_x", "v_y", "omega_x", "omega_y"], times).values()
    kept = np.array([v_x + ball.k * RADIUS * w_y, v_y - ball.k * RADIUS * w_x])
    scale = max(1.0, float(np.abs([v_x, v_y]).max()), float(np.abs([w_x, w_y]).max()) / 50)
    at = run.table(["x", "y", "v_x", "v_y"], GRID)
    places, velocities = np.array(course.places).T, np.array(course.velocities).T
    run_modes = [(segment.begin, segment.mode) for segment in run.segments]
    found = {
        "conserved": float(np.abs(kept - kept[:, :1]).max()) / (1e-13 * scale),
        "places": float(np.abs([at["x"] - places[0], at["y"] - places[1]]).max()) / 1e-9,
        "velocities": float(np.abs([at["v_x"] - velocities[0], at["v_y"] - velocities[1]]).max())
        / 1e-8,
        "energy": run.drift.energy / 1e-12,
        "crossings": _apart(_crossings(run_modes), _crossings(course.modes)) / 1e-9,
        "modes": float("inf"),
    }  # fmt: skip
    got, wanted = lasting(run_modes), lasting(course.modes)
    if [mode for _, mode in got] == [mode for _, mode in wanted]:
        found["modes"] = _apart([t for t, _ in got], [t for t, _ in wanted]) / 1e-9
    return found


def _crossings(modes: list[tuple[float, str]]) -> list[float]:
    """Instants at which the surface changes."""
    pairs = pairwise(modes)
    return [t for (_, one), (t, other) in pairs if ("table" in one) != ("table" in other)]


def lasting(modes: list[tuple[float, str]]) -> list[tuple[float, str]]:
    """Modes without those that last no time."""
    ends = [*(t for t, _ in modes[1:]), LAST]
    kept = [(t, m) for (t, m), end in zip(modes, ends, strict=True) if end - t > 1e-9]
    return [(t, m) for i, (t, m) in enumerate(kept) if i == 0 or kept[i - 1][1] != m]


def _apart(got: list[float], wanted: list[float]) -> float:
    got, wanted = _in_pairs(got), _in_pairs(wanted)
    if len(got) != len(wanted):
        return float("inf")
    return max((abs(a - b) for a, b in zip(got, wanted, strict=True)), default=0.0)


def _in_pairs(times: list[float]) -> list[float]:
    """Without crossings to and fro in no time, and without those at the very start and end."""
    kept: list[float] = []
    for t in times:
        if kept and t - kept[-1] <= 1e-9:
            kept.pop()
        else:
            kept.append(float(t))
    return [t for t in kept if 1e-9 < t < LAST - 1e-9]
