"""The claims of the problem set: judged in a worker process, and shown on the pages."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import dataclass
from functools import cache, partial
from itertools import chain, groupby

import polhode as ph
from polhode.base import NumericError, Tell, Worker, WorkerEndedError
from polhode.catalogue import PROBLEM_SET
from polhode.derive import Equations
from polhode.judge import Note, Read, document_of, judgement_on, readings_html, report_on
from polhode.solution import Remark, remarks_on
from polhode.view import Judgement, Markup, tag, typeset, words_with_published

_KINDS = {"holds": "good", "fails": "bad"}
_WORDS = {
    "holds": "holds",
    "ambiguous": "ambiguous",
    "approximate": "approximately",
    "definition": "definition",
    "fails": "fails",
    "unread": "not read",
}
_COUNTED = {
    "holds": ("holds", "hold"),
    "ambiguous": ("is ambiguous", "are ambiguous"),
    "approximate": ("holds approximately", "hold approximately"),
    "definition": ("defines", "define"),
    "fails": ("fails as printed", "fail as printed"),
    "unread": ("could not be read", "could not be read"),
}


@dataclass(frozen=True)
class JudgedClaim:
    """A claim and its verdict, as text.

    Attributes:
        id: in the document of claims, such as "12".
        system: name in the catalogue.
        stated: LaTeX as the text prints it, or words.
        is_formula: whether it is LaTeX.
        answer: holds, approximate, definition, fails or unread.
        reason: in words.
        correction: LaTeX of the least change that makes it hold; empty for none.
        judgement: the same for a page in three dimensions.
        notes: how it was read, beyond what the text prints.
        readings: the meanings that letters were given.
        part: heading of the part of the text that contains it.
        convention: of axes, angles and letters in that part, in words.
        remark: on it, for the solution.
    """

    id: str
    system: str
    stated: str
    is_formula: bool
    answer: str
    reason: str
    correction: str
    judgement: Judgement
    notes: tuple[Note, ...] = ()
    readings: tuple[Read, ...] = ()
    part: str = ""
    convention: str = ""
    remark: Remark | None = None

    @property
    def verdict(self) -> str:
        """In words; a formula that was damaged holds only as it was read."""
        is_mended = self.is_formula and any(note.label == "read as" for note in self.notes)
        return f"{_WORDS[self.answer]}{' as read' if is_mended and self.holds else ''}"

    @property
    def holds(self) -> bool:
        """Whether it is true, exactly or approximately."""
        return self.answer in ("holds", "approximate")

    @property
    def place(self) -> tuple[str, str]:
        """The part of the text that contains it, and the convention there."""
        return self.part, self.convention

    @property
    def problem(self) -> str:
        """The problem it belongs to."""
        return self.system.partition("/")[0]


@contextmanager
def judging(only: Iterable[str]) -> Iterator[Callable[[], tuple[JudgedClaim, ...]]]:
    """A function that returns the verdicts on claims with some ids, or on all of them.

    A worker process judges them while this block runs; the function waits for it to finish.

    Raises:
        NumericError: if that process ends without a result.
    """
    with closing(Worker[None, tuple[JudgedClaim, ...]](partial(_judging, tuple(only)))) as worker:

        def verdicts() -> tuple[JudgedClaim, ...]:
            try:
                return worker.ask(None)
            except WorkerEndedError:
                raise NumericError(
                    "a worker process that ended while judging claims",
                    expected="enough memory for it",
                    advice="judge fewer of them with only",
                ) from None

        yield verdicts


def _judging(
    only: tuple[str, ...],
) -> Callable[[None, Tell[tuple[JudgedClaim, ...]]], tuple[JudgedClaim, ...]]:
    """In the worker: judges on starting, so that the verdicts are ready when asked for."""
    verdicts = judged(only)
    return lambda question, tell: verdicts


def judged(only: tuple[str, ...]) -> tuple[JudgedClaim, ...]:
    """Judge the claims of the problem set with these ids, or all of them; part by part."""
    document = document_of(None)

    @cache
    def equations_of(name: str) -> Equations:
        return ph.derive(PROBLEM_SET[name].build())

    report = report_on(document, equations_of, only=only)
    remarks = remarks_on(document, report, equations_of)
    return tuple(
        JudgedClaim(
            id=found.claim.id,
            system=found.system,
            stated=found.claim.printed,
            is_formula=bool(found.claim.latex),
            answer=found.verdict.answer.value,
            reason=found.verdict.reason,
            correction=found.verdict.correction.latex if found.verdict.correction else "",
            judgement=judgement_on(found),
            notes=found.notes,
            readings=found.verdict.shown_readings,
            part=part.title or part.id,
            convention=found.convention,
            remark=remarks[found.claim.id],
        )
        for part, claims in report.by_part()
        for found in claims
    )


# --- on the pages ---


def verdicts(claims: Sequence[JudgedClaim]) -> Markup:
    """All claims about a problem with their verdicts, folded; nothing if there are none."""
    if not claims:
        return Markup()
    return tag(
        "details",
        tag("summary", "What the text claims: ", counted(claims)),
        tag("p", "Each was judged against the equations derived here."),
        *chain.from_iterable(_part(found) for _, found in groupby(claims, lambda c: c.place)),
        id="claims",
        class_="folded",
    )


def _part(claims: Iterable[JudgedClaim]) -> Iterator[Markup]:
    """The claims of a part of the text under its heading and its convention."""
    first, *others = claims
    if first.part:
        yield tag("h3", first.part)
    if first.convention:
        yield tag("p", *_lowered(first.convention), class_="convention")
    for claim in (first, *others):
        yield tag(
            "article",
            tag("span", f"({claim.id})" if claim.id.isdigit() else claim.id, class_="id"),
            tag("span", claim.verdict, class_=_KINDS.get(claim.answer, "so-so")),
            tag("div", *_said(claim), class_="said"),
            class_="claim",
        )


def _lowered(words: str) -> Iterator[str]:
    """Words with subscripts, which follow an underscore, as in ω_3, I_1ω_1 and ω_(1,2,3)."""
    for i, piece in enumerate(re.split(r"_(\d+|[^\W\d_]+|\([^()]*\))", words)):
        yield tag("sub", piece) if i % 2 else piece


def _said(claim: JudgedClaim) -> Iterator[Markup]:
    """A claim, how it was read, and what holds in its place."""
    if claim.is_formula:
        yield tag("div", formula(claim.stated), class_="stated", tabindex="0")
    else:
        yield tag("div", *_lowered(claim.stated))
    for note in claim.notes:
        text = (
            formula(note.text) if note.is_formula else tag("span", words_with_published(note.text))
        )
        yield _noted(note.label, text)
    if claim.readings:
        yield _noted("letters", tag("span", readings_html(claim.readings)))
    if claim.correction:
        correction = formula(claim.correction)
        yield tag("div", "should read ", correction, class_="should", tabindex="0")
    if claim.answer != "holds" and claim.reason:
        yield tag("p", words_with_published(claim.reason), class_="reason")


def _noted(label: str, text: Markup) -> Markup:
    return tag("div", tag("span", label, class_="label"), " ", text, class_="note", tabindex="0")


def formula(latex: str) -> Markup:
    """LaTeX as MathML; as source text if it cannot be read."""
    return typeset(latex) or tag("code", latex)


def counted(claims: Iterable[JudgedClaim]) -> str:
    """How many got each verdict, in words."""
    found = Counter(claim.answer for claim in claims)
    parts = [
        f"{found[answer]} {one if found[answer] == 1 else many}"
        for answer, (one, many) in _COUNTED.items()
        if found[answer]
    ]
    count = found.total()
    return f"{count} claim{'' if count == 1 else 's'}: {', '.join(parts)}"
