"""Derivatives, substitution, expansion and integrals, against SymPy and against numbers."""

from fractions import Fraction

import mpmath
import pytest
import sympy
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from algebra.backends import (
    KERNEL,
    NAMES,
    POINT,
    SYMPY,
    a,
    are_close,
    b,
    evaluated,
    expression_of,
    numbers_at,
    omega_3,
    phi,
    polynomials,
    smooth,
    symbols,
    theta,
    theta_dot,
    value,
    x,
    y,
)
from polhode.algebra import (
    ONE,
    ZERO,
    as_symbol,
    cos,
    exp,
    from_sympy,
    functions,
    integrate,
    linear_parts,
    pi,
    sin,
    sqrt,
    taylor,
    time,
    to_sympy,
)
from polhode.base import NumericError

variables = st.sampled_from(["x", "a", "theta", "theta_dot"])


# --- derivatives ---


@settings(max_examples=60)
@given(smooth, variables)
def test_a_derivative_is_the_one_of_sympy(tree, name):
    expression = expression_of(tree)
    assume(expression is not None)
    theirs = sympy.diff(evaluated(tree, SYMPY), sympy.Symbol(name))
    assert expression.diff(NAMES[name]) == from_sympy(theirs, NAMES)


@settings(max_examples=60)
@given(smooth, variables)
def test_a_derivative_is_the_slope(tree, name):
    expression = expression_of(tree)
    assume(expression is not None)
    step = mpmath.mpf(10) ** -20
    there, here = (
        evaluated(tree, numbers_at(POINT | {name: POINT[name] + sign * step})) for sign in (1, -1)
    )
    slope = value(expression.diff(NAMES[name]))
    assert abs((there - here) / (2 * step) - slope) < mpmath.mpf(10) ** -20 * (1 + abs(slope)) ** 3


@given(polynomials, polynomials)
def test_the_rules_of_differentiation(p, q):
    p, q = evaluated(p, KERNEL), evaluated(q, KERNEL)
    assert (p * q).dt() == p.dt() * q + p * q.dt()
    assert (p + q).diff(theta) == p.diff(theta) + q.diff(theta)
    assert p.diff(theta).diff(phi) == p.diff(phi).diff(theta)


def test_what_changes_in_time():
    X = functions("X")[0]
    assert x.dt() == 0
    assert pi.dt() == 0
    assert time.dt() == 1
    assert str(X.dt().dt()) == "X_ddot"
    assert omega_3.dt().symbol.published == "omega_3_dot"
    assert sin(theta).dt() == theta_dot * cos(theta)
    assert exp(-a * time).dt() == -a * exp(-a * time)
    assert (theta * x).dt() == x * theta_dot
    assert sqrt(theta**2 + a).dt() == theta * theta_dot / sqrt(theta**2 + a)


# --- substitution ---


@given(polynomials, polynomials, symbols)
def test_substitution_has_the_value_at_the_image(tree, image, name):
    name = name[1]
    assume(name not in ("theta", "phi"))  # the image of an angle is tested below
    replaced = evaluated(tree, KERNEL).subs({NAMES[name]: evaluated(image, KERNEL)})
    point = POINT | {name: evaluated(image, numbers_at(POINT))}
    assert are_close(value(replaced), evaluated(tree, numbers_at(point)))


@pytest.mark.parametrize("image", [phi, 2 * phi, phi + pi / 2, -theta, x, x / 2 - phi, pi / 3])
@settings(max_examples=15)
@given(tree=polynomials)
def test_an_angle_can_be_replaced_by_another(tree, image):
    replaced = evaluated(tree, KERNEL).subs({theta: image})
    point = POINT | {"theta": value(image)}
    assert are_close(value(replaced), evaluated(tree, numbers_at(point)))


