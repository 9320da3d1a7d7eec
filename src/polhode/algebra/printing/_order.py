"""The order in which a textbook writes the factors of a term and the terms of a sum."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache

from polhode.algebra._functions import Elementary, Even
from polhode.algebra._lengths import KeptSum, Length
from polhode.algebra._parts import Lettered
from polhode.algebra._ring import Generator, Monomial, Ring, Symbol, SymbolKind
from polhode.algebra.printing._names import Spelling

Rank = tuple[object, ...]

_MASSES, _INERTIAS, _GRAVITY = ("m", "M"), ("I",), ("g",)

# Ranks among the factors: 0 numbers, 1 constants, 2 variables, 3 functions, 4 and 5 roots, 6 sums.
CONSTANT_SUM: Rank = (1, 1)
VARYING_SUM: Rank = (6,)
EXPONENTIAL: Rank = (3,)


@lru_cache(maxsize=4096)
def is_constant(generator: Generator) -> bool:
    """Whether it depends on parameters alone."""
    return all(s.kind is SymbolKind.PARAMETER for s in generator.symbols())


@lru_cache(maxsize=4096)
def factor_rank(generator: Generator) -> Rank:
    """Numbers, then parameters, then what varies, then functions: m g a θ̇ sin θ."""
    if isinstance(generator, Symbol):
        if generator.kind is not SymbolKind.PARAMETER:
            return (2, _level(generator), generator.kind is not SymbolKind.SPEED, _place(generator))
        stem = Spelling.of(generator).stem
        families = ("pi",), _MASSES, _INERTIAS, _GRAVITY
        family = next((i for i, stems in enumerate(families) if stem in stems), len(families))
        return (1, 0, family, _place(generator))
    if isinstance(generator, KeptSum):
        names = sorted(_place(s) for s in generator.symbols())
        return (*(CONSTANT_SUM if is_constant(generator) else VARYING_SUM), names, generator.key)
    if isinstance(generator, Lettered):
        return (1, 3, generator.letter)
    if isinstance(generator, Elementary):
        names = sorted(_place(s) for s in generator.symbols())
        return (3, names, generator.family.sign, isinstance(generator, Even), generator.key)
    return radical_rank(tuple(generator.symbols()), generator.key)


def radical_rank(inside: Sequence[Generator], key: str = "") -> Rank:
    """Rank of a root: of a number first, of constants after these, any other last."""
    if not inside:
        return (0, key)
    return (1, 2, key) if all(map(is_constant, inside)) else (4, key)


def absolute_value_rank(inside: Iterable[Generator]) -> Rank:
    """Rank of an absolute value: after the roots, in the order of its contents."""
    return (5, sorted(map(factor_rank, inside)))


def _place(symbol: Symbol) -> Rank:
    return (*Spelling.of(symbol).place, symbol.order)


def term_rank(powers: Mapping[Generator, int]) -> Rank:
    """Highest time derivative first, then higher degree in speeds, then the rest."""
    rates = [(level, p) for g, p in powers.items() if (level := _level_of(g)) > 0]
    return (
        *_by_rates(rates, powers.values()),
        sorted((factor_rank(g), -p) for g, p in powers.items()),
    )


@dataclass(frozen=True)
class TermOrder:
    """The order of `term_rank` for the monomials of one ring.

    Attributes:
        varying: positions of the generators that vary in time.
        constant: positions of the others.
        kept: positions of lengths, and of sums that are kept as they stand.
        levels: time derivatives, 0 for all but velocities and accelerations.
        places: of the generators among the factors of a term.
    """

    varying: tuple[int, ...]
    constant: tuple[int, ...]
    kept: tuple[int, ...]
    levels: tuple[int, ...]
    places: tuple[int, ...]

    def rank(self, monomial: Monomial) -> Rank:
        """The rank of a term."""
        powers = [(i, int(p)) for i, p in enumerate(monomial) if p]
        rates = [(level, p) for i, p in powers if (level := self.levels[i])]
        factors = sorted((self.places[i], -p) for i, p in powers)
        return (*_by_rates(rates, [p for _, p in powers]), factors)


@lru_cache(maxsize=256)
def term_order(ring: Ring) -> TermOrder:
    """The order of terms over the generators of a ring."""
    generators = ring.generators
    ordered = sorted(range(len(generators)), key=lambda i: factor_rank(generators[i]))
    places = {i: place for place, i in enumerate(ordered)}
    constant = [is_constant(g) for g in generators]
    return TermOrder(
        tuple(i for i, c in enumerate(constant) if not c),
        tuple(i for i, c in enumerate(constant) if c),
        tuple(i for i, g in enumerate(generators) if isinstance(g, KeptSum | Length)),
        tuple(map(_level_of, generators)),
        tuple(places[i] for i in range(len(generators))),
    )


def _by_rates(rates: Sequence[tuple[int, int]], powers: Iterable[int]) -> Rank:
    """By the levels and powers of the rates in a term, then by its degree."""
    highest = max((level for level, _ in rates), default=0)
    return (
        -highest if highest > 1 else 0,
        -sum(p * level for level, p in rates),
        -max((p for _, p in rates), default=0),
        sum(map(abs, powers)),
    )


def _level_of(generator: Generator) -> int:
    return _level(generator) if isinstance(generator, Symbol) else 0


def _level(symbol: Symbol) -> int:
    """0 for a coordinate, 1 for a velocity, 2 for an acceleration."""
    if symbol.kind in (SymbolKind.PARAMETER, SymbolKind.TIME):
        return 0
    return symbol.order + (symbol.kind is SymbolKind.SPEED)
