"""Sampled motions, and relations along them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import TypeAlias
from warnings import catch_warnings, simplefilter

import numpy as np

from polhode.algebra import ZERO, Expr, Symbol, as_symbol, time
from polhode.base import ByIdentity, DriftWarning, PolhodeError
from polhode.derive import Equations
from polhode.judge.meaning._relations import ScalarRelation
from polhode.judge.states._bound_claim import SENSE, BoundClaim
from polhode.judge.states._claim_domain import TrueMotion
from polhode.judge.states._numeric import Array, number
from polhode.judge.states._sample_points import real_states
from polhode.simulate import Trajectory, simulate

Name: TypeAlias = str | Symbol | Expr
Numbers: TypeAlias = tuple[tuple[Symbol, float], ...]

TIME = as_symbol(time)

_SAMPLES = 400
_CLOSE = 1e-6  # relative; well above the error of the integration
_ROUNDING = 1e-11  # of terms that cancel
_SETTLED = 1e-3  # relative tolerance for "finally": a final state is only approached
_LASTING = _SAMPLES // 20  # consecutive samples for which a relation has to stay settled
_NARROWED = 8  # times that the interval of an event is narrowed
_PARTS = 64  # samples of such an interval
_KEPT = 48  # motions


@dataclass(frozen=True, eq=False)
class SampledMotion:
    """One motion from a start.

    Attributes:
        run: the motion.
        start: value of every symbol at the start, SI.
        begin: time at the start, as the text counts it, s.
        times: sample times, counted from the start, s.
    """

    run: Trajectory
    start: Mapping[Symbol, float]
    begin: float
    times: Array

    def at(self, event: Mapping[Symbol, Expr]) -> SampledMotion | None:
        """The motion at the instant of an event, or the whole motion if there is no event.

        An event is a quantity that first reaches a value. None if that does not happen.
        """
        for symbol, value in event.items():
            instant = self._first_at(symbol, float(number(value, self.start)))
            return None if instant is None else replace(self, times=instant)
        return self

    def _first_at(self, symbol: Symbol, level: float) -> Array | None:
        """The time at which a quantity first reaches a value, by refining the bracketing interval.

        Each pass narrows it by a factor of 63, so that eight of them reach rounding.
        """
        times = self.times
        for _ in range(_NARROWED):
            away = self.run.evaluate(symbol, times) - level
            crossed = np.flatnonzero(np.diff(np.sign(away)))
            if not len(crossed):
                return None
            first = int(crossed[0])
            times = np.linspace(times[first], times[first + 1], _PARTS)
        return times[:1]

    def state(self, part: float) -> dict[Symbol, float]:
        """The value of every symbol after this fraction of the motion, SI."""
        instant = self.times[-1:] * part
        found = replace(self, times=instant).states
        return {s: float(np.ravel(values)[0]) for s, values in found.items()}

    @cached_property
    def states(self) -> dict[Symbol, Array | float]:
        """The value of every symbol at the sample times, SI."""
        equations = self.run.equations
        varying = (*equations.coordinates, *equations.speeds)
        found = {s: self.run.evaluate(s, self.times) for s in varying}
        return {**self.start, **found, TIME: self.times + self.begin}


def sampled_motions(
    states: TrueMotion, used: list[Expr], clock: Symbol | None, duration: float
) -> Iterator[SampledMotion]:
    """Motions from starts in a domain, with different parameters.

    Args:
        states: the starts.
        used: expressions that have to be real at the start.
        clock: the letter of the text for the time at the start; None if that is zero.
        duration: of the motions, s.
    """
    equations = states.equations
    state = (*equations.coordinates, *equations.speeds)
    letters = {s for e in used for s in e.symbols()} - {TIME}
    for count, start in enumerate(real_states(states, used)):
        if count % 2:
            start.update(_turned(start, states))
        # `SymbolValues` finds a value on first use: look up also letters that occur only later.
        start.update({s: start[s] for s in letters})
        first = tuple((s, start[s]) for s in state)
        parameters = tuple((s, start[s]) for s in equations.parameters)
        try:
            run = _simulated(ByIdentity(equations), parameters, first, duration)
        except PolhodeError:
            continue
        begin = 0.0 if clock is None else start[clock]
        yield SampledMotion(run, start, begin, np.linspace(0.0, duration, _SAMPLES))


def _turned(start: Mapping[Symbol, float], states: TrueMotion) -> dict[Symbol, float]:
    """The coordinates on which nothing depends, with the other sign.

    Where such an azimuth is not given, a claim about its sign is false.
    """
    equations = states.equations
    rows = (*equations.mass.rows, equations.forcing)
    used = [e for row in rows for e in row] + [*states.settled_relations, *states.signs]
    fixed = {*states.given, *(s for e in used for s in e.symbols())}
    return {s: -start[s] for s in equations.coordinates if s not in fixed}


@lru_cache(maxsize=_KEPT)
def _simulated(
    key: ByIdentity[Equations], parameters: Numbers, first: Numbers, duration: float
) -> Trajectory:
    """One motion, kept because corrections of a claim are tried on the same motions."""
    given: dict[Name, float] = dict(parameters)
    start: dict[Name, float] = dict(first)
    with catch_warnings():
        # Of bodies that pass through each other: the start was drawn here, and is nobody's motion.
        simplefilter("ignore", DriftWarning)
        return simulate(key.subject, given, start, duration)


def _size(side: Expr, motion: SampledMotion) -> float:
    """The largest value that a term of a side has along a motion."""
    below = number(side.denominator, motion.states)
    terms = (number(term, motion.states) / below for term in side.summands())
    return float(max((np.abs(term).max() for term in terms), default=0.0))


@dataclass(frozen=True, eq=False)
class SampledRelation:
    """One scalar relation along a motion.

    Attributes:
        motion: the motion.
        component: the relation.
        sign: its sign.
        sides: values of both sides at the sample times.
        rounding: half a unit of the last digit of printed decimal numbers, and what is lost where
            terms cancel, as in p_x = 0 of a motion from rest.
    """

    motion: SampledMotion
    component: ScalarRelation
    sign: str
    sides: tuple[Array, Array]
    rounding: Array

    @classmethod
    def along(
        cls,
        motion: SampledMotion,
        component: ScalarRelation,
        claim: BoundClaim,
        states: TrueMotion,
    ) -> SampledRelation:
        """The relation, with the accelerations and reactions of the motion."""
        half = claim.digits.get(component.member, ZERO)
        left_right = [states.on(side) for side in (component.left, component.right)]
        values = (
            np.asarray(number(side, motion.states), float)
            for side in (*left_right, states.on(half))
        )
        left, right, printed = (np.broadcast_to(v, motion.times.shape) for v in values)
        sign = claim.members[component.member].sign
        rounding = _ROUNDING * max(_size(side, motion) for side in left_right)
        return cls(motion, component, sign, (left, right), np.abs(printed) + rounding)

    def exception(self, when: str) -> int | None:
        """A sample that refutes the relation, claimed always, never and so on; None without one."""
        match when:
            case "never":
                wrong = self._met(_CLOSE)
            case "sometimes":
                return None if self._met(_CLOSE).any() else 0
            case "finally":
                return None if self._settles else len(self.motion.times) - 1
            case _:
                wrong = np.logical_not(self._met(-_CLOSE))
        return int(np.argmax(wrong)) if wrong.any() else None

    def _met(self, margin: float) -> Array:
        """The samples at which the relation holds, an inequality with a relative margin."""
        left, right = self.sides
        if self.sign in SENSE:
            return np.asarray((left - right) * SENSE[self.sign] > margin * self._scale)
        near = np.maximum(_CLOSE * self._scale, self.rounding)
        return np.asarray(np.abs(left - right) <= near)

    @cached_property
    def _scale(self) -> float:
        return float(max(np.abs(self.sides).max(), 1e-300))  # both sides may be zero throughout

    @property
    def is_void(self) -> bool:
        """Whether both sides stay zero, of which neither is printed so: any factor would do."""
        return bool(self.component.left and self.component.right) and not np.any(self.sides)

    @property
    def _settles(self) -> bool:
        """Whether the relation nearly holds throughout a twentieth of the motion, at any time."""
        left, right = self.sides
        near = np.logical_or(self._met(-_CLOSE), np.abs(left - right) <= _SETTLED * self._scale)
        # The moving sum over a window reaches its full length only if all its samples are near.
        return bool(np.convolve(near, np.ones(_LASTING), "valid").max() >= _LASTING)
