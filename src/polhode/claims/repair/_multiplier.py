"""By what a place in a formula would have to be multiplied for the claim to hold."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.base import PolhodeError
from polhode.claims._numeric import Array
from polhode.claims.latex._tree import Name, Node, Statement
from polhode.claims.repair._places import Place, put, times
from polhode.claims.repair._reading import Reading
from polhode.claims.repair._trials import Trials

UNKNOWN = Symbol("multiplier")
_LETTER = "multiplier"
_CLOSE = 1e-8
_STEPS = 25
_LARGEST = 60
_TRIED = (Fraction(-1), *(Fraction(n, d) for n in range(1, 5) for d in range(1, 5) if n != d))


def response(
    statement: Statement,
    place: Place,
    reading: Reading,
    tried: Trials,
    members: Collection[int],
) -> Callable[[Array], Array] | None:
    """What must vanish for these members to hold, as a function of a factor put at a place."""
    changed = put(statement, place.path, times(Name(_LETTER), place.node))
    try:
        asked = reading.asked(changed, {_LETTER: Expr.generator(UNKNOWN)})
        residuals = [e for member, e in tried.residuals(asked) if member in members]
        return tried.bench.function(residuals, UNKNOWN) if residuals else None
    except (PolhodeError, ArithmeticError, KeyError):
        return None


def multiplier(function: Callable[[Array], Array], states: int) -> Array | None:
    """The factor at every state at which all vanishes, by secants from one; None if there is none.

    A residual that no factor changes must vanish already.
    """
    at, before = np.full(states, 1.0), np.full(states, 1.25)
    here, there = function(at), function(before)
    size = np.abs(here) + np.abs(there)
    row = int(np.argmax(np.abs(here - there).min(axis=1)))
    if not np.isfinite(here).all() or not np.abs(here - there)[row].all():
        return None
    for _ in range(_STEPS):
        with np.errstate(all="ignore"):
            step = here[row] * (at - before) / (here[row] - there[row])
        step = np.where(here[row] == 0, 0.0, step)
        if not np.isfinite(step).all():
            break
        before, there = at, here
        at = at - step
        here = function(at)
        if (np.abs(step) < 1e-14 * (1 + np.abs(at))).all():
            break
    scale = size.max(axis=1, keepdims=True) + np.abs(at)
    vanishes = np.isfinite(here).all() and (np.abs(here) <= _CLOSE * scale).all()
    return at if vanishes else None


def simple_numbers(function: Callable[[Array], Array], states: int) -> Iterator[Fraction]:
    """The simple factors at which all vanishes; what is not linear may have several."""
    size = np.abs(function(np.full(states, 1.0))).max(axis=1, keepdims=True)
    for number in _TRIED:
        left = function(np.full(states, float(number)))
        if np.isfinite(left).all() and (np.abs(left) <= _CLOSE * (size + 1)).all():
            yield number


@dataclass(frozen=True)
class Match:
    """A number times powers of known quantities that a factor equals at every state.

    Attributes:
        number: the number.
        powers: nodes and their powers.
    """

    number: Fraction
    powers: tuple[tuple[Node, int], ...] = ()

    @property
    def size(self) -> int:
        """How much it says: powers counted, and a number other than one."""
        number = self.number != 1
        return sum(abs(power) for _, power in self.powers) + number + (self.number.denominator > 1)


def simple_number(values: Array) -> Fraction | None:
    """The simple rational number that all values are, if they are."""
    first = float(values[0])
    if not np.ptp(values) <= _CLOSE * abs(first) + 1e-10:
        return None
    number = Fraction(first).limit_denominator(_LARGEST)
    close = abs(float(number) - first) <= _CLOSE * max(1.0, abs(first))
    return number if close and abs(number.numerator) <= _LARGEST else None


def matches(factor: Array, known: Sequence[tuple[Node, Array]]) -> Iterator[Match]:
    """Every simple product that equals a factor, the simplest first."""
    number = simple_number(factor)
    if number is not None:
        yield Match(number)
        return
    found = [*_singles(factor, known), *_pairs(factor, known)]
    yield from sorted(found, key=lambda match: match.size)


def _singles(factor: Array, known: Sequence[tuple[Node, Array]]) -> Iterator[Match]:
    for (node, values), power in product(known, (1, -1, 2, -2)):
        left = simple_number(factor / values**power)
        if left:
            yield Match(left, ((node, power),))


def _pairs(factor: Array, known: Sequence[tuple[Node, Array]]) -> Iterator[Match]:
    """Products of two quantities or their reciprocals, all tried at once."""
    if len(known) < 2:
        return
    values = np.array([v for _, v in known])
    table = np.concatenate([values, 1 / values])
    signed = [(node, 1) for node, _ in known] + [(node, -1) for node, _ in known]
    left = factor / (table[:, None, :] * table[None, :, :])
    constant = np.ptp(left, axis=2) <= _CLOSE * np.abs(left[:, :, 0])
    for i, j in zip(*np.nonzero(np.triu(constant, 1)), strict=True):
        number, (first, p), (second, q) = simple_number(left[i, j]), signed[i], signed[j]
        if number and first != second:
            yield Match(number, ((first, p), (second, q)))
