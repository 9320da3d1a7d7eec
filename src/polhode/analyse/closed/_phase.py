"""An argument of Jacobi's functions that grows steadily with time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from polhode.analyse.closed._elliptic import (
    first_kind,
    jacobi,
    quarter_period,
    third_kind,
    third_kind_complete,
)
from polhode.analyse.closed._reals import Array, Reals


class PhasePoint(NamedTuple):
    """A point of a phase: the argument less whole half-periods, their number, and sn, cn, dn."""

    argument: Array
    halves: Array
    sn: Array
    cn: Array
    dn: Array


@dataclass(frozen=True)
class EllipticPhase:
    """u = rate · t + start.

    Attributes:
        context: of the constants.
        rate: 1/s.
        start: u at t = 0.
        m1: complementary parameter; 0 on a separatrix, where nothing repeats.
    """

    context: Any
    rate: Any
    start: Any
    m1: Any

    @classmethod
    def through(cls, context: Any, rate: Any, sn: Any, cn: Any, m1: Any) -> EllipticPhase:
        """The phase with sn u : cn u = `sn` : `cn` at t = 0."""
        size = context.hypot(sn, cn)
        return cls(context, rate, first_kind(context, sn / size, cn / size, m1), m1)

    @property
    def half_period(self) -> Any:
        """Time in which u grows by 2K, after which sn and cn change sign; None if never."""
        if self.m1 == 0:
            return None
        return 2 * quarter_period(self.context, self.m1) / self.rate

    def at(self, reals: Reals, times: Array) -> PhasePoint:
        """sn, cn and dn at times, s."""
        m1 = reals.number(self.m1)
        if self.half_period is None:
            u = reals.number(self.rate) * times + reals.number(self.start)
            return PhasePoint(u, 0, *jacobi(reals, u, m1))
        half = self.half_period
        turns = reals.turns(times, 1 / half, self.start / (half * self.rate))
        u = turns.fraction * reals.number(half * self.rate)
        sign = 1 - 2 * (turns.whole % 2)
        sn, cn, dn = jacobi(reals, u, m1)
        return PhasePoint(u, turns.whole, sign * sn, sign * cn, dn)

    def third_kind(self, reals: Reals, times: Array, n1: Any) -> Array:
        """∫₀ᵗ dt/(cn² + n₁ sn²), s."""
        grown = self._since_zero(reals, self.at(reals, times), n1)
        before = self._since_zero(reals, self.at(reals, reals.array(0)), n1)
        return (grown - before) / reals.number(self.rate)

    def third_kind_half(self, n1: Any) -> Any:
        """What `third_kind` grows by in a half-period, s."""
        return 2 * third_kind_complete(self.context, n1, self.m1) / self.rate

    def _since_zero(self, reals: Reals, point: PhasePoint, n1: Any) -> Array:
        """The integral over u from the zero of u."""
        n, m1 = reals.number(n1), reals.number(self.m1)
        # Within a half-period the sign of cn, which third_kind takes squared, does not matter.
        sn = point.sn * (1 - 2 * (point.halves % 2))
        within = third_kind(reals, point.argument, sn, point.cn, n, m1)
        if self.m1 == 0:
            return within
        return point.halves * reals.number(self.third_kind_half(n1) * self.rate) + within
