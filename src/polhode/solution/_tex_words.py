"""Words of a worked solution as LaTeX: what is written in Unicode becomes mathematics."""

from __future__ import annotations

import re
import unicodedata

_ESCAPES = {
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "\\": r"\textbackslash{}",
    "“": "``",
    "”": "''",
    "‘": "`",
    "’": "'",
    "–": "--",
    "—": "---",
    "…": r"\dots{}",
    "°": r"\textdegree{}",
    "\u00a0": "~",
    "\u2009": r"\,",
    "\u202f": r"\,",
}
_MARKS = {"\u0302": r"\hat", "\u0307": r"\dot", "\u0308": r"\ddot", "\u20d7": r"\vec"}
_SYMBOLS = {
    "√": r"\surd ",
    "×": r"\times ",
    "·": r"\cdot ",
    "±": r"\pm ",
    "∓": r"\mp ",
    "−": "-",
    "≈": r"\approx ",
    "≠": r"\ne ",
    "≤": r"\le ",
    "≥": r"\ge ",
    "≪": r"\ll ",
    "≫": r"\gg ",
    "→": r"\to ",
    "∞": r"\infty ",
    "∫": r"\int ",
    "∂": r"\partial ",
    "∇": r"\nabla ",
    "′": "'",
    "½": r"\tfrac12 ",
    "Å": r"\mathring{A}",
}
_LETTER = re.compile("(.)([\u0302\u0307\u0308\u20d7]*)", re.DOTALL)


def text_tex(text: str) -> str:
    """Words without formulas, for LaTeX."""
    # Letters with accents are kept as one; marks of mechanics belong to the letter before them.
    return _LETTER.sub(lambda found: _letter(found[1], found[2]), text)


def _letter(letter: str, marks: str) -> str:
    if letter in _ESCAPES:
        return _ESCAPES[letter]
    if letter in "#%&_{}$":
        return rf"\{letter}"
    latex = _mathematics(letter)
    if not marks and latex == letter:
        return letter
    for mark in marks:
        latex = rf"{_MARKS[mark]}{{{latex}}}"
    return rf"\ensuremath{{{latex}}}"


def _mathematics(letter: str) -> str:
    if letter in _SYMBOLS:
        return _SYMBOLS[letter]
    if ord(letter) < 0x250:  # which the fonts of text have
        return letter
    plain = unicodedata.normalize("NFKD", letter)
    match unicodedata.name(letter, "").split():
        case ["GREEK", "SMALL", "LETTER", "FINAL", "SIGMA"]:
            return r"\varsigma "
        case ["GREEK", "SMALL", "LETTER", name]:
            return rf"\{_greek(name.lower())} "
        case ["GREEK", "CAPITAL", "LETTER", name]:
            return _capital(_greek(name.lower()).capitalize())
        case [*_, "SUBSCRIPT", _] | ["SUBSCRIPT", *_]:
            return rf"_{{{_plain(plain)}}}"
        case ["SUPERSCRIPT", *_]:
            return rf"^{{{_plain(plain)}}}"
    return _plain(plain)


def _plain(text: str) -> str:
    """What is left of a letter that has no other form here."""
    return text.replace("−", "-") if text.replace("−", "-").isascii() else "?"


def _greek(name: str) -> str:
    return {"lamda": "lambda", "omicron": "mathrm{o}"}.get(name, name)


def _capital(name: str) -> str:
    """A capital Greek letter: TeX has commands for those alone that differ from Latin ones."""
    latin = dict(
        zip(
            ("Alpha", "Beta", "Epsilon", "Zeta", "Eta", "Iota", "Kappa", "Mu", "Nu"),
            "ABEZHIKMN",
            strict=True,
        )
    )
    latin |= {"Rho": "P", "Tau": "T", "Chi": "X", "Omicron": "O"}
    return rf"\mathrm{{{latin[name]}}}" if name in latin else rf"\{name} "
