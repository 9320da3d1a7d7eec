"""Which swing starts where: the case, its constants and its phase from angle and velocity."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from polhode.algebra import ZERO, Expr, cos, pi, sin
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._phase import EllipticPhase
from polhode.analyse.closed._reals import Array, Digits, Reals
from polhode.analyse.closed._swing import Across, AcrossWell, Beside, Half, Over, OverWell, Swing
from polhode.base import NumericError

#: From where angles may be counted: that of a swing from its equilibria, or from across them.
SHIFTS = (ZERO, pi / 2)


@dataclass(frozen=True)
class Swinging:
    """θ = origin + ϑ, where ϑ swings.

    Attributes:
        swing: of ϑ.
        origin: where θ is when ϑ is 0: the equilibrium or its like, rad.
    """

    swing: Swing
    origin: Any

    def at(self, reals: Reals, times: Array) -> tuple[Array, Array]:
        """θ (rad) and θ̇ (rad/s) at times, s."""
        angle, rate = self.swing.at(reals, times)
        return reals.number(self.origin) + angle, rate

    def first_arrival(self, angle: Any) -> Any:
        """First time from 0 on at which θ is `angle` up to whole turns, s; None if never."""
        return self.swing.first_arrival(angle - self.origin)

    def shifted(self, shift: Any) -> Swinging:
        """The same of a coordinate that is less by `shift`."""
        return replace(self, origin=self.origin - shift) if shift else self

    @property
    def figures(self) -> dict[str, Any]:
        """Energy modulus and greatest departure from the origin, where there is one."""
        found = {"origin": self.origin, "m_1": self.swing.phase.m1}
        turning = self.swing.turning
        return found if turning is None else {**found, "amplitude": turning}


def swinging(data: Data, A: Expr, B: Expr, theta: Expr, rate: Expr) -> Swinging:
    """The motion under θ̈ = -A sin θ + B sin θ cos θ from the start; not one that is steady."""
    start = data.number(theta)
    half = Half(data.context.sin(start / 2), data.context.cos(start / 2))
    turned = data.number(A) < 0
    if turned:
        A, half = -A, Half(-half.cos, half.sin)
    c = -cos(theta) if turned else cos(theta)
    energy = rate**2 / 2 - A * c - B * sin(theta) ** 2 / 2
    levels = _Levels.of(data, A, B, energy)
    if levels.in_further_well(half):
        turned, levels, half = not turned, levels.mirrored(), Half(-half.cos, half.sin)
    swing = levels.swing(half, data.number(rate))
    return Swinging(swing, _origin(data, swing, start, turned))


def _origin(data: Data, swing: Swing, start: Any, turned: bool) -> Any:
    context = data.context
    reference = context.pi if turned else 0
    reals = Digits(context)
    angle, _ = swing.at(reals, reals.array(0))
    return reference + 2 * context.pi * context.nint((start - reference - angle) / (2 * context.pi))


@dataclass(frozen=True)
class _Levels:
    """Coefficients of 2ẋ² = top x⁴ + 2 middle x² + bottom, and the root of the discriminant.

    `root` is None where the discriminant is negative.
    """

    context: Any
    top: Any
    middle: Any
    bottom: Any
    root: Any

    @classmethod
    def of(cls, data: Data, A: Expr, B: Expr, energy: Expr) -> _Levels:
        discriminant = data.number(2 * energy * B + B * B + A * A)
        return cls(
            data.context,
            data.number(energy - A),
            data.number(energy + B),
            data.number(energy + A),
            data.context.sqrt(discriminant) if discriminant >= 0 else None,
        )

    def mirrored(self) -> _Levels:
        """For 1/x instead of x."""
        return _Levels(self.context, self.bottom, self.middle, self.top, self.root)

    @property
    def _has_two_wells(self) -> bool:
        return self.root is not None and self.top >= 0 and self.middle < 0

    def in_further_well(self, half: Half) -> bool:
        """Whether the motion swings about ϑ = π in spite of a well at 0."""
        return self._has_two_wells and self.top * half.sin**4 > self.bottom * half.cos**4

    def swing(self, half: Half, rate: Any) -> Swing:
        """The case, and its phase at the start."""
        if self._has_two_wells:
            return self._across_well(half, rate)
        if self.root is None:
            return self._over_well(half, rate)
        if self.top >= 0:
            return self._over(half, rate)
        if self.bottom > 0:
            return self._across(half, rate)
        return self._beside(half, rate)

    def _across(self, half: Half, rate: Any) -> Swing:
        sqrt = self.context.sqrt
        # Of the two forms of the greatest x² that one is taken in which nothing cancels.
        if self.middle > 0:
            p2, q2 = self.root + self.middle, -self.top
            m1 = -self.top * self.bottom / (2 * self.root * p2)
        else:
            p2, q2 = self.bottom, self.root - self.middle
            m1 = q2 / (2 * self.root)
        p, q = sqrt(p2), sqrt(q2)
        w, cn = sqrt(self.root), half.sin * q / (half.cos * p)
        dn = sqrt(m1 + (1 - m1) * cn**2)
        return Across(self._phase(w, -self._speed(half, rate) * q / (p * w * dn), cn, m1), p, q)

    def _across_well(self, half: Half, rate: Any) -> Swing:
        sqrt = self.context.sqrt
        widest = self.root - self.middle
        p, q, w = sqrt(self.bottom), sqrt(widest), sqrt(widest / 2)
        m1 = 2 * self.root / widest
        sn = half.sin * q / (half.cos * p)
        cn = self._speed(half, rate) * q / (p * w * sqrt(1 - (1 - m1) * sn**2))
        return AcrossWell(self._phase(w, sn, cn, m1), p, q)

    def _beside(self, half: Half, rate: Any) -> Swing:
        sqrt = self.context.sqrt
        widest = self.root + self.middle
        p, q, w = sqrt(widest), sqrt(-self.top), sqrt(widest / 2)
        m1 = self.bottom * self.top / widest**2
        x = half.sin / half.cos
        side = 1 if x > 0 else -1
        # dn near its extremes says little of u: twice the amplitude is taken instead.
        twice_sine = -2 * side * self._speed(half, rate) * q / (p * w * (1 - m1))
        twice_cosine = (2 * (x * q / p) ** 2 - 1 - m1) / (1 - m1)
        amplitude = self.context.atan2(twice_sine, twice_cosine) / 2
        sn, cn = self.context.sin(amplitude), self.context.cos(amplitude)
        return Beside(self._phase(w, sn, cn, m1), p, q, side)

    def _over(self, half: Half, rate: Any) -> Swing:
        sqrt, sign = self.context.sqrt, 1 if rate > 0 else -1
        steepest = self.root + self.middle
        if steepest == 0:
            raise NumericError(
                "a motion towards an equilibrium on the verge of stability",
                expected="one whose approach is exponential, or none",
                advice="change the start a little, or simulate it",
            )
        p, q = sqrt(self.bottom), sqrt(steepest)
        m1 = self.top * self.bottom / steepest**2
        phase = self._phase(sqrt(steepest / 2), sign * half.sin * q, half.cos * p, m1)
        return Over(phase, p, q, sign)

    def _over_well(self, half: Half, rate: Any) -> Swing:
        sqrt, sign = self.context.sqrt, 1 if rate > 0 else -1
        mean = sqrt(self.top * self.bottom)
        p, q = sqrt(self.bottom), sqrt(mean)
        s, c = sign * half.sin * q, half.cos * p
        m1 = (1 + self.middle / mean) / 2
        phase = self._phase(sqrt(2 * mean), 2 * s * c, c * c - s * s, m1)
        return OverWell(phase, p, q, sign)

    def _phase(self, rate: Any, sn: Any, cn: Any, m1: Any) -> EllipticPhase:
        return EllipticPhase.through(self.context, rate, sn, cn, m1)

    @staticmethod
    def _speed(half: Half, rate: Any) -> Any:
        """ẋ, from ϑ̇."""
        return rate / (2 * half.cos**2)
