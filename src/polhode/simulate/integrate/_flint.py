"""Taylor's method on python-flint's power series: on every machine, in any precision.

C. Jorba and M. Zou's choice of order and step (Experimental Mathematics 14, 2005).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from typing import Any

import flint
import numpy as np

from polhode.algebra import Arithmetic, Kind, Op
from polhode.simulate.integrate._integrators import broken
from polhode.simulate.integrate._numbers import Numbers, fraction_of
from polhode.simulate.integrate._series import Launch, Series, Watch

_SPARE = 32  # bits carried beyond those asked for


class PowerSeries:
    """Steps of high order, each from series that are lengthened term by term."""

    name = "flint"

    def integrate(self, launch: Launch, watch: Watch) -> Series:
        """The motion up to its end, until `watch` says no, or as far as it goes."""
        order = math.ceil(launch.numbers.bits * math.log(2) / 2) + 1
        with _precision(launch.numbers.bits + _SPARE, order):
            return _integrated(launch, order, watch)


def _integrated(launch: Launch, order: int, watch: Watch) -> Series:
    numbers = launch.numbers
    rates = launch.program.function(_arithmetic())
    state = [_ball(value) for value in launch.start]
    constants = [_ball(value) for value in launch.constants]
    now, end = flint.arb(0), _ball(launch.end)
    times, steps = [now], list[Any]()
    going = True
    while going and now < end:
        given = _given(launch, constants, now)
        series = _lengthened(rates, given, state, order)
        step = _step(series, order)
        if step is None:
            if not steps:
                raise broken(float(now))
            break
        step = min(step, end - now)
        steps.append([_limbs(_by_step(row, step), numbers) for row in series])
        state = [_at(row, step) for row in series]
        now = end if step == end - now else (now + step).mid()
        times.append(now)
        going = watch(float(now))
    limbs = np.array(steps).transpose(3, 0, 2, 1)  # from (steps, states, order + 1, limbs)
    joined = np.array([_limbs([time], numbers)[0] for time in times]).T
    return Series(numbers, numbers.joined(list(joined)), limbs)


def _given(launch: Launch, constants: list[Any], now: Any) -> list[Any]:
    """Arguments after the states: parameters, and the time as a series."""
    rest = launch.program.arguments[len(launch.start) :]
    values = iter(constants)
    clock = flint.arb_series([now, 1])
    return [
        flint.arb_series([next(values)]) if symbol.kind is Kind.PARAMETER else clock
        for symbol in rest
    ]


def _lengthened(rates: Any, given: list[Any], state: list[Any], order: int) -> list[list[Any]]:
    """Coefficients of every state by rising power: each term gives the next one."""
    rows = [[value] for value in state]
    for known in range(1, order + 1):
        with _cap(known):
            found = rates(*(flint.arb_series(row) for row in rows), *given)
        for row, rate in zip(rows, found, strict=True):
            row.append((_coefficient(rate, known - 1) / known).mid())
    return rows


def _coefficient(series: Any, place: int) -> Any:
    return series[place] if isinstance(series, flint.arb_series) else flint.arb(0)


def _step(rows: list[list[Any]], order: int) -> Any:
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


def _at(row: list[Any], step: Any) -> Any:
    total = row[-1]
    for coefficient in row[-2::-1]:
        total = coefficient + total * step
    return total.mid()


def _by_step(row: list[Any], step: Any) -> list[Any]:
    """Coefficients of the powers of the share of a step."""
    return [value * step**k for k, value in enumerate(row)]


def _limbs(row: list[Any], numbers: Numbers) -> list[list[float]]:
    found = []
    for value in row:
        parts = []
        for _ in range(numbers.limbs):
            parts.append(float(value))
            value = value - parts[-1]
        found.append(parts)
    return found


def _ball(value: Any) -> Any:
    exact: Fraction = fraction_of(value)
    return flint.arb(flint.fmpq(exact.numerator, exact.denominator)).mid()


def _arithmetic() -> Arithmetic:
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
def _precision(bits: int, order: int) -> Iterator[None]:
    before = flint.ctx.prec
    flint.ctx.prec = bits
    try:
        with _cap(order + 1):
            yield
    finally:
        flint.ctx.prec = before


@contextmanager
def _cap(terms: int) -> Iterator[None]:
    """Within it, series end after so many terms."""
    before = flint.ctx.cap
    flint.ctx.cap = terms
    try:
        yield
    finally:
        flint.ctx.cap = before
