"""Equations that hold only where their gradient vanishes, such as 1 − cos θ = 0 or (x − y)² = 0.

Differentiated, such an equation restrains nothing: its rate is zero wherever it holds. To divide by
the gradient all the same gives reactions that are false.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from polhode.algebra import Expr, Symbol, SymbolKind, Vector, Zero, has_parts, length, total, zeros
from polhode.base import DeclarationError
from polhode.model import Body, Constraint, Element

_LONGEST = 60  # terms of an equation whose zeros are looked for


def refuse_zero_gradients(elements: Iterable[Element], places: Mapping[Body, Vector]) -> None:
    """Refuse contacts, joints and constraints whose only equation has no simple zero.

    Raises:
        DeclarationError: naming one, with the equation to write instead.
    """
    for element in elements:
        equations = element.closures(places)
        if len(equations) != 1 or length(equations[0]) > _LONGEST or has_parts(equations[0]):
            continue
        found = zeros(equations[0], _is_place)
        if found and not any(zero.is_simple for zero in found):
            raise DeclarationError(
                f"{element.name!r}: {equations[0]} = 0, which holds only where its gradient "
                "vanishes",
                expected="an equation with a simple zero, whose rate of change restrains the "
                "motion",
                advice=_advice(element, found),
            )


def _is_place(symbol: Symbol) -> bool:
    return symbol.kind is SymbolKind.COORDINATE


def _advice(element: Element, found: Iterable[Zero]) -> str:
    if not isinstance(element, Constraint):
        return "hold it in a direction in which it can move there to first order"
    if any(zero.is_extreme and zero.equation is None for zero in found):
        return "a sum of squares vanishes where every square does: declare a Constraint for each"
    simple = [_equation(zero.equation) for zero in found if zero.equation is not None]
    if simple:
        return f"write {' or '.join(simple)} instead"
    return "write an equation that is not squared: theta = phi instead of cos(theta - phi) = 1"


def _equation(vanishing: Expr) -> str:
    """As an equation, with a constant on the right: theta = pi/2."""
    constants = total(s for s in vanishing.summands() if not any(map(_is_place, s.symbols())))
    return f"{vanishing - constants} = {-constants}"
