"""A report for referees: what was read, what holds under which assumptions, what survives."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path, PurePath

from polhode.base import digest, provenance, write_whole
from polhode.derive import Equations
from polhode.judge._reviewed import Mark, Review, ReviewedLine
from polhode.judge.output._page import (
    PageParts,
    counts_html,
    final_html,
    link,
    page_style,
    relation_html,
    typesettables,
)
from polhode.judge.text._words import without_marks
from polhode.model import write_declaration
from polhode.view import Markup, document, joined, table, tag

#: What a relation that holds in a context holds for.
_CONTEXTS = {
    "identity": "For every state that the constraints allow",
    "motion": "On every true motion",
    "steady": "In steady motion",
    "threshold": "As a condition",
    "limit": "To the order stated",
    "launch": "From the start stated",
    "number": "To the digits printed",
}
_METHOD = (
    "Each relation was bound to the model that is declared for the system, and judged by exact "
    "arithmetic: as an identity of the states that the constraints allow, or with the equations of "
    "motion that were derived from the declaration. A relation that does not hold is refuted by a "
    "state, and where it could be by a separate numerical balance of forces and moments too. The "
    "report says nothing about words, figures, and relations listed as not judged."
)


def referee_report(review: Review, equations: Equations, path: str | Path) -> None:
    """Write a report on a text that its author can attach to a submission: one page, no script.

    Args:
        review: of the text, with all that was found.
        equations: of the system.
        path: of the file to write.

    Raises:
        StoreError: where it cannot be written.
    """
    write_whole(Path(path), referee_html(review, equations).encode("utf-8"))


def referee_html(review: Review, equations: Equations) -> str:
    """The text of the page that `referee_report` writes; arguments as there."""
    parts = PageParts(review)
    shown = _Shown(parts)
    names = ", ".join(PurePath(name).name for name in review.files if name) or "a text"
    title = without_marks(f"Report on {names}")
    header = tag("header", tag("h1", title), *_read(review, equations))
    sections = (
        _results(review),
        _holding(review, shown),
        _section("Does not hold", _failing(review, shown)),
        _section(
            "Doubtful",
            map(shown, _marked(review, Mark.DOUBT)),
            "These do not hold as they were read, but nothing proves that they are slips.",
        ),
        _section(
            "True, but not derived here",
            map(shown, _marked(review, Mark.UNLINKED)),
            "These hold on the model. They are drawn from a line that does not.",
        ),
        _section(
            "Holds under a condition that is not stated", map(shown, _marked(review, Mark.NEEDS))
        ),
        _section("Stated, not judged", map(shown, (x for x in review.lines if x.is_stated))),
        _section("Not judged", map(shown, filter(_is_unread, review.lines))),
        _section("How it was judged", _certainty(review)),
    )
    return document(title, page_style(), header, tag("main", *sections), class_="review")


class _Shown:
    """Shows lines, each in the formula of the text that it stands in."""

    def __init__(self, parts: PageParts) -> None:
        self._parts = parts
        self._formulas = typesettables(parts.review)

    def __call__(self, line: ReviewedLine) -> Markup:
        return relation_html(line, self._formulas[self._parts.number(line)], self._parts)


def _section(title: str, content: Iterable[Markup], words: str = "") -> Markup:
    """A section, where it has content."""
    inner = list(content)
    if not inner:
        return Markup()
    return tag("section", tag("h2", title), *([tag("p", words)] if words else []), *inner)


def _marked(review: Review, mark: Mark) -> list[ReviewedLine]:
    return [line for line in review.lines if line.mark is mark]


def _is_unread(line: ReviewedLine) -> bool:
    return line.mark is Mark.NOT_JUDGED and not line.is_stated


# -- what was read, and what comes of it -----------------------------------------------------------


def _read(review: Review, equations: Equations) -> Iterator[Markup]:
    """The text and the model that the report is about, each told by its digest."""
    judged = sum(line.mark is not Mark.NOT_JUDGED for line in review.lines)
    stated = sum(line.is_stated for line in review.lines)
    total = len(review.lines)
    unread = total - judged - stated
    yield tag(
        "p",
        f"{total} relation{'s' * (total != 1)} read: {judged} judged, {stated} stated by the text "
        f"itself, {unread} could not be judged.",
    )
    yield counts_html(review)
    rows = [(without_marks(name), _short(text)) for name, text in sorted(review.texts.items())]
    rows.append((f"model: {review.system}", _short(write_declaration(equations.system))))
    yield table(("", "SHA-256 begins"), rows, caption="This report is about")
    for note in review.notes:
        yield tag("p", without_marks(note), class_="note")


def _short(text: str) -> Markup:
    return tag("code", digest(text.encode("utf-8", "replace").decode("utf-8"))[:16])


def _results(review: Review) -> Markup:
    """Which results survive the errors: displays and final answers, or else every relation."""
    every = [line for line in review.lines if line.mark is not Mark.NOT_JUDGED]
    judged = [line for line in every if line.is_display or line.is_final] or every
    if not judged:
        return Markup()
    survive = [line for line in judged if line.mark in (Mark.TRUE, Mark.UNLINKED)]
    fall = [line for line in judged if line.is_wrong]
    told = [f"{len(survive)} of {len(judged)} results hold on the model."]
    content = [tag("p", *told)]
    for error in review.errors:
        taken = [line for line in fall if line.of == review.lines.index(error)]
        words: list[str] = ["The error in ", link(review, error)]
        if taken:
            words += [" takes with it ", joined((link(review, line) for line in taken), ", ")]
        else:
            words += [" takes no other result with it"]
        content.append(tag("p", *words, "."))
    content += final_html(review)
    return _section("Which results survive", content)


def _holding(review: Review, shown: _Shown) -> Markup:
    """What holds, by the context in which it does."""
    content: list[Markup] = []
    true = _marked(review, Mark.TRUE)
    for context in dict.fromkeys([*_CONTEXTS, *(line.context for line in true)]):
        lines = [line for line in true if line.context == context]
        if lines:
            content += [tag("h3", _CONTEXTS.get(context, context)), *map(shown, lines)]
    return _section("Holds", content)


def _failing(review: Review, shown: _Shown) -> Iterator[Markup]:
    """Every error, each with the lines that it takes with it."""
    for number, line in enumerate(review.lines):
        if line.mark is Mark.ERROR:
            yield shown(line)
            yield from (shown(x) for x in review.lines if x.mark is Mark.FOLLOWS and x.of == number)
    yield from (shown(x) for x in review.lines if x.mark is Mark.FOLLOWS and x.of is None)


def _certainty(review: Review) -> Sequence[Markup]:
    bounds = [v.error_bound for line in review.lines if (v := line.verdict) and v.error_bound]
    content = [tag("p", _METHOD)]
    if bounds:
        text = (
            f"Decided by exact evaluation at random points: {len(bounds)}. The probability that "
            f"any of these was accepted though false is below {sum(bounds):.0e}."
        )
        content.append(tag("p", text))
    versions = provenance()["versions"]
    rows = [(name, version) for name, version in versions.items() if version]
    content.append(table(("", "version"), rows, caption="Made with"))
    return content
