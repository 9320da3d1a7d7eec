"""Reading a document of claims from TOML; the format is described in docs/claims-format.md."""

from __future__ import annotations

import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

from polhode.base import ParseError, read_whole
from polhode.claims.document._document import CONTEXTS, QUANTIFIERS, Claim, Document, Part
from polhode.claims.document._document_table import Table, tables

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

_SCHEMAS = (1, 2)  # what a document may hold is the same in both


def read_document(source: str | Path) -> Document:
    """A document of claims, from its text or from a file.

    Args:
        source: TOML as text, or the path of a file that holds it.

    Raises:
        ParseError: for what is no such document, with the line, the field and what to do.
        StoreError: for a file that cannot be read.
    """
    text = _text_of(source) if isinstance(source, Path) else source
    if len(text) > LONGEST:
        raise ParseError(f"a document of {len(text)} characters", expected=f"at most {LONGEST}")
    content = _toml(text)
    lines = text.splitlines()
    _refuse_strangers(content)
    head = Table("document", content.get("document", {}), _line(lines, "[document]"), lines)
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
        raise ParseError(
            f"a document that is no TOML: {error}",
            expected="tables [document], [[part]], [[claim]]",
            advice="put LaTeX in single quotes, or in three of them where it has some or has lines",
        ) from None
    except RecursionError:
        raise ParseError("a document nested too deeply", expected="plain tables") from None


def _refuse_strangers(content: dict[str, Any]) -> None:
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
        raise ParseError("'document' that is no table", expected="[document] with a title")


def _line(lines: list[str], header: str) -> int:
    return next((n for n, text in enumerate(lines, 1) if text.strip() == header), 1)


def _parts(found: tuple[Table, ...]) -> dict[str, Part]:
    parts: dict[str, Part] = {}
    for table in found:
        part = _part(table, parts)
        if part.id in parts:
            raise table.wrong("id", "an id of its own", "another [[part]] has it already")
        parts[part.id] = part
    return parts


def _part(table: Table, earlier: dict[str, Part]) -> Part:
    table.refuse_others(_PART)
    like = table.text("like")
    if like and like not in earlier:
        raise table.wrong("like", f"an earlier part: {', '.join(earlier) or 'there is none'}")
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
    """A part that has besides its own all conventions of an earlier one."""
    return replace(
        own,
        system=own.system or base.system,
        convention=_together(base.convention, own.convention),
        bindings={**base.bindings, **own.bindings},
        definitions=(*base.definitions, *own.definitions),
        constants=(*base.constants, *own.constants),
        positive=(*base.positive, *own.positive),
        given=(*base.given, *own.given),
    )


def _together(first: str, second: str) -> str:
    """Two conventions in words, one after the other."""
    return f"{first.rstrip('.')}. {second}" if first and second else first or second


def _claims(found: tuple[Table, ...], parts: dict[str, Part]) -> tuple[Claim, ...]:
    claims: dict[str, Claim] = {}
    for table in found:
        claim = _claim(table)
        if claim.id in claims:
            raise table.wrong("id", "an id of its own", f"line {claims[claim.id].line} has it")
        if claim.part not in parts:
            raise table.wrong("part", f"one of {', '.join(parts) or 'the parts: there is none'}")
        claims[claim.id] = claim
    for table in found:
        _refuse_unknown_origin(table, claims)
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
        raise table.wrong("reason", "read_as together with its reason", "say how the damage shows")
    return claim


def _refuse_unknown_origin(table: Table, claims: dict[str, Claim]) -> None:
    for origin in table.texts("follows_from"):
        if origin not in claims or origin == table.values["id"]:
            raise table.wrong("follows_from", "ids of other claims of this document")
