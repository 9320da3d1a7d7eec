"""A ball on a sheet that is pulled away from under it, over the edge of which it gets on a table.

With u = a ω × ẑ and V the velocity of the surface under the ball, that of the sheet where
x − X(t) < edge and none beyond, the slip s = v − u − V obeys s' = −α ŝ − dV/dt with
α = (1 + 1/k) μ g, and C = v + k u is what no force at the contact changes. At the edge v and u are
continuous, so that s jumps by the change of V. Rolling is followed by quadrature; slip as log |s|
and an angle over τ, dt = |s| dτ/α, in which its end is regular.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from scipy.integrate import DOP853, solve_ivp
from scipy.optimize import brentq

from .ball_on_paper import Ball, Stretch
from .parts import Array

_RTOL, _ATOL = 1e-13, 1e-15
_GONE = 1e-17  # m/s, a slip that has ended
_NONE = 1e-12  # of a velocity, over what it is the difference of
_LOOKS = 100  # per second of rolling
_CROSS = np.array([[0.0, -1.0], [1.0, 0.0]])
_THIN = 1e-14  # m, a distance beyond the edge that is rounding
_MOST = 2000  # changes, after which the ball is said to ride along the edge


class RidesTheEdgeError(Exception):
    """Friction on either side brings the ball back to the edge, ever more often."""


@dataclass
class Course:
    """What the ball did.

    `modes` lists the mode at first and every later one with its instant; `nearest_limit` is how
    near the acceleration of the sheet came to the limit of friction without passing it, or when
    passing it; `slowest` the least speed at which the edge was crossed.
    """

    modes: list[tuple[float, str]] = field(default_factory=list)
    crossings: list[float] = field(default_factory=list)
    places: list[Array] = field(default_factory=list)
    velocities: list[Array] = field(default_factory=list)
    nearest_limit: float = np.inf
    slowest: float = np.inf


def follow(
    ball: Ball,
    sheet: Sequence[Stretch],
    edge: float,
    place: Array,
    velocity: Array,
    times: Array,
) -> Course:
    """From rolling, with a velocity at t = 0, to the last time.

    Raises:
        RidesTheEdgeError: where it crosses the edge to and fro without end.
    """
    walk = _Walk(ball, sheet, edge, np.array(place, dtype=float), np.array(velocity, dtype=float))
    for time in times:
        walk.to(float(time))
        walk.note()
    return walk.course


class _Walk:
    def __init__(
        self, ball: Ball, sheet: Sequence[Stretch], edge: float, place: Array, velocity: Array
    ) -> None:
        self.ball, self.sheet, self.edge = ball, list(sheet), edge
        self.now, self.place, self.part = 0.0, place, 0
        while self.part + 1 < len(self.sheet) and self.sheet[self.part + 1].begin <= 0.0:
            self.part += 1
        self.course = Course()
        self.slip: Array | None = None
        self.away = edge - (place[0] - self.table()[0, 0]) <= 0
        self.kept = velocity * (1 + ball.k) - ball.k * self.below(0.0, place)
        self.tell()
        self.settle()

    # -- what is below --------------------------------------------------------------------------

    def table(self, t: float | None = None) -> Array:
        """Place, rate and second rate of the sheet."""
        return self.sheet[self.part].moves(self.now if t is None else t)

    def below(self, t: float, place: Array) -> Array:
        """Velocity of the surface that the ball touches."""
        if self.away:
            return np.zeros(2)
        table = self.table(t)
        return table[1, :2] + table[1, 2] * (_CROSS @ (place - table[0, :2]))

    def drag(self, t: float, place: Array, v: Array) -> Array:
        """Rate of that along the way of the ball."""
        if self.away:
            return np.zeros(2)
        table = self.table(t)
        arm = _CROSS @ (place - table[0, :2])
        return table[2, :2] + table[2, 2] * arm + table[1, 2] * (_CROSS @ (v - table[1, :2]))

    def velocity(self, t: float, place: Array, slip: Array) -> Array:
        k = self.ball.k
        return (self.kept + k * (slip + self.below(t, place))) / (1 + k)

    def room(self, t: float, x: float) -> float:
        """Distance from the edge, on the side where the ball is."""
        reserve = float(self.edge - x + self.table(t)[0, 0])
        return -reserve if self.away else reserve

    def leaving(self, t: float, v_x: float) -> float:
        """Rate of that."""
        rate = float(self.table(t)[1, 0] - v_x)
        return -rate if self.away else rate

    # -- going on -------------------------------------------------------------------------------

    def to(self, time: float) -> None:
        while self.now < time:
            last = self.part + 1 == len(self.sheet)
            until = np.inf if last else self.sheet[self.part + 1].begin
            goal = min(time, until)
            if self.slip is None:
                self.roll(goal)
            else:
                self.slide(goal)
            if self.now == until:
                self.knot()

    def note(self) -> None:
        slip = np.zeros(2) if self.slip is None else self.slip
        self.course.places.append(self.place.copy())
        self.course.velocities.append(self.velocity(self.now, self.place, slip))

    def tell(self) -> None:
        name = "rolling" if self.slip is None else "sliding"
        name = f"{name} on the table" if self.away else name
        if not self.course.modes or self.course.modes[-1][1] != name:
            self.course.modes.append((self.now, name))

    def knot(self) -> None:
        """The sheet moves differently from here on; it may have been shifted."""
        before = self.below(self.now, self.place)
        self.part += 1
        v = self.velocity_from(before)
        room = self.room(self.now, self.place[0])
        if room < -1e-13 or (abs(room) <= 1e-13 and self.leaving(self.now, v[0]) < 0):
            self.away = not self.away
        self.changed(before)

    def velocity_from(self, below: Array) -> Array:
        slip = np.zeros(2) if self.slip is None else self.slip
        return (self.kept + self.ball.k * (slip + below)) / (1 + self.ball.k)

    def cross(self) -> None:
        before = self.below(self.now, self.place)
        speed = abs(self.leaving(self.now, self.velocity_from(before)[0]))
        self.course.slowest = min(self.course.slowest, speed)
        self.course.crossings.append(self.now)
        if len(self.course.crossings) > _MOST:
            raise RidesTheEdgeError(f"t = {self.now}")
        self.away = not self.away
        self.changed(before)

    def changed(self, before: Array) -> None:
        """The velocity below the ball was something else before."""
        after = self.below(self.now, self.place)
        slip = (np.zeros(2) if self.slip is None else self.slip) + before - after
        size = float(np.hypot(*before) + np.hypot(*after)) + float(np.hypot(*self.kept))
        kept = self.slip is not None and np.array_equal(before, after)
        self.slip = slip if kept or np.hypot(*slip) > _NONE * size else None
        self.tell()
        if self.slip is None:
            self.settle()

    def settle(self) -> None:
        """It sticks if it can; else slip begins."""
        v = self.velocity(self.now, self.place, np.zeros(2))
        drag = float(np.hypot(*self.drag(self.now, self.place, v)))
        self.course.nearest_limit = min(self.course.nearest_limit, abs(drag / self.ball.limit - 1))
        if drag > self.ball.limit:
            self.begin()

    def begin(self) -> None:
        """A little after slip has begun, or to where the edge is crossed before."""
        step, started = 1e-7, self.now

        def room(after: float) -> float:
            return self.room(started + after, self.first_slip(after)[0][0])

        while room(step) > -_THIN and step <= 1e-2:
            if self.ball.alpha * step <= 3000 * np.hypot(*self.first_slip(step)[1]):
                break
            step *= 2
        crosses = room(step) <= -_THIN
        if crosses:
            step = float(brentq(room, 0.0, step, xtol=1e-20)) if room(0.0) > 0 else 0.0
        self.place, self.slip = self.first_slip(step)
        self.tell()
        self.now = started + step
        if crosses:
            self.cross()

    def first_slip(self, after: float) -> tuple[Array, Array]:
        """Place and slip soon after slip has begun, by their first terms."""
        t, k, alpha = self.now, self.ball.k, self.ball.alpha
        if not after:
            return self.place, np.zeros(2)

        def rates(time: float, y: Array) -> Array:
            v = self.velocity(time, y[:2], np.zeros(2))
            away = self.drag(time, y[:2], v)
            return np.array([*v, np.hypot(*away) - alpha, y[2]])

        span, start = (t, t + after), np.array([*self.place, 0.0, 0.0])
        found = solve_ivp(rates, span, start, method="DOP853", rtol=_RTOL, atol=1e-20).y[:, -1]

        def angle(time: float) -> float:
            v = self.velocity(time, found[:2], np.zeros(2))
            x, y = self.drag(time, found[:2], v)
            return float(np.arctan2(-y, -x))

        tiny = min(1e-6, after / 4)
        turn = np.sin(angle(t + after + tiny) - angle(t + after - tiny)) / (2 * tiny)
        v = self.velocity(t + after, found[:2], np.zeros(2))
        gain = float(np.hypot(*self.drag(t + after, found[:2], v))) - alpha
        psi = angle(t + after) - found[2] * turn / (2 * gain + alpha)
        along = np.array([np.cos(psi), np.sin(psi)])
        return found[:2] + k / (1 + k) * found[3] * along, found[2] * along

    # -- rolling --------------------------------------------------------------------------------

    def roll(self, goal: float) -> None:
        begin, none, rolled = self.now, np.zeros(2), self._rolled(goal)

        def leaving(t: float) -> float:
            return self.leaving(t, self.velocity(t, rolled(t), none)[0])

        def room(t: float) -> float:
            return self.room(t, rolled(t)[0])

        def grip(t: float) -> float:
            here = rolled(t)
            drag = self.drag(t, here, self.velocity(t, here, none))
            return 1 - float(np.hypot(*drag)) / self.ball.limit

        grid = np.linspace(begin, goal, max(7, round(_LOOKS * (goal - begin))))
        slips = None if self.away else self._slips(grip, grid)
        crossed = _first_fall(room, leaving, grid, fresh=begin)
        ends = [t for t in (slips, crossed) if t is not None]
        self.now = min(ends, default=goal)
        self.place = rolled(self.now)
        if crossed is not None and self.now == crossed:
            self.cross()
        elif slips is not None:
            self.begin()

    def _rolled(self, goal: float) -> Callable[[float], Array]:
        """Places up to the goal, rolling."""
        begin, place, k, none = self.now, self.place, self.ball.k, np.zeros(2)
        if self.away:
            v = self.velocity(begin, place, none)
            return lambda t: place + v * (t - begin)
        if not any(self.table(t)[1, 2] for t in np.linspace(begin, goal, 5)[1:-1]):
            first = self.table(begin)[0, :2]
            return lambda t: (
                place + (self.kept * (t - begin) + k * (self.table(t)[0, :2] - first)) / (1 + k)
            )
        dense = solve_ivp(
            lambda t, y: self.velocity(t, y, none),
            (begin, goal),
            place,
            method="DOP853",
            rtol=_RTOL,
            atol=_ATOL,
            max_step=0.01,
            dense_output=True,
        ).sol
        return lambda t: np.asarray(dense(t))

    def _slips(self, grip: Callable[[float], float], grid: Array) -> float | None:
        values = np.array([grip(t) for t in grid])
        low = min(range(len(grid)), key=lambda i: values[i])
        self.course.nearest_limit = min(self.course.nearest_limit, abs(float(values[low])))
        for i in range(1, len(grid)):
            if (values[i] < 0 and i + 1 < len(grid)) or values[i] < -1e-15:
                a = grid[i - 1] if values[i - 1] > 0 else grid[i - 1] + 1e-9 * (grid[1] - grid[0])
                return float(brentq(grip, a, grid[i], xtol=1e-16, rtol=1e-15)) if grip(a) > 0 else a
        return None

    # -- sliding --------------------------------------------------------------------------------

    def slide(self, goal: float) -> None:
        """To the goal, the edge, or the end of the slip; state: log |s|, angle, place, time."""
        assert self.slip is not None
        alpha = self.ball.alpha

        def rates(_: float, y: Array) -> Array:
            size, c, s = np.exp(y[0]), np.cos(y[1]), np.sin(y[1])
            v = self.velocity(y[4], y[2:4], size * np.array([c, s]))
            ax, ay = self.drag(y[4], y[2:4], v)
            turn = (ax * s - ay * c) / alpha
            return np.array(
                [-1 - (ax * c + ay * s) / alpha, turn, *(v * size / alpha), size / alpha]
            )

        size = float(np.hypot(*self.slip))
        psi = float(np.arctan2(self.slip[1], self.slip[0]))
        state = np.array([np.log(size), psi, *self.place, self.now])
        solver = DOP853(rates, 0.0, state, np.inf, rtol=_RTOL, atol=_ATOL, first_step=1e-4)
        fresh = True
        while True:
            tau, before = solver.t, solver.y.copy()
            solver.step()
            if solver.status == "failed":
                raise RuntimeError(f"the slip is lost at t = {before[4]}")
            sol = _Exact(rates, tau, before, solver.dense_output())
            last = solver.t
            if solver.y[4] >= goal:
                last = _root(lambda x, sol=sol: sol.rough(x)[4] - goal, tau, solver.t)
                last = sol.polished(last, lambda y: y[4] - goal, lambda y: np.exp(y[0]) / alpha)
            crossed = self._crossed(sol, np.linspace(tau, last, 9), fresh)
            if crossed is not None:
                self._arrive(sol.at(crossed))
                self.cross()
                return
            fresh = False
            if solver.y[4] >= goal:
                self._arrive(sol.at(last))
                self.now = goal
                return
            if solver.y[0] < np.log(_GONE):
                self._arrive(solver.y)
                self.slip = None
                self.tell()
                self.settle()
                return

    def _crossed(self, sol: _Exact, grid: Array, fresh: bool) -> float | None:
        def room(y: Array) -> float:
            return self.room(y[4], y[2])

        def leaving(y: Array) -> float:
            slip = np.exp(y[0]) * np.array([np.cos(y[1]), np.sin(y[1])])
            return self.leaving(y[4], self.velocity(y[4], y[2:4], slip)[0])

        found = _first_fall(
            lambda x: room(sol.rough(x)),
            lambda x: leaving(sol.rough(x)),
            grid,
            fresh=grid[0] if fresh else None,
        )
        if found is None or found == grid[0]:
            return found
        return sol.polished(found, room, lambda y: leaving(y) * np.exp(y[0]) / self.ball.alpha)

    def _arrive(self, y: Array) -> None:
        self.slip = np.exp(y[0]) * np.array([np.cos(y[1]), np.sin(y[1])])
        self.place, self.now = y[2:4].copy(), float(y[4])


@dataclass(frozen=True)
class _Exact:
    """A step: roughly by its dense output, and by another integration to rounding."""

    rates: Callable[[float, Array], Array]
    begin: float
    state: Array
    rough: Callable[[float], Array]

    def at(self, tau: float) -> Array:
        if tau <= self.begin:
            return self.state
        span = (self.begin, tau)
        return solve_ivp(self.rates, span, self.state, method="DOP853", rtol=_RTOL, atol=_ATOL).y[
            :, -1
        ]

    def polished(
        self, near: float, value: Callable[[Array], float], slope: Callable[[Array], float]
    ) -> float:
        """Newton's method."""
        for _ in range(4):
            y = self.at(near)
            rate = slope(y)
            change = value(y) / rate if rate else 0.0
            if not abs(change) < 1e-3:
                break
            near = max(near - change, self.begin)
        return near


