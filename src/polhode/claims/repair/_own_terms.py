"""Several coefficients of a claim's own terms, fitted together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations

import numpy as np

from polhode.claims._numeric import Array
from polhode.claims.latex._tree import Number
from polhode.claims.repair._edits import Edit, edits
from polhode.claims.repair._multiplier import Match, Response, simple_number
from polhode.claims.repair._places import Place

_CLOSE = 1e-8
_MOST_TOGETHER = 3
_MOST_PLACES = 24


def fitted(responses: Mapping[Place, Response]) -> Iterator[tuple[Edit, ...]]:
    """Sets of two or three changes of numbers or signs that together let a claim hold.

    Args:
        responses: how what must vanish changes with a factor put at each place.
    """
    places = [p for p in responses if p.is_term or isinstance(p.node, Number)]
    slopes = {p: s.ravel() for p in places if (s := responses[p].slope()) is not None}
    if not slopes:
        return
    rest = next(iter(responses.values())).before.ravel()
    for together in range(2, _MOST_TOGETHER + 1):
        found = False
        for chosen in combinations(list(slopes)[:_MOST_PLACES], together):
            factors = _factors(rest, [slopes[p] for p in chosen])
            if factors is not None and _apart(chosen):
                found = True
                yield from _written(chosen, factors)
        if found:
            return


def _factors(rest: Array, slopes: Sequence[Array]) -> list[Match] | None:
    matrix = np.array(slopes).T
    change, _, rank, _ = np.linalg.lstsq(matrix, -rest, rcond=1e-10)
    left = np.abs(matrix @ change + rest).max()
    if rank < len(slopes) or left > _CLOSE * np.abs(rest).max():
        return None
    numbers = [simple_number(np.array([1 + x])) for x in change]
    if any(number is None or number == 1 for number in numbers):
        return None
    return [Match(number) for number in numbers if number is not None]


def _apart(chosen: Sequence[Place]) -> bool:
    """Whether no place is inside another."""
    return not any(
        a.path[: len(b.path)] == b.path or b.path[: len(a.path)] == a.path
        for a, b in combinations(chosen, 2)
    )


def _written(chosen: Sequence[Place], factors: Sequence[Match]) -> Iterator[tuple[Edit, ...]]:
    options = [list(edits(p, match)) for p, match in zip(chosen, factors, strict=True)]
    if all(options):
        yield tuple(min(each, key=lambda edit: edit.size) for each in options)
