"""The ball on a sheet of paper, declared; and random sheets for it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

import polhode as ph
from oracles.ball_on_paper import Ball, Stretch, bumps, polynomials
from polhode.derive import Automaton, automaton
from polhode.simulate.forcing._pieces import Pieces
from polhode.simulate.forcing._samples import sampled

RADIUS, MASS = 0.02, 0.05
NAMES = ("X", "Y", "chi")
BUMPS = 2
LAST = 4.0
SHAPES = {
    (letter, name, i): ph.symbol(f"{letter}_{name}{i}")
    for letter in "hcw"
    for name in NAMES
    for i in range(BUMPS)
}


@cache
def paper() -> Automaton:
    m, r, k, g, mu, mu_static = ph.symbols("m r k g mu mu_s", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=r, inertia=k * m * r**2, axes=lab)
    x, y, chi = ph.functions("X Y chi")
    sheet = ph.Sheet(lab, motion=(x, y), angle=chi)
    touch = ph.Coulomb(ball, on=sheet, mu=mu, mu_static=mu_static, name="sheet")
    return automaton(ph.System(touch, ph.Gravity(g), name="ball on paper"))


@dataclass(frozen=True)
class Case:
    """One sheet, for polhode and for the oracle, and a ball that rolls on it from the start."""

    ball: Ball
    velocity: np.ndarray
    spin: float
    forcing: Mapping[str, Any]
    shape: Mapping[Any, float]
    sheet: list[Stretch]
    turns: bool

    @property
    def parameters(self) -> dict[Any, float]:
        ball = self.ball
        own = {"m": MASS, "r": RADIUS, "k": ball.k, "g": ball.g}
        return own | {"mu": ball.mu, "mu_s": ball.mu_static} | dict(self.shape)

    def run(self, **more: Any) -> ph.Trajectory:
        v_x, v_y = self.velocity
        start = {"v_x": v_x, "v_y": v_y, "omega_z": self.spin}
        return ph.simulate(
            paper(), self.parameters, start, LAST, forcing=self.forcing, samples=2, **more
        )


def case(seed: int) -> Case:
    """A random sheet: analytic, polynomials with jerks, or a spline through noisy samples."""
    rng = np.random.default_rng(seed)
    kind = seed % 4
    turns = bool(rng.integers(2))
    k = float(rng.choice([0.05, 0.2, 0.4, 2 / 3, 0.8, 1.0]))
    mu = float(rng.uniform(0.05, 0.5))
    ratio = float(rng.choice([1.0, 1.0, 1.2, 2.0]))
    ball = Ball(k, mu, mu * ratio)
    # as strong as makes it slip often: the sheet's acceleration against (1 + 1/k) mu g
    pull = ball.alpha * float(rng.uniform(0.5, 5.0))
    velocity = rng.normal(size=2) * float(rng.choice([0.0, 0.1, 0.5]))
    spin = float(rng.normal() * 5)
    make = (_analytic, _jerking, _noisy, _reversing)[kind]
    forcing, shape, sheet = make(rng, pull, turns)
    return Case(ball, velocity, spin, forcing, shape, sheet, turns)


def _analytic(rng: np.random.Generator, pull: float, turns: bool) -> tuple[Any, Any, Any]:
    widths = rng.uniform(0.08, 0.16, (3, BUMPS))
    heights = rng.normal(size=(3, BUMPS)) * pull * widths**2 / 2
    heights[2] = np.sign(heights[2]) * np.minimum(np.abs(heights[2]), 2.0) if turns else 0.0
    middles = rng.uniform(1.1, 1.6, (3, BUMPS))
    values = {"h": heights, "c": middles, "w": widths}
    shape = {
        symbol: float(values[letter][NAMES.index(name), i])
        for (letter, name, i), symbol in SHAPES.items()
        if turns or name != "chi"
    }
    return (
        {name: _bells(name) if turns or name != "chi" else 0 for name in NAMES},
        shape,
        bumps(heights, middles, widths, LAST),
    )


def _bells(name: str) -> ph.Expr:
    t = ph.time
    total = ph.Expr.of(0)
    for i in range(BUMPS):
        h, c, w = (SHAPES[letter, name, i] for letter in "hcw")
        total = total + h * ph.exp(-(((t - c) / w) ** 2))
    return total


def pieces(knots: np.ndarray, tables: list[np.ndarray], corners: tuple[int, ...]) -> Any:
    made = [Pieces(knots, table, corners) for table in tables]
    return dict(zip(NAMES, made, strict=True)), {}, polynomials(knots, tables, LAST)


def _jerking(rng: np.random.Generator, pull: float, turns: bool) -> tuple[Any, Any, Any]:
    """Cubics whose velocity jumps at every knot; from rest, stopped at once."""
    knots = np.cumsum(np.concatenate([[0.1], rng.uniform(0.1, 0.35, 4)]))
    tables = []
    for size in (1.0, 1.0, 3.0 if turns else 0.0):
        table = np.zeros((4, 4))
        place = 0.0
        for i, span in enumerate(np.diff(knots)):
            rate = rng.normal() * pull * 0.1
            own = [place, rate, rng.normal() * pull / 3, rng.normal() * pull]
            table[i] = np.array([own[0], *(size * np.array(own[1:]))])
            place = float(np.polynomial.polynomial.polyval(span, table[i]))
        tables.append(table)
    return pieces(knots, tables, (1, 2, 3))


def _noisy(rng: np.random.Generator, pull: float, turns: bool) -> tuple[Any, Any, Any]:
    """Splines through, or near, noisy samples of a smooth path, in two segments."""
    times = np.sort(0.2 + 1.2 * (np.arange(16) + rng.uniform(-0.3, 0.3, 16)) / 16)
    noise = float(rng.choice([0.0, 1e-4]))
    made = []
    for size in (1.0, 1.0, 2.0 if turns else 0.0):
        rate, phase = rng.uniform(6, 14), rng.uniform(0, 6)
        path = size * pull / rate**2 * np.sin(rate * times + phase)
        path = path + size * rng.normal(size=16) * 1e-4
        made.append(sampled(times, path, starts=(9,), noise=noise if size else 0.0))
    knots = made[0].knots
    return (
        dict(zip(NAMES, made, strict=True)),
        {},
        polynomials(knots, [pieces.coefficients for pieces in made], LAST),
    )


def _reversing(rng: np.random.Generator, pull: float, turns: bool) -> tuple[Any, Any, Any]:
    """To and fro along one line with constant accelerations: slip that reverses head-on."""
    knots = np.cumsum(np.concatenate([[0.0], rng.uniform(0.1, 0.3, 5)]))
    angle = rng.uniform(0, 2 * np.pi)
    along = np.zeros((5, 4))
    place, rate = 0.0, 0.0
    for i, span in enumerate(np.diff(knots)):
        bend = (-1) ** i * pull * rng.uniform(0.3, 1.5)
        along[i] = [place, rate, bend / 2, 0.0]
        place, rate = place + rate * span + bend * span**2 / 2, rate + bend * span
    tables = [along * np.cos(angle), along * np.sin(angle), np.zeros((5, 4))]
    return pieces(knots, tables, ())
