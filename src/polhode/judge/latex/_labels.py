"""Labels below and above letters: read from tokens, and written in LaTeX.

What stands below a letter, or above it in words, names a quantity and is text, never mathematics.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex._tokens import Token

_DOTS = {str(count): name for name, count in lexicon.DOTS.items()}
_MARKS = tuple("()[],;.:=+-*/'_^|{}×±∓")
_KINDS = {"letter", "number", "label", "function", "operator", "unit", "sign"} | {
    *("decoration", "dots", "alphabet"),
}
_SIGNS = {"±": r"\pm ", "∓": r"\mp ", "×": r"\times "}
_LETTERS = lexicon.LETTERS.keys() | set(lexicon.LABELS.values())
_ABOVE = lexicon.ACCENTS | lexicon.DOTS.keys()  # which stand before a letter
_SPELLABLE = re.compile(r"(?:[^\W_]|[ .,+=*/'-]|\((?:[^\W_]| )*\))*")
_WORD = re.compile(r"[^\W\d_]+|.", re.DOTALL)


def spells(token: Token) -> bool:
    """Whether a token can stand in a label."""
    if token.kind == "words":
        return _SPELLABLE.fullmatch(token.text) is not None
    return token.kind in _KINDS or token.is_mark(*_MARKS)


def label_text(inside: Sequence[Token]) -> str:
    """The text of a label: Greek letters by name, set off by spaces from letters and digits."""
    text = ""
    last_is_set_off = False
    for word, is_set_off in _words(inside):
        touches = text[-1:].isalnum() and word[:1].isalnum()
        text += f" {word}" if touches and (is_set_off or last_is_set_off) else word
        last_is_set_off = is_set_off
    return text


def _words(inside: Sequence[Token]) -> Iterator[tuple[str, bool]]:
    """The words of a label, and whether each needs a space beside letters and digits."""
    for token in inside:
        if token.kind == "letter":
            yield token.text, len(token.text) > 1
        elif token.kind == "dots":
            yield _DOTS[token.text], True
        elif token.kind == "decoration":
            yield from [(token.text, True)] if token.text in lexicon.ACCENTS else []
        elif token.kind == "alphabet":
            pass  # in labels, script letters are another font for the same frames and points
        elif not token.is_mark("{", "}"):
            yield token.text.replace(" ", ""), token.kind == "label"


def label_latex(text: str) -> str:
    """LaTeX for a label; `label_text` makes the same label of it."""
    return "".join(_word_latex(match) for match in _WORD.finditer(text)).rstrip()


def _word_latex(match: re.Match[str]) -> str:
    word, before, behind = match[0], match.string[: match.start()], match.string[match.end() :]
    if word == "." and behind[:1] in "0123456789.":
        return r"\text{.}"  # neither a decimal number nor an ellipsis
    if word.isalpha() and not word.isascii():  # тр, Stoß
        return rf"\text{{{word}}}"
    if len(word) == 1 or word in lexicon.FUNCTIONS:
        return _SIGNS.get(word, word.strip())
    stands_alone = not before[-1:].isalnum() and not behind[:1].isalnum()
    if stands_alone and (word in _LETTERS or (word in _ABOVE and behind[:1] == " ")):
        return f"\\{word} "
    return rf"\mathrm{{{word}}}"
