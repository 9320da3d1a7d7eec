"""Slips that people make in formulas, as changes of the text."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise

from polhode.solution import breaks

_NUMBER = re.compile(r"(?<![\d^_{.])(?<!_\{)\d+(?![\d}.])")
#: A letter with an index of one sign, which is not part of a longer name.
_INDEXED = re.compile(r"(?P<letter>\\[a-zA-Z]+|(?<![a-zA-Z\\])[a-zA-Z])_(?P<index>\w)(?!\w)")


@dataclass(frozen=True)
class Slip:
    """A formula with one slip.

    Attributes:
        kind: sign, factor, function, power, index or term.
        text: the formula, as LaTeX.
    """

    kind: str
    text: str


def slips(text: str, letters: Iterable[str] = ()) -> Iterator[Slip]:
    """Slips that people make, of all kinds.

    A sign, a factor, sine for cosine, a square left out, the index of another letter, a term
    forgotten.

    Args:
        text: of a formula, as LaTeX.
        letters: LaTeX of letters, the indices of which may be confused, besides those in the text.
    """
    yield from (Slip("sign", changed) for changed in _signs(text))
    yield from (Slip("factor", changed) for changed in _factors(text))
    for one, other in (("sin", "cos"), ("cos", "sin")):
        for found in re.finditer(rf"\\{one}(?![a-z])", text):
            yield Slip("function", f"{text[: found.start()]}\\{other}{text[found.end() :]}")
    for found in re.finditer(r"(?<=sin|cos)\^2", text):
        yield Slip("power", f"{text[: found.start()]}{text[found.end() :]}")
    yield from (Slip("index", changed) for changed in _indices(text, letters))
    yield from (Slip("term", changed) for changed in _terms(text))


def _signs(text: str) -> Iterator[str]:
    for found in re.finditer(r"(?<= )[+-](?= )", text):
        yield f"{text[: found.start()]}{'-' if found[0] == '+' else '+'}{text[found.end() :]}"


def _factors(text: str) -> Iterator[str]:
    """A number with another near it, and a 2 before a term, or left out."""
    for found in _NUMBER.finditer(text):
        number, behind = int(found[0]), text[found.end() :]
        for near in (number + 1, number - 1):
            if near > 1:
                yield f"{text[: found.start()]}{near}{behind}"
        if number == 2 and behind.startswith(" "):
            yield f"{text[: found.start()]}{behind[1:]}"
    for place in breaks(text):
        begins = text[place + 3 : place + 4]
        if begins and not begins.isdigit() and text[place + 1] in "+-=":
            yield f"{text[: place + 3]}2 {text[place + 3 :]}"


def _indices(text: str, letters: Iterable[str]) -> Iterator[str]:
    """The index of another quantity of the same letter, such as I₃ for I₁."""
    known = defaultdict[str, dict[str, None]](dict)
    for one in (text, *letters):
        for found in _INDEXED.finditer(one):
            known[found["letter"]][found["index"]] = None
    for found in _INDEXED.finditer(text):
        if found["letter"] in (r"\mathbf", r"\rm", r"\hat"):
            continue
        for index in known[found["letter"]]:
            if index != found["index"]:
                yield f"{text[: found.start('index')]}{index}{text[found.end('index') :]}"


def _terms(text: str) -> Iterator[str]:
    """A term of a sum left out, the first of a side excepted."""
    places = [*breaks(text), len(text)]
    for begin, end in pairwise(places):
        if text[begin + 1] in "+-":
            yield f"{text[:begin]}{text[end:]}"
