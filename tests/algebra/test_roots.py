"""Absolute values on one side of zero."""

import pytest

from polhode.algebra import absolute, coordinates, exp, roots_in, sin, sqrt, symbol, with_roots

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
