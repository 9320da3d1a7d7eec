"""What the text claims about a problem, and the verdicts."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, groupby

from polhode.claims import Note
from polhode.tour._claims import Told
from polhode.tour._html import Markup, joined, tag
from polhode.view import typeset

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
