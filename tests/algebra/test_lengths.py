"""Lengths that are kept as one quantity: short, exact, and equal to what they stand for."""

import pickle
from fractions import Fraction

import pytest
import sympy as sp
from hypothesis import given
from hypothesis import strategies as st

import polhode as ph
from polhode.algebra import (
    LengthLetter,
    SquareRoot,
    kept_length,
    kept_sum,
    lengths_in,
    lengths_written_out,
    to_sympy,
    with_fewer_terms,
    with_letters,
)

x, y, u, v, theta, phi = ph.coordinates("x y u v theta phi")
a, l = ph.symbols("a l", positive=True)
s, c = ph.sin(theta), ph.cos(theta)
rho = kept_length((x - u, y - v))


def test_a_length_is_one_letter_and_its_definition():
    assert str(a * kept_sum(x - u) / rho**3) == "-a*(u - x)/rho**3"
    (part,) = lengths_in([rho])
    assert str(rho) == "rho"
    assert str(part.meaning) == "sqrt((u - x)**2 + (v - y)**2)"
    assert rho.latex() == r"\rho"


def test_a_speed_is_printed_as_an_absolute_value():
    speed = kept_length((x.dt() - a * u.dt(), y.dt()), LengthLetter("v_c", of_velocity=True))
    assert str(1 / speed) == "1/abs(v_c)"
    assert speed.pretty() == "|v_c|"
    assert speed.latex() == r"\left|v_c\right|"


def test_what_comes_out_of_the_root_does_so():
    assert kept_length((l * s, l * c)) == l
    assert str(kept_length((a * x, a * y))) == "a*rho"
    assert str(kept_length((x,))) == "abs(x)"
    assert kept_length((ph.Expr.of(3) * a, 4 * a)) == 5 * a


def test_its_square_is_known_to_the_test_of_zero():
    assert (rho**2 - (x - u) ** 2 - (y - v) ** 2).is_zero
    assert not (rho**2 - (x - u) ** 2 - (y + v) ** 2).is_zero
    assert not (rho - (x - u)).is_zero
    assert (1 / rho - rho / ((x - u) ** 2 + (y - v) ** 2)).is_zero


components = st.sampled_from(
    [x - u, y - v, x + 2 * a, l * s - a, a + x * c, u - l * ph.sin(phi), x.dt() - a * theta.dt()]
)


@given(st.lists(components, min_size=2, max_size=3, unique_by=str), st.integers(-3, 3))
def test_written_out_it_is_the_root(vector, power):
    kept = kept_length(vector) ** power * kept_sum(vector[0])
    plain = ph.sqrt(sum((one * one for one in vector), start=ph.Expr.of(0))) ** power * vector[0]
    assert lengths_written_out(kept) == plain
    assert (kept - plain).is_zero


@given(st.lists(components, min_size=2, max_size=3, unique_by=str), st.sampled_from([x, u, theta]))
def test_its_derivatives_are_those_of_the_root(vector, symbol):
    """Against SymPy's."""
    kept = kept_length(vector)
    root = sp.sqrt(sum(to_sympy(one) ** 2 for one in vector))
    expected = sp.diff(root, to_sympy(symbol)) if symbol else 0
    state = {n: sp.Rational(k + 2, 7) for k, n in enumerate(sorted(root.free_symbols, key=str))}
    found = to_sympy(lengths_written_out(kept.diff(symbol)))
    assert abs((found - expected).subs(state).evalf(30)) < 1e-25
    assert (kept.dt() - lengths_written_out(kept).dt()).is_zero


def test_values_are_put_in():
    assert rho.subs({u: 0, v: 0, y: 0}) == ph.sqrt(x * x)
    assert rho.subs({x: 4, u: 1, y: 6, v: 2}) == 5
    assert str(rho.subs({u: 0})) == "rho"
    assert lengths_written_out(rho.subs({u: 2 * x})) == ph.sqrt(x**2 + (y - v) ** 2)


def test_it_pickles():
    read = pickle.loads(pickle.dumps(a / rho))
    assert read == a / rho
    assert str(read) == str(a / rho)


def test_what_is_known_of_signs_keeps_lengths_apart():
    """Names that are positive here may be of either sign in another system."""
    (b,) = ph.symbols("b")
    (positive,) = ph.symbols("b", positive=True)
    (one,), (other,) = (lengths_in([kept_length((x + k, y))]) for k in (b, positive))
    assert one != other
    assert lengths_written_out(kept_length((x + b, y)).subs({x: 0, y: 0})) != b
    assert lengths_written_out(kept_length((x + positive, y)).subs({x: 0, y: 0})) == positive


def test_roots_with_letters_are_lengths():
    """Also where the normal form has their squares below the bar and multiplied out."""
    root = ph.sqrt(x**2 + y**2)
    (generator,) = (g for g in root.generators if isinstance(g, SquareRoot))
    letters = {generator.key: LengthLetter("r")}
    for expression, expected in (
        (a * x / root**3, "a*x/r**3"),
        (1 + a / root, "(a + r)/r"),
        (x**3 + x * y**2, "x**3 + x*y**2"),
        (root * (x**2 + y**2 + 1), "r*(r**2 + 1)"),
    ):
        kept = with_letters(expression, letters)
        assert (kept - expression).is_zero
        assert sp.simplify(sp.sympify(str(kept)) - sp.sympify(expected)) == 0


def test_a_sum_is_multiplied_out_only_where_that_costs_no_digits():
    near = kept_sum(x + l * c) * s - kept_sum(y + l * s) * c
    assert with_fewer_terms(near) == x * s - y * c
    far = kept_sum(x - u) * s - kept_sum(x - a) * c
    assert with_fewer_terms(far) == far


@pytest.mark.parametrize("away", [1.0, 1e5, 1e9])
def test_differences_lose_no_digits(away):
    """The distance of two points far from the origin, as SymPy has it in rational numbers."""
    program = ph.algebra.compile_program([a / rho**3], [g.symbol for g in (a, x, u, y, v)])
    point = [1.0, away + 0.5, away, away, away + 0.25]
    (found,) = program.function()(*point)
    exact = (
        1
        / sp.sqrt(
            sum(
                (Fraction(p) - Fraction(q)) ** 2
                for p, q in zip(point[1::2], point[2::2], strict=True)
            )
        )
        ** 3
    )
    assert found == pytest.approx(float(exact), rel=4e-16)
