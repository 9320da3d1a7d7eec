"""A ball on a moved sheet in twenty-two digits: power series in balls of arbitrary precision.

The slip obeys s' = −α ŝ − dV/dt as in `ball_on_paper`; nothing else is shared with it. Slipping is
followed in τ, dt = |s| dτ/α, with log |s| and the angle of s; a beginning by its formal series in
time, at whose point the true slip arrives faster than any power; rolling in time. Instants are
found by Newton's method on those series. For sheets that are polynomials between knots.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

import flint
import numpy as np
from flint import arb, arb_series

from .parts import Array

_BITS, _ORDER = 130, 24
_SMALL = 1e-26  # of the last terms of a step
_GONE = 1e-24  # m/s, a slip that has ended
_LOOKS = 40  # in each step of rolling, for where the limit is passed

Series = Any  # arb_series
Number = Any  # arb
Rates = Callable[[list[Series]], list[Series]]


@dataclass(frozen=True)
class Piece:
    """X, Y and angle of the sheet in rising powers of the time since its begin."""

    begin: float
    rows: tuple[tuple[Number, ...], ...]


def pieces(knots: Array, tables: Sequence[Array]) -> list[Piece]:
    """The sheet between knots, and at rest before and after."""
    table = np.stack(tables)
    inner = [(float(knot), table[:, i]) for i, knot in enumerate(knots[:-1])]
    rests = table[:, 0, :1], np.zeros((3, 1))
    made = [
        _piece(at, rows) for at, rows in ((0.0, rests[0]), *inner, (float(knots[-1]), rests[1]))
    ]
    ends = tuple(
        (_polynomial(row, arb(float(knots[-1])) - made[-2].begin)[0],) for row in made[-2].rows
    )
    return [*made[:-1], Piece(float(knots[-1]), ends)]


def _piece(begin: float, rows: Array) -> Piece:
    return Piece(begin, tuple(tuple(arb(float(c)) for c in row) for row in rows))


@dataclass
class Course:
    """Switches, places and velocities at the instants asked for, in twenty-two digits."""

    switches: list[tuple[Number, str]] = field(default_factory=list)
    places: list[list[Number]] = field(default_factory=list)
    velocities: list[list[Number]] = field(default_factory=list)


@dataclass(frozen=True)
class Ball:
    """k = I/(m a²), kinetic and static friction, g."""

    k: Number
    mu: Number
    mu_static: Number
    g: Number

    @property
    def alpha(self) -> Number:
        return (1 + 1 / self.k) * self.mu * self.g

    @property
    def limit(self) -> Number:
        return (1 + 1 / self.k) * self.mu_static * self.g


def follow(ball: Ball, sheet: Sequence[Piece], velocity: Sequence[Number], times: Array) -> Course:
    """From rolling at the origin of a sheet at rest, to the last time."""
    with _precision():
        walk = _Walk(ball, sheet, list(velocity))
        for time in times:
            walk.to(arb(float(time)))
            walk.note()
        return walk.course


@contextmanager
def _precision() -> Iterator[None]:
    bits, cap = flint.ctx.prec, flint.ctx.cap
    flint.ctx.prec = _BITS
    try:
        yield
    finally:
        flint.ctx.prec, flint.ctx.cap = bits, cap


class _Walk:
    def __init__(self, ball: Ball, sheet: Sequence[Piece], velocity: list[Number]) -> None:
        self.ball, self.sheet, self.piece = ball, list(sheet), 0
        self.now, self.place = arb(0), [arb(0), arb(0)]
        self.end = arb(0)
        self.slip: list[Number] | None = None
        below = self._below([arb(0)], self.place)
        k = ball.k
        self.kept = [v * (1 + k) - k * V for v, V in zip(velocity, below, strict=True)]
        self.course = Course()

    # -- kinematics, of numbers and of series ---------------------------------------------------

    def _sheet(self, t: Any) -> list[list[Any]]:
        piece = self.sheet[self.piece]
        return [_polynomial(row, t - piece.begin) for row in piece.rows]

    def _below(self, t: list[Any], place: Sequence[Any]) -> list[Any]:
        (X, Vx, _), (Y, Vy, _), (_, turn, _) = self._sheet(t[0])
        return [Vx - turn * (place[1] - Y), Vy + turn * (place[0] - X)]

    def _velocity(self, t: Any, place: Sequence[Any], slip: Sequence[Any]) -> list[Any]:
        k = self.ball.k
        below = self._below([t], place)
        return [(c + k * (s + V)) / (1 + k) for c, s, V in zip(self.kept, slip, below, strict=True)]

    def _drag(self, t: Any, place: Sequence[Any], slip: Sequence[Any]) -> list[Any]:
        """dV/dt, along the way of the ball."""
        (X, Vx, Ax), (Y, Vy, Ay), (_, turn, bend) = self._sheet(t)
        v = self._velocity(t, place, slip)
        along = [Ax - bend * (place[1] - Y) - turn * (v[1] - Vy)]
        return [*along, Ay + bend * (place[0] - X) + turn * (v[0] - Vx)]

    # -- going on -------------------------------------------------------------------------------

    def to(self, time: Number) -> None:
        self.end = time
        while self.now < time:
            last = self.piece + 1 == len(self.sheet)
            goal = self._goal()
            if self.now < goal:
                (self._roll if self.slip is None else self._slide)(goal)
            elif not last:
                self._enter()
            if self.now == goal < time and not last:
                self._enter()

    def _goal(self) -> Number:
        """The time asked for, or the next knot."""
        knots = [arb(piece.begin) for piece in self.sheet[self.piece + 1 : self.piece + 2]]
        return min([self.end, *knots])

    def note(self) -> None:
        slip = self.slip or [arb(0), arb(0)]
        self.course.places.append(list(self.place))
        self.course.velocities.append(self._velocity(self.now, self.place, slip))

    def _enter(self) -> None:
        before = self._below([self.now], self.place)
        self.piece += 1
        after = self._below([self.now], self.place)
        jump = [b - a for a, b in zip(before, after, strict=True)]
        if float(_size(jump)) > 1e-12:
            if self.slip is None:
                self.course.switches.append((self.now, "slips"))
            self.slip = [s - j for s, j in zip(self.slip or [arb(0)] * 2, jump, strict=True)]
        elif self.slip is None:
            self._settle()

    def _settle(self) -> None:
        if _size(self._drag(self.now, self.place, [arb(0), arb(0)])) > self.ball.limit:
            self._begin()

    # -- rolling --------------------------------------------------------------------------------

    def _roll(self, goal: Number) -> None:
        rest = [arb(0), arb(0)]

        def rates(y: list[Series]) -> list[Series]:
            return [*self._velocity(y[2], y[:2], rest), arb_series([1])]

        rows = _solution(rates, [*self.place, self.now])
        span = min(_reach(rows), goal - self.now)
        with _cap(_ORDER):
            x, y, t = (arb_series(row) for row in rows)
            drag = self._drag(t, [x, y], rest)
            reserve = _row(self.ball.limit**2 - drag[0] * drag[0] - drag[1] * drag[1], _ORDER)
        passed = _first_below_zero(reserve, span)
        span = span if passed is None else passed
        ended = span == goal - self.now
        self.place = [_at(row, span) for row in rows[:2]]
        self.now = goal if ended and passed is None else (self.now + span).mid()
        if passed is not None:
            self._begin()

    # -- sliding --------------------------------------------------------------------------------

    def _begin(self) -> None:
        """By its formal series in time, as far as that goes: σ' = −a·ŝ − α, σ ψ' = a × ŝ."""
        start, rest = self.now, [arb(0), arb(0)]
        away = self._drag(start, self.place, rest)
        first = 1 - self.ball.alpha / _size(away)  # by which the angle lags, over its rate
        size, psi, *place = [[arb(0)], [_angle([-a for a in away])], *([p] for p in self.place)]
        for n in range(1, _ORDER):
            with _cap(n + 1):
                _, gain, velocity = self._pulled(start, size, psi, place)
                size.append((gain[n - 1] / n).mid())
                for row, rate in zip(place, velocity, strict=True):
                    row.append((rate[n - 1] / n).mid())
                drag, _, _ = self._pulled(start, size, psi, place)
                most = (drag[0] * drag[0] + drag[1] * drag[1]).sqrt()
                turn = arb_series([*(m * psi[m] for m in range(1, n)), arb(0)])
                lag = (arb_series(size) * turn / most).asin()
                wanted = _direction([-a for a in drag]) - lag
                psi.append((wanted[n] / (1 + n * first)).mid())
        rows = [size, psi, *place]
        step = min(_reach(rows), (self._goal() - start) / 2)
        ends = [_at(row, step) for row in rows]
        self.course.switches.append((start, "slips"))
        self.slip = [ends[0] * ends[1].cos(), ends[0] * ends[1].sin()]
        self.place, self.now = ends[2:], (start + step).mid()

    def _pulled(
        self, start: Number, size: list[Number], psi: list[Number], place: list[list[Number]]
    ) -> tuple[list[Series], Series, list[Series]]:
        """dV/dt, the rate of |s| and the ball's velocity, from series in the time since."""
        angle, along = arb_series(psi), [arb_series(row) for row in place]
        c, s = angle.cos(), angle.sin()
        slip = [arb_series(size) * c, arb_series(size) * s]
        t = arb_series([start, 1])
        drag = self._drag(t, along, slip)
        gain = -drag[0] * c - drag[1] * s - self.ball.alpha
        return drag, gain, self._velocity(t, along, slip)

    def _slide(self, goal: Number) -> None:
        """Steps in τ to the goal or to the end of the slip."""
        assert self.slip is not None
        alpha = self.ball.alpha

        def rates(y: list[Series]) -> list[Series]:
            size, c, s = y[0].exp(), y[1].cos(), y[1].sin()
            slip = [size * c, size * s]
            ax, ay = self._drag(y[4], y[2:4], slip)
            v = self._velocity(y[4], y[2:4], slip)
            turn = (ax * s - ay * c) / alpha
            return [
                -1 - (ax * c + ay * s) / alpha, turn, *(w * size / alpha for w in v), size / alpha
            ]  # fmt: skip

        state = [_size(self.slip).log().mid(), _angle(self.slip), *self.place, self.now]
        while state[4] < goal and float(state[0]) > np.log(_GONE):
            rows = _solution(rates, state)
            step = _reach(rows)
            if _at(rows[4], step) >= goal:
                step = _root([rows[4][0] - goal, *rows[4][1:]], step)
                state = [*(_at(row, step) for row in rows[:4]), goal]
            else:
                state = [_at(row, step) for row in rows]
        size = state[0].exp()
        self.place, self.now = state[2:4], state[4]
        self.slip = [(size * state[1].cos()).mid(), (size * state[1].sin()).mid()]
        if self.now < goal:
            self.slip = None
            self.course.switches.append((self.now, "sticks"))
            self._settle()


