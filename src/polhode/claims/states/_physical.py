"""What bodies that exist demand of numbers: positive parameters, inertias of some body."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import lru_cache, reduce
from typing import Any

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.claims.meaning._mechanics import EquationsKey
from polhode.claims.states._claim_domain import ClaimDomain
from polhode.claims.states._numeric import number

_ROUNDING = 1e-9


def is_physical(states: ClaimDomain, values: Mapping[Symbol, Any]) -> Any:
    """Whether bodies with these numbers can be; numbers may be arrays of one shape.

    What is declared positive is so, also where the circumstances determine it, and so is what the
    derivation took as positive; no moment of inertia exceeds the sum of the other two.
    """
    above, not_below = _demands(EquationsKey(states.equations))
    with np.errstate(all="ignore"):
        met = [number(states.on(e), values) > 0 for e in (*states.signs, *above)]
        for larger, size in not_below:
            least = -_ROUNDING * np.abs(number(states.on(size), values))
            met.append(number(states.on(larger), values) >= least)
    return reduce(np.logical_and, met, np.bool_(True))


def demanded(states: ClaimDomain) -> frozenset[Symbol]:
    """The symbols whose numbers that takes."""
    above, not_below = _demands(EquationsKey(states.equations))
    every = (*states.signs, *above, *(e for pair in not_below for e in pair))
    return frozenset(s for e in every for s in states.on(e).symbols())


@lru_cache(maxsize=16)
def _demands(the: EquationsKey) -> tuple[tuple[Expr, ...], tuple[tuple[Expr, Expr], ...]]:
    """What has to be positive, and what must not be negative, each with its size."""
    equations = the.equations
    signed = {s for s in equations.parameters if s.positive}
    inertias = tuple(_of_inertias(the))
    signed |= {s for pair in inertias for e in pair for s in e.symbols() if s.positive}
    ordered = sorted(signed, key=lambda s: s.published)
    return tuple(map(Expr.generator, ordered)), inertias


def _of_inertias(the: EquationsKey) -> Iterator[tuple[Expr, Expr]]:
    """Moments of inertia, and the sum of each two less the third; true along any axes."""
    for body in the.equations.system.bodies:
        moments = [body.inertia[i, i] for i in range(3)]
        whole = moments[0] + moments[1] + moments[2]
        for moment in moments:
            if moment:
                yield moment, whole
                yield whole - 2 * moment, whole
