"""Squares of sines or of cosines, whichever is shorter, decided for every cofactor."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Sequence
from math import comb
from typing import Any

from polhode.algebra._generators import Generator
from polhode.algebra._ring import Monomial, Polynomial, Ring

#: Coefficients by half the powers of (odd, even).
Binary = dict[tuple[int, int], Any]


def in_shortest_squares(ring: Ring, polynomial: Polynomial) -> Polynomial:
    """The form with fewest terms: I₁ sin²θ + I₃ cos²θ for I₃ + (I₁ - I₃) sin²θ.

    The choice is made anew for everything that stands with a square; the result is in general
    not reduced. Among equals one sign is preferred: 1 + 4 cos²θ for 5 - 4 sin²θ.
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
    position = ring.index[odd]
    cofactors: dict[Monomial, dict[int, Any]] = defaultdict(dict)
    for monomial, coefficient in polynomial.to_dict().items():
        half, rest = divmod(monomial[position], 2)
        cofactor = (*monomial[:position], rest, *monomial[position + 1 :])
        cofactors[cofactor][half] = coefficient
    squares = ring.variable(odd) ** 2, ring.variable(even) ** 2
    result = ring.zero
    for cofactor, halves in cofactors.items():
        parts = [halves.get(k, 0) for k in range(max(halves) + 1)]
        best = min((form(parts, sign) for form in _FORMS), key=_length)
        square = sum(
            (c * squares[0] ** odds * squares[1] ** evens for (odds, evens), c in best.items()),
            ring.zero,
        )
        result += ring.context.from_dict({cofactor: 1}) * square
    return result


def _length(form: Binary) -> tuple[int, int]:
    """Terms in all, and those that break the common sign."""
    signs = [coefficient > 0 for coefficient in form.values() if coefficient != 0]
    return len(signs), min(sum(signs), len(signs) - sum(signs))


def _in_odd(parts: Sequence[Any], sign: int) -> Binary:
    return {(k, 0): part for k, part in enumerate(parts)}


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


_FORMS: tuple[Callable[[Sequence[Any], int], Binary], ...] = (_in_odd, _in_even, _in_both)
