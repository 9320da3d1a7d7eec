"""Other forms of one polynomial: cos² written for sin² where that is shorter."""

from __future__ import annotations

from collections import defaultdict
from typing import Any

from polhode.algebra._generators import Generator
from polhode.algebra._ring import Monomial, Polynomial, Ring


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
    position = ring.index[odd]
    square = sign * (ring.variable(even) ** 2 - 1)
    parts: dict[int, dict[Monomial, Any]] = defaultdict(dict)
    for monomial, coefficient in polynomial.to_dict().items():
        power, rest = divmod(monomial[position], 2)
        parts[power][(*monomial[:position], rest, *monomial[position + 1 :])] = coefficient
    return sum(
        (ring.context.from_dict(part) * square**power for power, part in parts.items()), ring.zero
    )
