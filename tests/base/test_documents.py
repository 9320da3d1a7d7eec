"""Objects in documents: shared parts once, unknown ones never, damage named in words."""

import json
import platform
import subprocess
import sys
from dataclasses import dataclass
from typing import Any

import numpy
import pytest

from polhode.base import (
    SCHEMA,
    Codec,
    DeclarationError,
    ShapeRecord,
    StoreError,
    digest,
    installed_version,
    provenance,
)


@dataclass(frozen=True)
class Pair:
    first: Any
    second: Any


@dataclass(frozen=True)
class Stranger:
    name: str


def pair(first: Any, second: Any) -> Pair:
    if first == "forbidden":
        raise DeclarationError("a pair of what must not be", expected="something else")
    return Pair(first, second)


CODEC = Codec(
    [ShapeRecord("pair", (Pair,), lambda p: {"first": p.first, "second": p.second}, pair)]
)


@pytest.mark.parametrize(
    "value",
    [
        Pair(1, 2),
        Pair(None, True),
        Pair('é ∂ \u2028 " \\ \n', -(10**30)),
        Pair((1, (2, "x"), ()), Pair(3, 4)),
        Pair(Pair(1, 2), (Pair(1, 2), Pair(1, 2))),
    ],
)
def test_values_come_back(value):
    text = CODEC.write(value)
    assert CODEC.read(text, Pair) == value
    assert CODEC.write(CODEC.read(text, Pair)) == text


def test_parts_are_written_once():
    inner = Pair(1, 2)
    shared = CODEC.write(Pair(inner, inner))
    assert shared == CODEC.write(Pair(Pair(1, 2), Pair(1, 2)))
    assert len(json.loads(shared)["parts"]) == 2
    again = CODEC.read(shared, Pair)
    assert again.first is again.second


def test_true_is_not_one():
    assert CODEC.write(Pair(True, 0)) != CODEC.write(Pair(1, False))


def test_digests_distinguish_documents():
    assert digest(CODEC.write(Pair(1, 2))) == digest(CODEC.write(Pair(1, 2)))
    assert digest(CODEC.write(Pair(1, 2))) != digest(CODEC.write(Pair(2, 1)))


@pytest.mark.parametrize(
    "value", [Stranger("x"), Pair(1, Stranger("x")), Pair(1, 2.5), Pair(1, [])]
)
def test_what_could_not_be_read_back_is_not_written(value):
    with pytest.raises(StoreError, match="in a declaration; expected expressions, vectors, text"):
        CODEC.write(value)


def document(*parts, **more):
    return json.dumps({"format": "polhode declaration", "schema": 2, "parts": parts, **more})


ONE = {"is": "pair", "first": 1, "second": 2}


def holding(number):
    return {"is": "pair", "first": {"#": number}, "second": 0}


def nested(depth):
    return [ONE, *(holding(k) for k in range(depth))]


def deep(depth):
    value: Any = 1
    for _ in range(depth):
        value = [value]
    return {"is": "pair", "first": value, "second": 0}


def test_the_examples_below_are_bad_only_where_they_differ():
    assert CODEC.read(document(ONE), Pair) == Pair(1, 2)
    assert CODEC.read(document(*nested(150)), Pair).second == 0
    assert CODEC.read(document(deep(6)), Pair).second == 0


BAD = {
    "nothing": "",
    "no JSON": "{",
    "binary": "\x89HDF\r\n\x1a\n\0\0",
    "a number": "3",
    "a list": "[]",
    "another format": '{"format": "something", "schema": 2, "parts": []}',
    "no parts": document(),
    "parts that are no list": document(parts={"a": 1}),
    "a part that is a number": document(3),
    "a part that is a list": document([1]),
    "a part without a shape": document({"first": 1, "second": 2}),
    "an unknown shape": document({"is": "os.system", "command": "true"}),
    "a shape that is a list": document({**ONE, "is": ["pair"]}),
    "a field missing": document({"is": "pair", "first": 1}),
    "a field too many": document({**ONE, "third": 1}),
    "self as a field": document({**ONE, "self": 1}),
    "a part of itself": document(holding(0)),
    "a part to come": document(holding(1), ONE),
    "a part before the first": document(ONE, holding(-1)),
    "a part by name": document(ONE, holding("0")),
    "a part by truth": document(ONE, holding(False)),
    "a reference with more": document(ONE, {**ONE, "first": {"#": 0, "x": 1}}),
    "an object as a field": document({**ONE, "first": {"a": 1}}),
    "too deep": document(*nested(300)),
    "lists too deep": document(deep(7)),
    "JSON too deep": '{"format":' + "[" * 100_000,
    "a fraction": document({**ONE, "first": 0.5}),
    "NaN": document({**ONE, "first": float("nan")}),
    "a number of many digits": '{"parts": ' + "9" * 10_000 + "}",
    "too many parts": document(*[1] * 100_001),
    "refused by its constructor": document({**ONE, "first": "forbidden"}),
}


@pytest.mark.parametrize("name", BAD)
def test_damage_is_named_in_words(name):
    with pytest.raises(StoreError, match="a declaration that cannot be read: ") as refused:
        CODEC.read(BAD[name], Pair)
    assert len(str(refused.value)) < 500


def test_a_document_of_something_else():
    with pytest.raises(StoreError, match="it does not end with a Stranger"):
        CODEC.read(document(ONE), Stranger)


def test_a_document_too_long():
    with pytest.raises(StoreError, match="more than any declaration"):
        CODEC.read(" " * (33 * 1024**2), Pair)


@pytest.mark.parametrize("schema", [0, 1, "2", None])
def test_another_schema(schema):
    with pytest.raises(StoreError, match="expected schema 2; read it with the version"):
        CODEC.read(document(ONE, schema=schema), Pair)


def test_a_document_says_what_it_was_made_with():
    made = provenance(seed=7)
    assert made["schema"] == SCHEMA
    assert made["seed"] == 7
    assert made["versions"]["python"] == platform.python_version()
    assert made["versions"]["numpy"] == numpy.__version__
    assert made["versions"]["polhode"]
    assert json.loads(json.dumps(made)) == made


def test_no_random_numbers_no_seed():
    assert provenance()["seed"] is None


def test_what_is_not_installed_has_no_version():
    assert installed_version("no-such-distribution-anywhere") is None


def test_versions_are_found_without_imports():
    program = (
        "import sys; from polhode.base import provenance; provenance();"
        "print(sorted({'numpy', 'scipy', 'heyoka', 'sympy', 'flint'} & sys.modules.keys()))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"
