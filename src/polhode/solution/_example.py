"""Values for one motion of a system, from the catalogue or given by the user."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import islice
from typing import Any, Protocol

from polhode.algebra import Expr, compile_program
from polhode.analyse import ClosedForm, closed_form
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.simulate import Trajectory, simulate
from polhode.view import Illustration, pictures_of

_NOTHING: Mapping[str, str] = {}
#: Periods that a figure shows.
_PERIODS = 3
#: Pictures that stand beneath it.
_PICTURES = 2
#: Smaller differences after a period are rounding.
_SAME = 1e-9


@dataclass(frozen=True)
class Example:
    """One motion in numbers.

    Attributes:
        equations: derived from the system.
        parameters: by published name, SI.
        start: coordinates and speeds that were chosen; the rest is zero.
        duration: s.
        forcing: prescribed functions of time.
        formulas: parameters that are given by others, as text, such as I = 2*m*a**2/5.
        groups: quantities worth plotting together; everything where empty.
    """

    equations: Equations
    parameters: Mapping[Any, Any]
    start: Mapping[Any, Any]
    duration: Any
    forcing: Mapping[Any, Any] = field(default_factory=dict)
    formulas: Mapping[str, str] = field(default_factory=dict)
    groups: tuple[tuple[str, ...], ...] = ()

    @cached_property
    def pictures(self) -> tuple[Illustration, ...]:
        """What shows the motion besides its history, as many as stand side by side."""
        return tuple(islice(pictures_of(self.run), _PICTURES))

    @cached_property
    def period(self) -> float | None:
        """Of the motion, s, where it has a closed form with a period."""
        try:
            return float(self._closed_form.period)
        except (PolhodeError, ZeroDivisionError):
            return None

    @property
    def repeating(self) -> tuple[str, ...] | None:
        """Published names of what varies and has its value again after a period; None for all.

        Others advance in every period, as the angle of a precession does.
        """
        period = self.period or 0.0
        now, later, other = (self._closed_form.at(period * t) for t in (0.37, 1.37, 0.71))
        same = {name for name, value in now.items() if abs(later[name] - value) < _SAME}
        coordinates = {q.published for q in self.equations.coordinates}
        if coordinates <= same:
            return None
        varying = [s for s in same if abs(other[s] - now[s]) > _SAME]
        own = [q for q in self.equations.coordinates if q.published in same]
        rates = [self.equations.kinematics[q.derivative()].symbol for q in own]
        repeated = {rate.published for rate in rates if rate is not None}
        return tuple(name for name in now if name in varying and name not in repeated)

    @cached_property
    def _closed_form(self) -> ClosedForm:
        return closed_form(self.equations, self.parameters, self.start)

    @cached_property
    def run(self) -> Trajectory:
        """The motion, integrated."""
        shown = self.duration
        if self.period is not None:
            shown = min(float(shown), _PERIODS * self.period)
        system = self.equations.system
        return simulate(system, self.parameters, self.start, shown, forcing=self.forcing)

    @cached_property
    def known(self) -> dict[str, float]:
        """Parameters, and coordinates and speeds at the start, by published name."""
        state = (*self.equations.coordinates, *self.equations.speeds)
        zero = {symbol.published: 0.0 for symbol in state}
        given = {**self.start, **self.parameters}
        return {**zero, **{name: float(value) for name, value in given.items()}}

    def value(self, expression: Expr) -> float | None:
        """An expression of parameters and of quantities at the start; None for any other."""
        known = self.known
        symbols = sorted(expression.symbols(), key=lambda s: s.published)
        if any(s.published not in known for s in symbols if s.name != "pi"):
            return None
        used = [s for s in symbols if s.name != "pi"]
        program = compile_program([expression], used).function()
        try:
            (found,) = program(*(known[s.published] for s in used))
        except (ValueError, ZeroDivisionError, OverflowError):
            return None
        return float(found)


class Values(Protocol):
    """Arguments of `simulate`, such as the catalogue's numbers of a run."""

    @property
    def parameters(self) -> Mapping[Any, Any]:
        """By published name, SI."""

    @property
    def start(self) -> Mapping[Any, Any]:
        """Coordinates and speeds that were chosen."""

    @property
    def duration(self) -> Any:
        """In seconds."""

    @property
    def forcing(self) -> Mapping[Any, Any]:
        """Prescribed functions of time."""


def example_of(
    equations: Equations,
    values: Values,
    defaults: Mapping[str, str] = _NOTHING,
    groups: tuple[tuple[str, ...], ...] = (),
) -> Example:
    """The motion with some values.

    Args:
        equations: derived from the system.
        values: of a run.
        defaults: parameters as text, of which those that are formulas are stated, such as
            I = 2*m*a**2/5.
        groups: quantities worth plotting together.
    """
    used = {s.published for s in equations.parameters}
    formulas = {k: text for k, text in defaults.items() if k in used and _is_formula(text, used)}
    return Example(
        equations,
        values.parameters,
        values.start,
        values.duration,
        values.forcing,
        formulas,
        groups,
    )


def _is_formula(text: str, names: Iterable[str]) -> bool:
    """Whether a default value is an expression of other parameters of the equations."""
    words = "".join(c if c.isalnum() or c == "_" else " " for c in text).split()
    return "*" in text and any(word in names for word in words)
