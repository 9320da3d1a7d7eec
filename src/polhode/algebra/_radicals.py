"""The roots of one term drawn together: √g/√a is printed √(g/a), and √(f²) is |f|."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction as Rational
from functools import lru_cache
from math import gcd

from flint.utils.flint_exceptions import DomainError

from polhode.algebra._expression import ONE, Expr
from polhode.algebra._factored import content, over_cosines, rational
from polhode.algebra._ring import Polynomial
from polhode.algebra._roots import Root, is_positive
from polhode.algebra._squares import in_shortest_squares


@dataclass(frozen=True)
class Radicals:
    """number · √radicand^power · Π |size|^power · Π loose root^power."""

    number: Rational
    radicand: Expr
    power: int
    sizes: dict[Expr, int]
    loose: dict[Root, int]


def gathered(number: Rational, roots: Mapping[Root, int]) -> Radicals:
    """The roots of a term, as far as their product is a root whatever the signs.

    That is so for all whose radicands are positive, and one of unknown sign.
    """
    absolute = {root: absolute_of(root) for root in roots}
    sizes = {f: roots[root] for root, f in absolute.items() if f is not None}
    plain = {root: p for root, p in roots.items() if absolute[root] is None}
    safe = {root: p for root, p in plain.items() if is_positive(root.radicand)}
    loose = {root: p for root, p in plain.items() if root not in safe}
    if list(loose.values()) == [1]:
        safe, loose = safe | loose, {}
    power = max(safe.values(), default=0)
    radicand = ONE
    for root, exponent in safe.items():
        radicand = radicand * root.radicand ** (exponent * power)
    if power > 0:
        radicand, sizes = _with_sizes_below(radicand, sizes)
        number, radicand = _with_number_below(number, radicand)
    return Radicals(number, radicand, power, sizes, loose)


def _with_sizes_below(radicand: Expr, sizes: dict[Expr, int]) -> tuple[Expr, dict[Expr, int]]:
    """√(q r)/|q| is √(r/q)."""
    kept = {}
    for size, exponent in sizes.items():
        if exponent == -1 and (radicand / size).is_polynomial:
            radicand = radicand / size**2
        else:
            kept[size] = exponent
    return radicand, kept


def _with_number_below(number: Rational, radicand: Expr) -> tuple[Rational, Expr]:
    """√(2g)/2 is √(g/2)."""
    inside = content(rational(c) for c in radicand.num.coeffs()).numerator
    shared = gcd(inside, number.denominator)
    if shared == 1 or radicand.rational is not None:
        return number, radicand
    return number * shared, radicand / shared**2


@lru_cache(maxsize=1024)
def absolute_of(root: Root) -> Expr | None:
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
