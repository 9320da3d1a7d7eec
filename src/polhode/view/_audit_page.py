"""The report of an audit as one page: equations typeset, verdicts, corrections, evidence."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from importlib.resources import files
from pathlib import Path

from polhode.base import PolhodeError, write_whole
from polhode.claims import (
    Answer,
    Claim,
    Correction,
    Judged,
    Note,
    Part,
    Report,
    Residual,
    Verdict,
    read_latex,
    tally,
    tidied,
    write_latex,
)
from polhode.view._markup import math_fonts
from polhode.view._notebook import html_of
from polhode.view._typeset import typeset, typeset_change

_SHOWN = 1200  # characters of a residual or of one side of a counterexample
_SAID = {
    Answer.HOLDS: "holds",
    Answer.AMBIGUOUS: "ambiguous",
    Answer.APPROXIMATE: "approximately",
    Answer.DEFINITION: "definition",
    Answer.FAILS: "fails",
    Answer.UNREAD: "unread",
}


def audit_page(report: Report, path: str | Path) -> None:
    """Write a report as a page that stands by itself: one file, no script, nothing fetched.

    Args:
        report: of an audit.
        path: of the file to write.

    Raises:
        StoreError: where it cannot be written.
    """
    page = _PAGE.format(title=escape(report.document.title), style=_style(), body=_body(report))
    write_whole(Path(path), page.encode("utf-8"))


def audit_html(report: Report) -> str:
    """The same as a piece of HTML, for a notebook."""
    return f"<style>{_style()}</style><div class='audit'>{_body(report)}</div>"


@html_of.register
def _(thing: Report) -> str:
    return audit_html(thing)


@html_of.register
def _(thing: Verdict) -> str:
    correction = thing.correction
    shown = f"<p>{_badge(thing.answer)} {escape(thing.reason)}</p>"
    if correction is not None:
        shown += f"<p>{escape(correction.what)}; it holds as {_formula(correction.latex)}</p>"
    shown += _remarks(thing)
    evidence = "".join((*_residuals(thing), *_example(thing)))
    if evidence:
        shown += f"<details><summary>Evidence</summary><div {_SCROLLS}>{evidence}</div></details>"
    return f"<style>{_style()}</style><div class='audit'><article>{shown}</article></div>"


def _style() -> str:
    return f"{math_fonts()}\n{(files('polhode.view') / 'audit.css').read_text('utf-8')}"


_SCROLLS = "tabindex='0'"  # by the arrow keys, where it is too wide

_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}: an audit</title>
<style>
{style}</style>
</head>
<body class="audit">
{body}
</body>
</html>
"""


def _body(report: Report) -> str:
    return "\n".join(
        [
            "<header>",
            f"<h1>{escape(report.document.title)}</h1>",
            f"<p class='source'>{escape(report.document.source)}</p>",
            f"<ul class='counts'>{''.join(_counts(report))}</ul>",
            _contents(report),
            "</header>",
            "<main>",
            *(_part(part, found) for part, found in report.by_part()),
            _consequences(report),
            "</main>",
        ]
    )


def _counts(report: Report) -> Iterator[str]:
    for answer in Answer:
        if count := report.counts[answer.value]:
            yield f"<li>{_badge(answer)} {count}</li>"


def _badge(answer: Answer) -> str:
    return f"<span class='verdict {answer.value}'>{_SAID[answer]}</span>"


def _contents(report: Report) -> str:
    links = (
        f"<li><a href='#{escape(part.id)}'>{escape(part.title)}</a> "
        f"<small>{tally(found)}</small></li>"
        for part, found in report.by_part()
    )
    return f"<nav aria-label='Parts'><ul>{''.join(links)}</ul></nav>"


def _part(part: Part, found: tuple[Judged, ...]) -> str:
    convention = f"<p class='convention'>{escape(part.convention)}</p>" if part.convention else ""
    return (
        f"<section id='{escape(part.id)}'><h2>{escape(part.title)}</h2>"
        f"<p class='system'>{escape(part.system)}</p>{convention}{_definitions(part)}"
        f"{''.join(map(_claim, found))}</section>"
    )


def _definitions(part: Part) -> str:
    """What the text defines for all claims of a part, with where it does."""
    told = [
        f"<li>{_formula(d.latex)}{f' <small>{escape(d.where)}</small>' if d.where else ''}</li>"
        for d in part.definitions
    ]
    told += [f"<li>{_formula(relation)}</li>" for relation in part.given]
    return f"<ul class='definitions' {_SCROLLS}>{''.join(told)}</ul>" if told else ""


