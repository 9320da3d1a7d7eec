"""Values at random points of a prime field decide what is zero, as the normal form does."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import fmpz
from hypothesis import given
from hypothesis import strategies as st

import polhode as ph
from polhode.algebra import (
    Expr,
    FieldPoint,
    NoResidueError,
    Residue,
    Vanishing,
    cosh,
    exp,
    named,
    sinh,
    sqrt,
    vanishing,
)
from polhode.algebra._residues import PRIME, element

X, Y, THETA = ph.symbols("x y theta")
A, B = ph.symbols("a b", positive=True)
ATOMS = (X, Y, A, ph.sin(THETA), ph.cos(THETA), ph.sin(2 * THETA), ph.cos(THETA / 2), sqrt(A + B))
EXACT = st.sampled_from([*ATOMS, Expr.of(2), Expr.of(Fraction(-3, 7))])


def sums_and_products(inner: st.SearchStrategy[Expr]) -> st.SearchStrategy[Expr]:
    pairs = st.tuples(inner, inner)
    return pairs.map(lambda p: p[0] + p[1]) | pairs.map(lambda p: p[0] * p[1])


FORMULAS = st.recursive(EXACT, sums_and_products, max_leaves=6)


def decided(expression: Expr) -> Vanishing:
    return vanishing(expression.residue, lambda number: FieldPoint(f"test {number}"))


def at(point: FieldPoint, *expressions: Expr) -> list[int]:
    return [e.residue(point).value for e in expressions]


def test_nothing_divided_by_nothing_has_no_value() -> None:
    quotient = (X * A + Y) / (X * X + Y)
    zero = X.residue(FieldPoint("0"))._replace(value=element(0))

    class Diagonal(FieldPoint):
        def of(self, generator: object) -> Residue:
            return zero if generator in (X.symbol, Y.symbol) else super().of(generator)

    with pytest.raises(ZeroDivisionError):
        quotient.residue(Diagonal("0"))


def test_the_prime_is_one_and_small_primes_are_squares() -> None:
    assert fmpz(PRIME).is_prime()
    for small in (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43):
        assert pow(small, (PRIME - 1) // 2, PRIME) == 1
    assert pow(-1, (PRIME - 1) // 2, PRIME) != 1


@given(FORMULAS, FORMULAS)
def test_it_agrees_with_the_normal_form(f: Expr, g: Expr) -> None:
    assert decided(f - g).is_zero == (f - g).is_zero
    assert decided((f + g) ** 2 - f**2 - 2 * f * g - g**2).is_zero


@given(FORMULAS, FORMULAS)
def test_values_add_and_multiply(f: Expr, g: Expr) -> None:
    for number in range(20):
        try:
            one, other, total, product = at(FieldPoint(f"{number}"), f, g, f + g, f * g)
        except NoResidueError:  # a + b has no root at every other point
            continue
        assert total == one + other
        assert product == one * other
        return


def test_functions_of_one_angle_belong_together() -> None:
    point = FieldPoint("angles")
    s, c, double, half, third = at(
        point, ph.sin(THETA), ph.cos(THETA), ph.sin(2 * THETA), ph.cos(THETA / 2), ph.cos(THETA / 3)
    )
    assert s * s + c * c == 1
    assert double == 2 * s * c
    assert half * half * 2 == c + 1
    assert third * third * third * 4 - 3 * third == c
    e, ch, sh, part = at(point, exp(X), cosh(X), sinh(X), exp(X / 3))
    assert e == ch + sh
    assert ch * ch - sh * sh == 1
    assert part * part * part == e


def test_a_root_is_tried_with_both_signs() -> None:
    size = sqrt(X * X)
    assert not decided(size - X).is_zero
    assert not decided(size + X).is_zero
    assert decided(size * size - X * X).is_zero
    assert decided((size - X) * (size + X)).is_zero
    assert decided(sqrt(A) * sqrt(B) - sqrt(A * B)).is_zero


def test_a_long_expression_is_decided_under_its_name() -> None:
    long = named((X + Y + A + B) ** 6 + ph.sin(THETA))
    assert len(long.num) == 1
    assert (long - named((X + Y + A + B) ** 6) - ph.sin(THETA)).is_zero
    assert not (long - named((X + Y + A + B) ** 6) - ph.cos(THETA)).is_zero


def test_the_bound_is_the_degree_over_the_prime() -> None:
    zero = named((X + Y) ** 30) - named((X + Y) ** 29) * (X + Y)
    found = decided(zero)
    assert found.is_zero
    assert 30 / PRIME <= found.error_bound <= 200 / PRIME


def test_a_number_that_the_prime_divides_is_not_taken_for_zero() -> None:
    with pytest.raises(NoResidueError):
        element(PRIME)
    with pytest.raises(NoResidueError):
        element(1, PRIME)
    assert not named(PRIME * (X + Y + A + B)).is_zero


def test_what_no_point_has_a_value_for_is_refused() -> None:
    with pytest.raises(NoResidueError):
        decided(sqrt(Expr.of(47)) - sqrt(Expr.of(53)))
    roots = sum((sqrt(ph.symbol(f"u_{i}")) for i in range(6)), Expr.of(0))
    with pytest.raises(NoResidueError):
        decided(roots - named(roots))


def test_a_root_of_a_named_part_is_the_root_of_what_it_stands_for() -> None:
    """Two roots of unknown sign would differ on half of the branches."""
    radicand = 1 + X**2 * ph.cos(THETA) ** 2 + Y
    short, long = sqrt(named(radicand)), sqrt(radicand)
    assert short != long
    assert decided(X * short - X * long).is_zero
    assert not decided(short + long).is_zero
    assert not decided(short - sqrt(radicand + 1)).is_zero
