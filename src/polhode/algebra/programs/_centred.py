"""Sums about the place that an exponent is counted from.

The second derivative of exp(−(t − c)²/w²) has the factor 2(t − c)² − w². Multiplied out, as
2t² − 4ct + 2c² − w², it loses the digits of t²/w².
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from polhode.algebra._expression import Expr
from polhode.algebra._generators import Symbol, SymbolKind
from polhode.algebra._linear import length
from polhode.algebra._roots import factors


class Centred(NamedTuple):
    """An expression by a distance.

    Attributes:
        expression: with the distance as a symbol.
        distance: that symbol.
        meaning: what the distance is.
    """

    expression: Expr
    distance: Symbol
    meaning: Expr


def centred(factor: Expr, exponent: Expr) -> Centred | None:
    """The factor of an exp by a distance of which the exponent has a power.

    None where that is not shorter.
    """
    ways = (_about(factor, *place) for place in _places(exponent))
    best = min(ways, key=lambda way: length(way.expression), default=None)
    return best if best is not None and length(best.expression) < length(factor) else None


def _places(exponent: Expr) -> Iterator[tuple[Symbol, Expr]]:
    """Sums that the exponent has as factors, with what they are linear in."""
    for meaning, power in factors(exponent)[1].items():
        if power > 0 and len(meaning.num) > 1:
            for symbol in meaning.symbols():
                if not meaning.diff(symbol).generators:
                    yield symbol, meaning


def _about(factor: Expr, symbol: Symbol, meaning: Expr) -> Centred:
    distance = Symbol(f"({meaning.key})", SymbolKind.PARAMETER)
    away = (Expr.generator(distance) - meaning) / meaning.diff(symbol)
    return Centred(factor.subs({symbol: Expr.generator(symbol) + away}), distance, meaning)
