"""Dimensions of expressions from those of their symbols."""

from fractions import Fraction

import pytest

from polhode.algebra import ONE, coordinate, dimension_of, pi, sin, sqrt, symbols
from polhode.base import LENGTH, MASS, PURE, TIME, UnitError

m, a, g = symbols("m a g", positive=True)
theta = coordinate("theta")
KNOWN = {m.symbol: MASS, a.symbol: LENGTH, g.symbol: LENGTH / TIME**2, theta.symbol: PURE}


@pytest.mark.parametrize(
    ("expression", "dimension"),
    [
        (2 * m * a**2 / 5, MASS * LENGTH**2),
        (g / a, TIME**-2),
        (sqrt(g / a), TIME**-1),
        (sqrt(g), (LENGTH / TIME**2) ** Fraction(1, 2)),
        (a * sin(theta) + 2 * a, LENGTH),
        (theta.dt() ** 2 + g / a, TIME**-2),
        (a + Fraction(1, 100), LENGTH),
        (pi * a, LENGTH),
        (2 / a, LENGTH**-1),
        (ONE * 2, None),
        (pi / 3, None),
    ],
)
def test_dimension_of_an_expression(expression, dimension):
    assert dimension_of(expression, KNOWN) == dimension


@pytest.mark.parametrize("expression", [a + m, a + sin(theta), 1 / (a + m), sqrt(a + m)])
def test_unlike_terms_are_refused(expression):
    with pytest.raises(UnitError, match="adds quantities in"):
        dimension_of(expression, KNOWN)
