"""Derivatives of programs, against complex steps of the programs themselves.

f(x + i h) = f(x) + i h f'(x) + O(h²): with h = 1e-40 the imaginary part has all its digits.
"""

import cmath

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polhode.algebra import (
    Arithmetic,
    Expr,
    Symbol,
    SymbolKind,
    compile_program,
    cos,
    differentiated,
    exp,
    sin,
    sqrt,
    symbol,
)

NAMES = ("x", "y", "p")
X, Y, P = (symbol(name) for name in NAMES)
ARGUMENTS = tuple(next(iter(e.symbols())) for e in (X, Y, P))
SIZES = st.floats(0.25, 2.0)
STEP = 1e-40


def grown(inner):
    """Roots and denominators do not vanish."""
    pairs = st.tuples(inner, inner)
    return st.one_of(
        pairs.map(lambda ab: ab[0] + ab[1]),
        pairs.map(lambda ab: ab[0] - ab[1]),
        pairs.map(lambda ab: ab[0] * ab[1]),
        pairs.map(lambda ab: ab[0] / (1 + ab[1] ** 2)),
        st.sampled_from([X, Y, P, X * Y, X - P]).map(exp),
        inner.map(sin),
        inner.map(cos),
        inner.map(lambda a: sqrt(2 + a**2)),
    )


expressions = st.recursive(st.sampled_from([X, Y, P, Expr.of(3) / 7]), grown, max_leaves=6)


def by_complex_steps(program, values):
    """Of every output by every argument."""
    function = program.function(Arithmetic.of(cmath))
    for k in range(len(values)):
        moved = [complex(value, STEP * (i == k)) for i, value in enumerate(values)]
        yield [complex(found).imag / STEP for found in function(*moved)]


@given(st.lists(expressions, min_size=1, max_size=3), st.tuples(SIZES, SIZES, SIZES))
def test_they_are_those_by_complex_steps(wanted, values):
    program = compile_program(wanted, ARGUMENTS)
    units = {s: [int(s == other) for other in ARGUMENTS] for s in ARGUMENTS}
    found = differentiated(program, ARGUMENTS, units).function()(*values)
    columns = list(by_complex_steps(program, values))
    slopes = found[len(wanted) :]
    assert found[: len(wanted)] == pytest.approx(program.function()(*values), rel=1e-14)
    for i in range(len(wanted)):
        expected = [column[i] for column in columns]
        assert slopes[3 * i : 3 * i + 3] == pytest.approx(expected, rel=1e-11, abs=1e-12)


def test_directions_may_be_arguments_themselves():
    """Along (u, v) the product x y changes by u y + v x; p is kept."""
    u, v = (Symbol(name, SymbolKind.COORDINATE) for name in "uv")
    program = compile_program([X * Y + P], ARGUMENTS)
    x, y, p = ARGUMENTS
    along = differentiated(program, (x, u, y, v, p), {x: [u], y: [v]})
    assert along.arguments == (x, u, y, v, p)
    assert along.function()(2.0, 10.0, 3.0, 100.0, 7.0) == (13.0, 230.0)
