"""A display cut into its relations, each with the words and rows that belong to it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from polhode.base import ParseError
from polhode.claims.latex import _lexicon as lexicon
from polhode.claims.source._macros import closing
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


_INVISIBLE = re.compile(r"\\(?:[vh]?phantom|label|footnote|cite|index)\s*\{")
_WORDS_ALONE = re.compile(
    r"(?:[\s&,.;:]|\\[,;:!\s]|\\q?quad(?![A-Za-z])|\\(?:text\w*|mbox|mathrm)\s*\{[^{}$]*\})*\Z"
)
_MEMBER = re.compile(r"\\in(?![A-Za-z])")
_BRACKET = re.compile(
    r"""
      (?P<left>\\left\s*(?:\\?[A-Za-z]+|\\?.)|\\[bB]igg?l\s*(?:\\[A-Za-z]+|\\?.)|\\lbrace(?![A-Za-z])
        |\\\{|[(\[])
    | (?P<right>\\right\s*(?:\\[A-Za-z]+|\\?.)|\\[bB]igg?r\s*(?:\\[A-Za-z]+|\\?.)
        |\\rbrace(?![A-Za-z])|\\\}|[)\]])
    | (?P<begin>\\begin\s*\{[^{}]*\}(?:\s*\[[tbc]\])?(?:\s*\{[lcr@|\s]*\})?)
    | (?P<end>\\end\s*\{[^{}]*\})
    | (?P<row>\\\\(?:\s*\[[^\]\n]*\])?|\\(?:cr|newline)(?![A-Za-z]))
    | (?P<macro>\\[A-Za-z]+)
    | (?P<other>\\.|.)
    """,
    re.VERBOSE | re.DOTALL,
)


@dataclass
class _Bracket:
    """A bracket that is open, and what has stood in it so far."""

    marks: list[tuple[int, int]]
    is_first: bool  # in its row: nothing relates it to something before
    is_environment: bool = False
    braces: int = 0  # that are open around it
    signs: int = 0
    rows: int = 0  # that follow a sign
    related_rows: int = 0  # signs behind such a row

    def end_row(self, is_outermost: bool) -> None:
        """Count a line break; in the outermost rows a relation begins anew."""
        self.rows += self.signs > 0
        if is_outermost:
            self.signs = 0


def without_systems(display: PlacedText) -> PlacedText:
    r"""Without the brace or brackets around a system of equations, and its ``array``.

    Raises:
        ParseError: for rows of equations in a bracket that is part of a formula.
    """
    open_ = [_Bracket([], True)]
    dropped: list[tuple[int, int]] = []
    braces = 0
    for match in _BRACKET.finditer(display.text):
        kind, around = match.lastgroup or "", open_[-1]
        braces += (match[0] == "{") - (match[0] == "}")
        if kind in ("left", "begin"):
            is_first = around.is_first and not around.signs
            open_.append(_Bracket([match.span()], is_first, kind == "begin", braces))
        elif kind in ("right", "end") and len(open_) > 1:
            _close(open_, match.span(), dropped)
        elif kind == "row":
            around.end_row(is_outermost=len(open_) == 1)
        elif braces <= around.braces and _is_sign(match[0], kind):
            around.signs += 1
            around.related_rows += around.rows > 0
    text = list(display.text)
    for start, end in dropped:
        text[start:end] = " " * (end - start)
    return display.with_text("".join(text))


def _close(open_: list[_Bracket], closer: tuple[int, int], dropped: list[tuple[int, int]]) -> None:
    """Close the innermost bracket; one around a system is dropped, with what is right around it."""
    inner = open_.pop()
    inner.marks.append(closer)
    around = open_[-1]
    if not inner.related_rows:
        return
    if inner.is_first:
        dropped += inner.marks
        around.signs += inner.signs
        around.rows += inner.rows
        around.related_rows += inner.related_rows
    elif not inner.is_environment:
        raise ParseError(
            "rows of equations in brackets", expected="a bracket around one quantity or relation"
        )


def _is_sign(text: str, kind: str) -> bool:
    return (kind == "macro" and text[1:] in _SIGNS) or (kind == "other" and text in _CHARACTERS)


def is_relation(text: str) -> bool:
    """Whether a sign of a relation stands in a formula, outside braces and words."""
    return any(True for _ in _signs(text))


def plain(formula: PlacedText) -> PlacedText:
    r"""With ordinary signs: no ``\vphantom{...}``, ≤ for <=, [a, b] for ``[a \quad b]``."""
    text = formula.text
    for match in _INVISIBLE.finditer(text):
        end = closing(text, match.end() - 1)
        if end is not None:
            text = text[: match.start()] + " " * (end + 1 - match.start()) + text[end + 1 :]
    text = _with_commas(text.replace("<=", "≤ ").replace(">=", "≥ "))
    return formula.with_text(text)


def _with_commas(text: str) -> str:
    r"""With commas for wide spaces between the entries of a row in square brackets."""
    open_: list[str] = []
    found: list[re.Match[str]] = []
    for match in _BRACKET.finditer(text):
        kind = match.lastgroup
        if kind in ("left", "begin"):
            open_.append(match[0][-1])
        elif kind in ("right", "end"):
            del open_[-1:]
        elif match[0] in (r"\quad", r"\qquad") and open_[-1:] == ["["]:
            found.append(match)
    for match in reversed(found):
        before, behind = text[: match.start()], text[match.end() :]
        if not (_ENDS_OPEN.search(before) or _JOINING.match(behind) or before[-1:] == ","):
            text = f"{before}{','.ljust(len(match[0]))}{behind}"
    return text


def relations(display: PlacedText) -> list[PlacedText]:
    """The rows of a display; one without a relation continues the one before it."""
    found: list[PlacedText] = []
    for row in _cut(display, "row"):
        if _WORDS_ALONE.match(row.text):
            continue
        continues = found and (
            not is_relation(row.text)
            or _JOINING.match(row.text)
            or _ENDS_OPEN.search(found[-1].text)
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
    places = list(_signs(bare))
    return bool(places) and (places[0] == 0 or places[-1] >= len(bare) - 1)


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
        if _is_sign(match[0], kind or "") and depth <= 0:
            yield match.start()
