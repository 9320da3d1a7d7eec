"""Dormand and Prince's method of order eight, from SciPy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.integrate import DOP853, OdeSolution

from polhode.algebra import Compiled
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._flow import Flow
from polhode.simulate.integrate._stepping import (
    Leg,
    StepCallback,
    Stepper,
    broken,
    fewest_steps,
    longest_step,
)

_TIGHTEST = 1e-13  # relative tolerance; below it rounding would determine the steps
_ABSOLUTE = 1e-15  # absolute tolerance, for states that pass through zero


class DormandPrince:
    """Explicit Runge–Kutta steps of order eight, with an interpolant of order seven.

    Between the steps it is less accurate than at their ends, so that quadratures are not separated:
    all states are integrated together (`dense` is false).
    """

    name = "scipy"
    dense = False

    def prepare(self, flow: Flow, tolerance: float | None) -> Stepper:
        """The core as a function of floats."""
        rates = flow.core.program.function()
        return _RungeKuttaStepper(rates, max(tolerance or 0.0, _TIGHTEST), fewest_steps(flow))


@dataclass(frozen=True)
class _RungeKuttaStepper:
    rates: Compiled
    tolerance: float
    least_steps: int

    def leg(
        self, parameters: Array, begin: float, state: Array, end: float, watch: StepCallback
    ) -> Leg:
        constants = parameters.tolist()

        def rate(time: float, state: Array) -> Array:
            try:
                return np.array(self.rates(*state.tolist(), *constants, time), dtype=float)
            except (ArithmeticError, ValueError):  # SciPy then tries a shorter step
                return np.full(len(state), np.nan)

        method = DOP853(
            rate,
            begin,
            state,
            end,
            max_step=longest_step(begin, end, self.least_steps),
            rtol=self.tolerance,
            atol=_ABSOLUTE,
        )
        times, pieces = [begin], list[Any]()
        going = True
        while method.status == "running" and going:
            method.step()
            if method.status == "failed" or not np.all(np.isfinite(method.y)):
                break
            times.append(method.t)
            pieces.append(method.dense_output())
            going = watch(method.t, method.y.tolist())
        if not pieces:
            raise broken(begin)
        return _RungeKuttaLeg(OdeSolution(times, pieces), going and times[-1] < end)


@dataclass(frozen=True)
class _RungeKuttaLeg:
    solution: Any
    broken: bool

    @property
    def times(self) -> Array:
        return np.asarray(self.solution.ts)

    def at(self, times: Array) -> Array:
        return np.asarray(self.solution(times))
