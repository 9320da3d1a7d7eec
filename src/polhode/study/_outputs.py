"""What is kept of every motion of an ensemble.

Whatever else a motion was is forgotten at once, so that memory grows with the outputs alone.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from polhode.algebra import Expr, Symbol, as_symbol
from polhode.base import DeclarationError, NumericError
from polhode.simulate import Trajectory
from polhode.study._columns import Array
from polhode.study._event_outputs import EndMode
from polhode.study._extremes import Quantity, largest
from polhode.study._motions import Motions
from polhode.study._output import CodeTable, Output, Plain, Single


@dataclass(frozen=True)
class Final(Single):
    """A quantity at the end of the motion, SI.

    Args:
        quantity: a published name or an expression.
    """

    quantity: Quantity

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its value."""
        return float(run.evaluate(self.quantity, run.duration))

    @property
    def reads(self) -> tuple[Quantity, ...]:
        return (self.quantity,)

    @property
    def looks(self) -> tuple[float, ...]:
        return ()

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Its values, shape (motions,)."""
        return motions.at_end(self.quantity)


@dataclass(frozen=True)
class Maximum(Single):
    """The largest value of a quantity along the motion, SI, found to rounding between steps."""

    quantity: Quantity

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its value."""
        return largest(run, self.quantity, 1.0)


@dataclass(frozen=True)
class Minimum(Single):
    """The least value of a quantity along the motion, SI, found to rounding between steps."""

    quantity: Quantity

    def of(self, run: Trajectory, legend: CodeTable) -> float:
        """Its value."""
        return -largest(run, self.quantity, -1.0)


@dataclass(frozen=True)
class TimeSeries(Plain):
    """A quantity at some times, SI; not-a-number after the end of the motion.

    Args:
        quantity: a published name or an expression.
        times: s, increasing.
    """

    quantity: Quantity
    times: tuple[float, ...]

    def __post_init__(self) -> None:
        if not all(time >= 0 for time in self.times):
            raise NumericError(f"the times {self.times}", expected="times from 0 on, s")

    @property
    def shape(self) -> tuple[int, ...]:
        return (len(self.times),)

    def of(self, run: Trajectory, legend: CodeTable) -> Array:
        """Its values, shape (times,)."""
        times = np.array(self.times, dtype=float)
        inside = times <= run.duration
        values = np.full(len(times), np.nan)
        values[inside] = run.evaluate(self.quantity, times[inside])
        return values

    @property
    def reads(self) -> tuple[Quantity, ...]:
        return (self.quantity,)

    @property
    def looks(self) -> tuple[float, ...]:
        return self.times

    def of_many(self, motions: Motions, legend: CodeTable) -> Array:
        """Its values, shape (motions, times)."""
        return np.stack([motions.at(self.quantity, time) for time in self.times], axis=1)


Outputs: TypeAlias = Mapping[str, Output]


def outputs_of(asked: Mapping[str, Output | Quantity] | Sequence[Output | Quantity]) -> Outputs:
    """Outputs by name; a quantity alone stands for its value at the end, "mode" for the mode.

    Raises:
        DeclarationError: for none at all, or an output that needs a name.
    """
    several = (asked,) if isinstance(asked, str) else asked
    given = several if isinstance(several, Mapping) else {_name(one): one for one in several}
    if not given:
        raise DeclarationError(
            "no outputs", expected="what to keep of every motion, such as ['theta', 'mode']"
        )
    return {name: _output(one) for name, one in given.items()}


def _name(asked: Output | Quantity) -> str:
    if isinstance(asked, str):
        return asked
    if isinstance(asked, Symbol):
        return asked.published
    if isinstance(asked, Expr):
        return as_symbol(asked).published
    raise DeclarationError(
        f"{asked} without a name", expected="outputs={'a name': ...}", advice="give it a name"
    )


def _output(asked: Output | Quantity) -> Output:
    if asked == "mode":
        return EndMode()
    if isinstance(asked, str | Symbol | Expr):
        return Final(asked)
    if not isinstance(asked, Output):
        raise DeclarationError(
            f"the output {asked!r}", expected="a quantity, or an output such as Largest('theta')"
        )
    return asked
