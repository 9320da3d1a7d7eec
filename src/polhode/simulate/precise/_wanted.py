"""What is asked for beyond doubles."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from polhode.algebra import Expr, GivenValue
from polhode.simulate.integrate._number_types import NumberType


@dataclass(frozen=True)
class Wanted:
    """What is asked for, as it was given.

    Attributes:
        numbers: what to compute in.
        duration: s.
        samples: how many, or their times.
        events: expressions whose passing through zero is recorded, by name.
    """

    numbers: NumberType
    duration: GivenValue
    samples: Any
    events: Mapping[str, Expr]
