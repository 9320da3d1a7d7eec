"""Taylor's method on python-flint's power series: on every machine, in any precision."""

from __future__ import annotations

from typing import Any

import flint

from polhode.simulate.integrate._balls import (
    arithmetic,
    at,
    ball,
    by_step,
    cap,
    clocked,
    limbs_in,
    order_of,
    series_of,
    step_of,
    term,
    working,
)
from polhode.simulate.integrate._series import InitialValueProblem, SeriesCallback, TaylorSolution
from polhode.simulate.integrate._stepping import broken


class PowerSeries:
    """Steps of high order, each from series that are lengthened term by term."""

    name = "flint"

    def integrate(self, launch: InitialValueProblem, watch: SeriesCallback) -> TaylorSolution:
        """The motion up to its end, until `watch` says no, or as far as it goes."""
        order = order_of(launch.numbers)
        with working(launch.numbers, order):
            return _integrated(launch, order, watch)


def _integrated(launch: InitialValueProblem, order: int, watch: SeriesCallback) -> TaylorSolution:
    numbers = launch.numbers
    rates = launch.program.function(arithmetic())
    state = [ball(value) for value in launch.start]
    constants = [ball(value) for value in launch.constants]
    now, end = ball(launch.begin), ball(launch.end)
    times, steps = [now], list[Any]()
    others = launch.program.arguments[len(state) :]
    going = True
    while going and now < end:
        given = clocked(others, constants, now)
        series = _lengthened(rates, given, state, order)
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


def _lengthened(rates: Any, given: list[Any], state: list[Any], order: int) -> list[list[Any]]:
    """Coefficients of every state by rising power: each term gives the next one."""
    rows = [[value] for value in state]
    for known in range(1, order + 1):
        with cap(known):
            found = rates(*(flint.arb_series(row) for row in rows), *given)
        for row, rate in zip(rows, found, strict=True):
            row.append((term(rate, known - 1) / known).mid())
    return rows
