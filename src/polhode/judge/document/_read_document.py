"""Documents of claims read from TOML, with errors that point at the line.

The format is described in docs/claims-format.md.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from polhode.base import ParseError, read_whole
from polhode.judge.document._document import (
    CONTEXTS,
    QUANTIFIERS,
    Claim,
    Definition,
    Document,
    Part,
)

LONGEST = 4_000_000  # characters

_DOCUMENT = ("title", "source")
_PART = (
    *("id", "title", "system", "convention", "like"),
    *("bindings", "let", "constants", "positive", "given"),
)
_CLAIM = (
    *("id", "part", "context", "latex", "words", "means", "when", "read_as", "reason", "where"),
    *("follows_from", "bindings", "let", "given", "small", "start"),
)

_SCHEMAS = (1, 2)  # documents have the same fields in both


def read_document(source: str | Path) -> Document:
    """A document of claims, from its text or from a file.

    Args:
        source: TOML as text, or the path of a file that holds it.

    Raises:
        ParseError: for anything else, with the line, the field and what to do.
        StoreError: for a file that cannot be read.
    """
    text = _text_of(source) if isinstance(source, Path) else source
    if len(text) > LONGEST:
        raise ParseError(f"a document of {len(text)} characters", expected=f"at most {LONGEST}")
    content = _toml(text)
    lines = text.splitlines()
    _refuse_unknown_fields(content)
    header = next((n for n, line in enumerate(lines, 1) if line.strip() == "[document]"), 1)
    head = Table("document", content.get("document", {}), header, lines)
    head.refuse_others(_DOCUMENT)
    parts = _parts(tables("part", content.get("part", []), lines))
    claims = _claims(tables("claim", content.get("claim", []), lines), parts)
    return Document(
        head.text("title", required=True), head.text("source"), tuple(parts.values()), claims
    )


def _text_of(path: Path) -> str:
    content = read_whole(path, "a document of claims in TOML")
    try:
        return content.decode("utf-8").replace("\r\n", "\n")
    except UnicodeDecodeError as error:
        raise ParseError(
            f"{path.name}, which is not UTF-8 from byte {error.start} on",
            expected="a text file in UTF-8",
            advice="save it as UTF-8",
        ) from None


def _toml(text: str) -> dict[str, Any]:
    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        is_repeated = "overwrite" in str(error)
        raise ParseError(
            f"a document that is not TOML: {error}",
            expected="each name once" if is_repeated else "tables [document], [[part]], [[claim]]",
            advice="leave out one of the two, or bind a letter anew for one claim in its bindings"
            if is_repeated
            else "put LaTeX in single quotes, or in ''' if it has quotes or several lines",
        ) from None
    except RecursionError:
        raise ParseError("a document nested too deeply", expected="plain tables") from None


def _refuse_unknown_fields(content: dict[str, Any]) -> None:
    schema = content.get("schema", _SCHEMAS[-1])
    if schema not in _SCHEMAS:
        raise ParseError(
            f"a document of schema {schema!r}",
            expected=f"schema = {_SCHEMAS[-1]}",
            advice="it was written for another version of polhode",
        )
    for name in content.keys() - {"schema", "document", "part", "claim"}:
        raise ParseError(
            f"{name!r} at the top of the document",
            expected="schema, [document], [[part]] and [[claim]]",
        )
    if not isinstance(content.get("document", {}), dict):
        raise ParseError("'document' that is not a table", expected="[document] with a title")


def _parts(found: tuple[Table, ...]) -> dict[str, Part]:
    parts: dict[str, Part] = {}
    for table in found:
        part = _part(table, parts)
        if part.id in parts:
            raise table.wrong("id", "a unique id", "another [[part]] has it already")
        parts[part.id] = part
    return parts


def _part(table: Table, earlier: dict[str, Part]) -> Part:
    table.refuse_others(_PART)
    like = table.text("like")
    if like and like not in earlier:
        raise table.wrong("like", f"an earlier part: {', '.join(earlier) or 'no part is earlier'}")
    own = Part(
        id=table.text("id", required=True),
        title=table.text("title"),
        system=table.text("system", required=not like),
        convention=table.text("convention"),
        bindings=table.table("bindings"),
        definitions=table.definitions("let"),
        constants=table.texts("constants"),
        positive=table.texts("positive"),
        given=table.texts("given"),
    )
    return _extended(earlier[like], own) if like else own


def _extended(base: Part, own: Part) -> Part:
    """A part with all conventions of an earlier one in addition to its own."""
    convention = own.convention or base.convention
    if base.convention and own.convention:
        convention = f"{base.convention.rstrip('.')}. {own.convention}"
    return replace(
        own,
        system=own.system or base.system,
        convention=convention,
        bindings={**base.bindings, **own.bindings},
        definitions=(*base.definitions, *own.definitions),
        constants=(*base.constants, *own.constants),
        positive=(*base.positive, *own.positive),
        given=(*base.given, *own.given),
    )


def _claims(found: tuple[Table, ...], parts: dict[str, Part]) -> tuple[Claim, ...]:
    claims: dict[str, Claim] = {}
    for table in found:
        claim = _claim(table)
        if claim.id in claims:
            raise table.wrong("id", "a unique id", f"line {claims[claim.id].line} has it already")
        if claim.part not in parts:
            raise table.wrong(
                "part", f"one of {', '.join(parts) or 'the parts, but there is no [[part]]'}"
            )
        claims[claim.id] = claim
    for table in found:
        for origin in table.texts("follows_from"):
            if origin not in claims or origin == table.values["id"]:
                raise table.wrong("follows_from", "ids of other claims of this document")
    return tuple(claims.values())


def _claim(table: Table) -> Claim:
    table.refuse_others(_CLAIM)
    claim = Claim(
        id=table.text("id", required=True),
        part=table.text("part", required=True),
        context=table.one_of("context", CONTEXTS, "motion"),
        latex=table.text("latex"),
        words=table.text("words"),
        means=table.text("means"),
        when=table.one_of("when", QUANTIFIERS, ""),
        read_as=table.text("read_as"),
        reason=table.text("reason"),
        where=table.text("where"),
        follows_from=table.texts("follows_from"),
        bindings=table.table("bindings"),
        definitions=table.definitions("let"),
        given=table.texts("given"),
        small=table.orders("small"),
        start=table.table("start"),
        line=table.line,
    )
    if bool(claim.latex) == bool(claim.words):
        raise table.wrong("latex", "latex as printed, or words with what they mean, not both")
    if claim.words and not claim.means:
        raise table.wrong("means", "the words as a formula", "write means = '...' in LaTeX")
    if bool(claim.read_as) != bool(claim.reason):
        raise table.wrong(
            "reason", "read_as together with its reason", "state the evidence of the damage"
        )
    return claim


# -- one table, field by field -------------------------------------------------------------------

_LONGEST_SHOWN = 40  # characters of a value in an error
_HEADER = re.compile(r"\s*\[{1,2}\s*([\w.\-\"' ]+?)\s*\]{1,2}\s*(?:#.*)?")


@dataclass(frozen=True)
class Table:
    """A table such as `[[claim]]`.

    Attributes:
        name: the name in its header.
        values: its fields.
        line: line number of its header.
        lines: of the whole document.
    """

    name: str
    values: Mapping[str, Any]
    line: int
    lines: Sequence[str]

    def text(self, key: str, *, required: bool = False) -> str:
        """A string; empty if it is optional and left out."""
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
        """Refuse fields that this table does not have."""
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
        shown = repr(self.values.get(key))
        shown = shown if len(shown) <= _LONGEST_SHOWN else shown[: _LONGEST_SHOWN - 3] + "..."
        given = f"{key} = {shown}" if key in self.values else f"no {key}"
        place = f"line {self.line_of(key)}: {given} in [{self.name}]"
        return ParseError(place, expected=expected, advice=advice)

    def line_of(self, key: str) -> int:
        """Line where a field begins; that of the header if it is missing."""
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

    Raises `ParseError` where they are not a list of tables.
    """
    # tomllib gives no line numbers, so headers are matched with tables in order.
    headers = [number for number, text in enumerate(lines, 1) if _header(text) == name]
    if not isinstance(entries, list) or not all(isinstance(entry, dict) for entry in entries):
        place = f"line {headers[0]}: " if headers else ""
        raise ParseError(
            f"{place}{name!r} that is not a list of tables",
            expected=f"one [[{name}]] for each",
            advice="use double brackets",
        )
    headers += [1] * (len(entries) - len(headers))
    pairs = zip(entries, headers, strict=False)
    return tuple(Table(name, values, line, lines) for values, line in pairs)


def _header(text: str) -> str:
    match = _HEADER.fullmatch(text)
    return match.group(1) if match else ""
