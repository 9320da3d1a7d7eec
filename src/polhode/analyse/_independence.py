"""Whether an expression is a function of others, by the rank of their gradients."""

from __future__ import annotations

from random import Random

from flint import fmpq_mat

from polhode.algebra import Expr, Kind, variables
from polhode.analyse._points import exact_function, random_values


def independent(expression: Expr, known: list[Expr]) -> bool:
    """Whether an expression is independent of the known ones as functions of the state.

    Decided at a random rational point: rank can only be lost there by a rare accident.
    """
    everything = [*known, expression]
    symbols = sorted(variables(everything), key=lambda s: s.published)
    varying = [s for s in symbols if s.kind is not Kind.PARAMETER]
    if not varying or not expression.symbols() & set(varying):
        return False
    gradients = exact_function([e.diff(s) for e in everything for s in varying], symbols)
    values = gradients(random_values(len(symbols), Random(20261121)))
    matrix = fmpq_mat(len(everything), len(varying), list(values))
    return bool(matrix.rank() == len(everything))
