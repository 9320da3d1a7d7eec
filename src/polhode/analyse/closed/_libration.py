"""A libration by quadrature: q̇² = F(q) between two turning points, as Fourier series in time.

With q = mean - half cos s the rate ṡ = √G(s) has no singularity, and the trapezoidal rule on s
converges faster than any power. The period is ∫ ds/√G, and every quantity of the motion is a series
in the phase M = 2πt/T, as in Kepler's problem.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice
from typing import Any, NamedTuple

from polhode.analyse.closed._reals import Array, Reals
from polhode.base import NumericError

#: Nodes at first and at most.
_FEWEST, _MOST = 64, 2048


class FourierSeries(NamedTuple):
    """s = M + Σ b_k sin kM, and φ = drift · t + Σ c_k sin kM for angles carried along.

    Attributes:
        lags: b₁, b₂, …
        swings: c₁, c₂, … of each angle
        start: M at t = 0.
    """

    lags: list[Any]
    swings: tuple[list[Any], ...]
    start: Array


class _Nodes(NamedTuple):
    """Midpoints of s, and there ds/dt upside down and the rates of the angles carried along."""

    s: list[Any]
    delay: list[Any]
    rates: list[tuple[Any, ...]]

    @property
    def mean_delay(self) -> Any:
        return sum(self.delay) / len(self.delay)


@dataclass(frozen=True, eq=False)
class Libration:
    """A motion between turning points.

    Attributes:
        context: of the constants.
        ends: least and greatest q.
        square: F(q).
        carried: rates of angles carried along, as a function of q.
        start: s at t = 0.
        digits: that the period is wanted to.
    """

    context: Any
    ends: tuple[Any, Any]
    square: Callable[[Any], Any]
    carried: Callable[[Any], tuple[Any, ...]]
    start: Any
    digits: int
    _series: dict[Reals, FourierSeries] = field(default_factory=dict, repr=False)

    @property
    def period(self) -> Any:
        """s."""
        return 2 * self.context.pi * self._nodes.mean_delay

    @cached_property
    def drifts(self) -> tuple[Any, ...]:
        """Mean rates of the angles carried along, 1/s."""
        nodes = self._nodes
        return tuple(
            sum(rate * delay for rate, delay in zip(rates, nodes.delay, strict=True))
            / sum(nodes.delay)
            for rates in zip(*nodes.rates, strict=True)
        )

    def at(self, reals: Reals, times: Array) -> tuple[Array, Array, list[Array]]:
        """q, q̇ and the angles carried along, which are 0 at t = 0."""
        if reals not in self._series:
            self._series[reals] = self._expanded(reals)
        lags, swings, start = self._series[reals]
        frequency = 2 * self.context.pi / self.period
        turns = reals.turns(times, 1 / self.period, 0)
        M = turns.fraction * reals.number(2 * self.context.pi) + start
        s = M + _sines(reals, lags, M)
        s_rate = reals.number(frequency) * (1 + _cosines(reals, lags, M))
        low, high = (reals.number(end) for end in self.ends)
        half = (high - low) / 2
        carried = [
            reals.number(drift) * times + _sines(reals, swing, M) - _sines(reals, swing, start)
            for drift, swing in zip(self.drifts, swings, strict=True)
        ]
        return (
            (low + high) / 2 - half * reals.cos(s),
            half * reals.sin(s) * s_rate,
            carried,
        )

    @cached_property
    def _nodes(self) -> _Nodes:
        """As many as the period needs."""
        coarse = self._at_nodes(_FEWEST)
        for count in _doublings():
            fine = self._at_nodes(count)
            change = abs(fine.mean_delay / coarse.mean_delay - 1)
            if change < self.context.mpf(10) ** -(self.digits + 2):
                return fine
            coarse = fine
        raise _too_sharp()

    def _at_nodes(self, count: int) -> _Nodes:
        context, (low, high) = self.context, self.ends
        mean, half = (low + high) / 2, (high - low) / 2
        s = [(j + context.mpf(0.5)) * context.pi / count for j in range(count)]
        q = [mean - half * context.cos(angle) for angle in s]
        delay = [
            half * context.sin(angle) / context.sqrt(self.square(place))
            for angle, place in zip(s, q, strict=True)
        ]
        return _Nodes(s, delay, [self.carried(place) for place in q])

    def _expanded(self, reals: Reals) -> FourierSeries:
        nodes = self._nodes
        while len(nodes.s) <= _MOST:
            found = self._from_nodes(reals, nodes)
            if found is not None:
                return found
            nodes = self._at_nodes(2 * len(nodes.s))
        raise _too_sharp()

    def _from_nodes(self, reals: Reals, nodes: _Nodes) -> FourierSeries | None:
        """The series, or None if they have not converged on that many nodes."""
        count, mean = len(nodes.s), nodes.mean_delay
        s, delay = reals.array(nodes.s), reals.array([d / mean for d in nodes.delay])
        orders = range(1, count // 2)
        at_s = [cos for _, cos in islice(reals.harmonics(s), count // 2 - 1)]
        advances = [2 * (delay * wave).sum() / (k * count) for k, wave in enumerate(at_s, 1)]
        M = s + _sines(reals, advances, s)
        at_M = (cos for _, cos in reals.harmonics(M))
        waves = [2 * cos / (k * count) for k, cos in zip(orders, at_M, strict=False)]
        lags = [wave.sum() for wave in waves]
        weights = [
            reals.array([(rate - drift) * d for rate, d in zip(rates, nodes.delay, strict=True)])
            for drift, rates in zip(self.drifts, zip(*nodes.rates, strict=True), strict=True)
        ]
        swings = [[(wave * weight).sum() for wave in waves] for weight in weights]
        smallest = max(16 * reals.eps, reals.number(self.context.mpf(10) ** -(self.digits + 2)))
        if max(map(abs, lags[-count // 16 :])) > smallest:
            return None
        kept = max((k for k in orders if abs(lags[k - 1]) > smallest / 256), default=1)
        start = reals.array(reals.number(self.start))
        kept_swings = tuple(swing[:kept] for swing in swings)
        return FourierSeries(lags[:kept], kept_swings, start + _sines(reals, advances, start))


def _doublings() -> list[int]:
    counts = [2 * _FEWEST]
    while counts[-1] < _MOST:
        counts.append(2 * counts[-1])
    return counts


def _sines(reals: Reals, coefficients: list[Any], angle: Array) -> Array:
    terms = zip(coefficients, reals.harmonics(angle), strict=False)
    return sum((b * sin for b, (sin, _) in terms), start=0 * angle)


def _cosines(reals: Reals, coefficients: list[Any], angle: Array) -> Array:
    """The derivative of the series of sines."""
    terms = enumerate(zip(coefficients, reals.harmonics(angle), strict=False), 1)
    return sum((k * b * cos for k, (b, (_, cos)) in terms), start=0 * angle)


def _too_sharp() -> NumericError:
    return NumericError(
        f"a motion too sharp for a series of {_MOST} nodes",
        expected="turning points away from other places of rest and from singular ones",
        advice="change the start a little, or simulate it",
    )
