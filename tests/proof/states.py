"""Comparisons with the oracles, watched: how far off each is, and how sensitive to its numbers."""

from __future__ import annotations

import zlib
from collections.abc import Iterable

import numpy as np

from derive.states import Numeric, Values
from proof.ledger import Ledger

NUDGE = 1e-7  # relative change of every number, by which the condition is measured
ROUNDING = 1e-12  # relative error allowed per unit of (1 + condition number)


class Watched(Numeric):
    """Equations in numbers that remember the last state, and one a trifle away from it."""

    def at(self, **values: float) -> dict[str, float]:
        self.state = values
        self.nudged = super().at(**nudged(values))
        return super().at(**values)

    def condition(self, found: Values, names: Iterable[str], scale: float) -> float:
        """Relative change of these values per relative change of the numbers; at least 1."""
        moved = [abs(self.nudged[n] - found[n]) for n in names if n in self.nudged]
        return max(1.0, max(moved, default=0.0) / scale / NUDGE)


def nudged(values: Values) -> dict[str, float]:
    """Every number changed by the same relative amount, up or down at random."""
    rng = np.random.default_rng(zlib.crc32(repr(values).encode()))
    return {name: v * (1 + NUDGE * rng.choice([-1, 1])) for name, v in values.items()}


class Comparison:
    """Stands in for `agree` in the comparisons of the tests: enters errors in a ledger."""

    def __init__(self, ledger: Ledger) -> None:
        self.system: Watched | None = None
        self.place = ""
        self._ledger = ledger

    def agree(
        self,
        found: Values,
        expected: Values,
        names: Iterable[str],
        tolerance: float = 0.0,
    ) -> None:
        """As in the tests; but what is allowed also grows with the condition."""
        chosen = list(names)
        scale = max(1.0, *(abs(expected[name]) for name in chosen))
        size = max(abs(found[name] - expected[name]) for name in chosen) / scale
        assert self.system is not None
        condition = self.system.condition(found, chosen, scale)
        allowed = max(tolerance, ROUNDING * (1 + condition))
        self._ledger.error(size, allowed, condition, f"{chosen[0]} at {self.place}")
