"""Search for integrals polynomial in the speeds, with trigonometric coefficients.

The unknown coefficients solve a linear system. Its solutions are first found at random rational
parameters and points, which shows the few monomials that matter; with those the system is solved
exactly, parameters and all.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations_with_replacement
from random import Random

from flint import fmpq_mat

from polhode.algebra import (
    ONE,
    ZERO,
    Expr,
    Generator,
    Kind,
    Row,
    Symbol,
    cos,
    eliminate,
    sin,
    time,
    variables,
)
from polhode.analyse._points import Point, random_values
from polhode.analyse._reduced import reduced
from polhode.base import NumericError
from polhode.derive import Equations


@dataclass(frozen=True)
class Ansatz:
    """What a first integral may be made of.

    Attributes:
        speeds: highest degree in the speeds.
        trigonometric: highest degree in sines and cosines of angles.
        lengths: highest degree in coordinates that are no angles.
    """

    speeds: int = 2
    trigonometric: int = 2
    lengths: int = 1

    def describe(self) -> str:
        """In words."""
        return (
            f"polynomials of degree {self.speeds} in the speeds, {self.trigonometric} in sines and "
            f"cosines of essential angles and {self.lengths} in lengths, and time"
        )


def search(equations: Equations, ansatz: Ansatz) -> Iterator[Expr]:
    """Integrals within the ansatz, simple ones first; none for driven systems."""
    try:
        essential = reduced(equations).essential
    except NumericError:
        return
    monomials = _monomials(equations, essential, ansatz)
    rates = [equations.rate(m) for m in monomials]
    moving = [(m, r) for m, r in zip(monomials, rates, strict=True) if not m.rational]
    for support in _supports([rate for _, rate in moving]):
        chosen = [moving[i] for i in support]
        coefficients = _coefficients([rate for _, rate in chosen])
        if coefficients is not None:
            terms = (c * m for c, (m, _) in zip(coefficients, chosen, strict=True))
            yield sum(terms, ZERO)


def _monomials(equations: Equations, essential: tuple[Symbol, ...], ansatz: Ansatz) -> list[Expr]:
    angles = [q for q in essential if _is_angle(equations, q)]
    lengths = [q for q in equations.coordinates if not _is_angle(equations, q)]
    waves = _waves([Expr.generator(angle) for angle in angles], ansatz.trigonometric)
    places = _products([Expr.generator(q) for q in lengths], ansatz.lengths)
    speeds = _products([Expr.generator(u) for u in equations.speeds], ansatz.speeds)
    found = dict.fromkeys(u * w for u in speeds for w in waves)
    found.update(dict.fromkeys([*places, time]))
    return list(found)


def _waves(angles: Sequence[Expr], degree: int) -> list[Expr]:
    """Products of sines and cosines; cos² is left out, being 1 - sin²."""
    found = {0: [ONE]}
    for angle in angles:
        s, c = sin(angle), cos(angle)
        own = [(j + i, s**j * c**i) for i in (0, 1) for j in range(degree + 1 - i)]
        wider: dict[int, list[Expr]] = {}
        for power, waves in found.items():
            for extra, wave in own:
                if power + extra <= degree:
                    wider.setdefault(power + extra, []).extend(w * wave for w in waves)
        found = wider
    return [wave for waves in found.values() for wave in waves]


def _products(factors: Sequence[Expr], degree: int) -> list[Expr]:
    found = [ONE]
    for size in range(1, degree + 1):
        for chosen in combinations_with_replacement(factors, size):
            product = ONE
            for factor in chosen:
                product = product * factor
            found.append(product)
    return found


def _is_angle(equations: Equations, coordinate: Symbol) -> bool:
    return str(equations.dimensions.get(coordinate, "")) == "1"


def _supports(rates: Sequence[Expr]) -> Iterator[list[int]]:
    """Positions of the monomials in each independent solution, at random parameters."""
    symbols = sorted(variables(rates), key=lambda s: (s.kind is Kind.PARAMETER, s.published))
    varying = sum(s.kind is not Kind.PARAMETER for s in symbols)
    random = Random(7)
    constants = random_values(symbols[varying:], random)
    rows = [
        Point({**random_values(symbols[:varying], random), **constants}).all(rates)
        for _ in range(len(rates) + 4)
    ]
    echelon, rank = fmpq_mat(rows).rref()
    columns = range(len(rates))
    pivots = [next(j for j in columns if echelon[i, j] != 0) for i in range(rank)]
    for free in (j for j in columns if j not in pivots):
        used = [pivots[i] for i in range(rank) if echelon[i, free] != 0]
        yield sorted([*used, free])


def _is_constant(generator: Generator) -> bool:
    return all(s.kind is Kind.PARAMETER for s in generator.symbols())


def _coefficients(rates: Sequence[Expr]) -> Row | None:
    """Constants, of the parameters alone, with which the rates add up to zero."""
    common = ONE
    for rate in rates:
        if (common / rate.denominator).denominator != ONE:
            common = common * rate.denominator
    table: dict[frozenset[tuple[Generator, int]], list[Expr]] = defaultdict(
        lambda: [ZERO] * len(rates)
    )
    for column, rate in enumerate(rates):
        scaled = rate * common
        for powers, number in scaled.terms():
            key = frozenset((g, p) for g, p in powers.items() if not _is_constant(g))
            constant = {g: p for g, p in powers.items() if _is_constant(g)}
            table[key][column] = table[key][column] + _term(constant, number)
    outcome = eliminate(list(table.values()), [ZERO] * len(table), [0] * len(rates))
    if len(outcome.free) != 1:
        return None
    (free,) = outcome.free
    values = [ONE if j == free else outcome.solved[j][0][0] for j in range(len(rates))]
    scale = ONE
    for value in values:
        scale = scale * (value * scale).denominator
    return tuple(value * scale for value in values)


def _term(powers: dict[Generator, int], number: Fraction) -> Expr:
    result = Expr.constant(number)
    for generator, power in powers.items():
        result = result * Expr.generator(generator) ** power
    return result
