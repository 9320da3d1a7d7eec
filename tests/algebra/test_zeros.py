"""Orders of zeros, against those of products that are put together with known ones."""

from __future__ import annotations

import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

import polhode as ph
from polhode.algebra import Expr, Symbol, SymbolKind, zeros

X, Y, THETA, PHI = ph.coordinates("x y theta phi")
A = ph.symbol("a", positive=True)

#: Expressions with one simple zero, and how their equation is written.
SIMPLE = {
    X: "x",
    X - Y: "x - y",
    X - A: "a - x",
    THETA - X: "theta - x",
}


def varies(symbol: Symbol) -> bool:
    return symbol.kind is SymbolKind.COORDINATE


def orders(expression: Expr) -> list[int]:
    return sorted(zero.order for zero in zeros(expression, varies))


@settings(max_examples=40)
@given(st.dictionaries(st.sampled_from(list(SIMPLE)), st.integers(1, 3), min_size=1))
def test_products_vanish_to_the_order_of_their_powers(powers: dict[Expr, int]) -> None:
    expression = A * (1 + X**2 + Y**2)
    for factor, power in powers.items():
        expression = expression * factor**power
    assert orders(expression) == sorted(powers.values())


#: Trigonometric equations with the values of θ at which they hold.
TRIGONOMETRIC = [
    ("1 - cos(theta)", [0]),
    ("1 + cos(theta)", [sympy.pi]),
    ("1 - sin(theta)", [sympy.pi / 2]),
    ("1 + sin(theta)", [-sympy.pi / 2]),
    ("sin(theta)", [0, sympy.pi]),
    ("cos(theta)", [sympy.pi / 2, -sympy.pi / 2]),
    ("sin(theta)**2", [0, sympy.pi]),
    ("sin(theta)*(1 - cos(theta))", [0, sympy.pi]),
    ("sin(theta)*(1 + cos(theta))", [0, sympy.pi]),
    ("cos(theta)**3", [sympy.pi / 2, -sympy.pi / 2]),
    ("1 - cos(2*theta)", [0, sympy.pi]),
    ("cos(theta)*(1 - sin(theta))", [sympy.pi / 2, -sympy.pi / 2]),
]


@pytest.mark.parametrize(("text", "places"), TRIGONOMETRIC)
def test_orders_are_those_of_the_first_derivative_that_does_not_vanish(
    text: str, places: list[sympy.Expr]
) -> None:
    """SymPy differentiates."""
    theta = sympy.Symbol("theta")
    plain = sympy.sympify(text, {"theta": theta})
    expected = {
        float(place): next(
            k for k in range(1, 9) if sympy.simplify(plain.diff(theta, k).subs(theta, place)) != 0
        )
        for place in places
    }
    expression = ph.Expr.of(0) + eval(text, {"theta": THETA, "cos": ph.cos, "sin": ph.sin})
    found = {}
    for zero in zeros(expression, varies):
        assert zero.equation is not None
        constant = zero.equation - THETA
        found[float(-sympy.sympify(str(constant)))] = zero.order
    assert found == pytest.approx(expected)


def test_sums_of_squares_change_no_sign() -> None:
    (zero,) = zeros(X**2 + A * Y**2, varies)
    assert zero.is_extreme
    assert not zero.is_simple
    (zero,) = zeros(2 - ph.cos(THETA) - ph.cos(PHI), varies)
    assert zero.is_extreme
    (zero,) = zeros(X**2 + Y**2 - A**2, varies)
    assert zero.is_simple
    assert not zeros(1 + X**2, varies)
