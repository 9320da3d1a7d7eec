"""A ball on a moved sheet of paper, followed in slip variables by switches of its own.

With u = a ω × ẑ, V the velocity of the sheet under the ball and s = v − u − V the slip,
s' = −α ŝ − dV/dt, α = (1 + 1/k) μ g, and C = v + k u stays as it was. So v and the place follow
from s. The slip is carried as log |s| and angle over the time τ with dt = |s| dτ/α, in which
both its end and its beginning are regular.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.polynomial import Polynomial
from scipy.integrate import DOP853, solve_ivp
from scipy.optimize import brentq, minimize_scalar

from .parts import Array

#: X, Y, angle of the sheet in the columns; value, rate and second rate in the rows.
Moves = Callable[[float], Array]

_RTOL, _ATOL = 1e-13, 1e-15
_GONE = 1e-17  # m/s, a slip that has ended
_LOOKS = 80  # per second of rolling
_CROSS = np.array([[0.0, -1.0], [1.0, 0.0]])


@dataclass(frozen=True)
class Stretch:
    """A smooth part of the sheet's motion, from one instant to another."""

    begin: float
    end: float
    moves: Moves


def at_rest(begin: float, end: float, place: Sequence[float] = (0.0, 0.0, 0.0)) -> Stretch:
    table = np.zeros((3, 3))
    table[0] = place
    return Stretch(begin, end, lambda _: table)


def bumps(heights: Array, middles: Array, widths: Array, end: float) -> list[Stretch]:
    """Sums of bumps h exp(−((t − c)/w)²), shape (3, bumps) for X, Y and the angle."""

    def moves(t: float) -> Array:
        z = (t - middles) / widths
        bell = heights * np.where(np.abs(z) < 7, np.exp(-z * z), 0.0)  # beyond it is rounding
        slopes = -2 * z / widths * bell
        bends = (4 * z * z - 2) / widths**2 * bell
        return np.array([bell.sum(axis=1), slopes.sum(axis=1), bends.sum(axis=1)])

    return [Stretch(0.0, end, moves)]


def polynomials(knots: Array, tables: Sequence[Array], end: float) -> list[Stretch]:
    """Polynomials between knots, the tables of X, Y and angle in rising powers; else at rest."""
    first = [float(table[0, 0]) for table in tables]
    found = [at_rest(0.0, float(knots[0]), first)] if knots[0] > 0 else []
    for i, (begin, stop) in enumerate(pairwise(knots.tolist())):
        parts = [Polynomial(table[i]) for table in tables]
        powers = max(len(table[i]) for table in tables)
        series = np.zeros((powers, 3, 3))
        for order in range(3):
            for j, part in enumerate(parts):
                own = part.deriv(order).coef if order else part.coef
                series[: len(own), order, j] = own

        def moves(t: float, series: Array = series[::-1], begin: float = begin) -> Array:
            total, since = series[0], t - begin
            for term in series[1:]:
                total = total * since + term
            return total

        found.append(Stretch(begin, stop, moves))
    last = found[-1].moves(float(knots[-1]))[0]
    return [*found, at_rest(float(knots[-1]), end, last)]


@dataclass
class Course:
    """What the ball did: its switches, and where it was and how fast at the instants asked for."""

    switches: list[tuple[float, str]] = field(default_factory=list)
    places: list[Array] = field(default_factory=list)
    velocities: list[Array] = field(default_factory=list)
    slips: list[Array] = field(default_factory=list)
    nearest_limit: float = np.inf


@dataclass(frozen=True)
class Ball:
    """k = I/(m a²), kinetic and static friction, g."""

    k: float
    mu: float
    mu_static: float
    g: float = 9.81

    @property
    def alpha(self) -> float:
        return (1 + 1 / self.k) * self.mu * self.g

    @property
    def limit(self) -> float:
        return (1 + 1 / self.k) * self.mu_static * self.g


def follow(
    ball: Ball,
    sheet: Sequence[Stretch],
    place: Array,
    velocity: Array,
    times: Array,
    slip: Array | None = None,
) -> Course:
    """From a velocity of the ball at t = 0, with a given slip or rolling, to the last time."""
    walk = _Walk(ball, sheet, np.array(place, dtype=float), np.array(velocity, dtype=float), slip)
    for time in times:
        walk.to(float(time))
        walk.note()
    return walk.course


