"""The report of an audit as one page: equations typeset, verdicts, corrections, evidence."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from importlib.resources import files
from pathlib import Path

from polhode.base import write_whole
from polhode.judge._verdict import Answer, Verdict
from polhode.judge.document._document import Note, Part
from polhode.judge.document._report import Judged, Report, tally
from polhode.judge.output._evidence_html import (
    SCROLLS,
    correction_html,
    example_html,
    formula_html,
    readings_html,
    residuals_html,
)
from polhode.view import Markup, document, html_of, joined, styled, tag

_WORDS = {
    Answer.HOLDS: "holds",
    Answer.AMBIGUOUS: "ambiguous",
    Answer.APPROXIMATE: "approximately",
    Answer.DEFINITION: "definition",
    Answer.FAILS: "fails",
    Answer.UNREAD: "unread",
}
_EXPLAINED = (Answer.AMBIGUOUS, Answer.UNREAD)  # answers of which the reason is the content


def audit_page(report: Report, path: str | Path) -> None:
    """Write a report as a self-contained page: one file without scripts or external resources.

    Args:
        report: of an audit.
        path: of the file to write.

    Raises:
        StoreError: where it cannot be written.
    """
    title = f"{report.document.title}: an audit"
    page = document(title, _style(), *_body(report), class_="audit")
    write_whole(Path(path), page.encode("utf-8"))


@html_of.register
def audit_html(report: Report) -> Markup:
    """The report as HTML for a notebook."""
    return _framed(*_body(report))


@html_of.register
def _(thing: Verdict) -> str:
    correction = thing.correction
    shown = [tag("p", _badge(thing.answer), f" {thing.reason}")]
    if correction is not None:
        shown.append(tag("p", f"{correction.what}; it holds as ", formula_html(correction.latex)))
    notes = (_note(Note("note", detail)) for detail in thing.details)
    evidence = _evidence([*residuals_html(thing), *example_html(thing)])
    article = tag("article", *shown, *notes, _letters(thing), evidence, class_=thing.answer.value)
    return _framed(article)


def _framed(*inner: str) -> Markup:
    return joined([tag("style", Markup(_style())), tag("div", *inner, class_="audit")])


def _style() -> str:
    return styled((files("polhode.judge") / "audit.css").read_text("utf-8"), ".audit")


def _body(report: Report) -> tuple[Markup, Markup]:
    counts = [
        tag("li", _badge(answer), f" {count}")
        for answer in Answer
        if (count := report.counts[answer.value])
    ]
    parts = [
        tag(
            "li",
            tag("a", part.title or part.id, href=f"#{part.id}"),
            " ",
            tag("small", tally(found)),
        )
        for part, found in report.by_part()
    ]
    header = tag(
        "header",
        tag("h1", report.document.title),
        tag("p", report.document.source, class_="source"),
        tag("ul", *counts, class_="counts"),
        *(tag("p", sentence, class_="source") for sentence in report.certainty()),
        tag("nav", tag("ul", *parts), aria_label="Parts"),
    )
    sections = (_part(report, part, found) for part, found in report.by_part())
    return header, tag("main", *sections, _consequences(report))


def _badge(answer: Answer, mended: bool = False) -> Markup:
    words = f"{_WORDS[answer]} as read" if mended else _WORDS[answer]
    return tag("span", words, class_=f"verdict {answer.value}")


def _part(report: Report, part: Part, found: tuple[Judged, ...]) -> Markup:
    # definitions that hold for all claims of the part, with their places in the text
    definitions = [
        tag("li", formula_html(d.latex), *([" ", tag("small", d.where)] if d.where else []))
        for d in part.definitions
    ]
    definitions += [tag("li", formula_html(relation)) for relation in part.given]
    return tag(
        "section",
        tag("h2", part.title or part.id),
        tag("p", part.system, class_="system"),
        *(tag("p", sentence, class_="convention") for sentence in report.conventions(part)),
        tag("ul", *definitions, class_="definitions", **SCROLLS) if definitions else "",
        *map(_claim, found),
        id=part.id,
    )


def _claim(judged: Judged) -> Markup:
    claim, verdict = judged.claim, judged.verdict
    stated = tag("q", claim.words) if claim.words else formula_html(claim.latex)
    printed = tag("div", stated, class_="printed", **SCROLLS)
    number = tag("span", f"({claim.id})", class_="number")
    mended = bool(claim.read_as) and verdict.holds  # damaged, and true only as it was read
    return tag(
        "article",
        tag("div", number, printed, _badge(judged.answer, mended), class_="claim"),
        *map(_note, judged.notes),
        _letters(verdict),
        tag("p", verdict.reason, class_="reason") if judged.answer in _EXPLAINED else "",
        correction_html(
            "printed" if claim.formula == claim.latex else "read", claim.formula, verdict.correction
        ),
        _evidence(_grounds(judged)),
        id=f"claim-{claim.id}",
        class_=judged.answer.value,
    )


def _note(note: Note) -> Markup:
    text = formula_html(note.text) if note.is_formula else tag("span", note.text)
    return _noted(note.label, text)


def _noted(label: str, text: Markup) -> Markup:
    return tag("div", tag("span", label), text, class_="note", **SCROLLS)


def _letters(verdict: Verdict) -> Markup:
    """The meanings that letters were given; nothing if there is none to be said."""
    shown = readings_html(verdict.shown_readings)
    return _noted("letters", tag("span", shown)) if shown else shown


def _evidence(found: Iterable[Markup]) -> Markup:
    """The evidence for a verdict, folded away; nothing if there is none."""
    shown = joined(found)
    if not shown:
        return shown
    return tag("details", tag("summary", "Evidence"), tag("div", shown, **SCROLLS))


def _grounds(judged: Judged) -> Iterator[Markup]:
    verdict = judged.verdict
    reason = "" if verdict.answer in _EXPLAINED else f" {verdict.reason}"
    yield tag("p", "Judged as: ", tag("strong", verdict.context), f".{reason}")
    for other in verdict.alternatives:
        yield tag("p", f"Or, {other.what}: ", formula_html(other.latex))
    yield from residuals_html(verdict)
    yield from example_html(verdict)
    if judged.fed_by:
        fail = "fail" if len(judged.fed_by) > 1 else "fails"
        yield tag("p", "Derived from ", joined(map(_link, judged.fed_by), ", "), f", which {fail}.")


def _link(claim: str) -> Markup:
    return tag("a", f"({claim})", href=f"#claim-{claim}")


def _consequences(report: Report) -> Markup:
    rows = [tag("li", _link(c.failed), f" {c.summary}") for c in report.consequences if c.feeds]
    if not rows:
        return Markup()
    title = tag("h2", "Consequences of claims that fail")
    return tag("section", title, tag("ul", *rows), id="consequences")
