"""Whether expressions are functions of one another, by the rank of their gradients."""

from __future__ import annotations

from collections.abc import Iterable
from random import Random

from flint import fmpq_mat

from polhode.algebra import Expr, Symbol
from polhode.analyse._points import Point, Rational, random_values


class Independent:
    """A growing set of functions of the state none of which is a function of the others.

    Decided at one random rational point: rank can only be lost there by a rare accident.
    """

    def __init__(self, state: Iterable[Symbol], constants: Iterable[Symbol]) -> None:
        self._state = tuple(state)
        symbols = (*self._state, *constants)
        self._point = Point(random_values(symbols, Random(20261121)))
        self._gradients: list[list[Rational]] = []

    def takes(self, expression: Expr) -> bool:
        """Add an expression if it is independent of those taken before."""
        gradient = self._point.all(expression.diff(symbol) for symbol in self._state)
        table = fmpq_mat([*self._gradients, gradient])
        if table.rank() == len(self._gradients):
            return False
        self._gradients.append(gradient)
        return True
