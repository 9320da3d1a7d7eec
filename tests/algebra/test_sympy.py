"""To SymPy and back without loss."""

import subprocess
import sys
from fractions import Fraction

import pytest
import sympy
from hypothesis import assume, given, settings
from sympy.physics.mechanics import dynamicsymbols

from algebra.backends import (
    NAMES,
    SYMPY,
    a,
    evaluated,
    expression_of,
    polynomials,
    theta,
    trees,
    x,
    y,
)
from polhode.algebra import (
    SymbolKind,
    absolute,
    as_symbol,
    cos,
    cosh,
    exp,
    from_sympy,
    is_positive,
    pi,
    sin,
    sinh,
    speeds,
    sqrt,
    symbol,
    tan,
    to_sympy,
)
from polhode.base import NumericError

X, T = sympy.symbols("x t")


@settings(max_examples=80)
@given(trees)
def test_there_and_back(tree):
    expression = expression_of(tree)
    assume(expression is not None)
    again = from_sympy(to_sympy(expression), NAMES)
    assert (again - expression) * (again + expression) == 0
    assert not absolute_free(expression) or again == expression


def absolute_free(expression):
    """Whether no factor of unknown sign was taken out of a root in another order."""
    return "abs" not in str(expression)


@given(polynomials)
def test_what_sympy_makes_of_it_is_the_same(tree):
    assert from_sympy(evaluated(tree, SYMPY), NAMES) == expression_of(tree)
    assert from_sympy(sympy.expand(evaluated(tree, SYMPY)), NAMES) == expression_of(tree)


def test_every_symbol_is_a_plain_one_of_its_published_name():
    there = to_sympy(theta.dt().dt() * a + pi)
    assert there.free_symbols == {sympy.Symbol("theta_ddot"), sympy.Symbol("a")}
    assert sympy.srepr(there) == "Add(Mul(Symbol('a'), Symbol('theta_ddot')), pi)"


def test_names_can_be_given():
    q = dynamicsymbols("theta")
    assert to_sympy(sin(theta), {"theta": q}) == sympy.sin(q)
    assert from_sympy(X, {"x": sin(theta)}) == sin(theta)
    assert from_sympy(sympy.Symbol("theta_ddot"), {"theta": theta}) == theta.dt().dt()


@pytest.mark.parametrize(
    ("theirs", "ours"),
    [
        (sympy.Integer(-3), -3),
        (sympy.Rational(2, 3), Fraction(2, 3)),
        (sympy.Float("0.1"), Fraction(1, 10)),
        (sympy.pi / 2, pi / 2),
        (sympy.E, exp(1)),
        (sympy.sqrt(X), sqrt(x)),
        (X ** sympy.Rational(-3, 2), 1 / (x * sqrt(x))),
        (sympy.tan(X), tan(x)),
        (sympy.cot(X), cos(x) / sin(x)),
        (sympy.sec(X), 1 / cos(x)),
        (sympy.csc(X), 1 / sin(x)),
        (sympy.tanh(X), sinh(x) / cosh(x)),
        (sympy.sech(X), 1 / cosh(x)),
        (sympy.exp(2 * X), exp(2 * x)),
        (sympy.Abs(X), absolute(x)),
        (2 * X / sympy.Symbol("y") - 1, 2 * x / y - 1),
    ],
)
def test_what_is_read(theirs, ours):
    assert from_sympy(theirs) == ours


def test_unknown_symbols_become_parameters_that_keep_their_sign():
    found = from_sympy(sympy.Symbol("q", positive=True))
    assert as_symbol(found).kind is SymbolKind.PARAMETER
    assert is_positive(found)
    assert not is_positive(from_sympy(sympy.Symbol("q")))


def test_dynamicsymbols_become_coordinates():
    q = dynamicsymbols("theta")
    assert from_sympy(q) == theta
    assert from_sympy(sympy.sin(q).diff(T, 2)) == sin(theta).dt().dt()
    omega = speeds("omega_3")[0]
    rate = from_sympy(dynamicsymbols("omega_3", 1), {"omega_3": omega})
    assert rate == omega.dt()


def test_expressions_of_sympy_mix_with_ours():
    assert theta + X == theta + x
    assert X * theta == x * theta
    assert theta.subs({theta: sympy.pi / 2}) == pi / 2


@pytest.mark.parametrize(
    "value",
    [
        sympy.oo,
        sympy.nan,
        sympy.I,
        sympy.zoo,
        sympy.log(X),
        X**X,
        X ** sympy.Rational(1, 3),
        sympy.Function("f")(X),
        sympy.Function("f")(X, T),
        sympy.Function("f")(),
        sympy.Derivative(sympy.Function("f")(X), X),
        sympy.Integral(X, X),
        sympy.Eq(X, 1),
        sympy.Matrix([X]),
        sympy.Symbol("x dot"),
        sympy.Symbol("theta_dot"),
        sympy.true,
        sympy.asin(X),
        sympy.sin(sympy.pi / 7),
        "x",
        None,
        object(),
    ],
)
def test_anything_else_is_refused_by_name(value):
    with pytest.raises(NumericError):
        from_sympy(value)


def test_an_undefined_function_called_sin_is_no_sine():
    with pytest.raises(NumericError):
        from_sympy(sympy.Function("sin")(X))
    assert from_sympy(sympy.Function("sin")(T)) != sin(symbol("t_0"))


def test_the_error_names_what_came():
    with pytest.raises(NumericError, match=r"log\(x\) of type log"):
        from_sympy(sympy.log(X) + 1)


def test_printing_and_arithmetic_do_not_load_sympy():
    program = (
        "import sys; from polhode.algebra import *;"
        "q, = coordinates('q'); print(sin(q) / cos(q), q.latex(), file=sys.stderr);"
        "print('sympy' in sys.modules)"
    )
    run = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert run.stdout.strip() == "False"
