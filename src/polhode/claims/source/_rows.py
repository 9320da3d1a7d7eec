"""A display cut into its relations, each with the words and rows that belong to it."""

from __future__ import annotations

import re
from collections.abc import Iterator

from polhode.claims.latex import _lexicon as lexicon
from polhode.claims.source._placed import PlacedText

_LAYOUTS = "|".join(sorted(lexicon.LAYOUTS | {"subequations", "dmath", "IEEEeqnarray"}))
_LAYOUT = re.compile(
    rf"\\(?:begin|end)\s*\{{\s*(?:{_LAYOUTS})\*?\s*\}}(?:\s*\[[tbc]\]|\s*\{{[0-9]+\}})?"
)
_PIECE = re.compile(
    r"""
      (?P<begin>\\begin\s*\{[^{}]*\})
    | (?P<end>\\end\s*\{[^{}]*\})
    | (?P<row>\\\\\*?(?:\s*\[[^\]\n]*\])?|\\(?:newline|cr)(?![A-Za-z]))
    | (?P<gap>\\q?quad(?![A-Za-z]))
    | (?P<words>\\(?:text|mbox|textrm|mathrm|label|operatorname|tag)\s*\{[^{}]*\})
    | (?P<macro>\\[A-Za-z]+)
    | (?P<escape>\\.)
    | (?P<open>\{)
    | (?P<close>\})
    | (?P<other>.)
    """,
    re.VERBOSE | re.DOTALL,
)
_SIGNS = (lexicon.SIGNS.keys() | {"triangleq", "coloneqq", "eqqcolon", "Rightarrow"}) - {
    "to", "rightarrow", "longrightarrow", "leftrightarrow",
}  # fmt: skip
_CHARACTERS = frozenset("=<>") | (lexicon.SIGN_CHARACTERS.keys() - {"→", "↔"})
_JOINING = re.compile(
    r"(?:[\s&,;:!{}]|\\[,;:!>\s]|\\(?:q?quad|nonumber|notag|hspace\*?\{[^{}]*\}|phantom\{[^{}]*\}"
    r"|label\{[^{}]*\}|left\.|big|Big|bigg|Bigg|displaystyle)(?![A-Za-z]))*"
    r"(?:[-+=<>*/)\]·×−]|\\(?:pm|mp|cdot|times|otimes|right|approx|equiv|simeq|leq?|geq?"
    r"|Big[lr]?\s*[+\-)\]]|bigg?[lr]?\s*[+\-)\]])(?![A-Za-z]))"
)
_ENDS_OPEN = re.compile(
    r"(?:[-+=<>*/(\[·×−]|\\(?:pm|mp|cdot|times|otimes|left\s*[(\[|.]|approx|equiv))"
    r"(?:[\s&]|\\[,;:!]|\\nonumber)*\Z"
)


def without_layout(display: PlacedText) -> PlacedText:
    r"""With blanks for ``\begin{aligned}`` and the like, which only lay rows out."""
    return display.masked(_LAYOUT)


def is_relation(text: str) -> bool:
    """Whether a sign of a relation stands in a formula, outside braces and words."""
    return any(True for _ in _signs(text))


def relations(display: PlacedText) -> list[PlacedText]:
    """The rows of a display; one without a relation continues the one before it."""
    found: list[PlacedText] = []
    for row in _cut(display, "row"):
        continues = found and (
            not is_relation(row.text)
            or _JOINING.match(row.text)
            or _ENDS_OPEN.search(found[-1].text)
            or not is_relation(found[-1].text)
            or not is_balanced(found[-1].text)
        )
        if continues:
            end = row.stripped()
            if end.text:
                found[-1] = _spanning(display, found[-1], row)
        else:
            found.append(row)
    return [row for row in found if row.text.strip()]


def parts(row: PlacedText) -> list[PlacedText]:
    r"""What wide spaces, ``\quad`` and the like, separate in a row, if each is a relation."""
    return [part for part in _cut(row, "gap") if part.text.strip(" \t\n&,.;")]


def is_balanced(text: str) -> bool:
    r"""Whether as many ``\left`` as ``\right`` stand in it."""
    return len(re.findall(r"\\left(?![A-Za-z])", text)) == len(
        re.findall(r"\\right(?![A-Za-z])", text)
    )


def _spanning(display: PlacedText, first: PlacedText, last: PlacedText) -> PlacedText:
    return PlacedText.joined([first, PlacedText.at(r" \\ ", first.end, first.end), last])


def _cut(text: PlacedText, kind: str) -> Iterator[PlacedText]:
    """The pieces between breaks that stand in no braces and in no environment."""
    depth = start = 0
    for match in _PIECE.finditer(text.text):
        depth += (match.lastgroup in ("begin", "open")) - (match.lastgroup in ("end", "close"))
        if match.lastgroup == kind and depth <= 0:
            yield text[start : match.start()]
            start = match.end()
    yield text[start:]


def _signs(text: str) -> Iterator[int]:
    depth = 0
    for match in _PIECE.finditer(text):
        kind = match.lastgroup
        depth += (kind == "open") - (kind == "close")
        is_sign = (kind == "macro" and match[0][1:] in _SIGNS) or (
            kind == "other" and match[0] in _CHARACTERS
        )
        if is_sign and depth <= 0:
            yield match.start()
