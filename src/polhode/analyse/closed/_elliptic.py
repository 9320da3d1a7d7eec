"""Jacobi's functions and Legendre's integrals by the complementary parameter m₁ = 1 - k².

No digits are lost as the modulus k approaches 1: near a separatrix m₁ is small and accurately
known, which k² = 1 - m₁ no longer is once rounded. At m₁ = 0 the functions are tanh and sech.
The integrals are Carlson's symmetric ones (DLMF, chapter 19).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

from polhode.analyse.closed._reals import Array, Reals

#: Shifts u off zero, where the recurrence divides by sin u, by far less than rounding.
_NUDGE = 1e-100


def quarter_period(context: Any, m1: Any) -> Any:
    """K = π/(2 agm(1, k')), the complete integral of the first kind (DLMF 19.8.5)."""
    return context.pi / (2 * context.agm(1, context.sqrt(m1)))


def first_kind(context: Any, sn: Any, cn: Any, m1: Any) -> Any:
    """The argument u in [-2K, 2K] that has this sn and cn: sn R_F(cn², dn², 1) for |u| ≤ K.

    DLMF 19.25.5. Beyond the quarter period, where cn is negative, u is reflected about K.
    """
    dn2 = cn**2 + m1 * sn**2
    if cn >= 0:
        return sn * context.elliprf(cn**2, dn2, 1)
    turned = 2 * quarter_period(context, m1) - abs(sn) * context.elliprf(cn**2, dn2, 1)
    return turned if sn >= 0 else -turned


def third_kind_complete(context: Any, n1: Any, m1: Any) -> Any:
    """∫₀ᴷ du/(cn² + n₁ sn²), Legendre's Π with α² = 1 - n₁ (DLMF 19.25.2)."""
    return context.elliprf(0, m1, 1) + (1 - n1) / 3 * context.elliprj(0, m1, 1, n1)


def third_kind(reals: Reals, u: Array, sn: Array, cn: Array, n1: Any, m1: Any) -> Array:
    """∫₀ᵘ du/(cn² + n₁ sn²) for |u| ≤ K, given sn u and cn u (DLMF 19.25.14)."""
    s2, c2 = sn * sn, cn * cn
    rj = reals.rj(c2, c2 + m1 * s2, reals.number(1), c2 + n1 * s2)
    return u + (1 - n1) / 3 * sn * s2 * rj


def jacobi(reals: Reals, u: Array, m1: Any) -> tuple[Array, Array, Array]:
    """sn u, cn u, dn u for |u| ≤ 2K, by descending Landen steps.

    R. Bulirsch, Numerical calculation of elliptic integrals and elliptic functions, Numerische
    Mathematik 7 (1965) 78.
    """
    if m1 == 0:
        decay = reals.exp(-abs(u))
        sech = 2 * decay / (1 + decay * decay)
        return reals.tanh(u), sech, sech
    mean, root = reals.number(1), reals.sqrt(reals.number(m1))
    means = [(mean, root)]
    # convergence is quadratic: once they agree to half the digits, the next mean has all of them
    while abs(mean - root) > mean * reals.sqrt(reals.eps):
        mean, root = (mean + root) / 2, reals.sqrt(mean * root)
        means.append((mean, root))
    limit = (mean + root) / 2
    u = limit * (u + _NUDGE)
    sine = reals.sin(u)
    a = reals.cos(u) / sine
    c, dn = limit * a, 1
    for mean, root in reversed(means):
        a, c = a * c, c * dn
        dn = (root + a) / (mean + a)
        a = c / mean
    sn = abs(sine) / sine / reals.sqrt(c * c + 1)
    return sn, c * sn, dn


class PhasePoint(NamedTuple):
    """The argument less whole multiples of 2K, their number, and sn, cn, dn."""

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
        """Time in which u grows by 2K, after which sn and cn change sign; None on a separatrix."""
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
        sign = 1 - 2 * (turns.whole % 2)  # sn(u + 2K) = -sn u and cn(u + 2K) = -cn u
        sn, cn, dn = jacobi(reals, u, m1)
        return PhasePoint(u, turns.whole, sign * sn, sign * cn, dn)

    def third_kind(self, reals: Reals, times: Array, n1: Any) -> Array:
        """∫₀ᵗ dt/(cn² + n₁ sn²), s."""
        grown = self._since_zero(reals, self.at(reals, times), n1)
        before = self._since_zero(reals, self.at(reals, reals.array(0)), n1)
        return (grown - before) / reals.number(self.rate)

    def third_kind_half(self, n1: Any) -> Any:
        """Increment of `third_kind` in a half-period, s."""
        return 2 * third_kind_complete(self.context, n1, self.m1) / self.rate

    def _since_zero(self, reals: Reals, point: PhasePoint, n1: Any) -> Array:
        """The integral over u from the zero of u."""
        n, m1 = reals.number(n1), reals.number(self.m1)
        # sn without the sign of the half-periods; third_kind uses cn squared only
        sn = point.sn * (1 - 2 * (point.halves % 2))
        within = third_kind(reals, point.argument, sn, point.cn, n, m1)
        if self.m1 == 0:
            return within
        return point.halves * reals.number(self.third_kind_half(n1) * self.rate) + within
