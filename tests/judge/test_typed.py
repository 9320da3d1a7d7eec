"""What is typed to go with a claim: definitions, restrictions, small quantities."""

from functools import cache

import pytest

import polhode as ph
from catalogue.systems import equations
from polhode.algebra import Expr, pi
from polhode.base import ParseError
from polhode.judge._notation import Notation, letter
from polhode.judge._typed import typed, with_given, with_let, with_small
from polhode.judge.latex import read_latex

M, A = ph.symbols("m a", positive=True)
THETA = ph.coordinate("theta")


@cache
def disk() -> Notation:
    return Notation.of(equations("rolling-disk"))


@pytest.mark.parametrize("text", ["epsilon=theta-pi/2", r"\epsilon = \theta - \pi/2"])
def test_a_definition_in_names_or_in_latex(text: str) -> None:
    assert with_let(disk(), text).value(letter(r"\epsilon")) == THETA - pi / 2


def test_a_definition_may_use_an_earlier_one() -> None:
    notation = with_let(with_let(disk(), "epsilon = theta - pi/2"), "q = 2*epsilon + I_3")
    assert notation.scalar("q") == 2 * THETA - pi + M * A**2 / 2


def test_a_symbol_that_only_follows_from_the_declaration_may_be_defined() -> None:
    assert with_let(disk(), "I_1 = m*a**2/3").scalar("I_1") == M * A**2 / 3


@pytest.mark.parametrize(
    "text", ["theta=3", "m = 2*a", "omega_3=0", r"\theta = 3", r"\dot{\theta} = 3"]
)
def test_a_known_symbol_is_not_redefined(text: str) -> None:
    with pytest.raises(ParseError, match="restrict a known quantity"):
        with_let(disk(), text)


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("theta=pi/2", pi / 2),
        ("theta = 90deg", pi / 2),
        (r"\theta = \pi/2", pi / 2),
        ("theta=-1", -1),
    ],
)
def test_a_restriction_gives_a_symbol_its_value(text: str, value: Expr) -> None:
    notation = with_given(disk(), text)
    asked = notation.claimed(notation.bound(read_latex(r"F_z = mg")))
    assert {symbol.published: v for symbol, v in asked.given.items()} == {"theta": value}


def test_any_other_restriction_is_an_expression_that_vanishes() -> None:
    notation = with_given(disk(), "theta_dot**2 = phi_dot**2")
    asked = notation.claimed(notation.bound(read_latex(r"F_z = mg")))
    assert not asked.given
    assert asked.relations == (THETA.dt() ** 2 - ph.coordinate("phi").dt() ** 2,)


@pytest.mark.parametrize(
    ("text", "order"),
    [("theta_dot:2", 2), ("theta_dot", None), (r"\dot{\theta}:2", 2), (r"\dot\theta", None)],
)
def test_a_small_quantity_with_or_without_its_order(text: str, order: int | None) -> None:
    (small,) = with_small(disk(), text).small
    assert (small.quantity, small.order) == (THETA.dt(), order)


def test_a_letter_that_is_zero_is_still_known() -> None:
    assert typed(with_let(disk(), "n = 0"), "n + m") == M


@pytest.mark.parametrize(
    "text", ["epsilon theta", "a = b = c", "= 3", "q =", "2*q = 3", "q = omega_4"]
)
def test_a_malformed_definition_is_refused(text: str) -> None:
    with pytest.raises(ParseError):
        with_let(disk(), text)


@pytest.mark.parametrize("text", ["theta", "theta > 2", "omega_4 = 1", "theta = 3 furlongs"])
def test_a_malformed_restriction_is_refused(text: str) -> None:
    with pytest.raises(ParseError):
        with_given(disk(), text)


@pytest.mark.parametrize("text", ["theta:one", ":", "omega_4:1", ""])
def test_a_malformed_small_quantity_is_refused(text: str) -> None:
    with pytest.raises(ParseError):
        with_small(disk(), text)
