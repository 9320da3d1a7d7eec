"""Random expressions: equality decided as fifty digits decide it, and text that is read back."""

from __future__ import annotations

from fractions import Fraction
from functools import partial
from random import Random
from typing import Any

import mpmath
from hypothesis import assume, given
from hypothesis import strategies as st

from algebra.backends import (
    NAMES,
    POINT,
    divisors,
    evaluated,
    expression_of,
    numbers_at,
    polynomials,
    smooth,
    symbols,
    trees,
)
from polhode.algebra import Expr, pi, read_expression
from polhode.base import ParseError
from proof.widened import widened

FIFTY = mpmath.mpf(10) ** -50
DIGITS = 110  # carried, so that fifty are left whatever cancels


def point(seed: int) -> dict[str, Any]:
    """Random numbers for every name; a and b are positive."""
    random = Random(seed)
    numbers = {name: mpmath.mpf(random.getrandbits(300)) / 2**299 - 1 for name in POINT}
    positive = {name: abs(numbers[name]) for name in ("a", "b")}
    return numbers | positive | {"pi": +mpmath.mp.pi}


def agree_everywhere(first: tuple, second: tuple, seed: int) -> bool:
    """Whether two trees have the same value, to fifty digits, at three random points."""
    with mpmath.workdps(DIGITS):
        backends = [numbers_at(point(3 * seed + i)) for i in range(3)]
        pairs = [(evaluated(first, backend), evaluated(second, backend)) for backend in backends]
        return all(abs(u - v) <= FIFTY * (1 + abs(u) + abs(v)) for u, v in pairs)


@st.composite
def disguised(draw: st.DrawFn, kind: st.SearchStrategy) -> tuple[tuple, tuple]:
    """A tree and what may look quite unlike it: the same, or off by next to nothing."""
    plain = draw(kind)
    other = plain
    for _ in range(draw(st.integers(1, 3))):
        other = draw(st.sampled_from(DISGUISES))(draw, other)
    return plain, other


def _added_and_taken_away(draw: st.DrawFn, tree: tuple) -> tuple:
    more = draw(polynomials)
    return ("-", ("+", tree, more), more)


def _times_and_over(draw: st.DrawFn, tree: tuple) -> tuple:
    factor = draw(divisors)
    return ("/", ("*", tree, factor), factor)


def _times_one(draw: st.DrawFn, tree: tuple) -> tuple:
    angle = ("+", draw(symbols), draw(symbols))
    return ("*", tree, ("+", ("^", ("sin", angle), 2), ("^", ("cos", angle), 2)))


def _squared_apart(draw: st.DrawFn, tree: tuple) -> tuple:
    """((r + m)² - (r - m)²)/(4 m)"""
    more = draw(symbols)
    plus, minus = ("^", ("+", tree, more), 2), ("^", ("-", tree, more), 2)
    return ("/", ("-", plus, minus), ("*", ("number", Fraction(4)), more))


def _nearly(draw: st.DrawFn, tree: tuple) -> tuple:
    trifle = ("number", Fraction(draw(st.integers(-3, 3)), 10 ** draw(st.integers(0, 30))))
    return ("+", tree, ("*", trifle, draw(symbols)))


DISGUISES = (_added_and_taken_away, _times_and_over, _times_one, _squared_apart, _nearly)


@partial(widened, examples=3000)
@given(disguised(smooth), st.integers(0, 10**6))
def test_equal_just_where_fifty_digits_agree(pair, seed):
    first, second = map(expression_of, pair)
    assume(first is not None and second is not None)
    assert (first == second) == agree_everywhere(*pair, seed)


@partial(widened, examples=1500)
@given(smooth, smooth, st.integers(0, 10**6))
def test_strangers_are_equal_just_where_fifty_digits_agree(one, other, seed):
    first, second = expression_of(one), expression_of(other)
    assume(first is not None and second is not None)
    assert (first == second) == agree_everywhere(one, other, seed)


@partial(widened, examples=1500)
@given(disguised(trees), st.integers(0, 10**6))
def test_what_is_called_equal_agrees_with_roots_and_sizes_in_it(pair, seed):
    first, second = map(expression_of, pair)
    assume(first is not None and second is not None and first == second)
    assert agree_everywhere(*pair, seed)


# --- text ---


def read_back(text: str) -> Expr | None:
    """What a text spells; None where reading it would take long."""
    try:
        return read_expression(text, NAMES)
    except ParseError as refusal:
        told = str(refusal)
    assert len(told) < 600
    return None


@partial(widened, examples=2000)
@given(trees)
def test_what_is_printed_is_read_back(tree):
    expression = expression_of(tree)
    assume(expression is not None)
    again = read_back(str(expression))
    assume(again is not None)
    assert again == expression


@partial(widened, examples=2000)
@given(polynomials)
def test_polynomials_are_printed_to_be_read_back_always(tree):
    expression = expression_of(tree)
    assume(expression is not None and len(str(expression)) <= 1000)
    assert read_expression(str(expression), NAMES) == expression


@st.composite
def damaged(draw: st.DrawFn) -> str:
    """A printed expression with pieces of it cut out, doubled, or replaced by others."""
    text = str(expression_of(draw(polynomials)))
    for _ in range(draw(st.integers(1, 4))):
        i, j = sorted(draw(st.tuples(*[st.integers(0, len(text))] * 2)))
        middle = draw(
            st.sampled_from(["", text[i:j] * 2, "**", "(", ")", "/0", "sqrt(", "1e9", "_"])
        )
        text = text[:i] + middle + text[j:]
    return text


SOUP = "0123456789.eE+-*/^() \t\n_amtxyθπ−√²½sincosqrtexphabg,;:=[]{}'\"\\`$#@!~|&<>?%\0\u202e"
hostile = st.one_of(
    st.text(max_size=1200),
    st.text(SOUP, max_size=80),
    damaged(),
    st.sampled_from(["(", "-", "sin(", "a**", "2^", "9", "a/", "(a+b)**"]).flatmap(
        lambda piece: st.integers(1, 400).map(lambda times: piece * times)
    ),
)


@partial(widened, examples=8000)
@given(hostile)
def test_hostile_text_is_read_or_refused(text):
    known = {*(e.symbol for e in NAMES.values()), pi.symbol}
    expression = read_back(text)
    assert expression is None or expression.symbols() <= known
