"""Whether inequalities say the same as exact conditions: a proof, or a state that parts them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, reduce
from itertools import product
from math import pi, prod

import numpy as np

from polhode.algebra import Expr, Symbol, SymbolKind, variables
from polhode.base import PolhodeError
from polhode.claims.states._claim_domain import ClaimDomain
from polhode.claims.states._numeric import Array, number
from polhode.claims.states._physical import demanded, is_physical
from polhode.claims.states._signs import definite_sign, strict_sign

_SAMPLES = 40
_DRAWN = 4000
_DECADES = 3.0
_STEPS = 240
_BESIDE = 1e-5
_PI = Symbol("pi")


@dataclass(frozen=True)
class PrintedBound:
    """One side greater than the other."""

    greater: Expr
    less: Expr


@dataclass(frozen=True)
class Comparison:
    """Inequalities of a text set against conditions of the model, all of them together.

    Attributes:
        claimed: the inequalities, on the states.
        conditions: what has to be positive there.
        states: where they are compared, of bodies that can be.
        sizes: speeds in which the conditions are even: their magnitudes are meant.
    """

    claimed: tuple[PrintedBound, ...]
    conditions: tuple[Expr, ...]
    states: ClaimDomain
    sizes: frozenset[Symbol]

    # -- proof ----------------------------------------------------------------------------------

    @cached_property
    def is_proved(self) -> bool:
        """Whether each condition follows from the inequalities, and the reverse, by their signs."""
        given = [tuple(_forms(bound, self._signs)) for bound in self._claimed]
        if not all(given):
            return False
        return any(self._is_proved(forms) for forms in product(*given))

    def _is_proved(self, forms: Sequence[Expr]) -> bool:
        claims = all(self._follows(c, forms) for c in self._conditions)
        return claims and all(self._follows(f, self._conditions) for f in forms)

    def _follows(self, wanted: Expr, known: Sequence[Expr]) -> bool:
        """Whether something is positive where others are."""
        return strict_sign(wanted, self._signs) == 1 or any(
            self._is_more(wanted, each) for each in known
        )

    def _is_more(self, wanted: Expr, known: Expr) -> bool:
        """Whether it is a positive multiple of what is positive, and something not negative."""
        if strict_sign(wanted / known, self._signs) == 1:
            return True
        bars = (wanted.denominator, known.denominator)
        if any(strict_sign(bar, self._signs) != 1 for bar in bars):
            return False
        above, below = wanted.numerator, known.numerator
        ratios = (one / other for one, other in product(_monomials(above), _monomials(below)))
        return any(
            strict_sign(ratio, self._signs) == 1 and definite_sign(rest, self._signs) == 1
            for ratio in dict.fromkeys(ratios)
            if (rest := above - ratio * below)
        )

    @cached_property
    def _positive(self) -> dict[Symbol, Expr]:
        """Speeds of which the magnitude is meant, by letters for that."""
        named = ((s, Symbol(f"{s.published}_size", positive=True)) for s in self.sizes)
        return {s: Expr.generator(size) for s, size in named}

    @cached_property
    def _claimed(self) -> tuple[PrintedBound, ...]:
        sized = self._positive
        return tuple(PrintedBound(b.greater.subs(sized), b.less.subs(sized)) for b in self.claimed)

    @cached_property
    def _conditions(self) -> tuple[Expr, ...]:
        return tuple(c.subs(self._positive) for c in self.conditions)

    @cached_property
    def _signs(self) -> tuple[Expr, ...]:
        return tuple(e.subs(self._positive) for e in self.states.signs)

    # -- refutation -----------------------------------------------------------------------------

    def agree(self, values: Mapping[Symbol, Array | float]) -> Array:
        """1 where both are met or neither is, 0 where one is, nan where nothing can be said."""
        with np.errstate(all="ignore"):
            sides = [(number(b.greater, values), number(b.less, values)) for b in self.claimed]
            exact = [number(c, values) for c in self.conditions]
            allowed = np.asarray(is_physical(self.states, values))
            for size in self.sizes:
                allowed = allowed & (np.asarray(values[size]) > 0)
            for value in (*(v for pair in sides for v in pair), *exact):
                allowed = allowed & np.isfinite(value)
            said = reduce(np.logical_and, (a > b for a, b in sides))
            true = reduce(np.logical_and, (c > 0 for c in exact))
        alike = np.asarray(said == true, dtype=float)
        return np.asarray(np.where(allowed, alike, np.nan))

    @cached_property
    def symbols(self) -> tuple[Symbol, ...]:
        """All that takes a number."""
        sides = (side for bound in self.claimed for side in (bound.greater, bound.less))
        found = {*variables([*sides, *self.conditions]), *demanded(self.states)} - {_PI}
        return tuple(sorted(found, key=lambda s: s.published))

    @cached_property
    def parting(self) -> dict[Symbol, float] | None:
        """Numbers of a state that one allows and the other does not; None where none is found."""
        for start in self._starts:
            for symbol in self._spoken:
                found = self._beside(start, symbol)
                if found is not None:
                    return found
        return None

    @property
    def was_tried(self) -> bool:
        """Whether there was any state to compare them at."""
        return bool(self._starts)

    @cached_property
    def _spoken(self) -> tuple[Symbol, ...]:
        sides = (side for bound in self.claimed for side in (bound.greater, bound.less))
        return tuple(sorted(variables([*sides, *self.conditions]) - {_PI}, key=lambda s: s.name))

    @cached_property
    def _starts(self) -> tuple[dict[Symbol, float], ...]:
        """States of bodies that can be, of all sizes."""
        random = np.random.default_rng(1)
        drawn = {s: self._drawn(s, random) for s in self.symbols}
        known = np.flatnonzero(np.isfinite(self.agree(drawn)))[:_SAMPLES]
        return tuple({s: float(values[i]) for s, values in drawn.items()} for i in known)

    def _drawn(self, symbol: Symbol, random: np.random.Generator) -> Array:
        size = np.asarray(10 ** random.uniform(-1, 1, _DRAWN))
        if symbol.positive or symbol in self.sizes:
            return size
        if symbol.kind is SymbolKind.COORDINATE and not symbol.order:
            return np.asarray(random.uniform(-pi, pi, _DRAWN))
        return np.asarray(size * random.choice([-1, 1], _DRAWN))

    def _beside(self, start: Mapping[Symbol, float], symbol: Symbol) -> dict[Symbol, float] | None:
        """A parting state on the way through a start on which one number changes."""
        way = start[symbol] * 10 ** np.linspace(-_DECADES, _DECADES, _STEPS)
        if not symbol.positive and symbol not in self.sizes:
            way = np.concatenate((-way[::-1], way))
        every = [
            self.agree({**_spread(start, way), symbol: way * factor})
            for factor in (1 - _BESIDE, 1.0, 1 + _BESIDE)
        ]
        parted = np.flatnonzero(np.all(np.array(every) == 0, axis=0))
        if not len(parted):
            return None
        return {**start, symbol: float(way[parted[len(parted) // 2]])}


def _spread(start: Mapping[Symbol, float], way: Array) -> dict[Symbol, Array]:
    return {s: np.full(way.shape, value) for s, value in start.items()}


def _forms(bound: PrintedBound, signs: Sequence[Expr]) -> Iterator[Expr]:
    """What is positive where an inequality holds and only there.

    The difference of the sides, or of their squares where neither is negative, or neither
    positive.
    """
    above, below = bound.greater, bound.less
    if above != below:
        yield above - below
    senses = {_sense(side, signs) for side in (above, below) if side}
    squares = above * above - below * below
    if squares and len(senses) == 1 and senses != {0}:
        yield squares * senses.pop()


def _sense(side: Expr, signs: Sequence[Expr]) -> int:
    try:
        return definite_sign(side, signs)
    except PolhodeError:
        return 0


def _monomials(polynomial: Expr) -> Iterator[Expr]:
    for powers, coefficient in polynomial.terms():
        factors = (Expr.generator(g) ** power for g, power in powers.items())
        yield prod(factors, start=Expr.of(coefficient))
