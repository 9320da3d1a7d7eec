"""The request for a motion in more than double precision."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from polhode.algebra import Expr, GivenValue
from polhode.simulate.integrate._number_types import NumberType


@dataclass(frozen=True)
class PrecisionRequest:
    """The requested precision, duration, samples and events.

    Attributes:
        numbers: number type to compute in.
        duration: s.
        samples: their number, or their times.
        events: expressions whose zero crossings are recorded, by name.
    """

    numbers: NumberType
    duration: GivenValue
    samples: Any
    events: Mapping[str, Expr]
