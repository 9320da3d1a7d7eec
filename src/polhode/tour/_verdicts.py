"""What the text claims about a problem, and the verdicts."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

from latex2mathml.converter import convert

from polhode.tour._claims import Told
from polhode.tour._html import Markup, joined, table, tag

_KINDS = {"holds": "good", "fails": "bad"}
_WORDS = {
    "holds": "holds",
    "approximate": "approximately",
    "definition": "definition",
    "fails": "fails",
    "unread": "not read",
}


def verdicts(claims: Sequence[Told]) -> Markup:
    """A table of all claims about a problem; nothing where there are none."""
    if not claims:
        return Markup()
    rows = [(_number(claim), _stated(claim), _verdict(claim)) for claim in claims]
    return tag(
        "section",
        tag("h2", "What the text claims"),
        tag("p", counted(claims), ". Each was judged against the equations derived here."),
        table(("equation", "as printed", "verdict"), rows, class_="claims"),
        id="claims",
    )


def counted(claims: Iterable[Told]) -> str:
    """How many got each verdict, in words."""
    found = Counter(claim.answer for claim in claims)
    total = sum(found.values())
    parts = [f"{found[answer]} {word}" for answer, word in _COUNTED.items() if found[answer]]
    return f"{total} claims: {', '.join(parts)}"


_COUNTED = {
    "holds": "hold",
    "approximate": "hold approximately",
    "definition": "define",
    "fails": "fail as printed",
    "unread": "could not be read",
}


def _number(claim: Told) -> str:
    return f"({claim.id})" if claim.id.isdigit() else claim.id


def _stated(claim: Told) -> Markup:
    return formula(claim.stated) if claim.is_formula else tag("span", claim.stated)


def _verdict(claim: Told) -> Markup:
    word = tag("span", _WORDS[claim.answer], class_=_KINDS.get(claim.answer, "so-so"))
    said: list[Markup] = [word]
    if claim.correction:
        said.append(tag("div", "should read ", formula(claim.correction)))
    if claim.answer != "holds" and claim.reason:
        said.append(tag("div", claim.reason, class_="reason"))
    return joined(said)


def formula(latex: str) -> Markup:
    """LaTeX as MathML; as it is where the converter cannot read it."""
    try:
        return Markup(convert(latex))
    except Exception:  # the converter documents no error of its own
        return tag("code", latex)
