"""A system with values put in for parameters of its loads, such as g = 0."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, replace
from typing import Any

from polhode.algebra import Expr, Symbol
from polhode.base import DeclarationError
from polhode.derive import Equations, derive
from polhode.model import Gravity, Load, System


def special_case(equations: Equations, values: Mapping[Symbol, Expr]) -> Equations:
    """The equations of the same system with values in place of parameters of its loads.

    Gravity whose acceleration becomes zero is left out.

    Raises:
        DeclarationError: for a quantity that is not a parameter, or that a body or support has.
    """
    system = equations.system
    loads = [_with_values(load, values) for load in system.loads]
    kept = [load for load in loads if not (isinstance(load, Gravity) and not load.g)]
    found = System(
        *system.bodies,
        *system.elements,
        *kept,
        name=system.name,
        independent=[Expr.generator(s) for s in system.independent],
        speeds={symbol.name: meaning for symbol, meaning in system.speeds},
    )
    special = derive(found)
    left = {s for s in values if s.kind.varies or s in special.parameters}
    if left:
        names = ", ".join(sorted(s.published for s in left))
        raise DeclarationError(
            f"a worked solution of {system.name!r} at a value of {names}",
            expected="parameters that occur in the loads alone, such as g of gravity",
            advice=f"ask steady for motions at a value of {names}, or declare the system with it",
        )
    return special


def _with_values(load: Any, values: Mapping[Symbol, Expr]) -> Load:
    """A load, which is a dataclass, with values in its scalar fields."""
    own = {field.name: getattr(load, field.name) for field in fields(load)}
    changed = {
        name: value.subs(dict(values))
        for name, value in own.items()
        if isinstance(value, Expr) and value.symbols() & set(values)
    }
    found: Load = replace(load, **changed) if changed else load
    return found
