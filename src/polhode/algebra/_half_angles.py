"""Trigonometric fractions in lowest terms, by the tangent of half the angle.

In normal form sin(θ - φ)/sin(θ + φ) has a denominator free of cosines, at the price of a common
factor that vanishes somewhere, where a program would compute 0/0. In t = tan θ/2 every sine and
cosine is rational (Weierstrass), and that factor is found by the gcd of polynomials.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NamedTuple

from polhode.algebra._expression import Expr
from polhode.algebra._forms import Factors
from polhode.algebra._functions import CIRCULAR, Even
from polhode.algebra._ring import Generator, Monomial, Polynomial, Ring

#: Terms above which cancelling takes longer than the digits it saves are worth.
_LONGEST = 3000


class Lowest(NamedTuple):
    """A fraction in lowest terms, its denominator as powers of factors."""

    num: Polynomial
    factors: Factors


def lowest(expression: Expr) -> Lowest | None:
    """A fraction with its trigonometric common factors cancelled; None where it has none."""
    return _lowest(expression, expression.ring.generators)


@lru_cache(maxsize=512)
def _lowest(expression: Expr, _generators: tuple[Generator, ...]) -> Lowest | None:
    """Cached by the ring too: equal expressions may lie in rings with different generators."""
    ring, num, den = expression.ring, expression.num, expression.den
    angles = _angles_below(ring, den)
    if not angles or len(num) > _LONGEST:
        return None
    degrees = {a: max(a.degree(num), a.degree(den)) for a in angles}
    above, below = num, den
    for angle, degree in degrees.items():
        above, below = angle.in_tangent(above, degree), angle.in_tangent(below, degree)
    common = above.gcd(below)
    left = {a: 2 * degrees[a] - a.power(common) for a in angles}
    if common.is_constant() or _odd(left):
        return None
    # t^k cos(θ/2)^n = sin(θ/2)^k cos(θ/2)^(n - k) is a polynomial in sin θ, cos θ for even n only
    number, parts = _by_multiplicity(below / common)
    missing = {
        angle: degree - sum(angle.power(part) * exponent for part, exponent in parts)
        for angle, degree in left.items()
    }
    powers = [{angle: angle.power(part) for angle in left} for part, _ in parts]
    if any(map(_odd, (missing, *powers))):
        return None
    factors = [(_back(p, own), e) for (p, e), own in zip(parts, powers, strict=True)]
    factors += [(angle.cosine_squared, degree // 2) for angle, degree in missing.items() if degree]
    return Lowest(_back(above / common, left) / number, factors)


def lowest_numerator(expression: Expr) -> Expr:
    """The numerator of the fraction in lowest terms: zero where the expression is."""
    cancelled = lowest(expression)
    if cancelled is None:
        return expression.numerator
    return Expr(expression.ring, cancelled.num, expression.ring.one)


def _odd(degrees: Degrees) -> bool:
    return any(degree % 2 for degree in degrees.values())


def _by_multiplicity(polynomial: Polynomial) -> tuple[Any, Factors]:
    """A number, and the products of all irreducible factors that occur equally often."""
    number, factors = polynomial.factor()
    products: dict[int, Polynomial] = {}
    for factor, exponent in factors:
        products[exponent] = products.get(exponent, 1) * factor
    return number, [(product, exponent) for exponent, product in products.items()]


@dataclass(frozen=True, eq=False)
class _Angle:
    """One angle, by the positions of its sine and cosine in the ring.

    The variable of the sine also serves for t, as no polynomial has both.
    """

    ring: Ring
    sine: int
    cosine: int

    def degree(self, polynomial: Polynomial) -> int:
        """Highest degree in sine and cosine together."""
        return max((int(m[self.sine] + m[self.cosine]) for m in polynomial.monoms()), default=0)

    def power(self, polynomial: Polynomial) -> int:
        """Degree in the tangent."""
        return int(polynomial.degrees()[self.sine])

    @property
    def cosine_squared(self) -> Polynomial:
        """Of half the angle."""
        return (1 + self.ring.context.gen(self.cosine)) / 2

    @property
    def sine_squared(self) -> Polynomial:
        """Of half the angle."""
        return (1 - self.ring.context.gen(self.cosine)) / 2

    def in_tangent(self, polynomial: Polynomial, degree: int) -> Polynomial:
        """Times (1 + t²)^degree, with sine 2t/(1 + t²) and cosine (1 - t²)/(1 + t²)."""
        t = self.ring.context.gen(self.sine)
        total = self.ring.zero
        for (p, q), part in self._parts(polynomial).items():
            rest = (1 - t**2) ** q * (1 + t**2) ** (degree - p - q)
            total += part * (2 * t) ** p * rest
        return total

    def back(self, polynomial: Polynomial, degree: int) -> Polynomial:
        """A polynomial in t times cos(θ/2)^degree, for an even degree.

        Pairs sin(θ/2)², cos(θ/2)² are (1 ∓ cos θ)/2; an odd power leaves sin(θ/2) cos(θ/2).
        """
        sine = self.ring.context.gen(self.sine)
        total = self.ring.zero
        for (power, _), part in self._parts(polynomial).items():
            pairs, odd = divmod(power, 2)
            rest = self.sine_squared**pairs * self.cosine_squared ** (degree // 2 - pairs - odd)
            total += part * rest * (sine / 2) ** odd
        return total

    def _parts(self, polynomial: Polynomial) -> dict[Monomial, Polynomial]:
        """Coefficients of the powers of sine and cosine."""
        return self.ring.grouped(polynomial, (self.sine, self.cosine))


Degrees = dict[_Angle, int]


def _angles_below(ring: Ring, den: Polynomial) -> list[_Angle]:
    """The angles whose sine occurs in a factor of the denominator that is not a single term."""
    if den.is_constant():
        return []
    sums = [factor for factor, _ in den.factor()[1] if len(factor) > 1]
    angles = []
    for generator in ring.generators:
        if isinstance(generator, Even) and generator.family == CIRCULAR:
            sine, cosine = ring.index[generator.partner()[0]], ring.index[generator]
            if any(factor.degrees()[sine] > 0 for factor in sums):
                angles.append(_Angle(ring, sine, cosine))
    return angles


def _back(polynomial: Polynomial, degrees: Degrees) -> Polynomial:
    for angle, degree in degrees.items():
        polynomial = angle.back(polynomial, degree)
    return next(iter(degrees)).ring.reduce(polynomial)
