"""Whether expressions are functions of one another, by the rank of their gradients."""

from __future__ import annotations

from collections.abc import Iterable

from flint import nmod_mat

from polhode.algebra import Expr, Symbol
from polhode.analyse._points import points

_SEED = 20261121


class Independent:
    """A growing set of functions of the state none of which is a function of the others.

    Decided at one random point: rank can only be lost there by a rare accident.
    """

    def __init__(self, state: Iterable[Symbol]) -> None:
        self._state = tuple(state)
        self._gradients: list[list[Expr]] = []

    def takes(self, expression: Expr) -> bool:
        """Add an expression if it is independent of those taken before."""
        gradients = [*self._gradients, [expression.diff(symbol) for symbol in self._state]]
        entries = [entry for gradient in gradients for entry in gradient]
        (point,) = points(entries, self._state, 1, _SEED)
        table = nmod_mat(len(gradients), len(self._state), point.all(entries), point.field.prime)
        if table.rank() < len(gradients):
            return False
        self._gradients = gradients
        return True
