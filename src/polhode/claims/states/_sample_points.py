"""Many states by numbers, at which to see quickly whether relations can hold."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from itertools import islice

import numpy as np

from polhode.algebra import Expr, Symbol, variables
from polhode.base import PolhodeError
from polhode.claims.states._claim_domain import ClaimDomain
from polhode.claims.states._numeric import Array, Rational, number, numbers, rationals
from polhode.claims.states._points import points

_STATES = 6
_TRIES = 40
_PI = Symbol("pi")


class SymbolValues(dict[Symbol, float]):
    """The number of every symbol at one state, found when first asked for.

    Args:
        free: of those that the circumstances leave open.
        states: the circumstances.
        seed: of the others that they leave open.
    """

    def __init__(self, free: Mapping[Symbol, float], states: ClaimDomain, seed: int) -> None:
        super().__init__(free)
        self._free = dict(self)
        self._states = states
        self._seed = seed

    def __missing__(self, symbol: Symbol) -> float:
        image = self._states.of(symbol)
        unheard = image.symbols() - self._free.keys() - {_PI}
        self._free |= points((), unheard, self._seed + len(self._free)).floats()
        self[symbol] = number(image, self._free)
        return self[symbol]


@dataclass(frozen=True, eq=False)
class SamplePoints:
    """Several states that circumstances allow.

    Attributes:
        states: the number of every symbol, state by state.
    """

    states: tuple[SymbolValues, ...]

    def values(self, expressions: Sequence[Expr]) -> Array:
        """Values of expressions: (expressions, states); not a number where there is none."""
        columns = self._columns(variables(expressions) - {_PI})
        return numbers(expressions, columns, (self.size,))

    @property
    def size(self) -> int:
        """How many states there are."""
        return len(self.states)

    def function(self, expressions: Sequence[Expr], unknown: Symbol) -> Callable[[Array], Array]:
        """Values of expressions as a function of one symbol that no state fixes, state by state."""
        columns = self._columns(variables(expressions) - {_PI, unknown})
        shape = (self.size,)
        found = rationals(expressions, unknown, columns, shape)
        if found is None:
            return lambda at: numbers(expressions, {**columns, unknown: at}, at.shape)
        return partial(_evaluated, found)

    def _columns(self, symbols: Iterable[Symbol]) -> dict[Symbol, Array]:
        return {symbol: self._column(symbol) for symbol in symbols}

    def _column(self, symbol: Symbol) -> Array:
        if symbol not in self._known:
            self._known[symbol] = np.array([state[symbol] for state in self.states])
        return self._known[symbol]

    @cached_property
    def _known(self) -> dict[Symbol, Array]:
        return {}


def _evaluated(found: Sequence[Rational], at: Array) -> Array:
    with np.errstate(all="ignore"):
        return np.array([function(at) for function in found]).reshape(len(found), *at.shape)


def bench(states: ClaimDomain, expressions: Iterable[Expr]) -> SamplePoints:
    """States with independent numbers for everything the circumstances leave open."""
    return SamplePoints(tuple(islice(real_states(states, expressions), _STATES)))


def real_states(states: ClaimDomain, expressions: Iterable[Expr]) -> Iterator[SymbolValues]:
    """One such state after another, as long as some of the first ones drawn are real."""
    used = [states.on(e) for e in expressions]
    used += [*states.settled_relations, *states.signs]
    used += list(states.equations.accelerations.values())
    equations = states.equations
    symbols = {s for e in used for s in e.symbols()}
    symbols |= {*equations.coordinates, *equations.speeds, *equations.parameters}
    seeds = range(1000, 1000 + _TRIES)
    every = (SymbolValues(points(used, symbols, seed).floats(), states, seed) for seed in seeds)
    return (found for found in every if _is_real(found, states, symbols))


def _is_real(state: SymbolValues, states: ClaimDomain, symbols: Iterable[Symbol]) -> bool:
    ordered = tuple(symbols)
    try:
        settled = numbers([states.of(s) for s in ordered], state, ())
        positive = numbers([states.on(e) for e in states.signs], state, ()) > 0
    except (PolhodeError, ArithmeticError, ValueError, KeyError):
        return False
    state.update(zip(ordered, settled.tolist(), strict=True))
    return bool(positive.all() and np.isfinite(settled).all())
