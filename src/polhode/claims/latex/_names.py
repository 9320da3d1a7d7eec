"""Names of quantities: their labels read from tokens, and written in LaTeX and in ASCII.

What stands below a letter, or above it in words, names a quantity and is text, never mathematics.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import reduce

from polhode.claims.latex import _lexicon as lexicon
from polhode.claims.latex._tokens import Token
from polhode.claims.latex._tree import At, Component, Differential, Dots, Name, Node, Number

# -- labels --------------------------------------------------------------------------------------

_DOTS = {str(count): name for name, count in lexicon.DOTS.items()}
_MARKS = tuple("()[],;.:=+-*/'_^|{}×±∓")
_KINDS = {"letter", "number", "label", "function", "operator", "unit", "sign"} | {
    *("decoration", "dots", "alphabet"),
}
_ABOVE = lexicon.ACCENTS
_SIGNS = {"±": r"\pm ", "∓": r"\mp ", "×": r"\times "}
_MACROS = set(lexicon.LETTERS) | set(lexicon.LABELS.values()) | set(lexicon.DOTS) | _ABOVE
_SPELLABLE = re.compile(r"(?:[A-Za-z0-9 .,+=*/'-]|\([A-Za-z0-9 ]*\))*")
_WORD = re.compile(r"[A-Za-z]+|[^A-Za-z]")


def spells(token: Token) -> bool:
    """Whether a token can stand in a label."""
    if token.kind == "words":
        return _SPELLABLE.fullmatch(token.text) is not None
    return token.kind in _KINDS or token.is_mark(*_MARKS)


def is_label(inside: Sequence[Token]) -> bool:
    """Whether a superscript is a label rather than a power: a star, a sign alone, ``(n)``."""
    if len(inside) == 1:
        return inside[0].is_mark("*", "+", "-")
    return len(inside) == 3 and inside[0].is_mark("(") and inside[2].is_mark(")")


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
            yield from [(token.text, True)] if token.text in _ABOVE else []
        elif token.kind == "alphabet":
            pass  # in labels, script letters are another font for the same frames and points
        elif not token.is_mark("{", "}"):
            yield token.text.replace(" ", ""), token.kind == "label"


def label_latex(text: str) -> str:
    """LaTeX for a label; `label_text` makes the same label of it."""
    return "".join(_word_latex(match) for match in _WORD.finditer(text)).rstrip()


def _word_latex(match: re.Match[str]) -> str:
    word, text = match[0], match.string
    if word == "." and re.match("[0-9.]", text[match.end() :]):
        return "{.}"  # neither a decimal number nor an ellipsis
    if len(word) == 1 or word in lexicon.FUNCTIONS:
        return _SIGNS.get(word, word.strip())
    touches = text[: match.start()][-1:].isalnum() or text[match.end() :][:1].isalnum()
    return f"\\{word} " if word in _MACROS and not touches else f"\\mathrm{{{word}}}"


#: Letters that stand before the order of terms left out, as in O(θ³).
ORDERS = (Name("O"), Name("cal O"))

# -- letters in LaTeX ----------------------------------------------------------------------------

_ALPHABETS = {"cal": "mathcal", "bb": "mathbb", "frak": "mathfrak"}


def name_latex(name: Name) -> str:
    """A letter with its decoration, primes and labels."""
    if name.letter.isdigit() and not name.decoration:  # a zero matrix, set off from numbers
        matrix = f"{name.letter}_{{{label_latex(name.subscript)}}}"
        return in_frame_latex(name.prescript, rf"\left({matrix}\right)") + "'" * name.primes
    return in_frame_latex(name.prescript, letter_latex(name)) + scripts_latex(name)


def in_frame_latex(frame: str, latex: str) -> str:
    """A letter or a bracket with a label in front, such as the frame of a velocity."""
    if not frame:
        return latex
    label = label_latex(frame)
    if frame[0].isalpha() and not label.startswith(r"\mathrm"):
        return f"{{}}^{{{label}}}{latex}"
    # On nothing, a number is a power, and a word belongs to what stands before.
    return rf"\prescript{{{label}}}{{}}{{{latex}}}"


def letter_latex(name: Name) -> str:
    """The letter with its hat; unit vectors and vectors are bold, Greek ones by their own macro."""
    kind, _, inner = name.decoration.partition(" ")
    letter = _letter(name.letter)
    if kind in ("hat", "vector") or inner:
        letter = rf"\{'boldsymbol' if letter.startswith(chr(92)) else 'mathbf'}{{{letter}}}"
    accents = [accent for accent in (inner, kind) if accent in lexicon.ACCENTS]
    return reduce(lambda under, accent: rf"\{accent}{{{under}}}", accents, letter)


def _letter(letter: str) -> str:
    alphabet, _, script = letter.rpartition(" ")
    if alphabet:
        return rf"\{_ALPHABETS[alphabet]}{{{script}}}"
    if letter in lexicon.LETTERS:
        return rf"\{letter}"
    if len(letter) == 1:
        return letter
    return rf"\text{{{letter}}}" if letter == "constant" else rf"\mathrm{{{letter}}}"


def _superscript_latex(text: str) -> str:
    """A label above a letter: as words, where it could be taken for a formula otherwise."""
    is_formula = not text.isalpha() and re.search("[A-Za-z]{2}", text)
    return rf"\text{{{text}}}" if is_formula else label_latex(text)


def scripts_latex(name: Name) -> str:
    """The primes and labels of a letter."""
    below = f"_{{{label_latex(name.subscript)}}}" if name.subscript else ""
    above = f"^{{{_superscript_latex(name.superscript)}}}" if name.superscript else ""
    return "'" * name.primes + below + above


# -- published names, in ASCII -------------------------------------------------------------------

_ENDINGS = {"_dot": 1, "_ddot": 2, "_dddot": 3}


def name_of(published: str) -> Node:
    """The letter that a published name is printed as: `Fprime_rho`, `theta_ddot`."""
    for ending, count in _ENDINGS.items():
        if published.endswith(ending):
            return Dots(name_of(published.removesuffix(ending)), count)
    stem, *subscripts = published.rstrip("_").split("_")
    letter = stem
    while letter.endswith("prime") and letter != "prime":
        letter = letter.removesuffix("prime")
    primes = (len(stem) - len(letter)) // len("prime")
    return Name(letter, ",".join(subscripts), primes)


def spelled(node: Node) -> str:
    """A letter in ASCII for messages: `omega_3`, `theta_dot`, `hat 3`, `vector L_cm`."""
    match node:
        case Name(letter, subscript, primes, decoration):
            below = f"_{subscript}" if subscript else ""
            prefix = f"{decoration} " if decoration else ""
            return f"{prefix}{letter}{'prime' * primes}{below}"
        case Number(text):
            return text
        case Dots(of, count):
            return f"{spelled(of)}_{'d' * (count > 1) * (count - 1)}dot"
        case Differential(of, sign):
            return f"{sign}{spelled(of)}"
        case At(of, argument):
            return f"{spelled(of)}({spelled(argument)})"
        case Component(of, subscript):
            return f"({spelled(of)})_{subscript}"
    return type(node).__name__.lower()
