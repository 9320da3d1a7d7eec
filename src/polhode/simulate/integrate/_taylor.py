"""A solution as consecutive Taylor series, and the units in which its steps are chosen."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import floor, log2

import numpy as np

from polhode.algebra import Symbol, SymbolKind
from polhode.simulate.integrate._arrays import Array, evaluated, pieces_at


@dataclass(frozen=True)
class TaylorLeg:
    """A solution as consecutive Taylor series.

    Attributes:
        times: where the steps begin, and where the last one ends, s, shape (steps + 1,).
        rests: the remainders of the same times in double-double precision, s.
        lengths: of the steps, s.
        shares: coefficients of the powers of the share of a step, shape (steps, states, order + 1).
        broken: whether it cannot be continued.
    """

    times: Array
    rests: Array
    lengths: Array
    shares: Array
    broken: bool

    def then(self, other: TaylorLeg) -> TaylorLeg:
        """This leg and one that begins where it ends."""
        return TaylorLeg(
            np.concatenate([self.times, other.times[1:]]),
            np.concatenate([self.rests, other.rests[1:]]),
            np.concatenate([self.lengths, other.lengths]),
            np.concatenate([self.shares, other.shares]),
            other.broken,
        )

    def at(self, times: Array) -> Array:
        """States, shape (states, times)."""
        which = pieces_at(self.times, times)
        passed = (times - self.times[which]) - self.rests[which]
        return evaluated(self.shares, which, passed / self.lengths[which])


def scales_of(
    symbols: Sequence[Symbol],
    state: Array,
    sizes: Array,
    *,
    is_driven: bool,
    small: float = 2.0**-8,
) -> Array | None:
    """The units in which small states are integrated; None where the tolerance is relative.

    The tolerance is relative to the largest state, or absolute if that is below one. A motion over
    micrometres or with slip of micrometres per second is therefore integrated in multiples of the
    size of all coordinates, and of all speeds: powers of two, so that nothing is rounded.

    Args:
        symbols: the states.
        state: their values at the start.
        sizes: likewise, within one step.
        is_driven: whether time occurs explicitly: from rest, a step then does not tell the size.
        small: the size below which they are scaled.
    """
    scales = np.ones(len(sizes))
    speeds = np.array([s.kind is SymbolKind.SPEED or s.order > 0 for s in symbols], dtype=bool)
    for places in (speeds, ~speeds):
        size = float(np.max(sizes[places], initial=0.0))
        if 0.0 < size < small and (np.any(state[places]) or not is_driven):
            scales[places] = 2.0 ** floor(log2(size))
    return scales if np.any(scales < 1.0) else None
