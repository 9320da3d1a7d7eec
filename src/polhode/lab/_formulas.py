"""Formulas that do not change with the numbers, typeset once."""

from __future__ import annotations

from typing import Any

from polhode.algebra import Expr, Symbol
from polhode.analyse import invariants
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.view import equation


def invariants_of(equations: Equations) -> list[dict[str, Any]]:
    """First integrals with their names and meanings; none where none can be looked for."""
    try:
        found = invariants(equations)
    except PolhodeError:
        return []
    return [{"name": i.name, "meaning": i.meaning, **_formula(i.name, i.expression)} for i in found]


def _formula(name: str, expression: Expr) -> dict[str, Any]:
    made = equation("", Expr.generator(Symbol(name)), expression)
    return {"pieces": list(made.pieces), "spoken": made.spoken}
