"""Circular and hyperbolic functions, exponentials and roots: identities, special values, signs."""

from fractions import Fraction

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from algebra.backends import (
    KERNEL,
    POINT,
    a,
    angles,
    are_close,
    arguments,
    b,
    evaluated,
    phi,
    polynomials,
    theta,
    value,
    x,
    y,
)
from polhode.algebra import (
    Expr,
    absolute,
    cos,
    cosh,
    exp,
    is_positive,
    pi,
    principal_root,
    sech,
    sin,
    sinh,
    sqrt,
    symbols,
    tan,
    tanh,
)
from polhode.base import NumericError

# --- circular functions ---


@given(angles(), angles())
def test_addition_theorems_are_decided(first, second):
    p, q = evaluated(first, KERNEL), evaluated(second, KERNEL)
    assert sin(p + q) == sin(p) * cos(q) + cos(p) * sin(q)
    assert cos(p - q) == cos(p) * cos(q) + sin(p) * sin(q)
    assert sin(p) * sin(q) == (cos(p - q) - cos(p + q)) / 2


@given(angles())
def test_identities_of_one_angle_are_decided(tree):
    p = evaluated(tree, KERNEL)
    assert sin(p) ** 2 + cos(p) ** 2 == 1
    assert sin(2 * p) == 2 * sin(p) * cos(p)
    assert cos(3 * p) == 4 * cos(p) ** 3 - 3 * cos(p)
    assert sin(-p) == -sin(p)
    assert sin(p + pi / 2) == cos(p)
    assert cos(p + 2 * pi) == cos(p) == -cos(p + pi)


@pytest.mark.parametrize("angle", [theta, theta + phi, -3 * theta, pi / 3, theta + pi / 6])
def test_half_angles(angle):
    assert cos(angle / 2) ** 2 == (1 + cos(angle)) / 2
    assert sin(angle / 2) ** 2 == (1 - cos(angle)) / 2
    assert 2 * sin(angle / 2) * cos(angle / 2) == sin(angle)


def test_tangents():
    assert tan(theta) == sin(theta) / cos(theta)
    assert tan(theta / 2) == sin(theta) / (1 + cos(theta))
    assert 1 + tan(theta) ** 2 == 1 / cos(theta) ** 2


def test_an_angle_that_is_a_product_is_a_unit_of_its_own():
    t = symbols("tau")[0]
    assert sin(2 * a * t) == 2 * sin(a * t) * cos(a * t)
    assert sin(a * t).diff(t) == a * cos(a * t)


@pytest.mark.parametrize("twelfths", range(-30, 31))
def test_special_angles_are_exact(twelfths):
    angle = pi * Fraction(twelfths, 12)
    assert not sin(angle).symbols()
    assert are_close(value(sin(angle)), mpmath.sin(mpmath.pi * twelfths / 12))
    assert are_close(value(cos(angle)), mpmath.cos(mpmath.pi * twelfths / 12))


@pytest.mark.parametrize("fraction", [Fraction(1, 7), Fraction(1, 5), Fraction(3, 8)])
def test_an_angle_without_plain_surds_is_refused_by_name(fraction):
    with pytest.raises(NumericError, match=rf"{fraction}\*pi"):
        sin(pi * fraction)
    with pytest.raises(NumericError, match="multiple of pi/12"):
        cos(theta).subs({theta: pi * fraction})


def test_multiples_too_far_apart_are_taken_as_unrelated():
    both = sin(100 * theta) + sin(theta)
    assert both.dt() == theta.dt() * (100 * cos(100 * theta) + cos(theta))
    assert both - sin(theta) == sin(100 * theta)
    assert (sin(100 * theta) ** 2 + cos(100 * theta) ** 2 + sin(theta)) == 1 + sin(theta)


def test_functions_of_functions():
    assert sin(sin(theta)).dt() == cos(sin(theta)) * cos(theta) * theta.dt()
    assert cos(theta / x).subs({x: 2}) == cos(theta / 2)


# --- exponential and hyperbolic functions ---


@given(arguments, arguments)
def test_exponentials_and_hyperbolic_functions_agree(first, second):
    p, q = evaluated(first, KERNEL), evaluated(second, KERNEL)
    assert exp(p) * exp(q) == exp(p + q)
    assert exp(p) / exp(q) == exp(p - q)
    assert cosh(p) ** 2 - sinh(p) ** 2 == 1
    assert cosh(p) + sinh(p) - exp(p) == 0
    assert 2 * cosh(p) == exp(p) + exp(-p) + 0 * sinh(p)
    assert sinh(p + q) == sinh(p) * cosh(q) + cosh(p) * sinh(q)