class _Walk:
    def __init__(
        self,
        ball: Ball,
        sheet: Sequence[Stretch],
        place: Array,
        velocity: Array,
        slip: Array | None,
    ) -> None:
        self.ball, self.sheet = ball, list(sheet)
        self.begins = [stretch.begin for stretch in self.sheet]
        self.now, self.place = 0.0, place
        self.moves = self.sheet[0].moves
        below = self.support(0.0, place)
        s = np.zeros(2) if slip is None else np.array(slip, dtype=float)
        self.kept = velocity * (1 + ball.k) - ball.k * (below + s)
        self.slip: Array | None = s if np.hypot(*s) > 0 else None
        self.course = Course()
        if self.slip is None:
            self._settle()

    # -- kinematics -----------------------------------------------------------------------------

    def support(self, t: float, place: Array) -> Array:
        table = self.moves(t)
        return table[1, :2] + table[1, 2] * (_CROSS @ (place - table[0, :2]))

    def velocity(self, t: float, place: Array, slip: Array) -> Array:
        k = self.ball.k
        return (self.kept + k * (slip + self.support(t, place))) / (1 + k)

    def drag(self, t: float, place: Array, slip: Array) -> Array:
        """dV/dt, along the way of the ball."""
        table = self.moves(t)
        k = self.ball.k
        arm = _CROSS @ (place - table[0, :2])
        below = table[1, :2] + table[1, 2] * arm
        v = (self.kept + k * (slip + below)) / (1 + k)
        turned = _CROSS @ (v - table[1, :2])
        return table[2, :2] + table[2, 2] * arm + table[1, 2] * turned

    # -- going on -------------------------------------------------------------------------------

    def to(self, time: float) -> None:
        while self.now < time:
            i = min(bisect_right(self.begins, self.now) - 1, len(self.sheet) - 1)
            goal = min(time, self.begins[i + 1]) if i + 1 < len(self.begins) else time
            if self.slip is None:
                self._roll(goal)
            else:
                self._slide(goal)
            if self.now == goal and i + 1 < len(self.begins) and goal == self.begins[i + 1]:
                self._enter(self.sheet[i + 1])

    def note(self) -> None:
        slip = np.zeros(2) if self.slip is None else self.slip
        self.course.places.append(self.place.copy())
        self.course.velocities.append(self.velocity(self.now, self.place, slip))
        self.course.slips.append(slip.copy())

    def _enter(self, stretch: Stretch) -> None:
        before = self.support(self.now, self.place)
        rates = np.abs(self.moves(self.now)[1])
        self.moves = stretch.moves
        jump = self.support(self.now, self.place) - before
        rates = rates + np.abs(self.moves(self.now)[1])
        size = float(rates[:2].max() + rates[2] * (1 + np.hypot(*self.place)))
        if np.hypot(*jump) <= 1e-12 * size:
            if self.slip is None:
                self._settle()
            return
        slip = (np.zeros(2) if self.slip is None else self.slip) - jump
        if self.slip is None:
            self.course.switches.append((self.now, "slips"))
        self.slip = slip

    def _settle(self) -> None:
        """Sticks if it can; else slip begins."""
        drag = float(np.hypot(*self.drag(self.now, self.place, np.zeros(2))))
        self.course.nearest_limit = min(self.course.nearest_limit, abs(drag / self.ball.limit - 1))
        if drag > self.ball.limit:
            self._begin()

    def _begin(self) -> None:
        """A little after slip has begun, by its series."""
        t, k, alpha = self.now, self.ball.k, self.ball.alpha

        def drag(time: float, place: Array) -> Array:
            return self.drag(time, place, np.zeros(2))

        def rates(time: float, y: Array) -> Array:
            away = drag(time, y[:2])
            v = (self.kept + k * self.support(time, y[:2])) / (1 + k)
            return np.array([*v, np.hypot(*away) - alpha, y[2]])

        step, start = 1e-7, np.array([*self.place, 0.0, 0.0])
        while True:
            found = solve_ivp(
                rates, (t, t + step), start, method="DOP853", rtol=_RTOL, atol=1e-20
            ).y[:, -1]
            away = drag(t + step, found[:2])
            if alpha * step <= 3000 * found[2] or step > 1e-2:
                break
            step *= 2
        gain, size = float(np.hypot(*away)) - alpha, float(found[2])
        tiny = min(1e-6, step / 4)
        later, sooner = drag(t + step + tiny, found[:2]), drag(t + step - tiny, found[:2])
        turn = (np.arctan2(later[1], later[0]) - np.arctan2(sooner[1], sooner[0])) / (2 * tiny)
        lag = -size * turn / (gain + alpha + gain)
        psi = np.arctan2(-away[1], -away[0]) + lag
        along = np.array([np.cos(psi), np.sin(psi)])
        # the place is that of rolling, and k/(1 + k) of the way slipped besides
        self.place = found[:2] + k / (1 + k) * found[3] * along
        self.slip = size * along
        self.course.switches.append((t, "slips"))
        self.now = t + step

    # -- rolling --------------------------------------------------------------------------------

    def _rolled(self, begin: float, place: Array, end: float) -> Array:
        if end == begin:
            return place
        k = self.ball.k
        first, last = self.moves(begin), self.moves(end)
        turning = any(self.moves(t)[1, 2] for t in (begin, (begin + end) / 2, end))
        if not turning:
            path = last[0, :2] - first[0, :2]
            return place + (self.kept * (end - begin) + k * path) / (1 + k)

        def rates(t: float, y: Array) -> Array:
            return (self.kept + k * self.support(t, y)) / (1 + k)

        return solve_ivp(rates, (begin, end), place, method="DOP853", rtol=_RTOL, atol=_ATOL).y[
            :, -1
        ]

    def _roll(self, goal: float) -> None:
        ends = (self.now, goal, (self.now + goal) / 2, 0.3 * self.now + 0.7 * goal)
        if not any(self.moves(t)[1:].any() for t in ends):
            self.place = self._rolled(self.now, self.place, goal)
            self.now = goal
            return
        looks = max(6, round(_LOOKS * (goal - self.now)))
        grid = np.linspace(self.now, goal, looks)
        places = [self.place]
        for a, b in pairwise(grid):
            places.append(self._rolled(a, places[-1], b))

        def reserve(t: float) -> float:
            i = max(int(np.searchsorted(grid, t, "right")) - 1, 0)
            place = self._rolled(grid[i], places[i], t)
            return 1 - float(np.hypot(*self.drag(t, place, np.zeros(2)))) / self.ball.limit

        values = np.array([reserve(t) for t in grid])
        for i in range(len(grid) - 1):
            before, after = grid[i], grid[i + 1]
            if i + 2 < len(grid) and values[i + 1] < min(values[i], values[i + 2]):
                low = minimize_scalar(
                    reserve,
                    bounds=(grid[i], grid[i + 2]),
                    method="bounded",
                    options={"xatol": 1e-12},
                )
                self.course.nearest_limit = min(self.course.nearest_limit, abs(low.fun))
                if low.fun < 0 and (low.x < after or values[i + 1] > 0):
                    after = low.x
            if reserve(after) < 0 and (i > 0 or values[0] > 0 or self.course.switches):
                begin = before if reserve(before) > 0 else before + 1e-9 * (after - before)
                time = brentq(reserve, begin, after, xtol=1e-16, rtol=1e-15)
                j = int(np.searchsorted(grid, time, "right")) - 1
                self.place = self._rolled(grid[j], places[j], time)
                self.now = time
                self._begin()
                return
        self.now, self.place = goal, places[-1]

    # -- sliding --------------------------------------------------------------------------------

    def _slide(self, goal: float) -> None:
        """To the goal, or to the end of the slip; state: log |s|, its angle, place, time."""
        assert self.slip is not None
        alpha = self.ball.alpha

        def rates(_: float, y: Array) -> Array:
            size, c, s = np.exp(y[0]), np.cos(y[1]), np.sin(y[1])
            slip = size * np.array([c, s])
            ax, ay = self.drag(y[4], y[2:4], slip)
            v = self.velocity(y[4], y[2:4], slip)
            return np.array(
                [-1 - (ax * c + ay * s) / alpha, (ax * s - ay * c) / alpha, *(v * size / alpha),
                 size / alpha]
            )  # fmt: skip

        def in_time(t: float, y: Array) -> Array:
            return rates(t, np.array([*y[:4], t]))[:4] * alpha / np.exp(y[0])

        size = float(np.hypot(*self.slip))
        psi = float(np.arctan2(self.slip[1], self.slip[0]))
        state = np.array([np.log(size), psi, *self.place, self.now])
        solver = DOP853(rates, 0.0, state, np.inf, rtol=_RTOL, atol=_ATOL, first_step=1e-4)
        before = state
        while True:
            solver.step()
            if solver.status == "failed":
                raise RuntimeError(f"the slip is lost at t = {before[4]}")
            if solver.y[4] >= goal or solver.y[0] < np.log(_GONE):
                break
            before = solver.y.copy()
        if solver.y[4] >= goal:
            if goal > before[4]:
                end = solve_ivp(
                    in_time, (before[4], goal), before[:4], method="DOP853", rtol=_RTOL, atol=_ATOL
                ).y[:, -1]
            else:
                end = before[:4]
            self.slip = np.exp(end[0]) * np.array([np.cos(end[1]), np.sin(end[1])])
            self.place, self.now = end[2:], goal
            return
        self.place, self.now = solver.y[2:4].copy(), float(solver.y[4])
        self.slip = None
        self.course.switches.append((self.now, "sticks"))
        self._settle()
