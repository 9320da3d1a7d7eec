"""Products of several letters that equal a quantity at every state."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import combinations_with_replacement

import numpy as np

from polhode.claims._numeric import Array
from polhode.claims.latex._tree import Node
from polhode.claims.repair._multiplier import Match, matches, simple_number

_CLOSE = 1e-8
_MOST_LETTERS = 40
_MOST_TOGETHER = 3


def products(amount: Array, known: Sequence[tuple[Node, Array]]) -> Iterator[Match]:
    """A number times products of letters, the shortest first.

    Up to two letters may stand above or below; more of them, up to six, above only.
    """
    found = list(matches(amount, known))
    if not found:
        different = list({v.tobytes(): (n, v) for n, v in reversed(known)}.values())[::-1]
        found = sorted(_long(amount, different[:_MOST_LETTERS]), key=lambda match: match.size)
    yield from found


def _long(amount: Array, known: Sequence[tuple[Node, Array]]) -> Iterator[Match]:
    """Met in the middle: what a few letters leave must be the product of a few others."""
    if len(amount) < _MOST_TOGETHER or not amount.all():
        return
    # a product of nothing stands first, so that shorter ones are among them
    values = np.array([np.ones_like(amount), *(v for _, v in known)])
    logs = _without_number(np.log(np.abs(values)))
    few = np.array(list(combinations_with_replacement(range(len(values)), _MOST_TOGETHER)))
    sums = logs[few].sum(axis=1)
    wanted = _without_number(np.log(np.abs(amount))) - sums
    for one, other in _equal(wanted, sums):
        letters = sorted(i for i in (*few[one], *few[other]) if i)
        number = simple_number(amount / np.prod(values[letters], axis=0))
        if number and one <= other:
            counted = Counter(known[i - 1][0] for i in letters)
            yield Match(number, tuple(counted.items()))


def _without_number(logs: Array) -> Array:
    return np.asarray(logs[..., 1:] - logs[..., :1])


def _equal(some: Array, others: Array) -> Iterator[tuple[int, int]]:
    """Pairs of equal rows."""
    weights = np.random.default_rng(1).uniform(1, 2, some.shape[1])
    order = np.argsort(others @ weights)
    keys = (others @ weights)[order]
    first = np.searchsorted(keys, some @ weights - _CLOSE)
    last = np.searchsorted(keys, some @ weights + _CLOSE)
    for i in np.flatnonzero(last > first):
        for j in order[first[i] : last[i]]:
            if np.allclose(some[i], others[j], rtol=0, atol=_CLOSE):
                yield int(i), int(j)
