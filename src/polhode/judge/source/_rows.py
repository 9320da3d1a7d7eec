"""A display cut into its relations, each with the words and rows that belong to it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.source._placed import PlacedText
from polhode.judge.source._signs import ENDS_OPEN, JOINING, PIECE, is_relation, signs

_LAYOUTS = "|".join(sorted(lexicon.LAYOUTS | {"subequations", "dmath", "IEEEeqnarray"}))
_LAYOUT = re.compile(
    rf"\\(?:begin|end)\s*\{{\s*(?:{_LAYOUTS})\*?\s*\}}(?:\s*\[[tbc]\]|\s*\{{(?:[0-9]+|[lcrLCR]+)\}})?"
)


def without_layout(display: PlacedText) -> PlacedText:
    r"""With blanks for ``\begin{aligned}`` and the like, which only lay rows out."""
    return display.masked(_LAYOUT)


_WORDS_ALONE = re.compile(
    r"(?:[\s&,.;:]|\\[,;:!\s]|\\q?quad(?![A-Za-z])|\\(?:text\w*|mbox|mathrm)\s*\{[^{}$]*\})*\Z"
)
#: What stands before a relation that is drawn from words, as in ``$\\Rightarrow v = 0$``.
_ARROW = re.compile(r"(?:\\(?:Rightarrow|Longrightarrow|implies)(?![A-Za-z])|⇒|\s)+")
_MEMBER = re.compile(r"\\in(?![A-Za-z])")


def relations(display: PlacedText) -> list[PlacedText]:
    """The rows of a display; one without a relation continues the one before it."""
    found: list[PlacedText] = []
    for row in _cut(display, "row"):
        if _WORDS_ALONE.match(row.text):
            continue
        continues = found and (
            not is_relation(row.text)
            or JOINING.match(row.text)
            or ENDS_OPEN.search(found[-1].text)
            or not is_relation(found[-1].text)
            or not is_balanced(found[-1].text)
        )
        if continues:
            found[-1] = _spanning(found[-1], row)
        else:
            found.append(row)
    return [row for row in found if row.text.strip()]


def without_membership(relation: PlacedText) -> PlacedText | None:
    r"""A relation without the set of its values, ``\in \mathbb{R}^3``, that stands behind it."""
    match = _MEMBER.search(relation.text)
    before = relation[: match.start()] if match else None
    return before if before is not None and is_relation(before.text) else None


def parts(row: PlacedText) -> list[PlacedText]:
    r"""What wide spaces, ``\quad`` and the like, separate in a row, if each is a relation."""
    return [part for part in _cut(row, "gap") if part.text.strip(" \t\n&,.;")]


def is_fragment(text: str) -> bool:
    """Whether a side of the relation is missing, as in "a force ``$> 0$``"."""
    bare = text.strip().strip("$.,;&~ \n")
    arrow = _ARROW.match(bare)
    bare = bare[arrow.end() :] if arrow else bare
    places = list(signs(bare))
    return not places or places[0] == 0 or places[-1] >= len(bare) - 1


def is_balanced(text: str) -> bool:
    r"""Whether as many ``\left`` as ``\right`` stand in it."""
    return len(re.findall(r"\\left(?![A-Za-z])", text)) == len(
        re.findall(r"\\right(?![A-Za-z])", text)
    )


def _spanning(first: PlacedText, last: PlacedText) -> PlacedText:
    return PlacedText.joined([first, PlacedText.at(r" \\ ", first.end, first.end), last])


def _cut(text: PlacedText, kind: str) -> Iterator[PlacedText]:
    """The pieces between breaks that stand in no braces and in no environment."""
    depth = start = 0
    for match in PIECE.finditer(text.text):
        depth += (match.lastgroup in ("begin", "open")) - (match.lastgroup in ("end", "close"))
        if match.lastgroup == kind and depth <= 0:
            yield text[start : match.start()]
            start = match.end()
    yield text[start:]
