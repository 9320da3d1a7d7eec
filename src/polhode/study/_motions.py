"""Many motions of one mode, as outputs read them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from polhode.simulate import Abreast, Flights
from polhode.study._columns import Array
from polhode.study._extremes import Quantity


@dataclass(frozen=True)
class Motions:
    """Motions that have one event at most, at their end.

    Attributes:
        flights: the motions.
        mode: that all of them are in.
        times: of the looks, s: the start, others, the duration.
    """

    flights: Flights
    mode: Abreast
    times: Array

    def at_end(self, quantity: Quantity) -> Array:
        """A quantity at the end of every motion, shape (motions,)."""
        return self.flights.values(quantity, -1)

    def at(self, quantity: Quantity, time: float) -> Array:
        """A quantity at one of the looks; not-a-number where the motion has ended before."""
        look = min(int(np.searchsorted(self.times, time)), len(self.times) - 1)
        values = self.flights.values(quantity, look)
        return np.where(time <= self.flights.end, values, np.nan)

    def by_ending(self, values: dict[str, float], otherwise: float) -> Array:
        """A number per motion, by the event that ended it; shape (motions,)."""
        table = [values.get(ending.kind, otherwise) for ending in self.mode.endings]
        return np.array([*table, otherwise])[self.flights.ending]

    def by_mode(self, values: dict[str, float], otherwise: float) -> Array:
        """A number per motion, by the mode it ends in; shape (motions,)."""
        table = [values.get(ending.mode, otherwise) for ending in self.mode.endings]
        last = values.get(self.mode.mode, otherwise)
        return np.array([*table, last])[self.flights.ending]
