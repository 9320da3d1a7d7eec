"""Exact values for analysis: what "theta=pi/2" means."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from polhode.algebra import Expr, Symbol, pi
from polhode.base import PURE, TIME, Quantity, UnitError, look_up, read_quantity
from polhode.catalogue._values import read_value
from polhode.derive import Equations

#: Angles in these fractions of π have sines that are square roots; others are kept as decimals.
_EXACT_FRACTION = 12


def exact_values(equations: Equations, texts: Mapping[str, str]) -> dict[Symbol, Expr]:
    """Coordinates, speeds and parameters given exactly, by symbol.

    Args:
        equations: of the system they belong to.
        texts: expressions of parameters, or numbers with a unit, by published name.

    Raises:
        DeclarationError: for a name the system does not have.
        ParseError: for text that is no value; UnitError for one of the wrong dimension.
    """
    rates = [q.derivative() for q in equations.coordinates]
    everything = (*equations.coordinates, *rates, *equations.speeds, *equations.parameters)
    known = {symbol.published: symbol for symbol in everything}
    constants = {symbol.published: symbol for symbol in equations.parameters}
    found = {}
    for name, text in texts.items():
        symbol = look_up(name, known, f"quantity of {equations.system.name}")
        value = read_value(name, text, constants)
        found[symbol] = _measured(equations, symbol, value) if isinstance(value, str) else value
    return found


def _measured(equations: Equations, symbol: Symbol, text: str) -> Expr:
    quantity = read_quantity(text)
    base = equations.dimensions.get(symbol.base())
    wanted = base / TIME**symbol.order if base is not None else None
    if wanted is not None and quantity.dimension not in (None, wanted):
        raise UnitError(
            f"{symbol.published} = {text!r} is a quantity in {quantity.dimension}",
            expected=f"a quantity in {wanted}",
            advice="give a bare SI number or a unit of that dimension",
        )
    return _exactly(quantity)


def _exactly(quantity: Quantity) -> Expr:
    is_turn = quantity.pi_power == 1 and quantity.dimension == PURE
    if is_turn and _EXACT_FRACTION % quantity.coefficient.denominator:
        return Expr.of(Fraction(repr(quantity.value)))
    return Expr.of(quantity.coefficient) * pi**quantity.pi_power
