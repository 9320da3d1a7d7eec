"""The linear equations of small departures from a steady motion, exactly.

A departure of a coordinate q is written δ_q, and that of its rate as the derivative of δ_q; that of
a speed u that is no rate is δ_u.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from polhode.algebra import ZERO, Expr, Symbol, dot, eliminate, total
from polhode.analyse._given import TO_STEADY, Given, refuse_following, values_given
from polhode.analyse._stability import linear_matrices
from polhode.analyse._steady import SteadyMotion
from polhode.base import NumericError, Shown
from polhode.derive import without_idle_factors


@dataclass(frozen=True, repr=False)
class Departures(Shown):
    """Small departures from a steady motion.

    Attributes:
        family: the steady motion.
        names: the departure of every essential coordinate and independent speed.
        equations: expressions equal to zero, linear in the departures and their derivatives.
    """

    family: SteadyMotion
    names: dict[Symbol, Expr]
    equations: tuple[Expr, ...]

    @cached_property
    def integrals(self) -> tuple[Expr, ...]:
        """Combinations of departures that stay constant: equations that are derivatives in time."""
        return tuple(i for row in self.equations if (i := self._integral(row)) is not None)

    def _integral(self, row: Expr) -> Expr | None:
        """The combination whose time derivative a row is, if departures do not enter undotted."""
        own = {s.base() for value in self.names.values() for s in value.symbols()}
        moving = [s for s in row.symbols() if s.base() in own]
        lower = {s: Symbol(s.name, s.kind, s.order - 1) for s in moving if s.order}
        if len(lower) < len(moving):
            return None
        return total(row.diff(s) * Expr.generator(below) for s, below in lower.items())

    def __str__(self) -> str:
        lines = [f"Departures from {self.family}", *(f"  {e.pretty()} = 0" for e in self.equations)]
        lines += [f"  {i.pretty()} is constant" for i in self.integrals]
        return "\n".join(lines)

    __repr__ = __str__


def departures(
    family: SteadyMotion,
    at: Mapping[Any, Given] | None = None,
    names: Mapping[Symbol, Expr] | None = None,
) -> Departures:
    """Linearise the equations of motion about a family of steady motions.

    Args:
        family: from `steady`.
        at: further values of coordinates, speeds or parameters.
        names: departures of coordinates under other names, such as ε; δ_q by default.

    Raises:
        DeclarationError: for a name the system does not have.
        NumericError: where the coordinates are singular on the family.
        UnitError: for a value that cannot be read or has the wrong dimension.
    """
    system = family.reduced
    given = values_given(system.equations, at)
    refuse_following(system.equations, given, TO_STEADY)
    if given:
        fixed = {s: v.subs(given) for s, v in family.fixed.items()} | dict(given)
        relations = tuple(r for e in family.relations if (r := e.subs(given)))
        family = SteadyMotion(system, fixed, relations)
    known = {s: _departure(s, names or {}) for s in system.state}
    column = tuple(known.values())
    left, right = linear_matrices(family)
    if eliminate(left, [ZERO] * len(left)).free:
        raise NumericError(
            f"small departures from {family} of {system.equations.system.name}",
            expected="coordinates that are not singular there",
            advice="describe the attitude by other angles, such as two tilts for an upright top",
        )
    rates = tuple(value.dt() for value in column)
    pairs = zip(left, right, strict=True)
    rows = (dot(b, rates) - dot(a, column) for b, a in pairs)
    return Departures(family, known, tuple(without_idle_factors(row) for row in rows if row))


def _departure(symbol: Symbol, names: Mapping[Symbol, Expr]) -> Expr:
    base = symbol.base()
    if base in names:
        departure = names[base]
    else:
        departure = Expr.generator(Symbol(f"delta_{base.name}", base.kind))
    for _ in range(symbol.order):
        departure = departure.dt()
    return departure
