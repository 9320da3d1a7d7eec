"""A document of claims judged against the systems it names."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from polhode.base import Progress, terminal_progress
from polhode.catalogue import entry_named_in, problem_set
from polhode.judge.document._document import Document
from polhode.judge.document._read_document import read_document
from polhode.judge.document._report import Report
from polhode.judge.processes._parallel_audit import ClaimLimits, audit_apart
from polhode.model import System


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
    if isinstance(source, Document):
        return source
    return read_document(problem_set() if source is None else source)
