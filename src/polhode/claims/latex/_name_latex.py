"""Letters written as LaTeX with what they carry."""

from __future__ import annotations

from polhode.claims.latex import _lexicon as lexicon
from polhode.claims.latex._labels import label_latex
from polhode.claims.latex._tree import Name

_ALPHABETS = {"cal": "mathcal", "bb": "mathbb", "frak": "mathfrak"}


def name_latex(name: Name) -> str:
    """A letter with its decoration, primes and labels."""
    return letter_latex(name) + scripts_latex(name)


def scripts_latex(name: Name) -> str:
    """The primes and labels of a letter."""
    below = f"_{{{label_latex(name.subscript)}}}" if name.subscript else ""
    above = f"^{{{label_latex(name.superscript)}}}" if name.superscript else ""
    return "'" * name.primes + below + above


def letter_latex(name: Name) -> str:
    """The letter with its hat; unit vectors and vectors are bold, Greek ones by their own macro."""
    kind, _, is_vector = name.decoration.partition(" ")
    letter = _letter(name.letter)
    if kind in ("hat", "vector") or is_vector:
        letter = rf"\{'boldsymbol' if letter.startswith(chr(92)) else 'mathbf'}{{{letter}}}"
    return rf"\{kind}{{{letter}}}" if kind in ("hat", "bar", "tilde") else letter


def _letter(letter: str) -> str:
    alphabet, _, script = letter.rpartition(" ")
    if alphabet:
        return rf"\{_ALPHABETS[alphabet]}{{{script}}}"
    if letter in lexicon.LETTERS:
        return rf"\{letter}"
    if len(letter) == 1:
        return letter
    return rf"\text{{{letter}}}" if letter == "constant" else rf"\mathrm{{{letter}}}"
