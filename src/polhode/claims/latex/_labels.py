"""Sub- and superscripts that name something: read as text, never as mathematics."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from polhode.claims.latex import _lexicon as lexicon
from polhode.claims.latex._tokens import Token

_DOTS = {str(count): name for name, count in lexicon.DOTS.items()}
_MARKS = tuple("()[],;.:=+-*/'_^|{}")
_KINDS = {"letter", "number", "label", "function", "sign", "decoration", "dots"}
_ABOVE = {"hat", "bar", "tilde"}
_MACROS = set(lexicon.LETTERS) | set(lexicon.LABELS) | set(lexicon.DOTS) | _ABOVE
_SPELLABLE = re.compile(r"(?:[A-Za-z0-9 .,+=*/'-]|\([A-Za-z0-9 ]*\))*")
_WORD = re.compile(r"[A-Za-z]+|[^A-Za-z]")


def spells(token: Token) -> bool:
    """Whether a token can stand in a label."""
    if token.kind == "words":
        return _SPELLABLE.fullmatch(token.text) is not None
    return token.kind in _KINDS or token.is_mark(*_MARKS)


def is_label(inside: Sequence[Token]) -> bool:
    """Whether what stands above a letter is no power: a star, a sign alone, ``(n)``."""
    if len(inside) == 1:
        return inside[0].is_mark("*", "+", "-")
    return len(inside) == 3 and inside[0].is_mark("(") and inside[2].is_mark(")")


def spelled(inside: Sequence[Token]) -> str:
    """The text of a label: Greek letters by name, set off by spaces from letters and digits."""
    text = ""
    last_is_set_off = False
    for word, is_set_off in _words(inside):
        touches = text[-1:].isalnum() and word[:1].isalnum()
        text += f" {word}" if touches and (is_set_off or last_is_set_off) else word
        last_is_set_off = is_set_off
    return text


def label_latex(text: str) -> str:
    """LaTeX for a label; what `spelled` makes of it is the label again."""
    return "".join(_word_latex(match) for match in _WORD.finditer(text)).rstrip()


def _words(inside: Sequence[Token]) -> Iterator[tuple[str, bool]]:
    for token in inside:
        if token.kind == "letter":
            yield token.text, len(token.text) > 1
        elif token.kind == "dots":
            yield _DOTS[token.text], True
        elif token.kind == "decoration":
            yield from [(token.text, True)] if token.text in _ABOVE else []
        elif not token.is_mark("{", "}"):
            yield token.text.replace(" ", ""), token.kind == "label"


def _word_latex(match: re.Match[str]) -> str:
    word, text = match[0], match.string
    if len(word) == 1 or word in lexicon.FUNCTIONS:
        return word.strip()
    touches = text[: match.start()][-1:].isalnum() or text[match.end() :][:1].isalnum()
    return f"\\{word} " if word in _MACROS and not touches else f"\\mathrm{{{word}}}"
