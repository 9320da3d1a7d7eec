"""A derivation reviewed: read, judged line by line, and marked."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from time import perf_counter

from polhode.base import NumericError, interrupted
from polhode.claims import Answer, DocumentRead, SourceRelation, Verdict, read_documents, read_text
from polhode.claims.building_blocks import Node, OpenVerdict
from polhode.derive import Equations, equations_only
from polhode.review._body_axes import with_doubt_about_axes
from polhode.review._cues import cues
from polhode.review._in_force import Section, Statements
from polhode.review._judged_line import JudgedLine, TextLine, judged_line, unmentioned_speeds
from polhode.review._marks import ALTOGETHER, LONGEST, marked
from polhode.review._part_choices import choices_of, under_choice
from polhode.review._references import References
from polhode.review._reviewed import Review, ReviewedLine
from polhode.review._stated import stated_by, with_small

Tell = Callable[[ReviewedLine], object]


def review(
    text: str,
    equations: Equations,
    *,
    format: str = ".tex",
    name: str = "",
    seconds: float = ALTOGETHER,
    tell: Tell = lambda line: None,
) -> Review:
    """Review a derivation given as text: a mark for each of its relations.

    Args:
        text: the whole document.
        equations: of the system that it is about.
        format: the ending that its file would have: ``.tex``, ``.md``, ``.ipynb``, ``.typ``.
        name: a name for it.
        seconds: of processor time in which corrections are sought; 0 for none.
        tell: called with each line as soon as it is judged.

    Raises:
        ParseError: for a damaged notebook.
    """
    return _reviewed([read_text(text, format, name)], (name,), equations, seconds, tell)


def review_files(
    paths: Iterable[str | Path],
    equations: Equations,
    *,
    seconds: float = ALTOGETHER,
    tell: Tell = lambda line: None,
) -> Review:
    """Review derivations in files, each by itself, with the files that they include.

    Args:
        paths: files; their endings tell the formats.
        equations: of the system that they are about.
        seconds: of processor time in which corrections are sought for each file; 0 for none.
        tell: called with each line as soon as it is judged.

    Raises:
        StoreError: for a file that is missing, no text or too large.
        ParseError: for a damaged notebook.
    """
    files = tuple(map(str, paths))
    return _reviewed(read_documents(files), files, equations, seconds, tell)


def _reviewed(
    documents: Iterable[DocumentRead],
    files: tuple[str, ...],
    equations: Equations,
    seconds: float,
    tell: Tell,
) -> Review:
    """The relations of documents with their marks."""
    equations_only(equations, "the review of a derivation")
    began = perf_counter()
    lines: list[ReviewedLine] = []
    texts: dict[str, str] = {}
    notes: list[str] = []
    for document in documents:
        if document.is_damaged:
            raise document.refused[0]
        notes += map(str, document.refused)
        references = References.of(document.relations, document.texts)
        judged = list(_in_part_readings(document.relations, equations, references))
        for line in marked(judged, equations, len(lines), seconds):
            tell(line)
            lines.append(line)
        texts.update(document.texts)
    took = perf_counter() - began
    return Review(equations.system.name, files, tuple(lines), took, tuple(notes), texts)


def _in_part_readings(
    relations: Sequence[SourceRelation], equations: Equations, references: References
) -> Iterator[JudgedLine | SourceRelation]:
    """The relations judged, letters of several meanings read in one way throughout a part."""
    first = list(_judged(relations, equations, references))
    lines = [entry for entry in first if isinstance(entry, JudgedLine)]
    chosen = choices_of(lines)
    for entry in first:
        if isinstance(entry, JudgedLine) and entry.line.section in chosen:
            with suppress(NumericError), interrupted(LONGEST, advice="judge the line by itself"):
                entry = under_choice(entry, chosen[entry.line.section], equations)
        if isinstance(entry, JudgedLine):
            entry = with_doubt_about_axes(entry, equations)
        yield entry


def _judged(
    relations: Sequence[SourceRelation], equations: Equations, references: References
) -> Iterator[JudgedLine | SourceRelation]:
    """The relations judged in order; one that is unread or out of scope is left as it is."""
    section, statements = Section(), Statements()
    tacit = unmentioned_speeds(relations, equations)
    earlier: frozenset[Node] = frozenset()
    for place, relation in enumerate(relations):
        found = cues(relation)
        section = section.at(relation, found)
        if relation.relation is None or not relation.in_scope:
            yield relation
            continue
        stated = statements.at(section).in_sentence(found.sentence)
        stated = with_small(stated, found.small_here, equations).to_order(found.order)
        cited = references.cited(found, place)
        line = TextLine(relation, found, section, stated, tacit, earlier, cited)
        line = replace(line, in_force=stated.near_motion({*line.letters}))
        earlier = earlier.union(line.letters)
        try:
            with interrupted(LONGEST, advice="judge the line by itself"):
                judged = judged_line(line, equations, {})
                judged, own = stated_by(judged, statements.own(section), equations)
            statements.state(section, own)
        except NumericError:  # it does not stop those after it
            reason = f"undecided within {LONGEST:g} s"
            judged = JudgedLine(line, OpenVerdict(Verdict(Answer.UNREAD, "motion", reason)))
        yield judged
