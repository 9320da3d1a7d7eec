"""A document of claims judged against the systems it names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

from polhode.base import Progress, terminal_progress
from polhode.catalogue._named import entry_named_in
from polhode.model import System

if TYPE_CHECKING:
    from polhode.claims import ClaimLimits, Document, Report


def problem_set() -> str:
    """The problem set as a document of claims: TOML text, in the format of docs/claims-format.md.

    It holds all 162 numbered equations of the problem set, byte for byte as its transcript prints
    them, and statements in words.
    """
    return (files("polhode.catalogue") / "problem_set.toml").read_text("utf-8")


def audit(
    document: Document | str | Path | None = None,
    *,
    systems: Mapping[str, System] | None = None,
    only: Iterable[str] = (),
    workers: int = 2,
    limits: ClaimLimits | None = None,
    progress: Progress | None = None,
) -> Report:
    """Judge every claim of a document, each against the system that its part is about.

    Worker processes judge; a claim that takes too long is abandoned and reported as unread. An
    interruption keeps the verdicts found so far.

    Args:
        document: a document, its TOML text or its file; by default the problem set.
        systems: systems that the document names, in addition to those of the catalogue.
        only: ids of the claims to judge; all of them if empty.
        workers: number of worker processes.
        limits: on the time and memory for one claim.
        progress: called after every claim; by default a line in the terminal.

    Raises:
        ParseError: for text that is not a document, and for an id that it does not contain.
    """
    from polhode.claims import audit_apart  # deferred: the catalogue itself needs no claims

    own = systems or {}
    advice = "give it beside the document, as one of systems={...}"

    def find(name: str) -> System:
        if name in own:
            return own[name]
        return entry_named_in("the document", name, advice=advice).build()

    return audit_apart(
        document_of(document),
        find,
        only=only,
        workers=workers,
        limits=limits,
        progress=progress or terminal_progress(),
    )


def document_of(source: Document | str | Path | None) -> Document:
    """A document, read from TOML text or a file if necessary; the problem set for None."""
    from polhode.claims import Document, read_document

    if isinstance(source, Document):
        return source
    return read_document(problem_set() if source is None else source)