def _first_fall(
    value: Callable[[float], float],
    slope: Callable[[float], float],
    grid: Array,
    fresh: float | None,
) -> float | None:
    """Where a function falls through zero, which at the fresh beginning is zero itself."""
    nodes = list(_monotonic(slope, grid))
    for a, b in pairwise(nodes):
        low = value(b)
        if low > -_THIN:
            continue
        if a == fresh:
            if slope(a + 0.5 * (b - a)) < 0:  # falls from the beginning on
                return a if value(a) <= 1e-14 else _root(value, a, b)
            continue
        return _root(value, a, b)
    return None


def _monotonic(slope: Callable[[float], float], grid: Array) -> Iterator[float]:
    """The grid with the points at which the slope changes its sign."""
    slopes = [slope(t) for t in grid]
    yield grid[0]
    for (a, b), (u, v) in zip(pairwise(grid), pairwise(slopes), strict=True):
        if u * v < 0:
            yield float(brentq(slope, a, b, xtol=1e-17, rtol=1e-15))
        yield b


def _root(value: Callable[[float], float], a: float, b: float) -> float:
    first, last = value(a), value(b)
    if first == 0 or first * last > 0:
        return a if abs(first) < abs(last) else b
    return float(brentq(value, a, b, xtol=1e-17, rtol=1e-15))
