"""Taylor's method in long doubles, quadruple and any precision, compiled by heyoka."""

from __future__ import annotations

from collections.abc import Callable
from copy import copy
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np

from polhode.algebra import Program
from polhode.simulate.integrate._heyoka import library, rates_of
from polhode.simulate.integrate._number_types import LongDoubles, NumberType, number
from polhode.simulate.integrate._series import (
    InitialValueProblem,
    SeriesCallback,
    TaylorSolution,
    limbs_of,
)
from polhode.simulate.integrate._stepping import broken

_SPARE_DIGITS = 8
_QUADRUPLE_BITS = 113


class TaylorSeries:
    """Adaptive Taylor series, kept as they are."""

    name = "heyoka"

    def integrate(self, launch: InitialValueProblem, watch: SeriesCallback) -> TaylorSolution:
        """The motion up to its end, until `watch` says no, or as far as it goes."""
        numbers = launch.numbers
        taylor = copy(_compiled(launch.program, len(launch.start), numbers))
        read = _HeyokaNumbers(numbers)
        taylor.time = read(launch.begin)
        taylor.state[:] = [read(value) for value in launch.start]
        taylor.pars[:] = [read(value) for value in launch.constants[: len(taylor.pars)]]
        _, *_, output, _ = taylor.propagate_until(
            read(launch.end),
            c_output=True,
            callback=lambda t: watch(float(t.time), float(t.last_h), t.state),
        )
        if output is None:
            raise broken(float(taylor.time))
        times = numbers.joined(list(limbs_of(np.asarray(output.times), numbers.limbs)))
        limbs = limbs_of(_by_step(output), numbers.limbs).transpose(0, 1, 3, 2)
        return TaylorSolution(numbers, times, limbs)


def _by_step(output: Any) -> Any:
    """Coefficients of the powers of the share of each step, which neither grow nor vanish.

    Shape (steps, states, order + 1).
    """
    times, coefficients = np.asarray(output.times), np.array(output.tcs)
    steps = (times[1:] - times[:-1])[:, None]
    power = steps
    for k in range(1, coefficients.shape[2]):
        coefficients[:, :, k] = coefficients[:, :, k] * power
        power = power * steps
    return coefficients


@lru_cache(maxsize=32)
def _compiled(program: Program, size: int, numbers: NumberType) -> Any:
    """An integrator that is only ever copied."""
    read = _HeyokaNumbers(numbers)
    return library().taylor_adaptive(
        rates_of(program, size, read),
        [read(0)] * size,
        opt_level=0,
        compact_mode=True,  # at such orders the code would be endless, written out
        **read.kind,
    )


class _HeyokaNumbers:
    """Makes numbers of one precision as heyoka knows them."""

    def __init__(self, numbers: NumberType) -> None:
        self._numbers = numbers
        self._make, self.kind = _kind_of(numbers)

    def __call__(self, value: Fraction | Any) -> Any:
        exact = self._numbers.exact
        digits = int(exact.dps) + _SPARE_DIGITS
        return self._make(exact.nstr(number(exact, value), digits, strip_zeros=False))


def _kind_of(numbers: NumberType) -> tuple[Callable[[str], Any], dict[str, Any]]:
    """What makes such a number from text, and how heyoka is told of them."""
    heyoka = library()
    if isinstance(numbers, LongDoubles):
        return np.longdouble, {"fp_type": np.longdouble}
    if numbers.bits == _QUADRUPLE_BITS and hasattr(heyoka, "real128"):
        return heyoka.real128, {"fp_type": heyoka.real128}
    settings = {"fp_type": heyoka.real, "prec": numbers.bits}
    return (lambda text: heyoka.real(text, numbers.bits)), settings
