"""Alternative forms of a polynomial: cos² for sin² where that is shorter, and products."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache
from math import comb, gcd, lcm
from typing import Any

from polhode.algebra._ring import Generator, Monomial, Polynomial, Ring, as_fraction


def shortest(ring: Ring, polynomial: Polynomial) -> Polynomial:
    """The form with fewest terms, found by trading sin² for 1 - cos², one angle at a time.

    The result lies in the same ring but is in general not reduced.
    """
    for generator in ring.generators:
        if generator.partner() is not None and polynomial.degrees()[ring.index[generator]] < 2:
            other = traded(ring, polynomial, generator)
            if len(other) < len(polynomial):
                polynomial = other
    return polynomial


def traded(ring: Ring, polynomial: Polynomial, even: Generator) -> Polynomial:
    """The polynomial with every square of the odd partner of `even` replaced."""
    partner = even.partner()
    if partner is None:
        return polynomial
    odd, sign = partner
    return ring.folded(polynomial, ring.index[odd], sign * (ring.variable(even) ** 2 - 1))


# -- squares of sines or of cosines, whichever is shorter ------------------------------------------

#: Coefficients by half the powers of (odd, even).
Binary = dict[tuple[int, int], Any]


def in_shortest_squares(ring: Ring, polynomial: Polynomial) -> Polynomial:
    """The form with fewest terms: I₁ sin²θ + I₃ cos²θ for I₃ + (I₁ - I₃) sin²θ.

    The choice is made separately for each cofactor of the squares; the result is in general not
    reduced. Among equally short forms, one with a common sign is preferred: 1 + 4 cos²θ for
    5 - 4 sin²θ.
    """
    polynomial = ring.reduce(polynomial)
    for even in ring.generators:
        partner = even.partner()
        if partner is not None and polynomial.degrees()[ring.index[partner[0]]] > 1:
            polynomial = _rewritten(ring, polynomial, even, *partner)
    return polynomial


def _rewritten(
    ring: Ring, polynomial: Polynomial, even: Generator, odd: Generator, sign: int
) -> Polynomial:
    place, other = ring.index[odd], ring.index[even]
    result = dict[Monomial, Any](polynomial.to_dict())
    cofactors: dict[Monomial, dict[int, Any]] = defaultdict(dict)
    for monomial in [m for m in result if m[place] > 1]:
        half, rest = divmod(int(monomial[place]), 2)
        cofactor = (*monomial[:place], rest, *monomial[place + 1 :])
        cofactors[cofactor][half] = result.pop(monomial)
    for cofactor, halves in cofactors.items():
        halves[0] = result.pop(cofactor, 0)
        parts = tuple(halves.get(k, 0) for k in range(max(halves) + 1))
        for (odds, evens), coefficient in _shortest_squares(parts, sign).items():
            powers = list(cofactor)
            powers[place] += 2 * odds
            powers[other] += 2 * evens
            result[tuple(powers)] = coefficient
    return ring.context.from_dict(result)


@lru_cache(maxsize=4096)
def _shortest_squares(parts: tuple[Any, ...], sign: int) -> Binary:
    """A polynomial in odd², by its coefficients, in odd², in even² or in both."""
    in_odd: Binary = {(k, 0): part for k, part in enumerate(parts)}
    forms = (in_odd, _in_even(parts, sign), _in_both(parts, sign))
    best = min(forms, key=lambda form: _terms_and_signs(form.values()))
    return {powers: coefficient for powers, coefficient in best.items() if coefficient != 0}


def _terms_and_signs(coefficients: Iterable[Any]) -> tuple[int, int]:
    """The number of terms, and of those whose sign differs from that of the majority."""
    signs = [coefficient > 0 for coefficient in coefficients if coefficient != 0]
    return len(signs), min(sum(signs), len(signs) - sum(signs))


def _in_even(parts: Sequence[Any], sign: int) -> Binary:
    """odd² = sign · (even² - 1)."""
    return {
        (0, m): sum(comb(k, m) * (-1) ** (k - m) * sign**k * parts[k] for k in range(m, len(parts)))
        for m in range(len(parts))
    }


def _in_both(parts: Sequence[Any], sign: int) -> Binary:
    """1 = even² - sign · odd², until all terms have one degree."""
    top = len(parts) - 1
    return {
        (j, top - j): sum(
            comb(top - k, j - k) * (-sign) ** (j - k) * parts[k] for k in range(j + 1)
        )
        for j in range(top + 1)
    }


# -- products --------------------------------------------------------------------------------------

#: Polynomials with their powers.
Factors = list[tuple[Polynomial, int]]

#: Longer polynomials are not factorised: it would take longer than the shorter form is worth.
LONGEST_TO_FACTOR = 20


@dataclass(frozen=True)
class Factored:
    """number · Π generator^power · Π sum^power; powers of either sign."""

    number: Fraction = Fraction(1)
    powers: dict[Generator, int] = field(default_factory=dict)
    sums: tuple[tuple[Polynomial, int], ...] = ()

    @property
    def is_bare(self) -> bool:
        """Whether nothing stands beside the sums, except for a sign."""
        return abs(self.number) == 1 and not self.powers

    def __mul__(self, other: Factored) -> Factored:
        generators = self.powers.keys() | other.powers.keys()
        powers = {g: self.powers.get(g, 0) + other.powers.get(g, 0) for g in generators}
        return Factored(
            self.number * other.number,
            {g: p for g, p in powers.items() if p},
            self.sums + other.sums,
        )

    def inverse(self) -> Factored:
        """One over this."""
        return Factored(
            1 / self.number,
            {g: -p for g, p in self.powers.items()},
            tuple((s, -p) for s, p in self.sums),
        )


def terms(ring: Ring, polynomial: Polynomial) -> Iterator[Factored]:
    """Its terms."""
    for monomial, coefficient in polynomial.terms():
        yield Factored(as_fraction(coefficient), powers_of(ring, monomial))


def products(ring: Ring, polynomial: Polynomial) -> list[Factored]:
    """Its forms as a product: content taken out; factorised in the sines, or in the cosines."""
    if len(polynomial) == 1:
        return list(terms(ring, polynomial))
    if len(polynomial) > LONGEST_TO_FACTOR:
        return [extracted(ring, polynomial)]
    forms = [extracted(ring, polynomial), factorised(ring, polynomial)]
    other = over_cosines(ring, polynomial)
    if other != polynomial:
        forms.append(factorised(ring, other))
    return [form for i, form in enumerate(forms) if form not in forms[:i]]


def extracted(ring: Ring, polynomial: Polynomial) -> Factored:
    """With the number and the generators common to all terms taken out."""
    number = content(as_fraction(c) for c in polynomial.coeffs())
    if polynomial.leading_coefficient() < 0:
        number = -number
    common = tuple(min(powers) for powers in zip(*polynomial.monoms(), strict=True))
    rest = polynomial / (ring.context.from_dict({common: 1}) * number.numerator)
    rest *= number.denominator
    return Factored(number, powers_of(ring, common)) * _part(ring, rest)


def factorised(ring: Ring, polynomial: Polynomial) -> Factored:
    """As a product of irreducible factors; (1 - sin)(1 + sin) is cos²."""
    if len(polynomial) > LONGEST_TO_FACTOR or is_plainly_irreducible(polynomial):
        return extracted(ring, polynomial)
    number, factors = polynomial.factor()
    result = Factored(as_fraction(number))
    for factor, exponent in _with_squares(ring, factors):
        part = _part(ring, factor)
        powers = {g: p * exponent for g, p in part.powers.items()}
        sums = tuple((s, p * exponent) for s, p in part.sums)
        result *= Factored(part.number**exponent, powers, sums)
    return result


def is_plainly_irreducible(polynomial: Polynomial) -> bool:
    """Whether, apart from what all terms share, some generator occurs in one of them, linearly.

    In g·m + r, with m a single term and r free of g, one of two factors would be free of g and
    divide both m and r: it is a single term that all terms have in common.
    """
    count = [0] * polynomial.context().nvars()
    for monomial in polynomial.monoms():
        for place, power in enumerate(monomial):
            if power:
                count[place] += int(power)
    return 1 in count


def over_cosines(ring: Ring, polynomial: Polynomial) -> Polynomial:
    """With every square of a sine replaced."""
    for generator in ring.generators:
        partner = generator.partner()
        if partner is not None and polynomial.degrees()[ring.index[partner[0]]] > 1:
            polynomial = traded(ring, polynomial, generator)
    return polynomial


def content(numbers: Iterable[Fraction]) -> Fraction:
    """The largest number of which all are whole multiples."""
    values = list(numbers)
    return Fraction(
        gcd(*(n.numerator for n in values)),
        lcm(*(n.denominator for n in values)),
    )


def _part(ring: Ring, polynomial: Polynomial) -> Factored:
    if len(polynomial) == 1:
        return next(terms(ring, polynomial))
    return Factored(sums=((polynomial, 1),))


def powers_of(ring: Ring, monomial: Iterable[int]) -> dict[Generator, int]:
    """The generators of a monomial and their powers."""
    return {g: int(p) for g, p in zip(ring.generators, monomial, strict=True) if p}


def _with_squares(ring: Ring, factors: Factors) -> Factors:
    for even in ring.generators:
        for parts, square in _squares(ring, even):
            shared = min(next((e for f, e in factors if f == part), 0) for part in parts)
            if shared:
                rest = ((f, e - shared if f in parts else e) for f, e in factors)
                factors = [*((f, e) for f, e in rest if e), (square, shared)]
    return factors


def _squares(ring: Ring, even: Generator) -> Iterator[tuple[list[Polynomial], Polynomial]]:
    """Irreducible factors that together are a square, by even² = 1 + sign · odd²."""
    partner = even.partner()
    if partner is None:
        return
    odd, sign = partner
    # cos² = (1 - sin)(1 + sin), but cosh² = 1 + sinh² has no factors over the rationals
    e, o = ring.variable(even), ring.variable(odd)
    yield ([o - 1, o + 1], -(e**2)) if sign < 0 else ([o**2 + 1], e**2)
    yield [e - 1, e + 1], sign * o**2
