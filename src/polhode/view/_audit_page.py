"""The report of an audit as one page: equations typeset, verdicts, corrections, evidence."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from importlib.resources import files
from pathlib import Path

from polhode.base import write_whole
from polhode.claims import (
    Answer,
    Claim,
    Correction,
    Judged,
    Note,
    Part,
    Report,
    Verdict,
    tally,
)
from polhode.view._html import Markup, document, joined, tag
from polhode.view._judgement import readings_html
from polhode.view._mathml import math_fonts, typeset, typeset_change
from polhode.view._notebook import html_of

_SHOWN = 1200  # characters of a residual or of one side of a counterexample
_WORDS = {
    Answer.HOLDS: "holds",
    Answer.AMBIGUOUS: "ambiguous",
    Answer.APPROXIMATE: "approximately",
    Answer.DEFINITION: "definition",
    Answer.FAILS: "fails",
    Answer.UNREAD: "unread",
}
_EXPLAINED = (Answer.AMBIGUOUS, Answer.UNREAD)  # answers of which the reason is the content
_SCROLLS = {"tabindex": "0"}  # by the arrow keys, where it is too wide


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
        shown.append(tag("p", f"{correction.what}; it holds as ", _formula(correction.latex)))
    notes = (_note(Note("note", detail)) for detail in thing.details)
    evidence = _evidence([*_residuals(thing), *_example(thing)])
    article = tag("article", *shown, *notes, _letters(thing), evidence, class_=thing.answer.value)
    return _framed(article)


def _framed(*inner: str) -> Markup:
    return joined([tag("style", Markup(_style())), tag("div", *inner, class_="audit")])


def _style() -> str:
    return f"{math_fonts()}\n{(files('polhode.view') / 'audit.css').read_text('utf-8')}"


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
        tag("li", _formula(d.latex), *([" ", tag("small", d.where)] if d.where else []))
        for d in part.definitions
    ]
    definitions += [tag("li", _formula(relation)) for relation in part.given]
    return tag(
        "section",
        tag("h2", part.title or part.id),
        tag("p", part.system, class_="system"),
        *(tag("p", sentence, class_="convention") for sentence in report.conventions(part)),
        tag("ul", *definitions, class_="definitions", **_SCROLLS) if definitions else "",
        *map(_claim, found),
        id=part.id,
    )


def _claim(judged: Judged) -> Markup:
    claim, verdict = judged.claim, judged.verdict
    stated = tag("q", claim.words) if claim.words else _formula(claim.latex)
    printed = tag("div", stated, class_="printed", **_SCROLLS)
    number = tag("span", f"({claim.id})", class_="number")
    mended = bool(claim.read_as) and verdict.holds  # damaged, and true only as it was read
    return tag(
        "article",
        tag("div", number, printed, _badge(judged.answer, mended), class_="claim"),
        *map(_note, judged.notes),
        _letters(verdict),
        tag("p", verdict.reason, class_="reason") if judged.answer in _EXPLAINED else "",
        _correction(claim, verdict.correction),
        _evidence(_grounds(judged)),
        id=f"claim-{claim.id}",
        class_=judged.answer.value,
    )


def _note(note: Note) -> Markup:
    text = _formula(note.text) if note.is_formula else tag("span", note.text)
    return _noted(note.label, text)


def _noted(label: str, text: Markup) -> Markup:
    return tag("div", tag("span", label), text, class_="note", **_SCROLLS)


def _formula(latex: str) -> Markup:
    """LaTeX typeset, or as source text if it cannot be."""
    return (typeset(latex) or tag("code", latex)) if latex else Markup()


def _correction(claim: Claim, correction: Correction | None) -> Markup:
    if correction is None:
        return Markup()
    before, after = typeset_change(claim.formula, correction.latex)
    source = "printed" if claim.formula == claim.latex else "read"
    return tag(
        "div",
        tag("p", correction.what),
        tag("div", tag("span", source), before, class_="was", **_SCROLLS),
        tag(
            "div",
            tag("span", "holds"),
            after or _formula(correction.latex),
            class_="is",
            **_SCROLLS,
        ),
        class_="correction",
    )


def _letters(verdict: Verdict) -> Markup:
    """The meanings that letters were given; nothing if there is none to be said."""
    shown = readings_html(verdict.shown_readings)
    return _noted("letters", tag("span", shown)) if shown else shown


def _evidence(found: Iterable[Markup]) -> Markup:
    """The evidence for a verdict, folded away; nothing if there is none."""
    shown = joined(found)
    if not shown:
        return shown
    return tag("details", tag("summary", "Evidence"), tag("div", shown, **_SCROLLS))


def _grounds(judged: Judged) -> Iterator[Markup]:
    verdict = judged.verdict
    reason = "" if verdict.answer in _EXPLAINED else f" {verdict.reason}"
    yield tag("p", "Judged as: ", tag("strong", verdict.context), f".{reason}")
    for other in verdict.alternatives:
        yield tag("p", f"Or, {other.what}: ", _formula(other.latex))
    yield from _residuals(verdict)
    yield from _example(verdict)
    if judged.fed_by:
        fail = "fail" if len(judged.fed_by) > 1 else "fails"
        yield tag("p", "Derived from ", joined(map(_link, judged.fed_by), ", "), f", which {fail}.")


def _link(claim: str) -> Markup:
    return tag("a", f"({claim})", href=f"#claim-{claim}")


def _residuals(verdict: Verdict) -> Iterator[Markup]:
    if verdict.residuals:
        yield tag("p", "Left side minus right side, exactly:")
        items = []
        for residual in verdict.residuals:
            where = f", component {residual.component}" if residual.component else ""
            short = len(str(residual.expression)) < _SHOWN
            shown = _formula(residual.expression.latex()) if short else "too long to show"
            items.append(tag("li", f"member {residual.member + 1}{where}: ", shown))
        yield tag("ul", *items)


def _example(verdict: Verdict) -> Iterator[Markup]:
    if (example := verdict.counterexample) is not None:
        state = ", ".join(f"{name} = {value}" for name, value in example.values.items())
        left, right = (tag("b", str(side)[:_SHOWN]) for side in (example.left, example.right))
        yield tag("p", f"At {state} (SI): left ", left, ", right ", right, ".")
    if (second := verdict.confirmation) is not None:
        verb = "confirms" if second.agrees else "contradicts"
        yield tag(
            "p",
            "A separate numerical balance of forces and moments on every body gives "
            f"{second.left:.9g} and {second.right:.9g}, which {verb} this.",
        )


def _consequences(report: Report) -> Markup:
    rows = [tag("li", _link(c.failed), f" {c.summary}") for c in report.consequences if c.feeds]
    if not rows:
        return Markup()
    title = tag("h2", "Consequences of claims that fail")
    return tag("section", title, tag("ul", *rows), id="consequences")
