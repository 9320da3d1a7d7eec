"""Where the stability of a family of matrices changes, from their eigenvalues alone.

Stability changes where an indicator changes sign, whichever way the eigenvalues are numbered:

- the product of all λ, where a real one passes through zero (divergence);
- the product of all sums λᵢ + λⱼ, where a pair of conjugates crosses the imaginary axis (flutter;
  the bialternate product of A. T. Fuller, J. Math. Anal. Appl. 23 (1968) 71);
- where eigenvalues come in pairs ±λ, as without dissipation, and those sums always vanish: the
  discriminant of the polynomial whose roots are λ², where two frequencies meet (flutter).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from polhode.base import NumericError, Shown, zero_between

Exponents = NDArray[np.complex128]

_PAIRED = 1e-6  # relative distance within which eigenvalues are opposite to one another
_REAL = 1e-8  # relative imaginary part below which one is real
_GROWING = 1e-7  # relative real part above which a departure grows; frequencies that meet are
# rounded to the square root of machine precision
_NEXT_TO = 1e-3  # share of an interval at which eigenvalues are counted beside a change
_VANISHING = 1e-9  # relative size below which a factor is zero
_ASIDE = 1e-6  # share of an interval by which a value is avoided at which a factor is zero
_HALVINGS = 12  # of an interval in which more happens than one change of each kind


@dataclass(frozen=True)
class StabilityChange(Shown):
    """Where the real part of an exponent passes through zero.

    Attributes:
        value: of the parameter.
        low: a value below, and
        high: one above it, between which the computed indicator changes sign.
        frequency: of the departure that begins or ceases to grow, rad/s; 0 if it does not
            oscillate.
        unstable: how many exponents have a positive real part below and above.
    """

    value: float
    low: float
    high: float
    frequency: float
    unstable: tuple[int, int]


class Indicator(Protocol):
    """The factors of a real product that changes sign where stability may change."""

    def __call__(self, exponents: Exponents, /) -> Exponents: ...


def stability_changes(
    exponents: Callable[[float], Exponents], values: Sequence[float]
) -> tuple[StabilityChange, ...]:
    """Every change of stability between the first and the last of some values.

    Raises:
        NumericError: where more happens between two values than halving them can separate.
    """
    even = all(is_even(exponents(value)) for value in values)
    indicators = (_divergence, _collision if even else _flutter)
    search = _Search(exponents, indicators)
    found = [
        change for low, high in pairwise(values) for change in search.between(low, high, _HALVINGS)
    ]
    return tuple(sorted(found, key=lambda change: change.value))


def growing(exponents: Exponents) -> int:
    """How many exponents have a positive real part."""
    return int(np.sum(exponents.real > _GROWING * _scale(exponents)))


def is_even(exponents: Exponents) -> bool:
    """Whether exponents come in pairs ±λ, as where nothing dissipates."""
    apart = np.abs(exponents[:, None] + exponents[None, :])
    return len(exponents) % 2 == 0 and bool(
        np.all(apart.min(axis=1, initial=np.inf) <= _PAIRED * _scale(exponents))
    )


def _scale(exponents: Exponents) -> float:
    return max(float(np.max(np.abs(exponents), initial=0.0)), np.finfo(float).tiny)


def _divergence(exponents: Exponents) -> Exponents:
    return np.asarray(exponents / _scale(exponents))


def _flutter(exponents: Exponents) -> Exponents:
    scaled = exponents / _scale(exponents)
    return np.array([a + b for a, b in combinations(scaled, 2)])


def _collision(exponents: Exponents) -> Exponents:
    squares = _squares(exponents) / _scale(exponents) ** 2
    return np.array([(a - b) ** 2 for a, b in combinations(squares, 2)])


def _squares(exponents: Exponents) -> Exponents:
    """λ² of each pair ±λ once: of the half with the largest Im λ, then Re λ."""
    order = np.lexsort((-exponents.real, -exponents.imag))
    upper = exponents[order][: len(exponents) // 2]
    return np.asarray(upper**2)


@dataclass(frozen=True)
class _Search:
    exponents: Callable[[float], Exponents]
    indicators: tuple[Indicator, ...]

    def between(self, low: float, high: float, halvings: int) -> Iterator[StabilityChange]:
        """Changes between two values; intervals with more than one of a kind are halved."""
        aside = _ASIDE * (high - low)
        low, high = (self._off_the_axis(value, aside) for value in (low, high))
        found = [
            change
            for indicator in self.indicators
            if (change := self._change(indicator, low, high)) is not None
        ]
        counts = growing(self.exponents(low)), growing(self.exponents(high))
        gained = sum(change.unstable[1] - change.unstable[0] for change in found)
        if counts[0] + gained == counts[1]:
            yield from found
            return
        middle = (low + high) / 2
        if not halvings or not low < middle < high:
            raise NumericError(
                f"changes of stability between {low!r} and {high!r} that are not resolved",
                expected="changes that lie apart",
                advice="follow the modes over a narrower range around these values",
            )
        yield from self.between(low, middle, halvings - 1)
        yield from self.between(middle, high, halvings - 1)

    def _off_the_axis(self, value: float, aside: float) -> float:
        """The value, or one close to it if a product vanishes there."""
        found = self.exponents(value)
        least = min(np.min(np.abs(factors(found)), initial=1.0) for factors in self.indicators)
        return value + aside if least < _VANISHING else value

    def _change(self, indicator: Indicator, low: float, high: float) -> StabilityChange | None:
        """The change of stability at a change of sign; None where there is none."""

        def signed(value: float) -> float:
            return float(np.prod(indicator(self.exponents(value))).real)

        if signed(low) * signed(high) >= 0:
            return None
        value = zero_between(signed, low, high)
        step = _NEXT_TO * (high - low)
        beside = max(low, value - step), min(high, value + step)
        unstable = growing(self.exponents(beside[0])), growing(self.exponents(beside[1]))
        if unstable[0] == unstable[1]:
            return None  # such as a growing and a decaying departure of equal rates
        found = self.exponents(value)
        frequency = 0.0
        if indicator is not _divergence:
            frequency = abs(_crossing(found, indicator).imag)
        below, above = self._bracket(signed, value, low, high)
        return StabilityChange(value, below, above, frequency, unstable)

    def _bracket(
        self, signed: Callable[[float], float], value: float, low: float, high: float
    ) -> tuple[float, float]:
        """The closest values found at which the indicator has the signs of the two ends."""
        signs = math.copysign(1, signed(low)), math.copysign(1, signed(high))
        gap = math.ulp(value) if value else np.finfo(float).eps * (high - low)
        while gap < high - low:
            below, above = max(low, value - gap), min(high, value + gap)
            if signed(below) * signs[0] > 0 and signed(above) * signs[1] > 0:
                return below, above
            gap *= 4
        return low, high


def _crossing(exponents: Exponents, indicator: Indicator) -> complex:
    """The exponent that is on the imaginary axis where an indicator vanishes."""
    if indicator is _collision:
        squares = _squares(exponents)
        first, second = min(combinations(squares, 2), key=lambda pair: abs(pair[0] - pair[1]))
        return complex(np.sqrt((first + second) / 2))
    first, second = min(combinations(exponents, 2), key=lambda pair: abs(pair[0] + pair[1]))
    return complex((first - second) / 2)