# -- power series --------------------------------------------------------------------------------


@contextmanager
def _cap(length: int) -> Iterator[None]:
    before, flint.ctx.cap = flint.ctx.cap, length
    try:
        yield
    finally:
        flint.ctx.cap = before


def _polynomial(row: Sequence[Number], since: Any) -> list[Any]:
    """Value, rate and second rate."""
    value, rate, bend = since * 0, since * 0, since * 0
    for n in reversed(range(len(row))):
        value = value * since + row[n]
        if n >= 1:
            rate = rate * since + n * row[n]
        if n >= 2:
            bend = bend * since + n * (n - 1) * row[n]
    return [value, rate, bend]


def _solution(rates: Rates, start: Sequence[Number]) -> list[list[Number]]:
    """Coefficients of y' = rates(y), each term from those before it."""
    rows = [[value] for value in start]
    for known in range(1, _ORDER):
        with _cap(known):
            found = rates([arb_series(row) for row in rows])
        for row, rate in zip(rows, found, strict=True):
            row.append((rate[known - 1] / known).mid())
    return rows


def _row(series: Series, terms: int) -> list[Number]:
    return [series[n].mid() for n in range(terms)]


def _direction(vector: list[Series]) -> Series:
    """Its angle, near that of its first term."""
    first = [part[0].mid() for part in vector]
    along = vector[0] * first[0] + vector[1] * first[1]
    across = vector[1] * first[0] - vector[0] * first[1]
    return (across / along).atan() + _angle(first)


