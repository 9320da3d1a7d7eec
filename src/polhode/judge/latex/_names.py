"""Names of quantities: labels told from powers, and names written in LaTeX and in ASCII.

What is written is read again as the same name, since it is chosen by the rules of the reader.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache, reduce
from itertools import pairwise
from string import ascii_letters

from polhode.algebra import LetterParts
from polhode.base import ParseError
from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex._brackets import paired
from polhode.judge.latex._labels import label_latex, label_text, spells
from polhode.judge.latex._rewriting import rewritten
from polhode.judge.latex._tokens import Token, tokens
from polhode.judge.latex._tree import (
    At,
    Call,
    Component,
    ComponentList,
    Derivative,
    Differential,
    Dots,
    Name,
    Node,
    Number,
    Quotient,
    Root,
)
from polhode.judge.latex._units import unit_text

#: Letters that stand before the order of terms left out, as in O(θ³).
ORDERS = (Name("O"), Name("cal O"))
ROMAN = frozenset(ascii_letters)
#: Kinds of tokens that letters begin with, and what can stand behind the d of a differential.
LETTERS = frozenset(("letter", "decoration", "dots", "alphabet"))
BEGIN_DIFFERENTIATED = LETTERS | {"prescript"}

_EULER = Name("e")  # the base of an exponential, even of one to the power T
_ABOVE_VECTORS = {"letter", "number", "alphabet", "words"}

# -- labels, and what else stands above ----------------------------------------------------------


@lru_cache(4096)
def scanned(latex: str) -> tuple[Token, ...]:
    """The tokens of LaTeX as the grammar meets them.

    Raises:
        ParseError: for LaTeX that no formula holds.
    """
    return paired(latex, rewritten(latex, tokens(latex))).tokens[:-1]


def is_label_text(text: str) -> bool:
    """Whether a label is read again from what is written for it."""
    return _is_read_as(label_latex(text), text)


def _is_read_as(latex: str, text: str) -> bool:
    inside = _above(latex)
    if not inside or inside[-1].kind in ("decoration", "dots") or not all(map(spells, inside)):
        return False
    return label_text(inside) == text


def _above(latex: str) -> Sequence[Token]:
    """The tokens of what stands above a letter; none for what cannot stand there."""
    try:
        return scanned(f"x^{{{latex}}}")[3:-1]
    except ParseError:
        return ()


def superscript_kind(inside: Sequence[Token], node: Node | None) -> str:
    """What the tokens above a quantity are.

    Returns:
        "transpose", "primes", "degrees", "label" or "exponent".
    """
    printed = "".join(token.text for token in inside)
    is_scalar = node in (None, _EULER) or isinstance(node, Number)
    if printed.lstrip("'") in ("T", "-T") and not is_scalar:
        return "transpose"
    if all(token.is_mark("'") for token in inside):
        return "primes"
    if all(token.is_mark("°") for token in inside):
        return "degrees"
    is_words = {token.kind for token in inside} <= {"words", "label", "operator"}
    is_sign = len(inside) == 1 and inside[0].is_mark("*", "+", "-")
    in_bracket = inside[1:-1] if inside[0].is_mark("(") and inside[-1].is_mark(")") else ()
    is_bracket = len(in_bracket) == 1 or {token.kind for token in in_bracket} == {"letter"}
    is_coordinate = isinstance(node, Dots) or (isinstance(node, Name) and node.letter == "q")
    is_index = is_coordinate and len(printed) == 1 and are_indices(inside)
    is_label = is_words or is_sign or is_bracket or is_index or _names_body(inside, node)
    return "label" if is_label else "exponent"


def are_indices(inside: Sequence[Token]) -> bool:
    """Whether what stands above a quantity could be indices: q^i, g^{ij}."""
    return all(token.kind == "letter" and token.text in lexicon.INDICES for token in inside)


def has_indices_above(tokens: Sequence[Token]) -> bool:
    """Whether a formula differentiates by, or counts the rates of, coordinates such as x^i."""
    printed = [token for token in tokens if not token.is_mark("{", "}")]
    runs = zip(printed, printed[1:], printed[2:], printed[3:], strict=False)
    return any(
        (first.kind == "dots" or first.text in lexicon.DIFFERENTIALS)
        and base.kind == "letter"
        and above.is_mark("^")
        and are_indices([index])
        for first, base, above, index in runs
    )


def _names_body(inside: Sequence[Token], node: Node | None) -> bool:
    r"""Whether a superscript is the name of a body or a point: ``\mathbf v^P``, ``I^{B/O}``.

    A vector has no powers but its square, and points have no quotient.
    """
    match node:
        case Dots(Name() as name) | Derivative(Name() as name, frame="circ") | (Name() as name):
            pass
        case _:
            return False
    printed = [token for token in inside if not token.is_mark("{", "}")]
    if not printed or name.superscript:
        return False
    is_mark = [token.is_mark("/", "_", ",") for token in printed]
    if not all(m or t.kind in _ABOVE_VECTORS for m, t in zip(is_mark, printed, strict=True)):
        return False
    if is_mark[-1] or any(map(all, pairwise(is_mark))):  # each stands between two names
        return False
    first = next((token for token in printed if token.kind != "alphabet"), printed[0])
    if first.kind not in ("letter", "words"):
        return False
    if name.prescript or (name.is_marked_vector and first.text in ROMAN):
        return True
    if name.decoration and any(token.is_mark("_") for token in printed):
        return True  # points: \bar v^{c_o}, \bar r^{c_l/d_o}
    is_point = first.text[:1].isupper() and len(first.text) == 1
    return is_point and (bool(name.decoration) or any(token.is_mark("/") for token in printed))


def superscript_latex(text: str, node: Node | None) -> str:
    """LaTeX for a label above a letter, as words where need be; nothing if it is read otherwise."""
    for latex in (label_latex(text), rf"\text{{{text}}}"):
        if _is_read_as(latex, text) and superscript_kind(_above(latex), node) == "label":
            return latex
    return ""


def exponent_latex(latex: str, base: Node) -> str:
    """An exponent, with a plus sign before it where it would be read as a label without."""
    return latex if superscript_kind(_above(latex), base) == "exponent" else f"+{latex}"


# -- letters in LaTeX ----------------------------------------------------------------------------

_FRAME = re.compile("(?!T$)[A-Za-z](?![A-Za-z]).*")  # set on nothing
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
    above, _, below = frame.partition(";")
    if _FRAME.fullmatch(frame) and scanned(latex)[0].kind != "words":
        return f"{{}}^{{{label_latex(above)}}}{f'_{{{label_latex(below)}}}' * bool(below)}{latex}"
    # On nothing, a number is a power, and a word belongs to what stands before.
    return rf"\prescript{{{label_latex(above)}}}{{{label_latex(below)}}}{{{latex}}}"


def letter_latex(name: Name) -> str:
    """The letter with its hat; unit vectors and vectors are bold, Greek ones by their own macro."""
    kind, _, inner = name.decoration.partition(" ")
    letter = _letter(name.letter)
    if _is_name_by_label(name):
        letter += _subscript_latex(name)
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
    if letter in ROMAN or not letter.isalpha():
        return letter
    if unit_text(letter):  # which, set plainly behind a number, is a unit
        return rf"\text{{\textit{{{letter}}}}}"
    is_plain = letter.isascii() and letter != "constant" and letter not in lexicon.OPERATORS
    return rf"\mathrm{{{letter}}}" if is_plain else rf"\text{{{letter}}}"


def is_word(name: Name) -> bool:
    """Whether a name is printed as an upright word."""
    return name.letter.isalpha() and name.letter not in ROMAN | lexicon.LETTERS.keys()


def follows_d(node: Node) -> bool:
    """Whether the letter of a differential is such that it can stand plainly behind the d."""
    if isinstance(node, Dots):
        return isinstance(node.of, Name)
    if not isinstance(node, Name):
        return False
    is_decorated = bool(node.decoration or node.prescript)
    return is_decorated or not (is_word(node) or node.letter.isdigit())


def _subscript_latex(name: Name) -> str:
    return f"_{{{label_latex(name.subscript)}}}" if name.subscript else ""


def _is_name_by_label(name: Name) -> bool:
    """Whether it is a word that is a name only with its label right behind it."""
    return is_word(name) and not name.letter.isupper() and name.letter != "constant"


def scripts_latex(name: Name, dots: int = 0) -> str:
    """The primes and labels of a letter, over which dots may stand."""
    below = "" if _is_name_by_label(name) else _subscript_latex(name)
    bare = replace(name, superscript="")
    marked = Dots(bare, dots) if dots else bare
    above = name.superscript and superscript_latex(name.superscript, marked)
    return "'" * name.primes + below + (f"^{{{above}}}" if above else "")


# -- published names, in ASCII -------------------------------------------------------------------

_ENDINGS = {"_dot": 1, "_ddot": 2, "_dddot": 3}


def name_of(published: str) -> Node:
    """The letter that a published name is printed as: `Fprime_rho`, `theta_ddot`."""
    for ending, count in _ENDINGS.items():
        if published.endswith(ending):
            return Dots(name_of(published.removesuffix(ending)), count)
    parts = LetterParts.of(published)
    return Name(parts.letter, ",".join(parts.labels), parts.primes)


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
        case ComponentList(entries):
            return ", ".join(map(spelled, entries))
        case Call() | Root() | Quotient():
            return "..."
    return type(node).__name__.lower()
