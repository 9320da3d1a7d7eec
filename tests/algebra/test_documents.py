"""Expressions in documents: they come back as they were, and nonsense is refused."""

import json

import pytest
from hypothesis import assume, given, settings

from algebra.backends import (
    NUMBERS,
    a,
    are_close,
    evaluated,
    expression_of,
    phi,
    theta,
    trees,
    value,
    x,
)
from polhode.algebra import (
    SHAPES,
    ZERO,
    Expr,
    Matrix,
    Symbol,
    absolute,
    as_symbol,
    cos,
    exp,
    functions,
    pi,
    sin,
    sqrt,
    symbol,
    time,
)
from polhode.base import Codec, StoreError

CODEC = Codec(SHAPES)


@given(trees)
def test_expressions_come_back_as_they_were(tree):
    expression = expression_of(tree)
    assume(expression is not None)
    text = CODEC.write(expression)
    again = CODEC.read(text, Expr)
    assert again == expression
    assert again.generators == expression.generators
    assert CODEC.write(again) == text
    assert are_close(value(again), evaluated(tree, NUMBERS))


@pytest.mark.parametrize(
    "expression",
    [
        ZERO,
        Expr.of(10**40) / 7,
        pi / 3,
        time**2 * functions("X")[0].dt().dt(),
        sin(10 * theta) + cos(15 * theta),
        sin(17 * theta / 3) / cos(phi / 2),
        exp(-x / a) * sqrt(2 * a),
        absolute(x - a),
        sqrt(x) / sqrt(x - theta),
        sqrt(1 + sqrt(1 + x**2)),
        sin(x * theta / a) + sin(1),
    ],
    ids=str,
)
def test_particular_expressions(expression):
    assert CODEC.read(CODEC.write(expression), Expr) == expression


def test_signs_that_are_known_stay_known():
    positive = CODEC.read(CODEC.write(a), Expr)
    assert sqrt(positive**2) == a
    assert as_symbol(positive).positive
    assert not as_symbol(CODEC.read(CODEC.write(symbol("a")), Expr)).positive


def test_a_matrix_comes_back():
    matrix = Matrix.of([[a, sin(theta)], [0, 1 / x]])
    assert CODEC.read(CODEC.write(matrix), Matrix) == matrix


NAME = {"is": "symbol", "name": "x", "kind": "parameter", "order": 0, "positive": False}
ANGLE = {**NAME, "name": "theta", "kind": "coordinate"}
ONE_X = {"is": "expression", "over": [{"#": 0}], "above": [[[1], 1, 1]], "below": [[[0], 1, 1]]}


def document(*parts):
    return json.dumps({"format": "polhode declaration", "schema": 2, "parts": list(parts)})


def test_the_examples_below_are_bad_only_where_they_differ():
    assert CODEC.read(document(NAME, ONE_X), Expr) == x
    assert CODEC.read(document(ANGLE), Symbol) == as_symbol(theta)


def over(*generators, above=((1,), 1, 1), below=((0,), 1, 1)):
    return {
        "is": "expression",
        "over": [{"#": k} for k in generators],
        "above": [above],
        "below": [below],
    }


COSINE = {"is": "function", "name": "cos", "of": {"#": 1}, "times": [1, 1]}
BAD = {
    "code as a name": [{**NAME, "name": "__import__('os')"}],
    "no name": [{**NAME, "name": ""}],
    "a number as name": [{**NAME, "name": 7}],
    "time as a parameter": [{**NAME, "name": "t"}],
    "another name of time": [{**NAME, "kind": "time"}],
    "unknown kind": [{**NAME, "kind": "spell"}],
    "a derivative below none": [{**NAME, "order": -1}],
    "a far derivative": [{**NAME, "order": 10**9}],
    "a sign that is a text": [{**NAME, "positive": "yes"}],
    "a field too many": [{**NAME, "colour": 1}],
    "a field too few": [{"is": "symbol", "name": "x"}],
    "two meanings": [NAME, {**NAME, "kind": "speed"}, over(0, 1, above=((1, 1), 1, 1))],
    "twice the same": [NAME, over(0, 0)],
    "no generator": [NAME, ONE_X, over(1)],
    "nothing below": [NAME, {**ONE_X, "below": []}],
    "zero below": [NAME, over(0, below=((0,), 0, 1))],
    "too few powers": [NAME, over(0, above=((), 1, 1))],
    "too many powers": [NAME, over(0, above=((1, 1), 1, 1))],
    "a negative power": [NAME, over(0, above=((-1,), 1, 1))],
    "a huge power": [NAME, over(0, above=((10**12,), 1, 1))],
    "a true power": [NAME, over(0, above=((True,), 1, 1))],
    "half a coefficient": [NAME, over(0, above=((1,), 1))],
    "over zero": [NAME, over(0, above=((1,), 1, 0))],
    "not in lowest terms": [NAME, over(0, above=((1,), 2, 4))],
    "a text as coefficient": [NAME, over(0, above=((1,), "1", 1))],
    "too many terms": [NAME, {**ONE_X, "above": [[[k], 1, 1] for k in range(6000)]}],
    "a list for a polynomial": [NAME, {**ONE_X, "above": [1, 2]}],
    "a number for a polynomial": [NAME, {**ONE_X, "above": 3}],
    "cos squared": [ANGLE, ONE_X, COSINE, over(2, above=((2,), 1, 1))],
    "over a cosine": [ANGLE, ONE_X, COSINE, over(2, below=((1,), 1, 1))],
    "no such function": [ANGLE, ONE_X, {**COSINE, "name": "system"}],
    "minus an angle": [ANGLE, ONE_X, {**COSINE, "times": [-1, 1]}],
    "no angle": [ANGLE, ONE_X, {**COSINE, "times": [0, 1]}],
    "twice an angle": [ANGLE, over(0, above=((1,), 2, 1)), COSINE],
    "a sine of a symbol": [ANGLE, {**COSINE, "of": {"#": 0}}],
    "a root of a square": [{**NAME, "positive": True}, over(0, above=((2,), 1, 1)), "root"],
    "a root of nothing": [NAME, {**ONE_X, "above": []}, "root"],
    "a root of four": [NAME, over(0, above=((0,), 4, 1)), "root"],
    "a root of a fraction": [NAME, over(0, above=((0,), 1, 1), below=((1,), 1, 1)), "root"],
    "a ragged matrix": [NAME, ONE_X, {"is": "matrix", "rows": [[{"#": 1}], []]}],
    "a matrix of texts": [{"is": "matrix", "rows": [["1"]]}],
}


@pytest.mark.parametrize("name", BAD)
def test_nonsense_is_refused(name):
    parts = [{"is": "root", "of": {"#": 1}} if part == "root" else part for part in BAD[name]]
    with pytest.raises(StoreError, match="cannot be read"):
        CODEC.read(document(*parts), object)


@settings(max_examples=30)
@given(trees)
def test_writing_is_the_same_for_equal_expressions(tree):
    first, second = expression_of(tree), expression_of(tree)
    assume(first is not None)
    assert CODEC.write(first) == CODEC.write(second + x - x)
