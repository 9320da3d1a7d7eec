"""The swing ϑ̈ = -A sin ϑ + B sin ϑ cos ϑ: pendulum, gyrocompass, bead on a turning hoop.

With x = tan ϑ/2 and the energy E = ϑ̇²/2 - A cos ϑ - (B/2) sin² ϑ,

    2ẋ² = (E - A) x⁴ + 2 (E + B) x² + (E + A),

which Jacobi's functions solve. In every case x = p/q, so that ϑ = 2 atan2(p, q) stays exact where x
is infinite.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

from polhode.algebra import ZERO, Expr, Symbol, cos, pi, sin
from polhode.analyse.closed._elliptic import EllipticPhase, PhasePoint, first_kind
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._reals import Array, Digits, Reals
from polhode.analyse.closed._solution import ExactSolution
from polhode.base import NumericError


class SwingQuotient(NamedTuple):
    """x = p/q, the derivatives of p and q by u, and the turns of ϑ/2 that atan2(p, q) omits."""

    p: Array
    q: Array
    p_slope: Array
    q_slope: Array
    turned: Array = 0


class Half(NamedTuple):
    """sin ϑ/2 and cos ϑ/2, of which one at least is not zero."""

    sin: Any
    cos: Any

    def x_rate(self, rate: Any) -> Any:
        """ẋ, from ϑ̇."""
        return rate / (2 * self.cos**2)


@dataclass(frozen=True)
class SwingLevels:
    """Coefficients of 2ẋ² = top x⁴ + 2 middle x² + bottom, and the root of the discriminant.

    `root` is None where the discriminant is negative.
    """

    context: Any
    top: Any
    middle: Any
    bottom: Any
    root: Any

    @classmethod
    def of(cls, data: Data, A: Expr, B: Expr, energy: Expr) -> SwingLevels:
        """The levels of a motion."""
        discriminant = data.number(2 * energy * B + B * B + A * A)
        return cls(
            data.context,
            data.number(energy - A),
            data.number(energy + B),
            data.number(energy + A),
            data.context.sqrt(discriminant) if discriminant >= 0 else None,
        )

    def mirrored(self) -> SwingLevels:
        """For 1/x instead of x."""
        return SwingLevels(self.context, self.bottom, self.middle, self.top, self.root)

    @property
    def has_two_wells(self) -> bool:
        """Whether a barrier higher than the energy separates wells at ϑ = 0 and ϑ = π."""
        return self.root is not None and self.top >= 0 and self.middle < 0

    def phase(self, rate: Any, sn: Any, cn: Any, m1: Any) -> EllipticPhase:
        """The phase with these values at the start."""
        return EllipticPhase.through(self.context, rate, sn, cn, m1)


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
        """The type of motion."""
        return self.style if self.phase.m1 else "separatrix"

    @property
    def period(self) -> Any:
        """Time after which ϑ, up to whole turns, and ϑ̇ repeat, s; None on a separatrix."""
        half = self.phase.half_period
        return None if half is None else 2 * half

    def at(self, reals: Reals, times: Array) -> tuple[Array, Array]:
        """ϑ, continuous, and ϑ̇ (1/s) at times, s."""
        p, q = reals.number(self.p), reals.number(self.q)
        x = self.quotient(reals, self.phase.at(reals, times), p, q)
        slope = (x.p_slope * x.q - x.p * x.q_slope) / (x.p * x.p + x.q * x.q)
        angle = reals.atan2(x.p, x.q) + x.turned
        return 2 * angle, 2 * reals.number(self.phase.rate) * slope

    def first_arrival(self, angle: Any) -> Any:
        """First time from 0 on at which ϑ is `angle` up to whole turns, s; None if never."""
        context = self.phase.context
        half = Half(context.sin(angle / 2), context.cos(angle / 2))
        waits = [(u - self.phase.start) / self.phase.rate for u in self.arguments(half)]
        if self.period is not None:
            waits = [wait % self.period for wait in waits]
        return min((wait for wait in waits if wait >= 0), default=None)

    @property
    def turning(self) -> Any:
        """Greatest |ϑ|; None for one that turns over."""
        return 2 * self.phase.context.atan2(self.p, self.q)

    @classmethod
    @abstractmethod
    def from_start(cls, levels: SwingLevels, half: Half, rate: Any) -> Swing:
        """The motion through ϑ/2 with this sine and cosine, and this ϑ̇."""

    @abstractmethod
    def quotient(self, reals: Reals, point: PhasePoint, p: Any, q: Any) -> SwingQuotient:
        """x at a point of the phase."""

    @abstractmethod
    def arguments(self, half: Half) -> Iterator[Any]:
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

    @classmethod
    def from_start(cls, levels: SwingLevels, half: Half, rate: Any) -> Swing:
        sqrt = levels.context.sqrt
        # the greatest x² is (root + middle)/(-top) = bottom/(root - middle): use the form without
        # cancellation
        if levels.middle > 0:
            p2, q2 = levels.root + levels.middle, -levels.top
            m1 = -levels.top * levels.bottom / (2 * levels.root * p2)
        else:
            p2, q2 = levels.bottom, levels.root - levels.middle
            m1 = q2 / (2 * levels.root)
        p, q = sqrt(p2), sqrt(q2)
        w, cn = sqrt(levels.root), half.sin * q / (half.cos * p)
        dn = sqrt(m1 + (1 - m1) * cn**2)
        return cls(levels.phase(w, -half.x_rate(rate) * q / (p * w * dn), cn, m1), p, q)

    def quotient(self, reals: Reals, point: PhasePoint, p: Any, q: Any) -> SwingQuotient:
        return SwingQuotient(p * point.cn, q, -p * point.sn * point.dn, 0)

    def arguments(self, half: Half) -> Iterator[Any]:
        if half.cos:
            cn = half.sin * self.q / (half.cos * self.p)
            yield from (self._argument(sn, cn) for sn in self._roots(1 - cn**2))


class AcrossWell(Swing):
    """x = (p/q) sn u: across ϑ = 0 where ϑ = π is a well too."""

    @classmethod
    def from_start(cls, levels: SwingLevels, half: Half, rate: Any) -> Swing:
        sqrt = levels.context.sqrt
        widest = levels.root - levels.middle
        p, q, w = sqrt(levels.bottom), sqrt(widest), sqrt(widest / 2)
        m1 = 2 * levels.root / widest
        sn = half.sin * q / (half.cos * p)
        cn = half.x_rate(rate) * q / (p * w * sqrt(1 - (1 - m1) * sn**2))
        return cls(levels.phase(w, sn, cn, m1), p, q)

    def quotient(self, reals: Reals, point: PhasePoint, p: Any, q: Any) -> SwingQuotient:
        return SwingQuotient(p * point.sn, q, p * point.cn * point.dn, 0)

    def arguments(self, half: Half) -> Iterator[Any]:
        if half.cos:
            sn = half.sin * self.q / (half.cos * self.p)
            yield from (self._argument(sn, cn) for cn in self._roots(1 - sn**2))


class Beside(Swing):
    """x = ± (p/q) dn u: to and fro on one side of ϑ = 0, never across it."""

    style = "swing on one side"

    @property
    def period(self) -> Any:
        return self.phase.half_period

    @classmethod
    def from_start(cls, levels: SwingLevels, half: Half, rate: Any) -> Swing:
        sqrt = levels.context.sqrt
        widest = levels.root + levels.middle
        p, q, w = sqrt(widest), sqrt(-levels.top), sqrt(widest / 2)
        m1 = levels.bottom * levels.top / widest**2
        x = half.sin / half.cos
        side = 1 if x > 0 else -1
        # Near its extremes dn determines u badly; sine and cosine of twice the amplitude do so
        # well: dn² = (1 + m₁)/2 + (1 - m₁)/2 · cos 2 am u.
        twice_sine = -2 * side * half.x_rate(rate) * q / (p * w * (1 - m1))
        twice_cosine = (2 * (x * q / p) ** 2 - 1 - m1) / (1 - m1)
        amplitude = levels.context.atan2(twice_sine, twice_cosine) / 2
        sn, cn = levels.context.sin(amplitude), levels.context.cos(amplitude)
        return cls(levels.phase(w, sn, cn, m1), p, q, side)

    def quotient(self, reals: Reals, point: PhasePoint, p: Any, q: Any) -> SwingQuotient:
        m = reals.number(1 - self.phase.m1)
        return SwingQuotient(
            self.sign * p * point.dn, q, -self.sign * p * m * point.sn * point.cn, 0
        )

    def arguments(self, half: Half) -> Iterator[Any]:
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

    @classmethod
    def from_start(cls, levels: SwingLevels, half: Half, rate: Any) -> Swing:
        sqrt, sign = levels.context.sqrt, 1 if rate > 0 else -1
        steepest = levels.root + levels.middle
        if steepest == 0:
            raise NumericError(
                "a motion towards an equilibrium on the verge of stability",
                expected="one whose approach is exponential, or none",
                advice="change the start a little, or simulate it",
            )
        p, q = sqrt(levels.bottom), sqrt(steepest)
        m1 = levels.top * levels.bottom / steepest**2
        phase = levels.phase(sqrt(steepest / 2), sign * half.sin * q, half.cos * p, m1)
        return cls(phase, p, q, sign)

    def quotient(self, reals: Reals, point: PhasePoint, p: Any, q: Any) -> SwingQuotient:
        flip = 1 - 2 * (point.halves % 2)
        sn, cn = flip * point.sn, flip * point.cn
        turned = self.sign * reals.number(self.phase.context.pi) * point.halves
        return SwingQuotient(
            self.sign * p * sn, q * cn, self.sign * p * cn * point.dn, -q * sn * point.dn, turned
        )

    def arguments(self, half: Half) -> Iterator[Any]:
        yield self._argument(self.sign * half.sin * self.q, half.cos * self.p)


class OverWell(Swing):
    """x = ± (p/q) tan(am u/2): turning over, slowest or fastest somewhere on the way."""

    style = "turning over"
    turning = None

    @classmethod
    def from_start(cls, levels: SwingLevels, half: Half, rate: Any) -> Swing:
        sqrt, sign = levels.context.sqrt, 1 if rate > 0 else -1
        mean = sqrt(levels.top * levels.bottom)
        p, q = sqrt(levels.bottom), sqrt(mean)
        s, c = sign * half.sin * q, half.cos * p
        m1 = (1 + levels.middle / mean) / 2
        phase = levels.phase(sqrt(2 * mean), 2 * s * c, c * c - s * s, m1)
        return cls(phase, p, q, sign)

    def quotient(self, reals: Reals, point: PhasePoint, p: Any, q: Any) -> SwingQuotient:
        pi, odd = reals.number(self.phase.context.pi), point.halves % 2
        flip = 1 - 2 * odd
        half = (reals.atan2(flip * point.sn, flip * point.cn) + odd * pi) / 2
        sin, cos = reals.sin(half), reals.cos(half)
        slope = point.dn / 2
        turned = self.sign * pi * (point.halves - odd) / 2
        return SwingQuotient(
            self.sign * p * sin, q * cos, self.sign * p * cos * slope, -q * sin * slope, turned
        )

    def arguments(self, half: Half) -> Iterator[Any]:
        s, c = self.sign * half.sin * self.q, half.cos * self.p
        yield self._argument(2 * s * c, c * c - s * s)


# -- the case that a start belongs to --------------------------------------------------------------

#: Added to a coordinate to give θ: it is measured from an equilibrium, or from 90° away.
SHIFTS = (ZERO, pi / 2)


@dataclass(frozen=True)
class Swinging:
    """θ = origin + ϑ, where ϑ swings.

    Attributes:
        swing: of ϑ.
        origin: θ where ϑ is 0: an equilibrium, rad.
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
        """The same motion, in a coordinate that is less by `shift`."""
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
    if turned:  # ϑ = θ - π, with which A changes sign
        A, half = -A, Half(-half.cos, half.sin)
    c = -cos(theta) if turned else cos(theta)
    energy = rate**2 / 2 - A * c - B * sin(theta) ** 2 / 2
    levels = SwingLevels.of(data, A, B, energy)
    if levels.has_two_wells and levels.top * half.sin**4 > levels.bottom * half.cos**4:
        # it swings in the well at ϑ = π: 1/x, with the other sign, for x
        turned, levels, half = not turned, levels.mirrored(), Half(-half.cos, half.sin)
    # The roots of top X² + 2 middle X + bottom in X = x², with bottom ≥ top as A ≥ 0: both positive
    # and motion outside them; complex, so that none limits the motion; both negative, likewise; one
    # positive, the greatest X; or both positive and motion between them.
    case: type[Swing]
    if levels.has_two_wells:
        case = AcrossWell
    elif levels.root is None:
        case = OverWell
    elif levels.top >= 0:
        case = Over
    else:
        case = Across if levels.bottom > 0 else Beside
    swing = case.from_start(levels, half, data.number(rate))
    context, reals = data.context, Digits(data.context)
    reference = context.pi if turned else 0
    angle, _ = swing.at(reals, reals.array(0))
    turns = context.nint((start - reference - angle) / (2 * context.pi))
    return Swinging(swing, reference + 2 * context.pi * turns)


@dataclass(frozen=True)
class SwingSolution(ExactSolution):
    """An angle that swings or turns over.

    Attributes:
        angle: θ.
        rate: θ̇.
        motion: of it.
    """

    angle: Symbol
    rate: Symbol
    motion: Swinging

    @property
    def kind(self) -> str:
        return self.motion.swing.kind

    @property
    def period(self) -> Any:
        return self.motion.swing.period

    @property
    def figures(self) -> dict[str, Any]:
        return self.motion.figures

    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        angle, rate = self.motion.at(reals, times)
        return {self.angle.published: angle, self.rate.published: rate}
