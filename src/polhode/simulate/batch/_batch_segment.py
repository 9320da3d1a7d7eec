"""One contact mode for batches of motions: their states on entry, and what ends them."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from operator import attrgetter

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import ZERO, Expr, Matrix, Symbol, sqrt
from polhode.base import ByIdentity, look_up
from polhode.derive import Guard
from polhode.simulate._dynamics import CLOCK, WORK, Dynamics, readable
from polhode.simulate._gimbal_lock import NumericAttitude, attitudes_of
from polhode.simulate._overlap import gaps_of
from polhode.simulate._task import AS_DECLARED
from polhode.simulate._vanishing_lengths import stretches_of
from polhode.simulate.batch._forcing_intervals import ForcingIntervals
from polhode.simulate.batch._lanes import BatchArrivals, BatchStage, Lanes
from polhode.simulate.contact._auxiliary_states import slip_symbols
from polhode.simulate.contact._hybrid_system import CompiledMode
from polhode.simulate.integrate._arrays import Array, rows

# -- what ends the motions of a contact mode -------------------------------------------------------


@dataclass(frozen=True)
class Ending:
    """A condition that ends motions within a mode.

    Attributes:
        positive: an expression that stays above the least value while the mode lasts.
        kind: of the event that ends the motion as a whole; empty where it goes on from there.
        mode: that a motion ends in.
        guard: of the contact mode, if the motion goes on in another.
        least: value at which it has fallen.
        slips: the slip velocity that vanishes soon after.
    """

    positive: Expr
    kind: str
    mode: str
    guard: Guard | None = None
    least: float = 0.0
    slips: tuple[Symbol, Symbol] | None = None


def endings_of(mode: CompiledMode, near_flat: float, until: Collection[str]) -> tuple[Ending, ...]:
    """The conditions that end a mode, in the order of its guards."""
    found, name = list[Ending](), mode.mode.name
    for guard in mode.mode.guards:
        if guard.ends_before:
            after = guard.kind if guard.kind == "near-flat" else name
            found.append(Ending(guard.positive, guard.ends, after, guard, near_flat))
            continue
        kind = guard.kind if guard.kind in (*until, guard.ends) else ""
        if guard.kind != "sticks":
            found.append(Ending(guard.positive, kind, name, guard))
            continue
        contacts = (touch.contact for touch in mode.mode.touches)
        slips = next(
            slip_symbols(c) for c in contacts if guard.contact and c.name == guard.contact.name
        )
        if set(slips) <= set(mode.flow.core.symbols):
            first, second = (Expr.generator(s) for s in slips)
            speed = sqrt(first * first + second * second)
            found.append(Ending(speed, kind, name, guard, slips=slips))
    return (
        *found,
        *vanishings_of(mode.dynamics, name),
        *gimbal_locks_of(mode.dynamics, name, attrgetter("doubtful")),
    )


def vanishings_of(dynamics: Dynamics, mode: str) -> Iterator[Ending]:
    """Lengths that vanish, of ropes too, and bodies that meet: integrated individually.

    A Taylor series continues the length below zero, where it counts as a fallen guard.
    """
    lengths = map(Expr.generator, dynamics.lengths)
    for length in (*lengths, *stretches_of(dynamics), *gaps_of(dynamics.equations)):
        yield Ending(length, "", mode, Guard(None, "vanishes", length))


def gimbal_locks_of(
    dynamics: Dynamics, mode: str, limit: Callable[[NumericAttitude], float]
) -> Iterator[Ending]:
    """Angles near gimbal lock: such a motion is integrated individually.

    Args:
        limit: sine of the second angle below which it is.
    """
    for attitude in attitudes_of(ByIdentity(dynamics.equations)):
        apart, least = 1 - attitude.declared.alignment**2, limit(attitude)
        yield Ending(apart, "", mode, Guard(None, "vanishes", apart), least**2)


def sides_of(positive: Collection[Expr]) -> tuple[Ending, ...]:
    """The side for which equations of one mode were derived."""
    return tuple(Ending(side, "", AS_DECLARED) for side in positive)


# Of the largest value of a guard among the motions: those that start closer to its fall may not
# stay in the mode at all, and are doubtful.
_CLEAR = 1e-9
#: Slip speed at which slip ends, relative to the velocities that cancel in it. It may not be much
#: larger: where friction hardly exceeds what it opposes, the slip keeps turning down to zero.
SLIP_ENDS = 1e-12
_NEARLY = 1e-6  # of the determinant at the start: less counts as zero, and sliding jams

Quantity = str | Symbol | Expr


class BatchSegment:
    """Integrates many motions while they stay in one contact mode.

    Args:
        dynamics: the equations.
        mode: its name.
        endings: what may end it.
        quantities: that are to be read.
        names: of all quantities of the system: those that this mode lacks are zero in it.
        tolerance: relative, of one step.
        intervals: of prescribed motions.
        whole: whether other modes follow, which need all states; otherwise only those that the
            quantities and endings depend on are integrated.
        square: a matrix that must stay regular.
    """

    def __init__(
        self,
        dynamics: Dynamics,
        mode: str,
        endings: Sequence[Ending],
        quantities: Collection[Quantity],
        names: Collection[str],
        tolerance: float | None,
        intervals: ForcingIntervals,
        *,
        whole: bool = False,
        square: Matrix | None = None,
    ) -> None:
        self.dynamics = dynamics
        self.mode = mode
        self.endings = tuple(endings)
        self._square = square
        self._names = names
        self._tolerance = tolerance
        self._intervals = intervals
        self._whole = whole
        self.states = self._needed(quantities)

    @property
    def doubtful(self) -> int:
        """The guard after all others: a motion that it ends has to be integrated individually."""
        return len(self.endings)

    def stage(
        self,
        begin: Array,
        states: Mapping[Symbol, Array],
        constants: Mapping[Symbol, Array],
        scales: Array,
    ) -> BatchStage:
        """Motions that enter this mode.

        Args:
            begin: s.
            states: of all motions; zero where there is none.
            constants: likewise, of all parameters, and coefficients of prescribed motions.
            scales: size of the velocities that slips are the difference of, m/s.
        """
        rest = np.zeros(len(begin))
        jams = [] if self._square is None else [rest]
        least = [e.least + (SLIP_ENDS if e.slips else 0.0) * scales for e in self.endings]
        found = BatchStage(
            begin,
            rows([states.get(s, rest) for s in self.states], len(begin)),
            self.ordered(constants, len(begin)),
            rows([*least, *jams], len(begin)),
            self._intervals.until_jerk(begin),
        )
        if jams:
            found.least[-1] = _NEARLY * np.abs(self.lanes.guarded(found)[-1])
        return found

    def ordered(self, constants: Mapping[Symbol, Array], count: int) -> Array:
        """Constants of many motions as the equations take them, shape (parameters, motions)."""
        values: Array = rows([constants[s] for s in self.dynamics.parameters], count)
        return values

    def clear(self, stage: BatchStage) -> NDArray[np.bool_]:
        """Motions that start where all rates are finite and no guard is near its fall."""
        with np.errstate(all="ignore"):
            above = self.lanes.guarded(stage)
        rates = self.lanes.values([self._rates[s] for s in self.states], stage)
        sizes = np.where(np.isfinite(above), np.abs(above), 0.0)
        least = _CLEAR * np.max(sizes, axis=1, initial=0.0, keepdims=True)
        finite = np.all(np.isfinite(rates), axis=0)
        return np.asarray(finite & np.all(above > least, axis=0), dtype=bool)

    def follow(self, stage: BatchStage, times: Array) -> BatchArrivals:
        """Integrate all motions to each of some times, as far as they go."""
        return self.lanes.follow(stage, times)

    def rates(self, stage: BatchStage) -> Array:
        """Rates of the states where motions start, shape (states, motions)."""
        return self.lanes.values([self._rates[s] for s in self.states], stage)

    def values(
        self,
        quantity: Quantity,
        times: Array,
        states: Mapping[Symbol, Array],
        constants: Mapping[Symbol, Array],
    ) -> Array:
        """A quantity of many motions, each at its own time; shape (motions,)."""
        there = self.stage(times, states, constants, np.zeros(len(times)))
        (found,) = self.lanes.values([self._expression(quantity)], there)
        return np.asarray(found, dtype=float)

    # -- the states and rates to integrate ------------------------------------------------------

    def _expression(self, quantity: Quantity) -> Expr:
        if isinstance(quantity, Expr):
            return quantity
        name = quantity if isinstance(quantity, str) else quantity.published
        if name in self._names and name not in self._readable:
            return ZERO
        return look_up(name, self._readable, "quantity of this system")

    @cached_property
    def _readable(self) -> dict[str, Expr]:
        return readable(self.dynamics, {})

    @cached_property
    def _rates(self) -> dict[Symbol, Expr]:
        dynamics = self.dynamics
        rates = dict(zip(dynamics.states, dynamics.rates, strict=True))
        return rates | {WORK: dynamics.equations.power}

    def _needed(self, quantities: Collection[Quantity]) -> tuple[Symbol, ...]:
        """The states that some quantities and the endings depend on, directly or through rates."""
        rates = self._rates
        asked = [self._expression(quantity) for quantity in quantities]
        wanted = self._read([*asked, *(ending.positive for ending in self.endings)])
        if self._whole:
            wanted |= set(rates) - {WORK}
        while wanted != (more := wanted | self._read([rates[s] for s in wanted])):
            wanted = more
        return tuple(s for s in rates if s in wanted) or tuple(self.dynamics.states)

    def _read(self, expressions: Sequence[Expr]) -> set[Symbol]:
        given = (*self._rates, *self.dynamics.parameters, CLOCK)
        places = self.dynamics.program(expressions, given).reads
        return {given[i] for i in places} & set(self._rates)

    @cached_property
    def lanes(self) -> Lanes:
        """The compiled equations."""
        dynamics = self.dynamics
        motions = (dynamics.prescribed.get(f, ZERO) for f in dynamics.equations.functions)
        return Lanes(
            self.dynamics,
            self.states,
            self._rates,
            [ending.positive for ending in self.endings],
            self._square,
            self._tolerance,
            self._intervals,
            # The time since a knot of a prescribed motion does not count.
            driven=any(CLOCK in motion.symbols() for motion in motions),
        )
