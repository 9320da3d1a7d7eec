"""Taylor's method on python-flint's power series: available on every machine, in any precision."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import flint
import numpy as np

from polhode.algebra import Arithmetic, Op, Program, Symbol, SymbolKind, fraction_of
from polhode.simulate.integrate._number_types import NumberType
from polhode.simulate.integrate._series import InitialValueProblem, SeriesCallback, TaylorSolution
from polhode.simulate.integrate._stepping import broken

# -- power series of python-flint's balls ------------------------------------------------------
#
# A ball is a number with a bound on its error. Only the midpoints are used here (`mid`): over many
# steps the bounds would grow without limit, though the errors do not. Order and step are chosen as
# in Jorba and Zou, Experimental Mathematics 14 (2005).

_SPARE = 32  # bits carried beyond those requested, for the rounding of long sums


def order_of(numbers: NumberType) -> int:
    """The order that costs least per unit of time: −½ ln ε for the rounding ε (Jorba and Zou)."""
    return math.ceil(numbers.bits * math.log(2) / 2) + 1


def series_of(numbers: NumberType, times: list[Any], steps: list[Any]) -> TaylorSolution:
    """A solution from the coefficients of all steps, each as a sum of doubles."""
    limbs = np.array(steps).transpose(3, 0, 2, 1)  # from (steps, states, order + 1, limbs)
    joined = np.array([limbs_in([time], numbers)[0] for time in times]).T
    return TaylorSolution(numbers, numbers.joined(list(joined)), limbs)


def clocked(symbols: Sequence[Symbol], constants: Sequence[Any], now: Any) -> list[Any]:
    """Parameters as constant series, and the time as now + τ."""
    values = iter(constants)
    clock = flint.arb_series([now, 1])
    return [
        flint.arb_series([next(values)]) if symbol.kind is SymbolKind.PARAMETER else clock
        for symbol in symbols
    ]


def term(series: Any, place: int) -> Any:
    """One coefficient of a series."""
    return series[place] if isinstance(series, flint.arb_series) else flint.arb(0)


def step_of(rows: list[list[Any]], order: int) -> Any:
    """Length of a step over which the series have converged; None if they are not finite.

    The radius of convergence is estimated from the last coefficients, (size/|c_k|)^(1/k); there are
    motions of which only every fourth one is not zero. The optimal step is that over e², with a
    safety factor (Jorba and Zou).
    """
    if not all(value.is_finite() for row in rows for value in row):
        return None
    size = max([flint.arb(1), *(abs(row[0]) for row in rows)])
    radii = []
    for k in range(max(1, order - 7), order + 1):
        last = max(abs(row[k]) for row in rows)
        radii.append((size / last).root(k) if last > 0 else flint.arb(2) ** 40)
    factor = math.exp(-2 - 0.7 / (order - 1))
    return (min(radii) * factor).mid()


def at(row: list[Any], step: Any) -> Any:
    """Where a series leads."""
    total = row[-1]
    for coefficient in row[-2::-1]:
        total = coefficient + total * step
    return total.mid()


def by_step(row: list[Any], step: Any) -> list[Any]:
    """Coefficients of the powers of the share of a step."""
    return [value * step**k for k, value in enumerate(row)]


def limbs_in(row: list[Any], numbers: NumberType) -> list[list[float]]:
    """Coefficients as sums of doubles."""
    found = []
    for value in row:
        parts = []
        for _ in range(numbers.limbs):
            parts.append(float(value))
            value = value - parts[-1]
        found.append(parts)
    return found


def ball(value: Any) -> Any:
    """A number of any type, rounded once."""
    exact: Fraction = fraction_of(value)
    return flint.arb(flint.fmpq(exact.numerator, exact.denominator)).mid()


def arithmetic() -> Arithmetic:
    """The arithmetic of such series, as compiled programs use it."""

    def constant(value: Fraction) -> Any:
        return flint.arb_series([flint.arb(flint.fmpq(value.numerator, value.denominator))])

    return Arithmetic(
        constant,
        flint.arb_series([flint.arb.pi()]),
        {
            Op.SQRT: lambda x: x.sqrt(),
            Op.SIN: lambda x: x.sin(),
            Op.COS: lambda x: x.cos(),
            Op.EXP: lambda x: x.exp(),
            Op.SINH: lambda x: (x.exp() - (-x).exp()) / 2,
            Op.COSH: lambda x: (x.exp() + (-x).exp()) / 2,
        },
    )


@contextmanager
def working_precision(numbers: NumberType, order: int) -> Iterator[None]:
    """A context in which balls have bits to spare, and series end after a power."""
    before = flint.ctx.prec
    flint.ctx.prec = numbers.bits + _SPARE
    try:
        with cap(order + 1):
            yield
    finally:
        flint.ctx.prec = before


@contextmanager
def cap(terms: int) -> Iterator[None]:
    """A context in which series end after so many terms."""
    before = flint.ctx.cap
    flint.ctx.cap = terms
    try:
        yield
    finally:
        flint.ctx.cap = before


class PowerSeries:
    """Taylor steps of high order, whose series are extended term by term."""

    name = "flint"

    def integrate(self, problem: InitialValueProblem, watch: SeriesCallback) -> TaylorSolution:
        """The motion up to its end, until `watch` returns false, or as far as it goes."""
        order = order_of(problem.numbers)
        with working_precision(problem.numbers, order):
            return _integrated(problem, order, watch)


def _integrated(problem: InitialValueProblem, order: int, watch: SeriesCallback) -> TaylorSolution:
    numbers = problem.numbers
    rates = problem.program.function(arithmetic())
    state = [ball(value) for value in problem.start]
    constants = [ball(value) for value in problem.constants]
    now, end = ball(problem.begin), ball(problem.end)
    times, steps = [now], list[Any]()
    others = problem.program.arguments[len(state) :]
    going = True
    while going and now < end:
        given = clocked(others, constants, now)
        # Coefficients by rising power: the series of the rates up to a term gives the next term.
        series = [[value] for value in state]
        for known in range(1, order + 1):
            with cap(known):
                found = rates(*(flint.arb_series(row) for row in series), *given)
            for row, rate in zip(series, found, strict=True):
                row.append((term(rate, known - 1) / known).mid())
        step = step_of(series, order)
        if step is None:
            if not steps:
                raise broken(float(now))
            break
        step = min(step, end - now)
        steps.append([limbs_in(by_step(row, step), numbers) for row in series])
        state = [at(row, step) for row in series]
        now = end if step == end - now else (now + step).mid()
        times.append(now)
        going = watch(float(now), float(step), state)
    return series_of(numbers, times, steps)


# -- slips from the instant at which they begin, as power series of the time since then --------
#
# With the slip velocity s = ρ (cos ψ, sin ψ) the equations ρ' = ṡ·ŝ and ρ ψ' = ṡ·ŝ' are singular at
# ρ = 0. With ρ = ρ₁ τ + ρ₂ τ² + … and G = ṡ·ŝ', which vanishes at first, the coefficients of ψ
# follow one after the other from (n ρ₁ − ∂G/∂ψ) ψₙ = Gₙ − Σ ρₖ (n + 1 − k) ψₙ₊₁₋ₖ (k ≥ 2, Gₙ
# without ψₙ). Where slip begins gently, ρ₁ = 0, the point is irregular and the series asymptotic:
# it is used only as far as its terms fall to the rounding of the numbers.

_GROWING = 64  # places within a step at which slips are checked to be positive
_HALVES = 200  # times the step is halved to this end
_BARELY = 500  # bits below one at which a slip speed counts as zero, but keeps a direction


@dataclass(frozen=True)
class SlipSeries:
    """The beginning of slips as an initial value problem.

    Attributes:
        program: the rates of the other states and of the slip velocities, as functions of the
            other states, of cosine, sine and size of every slip, of parameters and time.
        others: the parameters and the time, in the order of the program.
        numbers: the type of numbers to compute with.
        constants: of the parameters.
        start: of the other states.
        angles: of the slips to come.
        begin: s.
        end: s, at the latest.
    """

    program: Program
    others: Sequence[Symbol]
    numbers: NumberType
    constants: Sequence[Any]
    start: Sequence[Any]
    angles: Sequence[Any]
    begin: Any
    end: Any

    def series(self) -> TaylorSolution | None:
        """The other states and the slip velocities over one step; None where no slip grows."""
        order = order_of(self.numbers)
        with working_precision(self.numbers, order):
            return _SlipSeriesBuilder(self, order).series()


class _SlipSeriesBuilder:
    """The coefficients of all states, found one after the other."""

    def __init__(self, beginning: SlipSeries, order: int) -> None:
        self._numbers = beginning.numbers
        self._order = order
        self._begin, self._end = ball(beginning.begin), ball(beginning.end)
        self._rates = beginning.program.function(arithmetic())
        constants = [ball(value) for value in beginning.constants]
        self._given = clocked(beginning.others, constants, self._begin)
        self._states = [[ball(value)] for value in beginning.start]
        self._angles = [[ball(value)] for value in beginning.angles]
        self._sizes = [[flint.arb(0)] for _ in beginning.angles]

    def series(self) -> TaylorSolution | None:
        # ∂G/∂ψ: how the rate across each slip changes with its direction, to first order.
        turned = [[*row, flint.arb(1)] for row in self._angles]
        with cap(2):
            (_, _, now), (_, _, then) = self._evaluated(self._angles), self._evaluated(turned)
            sensitivities = [term(y, 1) - term(x, 1) for x, y in zip(now, then, strict=True)]
        for known in range(self._order):
            with cap(known + 1):
                rates, along, _ = self._evaluated(self._angles)
            for row, rate in zip([*self._states, *self._sizes], [*rates, *along], strict=True):
                row.append((term(rate, known) / (known + 1)).mid())
            self._turn(known + 1, sensitivities)
        rows = [*self._states, *self._sizes, *self._angles]
        step = step_of(rows, self._order)
        step = None if step is None else self._shortened(min(step, self._end - self._begin))
        if step is None:
            return None
        every = [*self._states, *self._slips()]
        steps = [[limbs_in(by_step(row, step), self._numbers) for row in every]]
        return series_of(self._numbers, [self._begin, (self._begin + step).mid()], steps)

    def _turn(self, known: int, sensitivities: Sequence[Any]) -> None:
        """The next coefficient of every direction, by the recursion above."""
        with cap(known + 1):
            _, _, across = self._evaluated(self._angles)
        for sizes, angles, turning, own in zip(
            self._sizes, self._angles, across, sensitivities, strict=True
        ):
            behind = sum(
                (sizes[k] * ((known + 1 - k) * angles[known + 1 - k]) for k in range(2, known + 1)),
                flint.arb(0),
            )
            angles.append(((term(turning, known) - behind) / (known * sizes[1] - own)).mid())

    def _evaluated(self, angles: Sequence[list[Any]]) -> tuple[list[Any], list[Any], list[Any]]:
        """Rates of the other states, and of every slip along and across itself."""
        units = [_unit(row) for row in angles]
        sizes = [flint.arb_series(row) for row in self._sizes]
        directions = [x for unit, size in zip(units, sizes, strict=True) for x in (*unit, size)]
        states = [flint.arb_series(row) for row in self._states]
        found = self._rates(*states, *directions, *self._given)
        slips = found[len(states) :]
        pairs = list(zip(slips[::2], slips[1::2], units, strict=True))
        along = [x * cos + y * sin for x, y, (cos, sin) in pairs]
        across = [y * cos - x * sin for x, y, (cos, sin) in pairs]
        return list(found[: len(states)]), along, across

    def _shortened(self, step: Any) -> Any:
        """The step, halved until every slip stays positive within it; None if that never happens.

        What is evaluated is ρ/τ, which is not zero at the beginning.
        """
        shares = np.arange(1, _GROWING + 1) / _GROWING
        for _ in range(_HALVES):
            rows = [[float(value) for value in by_step(row, step)[1:]] for row in self._sizes]
            scale = [max(map(abs, row)) for row in rows]
            means = [np.polynomial.polynomial.polyval(shares, row) for row in rows]
            if all(np.min(mean) > 0 and s > 0 for mean, s in zip(means, scale, strict=True)):
                return step
            step = step / 2
        return None

    def _slips(self) -> list[list[Any]]:
        """Slip velocities along the two tangents of each support.

        At first they have a direction, and a speed too small to be told from zero.
        """
        found, barely = [], flint.arb(2) ** -max(_BARELY, 2 * self._numbers.bits)
        for sizes, angles in zip(self._sizes, self._angles, strict=True):
            size = flint.arb_series([barely, *sizes[1:]])
            for part in _unit(angles):
                series = size * part
                found.append([term(series, k).mid() for k in range(self._order + 1)])
        return found


def _unit(angles: Sequence[Any]) -> tuple[Any, Any]:
    angle = flint.arb_series(list(angles))
    return angle.cos(), angle.sin()
