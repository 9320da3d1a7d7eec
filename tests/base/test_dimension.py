from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from polhode.base import LENGTH, MASS, PURE, TIME, Dimension, read_unit

whole = st.integers(-4, 4).map(Fraction)
dimensions = st.builds(Dimension, whole, whole, whole)


@pytest.mark.parametrize(
    ("dimension", "printed"),
    [
        (PURE, "1"),
        (MASS, "kg"),
        (MASS * LENGTH**2 / TIME**2, "kg m^2/s^2"),
        (TIME**-1, "1/s"),
        (MASS / (LENGTH * TIME**2), "kg/(m s^2)"),
        (LENGTH ** Fraction(1, 2), "m^(1/2)"),
    ],
)
def test_prints_as_its_si_unit(dimension, printed):
    assert str(dimension) == printed


@given(dimensions.filter(lambda dimension: dimension != PURE))
def test_what_is_printed_reads_back(dimension):
    unit = read_unit(str(dimension))
    assert (unit.coefficient, unit.pi_power, unit.dimension) == (1, 0, dimension)


@given(dimensions, dimensions, st.integers(-3, 3))
def test_powers_multiply_and_divide(one, other, exponent):
    assert one * other / other == one
    assert (one * other) ** exponent == one**exponent * other**exponent
