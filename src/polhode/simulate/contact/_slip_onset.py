"""The beginning of slip, at which its direction has no history.

With the slip velocity s = ρ (cos ψ, sin ψ) the equations are ρ̇ = ṡ·ŝ and ρ ψ̇ = ṡ·ŝ', where
ŝ' = dŝ/dψ. They are regular at ρ = 0 if ψ starts where ṡ·ŝ' vanishes, but infinitely stiff there.
They are solved by collocation at Radau's points, which include the end of a step but not its
beginning (Radau IIA: Hairer and Wanner, Solving Ordinary Differential Equations II), so that the
singular point is never evaluated.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache as once
from typing import Any

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray
from threadpoolctl import ThreadpoolController

from polhode.algebra import Expr, Symbol
from polhode.base import NumericError, bisected
from polhode.model import ContactLaw
from polhode.simulate._dynamics import CLOCK, WORK
from polhode.simulate._segment import TrajectoryPiece
from polhode.simulate.contact._auxiliary_states import slip_symbols
from polhode.simulate.contact._hybrid_system import CompiledMode
from polhode.simulate.contact._mode_state import ModeState
from polhode.simulate.contact._onset_directions import rates_along
from polhode.simulate.integrate._arrays import Array, rows
from polhode.simulate.integrate._driver import SegmentSolution
from polhode.simulate.integrate._stop_criteria import Stop

_STAGES = 9  # of the method, which is then of order 2·9 − 1 = 17
_RESOLVED = 1e-14  # last Legendre coefficients of a converged step, relative to the largest
_ROUNDED = 1e-11  # the same, accepted if a shorter step does not reduce them: they are rounding
_TURN = 10.0  # rad: scale of the rounding of angles, which come from differences
_NOISE = 1e-15  # rounding of a slip speed, relative to its largest value within a step
_ENDED = 1e-12  # the same: a slip of this size that no shorter step can resolve has ended
# Where the sign of a slip speed is checked within a step: denser at the beginning, where a slip
# that hardly grows may end again soon.
_PARTS = np.concatenate([np.geomspace(1e-6, 0.02, 30), np.linspace(0.03, 1.0, 98)])
# A slip that ends within the first fifth of a step is resolved again with a step that ends near
# there, but is shortened at most a hundredfold at a time.
_WELL_INSIDE, _CLOSER = 0.2, 0.01
_NEWTON = 12  # iterations; a step that needs more is too long
_SHORTEST = 1e-13  # of the duration and the time: shorter steps have no digits left


def _radau() -> tuple[Array, Array]:
    """Radau's points of [0, 1] with 0 in front, and the differentiation matrix on them.

    By barycentric weights (Berrut and Trefethen, SIAM Review 46, 2004).
    """
    series = np.zeros(_STAGES + 1)
    series[_STAGES], series[_STAGES - 1] = 1.0, -1.0
    points = np.concatenate([[0.0], (np.sort(legendre.legroots(series).real) + 1) / 2])
    points[-1] = 1.0
    gaps = points[:, None] - points[None, :] + np.eye(len(points))
    weights = 1 / np.prod(gaps, axis=1)
    matrix = weights[None, :] / weights[:, None] / gaps
    np.fill_diagonal(matrix, 0.0)
    np.fill_diagonal(matrix, -np.sum(matrix, axis=1))
    return points, matrix


POINTS, SLOPES = _radau()
TO_SERIES = np.linalg.inv(legendre.legvander(2 * POINTS - 1, _STAGES))


@dataclass(frozen=True)
class SlipOnset:
    """A solution, step by step.

    Attributes:
        times: ends of the steps, s.
        series: Legendre coefficients of the states, shape (steps, orders, states).
        end: how far it goes; within the last step if the slip vanishes there, s.
        vanished: which slip vanishes at the end, if one does.
    """

    times: Array
    series: Array
    end: float
    vanished: int | None

    def at(self, times: Array) -> Array:
        """States, shape (states, times)."""
        step = np.clip(np.searchsorted(self.times, times, "right") - 1, 0, len(self.series) - 1)
        left, right = self.times[step], self.times[step + 1]
        place = (2 * times - left - right) / (right - left)
        by_order = np.transpose(self.series[step], (1, 2, 0))  # (orders, states, times)
        return np.asarray(legendre.legval(place[None, :], by_order, tensor=False))


Indices = NDArray[np.intp]
#: Rates of all states, where those of angles are ρ ψ̇: from states (n, m) and times (m,) to (n, m).
Rates = Callable[[Array, Array], Array]


def slip_onset(
    rates: Rates,
    start: Array,
    begin: float,
    end: float,
    acceleration: float,
    explicit_can_go_on: Callable[[float, Array], bool],
    slips: int = 1,
) -> SlipOnset:
    """Integrate from the instant at which slip begins.

    Args:
        start: states, the last of them ρ = 0 and ψ of every slip.
        acceleration: size of the accelerations that cancel in ρ̇, m/s².
        explicit_can_go_on: whether an explicit method can take over, given the time since the
            beginning and the states.
        slips: how many begin.

    Raises:
        NumericError: where the slip has no beginning that could be found.
    """
    with _pools().limit(limits=1):  # on matrices this small, threads only wait for one another
        angles = np.arange(len(start) - 2 * slips + 1, len(start), 2)
        return _integrated(rates, start, begin, end, acceleration, explicit_can_go_on, angles)


@once
def _pools() -> ThreadpoolController:
    """The thread pools of linear algebra; finding them takes a while."""
    return ThreadpoolController()


def _integrated(
    rates: Rates,
    start: Array,
    begin: float,
    end: float,
    acceleration: float,
    explicit_can_go_on: Callable[[float, Array], bool],
    angles: Indices,
) -> SlipOnset:
    now, state = begin, start
    times, series = [begin], list[Array]()
    length, unresolved = min(end - begin, 1e-3), np.inf
    vanished: int | None = None
    shortest = min(_SHORTEST * max(end - begin, abs(begin)), end - begin)
    while now < end and vanished is None:
        length = min(length, end - now)
        step = _step(rates, now, length, state, acceleration, angles)
        if length < shortest and series:
            vanished = _vanished_slip(series, state, angles - 1)
            break
        if length < shortest:
            raise NumericError(
                f"slip that begins at t = {begin:.9g} s cannot be followed",
                expected="a direction in which it grows steadily",
                advice="end the motion before that time, or change the friction coefficient",
            )
        if step is None or not step.is_resolved(unresolved):
            unresolved = np.inf if step is None else step.tail
            length /= 4
            continue
        unresolved = np.inf
        last, which = step.vanishing
        if which is not None and last < _WELL_INSIDE and length > 4 * shortest:
            length *= max(last, _CLOSER)
            continue
        vanished = which
        state = step.end
        times.append(min(now + length, end))
        series.append(step.series)
        now = now + length * last if which is not None else times[-1]
        if explicit_can_go_on(now - begin, state):
            break
        length *= 2
    return SlipOnset(np.array(times), np.array(series), now, vanished)


def _vanished_slip(series: list[Array], state: Array, sizes: Indices) -> int | None:
    """The ρ that has vanished, where no step is short enough to go on; None if none has."""
    largest = np.max([np.max(np.abs(step[:, sizes]), axis=0) for step in series], axis=0)
    left = np.abs(state[sizes]) / largest
    return int(np.argmin(left)) if np.min(left) <= _ENDED else None


@dataclass(frozen=True)
class _Step:
    """Legendre series of all states over one step, the states at its end, and the last terms."""

    series: Array
    end: Array
    tail: float
    sizes: Indices

    def is_resolved(self, before: float) -> bool:
        """Whether the series has converged, or as far as it did over a step four times as long."""
        return self.tail <= _RESOLVED or before / 4 <= self.tail <= _ROUNDED

    @property
    def vanishing(self) -> tuple[float, int | None]:
        """The share of the step after which the first ρ vanishes, and which, if any does."""
        found = [(self._vanishes(row), k) for k, row in enumerate(self.sizes.tolist())]
        parts = [(part, k) for part, k in found if part is not None]
        return min(parts, default=(np.inf, None))

    def _vanishes(self, row: int) -> float | None:
        """The share of the step after which a ρ vanishes, after it has grown from zero."""
        series = self.series[:, row]

        def size(part: float) -> float:
            return float(legendre.legval(2 * part - 1, series))

        noise = _NOISE * float(np.max(np.abs(series)))
        sizes = legendre.legval(2 * _PARTS - 1, series)
        beyond = np.flatnonzero(sizes < -noise)
        if not len(beyond):
            return None
        after = int(beyond[0])
        before = max(_PARTS[:after][sizes[:after] > 0].tolist(), default=0.0)
        return bisected(size, before, float(_PARTS[after]))


_DEPENDENT = 1e-13  # of the largest singular value: smaller ones are rounding


def _step(
    rates: Rates, begin: float, length: float, start: Array, acceleration: float, angles: Indices
) -> _Step | None:
    """One step; None if it is too long for its equations to be solved."""
    # Scales in the tests of convergence: at least what a step may change a slip speed by.
    least = np.full(len(start), acceleration * length)
    least[angles] = _TURN
    times = begin + length * POINTS[1:]
    stages = np.repeat(start[:, None], _STAGES, axis=1)
    stages[angles - 1] = np.maximum(stages[angles - 1], 0.0)
    # Newton's method on all stages together, with a new Jacobian in every iteration, since it
    # changes with ρ from zero on.
    last = np.inf
    for _ in range(_NEWTON):
        residual, slope = _system(rates, times, length, start, stages, angles)
        try:
            change = np.linalg.solve(slope, -residual.ravel()).reshape(stages.shape)
        except np.linalg.LinAlgError:
            # Slips of one rigid body depend on one another: where all are zero, so do the equations
            # for their directions, which then stay as they are as far as possible.
            found = np.linalg.lstsq(slope, -residual.ravel(), rcond=_DEPENDENT)[0]
            change = np.asarray(found, dtype=float).reshape(stages.shape)
        if not np.all(np.isfinite(change)):
            return None
        stages = stages + change
        sizes = np.maximum(least, np.max(np.abs(stages), axis=1))
        size = float(np.max(np.abs(change) / sizes[:, None]))
        # Converged; or at the level of rounding, where changes stop getting smaller.
        if size < 1e-14 or (size < 1e-11 and size >= last):
            break
        last = size
    else:
        return None
    whole = np.hstack([start[:, None], stages])
    coefficients = TO_SERIES @ whole.T
    tails = np.max(np.abs(coefficients[-2:]), axis=0)
    sizes = np.maximum(least, np.max(np.abs(coefficients), axis=0))
    end = np.asarray(stages[:, -1], dtype=float)
    tail = float(np.max(tails / sizes))
    return _Step(np.asarray(coefficients, dtype=float), end, tail, angles - 1)


def _system(
    rates: Rates, times: Array, length: float, start: Array, stages: Array, angles: Indices
) -> tuple[Array, Array]:
    """Residual of the collocation, D·states/length − rates (with ρ D·ψ), and its derivatives.

    The Jacobian comes from complex steps, which lose no digits (Squire and Trapp, SIAM Review 40,
    1998).
    """
    states, count = stages.shape
    whole = np.hstack([start[:, None], stages])
    slopes = whole @ SLOPES[1:].T / length
    leading = np.ones_like(stages)
    leading[angles] = stages[angles - 1]
    tiny = 1e-30
    moved = np.repeat(stages[:, None, :].astype(complex), states, axis=1)
    each = np.arange(states)
    moved[each, each] += 1j * tiny
    found = rates(moved.reshape(states, -1), np.tile(times, states))
    residual = leading * slopes - np.real(found).reshape(moved.shape)[:, 0]
    inner = -np.imag(found).reshape(moved.shape) / tiny
    # ρ ψ̇ depends on ρ directly, too.
    inner[angles, angles - 1] += slopes[angles]
    full = np.zeros((states, count, states, count))
    spread = SLOPES[1:, 1:] / length
    for k in range(states):
        full[k, :, k, :] = leading[k][:, None] * spread
    stage = np.arange(count)
    full[:, stage, :, stage] += np.transpose(inner, (2, 0, 1))
    return residual, full.reshape(states * count, states * count)


# -- the equations, in the speed and direction of each slip ----------------------------------------


@dataclass(frozen=True)
class PolarShape:
    """The rates to be computed while slips begin, and their arguments.

    Attributes:
        starting: the contacts, by their places in the declaration.
        symbols: all other states.
        polars: slip velocities of those contacts, two of each.
        given: of each of them, cosine and sine of the direction of its slip, and its size.
        wanted: rates of the other states, then of the slip velocities.
    """

    starting: tuple[int, ...]
    symbols: tuple[Symbol, ...]
    polars: tuple[Symbol, ...]
    given: tuple[Symbol, ...]
    wanted: tuple[Expr, ...]


def polar_shape(mode: CompiledMode, entry: ModeState, contacts: Sequence[ContactLaw]) -> PolarShape:
    """The rates for a mode in which some contacts begin to slip.

    Args:
        contacts: of the automaton.
    """
    starting = tuple(sorted(entry.onset))
    touching = [contacts[i] for i in starting]
    polars = tuple(symbol for contact in touching for symbol in slip_symbols(contact))
    own = tuple(s for s in mode.dynamics.states if s not in polars and s != WORK)
    rates = dict(zip(mode.dynamics.states, mode.dynamics.rates, strict=True))
    slips = [slip for i in starting for slip in mode.slip_changes[2 * i : 2 * i + 2]]
    turning = [mode.sliding_at(contact) for contact in touching]
    return PolarShape(
        starting,
        (*own, WORK),
        polars,
        tuple(s for e in turning for s in (*e.direction, e.slip_speed)),
        (*(rates[s] for s in own), mode.mode.equations.power, *slips),
    )


# -- the first piece of a motion on which contacts begin to slip -----------------------------------

_BARELY = 1e-150  # m/s, for a slip with a direction but no speed yet: its square does not underflow
# An explicit method takes over once friction would change the slip by no more than so many times
# its present speed over the time since it began: the direction then relaxes slowly enough.
_STIFF = 30.0


def slip_onset_piece(
    mode: CompiledMode,
    entry: ModeState,
    state: Mapping[Symbol, Any],
    span: tuple[float, float],
    contacts: Sequence[ContactLaw],
) -> TrajectoryPiece:
    """The piece on which slip velocities have to be integrated as sizes and directions.

    Args:
        mode: sliding.
        entry: with the directions in which slips begin.
        state: at the beginning.
        span: from when, and until when at most, s.
        contacts: of the automaton.
    """
    shape = polar_shape(mode, entry, contacts)
    starting, symbols, polars = shape.starting, shape.symbols, shape.polars
    arguments = (*symbols, *shape.given, *mode.dynamics.parameters, CLOCK)
    function = mode.dynamics.function(shape.wanted, arguments)
    constants = mode.parameters
    first = len(symbols)

    def polar(states: Array, times: Array) -> Array:
        sizes, psis = states[first::2], states[first + 1 :: 2]
        c, s = np.cos(psis), np.sin(psis)
        directions = np.stack([c, s, sizes], axis=1).reshape(-1, len(times))
        found = function(*states[:first], *directions, *constants, times)
        values: Array = rows(found, len(times), states.dtype)
        along, across = values[first::2].copy(), values[first + 1 :: 2].copy()
        values[first::2] = along * c + across * s
        values[first + 1 :: 2] = across * c - along * s
        return values

    angles = [entry.onset[i] for i in starting]
    start = np.array([*(state[s] for s in symbols), *(x for psi in angles for x in (0.0, psi))])
    accelerations = [_slip_accelerations(mode, entry, i) for i in starting]
    frictions = np.array([friction for friction, _ in accelerations])

    def explicit_can_go_on(elapsed: float, reached: Array) -> bool:
        return bool(np.all(frictions * elapsed < _STIFF * reached[first::2]))

    acceleration = max(acceleration for _, acceleration in accelerations)
    found = slip_onset(polar, start, *span, acceleration, explicit_can_go_on, len(starting))
    all_symbols = (*symbols, *polars)

    def at(times: Array) -> Array:
        values = found.at(times)
        sizes, psis = np.maximum(values[first::2], _BARELY), values[first + 1 :: 2].copy()
        values[first::2], values[first + 1 :: 2] = sizes * np.cos(psis), sizes * np.sin(psis)
        return values

    def rest_at(time: float) -> Array:
        values = dict(zip(all_symbols, at(np.array([time]))[:, 0].tolist(), strict=True))
        return mode.flow.rest(values, constants, time)

    stop, vanished = Stop.PAUSE, None
    if found.vanished is not None:
        stop, vanished = Stop.VANISHED, sorted(entry.slips).index(starting[found.vanished])
    times = np.append(found.times[:-1], found.end)
    solution = SegmentSolution(all_symbols, {}, times, stop, vanished, at, _rest_at=rest_at)
    return TrajectoryPiece(entry.shared.time, found.end, solution, constants)


def _slip_accelerations(mode: CompiledMode, entry: ModeState, i: int) -> tuple[float, float]:
    """Accelerations of a slip by its friction, and by that or by all else if more, m/s²."""
    along, against = rates_along(mode, entry, i, i, np.array([0.0, np.pi])).T
    friction, rest = (float(np.hypot(*change)) / 2 for change in (along - against, along + against))
    return friction, max(friction, rest)
