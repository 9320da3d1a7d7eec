"""Absolute values on one side of zero."""

import pytest

from polhode.algebra import (
    absolute,
    coordinates,
    cos,
    exp,
    merged_roots,
    roots_in,
    sin,
    sqrt,
    symbol,
    with_roots,
)

x, y = coordinates("x y")
a = symbol("a", positive=True)


def below(expression):
    """With everything within bars taken as negative, from the inside out."""
    images = {}
    while True:
        found = with_roots(expression, images)
        open_ = [root for root in roots_in([found]) if root.plain is not None]
        if not open_:
            return found
        images[open_[0]] = -open_[0].plain


@pytest.mark.parametrize(
    ("given", "wanted"),
    [
        (absolute(x), -x),
        (x / absolute(x), -1),
        (1 / (1 + absolute(x)), 1 / (1 - x)),
        (sin(2 * absolute(x)), -sin(2 * x)),
        (exp(-absolute(x - y)), exp(x - y)),
        (sqrt(1 + absolute(x) * a), sqrt(1 - a * x)),
        (absolute(absolute(x) - 1), -1 - x),
        (absolute(x * y), x * y),
        (sqrt(x**2 + y**2), sqrt(x**2 + y**2)),
    ],
)
def test_bars_come_off_on_one_side(given, wanted):
    assert below(given) == wanted


def test_roots_are_found_inside_functions_inner_ones_first():
    roots = roots_in([sin(absolute(x) * y), absolute(absolute(x) - 1)])
    assert [root.plain for root in roots] == [x, None]
    assert roots_in([x * y + 1]) == ()


def test_a_square_is_seen_that_needs_cosines_for_sines():
    """(a y² sin²x + cos x)² contains sin⁴x and cos²x, which are not both in normal form."""
    inside = a * y**2 * sin(x) ** 2 + cos(x)
    (root,) = roots_in([sqrt(inside**2)])
    assert root.plain in (inside, -inside)
    (other,) = roots_in([sqrt(inside**2 + a)])
    assert other.plain is None


@pytest.mark.parametrize(
    "inside",
    [
        sqrt(x**2 + y**2) - a,
        a - 2 * x * sqrt(1 + y**2),
        a * y - cos(x) * sqrt(y**2 + sin(y) ** 2),
        sqrt(2) * x - sqrt(3) * y,
    ],
)
def test_a_square_is_seen_with_a_root_in_it(inside):
    """(√(x² + y²) − a)² is multiplied out in normal form."""
    root = roots_in([absolute(inside)])[-1]
    assert root.plain in (inside, -inside)
    assert roots_in([sqrt(inside**2 + a)])[-1].plain is None


def test_the_root_of_a_root_stays():
    """p + q √A with p² − q²A < 0 is no square; that was an error of a negative radicand."""
    (inner, outer) = roots_in([sqrt(sqrt(x**2 + y**2))])
    assert inner.plain is None
    assert outer.plain is None


def test_the_product_of_two_roots_is_merged_where_it_is_the_root_of_a_square():
    product = sqrt(1 - cos(x)) * sqrt(1 + cos(x))
    assert merged_roots(product) == absolute(sin(x))
    assert merged_roots(y + product * sqrt(2)) == y + absolute(sin(x)) * sqrt(2)
    for kept in (sqrt(1 - x) * sqrt(1 + x), absolute(x) * absolute(y), absolute(x) * sqrt(y)):
        assert merged_roots(kept) == kept
