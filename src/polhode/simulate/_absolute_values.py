"""Absolute values along a motion: the side of zero their arguments are on, and how it changes.

A right-hand side with |x| or x/|x| is smooth on either side of x = 0, and each side is integrated
separately. Where x reaches zero, its rates on both sides say what follows: if they have one sign,
the motion crosses; if both drive x back, x stays zero (Filippov, Differential Equations with
Discontinuous Righthand Sides, 1988), as in the sticking of dry friction.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from polhode.algebra import ZERO, Expr, SquareRoot, Symbol, SymbolKind
from polhode.base import DeclarationError, NumericError
from polhode.derive import Guard
from polhode.simulate._dynamics import CLOCK, WORK, Dynamics, sign_symbol
from polhode.simulate._segment import TrajectoryPiece, values_of
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._crossing import Crossing, first_fall
from polhode.simulate.integrate._flow import Flow
from polhode.simulate.integrate._number_types import DOUBLES, NumberType

PASSES = "passes"
"""The kind of guard that ends a side."""

_ALIKE = 1e-9  # relative difference of rates on both sides that counts as rounding
# Where an argument is this share of its largest value beyond zero, it has certainly crossed, and
# integration stops to locate the crossing.
_BEYOND = 1e-9
# A chattering motion changes its side ever faster: it is given up after so many changes in all, or
# after so many in a row that each take less than this share of the longest interval.
_MOST = 50_000
_MOST_QUICK = 32
_QUICK = 1e-6
_RESIDUAL = 1e-9  # of the largest value on a piece: how far below zero an argument may begin
# Of the first step: an argument that seems to have fallen before then, but is on its side there,
# has not fallen.
_SOON = 1e-6
# If the last step went this many times further than the end of the side, the span is integrated
# again up to only so many times that end: a long step has lost digits near its beginning.
_FAR = 2.0
_NEARER = 1.5
_INSTANT = 64  # units in the last place of the time: too short a span to be integrated again

Sides = Mapping[SquareRoot, int]
Values = Callable[[Array], Array]


@dataclass(frozen=True)
class SideChange(Guard):
    """A guard that falls where the argument of an absolute value reaches zero, or leaves it.

    Attributes:
        root: the absolute value.
        leaves: for one whose argument is held at zero, the side on which it is let go.
    """

    root: SquareRoot
    leaves: int = 0


def guards_of_sides(dynamics: Dynamics) -> tuple[SideChange, ...]:
    """The guards of the sides on which equations hold."""
    found = list[SideChange]()
    for root, side in dynamics.sides.items():
        if side:
            positive = dynamics.on_side(root.plain or ZERO) * side
            found.append(SideChange(None, PASSES, positive, root))
        else:
            sign = Expr.generator(sign_symbol(root))
            found += [SideChange(None, PASSES, 1 - k * sign, root, k) for k in (1, -1)]
    return tuple(found)


@dataclass(frozen=True)
class Instant:
    """An instant of a motion.

    Attributes:
        state: value of every state of the equations.
        constants: of the parameters, in the order of the equations.
        time: s.
        numbers: their type.
    """

    state: Mapping[Symbol, Any]
    constants: Any
    time: Any
    numbers: NumberType = DOUBLES

    def values(self, dynamics: Dynamics, expressions: Sequence[Expr]) -> Array:
        """Values of expressions, in doubles; not-a-number where they are not finite."""
        states = tuple(s for s in dynamics.states if s in self.state)
        known = (*states, *dynamics.parameters, CLOCK)
        function = dynamics.function(expressions, known, numbers=self.numbers)
        given = [self.state[s] for s in states]
        try:
            with np.errstate(all="ignore"):
                found = function(*self.numbers.array([*given, *self.constants, self.time]))
        except ArithmeticError:
            return np.full(len(expressions), np.nan)
        return np.array([float(value) for value in found])

    def on_other_speeds(self, dynamics: Dynamics, other: Dynamics) -> dict[Symbol, Any]:
        """The state in the independent speeds of other equations, with the work done.

        Args:
            dynamics: the equations of the state, of which no sides are known.
        """
        known = (*dynamics.states, *dynamics.parameters, CLOCK)
        wanted = [Expr.generator(s) for s in other.states]
        function = dynamics.function(wanted, known, numbers=self.numbers)
        given = [self.state[s] for s in dynamics.states]
        values = function(*self.numbers.array([*given, *self.constants, self.time]))
        work = {WORK: self.state[WORK]} if WORK in self.state else {}
        return {**dict(zip(other.states, values, strict=True)), **work}


def sides_at(
    dynamics: Dynamics, here: Instant, kept: Sides | None = None, passed: SquareRoot | None = None
) -> dict[SquareRoot, int]:
    """The sides of all absolute values from an instant on.

    Args:
        dynamics: of which no sides are known.
        kept: sides up to then.
        passed: the absolute value whose argument has just reached zero.

    Raises:
        NumericError: where no side, or more than one, can follow.
    """
    known = {} if kept is None else {r: side for r, side in kept.items() if r != passed}
    open_ = [] if passed is None else [passed]
    sides = _sides_away_from_zero(dynamics, here, known, open_)
    # The side of one argument at zero may depend on those of the others: iterated until they agree
    # with one another. Without agreement after a few rounds, the motion is not determined.
    for _ in range(2 * len(open_) + 2):
        before = dict(sides)
        for root in open_:
            if root in sides:
                chosen = {**sides, root: _next_side(dynamics, here, sides, root)}
                sides = _sides_away_from_zero(dynamics, here, chosen, open_)
        if sides == before:
            return sides
    raise _undetermined(open_[0], here)


def _sides_away_from_zero(
    dynamics: Dynamics, here: Instant, known: Sides, open_: list[SquareRoot]
) -> dict[SquareRoot, int]:
    """Sides of all absolute values; roots whose argument is zero are added to `open_`."""
    sides: dict[SquareRoot, int] = {}
    # Inner absolute values come first: the argument of an outer one depends on their sides.
    while roots := dynamics.on(sides).undecided:
        root = roots[0]
        if root in known:
            sides[root] = known[root]
            continue
        (value,) = here.values(dynamics.on(sides), [root.plain or ZERO])
        if not value and root not in open_:
            open_.append(root)
        sides[root] = -1 if value < 0 else 1
    return sides


def smooth_at(
    dynamics: Dynamics, state: Sequence[float], parameters: Mapping[Symbol, float]
) -> Dynamics:
    """Equations on the sides of all absolute values that a state is on.

    Args:
        state: values of all states.

    Raises:
        NumericError: where an argument of an absolute value is zero.
    """
    here = Instant(dict(zip(dynamics.states, state, strict=True)), list(parameters.values()), 0.0)
    zero = list[SquareRoot]()
    sides = _sides_away_from_zero(dynamics, here, {}, zero)
    if zero:
        raise NumericError(
            f"small departures from a state at which {_named(zero[0])} is zero",
            expected="a state around which the equations are smooth",
            advice=f"choose one on either side of {_named(zero[0])} = 0",
        )
    return dynamics.on(sides)


def sides_in_order(dynamics: Dynamics, values: Iterable[int]) -> dict[SquareRoot, int]:
    """Sides from their values alone, in the order in which they were found."""
    sides: dict[SquareRoot, int] = {}
    for value in values:
        sides[dynamics.on(sides).undecided[0]] = value
    return sides


def _next_side(dynamics: Dynamics, here: Instant, sides: Sides, root: SquareRoot) -> int:
    """The side that follows where an argument is zero; 0 if it stays zero (Filippov's sliding).

    Its rate decides, or, where that is zero on both sides, its second rate.
    """
    above, below = (dynamics.on({**sides, root: side}) for side in (1, -1))
    _refuse_jump(above, below, here, root)
    rate = above.on_side(root.plain or ZERO)
    for _ in range(2):
        rate = rate.dt()
        try:
            up, down = (float(here.values(side, [rate])[0]) for side in (above, below))
        except DeclarationError:  # the rate of an acceleration
            break
        least = _ALIKE * max(abs(up), abs(down))
        if not least:
            continue
        up, down = (0.0 if abs(x) <= least else x for x in (up, down))
        if up > 0 > down:  # driven away on both sides: it may go either way
            raise _undetermined(root, here)
        if up <= 0 <= down:  # driven back from both sides
            return 0
        return 1 if up > 0 or down > 0 else -1
    if _alike(above, below, here, list(above.rates)):
        return sides[root] or 1
    raise _undetermined(root, here)


def _alike(one: Dynamics, other: Dynamics, here: Instant, expressions: Sequence[Expr]) -> bool:
    first, second = (here.values(dynamics, expressions) for dynamics in (one, other))
    scale = np.max(np.abs(first), initial=0.0) + np.max(np.abs(second), initial=0.0)
    return bool(np.all(np.abs(first - second) <= _ALIKE * scale))


def _refuse_jump(above: Dynamics, below: Dynamics, here: Instant, root: SquareRoot) -> None:
    """Refuse positions and velocities that jump: this would take an impulse, which is unknown."""
    equations = above.equations
    own = [*equations.kinematics.values(), *equations.dependent.values()]
    inertia = equations.mass.entries
    motion = getattr(equations, "kinetics", None)
    if motion is not None:  # positions and velocities of all bodies
        velocities = (vector for pair in motion.velocities.values() for vector in pair)
        vectors = (*motion.places.values(), *velocities)
        own += [component for vector in vectors for component in vector.components]

    def jumps(expressions: Iterable[Expr]) -> bool:
        suspects = [expression for expression in expressions if may_jump(expression)]
        return bool(suspects) and not _alike(above, below, here, suspects)

    def may_jump(expression: Expr) -> bool:
        driven = any(symbol.kind is SymbolKind.FUNCTION for symbol in expression.symbols())
        return driven or above.on_side(expression) != below.on_side(expression)

    where = f"where {_named(root)} is zero, at t = {_time_text(here)} s"
    if jumps(own):
        raise NumericError(
            f"a position or velocity that jumps {where}",
            expected="positions and prescribed motions without corners",
            advice="round the corner off, or end the motion before that time",
        )
    if jumps(inertia):  # friction, in proportion to a reaction in which accelerations occur
        raise NumericError(
            f"a mass matrix that jumps {where}",
            expected="friction that does not depend on accelerations where it changes sign",
            advice="round the sign off, as tanh(v/v_0), or end the motion before that time",
        )


# -- along a motion --------------------------------------------------------------------------------


def overshoots(
    dynamics: Dynamics, side_guards: Sequence[SideChange], flow: Flow, constants: Array
) -> Callable[[float, Sequence[float]], bool]:
    """A function that says whether a state of the core is certainly beyond the end of a side.

    Integration then stops: beyond the end the equations do not hold, and their solution may grow
    without limit. Guards that depend on more than the core are left to the regular checks.
    """
    core = flow.core.symbols
    arguments = (*flow.states, *flow.parameters, CLOCK)
    programs = [dynamics.program([p.positive], arguments) for p in side_guards]
    outside = set(range(len(core), len(flow.states)))
    functions = [p.function() for p in programs if not p.reads & outside]
    rest = [0.0] * len(outside)
    given = constants.tolist()
    largest = [0.0] * len(functions)

    def over(time: float, state: Sequence[float]) -> bool:
        found = False
        for k, function in enumerate(functions):
            try:
                (value,) = function(*state, *rest, *given, time)
            except (ArithmeticError, ValueError):
                return True
            largest[k] = max(largest[k], abs(value))
            found = found or value < -_BEYOND * largest[k]
        return found

    return over


def first_side_change(
    dynamics: Dynamics, side_guards: Sequence[SideChange], piece: TrajectoryPiece
) -> tuple[TrajectoryPiece, SideChange | None]:
    """A piece up to the first end of a side, and the guard that falls there."""
    if not side_guards:
        return piece, None
    expressions = [change.positive for change in side_guards]

    def values(times: Array) -> Array:
        return values_of(dynamics, piece, expressions, times)

    fall = first_end_of_side(values, piece.solution.steps)
    if fall is None:
        return piece, None
    return replace(piece, end=fall.time), side_guards[fall.guard]


def first_end_of_side(values: Values, knots: Array, first: int = 0) -> Crossing | None:
    """The first fall of some guards, of which those of sides may only seem to fall where they rise.

    A side begins where its argument is zero, but only to within rounding: of the time, and of the
    terms that cancel in it. It may start a little below zero, or dip below it soon after.

    Args:
        values: at some times or places, shape (functions, times).
        knots: of the piece.
        first: of the functions that guard a side.
    """
    raised = _raised_at_start(values, knots, first)
    soon = knots[0] + _SOON * (knots[1] - knots[0]) if len(knots) > 1 else knots[0]
    rising = list[int]()
    while True:
        fall = first_fall(_without(raised, rising), knots)
        is_early = fall is not None and fall.guard >= first and fall.time < soon
        if fall is None or not is_early or raised(np.array([soon]))[fall.guard, 0] <= 0:
            break
        rising.append(fall.guard)
    if not rising:
        return fall
    later = first_fall(lambda times: raised(times)[rising], np.array([soon, *knots[1:]]))
    own = None if later is None else replace(later, guard=rising[later.guard])
    return min(filter(None, (fall, own)), key=lambda crossing: crossing.time, default=None)


def _without(values: Values, left_out: Sequence[int]) -> Values:
    """Values with one in place of some of the functions."""
    if not left_out:
        return values

    def others(times: Array) -> Array:
        found = values(times).copy()
        found[left_out] = 1.0
        return found

    return others


def _raised_at_start(values: Values, knots: Array, first: int) -> Values:
    """Values along a piece, raised by as much as they are below zero at its beginning."""
    there = values(knots)
    largest = np.max(np.abs(there), axis=1, initial=0.0)
    below = -there[:, 0]
    moved = (np.arange(len(there)) >= first) & (below > 0) & (below <= _RESIDUAL * largest)
    if not np.any(moved):
        return values
    shift = np.where(moved, below, 0.0)[:, None]
    return lambda times: values(times) + shift


def shorter_span(steps: Any, end: Any, numbers: NumberType = DOUBLES) -> Any | None:
    """Until when to integrate again if a step went far beyond the end of a side; None otherwise.

    The error of a step follows the size of the states at its end, far beyond the side. A piece that
    ends within the rounding of the time, as where two sides end together, is kept: over so short a
    time nothing can be resolved.
    """
    begin, wanted = steps[0], end - steps[0]
    if wanted <= _INSTANT * numbers.spacing(begin) or steps[-1] - begin <= _FAR * wanted:
        return None
    return begin + _NEARER * wanted


def sides_after(
    dynamics: Dynamics, here: Instant, sides: Sides, change: SideChange
) -> dict[SquareRoot, int]:
    """The sides that follow where one ends.

    Args:
        dynamics: of which no sides are fixed.

    Raises:
        NumericError: where no side, or more than one, can follow.
    """
    if change.leaves:
        return sides_at(dynamics, here, {**sides, change.root: change.leaves})
    return sides_at(dynamics, here, sides, change.root)


def name_of_change(change: SideChange, after: Sides) -> str:
    """The kind of the event at the end of a side."""
    if change.leaves:
        return "leaves zero"
    return "changes sign" if after.get(change.root, 1) else "stays zero"


class SideChangeCount:
    """Counts the changes of side in one motion."""

    def __init__(self) -> None:
        self._count = 0
        self._quick = 0
        self._longest = 0.0
        self._last = 0.0

    def count(self, time: float, change: SideChange) -> None:
        """Count one more.

        Raises:
            NumericError: where changes accumulate at an instant, or are too many.
        """
        passed, self._last = float(time) - self._last, float(time)
        self._count += 1
        self._longest = max(self._longest, passed)
        self._quick = self._quick + 1 if passed <= _QUICK * self._longest else 0
        if self._quick >= _MOST_QUICK or self._count > _MOST:
            raise NumericError(
                f"{_named(change.root)} changes sign without end near t = {float(time):.9g} s",
                expected="a motion that settles on one side of zero, or stays at zero",
                advice="end the motion before that time; declare dry friction at a contact as "
                "ph.Coulomb",
            )


def _undetermined(root: SquareRoot, here: Instant) -> NumericError:
    return NumericError(
        f"what happens where {_named(root)} is zero, at t = {_time_text(here)} s, "
        "is not determined",
        expected="forces that drive it to one side, or back to zero from both",
        advice="start elsewhere; declare dry friction at a contact as ph.Coulomb",
    )


def _named(root: SquareRoot) -> str:
    return f"{root.plain}"


def _time_text(here: Instant) -> str:
    return f"{float(here.time):.9g}"