def test_an_image_of_one_term_is_brought_to_normal_form():
    assert (x**2 * y + x).subs({x: cos(theta), y: 2}) == 2 - 2 * sin(theta) ** 2 + cos(theta)
    halved = sin(theta / 2) ** 2 * cos(theta / 2)
    assert (x * sin(theta / 2)).subs({x: sin(theta)}) == 2 * halved


def test_symbols_are_replaced_all_at_once():
    assert (x - 2 * y).subs({x: y, y: x}) == y - 2 * x
    assert sin(theta + phi).subs({theta: phi, phi: theta}) == sin(theta + phi)
    assert (x / y).subs({as_symbol(x): 3, y: Fraction(1, 2)}) == 6
    assert sqrt(x).subs({x: a**2}) == a
    assert x.subs({y: 5}) is x


# --- expansion ---


@pytest.mark.parametrize("order", [0, 1, 2, 5])
@pytest.mark.parametrize(
    "expression",
    [sin(theta), cos(theta) * exp(theta), 1 / (1 + theta), sqrt(1 + a * theta), theta**3 + x],
)
def test_taylor_polynomials_are_those_of_sympy(expression, order):
    t, names = sympy.Symbol("theta"), {"a": sympy.Symbol("a", positive=True)}
    theirs = sympy.series(to_sympy(expression, names), t, 0, order + 1).removeO()
    assert taylor(expression, theta, order) == from_sympy(theirs, NAMES)


def test_taylor_about_a_place():
    expanded = taylor(cos(theta), theta, 2, about=pi / 2)
    assert expanded == -(theta - pi / 2)
    assert taylor(theta**2, theta, 1, about=a) == a**2 + 2 * a * (theta - a)
    with pytest.raises(ZeroDivisionError):
        taylor(1 / theta, theta, 1)


def test_linear_parts_put_together_give_the_whole():
    expression = (a * theta_dot * sin(theta) - 3 * omega_3 + x * y) / (a + b)
    (first, second), rest = linear_parts(expression, [as_symbol(theta_dot), as_symbol(omega_3)])
    assert first == a * sin(theta) / (a + b)
    assert first * theta_dot + second * omega_3 + rest == expression


@pytest.mark.parametrize("expression", [theta_dot**2, sin(theta_dot), 1 / theta_dot, x * theta_dot])
def test_what_is_not_linear_is_refused(expression):
    with pytest.raises(NumericError, match="linear in theta_dot"):
        linear_parts(expression, [as_symbol(theta_dot), as_symbol(x)])


# --- integrals ---


@pytest.mark.parametrize(
    "integrand",
    [
        sin(theta),
        cos(theta) ** 2,
        sin(theta) ** 4 * a,
        sin(theta) ** 3 * cos(theta) ** 3,
        sin(theta) * cos(phi) - x,
        sin(2 * theta) * cos(theta),
        sin(theta / 2) ** 2,
        theta**2 + x * theta,
        sin(phi) / (a + b),
    ],
)
@pytest.mark.parametrize("limits", [(0, 2 * pi), (-pi / 2, pi / 3), (0, x)])
def test_integrals_are_those_of_numbers(integrand, limits):
    integral = integrate(integrand, theta, *limits)
    low, high = (value(ZERO + limit) for limit in limits)
    number = mpmath.quad(
        lambda t: value(integrand, POINT | {"theta": t}), mpmath.linspace(low, high, 5)
    )
    assert abs(value(integral) - number) < mpmath.mpf(10) ** -25


@pytest.mark.parametrize("integrand", [1 / theta, theta * sin(theta), exp(theta), sqrt(theta)])
def test_other_integrals_are_refused(integrand):
    with pytest.raises(NumericError, match="integral"):
        integrate(integrand, theta, 0, 1)


def test_an_integral_over_a_multiple_of_an_angle():
    integral = integrate(sin(a * theta) * cos(a * theta), theta, 0, x)
    assert integral == sin(a * x) ** 2 / (2 * a)


def test_an_integral_over_nothing_is_the_length():
    assert integrate(ONE, x, a, b) == b - a
