"""Modes of small departures, followed along a parameter."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import pairwise
from typing import Any

import numpy as np

from polhode.algebra import Expr, Symbol, as_symbol
from polhode.base import (
    TIME,
    DeclarationError,
    NumericError,
    Shown,
    Value,
    extra,
    quantity_of,
    to_si,
)
from polhode.derive import Equations, derive
from polhode.model import System
from polhode.simulate import Dynamics, idle_parameters
from polhode.study._columns import Array, Name, published_names, whole
from polhode.study._linearised import Linearised, linearised_about
from polhode.study._stability_changes import Exponents, StabilityChange, growing, stability_changes


@dataclass(frozen=True)
class Modes(Shown):
    """Exponents of a family of steady motions, each followed along a parameter.

    Attributes:
        along: name of the parameter.
        values: of it, SI, ascending.
        exponents: 1/s, shape (values, modes), without those that are zero for all parameters. A
            column follows one mode, matched to the continuation of the values before; where a pair
            of conjugates becomes two real exponents, which is which is a convention.
        changes: where stability changes, ascending.
    """

    along: str
    values: Array
    exponents: Exponents
    changes: tuple[StabilityChange, ...]

    @property
    def growth(self) -> Array:
        """The largest real part at every value, 1/s."""
        return np.asarray(self.exponents.real.max(axis=1, initial=-np.inf))

    @property
    def stable(self) -> tuple[tuple[float, float], ...]:
        """Intervals of the parameter in which no small departure grows exponentially."""
        ends = [float(self.values[0]), *(c.value for c in self.changes), float(self.values[-1])]
        counts = [growing(self.exponents[0]), *(change.unstable[1] for change in self.changes)]
        return tuple(pair for pair, count in zip(pairwise(ends), counts, strict=True) if not count)


def modes(
    subject: System | Equations,
    parameters: Mapping[Name, Any],
    at: Mapping[Name, Any],
    *,
    along: Name,
    between: tuple[Value, Value],
    count: int = 41,
) -> Modes:
    """Follow the modes of a family of steady motions along one quantity.

    Stability changes are located to rounding: by the signs of functions of all exponents that
    vanish where one passes through zero or a pair crosses the imaginary axis.

    Args:
        subject: a declaration, or equations derived from it; one contact mode.
        parameters: the value of every parameter.
        at: coordinates and speeds of the steady motion, as for `linearise`.
        along: a parameter, coordinate or speed, or a symbol of your own that occurs in values of
            `parameters` and `at`.
        between: its first and last value.
        count: how many values to follow the modes over.

    Raises:
        ConstraintError: for values that contradict each other or the constraints.
        DeclarationError: for unknown names, and a quantity that nothing depends on.
        NumericError: for a motion that is not steady, where the equations are not smooth, and
            where modes cannot be followed.
        UnitError: for a value that cannot be read.
    """
    equations = subject if isinstance(subject, Equations) else derive(subject)
    family = _Family.of(equations, parameters, at, along)
    low, high = (family.read(value) for value in between)
    if not low < high:
        raise DeclarationError(
            f"modes between {family.name} = {low:g} and {high:g}",
            expected="the smaller value first",
        )
    values = np.linspace(low, high, whole(count, "values of a parameter", least=2))
    rows = [family.exponents(value) for value in values.tolist()]
    if len({len(row) for row in rows}) > 1:
        lengths = [len(row) for row in rows]
        odd = next(i for i, size in enumerate(lengths) if size != max(lengths))
        raise NumericError(
            f"{max(lengths)} exponents along {family.name}, but {lengths[odd]} at {values[odd]:g}",
            expected="the same number, apart from those that are zero for all parameters",
            advice="leave that value out: at it the steady motion belongs to a larger family",
        )
    changes = stability_changes(family.exponents, values.tolist())
    return Modes(family.name, values, _followed(rows), changes)


def _followed(rows: Sequence[Exponents]) -> Exponents:
    """Every row in the order that best continues the columns of the rows before it."""
    with extra("SciPy", "study"):
        from scipy.optimize import linear_sum_assignment

    followed = [rows[0]]
    for row in rows[1:]:
        last = followed[-1]
        expected = 2 * last - followed[-2] if len(followed) > 1 else last
        _, order = linear_sum_assignment(np.abs(expected[:, None] - row[None, :]))
        followed.append(row[order])
    return np.array(followed)


class _Family:
    """Steady motions by one quantity, with what has been computed for them."""

    def __init__(
        self,
        equations: Equations,
        parameters: Mapping[Name, Any],
        at: Mapping[Name, Any],
        symbol: Symbol,
    ) -> None:
        self.name = symbol.published
        self._equations = equations
        self._dynamics = Dynamics(equations, {}, idle_parameters(equations, parameters))
        self._tables = (parameters, at)
        self._symbol = symbol
        self.exponents = lru_cache(maxsize=None)(self._exponents)

    @classmethod
    def of(
        cls,
        equations: Equations,
        parameters: Mapping[Name, Any],
        at: Mapping[Name, Any],
        along: Name,
    ) -> _Family:
        """The family in which `along` takes values.

        Raises:
            DeclarationError: where nothing depends on it.
        """
        numbers = dict[Name, Any](published_names(parameters).items())
        start = dict[Name, Any](published_names(at).items())
        moving = (*equations.coordinates, *equations.speeds, *equations.kinematics)
        moving += tuple(equations.dependent)
        known = {s.published: s for s in (*equations.parameters, *moving)}
        used = {s.published: s for v in (*numbers.values(), *start.values()) for s in _symbols(v)}
        name = along if isinstance(along, str) else as_symbol(along).published
        symbol = (known | used).get(name)
        if symbol is None:
            raise DeclarationError(
                f"modes along {name}, on which nothing depends",
                expected="a parameter, coordinate or speed, or a symbol in the values given",
                advice=f"known are {', '.join(sorted(known))}",
            )
        if name not in used:
            table = numbers if symbol in equations.parameters else start
            table[name] = Expr.generator(symbol)
        return cls(equations, numbers, start, symbol)

    def read(self, value: Value) -> float:
        """A value of the quantity, SI.

        Raises:
            UnitError: if it cannot be read or has the wrong dimension.
        """
        base = self._equations.dimensions.get(self._symbol.base())
        if base is None:
            return quantity_of(value, self.name).value
        return to_si(value, base / TIME**self._symbol.order, self.name)

    def linearised(self, value: float) -> Linearised:
        """Small departures from the steady motion at one value."""
        image = {self._symbol: Expr.of(value)}

        def with_value(table: Mapping[Name, Any]) -> dict[Name, Any]:
            return {k: v.subs(image) if isinstance(v, Expr) else v for k, v in table.items()}

        numbers, start = map(with_value, self._tables)
        return linearised_about(self._dynamics, numbers, start)

    def _exponents(self, value: float) -> Exponents:
        return self.linearised(value).exponents


def _symbols(value: Any) -> frozenset[Symbol]:
    return value.symbols() if isinstance(value, Expr) else frozenset()
