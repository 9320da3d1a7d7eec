"""The signs of relations in a formula, and the pieces that a formula is made of."""

from __future__ import annotations

import re
from collections.abc import Iterator

from polhode.judge.latex import _lexicon as lexicon

PIECE = re.compile(
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
BRACKET = re.compile(
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


_SIGNS = (lexicon.SIGNS.keys() | {"triangleq", "coloneqq", "eqqcolon", "Rightarrow"}) - {
    "to", "rightarrow", "longrightarrow", "leftrightarrow",
}  # fmt: skip
_CHARACTERS = frozenset("=<>") | (lexicon.SIGN_CHARACTERS.keys() - {"→", "↔"})
#: A sign of a relation, alone.
SIGN = re.compile(rf"[{''.join(_CHARACTERS)}]|\\\\(?:{'|'.join(_SIGNS)})|:=|=:")
#: The beginning of a row that continues the one before, and the end of one that is not complete.
JOINING = re.compile(
    r"(?:[\s&,;:!{}]|\\[,;:!>\s]|\\(?:q?quad|nonumber|notag|hspace\*?\{[^{}]*\}|phantom\{[^{}]*\}"
    r"|label\{[^{}]*\}|left\.|big|Big|bigg|Bigg|displaystyle)(?![A-Za-z]))*"
    r"(?:[-+=<>*/)\]·×−]|\\(?:pm|mp|cdot|times|otimes|right|approx|equiv|simeq|leq?|geq?"
    r"|Big[lr]?\s*[+\-)\]]|bigg?[lr]?\s*[+\-)\]])(?![A-Za-z]))"
)
ENDS_OPEN = re.compile(
    r"(?:[-+=<>*/(\[·×−]|\\(?:pm|mp|cdot|times|otimes|left\s*[(\[|.]|approx|equiv))"
    r"(?:[\s&]|\\[,;:!]|\\nonumber)*\Z"
)


def is_sign(text: str, kind: str) -> bool:
    """Whether a piece of a formula, of kind "macro" or "other", relates two sides."""
    return (kind == "macro" and text[1:] in _SIGNS) or (kind == "other" and text in _CHARACTERS)


def is_relation(text: str) -> bool:
    """Whether a sign of a relation stands in a formula, outside braces and words."""
    return any(True for _ in signs(text))


def signs(text: str) -> Iterator[int]:
    """The places of the signs of relations, outside braces and words."""
    depth = 0
    for match in PIECE.finditer(text):
        kind = match.lastgroup
        depth += (kind == "open") - (kind == "close")
        if is_sign(match[0], kind or "") and depth <= 0:
            yield match.start()
