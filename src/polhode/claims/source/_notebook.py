"""The cells of words of a Jupyter notebook, with the place of every character in its file."""

from __future__ import annotations

import json
import re
from array import array
from collections.abc import Iterator
from json.decoder import JSONDecoder, scanstring
from json.scanner import py_make_scanner
from typing import Any

from polhode.base import ParseError
from polhode.claims.source._placed import PlacedText

_ESCAPE = re.compile(r"\\u([0-9a-fA-F]{4})(?:\\u([dD][c-fC-F][0-9a-fA-F]{2}))?|\\(.)|([^\\])", re.S)
_CHARACTERS = {"n": "\n", "t": "\t", "r": "\r", "b": "\b", "f": "\f"}


class _PlacedString(str):
    """A string of a JSON document that knows where it begins."""

    start = 0


class _Decoder(JSONDecoder):
    """Reads JSON as the standard library does, and keeps the places of strings."""

    def __init__(self) -> None:
        super().__init__()
        self.parse_string = _string
        self.scan_once = py_make_scanner(self)


def _string(text: str, start: int, strict: bool = True) -> tuple[str, int]:
    value, end = scanstring(text, start, strict)
    placed = _PlacedString(value)
    placed.start = start
    return placed, end


def markdown_cells(text: str) -> Iterator[PlacedText]:
    """The cells of words, in order.

    Raises:
        ParseError: for a file that is no notebook.
    """
    try:
        notebook = _Decoder().decode(text)
    except (json.JSONDecodeError, RecursionError) as error:
        where = f" (line {error.lineno})" if isinstance(error, json.JSONDecodeError) else ""
        raise ParseError(
            f"a notebook whose JSON is damaged{where}", expected="a Jupyter notebook"
        ) from error
    cells = notebook.get("cells") if isinstance(notebook, dict) else None
    if not isinstance(cells, list):
        raise ParseError("JSON without cells", expected="a Jupyter notebook of format 4")
    for cell in cells:
        if isinstance(cell, dict) and cell.get("cell_type") == "markdown":
            yield PlacedText.joined(_lines(cell.get("source"), text))


def _lines(source: Any, text: str) -> list[PlacedText]:
    """The lines of a cell, which are one string or many."""
    lines = source if isinstance(source, list) else [source]
    found = [_decoded(line, text) for line in lines if isinstance(line, _PlacedString)]
    return found or [PlacedText.of("")]


def _decoded(value: _PlacedString, text: str) -> PlacedText:
    """A string with the place of each of its characters in the file."""
    places = array("q")
    place = value.start
    while len(places) < len(value):
        match = _ESCAPE.match(text, place)
        assert match is not None  # the decoder has read it
        places.append(place)
        place = match.end()
        if match[2] is not None and not _is_pair(match[1]):
            place -= 6  # two characters rather than a pair
    return PlacedText(str(value), places, place)


def _is_pair(first: str) -> bool:
    return 0xD800 <= int(first, 16) <= 0xDBFF
