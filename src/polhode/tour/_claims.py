"""The problem set's claims judged, in a process of their own beside the work on the systems."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import chain, groupby
from multiprocessing import get_context

import polhode as ph
from polhode.catalogue import CATALOGUE, document_of
from polhode.claims import Judged, Note, audit
from polhode.derive import Equations
from polhode.view import Judgement, Markup, joined, tag, typeset


@dataclass(frozen=True)
class Told:
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
        part: heading of the part of the text that it stands in.
        convention: of axes, angles and letters in that part, in words.
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
    part: str = ""
    convention: str = ""

    @property
    def place(self) -> tuple[str, str]:
        """The part of the text that it stands in, and the convention there."""
        return self.part, self.convention

    @property
    def problem(self) -> str:
        """The problem it belongs to."""
        return self.system.partition("/")[0]


@contextmanager
def judging(only: Iterable[str]) -> Iterator[Future[tuple[Told, ...]]]:
    """The verdicts to come, on claims with some ids or on all of them."""
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as workers:
        yield workers.submit(judged, tuple(only))


def judged(only: tuple[str, ...]) -> tuple[Told, ...]:
    """Judge the claims of the problem set with these ids, or all of them; part by part."""
    report = audit(document_of(None), _equations, only=only)
    return tuple(_told(judged, part.title) for part, found in report.by_part() for judged in found)


def _equations(system: str) -> Equations:
    return ph.derive(CATALOGUE[system].build())


def _told(judged: Judged, part: str) -> Told:
    claim, verdict = judged.claim, judged.verdict
    return Told(
        id=claim.id,
        system=judged.system,
        stated=claim.printed,
        is_formula=bool(claim.latex),
        answer=verdict.answer.value,
        reason=verdict.reason,
        correction=verdict.correction.latex if verdict.correction is not None else "",
        judgement=Judgement.on(judged),
        notes=(*claim.notes, *(Note("note", note) for note in verdict.notes)),
        part=part,
        convention=judged.convention,
    )


# What the text claims about a problem, and the verdicts.

_KINDS = {"holds": "good", "fails": "bad"}
_WORDS = {
    "holds": "holds",
    "ambiguous": "ambiguous",
    "approximate": "approximately",
    "definition": "definition",
    "fails": "fails",
    "unread": "not read",
}


def verdicts(claims: Sequence[Told]) -> Markup:
    """All claims about a problem with what came of them; nothing where there are none."""
    if not claims:
        return Markup()
    return tag(
        "section",
        tag("h2", "What the text claims"),
        tag("p", counted(claims), ". Each was judged against the equations derived here."),
        *chain.from_iterable(_part(found) for _, found in groupby(claims, lambda c: c.place)),
        id="claims",
    )


def _part(claims: Iterable[Told]) -> Iterator[Markup]:
    """The claims of a part of the text under its heading and its convention."""
    first, *others = claims
    if first.part:
        yield tag("h3", first.part)
    if first.convention:
        yield tag("p", first.convention, class_="convention")
    yield from map(_claim, [first, *others])


def counted(claims: Iterable[Told]) -> str:
    """How many got each verdict, in words."""
    found = Counter(claim.answer for claim in claims)
    total = sum(found.values())
    parts = [
        f"{found[answer]} {one if found[answer] == 1 else many}"
        for answer, (one, many) in _COUNTED.items()
        if found[answer]
    ]
    return f"{total} claims: {', '.join(parts)}"


_COUNTED = {
    "holds": ("holds", "hold"),
    "approximate": ("holds approximately", "hold approximately"),
    "definition": ("defines", "define"),
    "fails": ("fails as printed", "fail as printed"),
    "unread": ("could not be read", "could not be read"),
}


def _claim(claim: Told) -> Markup:
    said = list(map(_note, claim.notes))
    if claim.correction:
        said.append(
            tag("div", "should read ", formula(claim.correction), class_="should", tabindex="0")
        )
    if claim.answer != "holds" and claim.reason:
        said.append(tag("p", claim.reason, class_="reason"))
    return tag(
        "article",
        tag("span", _number(claim), class_="id"),
        tag("span", _WORDS[claim.answer], class_=_KINDS.get(claim.answer, "so-so")),
        tag("div", _stated(claim), *said, class_="said"),
        class_="claim",
    )


def _note(note: Note) -> Markup:
    text = formula(note.text) if note.is_formula else tag("span", note.text)
    label = tag("span", note.label, class_="label")
    return tag("div", label, " ", text, class_="note", tabindex="0")


def _number(claim: Told) -> str:
    return f"({claim.id})" if claim.id.isdigit() else claim.id


def _stated(claim: Told) -> Markup:
    if claim.is_formula:
        return tag("div", formula(claim.stated), class_="stated", tabindex="0")
    return tag("div", _words(claim.stated))


def _words(text: str) -> Markup:
    """Words with what stands behind an underscore lowered, as in ω_3 and ω_(1,2,3)."""
    pieces = re.split(r"_(\w+|\([^()]*\))", text)
    return joined(tag("sub", piece) if i % 2 else piece for i, piece in enumerate(pieces))


def formula(latex: str) -> Markup:
    """LaTeX as MathML; as it is where it cannot be read."""
    found = typeset(latex)
    return Markup(found) if found else tag("code", latex)
