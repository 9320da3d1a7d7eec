"""The swing ϑ̈ = -A sin ϑ + B sin ϑ cos ϑ: pendulum, gyrocompass, bead on a turning hoop.

With x = tan ϑ/2 and the energy E = ϑ̇²/2 - A cos ϑ - (B/2) sin² ϑ,

    2ẋ² = (E - A) x⁴ + 2 (E + B) x² + (E + A),

which only Jacobi's functions solve. Every case is x = p/q, so that ϑ = 2 atan2(p, q) stays exact
where x is infinite.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

from polhode.analyse.closed._elliptic import first_kind
from polhode.analyse.closed._phase import EllipticPhase, PhasePoint
from polhode.analyse.closed._reals import Array, Reals


class SwingQuotient(NamedTuple):
    """x = p/q, the derivatives of p and q by u, and what atan2(p, q) has forgotten of ϑ/2."""

    p: Array
    q: Array
    p_slope: Array
    q_slope: Array
    turned: Array = 0


class Half(NamedTuple):
    """sin ϑ/2 and cos ϑ/2, in whose ratio no angle is singular."""

    sin: Any
    cos: Any


@dataclass(frozen=True)
class Swing(ABC):
    """One motion of the angle ϑ.

    Attributes:
        phase: argument of Jacobi's functions.
        p: size of the numerator of x.
        q: size of its denominator.
        sign: of the velocity, or of the side the motion keeps to.
    """

    phase: EllipticPhase
    p: Any
    q: Any
    sign: int = 1

    style = "swing"

    @property
    def kind(self) -> str:
        """What the motion is called."""
        return self.style if self.phase.m1 else "separatrix"

    @property
    def period(self) -> Any:
        """After which ϑ and ϑ̇ are the same, up to whole turns, s; None where never."""
        half = self.phase.half_period
        return None if half is None else 2 * half

    def at(self, reals: Reals, times: Array) -> tuple[Array, Array]:
        """ϑ, continuous, and ϑ̇ (1/s) at times, s."""
        p, q = reals.number(self.p), reals.number(self.q)
        x = self._fraction(reals, self.phase.at(reals, times), p, q)
        slope = (x.p_slope * x.q - x.p * x.q_slope) / (x.p * x.p + x.q * x.q)
        angle = reals.atan2(x.p, x.q) + x.turned
        return 2 * angle, 2 * reals.number(self.phase.rate) * slope

    def first_arrival(self, angle: Any) -> Any:
        """First time from 0 on at which ϑ is `angle` up to whole turns, s; None if never."""
        context = self.phase.context
        half = Half(context.sin(angle / 2), context.cos(angle / 2))
        waits = [(u - self.phase.start) / self.phase.rate for u in self._arguments(half)]
        if self.period is not None:
            waits = [wait % self.period for wait in waits]
        return min((wait for wait in waits if wait >= 0), default=None)

    @property
    def turning(self) -> Any:
        """Greatest |ϑ|; None where it turns over."""
        return 2 * self.phase.context.atan2(self.p, self.q)

    @abstractmethod
    def _fraction(self, reals: Reals, point: PhasePoint, p: Any, q: Any) -> SwingQuotient:
        """x at a point of the phase."""

    @abstractmethod
    def _arguments(self, half: Half) -> Iterator[Any]:
        """Arguments u of a period at which ϑ/2 has this sine and cosine."""

    def _argument(self, sn: Any, cn: Any) -> Any:
        size = self.phase.context.hypot(sn, cn)
        return first_kind(self.phase.context, sn / size, cn / size, self.phase.m1)

    def _roots(self, square: Any) -> Iterator[Any]:
        if square >= 0:
            root = self.phase.context.sqrt(square)
            yield from (root, -root)


class Across(Swing):
    """x = (p/q) cn u: to and fro across ϑ = 0."""

    def _fraction(self, reals: Reals, point: PhasePoint, p: Any, q: Any) -> SwingQuotient:
        return SwingQuotient(p * point.cn, q, -p * point.sn * point.dn, 0)

    def _arguments(self, half: Half) -> Iterator[Any]:
        if half.cos:
            cn = half.sin * self.q / (half.cos * self.p)
            yield from (self._argument(sn, cn) for sn in self._roots(1 - cn**2))


class AcrossWell(Swing):
    """x = (p/q) sn u: the same where ϑ = π is a well too."""

    def _fraction(self, reals: Reals, point: PhasePoint, p: Any, q: Any) -> SwingQuotient:
        return SwingQuotient(p * point.sn, q, p * point.cn * point.dn, 0)

    def _arguments(self, half: Half) -> Iterator[Any]:
        if half.cos:
            sn = half.sin * self.q / (half.cos * self.p)
            yield from (self._argument(sn, cn) for cn in self._roots(1 - sn**2))


class Beside(Swing):
    """x = ± (p/q) dn u: to and fro on one side of ϑ = 0, never across it."""

    style = "swing on one side"

    @property
    def period(self) -> Any:
        return self.phase.half_period

    def _fraction(self, reals: Reals, point: PhasePoint, p: Any, q: Any) -> SwingQuotient:
        m = reals.number(1 - self.phase.m1)
        return SwingQuotient(
            self.sign * p * point.dn, q, -self.sign * p * m * point.sn * point.cn, 0
        )

    def _arguments(self, half: Half) -> Iterator[Any]:
        m1, m = self.phase.m1, 1 - self.phase.m1
        if half.cos and self.sign * half.sin / half.cos > 0:
            dn2 = (half.sin * self.q / (half.cos * self.p)) ** 2
            for sn in self._roots((1 - dn2) / m):
                yield from (self._argument(sn, cn) for cn in self._roots((dn2 - m1) / m) if cn >= 0)


class Over(Swing):
    """x = ± (p/q) sn u/cn u: turning over."""

    style = "turning over"
    turning = None

    @property
    def period(self) -> Any:
        return self.phase.half_period

    def _fraction(self, reals: Reals, point: PhasePoint, p: Any, q: Any) -> SwingQuotient:
        flip = 1 - 2 * (point.halves % 2)
        sn, cn = flip * point.sn, flip * point.cn
        turned = self.sign * reals.number(self.phase.context.pi) * point.halves
        return SwingQuotient(
            self.sign * p * sn, q * cn, self.sign * p * cn * point.dn, -q * sn * point.dn, turned
        )

    def _arguments(self, half: Half) -> Iterator[Any]:
        yield self._argument(self.sign * half.sin * self.q, half.cos * self.p)


class OverWell(Swing):
    """x = ± (p/q) tan(am u/2): turning over, slowest or fastest somewhere on the way."""

    style = "turning over"
    turning = None

    def _fraction(self, reals: Reals, point: PhasePoint, p: Any, q: Any) -> SwingQuotient:
        pi, odd = reals.number(self.phase.context.pi), point.halves % 2
        flip = 1 - 2 * odd
        half = (reals.atan2(flip * point.sn, flip * point.cn) + odd * pi) / 2
        sin, cos = reals.sin(half), reals.cos(half)
        slope = point.dn / 2
        turned = self.sign * pi * (point.halves - odd) / 2
        return SwingQuotient(
            self.sign * p * sin, q * cos, self.sign * p * cos * slope, -q * sin * slope, turned
        )

    def _arguments(self, half: Half) -> Iterator[Any]:
        s, c = self.sign * half.sin * self.q, half.cos * self.p
        yield self._argument(2 * s * c, c * c - s * s)
