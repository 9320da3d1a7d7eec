"""Programs kept on disk: the same steps, found again by what they are made from."""

import zlib
from fractions import Fraction

import pytest

import polhode as ph
from polhode.algebra import as_symbol, compile_program, cos, sin, sqrt, stored, symbols, texts_of
from polhode.algebra import coordinate as angle
from polhode.base import cache

X, Y = symbols("x y")
Q = angle("q")
GIVEN = (as_symbol(X), as_symbol(Y), as_symbol(Q))
WANTED = (X * Y / 3 - sin(Q) ** 2, sqrt(X**2 + Y**2) / cos(Q), Y * 10**30 + ph.pi)


@pytest.fixture(autouse=True)
def place(tmp_path, monkeypatch):
    monkeypatch.setenv("POLHODE_CACHE", str(tmp_path))
    return tmp_path / "programs"


def made():
    return compile_program(WANTED, GIVEN)


def refused():
    raise AssertionError("it was not found")


def again(make=refused, texts=("one",), arguments=GIVEN):
    return stored(texts, arguments, make)


def entry(place):
    (found,) = (path for path in place.iterdir() if path.name != "CACHEDIR.TAG")
    return found


def test_the_same_program_is_read():
    assert again(made) == made()
    kept = again()
    assert kept == made()
    assert kept.function()(2.0, 3.0, 0.5) == made().function()(2.0, 3.0, 0.5)
    assert Fraction(1, 3) in {step.value for step in kept.instructions}


def test_other_texts_and_other_arguments_are_other_programs():
    again(made)
    with pytest.raises(AssertionError):
        again(texts=("one", "more"))
    with pytest.raises(AssertionError):
        again(arguments=GIVEN[::-1])


def test_texts_tell_apart_what_has_one_name():
    """A parameter that is known to be positive, or a coordinate, is not the same symbol."""
    positive, moving = ph.symbol("x", positive=True), ph.coordinate("x")
    texts = {tuple(texts_of([sqrt(x**2 + 1)])) for x in (X, positive, moving)}
    assert len(texts) == 3
    assert tuple(texts_of([X + Y])) == tuple(texts_of([Y + X]))


@pytest.mark.parametrize(
    "document",
    [
        b"no program",
        zlib.compress(b"[]"),
        zlib.compress(b'{"operations": "+", "operands": [0, 0], "values": [], "outputs": [0]}'),
        zlib.compress(b'{"operations": "a", "operands": [], "values": [[3, 1]], "outputs": [0]}'),
        zlib.compress(b'{"operations": "c", "operands": [], "values": [[1, 0]], "outputs": [0]}'),
        zlib.compress(b'{"operations": "c", "operands": [], "values": [[1, 1]], "outputs": [1]}'),
        zlib.compress(b'{"operations": "?", "operands": [], "values": [], "outputs": []}'),
    ],
)
def test_what_is_no_program_is_made_again(place, document):
    again(made)
    key = entry(place).name
    cache.write("programs", key, document)
    assert again(made) == made()
    assert again() == made()
