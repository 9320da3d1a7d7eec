"""Several coefficients of a claim's own terms, fitted together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations

import numpy as np

from polhode.claims.latex._tree import Number
from polhode.claims.repair._edits import Edit, edits
from polhode.claims.repair._multiplier import Match, Response, simple_number
from polhode.claims.repair._places import NodePosition
from polhode.claims.states._numeric import Array

_CLOSE = 1e-8
_INDEPENDENT = 1e-10
_MOST_TOGETHER = 3
_MOST_PLACES = 24


def fitted(responses: Mapping[NodePosition, Response]) -> Iterator[tuple[Edit, ...]]:
    """Sets of two or three changes of numbers or signs that together let a claim hold.

    Args:
        responses: how what must vanish changes with a factor put at each place.
    """
    places = [p for p in responses if p.is_term or isinstance(p.node, Number)]
    slopes = {p: s.ravel() for p in places if (s := responses[p].slope()) is not None}
    if not slopes:
        return
    tried = list(slopes)[:_MOST_PLACES]
    rest = next(iter(responses.values())).before.ravel()
    for together in range(2, _MOST_TOGETHER + 1):
        found = False
        for chosen, factors in _solutions(rest, np.array([slopes[p] for p in tried]), together):
            where = [tried[i] for i in chosen]
            if _apart(where):
                found = True
                yield from _written(where, factors)
        if found:
            return


def _solutions(
    rest: Array, slopes: Array, together: int
) -> Iterator[tuple[tuple[int, ...], list[Match]]]:
    """Which slopes, with which factors, bring the rest to nothing; all sets are tried at once."""
    sets = list(combinations(range(len(slopes)), together))
    if not sets or together > len(rest):
        return
    bases, triangles = np.linalg.qr(np.moveaxis(slopes[np.array(sets)], 1, 2))
    shares = np.einsum("snk,n->sk", bases, -rest)
    left = np.abs(np.einsum("snk,sk->sn", bases, shares) + rest).max(axis=1)
    sizes = np.abs(np.diagonal(triangles, axis1=1, axis2=2))
    apart = sizes.min(axis=1) > _INDEPENDENT * sizes.max(axis=1)
    for i in np.flatnonzero(apart & (left <= _CLOSE * np.abs(rest).max())):
        change = np.linalg.solve(triangles[i], shares[i])
        numbers = [simple_number(np.array([1 + x])) for x in change]
        factors = [Match(n) for n in numbers if n is not None and n != 1]
        if len(factors) == together:
            yield sets[i], factors


def _apart(chosen: Sequence[NodePosition]) -> bool:
    """Whether no place is inside another."""
    return not any(
        a.path[: len(b.path)] == b.path or b.path[: len(a.path)] == a.path
        for a, b in combinations(chosen, 2)
    )


def _written(
    chosen: Sequence[NodePosition], factors: Sequence[Match]
) -> Iterator[tuple[Edit, ...]]:
    options = [list(edits(p, match)) for p, match in zip(chosen, factors, strict=True)]
    if all(options):
        yield tuple(min(each, key=lambda edit: edit.size) for each in options)