def _claim(judged: Judged) -> str:
    evidence = "".join(_evidence(judged))
    label = escape(judged.claim.id)
    head = f"<span class='number'>({label})</span>{_statement(judged)}{_badge(judged.answer)}"
    body = (
        f"<details><summary>Evidence</summary><div {_SCROLLS}>{evidence}</div></details>"
        if evidence
        else ""
    )
    notes = "".join(map(_note, judged.claim.notes))
    shown = f"{notes}{_remarks(judged.verdict)}{_correction(judged, judged.verdict.correction)}"
    return (
        f"<article id='claim-{label}' class='{judged.answer.value}'>"
        f"<div class='claim'>{head}</div>{shown}{body}</article>"
    )


def _statement(judged: Judged) -> str:
    claim = judged.claim
    stated = f"<q>{escape(claim.words)}</q>" if claim.words else _formula(claim.latex)
    return f"<div class='printed' {_SCROLLS}>{stated}</div>"


def _note(note: Note) -> str:
    said = _formula(note.text) if note.is_formula else f"<span>{escape(note.text)}</span>"
    return f"<div class='note' {_SCROLLS}><span>{escape(note.label)}</span>{said}</div>"


def _formula(latex: str) -> str:
    """Typeset, or as it was typed where that cannot be."""
    if not latex:
        return ""
    return typeset(latex) or f"<code>{escape(latex)}</code>"


def _correction(judged: Judged, correction: Correction | None) -> str:
    if correction is None:
        return ""
    before, after = typeset_change(_as_read(judged.claim.formula), correction.latex)
    if not after:
        after = f"<code>{escape(correction.latex)}</code>"
    return (
        f"<div class='correction'><p>{escape(correction.what)}</p>"
        f"<div class='was' {_SCROLLS}><span>{_origin(judged.claim)}</span>{before}</div>"
        f"<div class='is' {_SCROLLS}><span>holds</span>{after}</div></div>"
    )


def _origin(claim: Claim) -> str:
    return "printed" if claim.formula == claim.latex else "read"


def _as_read(latex: str) -> str:
    """The formula written as corrections are written, so that only what was changed differs."""
    try:
        return write_latex(tidied(read_latex(latex)))
    except PolhodeError:
        return latex


def _evidence(judged: Judged) -> Iterator[str]:
    verdict = judged.verdict
    yield f"<p>Asked: <strong>{escape(verdict.context)}</strong>. {escape(verdict.reason)}</p>"
    for other in verdict.alternatives:
        yield f"<p>Or, {escape(other.what)}: {_formula(other.latex)}</p>"
    yield from _residuals(verdict)
    yield from _example(verdict)
    if judged.fed_by:
        links = ", ".join(f"<a href='#claim-{escape(i)}'>({escape(i)})</a>" for i in judged.fed_by)
        yield f"<p>Drawn from {links}, which {'fail' if len(judged.fed_by) > 1 else 'fails'}.</p>"


def _residuals(verdict: Verdict) -> Iterator[str]:
    if not verdict.residuals:
        return
    rows = "".join(map(_residual, verdict.residuals))
    yield f"<p>Left side less right side, exactly:</p><ul>{rows}</ul>"


def _residual(residual: Residual) -> str:
    where = f", component {escape(residual.component)}" if residual.component else ""
    short = len(str(residual.expression)) < _SHOWN
    shown = _formula(residual.expression.latex()) if short else "too long to show"
    return f"<li>member {residual.member + 1}{where}: {shown}</li>"


def _example(verdict: Verdict) -> Iterator[str]:
    if (found := verdict.counterexample) is not None:
        state = ", ".join(
            f"{escape(name)} = {escape(value)}" for name, value in found.values.items()
        )
        left, right = (escape(str(side))[:_SHOWN] for side in (found.left, found.right))
        yield f"<p>At {state} (SI): left <b>{left}</b>, right <b>{right}</b>.</p>"
    if (second := verdict.confirmation) is not None:
        said = "the same" if second.agrees else "otherwise"
        yield (
            f"<p>By numbers, from the balance of every body alone: "
            f"{second.left:.9g} and {second.right:.9g}, which says {said}.</p>"
        )


def _remarks(verdict: Verdict) -> str:
    """What else is to be known of a verdict, such as how letters were read."""
    return "".join(f"<p class='remark'>{escape(note)}</p>" for note in verdict.notes)


def _consequences(report: Report) -> str:
    drawn = [c for c in report.consequences if c.feeds]
    if not drawn:
        return ""
    rows = "".join(
        f"<li><a href='#claim-{escape(c.failed)}'>({escape(c.failed)})</a> {escape(c.summary)}</li>"
        for c in drawn
    )
    title = "<h2>What is drawn from claims that fail</h2>"
    return f"<section id='consequences'>{title}<ul>{rows}</ul></section>"
