"""The roots of one term drawn together: √g/√a is printed √(g/a), and √(f²) is |f|."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction as Rational
from functools import lru_cache
from math import gcd
from typing import TypeVar

from flint.utils.flint_exceptions import DomainError

from polhode.algebra._expression import ONE, Expr
from polhode.algebra._forms import content, in_shortest_squares, over_cosines, rational
from polhode.algebra._ring import Generator, Polynomial
from polhode.algebra._roots import SquareRoot, is_plainly_positive

K = TypeVar("K")


@dataclass(frozen=True)
class Radicals:
    """number · √radicand^power · Π |size|^power · Π loose root^power · Π generator^power."""

    number: Rational
    radicand: Expr
    power: int
    sizes: dict[Expr, int]
    loose: dict[SquareRoot, int]
    powers: dict[Generator, int]


def gathered(number: Rational, powers: Mapping[Generator, int]) -> Radicals:
    """The roots of a term, as far as their product is a root whatever the signs.

    That is so for all whose radicands are positive, and for one more of unknown sign.
    """
    roots = {g: p for g, p in powers.items() if isinstance(g, SquareRoot)}
    others = {g: p for g, p in powers.items() if g not in roots}
    absolute = {root: absolute_of(root) for root in roots}
    sizes = {f: roots[root] for root, f in absolute.items() if f is not None}
    sizes, others = _with_squares_of_sizes(sizes, others)
    plain = {root: p for root, p in roots.items() if absolute[root] is None}
    safe = {root: p for root, p in plain.items() if is_plainly_positive(root.radicand)}
    loose = {root: p for root, p in plain.items() if root not in safe}
    if list(loose.values()) == [1]:
        safe, loose = plain, {}
    power = max(safe.values(), default=0)
    radicand = ONE
    for root, exponent in safe.items():
        radicand = radicand * root.radicand ** (exponent * power)
    if power > 0:
        number, radicand = _with_number_below(number, radicand)
        radicand, sizes = _with_divisors_inside(radicand, {f: f for f in sizes}, sizes)
        positive = {g: Expr.generator(g) for g in others if g.positive}
        radicand, others = _with_divisors_inside(radicand, positive, others)
    return Radicals(number, radicand, power, sizes, loose, others)


def _with_squares_of_sizes(
    sizes: dict[Expr, int], powers: dict[Generator, int]
) -> tuple[dict[Expr, int], dict[Generator, int]]:
    """|f|/f² is 1/|f|."""
    below = {g: Expr.generator(g) for g, p in powers.items() if p < 0 and p % 2 == 0}
    squares = {below[g]: powers[g] for g in below if below[g] in sizes}
    rest = {g: p for g, p in powers.items() if below.get(g) not in squares}
    return {f: p + squares.get(f, 0) for f, p in sizes.items()}, rest


def _with_number_below(number: Rational, radicand: Expr) -> tuple[Rational, Expr]:
    """√(2g)/2 is √(g/2)."""
    inside = content(rational(c) for c in radicand.num.coeffs()).numerator
    shared = gcd(inside, number.denominator)
    if shared == 1 or radicand.rational is not None:
        return number, radicand
    return number * shared, radicand / shared**2


def _with_divisors_inside(
    radicand: Expr, values: Mapping[K, Expr], powers: dict[K, int]
) -> tuple[Expr, dict[K, int]]:
    """√(q r)/q is √(r/q), for values q that are not negative."""
    found = dict(powers)
    for key, value in values.items():
        if found[key] < 0 and (radicand.numerator / value).is_polynomial:
            radicand = radicand / value**2
            found[key] += 1
    return radicand, {key: p for key, p in found.items() if p}


@lru_cache(maxsize=1024)
def absolute_of(root: SquareRoot) -> Expr | None:
    """The expression whose absolute value the root is, if it is one."""
    ring, num = root.radicand.ring, root.radicand.num
    for form in (num, over_cosines(ring, num), in_shortest_squares(ring, num)):
        base = _exact_root(form)
        if base is not None:
            return Expr(ring, ring.reduce(base), ring.one)
    return None


def _exact_root(polynomial: Polynomial) -> Polynomial | None:
    try:
        return polynomial.sqrt()
    except DomainError:
        return None
