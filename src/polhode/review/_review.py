"""A derivation reviewed: read, judged line by line, and marked."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from time import perf_counter

from polhode.base import NumericError, interrupted
from polhode.claims import Answer, DocumentRead, SourceRelation, Verdict, read_documents, read_text
from polhode.claims.building_blocks import Meaning, Node, OpenVerdict
from polhode.derive import Equations, equations_only
from polhode.review._body_axes import with_doubt_about_axes
from polhode.review._cues import Role, with_cues
from polhode.review._end_of_contact import as_end_of_contact
from polhode.review._in_force import InForce, Section, Statements, with_small
from polhode.review._judged_line import JudgedLine, judged_line
from polhode.review._links import link_by_link
from polhode.review._marks import ALTOGETHER, LONGEST, marked
from polhode.review._other_forms import other_forms
from polhode.review._own_letters import with_meaning_of_words, with_named
from polhode.review._part_choices import choices_of, under_choice
from polhode.review._references import References
from polhode.review._reviewed import Review, ReviewedLine
from polhode.review._slashes import in_one_way
from polhode.review._stability import as_threshold
from polhode.review._stated import stated_by, with_start
from polhode.review._states_in_words import in_state_of_words
from polhode.review._text_line import TextLine, unmentioned_speeds
from polhode.review._units_in_words import with_unit_behind

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
    read: dict[Path, Collection[str]] = {}
    for document in documents:
        if document.is_damaged:
            raise document.refused[0]
        notes += map(str, document.refused)
        read[document.path] = document.texts.keys()
        references = References.of(document.relations, document.texts)
        judged = list(_in_part_readings(document.relations, equations, references))
        for line in marked(judged, equations, len(lines), seconds):
            tell(line)
            lines.append(line)
        texts.update(document.texts)
    found_in = {line.file for line in lines}
    silent = [path for path, names in read.items() if found_in and found_in.isdisjoint(names)]
    notes += [f"no relation was found in {path}" for path in silent]
    took = perf_counter() - began
    return Review(equations.system.name, files, tuple(lines), took, tuple(notes), texts)


def _in_part_readings(
    relations: Sequence[SourceRelation], equations: Equations, references: References
) -> Iterator[JudgedLine | SourceRelation]:
    """The relations judged, letters of several meanings read in one way throughout a part."""
    first = list(_with_letters_of(list(_judged(relations, equations, references)), equations))
    lines = [entry for entry in first if isinstance(entry, JudgedLine)]
    chosen = choices_of(lines)
    for entry in first:
        if isinstance(entry, JudgedLine) and entry.line.section in chosen:
            with suppress(NumericError), interrupted(LONGEST, advice="judge the line by itself"):
                entry = under_choice(entry, chosen[entry.line.section], equations)
        if isinstance(entry, JudgedLine):
            entry = with_doubt_about_axes(entry, equations)
        yield entry


def _with_letters_of(
    entries: Sequence[JudgedLine | SourceRelation], equations: Equations
) -> Iterator[JudgedLine | SourceRelation]:
    """The entries, lines judged again with letters that their paragraph defines behind them.

    A text may say v = ω × a, "where a = ...".
    """
    for place, entry in enumerate(entries):
        if isinstance(entry, JudgedLine) and not entry.verdict.holds:
            stated = _stated_behind(entry.line, entries[place + 1 :])
            if stated != entry.line.in_force:
                with suppress(NumericError), interrupted(LONGEST, advice="judge it by itself"):
                    found = judged_line(replace(entry.line, in_force=stated), equations, {})
                    is_judged = found.verdict.answer in (Answer.HOLDS, Answer.FAILS)
                    entry = found if is_judged else entry
        yield entry


def _with_letters(
    judged: JudgedLine,
    lines: Sequence[TextLine],
    letters: Mapping[Node, Meaning],
    equations: Equations,
) -> JudgedLine:
    """A line that is unread for want of a letter, judged with that of a part before it."""
    if judged.verdict.answer is not Answer.UNREAD:
        return judged
    used = {letter for line in lines for letter in line.letters}
    new = {n: m for n, m in letters.items() if n in used - lines[0].in_force.defined.keys()}
    if not new:
        return judged
    known = [replace(line, in_force=line.in_force.defining(new)) for line in lines]
    found = in_one_way(known, equations)
    return judged if found.verdict.answer is Answer.UNREAD else found


def _stated_behind(line: TextLine, behind: Iterable[JudgedLine | SourceRelation]) -> InForce:
    """What stands for a line with those of its letters that its paragraph defines behind it."""
    stated = line.in_force
    for other in behind:
        if isinstance(other, JudgedLine):
            if other.line.relation.latex not in line.relation.after:
                break
            said = other.line.cues
            is_where = said.role is Role.DEFINITION and not said.introduces
            if is_where and not other.defines.keys().isdisjoint(line.letters):
                stated = stated.defining(other.defines)
    return stated


def _without_meaning(relation: SourceRelation) -> SourceRelation:
    """A relation with a macro that no file defines: its structure was read, but it claims nothing.

    Nobody knows what such a macro prints.
    """
    macro = relation.undefined[0]
    why = f"{macro}, which is defined nowhere; expected the document that defines it"
    return replace(relation, relation=None, printed="", why=relation.why or why, ways=())


def _judged(
    relations: Sequence[SourceRelation], equations: Equations, references: References
) -> Iterator[JudgedLine | SourceRelation]:
    """The relations judged in order; one that is unread or out of scope is left as it is."""
    section, statements = Section(), Statements()
    statements.state(section, InForce(dict(other_forms(relations, equations))))
    tacit = unmentioned_speeds(relations, equations)
    earlier: frozenset[Node] = frozenset()
    for place, (relation, found) in enumerate(with_cues(relations)):
        section = section.at(relation, found)
        ways = relation.ways or (with_unit_behind(relation),) * (relation.relation is not None)
        if relation.undefined:
            yield _without_meaning(relation)
            continue
        if not ways or not relation.in_scope:
            yield relation
            continue
        stated = with_named(statements.at(section), found, equations).in_sentence(found.sentence)
        stated = with_small(stated, found.small_here, equations).to_order(found.order)
        stated = with_start(stated, found, equations)
        cited = references.cited(found, place)
        said = f"read as {ways[0].printed}" if ways[0] not in (relation, *relation.ways) else ""
        lines = [TextLine(way, found, section, stated, tacit, earlier, cited, said) for way in ways]
        line = lines[0]
        near = stated.near_motion({*line.letters})
        lines = [replace(line, in_force=near) for line in lines]
        earlier = earlier.union(line.letters)
        try:
            with interrupted(LONGEST, advice="judge the line by itself"):
                found_here = in_one_way(lines, equations)
                judged = _with_letters(found_here, lines, statements.letters, equations)
                judged = as_threshold(judged, equations)
                judged = as_end_of_contact(judged, equations)
                judged = link_by_link(judged, equations)
                before = statements.own(section).defined
                judged, own = stated_by(judged, statements.own(section), equations)
                new = {name: v for name, v in own.defined.items() if before.get(name) != v}
                judged = replace(in_state_of_words(judged, equations), defines=new)
            own = with_named(with_start(own, found, equations), found, equations)
            own = with_meaning_of_words(own, judged)
            statements.state(section, own)
        except NumericError as error:  # it does not stop those after it
            judged = JudgedLine(line, OpenVerdict(Verdict.unread("motion", error)))
        yield judged
