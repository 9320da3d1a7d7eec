"""Values of exact expressions by floating-point numbers, one at a time or in arrays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, Generator, Symbol

Array: TypeAlias = NDArray[np.float64]

_FUNCTIONS = {name: getattr(np, name) for name in ("sin", "cos", "sinh", "cosh", "exp", "sqrt")}
_PI = Symbol("pi")


def number(expression: Expr, values: Mapping[Symbol, Any]) -> Any:
    """The value of an expression, in the shape of the values; `KeyError` for unknown symbols."""
    known: dict[Generator, Any] = {}
    with np.errstate(all="ignore"):
        return _of(expression, values, known)


def numbers(expressions: list[Expr], values: Mapping[Symbol, Any], shape: tuple[int, ...]) -> Array:
    """Values of several expressions: (expressions, *shape)."""
    known: dict[Generator, Any] = {}
    with np.errstate(all="ignore"):
        found = [np.broadcast_to(_of(e, values, known), shape) for e in expressions]
    return np.array(found, dtype=float).reshape(len(found), *shape)


def _of(expression: Expr, values: Mapping[Symbol, Any], known: dict[Generator, Any]) -> Any:
    for generator in expression.generators:
        if generator not in known:
            known[generator] = _generator(generator, values, known)
    above = _sum(expression.numerator, known)
    if expression.is_polynomial:
        return above / _sum(expression.denominator, known)
    return np.true_divide(above, _sum(expression.denominator, known))


def _sum(polynomial: Expr, known: Mapping[Generator, Any]) -> Any:
    total: Any = 0.0
    for powers, coefficient in polynomial.terms():
        term: Any = float(coefficient)
        for generator, power in powers.items():
            term = term * known[generator] ** power
        total = total + term
    return total


def _generator(
    generator: Generator, values: Mapping[Symbol, Any], known: dict[Generator, Any]
) -> Any:
    if isinstance(generator, Symbol):
        return np.pi if generator == _PI else values[generator]
    function = _FUNCTIONS[generator.key.partition("(")[0]]
    return function(_of(generator.arguments[0], values, known))
