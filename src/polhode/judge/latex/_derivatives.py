"""Derivatives d/dt and ∂/∂θ recognised in fractions, and the variable of an integral in its dx."""

from __future__ import annotations

from dataclasses import dataclass, replace

from polhode.base import ParseError
from polhode.judge.latex._tree import (
    Cross,
    Derivative,
    Differential,
    Dot,
    Name,
    Negative,
    Node,
    Number,
    Power,
    Quotient,
    Span,
    factors_of,
    product,
)

_DERIVING = {"d": "d", "∂": "partial"}
_MATERIAL = Name("D")
_ORDERS = tuple("123456789")


@dataclass(frozen=True)
class Operator(Node):
    """A d/dt without the quantity it acts on."""

    by: tuple[tuple[Node, int], ...]
    partial: bool
    frame: str = ""

    def applied(self, of: Node, span: Span) -> Node:
        """The derivative of a quantity."""
        for by, order in reversed(self.by):
            of = Derivative(of, by, order, self.partial, self.frame, span=span)
        return of


def derivative(above: Node, below: Node, span: Span) -> Node | None:
    """The derivative or operator that a fraction prints; None for an ordinary fraction."""
    if isinstance(above, Negative):  # -dx/dt: the sign belongs to the derivative
        inner = derivative(above.of, below, span)
        lacks_operand = inner is None or isinstance(factors_of(inner)[-1], Operator)
        return None if inner is None or lacks_operand else replace(above, of=inner)
    if factors_of(below)[:1] == (_MATERIAL,) == factors_of(above)[:1] and Name("t") in factors_of(
        below
    ):
        problem = "a derivative D/Dt, of matter that flows or along a curve"
        raise ParseError(problem, expected="d/dt of the quantity, or its terms written out")
    denominators = [_denominator(factor) for factor in factors_of(below)]
    by = tuple((of, order) for _, of, order in denominators)
    signs = {sign for sign, _, _ in denominators}
    if len(signs) != 1 or not signs <= set(_DERIVING):
        return None
    return _differentiated(factors_of(above), signs.pop(), by, span)


def measured(integrand: Node, span: Span) -> tuple[Node, Node] | None:
    """The quantity under an integral and the variable it runs over; None without a differential."""
    factors = factors_of(integrand)
    for place, factor in enumerate(factors):
        found = _variable(factor)
        if found is not None:
            left, by = found
            return product((*factors[:place], *left, *factors[place + 1 :]), span), by
    return None


def _variable(factor: Node) -> tuple[tuple[Node, ...], Node] | None:
    match factor:
        case Differential(of, "d"):
            return (), of
        case Quotient(above, below):
            found = measured(above, above.span)
            return found and ((replace(factor, above=found[0], below=below),), found[1])
        case Cross(left, right) | Dot(left, right) if not isinstance(right, Differential):
            found = measured(right, right.span)
            return found and ((replace(factor, left=left, right=found[0]),), found[1])
    return None


def _denominator(factor: Node) -> tuple[str, Node, int]:
    """The sign, quantity and order of dt, dt² or ∂θ; no sign for anything else."""
    match factor:
        case Differential(of, sign):
            return sign, of, 1
        case Power(Differential(of, sign), Number(text)) if text in _ORDERS:
            return sign, of, int(text)
    return "", factor, 0


def _differentiated(
    above: tuple[Node, ...], sign: str, by: tuple[tuple[Node, int], ...], span: Span
) -> Node | None:
    total = sum(order for _, order in by)
    for place, factor in enumerate(above):
        started = _started(factor, sign, total)
        if started is not None:
            operator = Operator(by, sign == "∂", _frame(factor), span=span)
            of = (*started, *above[place + 1 :])
            derived = operator.applied(product(of, span), span) if of else operator
            return product((*above[:place], derived), span)
    return None


def _started(factor: Node, sign: str, order: int) -> tuple[Node, ...] | None:
    """The x of a numerator that begins with dx, empty for a bare d; None if it begins otherwise."""
    match factor:
        case Differential(of, printed) if printed == sign and order == 1:
            return (of,)
        case Power(Differential(of, printed), exponent) if printed == sign and order == 1:
            return (Power(of, exponent, span=factor.span),)
        case Name(letter, "", 0 | 1, "", "") if letter == _DERIVING[sign] and order == 1:
            return ()
        case Power(Name(letter, "", 0 | 1, "", ""), Number(text)) if letter == _DERIVING[sign]:
            return () if text == str(order) else None
    return None


def _frame(factor: Node) -> str:
    """The triad that a d names: N of ᴺd, ``"'"`` of d'."""
    sign = factor.base if isinstance(factor, Power) else factor
    if not isinstance(sign, Name):
        return ""
    return sign.prescript + "'" * sign.primes
