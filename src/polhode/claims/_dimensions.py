"""Whether all terms of a claim have one dimension, as far as the declaration tells."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction

from polhode.algebra import Expr, Generator, Symbol
from polhode.base import PURE, TIME, Dimension, PolhodeError
from polhode.claims._asked import Asked
from polhode.claims._components import Component

Known = Mapping[Symbol, Dimension]


def dimensions_at_odds(asked: Asked) -> str:
    """The members whose terms have different dimensions, in words; empty where there are none."""
    try:
        known = asked.equations.dimensions
    except PolhodeError:
        return ""
    odd = {c.member: found for c in asked.components() if (found := _dimensions(c, known))}
    told = (f"{_listed(found)} in member {member + 1}" for member, found in odd.items())
    return f"terms of different dimensions: {'; '.join(told)}" if odd else ""


def _listed(found: tuple[Dimension, ...]) -> str:
    return " and ".join(sorted(map(str, found)))


def _dimensions(component: Component, known: Known) -> tuple[Dimension, ...]:
    """The dimensions of a component's terms, where they are not all the same."""
    every = [d for side in (component.left, component.right) for d in _terms(side, known)]
    found = tuple(dict.fromkeys(every))
    return found if len(found) > 1 else ()


def _terms(side: Expr, known: Known) -> Iterator[Dimension]:
    """Of every term of which the dimension is known, over the first term below."""
    below = next((_dimension(powers, known) for powers, _ in side.denominator.terms()), PURE)
    for powers, _ in side.numerator.terms():
        above = _dimension(powers, known)
        if above is not None and below is not None:
            yield above / below


def _dimension(powers: Mapping[Generator, int], known: Known) -> Dimension | None:
    """Of a product of powers; None where it has a letter of unknown dimension."""
    whole = PURE
    for generator, power in powers.items():
        found = _of(generator, known)
        if found is None:
            return None
        whole = whole * found**power
    return whole


def _of(generator: Generator, known: Known) -> Dimension | None:
    if isinstance(generator, Symbol):
        base = PURE if generator.name == "pi" else known.get(generator.base())
        return None if base is None else base / TIME**generator.order
    if not generator.depth or generator.partner() is not None:
        return PURE
    inside = next(iter(generator.arguments[0].numerator.terms()))[0]
    found = _dimension(inside, known)
    return None if found is None else found ** Fraction(1, 2)