def _reach(rows: Sequence[Sequence[Number]]) -> Number:
    """The step over which the last terms stay small."""
    steps = [np.inf]
    for row in rows:
        for n in range(_ORDER - 4, _ORDER):
            size = abs(row[n])
            if size > 0:
                steps.append(float((arb(_SMALL) / size).log() / n))
    return arb(float(np.exp(min(steps)))) if np.isfinite(min(steps)) else arb(1e3)


def _at(row: Sequence[Number], step: Number) -> Number:
    total = arb(0)
    for term in reversed(row):
        total = total * step + term
    return total.mid()


def _root(row: Sequence[Number], near: Number) -> Number:
    for _ in range(60):
        slope = _at([n * term for n, term in enumerate(row)][1:], near)
        change = (_at(row, near) / slope).mid()
        near = (near - change).mid()
        if abs(float(change)) < 1e-40:
            break
    return near


def _first_below_zero(row: Sequence[Number], span: Number) -> Number | None:
    """Where a series that begins at or above zero is first below it."""
    before = arb(0)
    for look in range(1, _LOOKS + 1):
        after = (span * look / _LOOKS).mid()
        if _at(row, after) < 0:
            while float(after - before) > 1e-9 * float(span):
                middle = ((before + after) / 2).mid()
                before, after = (before, middle) if _at(row, middle) < 0 else (middle, after)
            return _root(row, after)
        before = after
    return None


def _size(vector: Sequence[Number]) -> Number:
    return (vector[0] ** 2 + vector[1] ** 2).sqrt()


def _angle(vector: Sequence[Number]) -> Number:
    return arb.atan2(vector[1], vector[0]).mid()
