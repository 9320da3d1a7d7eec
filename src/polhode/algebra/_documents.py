"""Expressions in documents: written as plain fields and read back.

A document may come from anyone. Reading therefore checks each part for the normal form in which
equality is decided, and its size, instead of trusting the writer.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from fractions import Fraction
from math import gcd
from typing import Any

from flint import fmpq

from polhode.algebra._expression import ZERO, Expr
from polhode.algebra._functions import (
    CIRCULAR,
    HYPERBOLIC,
    Elementary,
    Even,
    Exponential,
    Odd,
    is_unit_argument,
)
from polhode.algebra._ring import Generator, Polynomial, Ring, Symbol, SymbolKind, ring_of
from polhode.algebra._roots import SquareRoot, sqrt
from polhode.algebra._symbols import is_name
from polhode.algebra._vector import Matrix
from polhode.base import ShapeRecord

_LARGEST_POWER = 1000
_MOST_TERMS = 5000
_HIGHEST_DERIVATIVE = 9

_FUNCTIONS: Mapping[str, tuple[type[Elementary], Any]] = {
    "sin": (Odd, CIRCULAR),
    "cos": (Even, CIRCULAR),
    "sinh": (Odd, HYPERBOLIC),
    "cosh": (Even, HYPERBOLIC),
    "exp": (Exponential, HYPERBOLIC),
}


# -- symbols ---------------------------------------------------------------------------------------


def _symbol_fields(symbol: Symbol) -> dict[str, Any]:
    return {
        "name": symbol.name,
        "kind": symbol.kind.value,
        "order": symbol.order,
        "positive": symbol.positive,
    }


def _symbol(name: str, kind: str, order: int, positive: bool) -> Symbol:
    # polhode's own symbols may have blanks in their names, which users cannot declare
    named = isinstance(name, str) and is_name(name.replace(" ", "_"))
    if not named or (name == "t") != (kind == "time"):
        raise ValueError(f"the name {name!r}")
    if type(order) is not int or not 0 <= order <= _HIGHEST_DERIVATIVE:
        raise ValueError(f"the derivative {order!r}")
    if type(positive) is not bool:
        raise ValueError(f"the sign {positive!r}")
    return Symbol(name, SymbolKind(kind), order, positive)


# -- functions -------------------------------------------------------------------------------------


def _function_fields(function: Elementary) -> dict[str, Any]:
    unit = function.unit
    return {
        "name": function.name,
        "of": function.base,
        "times": (unit.numerator, unit.denominator),
    }


def _function(name: str, of: Expr, times: tuple[int, int]) -> Elementary:
    kind, family = _FUNCTIONS[name]
    unit = _rational(*times)
    if unit <= 0 or not is_unit_argument(family, of):
        raise ValueError(f"{name} of an argument that is not in normal form")
    return kind(family, of, unit)


def _root(of: Expr) -> SquareRoot:
    root = SquareRoot(of.trimmed())
    if sqrt(of) != Expr.generator(root):
        raise ValueError("a root that is not in normal form")
    return root


# -- expressions -----------------------------------------------------------------------------------


def _expression_fields(expression: Expr) -> dict[str, Any]:
    return {
        "over": expression.generators,
        "above": _terms(expression, expression.num),
        "below": _terms(expression, expression.den),
    }


def _terms(expression: Expr, polynomial: Polynomial) -> tuple[Any, ...]:
    terms = expression.ring.plain(expression.generators, polynomial)
    return tuple(sorted((tuple(map(int, powers)), p, q) for powers, p, q in terms))


def _expression(over: tuple[Generator, ...], above: Any, below: Any) -> Expr:
    if len(set(over)) < len(over) or not all(isinstance(g, Generator) for g in over):
        raise ValueError("an expression whose symbols are not all different")
    ring = ring_of(frozenset(over))
    num = _polynomial(ring, over, above)
    den = _polynomial(ring, over, below)
    if den == 0 or any(den.degrees()[ring.index[g]] for g in over if g.depth):
        raise ValueError("a fraction with zero or a root below the bar")
    return Expr(ring, *ring.cancel(num, den)) if num != 0 else ZERO


def _polynomial(
    ring: Ring, over: tuple[Generator, ...], terms: Iterable[tuple[tuple[int, ...], int, int]]
) -> Polynomial:
    table = {}
    for number, (powers, p, q) in enumerate(terms):
        if number >= _MOST_TERMS:
            raise ValueError("more terms than a declaration has")
        monomial = [0] * len(ring.generators)
        for generator, power in zip(over, powers, strict=True):
            if type(power) is not int or not 0 <= power <= (
                1 if generator.depth else _LARGEST_POWER
            ):
                raise ValueError(f"the power {power!r}")
            monomial[ring.index[generator]] = power
        value = _rational(p, q)
        table[tuple(monomial)] = fmpq(value.numerator, value.denominator)
    return ring.context.from_dict(table)


def _rational(p: int, q: int) -> Fraction:
    if type(p) is not int or type(q) is not int or q <= 0 or gcd(p, q) != 1:
        raise ValueError(f"the fraction {p!r}/{q!r}")
    return Fraction(p, q)


# -- matrices --------------------------------------------------------------------------------------


def _matrix(rows: tuple[tuple[Expr, ...], ...]) -> Matrix:
    if {len(row) for row in rows} != {len(rows)}:
        raise ValueError("a matrix that is not square")
    if not all(isinstance(entry, Expr) for row in rows for entry in row):
        raise ValueError("a matrix of anything but expressions")
    return Matrix(rows)


#: Document forms of expressions and of their parts.
SHAPES = (
    ShapeRecord("symbol", (Symbol,), _symbol_fields, _symbol),
    ShapeRecord("function", (Odd, Even, Exponential), _function_fields, _function),
    ShapeRecord("root", (SquareRoot,), lambda root: {"of": root.radicand}, _root),
    ShapeRecord("expression", (Expr,), _expression_fields, _expression),
    ShapeRecord("matrix", (Matrix,), lambda matrix: {"rows": matrix.rows}, _matrix),
)
