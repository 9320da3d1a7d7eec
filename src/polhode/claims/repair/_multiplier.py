"""By what a place in a formula would have to be multiplied for the claim to hold."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product

import numpy as np

from polhode.claims._numeric import Array
from polhode.claims.latex._tree import Node

_CLOSE = 1e-8
_STEPS = 25
_LARGEST = 60
_TRIED = (Fraction(-1), *(Fraction(n, d) for n in range(1, 5) for d in range(1, 5) if n != d))


@dataclass(frozen=True, eq=False)
class Response:
    """How what must vanish changes with a factor put at a place.

    Attributes:
        changing: those rows that may change, (rows, trials, states), by the factor in every trial
            at every state.
        rows: which of all they are.
        before: all rows as they are: (rows, states).
    """

    changing: Callable[[Array], Array]
    rows: tuple[int, ...]
    before: Array

    def __call__(self, factors: Array) -> Array:
        """The changing rows, with arithmetic that may fail at a state."""
        with np.errstate(all="ignore"):
            return self.changing(factors)

    def at(self, numbers: Sequence[float]) -> Array:
        """The changing rows for factors that are the same at all states."""
        return self(np.outer(numbers, np.ones(self.states)))

    @property
    def states(self) -> int:
        """At how many states it is known."""
        return int(self.before.shape[1])

    @property
    def is_faithful(self) -> bool:
        """Whether a factor one changes nothing."""
        now, known = self.at([1.0])[:, 0], self.before[list(self.rows)]
        return now.shape == known.shape and np.allclose(now, known, rtol=_CLOSE, atol=_CLOSE)

    def slope(self) -> Array | None:
        """Change of all rows per unit of the factor, where that is the same for any factor."""
        one, two, three = np.moveaxis(self.at([1.0, 2.0, 3.0]), 1, 0)
        change = two - one
        straight = np.abs(three - two - change) <= _CLOSE * (np.abs(one) + np.abs(three))
        if not np.isfinite(change).all() or not straight.all() or not change.any():
            return None
        whole = np.zeros_like(self.before)
        whole[list(self.rows)] = change
        return whole


def multiplier(response: Response) -> Array | None:
    """The factor at every state at which all vanishes, by secants from one; None if there is none.

    A residual that no factor changes must vanish already.
    """
    here, there = np.moveaxis(response.at([1.0, 1.25]), 1, 0)
    at, before = np.full(response.states, 1.0), np.full(response.states, 1.25)
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
        here = response(at[None])[:, 0]
        if (np.abs(step) < 1e-14 * (1 + np.abs(at))).all():
            break
    scale = size.max(axis=1, keepdims=True) + np.abs(at)
    vanishes = np.isfinite(here).all() and (np.abs(here) <= _CLOSE * scale).all()
    return at if vanishes else None


def simple_numbers(response: Response) -> Iterator[Fraction]:
    """The simple factors at which all vanishes; what is not linear may have several."""
    one, *left = np.moveaxis(response.at([1.0, *map(float, _TRIED)]), 1, 0)
    size = np.abs(one).max(axis=1, keepdims=True)
    for number, rows in zip(_TRIED, left, strict=True):
        if np.isfinite(rows).all() and (np.abs(rows) <= _CLOSE * (size + 1)).all():
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
