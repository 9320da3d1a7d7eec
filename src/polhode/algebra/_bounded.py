"""Arithmetic on typed expressions that refuses, before it is tried, what would take long."""

from __future__ import annotations

from collections.abc import Callable
from math import comb, prod

from polhode.algebra import _functions as functions
from polhode.algebra._expression import Expr
from polhode.algebra._roots import absolute, sqrt
from polhode.base import NumericError

HIGHEST = 64  # power
MOST_TERMS = 2000  # of an expression multiplied out
MOST_BITS = 4096  # of a whole number raised to a power
MOST_BITS_OF_ROOT = 160  # of a whole number that is factorised to take a root

FUNCTIONS: dict[str, Callable[[Expr], Expr]] = {
    "sin": functions.sin,
    "cos": functions.cos,
    "tan": functions.tan,
    "sqrt": sqrt,
    "abs": absolute,
    "exp": functions.exp,
    "sinh": functions.sinh,
    "cosh": functions.cosh,
    "tanh": functions.tanh,
}
"""What may be applied, by name."""


def add(first: Expr, second: Expr) -> Expr:
    """The sum; like all that follows, raises `NumericError` for what may be too long."""
    _refuse_many(max(_size(first) * _below(second), _size(second) * _below(first)))
    return _small(first + second)


def multiply(first: Expr, second: Expr) -> Expr:
    """The product."""
    _refuse_many(_size(first) * _size(second))
    return _small(first * second)


def raise_to(base: Expr, exponent: Expr) -> Expr:
    """A whole or half-integer power."""
    power = exponent.rational
    if power is None or abs(power) > HIGHEST:
        raise NumericError(
            "a power that is no number, or too high", expected=f"one from -{HIGHEST} to {HIGHEST}"
        )
    times = abs(power.numerator)
    _refuse_many(comb(_size(base) + times - 1, times))
    _refuse_long(_bits(base) * times, MOST_BITS)
    if power.denominator > 1:
        _refuse_hard_root(base)
    return _small(base**power)


def apply(name: str, argument: Expr) -> Expr:
    """A function of `FUNCTIONS`."""
    if name in ("sqrt", "abs"):
        _refuse_hard_root(argument)
    else:  # sines of sums and multiples are written out in those of the parts
        _refuse_many(prod(2 * min(abs(c.numerator), 8) for _, c in argument.terms()))
    return _small(FUNCTIONS[name](argument))


def _refuse_hard_root(radicand: Expr) -> None:
    _refuse_many(_size(radicand) ** 2)
    _refuse_long(_bits(radicand), MOST_BITS_OF_ROOT)


def _small(expression: Expr) -> Expr:
    _refuse_many(_size(expression))
    return expression


def _refuse_many(terms: int) -> None:
    if terms > MOST_TERMS:
        raise NumericError("a result that may be very long", expected=f"at most {MOST_TERMS} terms")


def _refuse_long(bits: int, most: int) -> None:
    if bits > most:
        raise NumericError(
            f"a number of {round(bits * 0.30103)} digits",
            expected=f"at most {round(most * 0.30103)} digits",
        )


def _size(expression: Expr) -> int:
    """Number of terms above or below the bar, whichever is more."""
    return max(sum(1 for _ in expression.terms()), _below(expression))


def _below(expression: Expr) -> int:
    return sum(1 for _ in expression.denominator.terms())


def _bits(expression: Expr) -> int:
    """Length of the longest coefficient, numerator and denominator together."""
    numbers = [c for part in (expression, expression.denominator) for _, c in part.terms()]
    return max((c.numerator.bit_length() + c.denominator.bit_length() for c in numbers), default=0)
