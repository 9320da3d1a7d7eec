"""A derivation reviewed: read, judged line by line, and marked."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from time import perf_counter

from polhode.base import NumericError, PolhodeError, interrupted
from polhode.derive import Equations, equations_only
from polhode.judge._check import OpenVerdict
from polhode.judge._marks import ALTOGETHER, LONGEST, corrected, marked
from polhode.judge._reviewed import Review, ReviewedLine
from polhode.judge._verdict import Answer, Verdict
from polhode.judge.latex._tree import At, Node
from polhode.judge.lines._body_axes import with_doubt_about_axes
from polhode.judge.lines._conventions import in_conventions
from polhode.judge.lines._end_of_contact import as_end_of_contact
from polhode.judge.lines._hypotheses import supposed, with_what_stands
from polhode.judge.lines._judge_line import for_positive_speeds, judged_line
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.lines._lagranges_equation import as_lagranges_equation
from polhode.judge.lines._links import link_by_link
from polhode.judge.lines._other_forms import other_forms
from polhode.judge.lines._own_letters import (
    called_by_words,
    constant_named,
    with_meaning_of_words,
    with_named,
)
from polhode.judge.lines._part_choices import choices_of, in_one_sense, under_choice
from polhode.judge.lines._positions import as_coordinate_of_a_point
from polhode.judge.lines._slashes import in_one_way
from polhode.judge.lines._stability import as_threshold
from polhode.judge.lines._starts import with_start
from polhode.judge.lines._stated import stated_by
from polhode.judge.source import DocumentRead, SourceRelation, read_documents, read_text
from polhode.judge.text._cues import Role, takes_axis_along_momentum, with_cues
from polhode.judge.text._in_force import InForce, Section, Statements, kept_by_words, with_small
from polhode.judge.text._references import References
from polhode.judge.text._text_line import TextLine, unmentioned_speeds
from polhode.judge.text._units_in_words import with_unit_behind

Tell = Callable[[ReviewedLine], object]

_CORRECTION = 2.0  # s in which one is sought of what may be another meaning of a letter


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
        whole = InForce(
            dict(other_forms(document.relations, equations)),
            is_along_momentum=any(map(takes_axis_along_momentum, document.texts.values())),
        )
        parts = _in_part_readings(document.relations, equations, references, whole)
        for line in marked(parts, equations, len(lines), seconds):
            tell(line)
            lines.append(line)
        texts.update(document.texts)
    found_in = {line.file for line in lines}
    silent = [path for path, names in read.items() if found_in and found_in.isdisjoint(names)]
    notes += [f"no relation was found in {path}" for path in silent]
    took = perf_counter() - began
    return Review(equations.system.name, files, tuple(lines), took, tuple(notes), texts)


def _in_part_readings(
    relations: Sequence[SourceRelation],
    equations: Equations,
    references: References,
    whole: InForce,
) -> Iterator[list[JudgedLine | SourceRelation]]:
    """The parts of a text judged, letters of several meanings read in one way throughout each."""
    for part in _parts(_judged(relations, equations, references, whole)):
        read = list[JudgedLine | SourceRelation]()
        entries = list(_with_letters_of(part, equations))
        lines = [entry for entry in entries if isinstance(entry, JudgedLine)]
        chosen = choices_of(lines)
        for entry in entries:
            if isinstance(entry, JudgedLine) and entry.line.section.whole in chosen:
                choice = chosen[entry.line.section.whole]
                with (
                    suppress(NumericError),
                    interrupted(LONGEST, advice="judge the line by itself"),
                ):
                    entry = under_choice(entry, choice, equations)
            if isinstance(entry, JudgedLine):
                entry = with_doubt_about_axes(entry, equations)
            read.append(entry)
        read = _in_conventions(read, equations)
        yield [_supposed(entry, read, equations) for entry in read]


def _in_conventions(
    part: Sequence[JudgedLine | SourceRelation], equations: Equations
) -> list[JudgedLine | SourceRelation]:
    """A part with those lines true that hold as the text counts its coordinates."""
    places = [i for i, entry in enumerate(part) if isinstance(entry, JudgedLine)]
    lines = [entry for entry in part if isinstance(entry, JudgedLine)]
    found = list(part)
    with suppress(NumericError), interrupted(LONGEST, advice="review a part of the text"):
        for place, line in in_conventions(lines, equations).items():
            found[places[place]] = line
        for place, line in in_one_sense(lines, equations).items():
            found[places[place]] = line
    return found


def _supposed(
    entry: JudgedLine | SourceRelation,
    part: Sequence[JudgedLine | SourceRelation],
    equations: Equations,
) -> JudgedLine | SourceRelation:
    """A line that fails, as it holds under a natural hypothesis; others as they are."""
    if not isinstance(entry, JudgedLine) or entry.stated:
        return entry
    relation = entry.line.relation
    near = [
        other
        for other in part
        if isinstance(other, JudgedLine)
        and (
            other.line.relation.latex in relation.before
            or other.line.relation.latex in relation.after
        )
    ]
    if entry.needs:
        return with_what_stands(entry, near)
    if entry.verdict.answer is not Answer.FAILS:
        return entry
    try:
        with interrupted(LONGEST, advice="judge the line by itself"):
            return supposed(entry, near, equations) or entry
    except (PolhodeError, ArithmeticError):
        return entry


def _parts(
    entries: Iterable[JudgedLine | SourceRelation],
) -> Iterator[list[JudgedLine | SourceRelation]]:
    """The entries part by part, so that what is known of one is told before the next is judged."""
    part = list[JudgedLine | SourceRelation]()
    section = Section()
    for entry in entries:
        here = entry.line.section.whole if isinstance(entry, JudgedLine) else section
        if part and here != section:
            yield part
            part = []
        section = here
        part.append(entry)
    if part:
        yield part


def _with_letters_of(
    entries: Sequence[JudgedLine | SourceRelation], equations: Equations
) -> Iterator[JudgedLine | SourceRelation]:
    """The entries, lines judged again with letters that their paragraph defines behind them.

    A text may say v = ω × a, "where a = ...".
    """
    for place, entry in enumerate(entries):
        if isinstance(entry, JudgedLine) and not entry.verdict.holds:
            lacks_letter = entry.verdict.answer is Answer.UNREAD
            stated = _stated_behind(entry.line, entries[place + 1 :], lacks_letter)
            if stated != entry.line.in_force:
                with suppress(NumericError), interrupted(LONGEST, advice="judge it by itself"):
                    found = judged_line(replace(entry.line, in_force=stated), equations, {})
                    is_judged = found.verdict.answer in (Answer.HOLDS, Answer.FAILS)
                    entry = found if is_judged else entry
        yield entry


def _not_claimed_again(judged: JudgedLine, statements: Statements) -> JudgedLine:
    """A line that repeats word for word what the text has stated: true by that alone.

    What repeats "S = …", by which S was defined, may be the answer that is asked for.
    """
    printed = judged.line.relation.printed
    relation = judged.line.relation.relation
    gives_letter = relation is not None and relation.sides[0] in judged.defines
    if judged.stated and not gives_letter:
        repeats = "it repeats what the text has stated"
        again = f"{judged.stated} once more" if judged.defines else repeats
        statements.printed.setdefault(printed, again)
    elif judged.verdict.holds and printed in statements.printed:
        return replace(judged, stated=statements.printed[printed])
    return judged


def _with_letters(
    judged: JudgedLine, lines: Sequence[TextLine], stated: Statements, equations: Equations
) -> JudgedLine:
    """A line that is unread or open for want of a letter, judged with that of a part before it.

    So is one that fails with the usual meaning of such a letter, if it is right with that.
    """
    used = {letter for line in lines for letter in line.letters}
    here = lines[0].in_force
    if judged.verdict.answer in (Answer.UNREAD, Answer.FAILS):
        letters = {n: m for n, m in stated.letters.items() if n in used - here.defined.keys()}
        numbers = {n: of for n, of in stated.measured.items() if n in letters}
        known = here.defining(letters).measuring(numbers)
    elif judged.verdict.answer is Answer.AMBIGUOUS:
        named = {n: m for n, m in stated.called.items() if n in used - here.named.keys()}
        known = replace(here, named={**here.named, **named}) if named else here
    elif judged.verdict.answer is Answer.DEFINITION:
        return _of_letter_before(judged, lines, stated, equations)
    else:
        return judged
    if known is here:
        return judged
    if judged.verdict.answer is Answer.FAILS and not letters:
        return judged
    found = in_one_way([replace(line, in_force=known) for line in lines], equations)
    if judged.verdict.answer is Answer.FAILS:
        is_right = found.verdict.holds or found.verdict.answer is Answer.DEFINITION
        return found if is_right else judged
    return judged if found.verdict.answer in (Answer.UNREAD, Answer.AMBIGUOUS) else found


def _of_letter_before(
    judged: JudgedLine, lines: Sequence[TextLine], stated: Statements, equations: Equations
) -> JudgedLine:
    """A definition of a letter that a part before has, as a claim about what it is there.

    It is one if it is true or one change of it would be: in another part a letter may have another
    meaning.
    """
    letters = {**stated.letters, **stated.constants}
    again = letters.keys() & (judged.bound.defined.keys() if judged.bound is not None else set())
    if not again:
        return judged
    known = lines[0].in_force.defining({n: letters[n] for n in again})
    found = in_one_way([replace(line, in_force=known) for line in lines], equations)
    if found.verdict.holds:
        return found
    right = corrected(found.judgement, _CORRECTION)
    if right.correction is None:
        return judged
    return replace(found, judgement=replace(found.judgement, corrected=lambda: right))


def _stated_behind(
    line: TextLine, behind: Iterable[JudgedLine | SourceRelation], lacks_letter: bool
) -> InForce:
    """What stands for a line with those of its letters that its paragraph defines behind it.

    Behind "where"; or without that word, a function for a line that lacks one: E = T + W(θ).
    """
    stated = line.in_force
    for other in behind:
        if isinstance(other, JudgedLine):
            if other.line.relation.latex not in line.relation.after:
                break
            said = other.line.cues
            is_where = said.role is Role.DEFINITION and not said.introduces
            functions = {n.of for n in other.defines if isinstance(n, At)}
            new = {*functions, *other.defines} if is_where else functions if lacks_letter else set()
            if not new.isdisjoint(line.letters):
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
    relations: Sequence[SourceRelation],
    equations: Equations,
    references: References,
    whole: InForce,
) -> Iterator[JudgedLine | SourceRelation]:
    """The relations judged in order; one that is unread or out of scope is left as it is.

    Args:
        relations: of the document.
        equations: of the system.
        references: from lines to others.
        whole: what the document states for all of its parts.
    """
    section, statements = Section(), Statements()
    statements.state(section, whole)
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
        kept = kept_by_words(stated, found.kept, equations)
        stated = stated.under(tuple(r for condition in kept for r in condition.relations))
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
                judged = _with_letters(found_here, lines, statements, equations)
                judged = as_lagranges_equation(judged, equations)
                judged = as_threshold(judged, equations)
                judged = as_end_of_contact(judged, equations)
                judged = link_by_link(judged, equations)
                judged = as_coordinate_of_a_point(judged, equations)
                before = statements.own(section).defined
                judged, own = stated_by(judged, statements.own(section), equations)
                new = {name: v for name, v in own.defined.items() if before.get(name) != v}
                judged = replace(judged, defines=new)
                statements.constants.update(constant_named(judged, equations))
                judged = _not_claimed_again(judged, statements)
                judged = for_positive_speeds(judged, equations)
            own = with_named(with_start(own, found, equations), found, equations)
            own = with_meaning_of_words(own, judged)
            statements.called.update(called_by_words(judged))
            own = replace(own, conditions=(*own.conditions, *kept))
            statements.state(section, own)
        except (PolhodeError, ArithmeticError) as error:  # it does not stop those after it
            judged = JudgedLine(line, OpenVerdict(Verdict.unread("motion", error)))
        yield judged
