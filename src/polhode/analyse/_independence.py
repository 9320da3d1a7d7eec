"""Whether an expression is a function of others, by the rank of their gradients."""

from __future__ import annotations

from random import Random

from flint import fmpq, fmpq_mat

from polhode.algebra import Expr, Kind, Symbol
from polhode.analyse._points import at_point, random_point


def independent(expression: Expr, known: list[Expr]) -> bool:
    """Whether an expression is independent of the known ones as functions of the state.

    Decided at random rational points: rank can only be lost there by a rare accident.
    """
    everything = [*known, expression]
    variables = sorted(
        {s for e in everything for s in e.symbols() if s.kind is not Kind.PARAMETER},
        key=lambda s: s.published,
    )
    if not variables or not expression.symbols() & set(variables):
        return False
    gradients = [[e.diff(s) for s in variables] for e in everything]
    entries = [entry for row in gradients for entry in row]
    point = random_point(entries, Random(20261121))
    table = [[at_point(entry, point) for entry in row] for row in gradients]
    matrix = fmpq_mat([[fmpq(v.numerator, v.denominator) for v in row] for row in table])
    return bool(matrix.rank() == len(everything))


def varying(expression: Expr) -> frozenset[Symbol]:
    """The symbols in an expression that are not constants."""
    return frozenset(s for s in expression.symbols() if s.kind is not Kind.PARAMETER)
