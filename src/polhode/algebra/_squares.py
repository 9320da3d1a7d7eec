"""Squares of sines or of cosines, whichever is shorter, decided for every cofactor."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from math import comb
from typing import Any

from polhode.algebra._arrange import is_constant
from polhode.algebra._generators import Generator
from polhode.algebra._ring import Monomial, Polynomial, Ring

#: Coefficients by half the powers of (odd, even).
Binary = dict[tuple[int, int], Polynomial]


def in_shortest_squares(ring: Ring, polynomial: Polynomial) -> Polynomial:
    """The form with fewest terms: I₁ sin²θ + I₃ cos²θ for I₃ + (I₁ - I₃) sin²θ.

    Among equals one sign is preferred: 1 + 4 cos²θ for 5 - 4 sin²θ.

    The choice is made anew for everything that stands with a square; the result is in general
    not reduced.
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
    varies = [g in (even, odd) or not is_constant(g) for g in ring.generators]
    position = ring.index[odd]
    cofactors: dict[Monomial, dict[int, dict[Monomial, Any]]] = defaultdict(
        lambda: defaultdict(dict)
    )
    for monomial, coefficient in polynomial.to_dict().items():
        half, rest = divmod(monomial[position], 2)
        kept = (*monomial[:position], rest, *monomial[position + 1 :])
        pairs = list(zip(kept, varies, strict=True))
        inner = tuple(0 if v else p for p, v in pairs)
        cofactors[tuple(p if v else 0 for p, v in pairs)][half][inner] = coefficient
    squares = ring.variable(odd) ** 2, ring.variable(even) ** 2
    result = ring.zero
    for outer, halves in cofactors.items():
        parts = [ring.context.from_dict(halves.get(k, {})) for k in range(max(halves) + 1)]
        best = min((form(parts, sign) for form in _FORMS), key=_length)
        factor = ring.context.from_dict({outer: 1})
        for (odds, evens), part in best.items():
            result += factor * part * squares[0] ** odds * squares[1] ** evens
    return result


def _length(form: Binary) -> tuple[int, int]:
    """Terms in all, and those that break the common sign."""
    signs = [coefficient > 0 for part in form.values() for coefficient in part.coeffs()]
    return len(signs), min(sum(signs), len(signs) - sum(signs))


def _in_odd(parts: Sequence[Polynomial], sign: int) -> Binary:
    return {(k, 0): part for k, part in enumerate(parts)}


def _in_even(parts: Sequence[Polynomial], sign: int) -> Binary:
    """odd² = sign · (even² - 1)."""
    return {
        (0, m): sum(comb(k, m) * (-1) ** (k - m) * sign**k * parts[k] for k in range(m, len(parts)))
        for m in range(len(parts))
    }


def _in_both(parts: Sequence[Polynomial], sign: int) -> Binary:
    """1 = even² - sign · odd², until all terms have one degree."""
    top = len(parts) - 1
    return {
        (j, top - j): sum(
            comb(top - k, j - k) * (-sign) ** (j - k) * parts[k] for k in range(j + 1)
        )
        for j in range(top + 1)
    }


_FORMS: tuple[Callable[[Sequence[Polynomial], int], Binary], ...] = (_in_odd, _in_even, _in_both)
