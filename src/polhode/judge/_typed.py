"""Options typed with a claim: `theta = pi/2`, `epsilon = theta - pi/2`, `epsilon:1`.

Text with a backslash or a brace is read as LaTeX, other text in published names.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import replace

from polhode.algebra import Expr, pi, read_expression
from polhode.base import ParseError, PolhodeError, UnitError, read_quantity
from polhode.judge._notation import Notation, letter
from polhode.judge.document._document import Definition
from polhode.judge.latex import read_latex
from polhode.judge.latex._names import name_of, spelled
from polhode.judge.latex._tree import Differential, Dots, Name, Node, Piece
from polhode.judge.meaning._evaluate import RATES, SLOPES
from polhode.judge.meaning._meaning import BindingError, Meaning
from polhode.judge.meaning._poisson_bracket import BRACKET, SIGNS
from polhode.judge.meaning._relations import BoundRelation
from polhode.judge.states._bound_claim import Small

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_POSITIVE = re.compile(r"\s*>\s*0\s*$")


def pieces_of(text: str) -> tuple[Piece, ...]:
    """The letters in an option of a claim; for LaTeX, its statement."""
    if _is_latex(text):
        return (read_latex(text),)
    letters = map(name_of, _NAME.findall(text))
    return tuple(node for node in letters if isinstance(node, Name | Dots))


def with_reading(notation: Notation, text: str) -> Notation:
    """With a letter of several meanings read as one of them: `L = about pivot`, `T = tension`.

    Raises `ParseError` for a letter without several meanings, and for a meaning it does not have.
    """
    left, right = _sides(text, "a letter and the quantity it means", once=False)
    ways = _DERIVATIVE.fullmatch(left)
    if ways is not None:
        meant = _meant(right, SLOPES, left)
        return notation.allowing({Differential(name_of(ways[1])): meant})
    if left == BRACKET.letter:
        return notation.allowing({BRACKET: _meant(right, SIGNS, left)})
    named = letter(left) if _is_latex(left) else name_of(left)
    if isinstance(named, Dots) and isinstance(named.of, Name):
        vector = Dots(replace(named.of, decoration="vector"), 1)
        return notation.allowing({vector: _meant(right, RATES, left)})
    vocabulary = notation.vocabulary
    readings = vocabulary.readings_of(named) if isinstance(named, Name) else ()
    if not readings:
        raise ParseError(
            f"the reading {text!r}",
            expected=f"a letter of several meanings in {vocabulary.system}, such as L or v",
            advice="define a new letter with let",
        )
    _meant(right, tuple(dict.fromkeys(p for r in readings for p in r.phrases)), left)
    # **L** "about pivot" leaves open whether a plain L is its magnitude.
    allowed = {r.letter: tuple(_matching(right, r.phrases)) for r in readings}
    return notation.allowing({letter: phrases for letter, phrases in allowed.items() if phrases})


_DERIVATIVE = re.compile(r"d/d\s*([A-Za-z]\w*)")


def _meant(words: str, phrases: tuple[str, ...], letter: str) -> tuple[str, ...]:
    meant = tuple(_matching(words, phrases))
    if not meant:
        raise ParseError(f"{words!r} for {letter}", expected=f"one of: {'; '.join(phrases)}")
    return meant


def _matching(words: str, phrases: Iterable[str]) -> Iterator[str]:
    """The phrases meant by some words: "about pivot" is enough."""
    known = tuple(phrases)
    if words in known:
        yield words
        return
    for phrase in known:
        if phrase.startswith(f"{words} ") or phrase.endswith(f" {words}"):
            yield phrase


def with_let(notation: Notation, text: str) -> Notation:
    """With a new symbol: `epsilon = theta - pi/2`.

    Raises `ParseError` for a symbol that the system has already.
    """
    if _is_latex(text):
        extended = notation.defining([Definition(text)])
        meanings = extended.vocabulary.stated
        for new in meanings.keys() - notation.vocabulary.stated.keys():
            _refuse_redefined(notation, new, meanings[new])
        return extended
    name, value = _sides(text, "a new symbol and its value")
    new = name_of(name)
    if _NAME.fullmatch(name) is None or new in notation.vocabulary.declared:
        raise ParseError(
            f"the definition {text!r}",
            expected=f"a new symbol, which {spelled(new)} is not",
            advice="restrict a known quantity to a value instead",
            option="given",
        )
    meaning = typed(notation, value)
    _refuse_redefined(notation, new, meaning)
    return replace(notation, vocabulary=notation.vocabulary.stating({new: meaning}))


def _refuse_redefined(notation: Notation, new: Node, meaning: Meaning) -> None:
    """A quantity of the motion may be written out, but not redefined as another one.

    L_z = I ω_z is accepted where it is true; E = 5 would turn every claim on E into another one.
    """
    if not isinstance(meaning, Expr):
        return
    in_rates = notation.vocabulary.mechanics.in_rates
    found = [m for m in notation.vocabulary.firmly(new) if isinstance(m, Expr)]
    moving = [m for m in found if m.varies]
    if moving and all(in_rates(known) != in_rates(meaning) for known in moving):
        raise ParseError(
            f"{spelled(new)} = {meaning}, though {spelled(new)} is known as {moving[0]}",
            expected="a definition of a new symbol",
            advice="restrict a known quantity instead",
            option="given",
        )


def with_given(notation: Notation, text: str) -> Notation:
    """Restricted by an equality: `theta = pi/2`, `theta = 90deg`, `2*I_2*T = L**2`."""
    if _is_latex(text):
        return notation.under([text])
    try:
        return replace(notation, given=(*notation.given, _equality(notation, text)))
    except ParseError as error:
        if "=" in text:
            with suppress(PolhodeError):  # E = mga, which is LaTeX without a backslash
                return notation.under([text])
        raise error


def with_start(notation: Notation, text: str) -> Notation:
    """With a value at the start of a motion: `theta_dot = 0`."""
    return replace(notation, start=(*notation.start, _equality(notation, text)))


def _equality(notation: Notation, text: str) -> BoundRelation:
    left, right = _sides(text, "an equality")
    return BoundRelation(typed(notation, left), "=", typed(notation, right))


def with_small(notation: Notation, text: str) -> Notation:
    """With a small quantity and, where it is stated, the order to which it is kept: `epsilon:1`."""
    quantity, colon, order = text.rpartition(":")
    if colon and not order.strip().isdigit():
        raise ParseError(f"{text!r}", expected="SYMBOL or SYMBOL:ORDER", advice="as in epsilon:1")
    small = (quantity if colon else text).strip()
    value = notation.scalar(small) if _is_latex(small) else typed(notation, small)
    found = Small(value, int(order) if colon else None)
    return replace(notation, small=(*notation.small, found))


def with_positive(notation: Notation, text: str) -> Notation:
    """With a quantity whose sign is stated: `sin(alpha)`, `v_y > 0`, `-F_x`."""
    text = _POSITIVE.sub("", text)
    value = notation.scalar(text) if _is_latex(text) else typed(notation, text)
    return notation.with_positive([value])


def typed(notation: Notation, text: str) -> Expr:
    """An exact expression of published names and of letters of the text, or a number with a unit.

    Raises `ParseError` for any other text, naming the symbol at fault.
    """
    values: dict[str, Expr] = {}
    for name in _NAME.findall(text):
        with suppress(BindingError):
            value = notation.value(name_of(name))
            if isinstance(value, Expr):
                values[name] = value
    try:
        return read_expression(text, values)
    except ParseError as error:
        try:
            quantity = read_quantity(text.strip())
        except UnitError:
            raise error from None
        return Expr.of(quantity.coefficient) * pi**quantity.pi_power


def _sides(text: str, expected: str, once: bool = True) -> tuple[str, str]:
    left, equals, right = text.partition("=")
    if not equals or (once and "=" in right) or not left.strip() or not right.strip():
        raise ParseError(f"{text!r}", expected=f"{expected} with one = between")
    return left.strip(), right.strip()


def _is_latex(text: str) -> bool:
    return any(mark in text for mark in "\\{}")
