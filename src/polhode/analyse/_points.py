"""Exact evaluation at rational points, with sines and cosines on the unit circle."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from random import Random
from typing import Any

from flint import fmpq

from polhode.algebra import Arithmetic, Expr, Op, Symbol, compile_program
from polhode.base import NumericError

Values = tuple[Any, ...]


def exact_function(
    expressions: Sequence[Expr], symbols: Sequence[Symbol]
) -> Callable[[Sequence[Any]], Values]:
    """The values of expressions at rational arguments.

    Stands sin x → 2x/(1 + x²) and cos x → (1 - x²)/(1 + x²) in for the sine and cosine: other
    points, but with every algebraic relation intact, which is all that identities ask for.
    """
    program = compile_program(expressions, symbols)
    function = program.function(_RATIONAL)
    return lambda values: tuple(fmpq(v) for v in function(*values))


def random_values(count: int, random: Random) -> list[Any]:
    """Rational numbers between 1/50 and 50."""
    return [fmpq(random.randint(2, 97), random.randint(2, 97)) for _ in range(count)]


def _no_rational_value(_: Any) -> Any:
    raise NumericError(
        "a square root or an exponential in a search for integrals",
        expected="equations in polynomials, sines and cosines",
        advice="the named candidates are still tried",
    )


_RATIONAL = Arithmetic(
    number=lambda value: fmpq(value.numerator, value.denominator),
    pi=fmpq(22, 7),
    functions={
        Op.SIN: lambda x: 2 * x / (1 + x * x),
        Op.COS: lambda x: (1 - x * x) / (1 + x * x),
        Op.SINH: lambda x: 2 * x / (1 - x * x),
        Op.COSH: lambda x: (1 + x * x) / (1 - x * x),
        Op.SQRT: _no_rational_value,
        Op.EXP: _no_rational_value,
    },
)
