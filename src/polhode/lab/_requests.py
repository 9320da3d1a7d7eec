"""Requests of the page, read from JSON and refused if types or sizes are wrong."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from math import isfinite
from typing import Any

from polhode.base import ParseError
from polhode.base.http import json_object

CONTACTS = ("", "rolling", "smooth", "friction")

_LONGEST = 300  # characters of a value
_LONGEST_LATEX = 4000
_LONGEST_TEXT = 40_000
_FORMATS = ("", ".tex", ".md")
_MOST_VALUES = 80
_MOST_ROWS = 1500  # of the path of a sheet
_LARGEST = 1e4  # m or s, in the path of a sheet

Row = tuple[float, float, float]


@dataclass(frozen=True)
class RunRequest:
    """A request for a motion; its values stay texts, for the library to read.

    Attributes:
        system: its name.
        contact: rolling, smooth or friction; empty for the declared kind.
        settings: parameters, prescribed functions and mu, by name.
        start: coordinates and speeds, by name.
        duration: such as 10 s; empty for the default.
        sheet: path of a dragged sheet, time (s) and place (m) per row; empty if it is not dragged.
    """

    system: str
    contact: str = ""
    settings: Mapping[str, str] = field(default_factory=dict)
    start: Mapping[str, str] = field(default_factory=dict)
    duration: str = ""
    sheet: tuple[Row, ...] = ()


@dataclass(frozen=True)
class Question:
    """A request to check an equation.

    Attributes:
        system: its name.
        contact: as in `RunRequest`.
        latex: the equation.
        context: of the claim, such as motion or steady.
        read: meanings of ambiguous letters, such as "L = about pivot".
    """

    system: str
    contact: str
    latex: str
    context: str
    read: tuple[str, ...] = ()


@dataclass(frozen=True)
class DerivationRequest:
    """A request to review a derivation.

    Attributes:
        system: its name.
        contact: as in `RunRequest`.
        text: the derivation, in LaTeX or Markdown.
        format: the ending that its file would have.
    """

    system: str
    contact: str
    text: str
    format: str


@dataclass(frozen=True)
class Fields:
    """The members of a JSON object, taken one by one with their types checked."""

    values: Mapping[str, Any]

    @classmethod
    def read(cls, body: bytes) -> Fields:
        """Strict JSON: an object, without NaN, infinities and repeated names.

        Raises:
            ParseError: for anything else.
        """
        return cls(json_object(body))

    def only(self, *names: str) -> Fields:
        """These fields; an error if there are any besides the ones named."""
        for name in self.values:
            if name not in names:
                raise _wrong(name, f"one of {', '.join(names)}")
        return self

    def text(self, name: str, longest: int = _LONGEST) -> str:
        """A text; empty where it is left out."""
        value = self.values.get(name, "")
        if not isinstance(value, str) or len(value) > longest:
            raise _wrong(name, f"a text of at most {longest} characters")
        return value

    def one_of(self, name: str, known: Sequence[str]) -> str:
        """One of a few words."""
        value = self.text(name)
        if value not in known:
            raise _wrong(name, f"one of {', '.join(filter(None, known))}")
        return value

    def texts(self, name: str) -> dict[str, str]:
        """Texts by name."""
        value = self.values.get(name, {})
        if not isinstance(value, dict) or len(value) > _MOST_VALUES:
            raise _wrong(name, f"an object of at most {_MOST_VALUES} texts")
        inner = Fields(value)
        return {key[:_LONGEST]: inner.text(key) for key in value}

    def rows(self, name: str) -> tuple[Row, ...]:
        """Rows of a time and two lengths, the times increasing from 0."""
        value = self.values.get(name, [])
        if not isinstance(value, list) or len(value) > _MOST_ROWS:
            raise _wrong(name, f"a list of at most {_MOST_ROWS} rows")
        rows = tuple(_row(name, row) for row in value)
        if len(rows) == 1 or any(b[0] <= a[0] for a, b in pairwise(rows)):
            raise _wrong(name, "at least two rows with times that increase")
        return rows


def run_request(fields: Fields) -> RunRequest:
    """The motion requested.

    Raises:
        ParseError: for an unknown member, or one of the wrong type or size.
    """
    return RunRequest(
        fields.text("system"),
        fields.one_of("contact", CONTACTS),
        fields.texts("settings"),
        fields.texts("start"),
        fields.text("duration"),
        fields.rows("sheet"),
    )


def question_of(fields: Fields) -> Question:
    """The equation to be checked.

    Raises:
        ParseError: for an unknown member, or one of the wrong type or size.
    """
    fields.only("system", "contact", "latex", "context", "read")
    readings = (reading.strip() for reading in fields.text("read").split(";"))
    return Question(
        fields.text("system"),
        fields.one_of("contact", CONTACTS),
        fields.text("latex", _LONGEST_LATEX),
        fields.text("context") or "motion",
        tuple(filter(None, readings)),
    )


def solution_of(fields: Fields) -> DerivationRequest:
    """The derivation to be reviewed.

    Raises:
        ParseError: for an unknown member, or one of the wrong type or size.
    """
    fields.only("system", "contact", "text", "format")
    return DerivationRequest(
        fields.text("system"),
        fields.one_of("contact", CONTACTS),
        fields.text("text", _LONGEST_TEXT),
        fields.one_of("format", _FORMATS) or ".tex",
    )


def _row(name: str, row: object) -> Row:
    if not isinstance(row, list) or len(row) != 3:
        raise _wrong(name, "rows of a time and two lengths")
    t, x, y = (_number(name, value) for value in row)
    return t, x, y


def _number(name: str, value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise _wrong(name, "numbers")
    if not (isfinite(value) and abs(value) <= _LARGEST):
        raise _wrong(name, f"numbers of size up to {_LARGEST:g}")
    return float(value)


def _wrong(name: str, expected: str) -> ParseError:
    return ParseError(f"{name[:40]!r} in the request", expected=expected)