def test_hyperbolic_quotients():
    assert tanh(x) == sinh(x) / cosh(x)
    assert sech(x) ** 2 == 1 - tanh(x) ** 2
    assert exp(0) == 1
    assert exp(x).diff(x) == exp(x)
    assert sinh(2 * x).diff(x) == 2 * cosh(2 * x)


# --- roots ---


@given(st.fractions(min_value=0, max_value=50, max_denominator=12))
def test_roots_of_numbers_are_exact(number):
    root = sqrt(number)
    assert root**2 == number
    assert are_close(value(root), mpmath.sqrt(mpmath.mpf(number.numerator) / number.denominator))


@given(polynomials)
def test_the_root_of_a_square_has_the_absolute_value(tree):
    base = evaluated(tree, KERNEL)
    root = sqrt(base**2)
    assert root**2 == base**2
    assert absolute(base) == absolute(-base)
    assert are_close(value(root), abs(value(base)))
    assert are_close(value(absolute(base)), abs(value(base)))


@pytest.mark.parametrize("base", [x, 2 * x * y, x - y, a * sin(theta), x * cos(theta) / y, x + a])
def test_the_root_of_a_square_is_the_absolute_value(base):
    assert sqrt(base**2) == absolute(base)
    assert absolute(base) ** 2 == base**2


def test_known_signs_come_out_of_a_root():
    assert sqrt(a**2 * b) == a * sqrt(b)
    assert sqrt(a * b) == sqrt(a) * sqrt(b)
    assert sqrt(4 * x**2 / a**2) == 2 * absolute(x) / a
    assert sqrt(12) == 2 * sqrt(3)
    assert sqrt(Fraction(1, 2)) == sqrt(2) / 2
    assert absolute(a) == a == absolute(-a)
    assert sqrt(x) * sqrt(x) == x
    assert sqrt(0) == 0


def test_a_principal_root_is_plain_where_there_is_one():
    assert principal_root(sin(theta) ** 2) == sin(theta)
    assert principal_root(a * sin(theta) ** 2) == sqrt(a) * sin(theta)
    assert principal_root(x**2 + 1) == sqrt(x**2 + 1)


@pytest.mark.parametrize(
    "take", [lambda: sqrt(-4), lambda: sqrt(-(a**2)), lambda: sqrt(x).subs({x: -1})]
)
def test_the_root_of_a_negative_number_is_refused(take):
    with pytest.raises(NumericError, match="square root of a negative number"):
        take()


@pytest.mark.parametrize("sure", [a, a * b + 1, x**2 + a, cosh(x), exp(y), sqrt(a), pi, a / b])
def test_what_is_seen_to_be_positive(sure):
    assert is_positive(sure)
    assert not is_positive(-sure)


@pytest.mark.parametrize("open_", [x, a - b, sin(theta), x**2, Expr.of(0), theta + 1])
def test_what_is_not(open_):
    assert not is_positive(open_)


def test_roots_of_an_angle_follow_the_branch():
    root = sqrt(1 - cos(theta) ** 2)
    assert root == absolute(sin(theta))
    point = POINT | {"theta": mpmath.mpf(-1)}
    assert are_close(value(root, point), -mpmath.sin(-1))
    assert root * absolute(sin(theta)) == sin(theta) ** 2


def test_denominators_with_cosines_and_roots_are_decided():
    assert (1 / (a + b * cos(phi))) * (a + b * cos(phi)) == 1
    assert 1 / (sqrt(a) + sqrt(b)) == (sqrt(a) - sqrt(b)) / (a - b)
    assert (1 - sin(phi)) / cos(phi) == cos(phi) / (1 + sin(phi))


def test_roots_follow_where_an_angle_is_halved():
    half = sin(theta / 2)
    assert half * sqrt(a + sin(theta) ** 2) / half == sqrt(a + sin(theta) ** 2)
    assert sqrt(1 - cos(theta)) == sqrt(2) * absolute(half)
    assert (cos(theta / 3) * sqrt(a + sqrt(b + cos(theta) ** 2))) ** 2 == cos(theta / 3) ** 2 * (
        a + sqrt(b + cos(theta) ** 2)
    )
