"""Exact values for analysis: what "theta=pi/2" means."""

from __future__ import annotations

from collections.abc import Mapping

from polhode.algebra import Expr, Symbol
from polhode.analyse import exact_value
from polhode.base import look_up
from polhode.catalogue._values import read_value
from polhode.derive import Equations


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
        found[symbol] = exact_value(value, symbol, equations.dimensions)
    return found
