"""Products of letters that equal a quantity at every state."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from itertools import combinations_with_replacement

import numpy as np

from polhode.claims.latex._tree import Node
from polhode.claims.repair._multiplier import Match, simple_number
from polhode.claims.states._numeric import Array

_CLOSE = 1e-8
_MOST_LETTERS = 40
_MOST_TOGETHER = 3
_POWERS = (1, -1, 2, -2)


@dataclass(frozen=True, eq=False)
class Products:
    """Everything that can be formed of some letters, at the states of a bench.

    Attributes:
        known: letters with their values: (states,).
        upright: those that stand above a fraction line only.
    """

    known: Sequence[tuple[Node, Array]]
    upright: Collection[Node] = ()

    def equal_to(self, amount: Array) -> Iterator[Match]:
        """A number times products of letters, the shortest first.

        Up to two letters may stand above or below; more of them, up to six, above only.
        """
        yield from list(self.short(amount)) or sorted(self._long(amount), key=_size)

    def short(self, amount: Array) -> Iterator[Match]:
        """Those of up to two letters alone, the simplest first."""
        number = simple_number(amount)
        if number is not None:
            yield Match(number)
        elif self.known:
            yield from sorted([*self._singles(amount), *self._pairs(amount)], key=_size)

    # -- one letter or two -----------------------------------------------------------------------

    @cached_property
    def _values(self) -> Array:
        return np.array([values for _, values in self.known])

    def _singles(self, amount: Array) -> Iterator[Match]:
        for (i, j), number in _simple(amount, self._powered):
            if self._may_stand(self.known[i][0], _POWERS[j]):
                yield Match(number, ((self.known[i][0], _POWERS[j]),))

    def _may_stand(self, node: Node, power: int) -> bool:
        return power > 0 or node not in self.upright

    @cached_property
    def _powered(self) -> Array:
        """Powers of the letters."""
        return np.asarray(self._values[:, None] ** np.array(_POWERS, dtype=float)[None, :, None])

    @cached_property
    def _signed(self) -> list[tuple[Node, int]]:
        return [(node, power) for power in (1, -1) for node, _ in self.known]

    @cached_property
    def _table(self) -> Array:
        """Products of two of the letters or of their reciprocals."""
        table = np.concatenate([self._values, 1 / self._values])
        return np.asarray(table[:, None] * table[None])

    def _pairs(self, amount: Array) -> Iterator[Match]:
        for (i, j), number in _simple(amount, self._table):
            (first, p), (second, q) = self._signed[i], self._signed[j]
            allowed = self._may_stand(first, p) and self._may_stand(second, q)
            if allowed and i < j and first != second:
                yield Match(number, ((first, p), (second, q)))

    # -- more of them ----------------------------------------------------------------------------

    def _long(self, amount: Array) -> Iterator[Match]:
        """Met in the middle: what a few letters leave must be the product of a few others."""
        if len(amount) < _MOST_TOGETHER or not amount.all() or not self.known:
            return
        few = self._few
        for one, other in few.pairs(_without_number(np.log(np.abs(amount)))):
            letters = sorted(i for i in (*few.letters[one], *few.letters[other]) if i)
            number = simple_number(amount / np.prod(few.values[letters], axis=0))
            if number:
                counted = Counter(few.nodes[i] for i in letters)
                yield Match(number, tuple(counted.items()))

    @cached_property
    def _few(self) -> _Few:
        different = list({v.tobytes(): (n, v) for n, v in reversed(self.known)}.values())[::-1]
        kept = different[:_MOST_LETTERS]
        # a product of nothing stands first, so that shorter ones are among them
        values = np.array([np.ones_like(kept[0][1]), *(v for _, v in kept)])
        return _Few([kept[0][0], *(n for n, _ in kept)], values)


class _Few:
    """Products of a few letters by the logarithms of their values, in an order to find them by."""

    def __init__(self, nodes: Sequence[Node], values: Array) -> None:
        self.nodes, self.values = nodes, values
        places = combinations_with_replacement(range(len(values)), _MOST_TOGETHER)
        self.letters = np.array(list(places))
        self._sums = _without_number(np.log(np.abs(values)))[self.letters].sum(axis=1)
        self._weights = np.random.default_rng(1).uniform(1, 2, self._sums.shape[1])
        self._keys = self._sums @ self._weights
        self._order = np.argsort(self._keys)
        self._sorted = self._keys[self._order]

    def pairs(self, wanted: Array) -> Iterator[tuple[int, int]]:
        """Two of them, the first one first, whose logarithms make up a sum."""
        keys = wanted @ self._weights - self._keys
        first = np.searchsorted(self._sorted, keys - _CLOSE)
        last = np.searchsorted(self._sorted, keys + _CLOSE)
        for one in np.flatnonzero(last > first):
            for other in self._order[first[one] : last[one]]:
                left = wanted - self._sums[one] - self._sums[other]
                if one <= other and np.abs(left).max() < _CLOSE:
                    yield int(one), int(other)


def _simple(amount: Array, table: Array) -> Iterator[tuple[tuple[int, int], Fraction]]:
    """Where an amount over a table of values, (.., .., states), is one simple number throughout."""
    first, last = (amount[state] / table[:, :, state] for state in (0, -1))
    likely = np.abs(last - first) <= _CLOSE * np.abs(first)
    for i, j in zip(*np.nonzero(likely), strict=True):
        left = amount / table[i, j]
        constant = np.ptp(left) <= _CLOSE * abs(left[0])
        if constant and (number := simple_number(left)):
            yield (int(i), int(j)), number


def _size(match: Match) -> int:
    return match.size


def _without_number(logs: Array) -> Array:
    return np.asarray(logs[..., 1:] - logs[..., :1])
