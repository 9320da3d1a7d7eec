"""The cells of words of a Jupyter notebook, with the place of every character in its file."""

from __future__ import annotations

import json
import re
from array import array
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from polhode.base import ParseError
from polhode.judge.source._placed import PlacedText

_LITERAL = re.compile(r'"((?:[^"\\]|\\.)*)"', re.DOTALL)
_CHARACTER = re.compile(
    r"\\u[dD][89abAB][0-9a-fA-F]{2}\\u[dD][c-fC-F][0-9a-fA-F]{2}"  # two for one character
    r"|\\u[0-9a-fA-F]{4}|\\.|.",
    re.DOTALL,
)


@dataclass(frozen=True)
class _Pairs:
    """An object of a JSON document, with its keys in the order of the file, repeated ones too."""

    entries: tuple[tuple[str, Any], ...]


@dataclass(frozen=True)
class _Literal:
    """A string of a JSON document, and where what stands between its quotes begins."""

    value: str
    start: int


def markdown_cells(text: str) -> Iterator[PlacedText]:
    """The cells of words, in order.

    Raises:
        ParseError: for a file that is no notebook.
    """
    try:
        content = json.loads(text, object_pairs_hook=lambda pairs: _Pairs(tuple(pairs)))
        # The strings of the document are read in the order in which they stand in the file.
        notebook = _placed(content, _LITERAL.finditer(text))
    except (json.JSONDecodeError, RecursionError) as error:
        where = f" in line {error.lineno}" if isinstance(error, json.JSONDecodeError) else ""
        raise ParseError(
            f"a notebook whose JSON is damaged{where}", expected="a Jupyter notebook"
        ) from error
    cells = notebook.get("cells") if isinstance(notebook, dict) else None
    if not isinstance(cells, list):
        raise ParseError(
            "JSON without cells",
            expected="a Jupyter notebook of format 4",
            advice="open and save an older one in Jupyter, which converts it",
        )
    for cell in cells:
        if isinstance(cell, dict) and _text(cell.get("cell_type")) == "markdown":
            yield _source(cell.get("source"), text)


def _placed(value: Any, literals: Iterator[re.Match[str]]) -> Any:
    match value:
        case str():
            return _Literal(value, next(literals).start(1))
        case list():
            return [_placed(entry, literals) for entry in value]
        case _Pairs(entries):
            found: dict[str, Any] = {}
            for key, entry in entries:
                next(literals)
                found[key] = _placed(entry, literals)
            return found
    return value


def _text(value: Any) -> str:
    return value.value if isinstance(value, _Literal) else ""


def _source(source: Any, text: str) -> PlacedText:
    """The lines of a cell, which are one string or many."""
    lines = source if isinstance(source, list) else [source]
    found = [_decoded(line, text) for line in lines if isinstance(line, _Literal)]
    return PlacedText.joined(found) if found else PlacedText.of("")


def _decoded(literal: _Literal, text: str) -> PlacedText:
    """A string with the place of each of its characters in the file."""
    places = array("q")
    place = literal.start
    for _ in literal.value:
        places.append(place)
        match = _CHARACTER.match(text, place)
        place = match.end() if match else place
    return PlacedText(literal.value, places, place)
