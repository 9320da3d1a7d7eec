"""Trigonometric fractions in lowest terms: the same value, and no sine that both sides share."""

from functools import reduce
from math import cos as cosine
from math import sin as sine

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from algebra.backends import KERNEL, a, angles, b, evaluated, phi, theta, x
from polhode.algebra import (
    Expr,
    as_symbol,
    compile_program,
    cos,
    lowest_numerator,
    sin,
    sqrt,
)
from polhode.algebra._half_angles import lowest

trigonometric = st.one_of(
    st.tuples(st.sampled_from(["sin", "cos"]), angles()).map(lambda tree: evaluated(tree, KERNEL)),
    st.sampled_from([a + b * cos(theta), x, a * sin(theta) + b * cos(phi)]),
)
products = st.lists(trigonometric, min_size=1, max_size=2).map(
    lambda factors: reduce(Expr.__mul__, factors)
)


def put_together(expression: Expr) -> Expr:
    """The fraction in lowest terms, as an expression in normal form again."""
    cancelled = lowest(expression)
    assert cancelled is not None
    ring = expression.ring
    factors = (Expr(ring, ring.reduce(f), ring.one) ** e for f, e in cancelled.factors)
    return Expr(ring, cancelled.num, ring.one) / reduce(Expr.__mul__, factors)


@settings(max_examples=60)
@given(products, products)
def test_the_value_stays(above, below):
    assume(below)
    expression = above / below
    if lowest(expression) is not None:
        assert put_together(expression) == expression
    numerator = lowest_numerator(expression)
    assert numerator.is_polynomial
    assert numerator.is_zero == expression.is_zero


@pytest.mark.parametrize(
    ("above", "below"),
    [
        (sin(theta - phi), sin(theta + phi)),
        (a * cos(theta - phi) ** 2, b * cos(theta + phi) ** 3),
        (x, a + b * cos(theta)),
        (x * sin(theta), (a + b * cos(theta)) ** 2),
        (sqrt(a * x), sin(phi - theta)),
        (x, 1 - cos(theta) * cos(phi)),
        (sin(theta), cos(theta)),
    ],
)
def test_what_both_sides_share_is_gone(above, below):
    expression = above / below
    cancelled = lowest(expression)
    assert cancelled is not None
    assert put_together(expression) == expression
    assert (lowest_numerator(expression) / above).rational is not None


@pytest.mark.parametrize(
    "expression", [x, sin(theta) * cos(phi), x / sin(theta), 1 / (a + b), x / (1 + x)]
)
def test_what_shares_nothing_is_left_alone(expression):
    assert lowest(expression) is None
    assert lowest_numerator(expression) == expression.numerator


@pytest.mark.parametrize("gap", [1e-3, 1e-5, 1e-7])
def test_no_digits_are_lost_where_only_the_normal_form_is_singular(gap):
    expression = x / sin(theta - phi) ** 2 + cos(theta) / sin(theta - phi)
    arguments = [as_symbol(e) for e in (x, theta, phi)]
    (value,) = compile_program([expression], arguments).function()(2.0, 0.7, gap - 0.7)
    apart = sine(1.4 - gap)
    assert value == pytest.approx(2 / apart**2 + cosine(0.7) / apart, rel=1e-14)


def test_it_prints_as_a_text_has_it():
    expression = a * sin(theta - phi) / (b * sin(theta + phi))
    assert str(expression) == "a*sin(theta - phi)/(b*sin(theta + phi))"
