"""Power series of python-flint's balls: what Taylor's method in any precision is made of.

C. Jorba and M. Zou's choice of order and step (Experimental Mathematics 14, 2005).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from fractions import Fraction
from typing import Any

import flint
import numpy as np

from polhode.algebra import Arithmetic, Op, Symbol, SymbolKind, fraction_of
from polhode.simulate.integrate._number_types import NumberType
from polhode.simulate.integrate._series import TaylorSolution

_SPARE = 32  # bits carried beyond those asked for


def order_of(numbers: NumberType) -> int:
    """Of the series that reach farthest for what they cost."""
    return math.ceil(numbers.bits * math.log(2) / 2) + 1


def series_of(numbers: NumberType, times: list[Any], steps: list[Any]) -> TaylorSolution:
    """What was found, as sums of doubles: of every step, state and power the limbs."""
    limbs = np.array(steps).transpose(3, 0, 2, 1)  # from (steps, states, order + 1, limbs)
    joined = np.array([limbs_in([time], numbers)[0] for time in times]).T
    return TaylorSolution(numbers, numbers.joined(list(joined)), limbs)


def clocked(symbols: Sequence[Symbol], constants: Sequence[Any], now: Any) -> list[Any]:
    """Parameters and the time, as series."""
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
    """Length of a step after which the series are still exact; None where they are not finite."""
    if not all(value.is_finite() for row in rows for value in row):
        return None
    size = max([flint.arb(1), *(abs(row[0]) for row in rows)])
    radii = []
    for k in (order - 1, order):
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
    """A number of any sort, rounded once."""
    exact: Fraction = fraction_of(value)
    return flint.arb(flint.fmpq(exact.numerator, exact.denominator)).mid()


def arithmetic() -> Arithmetic:
    """How such series are computed with."""

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
def working(numbers: NumberType, order: int) -> Iterator[None]:
    """Within it, balls have bits to spare, and series end after a power."""
    before = flint.ctx.prec
    flint.ctx.prec = numbers.bits + _SPARE
    try:
        with cap(order + 1):
            yield
    finally:
        flint.ctx.prec = before


@contextmanager
def cap(terms: int) -> Iterator[None]:
    """Within it, series end after so many terms."""
    before = flint.ctx.cap
    flint.ctx.cap = terms
    try:
        yield
    finally:
        flint.ctx.cap = before
