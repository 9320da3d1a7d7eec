"""Exact expressions evaluated in floating point, at one state or at arrays of states."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import PI, Expr, Generator, Symbol, under_name
from polhode.base import PolhodeError

Array: TypeAlias = NDArray[np.float64]

_FUNCTIONS = {name: getattr(np, name) for name in ("sin", "cos", "sinh", "cosh", "exp", "sqrt")}

#: The exceptions raised where an expression or a formula has no value at a state.
NO_VALUE = (PolhodeError, ArithmeticError, ValueError, KeyError)


def number(
    expression: Expr, values: Mapping[Symbol, Any], known: dict[Generator, Any] | None = None
) -> Any:
    """The value of an expression, in the shape of the values; `KeyError` for unknown symbols.

    Args:
        expression: any.
        values: of its symbols.
        known: values of generators from earlier calls with the same values of symbols; more of them
            are added to it. Long parts under names are then evaluated once.
    """
    with np.errstate(all="ignore"):
        return _value(expression, values, {} if known is None else known)


def numbers(
    expressions: Iterable[Expr], values: Mapping[Symbol, Any], shape: tuple[int, ...]
) -> Array:
    """Values of several expressions: (expressions, *shape)."""
    known: dict[Generator, Any] = {}
    wanted = tuple(expressions)
    found = np.empty((len(wanted), *shape))
    with np.errstate(all="ignore"):
        for place, expression in enumerate(wanted):
            found[place] = _value(expression, values, known)
    return found


@dataclass(frozen=True, eq=False)
class Rational:
    """The value of an expression as a rational function of one unknown.

    Attributes:
        above: coefficients of the numerator, from that of the highest power down: (powers, *shape).
        below: those of the denominator.
    """

    above: Array
    below: Array

    def __call__(self, at: Array) -> Array:
        """Values, one unknown for each entry of the shape."""
        return np.asarray(np.polyval(self.above, at) / np.polyval(self.below, at))


def rationals(
    expressions: Iterable[Expr],
    unknown: Symbol,
    values: Mapping[Symbol, Any],
    shape: tuple[int, ...],
) -> list[Rational] | None:
    """Expressions as rational functions of an unknown; None if it is inside a root or a sine."""
    known: dict[Generator, Any] = {}
    found = []
    with np.errstate(all="ignore"):
        for expression in expressions:
            others = [g for g in expression.generators if g != unknown]
            if any(unknown in g.symbols() for g in others):
                return None
            _evaluate(others, values, known)
            parts = (expression.numerator, expression.denominator)
            above, below = (_coefficients(part, unknown, known, shape) for part in parts)
            found.append(Rational(above, below))
    return found


def _coefficients(
    polynomial: Expr, unknown: Symbol, known: Mapping[Generator, Any], shape: tuple[int, ...]
) -> Array:
    """Coefficients of the powers of the unknown, the highest power first, as `np.polyval` takes."""
    found: dict[int, Any] = {}
    for powers, coefficient in polynomial.terms():
        power = powers.pop(unknown, 0)
        found[power] = found.get(power, 0.0) + _term(powers, coefficient, known)
    count = max(found, default=0) + 1
    return np.array([np.broadcast_to(found.get(p, 0.0), shape) for p in reversed(range(count))])


def _value(expression: Expr, values: Mapping[Symbol, Any], known: dict[Generator, Any]) -> Any:
    _evaluate(expression.generators, values, known)
    factors = [known.get(generator) for generator in expression.ring.generators]
    above = _sum(expression.num, factors)
    if expression.is_polynomial:
        return above
    # NumPy's division gives inf or nan at a pole, where Python's would raise an exception.
    return np.true_divide(above, _sum(expression.den, factors))


def _evaluate(
    generators: Iterable[Generator], values: Mapping[Symbol, Any], known: dict[Generator, Any]
) -> None:
    for generator in generators:
        if generator not in known:
            known[generator] = _generator_value(generator, values, known)


def _sum(polynomial: Any, factors: Sequence[Any]) -> Any:
    """The value of a polynomial of FLINT at values of its generators."""
    total: Any = 0.0
    for powers, coefficient in polynomial.terms():
        term: Any = float(coefficient)
        for factor, power in zip(factors, map(int, powers), strict=True):
            if power:
                term = term * (factor if power == 1 else factor**power)
        total = total + term
    return total


def _term(
    powers: Mapping[Generator, int], coefficient: Fraction, known: Mapping[Generator, Any]
) -> Any:
    term: Any = float(coefficient)
    for generator, power in powers.items():
        value = known[generator]
        term = term * (value if power == 1 else value**power)
    return term


def _generator_value(
    generator: Generator, values: Mapping[Symbol, Any], known: dict[Generator, Any]
) -> Any:
    if isinstance(generator, Symbol):
        return np.pi if generator == PI else values[generator]
    meaning = under_name(generator)
    if meaning is not None:
        return _value(meaning, values, known)
    function = _FUNCTIONS[generator.key.partition("(")[0]]
    return function(_value(generator.arguments[0], values, known))
