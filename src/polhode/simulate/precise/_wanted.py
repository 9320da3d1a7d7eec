"""What is asked for beyond doubles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from polhode.algebra import Expr
from polhode.simulate.integrate._number_types import NumberType


@dataclass(frozen=True)
class Wanted:
    """What is asked for, as it was given.

    Attributes:
        numbers: what to compute in.
        duration: s, with a unit or exactly.
        samples: how many, or their times.
        events: expressions whose passing through zero is recorded, by name.
    """

    numbers: NumberType
    duration: Any
    samples: Any
    events: Mapping[str, Expr]
