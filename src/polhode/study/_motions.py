"""Many motions, as outputs read them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from polhode.simulate.batch import LAST, BatchResults
from polhode.study._columns import Array
from polhode.study._extremes import Quantity


@dataclass(frozen=True)
class Motions:
    """Motions that have been followed together.

    Attributes:
        seen: where they were, and what happened to them.
    """

    seen: BatchResults

    @property
    def end(self) -> Array:
        """How far each went, s."""
        return self.seen.end

    def at_end(self, quantity: Quantity) -> Array:
        """A quantity at the end of every motion, shape (motions,)."""
        return self.seen.values(quantity, LAST)

    def at(self, quantity: Quantity, time: float) -> Array:
        """A quantity at one of the looks; not-a-number where the motion has ended before."""
        look = int(np.searchsorted(self.seen.times, time))
        if look < len(self.seen.times) - 1:
            return self.seen.values(quantity, look)
        return np.where(time <= self.end, self.at_end(quantity), np.nan)

    def coded(self, names: list[str], known: tuple[str, ...]) -> Array:
        """Names as places among those that are known, or -1."""
        places = {name: float(i) for i, name in enumerate(known)}
        return np.array([places.get(name, -1.0) for name in names])

    @cached_property
    def events(self) -> tuple[Array, NDArray[np.intp], tuple[str, ...]]:
        """Times and kinds of what happened, shape (motions, most), and what the kinds are."""
        found = self.seen.events()
        return found.times, found.codes, found.kinds

    def event_codes(self, known: tuple[str, ...]) -> Array:
        """Kinds of what happened, as places among those that are known, or -1."""
        _, codes, kinds = self.events
        return self.coded([*kinds, ""], known)[codes]
