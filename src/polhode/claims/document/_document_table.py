"""One table of a document of claims, read field by field with errors that point at the line."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

from polhode.base import ParseError
from polhode.claims.document._document import Definition

_HEADER = re.compile(r"\s*\[{1,2}\s*([\w.\-\"' ]+?)\s*\]{1,2}\s*(?:#.*)?")


@dataclass(frozen=True)
class Table:
    """A table such as `[[claim]]`.

    Attributes:
        name: what its header says.
        values: what it holds.
        line: of its header.
        lines: of the whole document.
    """

    name: str
    values: Mapping[str, Any]
    line: int
    lines: Sequence[str]

    def text(self, key: str, *, required: bool = False) -> str:
        """A string; empty where it is left out and may be."""
        value = self.values.get(key, "")
        if not isinstance(value, str):
            raise self.wrong(key, "a string in quotes", "put it in single quotes: '...'")
        if required and not value.strip():
            raise self.wrong(key, "a string that is not empty", f"write {key} = '...' below it")
        return value

    def texts(self, key: str) -> tuple[str, ...]:
        """A list of strings."""
        value = self.values.get(key, [])
        if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
            raise self.wrong(key, "a list of strings", f"write {key} = ['...', '...']")
        return tuple(value)

    def table(self, key: str) -> dict[str, str]:
        """A table of strings."""
        value = self.values.get(key, {})
        if not isinstance(value, dict) or not all(isinstance(v, str) for v in value.values()):
            raise self.wrong(key, "a table of strings", f"write {key} = {{ 'symbol' = '...' }}")
        return dict(value)

    def definitions(self, key: str) -> tuple[Definition, ...]:
        """A list of definitions with their places."""
        value = self.values.get(key, [])
        entries = value if isinstance(value, list) else [value]
        return tuple(self._definition(key, entry) for entry in entries)

    def _definition(self, key: str, entry: object) -> Definition:
        form = f"{key} = [{{ says = 'r = R + x', where = 'after (3)' }}]"
        if not isinstance(entry, dict) or not all(isinstance(v, str) for v in entry.values()):
            raise self.wrong(key, "a list of tables of strings", f"write {form}")
        if not entry.keys() <= {"says", "where"} or not entry.get("says"):
            raise self.wrong(key, "'says', and 'where' in the text", f"write {form}")
        return Definition(entry["says"], entry.get("where", ""))

    def orders(self, key: str) -> dict[str, int | None]:
        """Small quantities with the order to which they are kept: `['\\epsilon:1', 'x']`."""
        found: dict[str, int | None] = {}
        for entry in self.texts(key):
            quantity, colon, order = entry.rpartition(":")
            if colon and not order.strip().isdigit():
                raise self.wrong(key, "SYMBOL or SYMBOL:ORDER", "give the order as a number")
            found[(quantity if colon else entry).strip()] = int(order) if colon else None
        return found

    def one_of(self, key: str, choices: Sequence[str], default: str) -> str:
        """One of a few words."""
        value = self.text(key) or default
        if value not in (*choices, default):
            near = get_close_matches(value, choices, n=1)
            advice = f"did you mean {near[0]!r}?" if near else ""
            raise self.wrong(key, f"one of {', '.join(choices)}", advice)
        return value

    def refuse_others(self, known: Sequence[str]) -> None:
        """Refuse a field that this table does not have."""
        for key in self.values:
            if key not in known:
                near = get_close_matches(key, known, n=1)
                advice = (
                    f"did you mean {near[0]!r}?" if near else "take it out, or make it a comment"
                )
                place = f"line {self.line_of(key)}: unknown field {key!r} in [{self.name}]"
                raise ParseError(place, expected=f"one of {', '.join(known)}", advice=advice)

    def wrong(self, key: str, expected: str, advice: str = "") -> ParseError:
        """The error about one field."""
        given = f"{key} = {_short(self.values[key])}" if key in self.values else f"no {key}"
        place = f"line {self.line_of(key)}: {given} in [{self.name}]"
        return ParseError(place, expected=expected, advice=advice)

    def line_of(self, key: str) -> int:
        """Line where a field begins; that of the header where there is none."""
        start = re.compile(rf"\s*[\"']?{re.escape(key)}[\"']?\s*=")
        below = re.compile(rf"\s*\[{{1,2}}\s*[\w\-]+\.{re.escape(key)}\s*\]")
        for number in range(self.line, len(self.lines) + 1):
            text = self.lines[number - 1]
            if start.match(text) or below.match(text):
                return number
            if number > self.line and _header(text) in _TOP:
                break
        return self.line


_TOP = ("document", "part", "claim")


def tables(name: str, entries: object, lines: Sequence[str]) -> tuple[Table, ...]:
    """All tables of one name, such as every `[[claim]]`.

    Raises `ParseError` where they are no list of tables.
    """
    headers = [number for number, text in enumerate(lines, 1) if _header(text) == name]
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        place = f"line {headers[0]}: " if headers else ""
        raise ParseError(
            f"{place}{name!r} that is no list of tables",
            expected=f"one [[{name}]] for each",
            advice="use double brackets",
        )
    headers += [1] * (len(entries) - len(headers))
    pairs = zip(entries, headers, strict=False)
    return tuple(Table(name, values, line, lines) for values, line in pairs)


def _header(text: str) -> str:
    match = _HEADER.fullmatch(text)
    return match.group(1) if match else ""


def _short(value: object) -> str:
    shown = repr(value)
    return shown if len(shown) <= 40 else shown[:37] + "..."
