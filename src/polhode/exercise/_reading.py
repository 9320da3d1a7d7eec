"""Answers read as the question means them: components along the axes in which it asks for them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

from polhode.base import ParseError
from polhode.judge import read_latex
from polhode.judge.latex import (
    ComponentList,
    Derivative,
    Dots,
    Name,
    Piece,
    Span,
    Statement,
    keyboard_latex,
    walk,
    write_latex,
)
from polhode.solution import unit

_WHOLE = re.compile(
    r"\s*(?:\$\$(?P<a>[^$]*)\$\$|\$(?P<b>[^$]*)\$|\\\[(?P<c>.*)\\\]|\\\((?P<d>.*)\\\))[\s.]*",
    re.DOTALL,
)
_DELIMITED = re.compile(r"(?<!\\)\$|\\\(|\\\[")
_BASIS = dict(zip("ijk", "xyz", strict=True))
_OF_CENTRE = re.compile(r"^(?:cm|com|c|G|S)?,?|,?(?:cm|com)$")
_TIME = Name("t")


def read_statement(text: str) -> Statement | None:
    """An answer of one formula or several; None for a text with formulas, and for what is no LaTeX.

    It may be typed as on a keyboard.
    """
    bare = bare_formula(text)
    if _DELIMITED.search(bare):
        return None
    try:
        return read_latex(keyboard_latex(bare))
    except ParseError:
        return None


def bare_formula(text: str) -> str:
    """An answer without the signs around a formula, if it is one."""
    found = _WHOLE.fullmatch(text)
    return text.strip() if found is None else next(filter(None, found.groups()), "").strip()


def with_root(text: str, asked: str) -> str:
    """An answer S² = ... for a positive quantity as S = √(...); any other as it is."""
    statement = read_statement(text)
    if statement is None or len(statement.relations) != 1:
        return text
    (relation,) = statement.relations
    left, right = relation.sides[0], relation.sides[-1]
    square = read_latex(rf"\left({asked}\right)^2").relations[0].sides[0]
    if relation.signs != ("=",) or left != square:
        return text
    return rf"{asked} = \sqrt{{{write_latex(right)}}}"


def derivatives_in(piece: Piece) -> Iterator[tuple[str, int]]:
    """Letters with how many dots they have, as dots, or as derivatives with respect to time."""
    for part in walk(piece):
        order, of = 0, part
        while isinstance(of, Dots | Derivative) and (isinstance(of, Dots) or of.by == _TIME):
            order, of = order + (of.count if isinstance(of, Dots) else of.order), of.of
        if order:
            yield write_latex(of), order


# -- vectors ---------------------------------------------------------------------------------------


@dataclass(frozen=True)
class VectorReader:
    """Reads vectors that are given by components.

    Attributes:
        asked: the vector, as LaTeX.
        axes: labels of the axes along which it is asked for, then of others on the sheet.
    """

    asked: str
    axes: tuple[tuple[str, ...], ...]

    def read(self, text: str) -> str:
        """An answer in which components became sums of unit vectors of the sheet."""
        bare = bare_formula(text)
        if _DELIMITED.search(bare):
            return text
        if r"\begin" in bare:
            bare = " ".join(bare.split())
        rows = [self._with_units(keyboard_latex(row)) for row in bare.splitlines() if row.strip()]
        return self._of_components(rows) or "\n".join(map(self._with_sums, rows))

    def _with_units(self, row: str) -> str:
        """With x̂ for other spellings of it, such as e with the index x."""
        return _replaced(row, lambda piece, _: self._unit(piece))

    def _unit(self, piece: Piece) -> str:
        labels = {label for axes in self.axes for label in axes}
        match piece:
            case Name(letter="e", subscript=label) if label in labels:
                return unit(label)
            case Name(letter="i" | "j" | "k" as letter, subscript="") if (
                piece.is_marked_vector and {"x", "y", "z"} <= labels
            ):
                return unit(_BASIS[letter])
        return ""

    def _with_sums(self, row: str) -> str:
        """With a sum of unit vectors for three components in a bracket or a column."""
        return _replaced(row, partial(self._summed, self.axes[0]))

    def _summed(self, axes: Sequence[str], piece: Piece, source: str) -> str:
        if not isinstance(piece, ComponentList) or len(piece.entries) != len(axes):
            return ""
        entries = [source[slice(*entry.span)] for entry in piece.entries]
        return rf"\left({_sum(dict(zip(axes, entries, strict=True)))}\right)"

    def _of_components(self, rows: Sequence[str]) -> str:
        """The vector from an answer that gives each of its components; empty for any other."""
        found = dict[str, str]()
        for row in rows:
            try:
                statement = read_latex(row)
            except ParseError:
                return ""
            for relation in statement.relations:
                left, right = relation.sides[0], relation.sides[-1]
                label = self._label(left) if len(relation.sides) > 1 else ""
                if not label or label in found or set(relation.signs) != {"="}:
                    return ""
                found[label] = row[slice(*right.span)]
        if not any(found.keys() <= {*axes} for axes in self.axes):
            return ""
        return f"{self.asked} = {_sum(found)}" if found else ""

    def _label(self, piece: Piece) -> str:
        """The axis of a component of the vector, such as 3 of L₃ or z of v_{cm,z}."""
        vector = read_latex(self.asked).relations[0].sides[0]
        if not (isinstance(piece, Name) and isinstance(vector, Name)):
            return ""
        if piece.letter != vector.letter or piece.decoration:
            return ""
        low = piece.subscript.removeprefix(vector.subscript).removesuffix(vector.subscript)
        label = _OF_CENTRE.sub("", low).strip(", ") or low
        return label if any(label in axes for axes in self.axes) else ""


def _sum(components: dict[str, str]) -> str:
    parts = (rf"\left({value}\right) {unit(label)}" for label, value in components.items())
    return " + ".join(parts)


def _replaced(row: str, writes: Callable[[Piece, str], str]) -> str:
    """A formula with the outermost pieces rewritten for which something is written."""
    try:
        found = list(_rewritten(read_latex(row), row, writes))
    except ParseError:
        return row
    for (begin, end), text in sorted(found, reverse=True):
        row = f"{row[:begin]}{text}{row[end:]}"
    return row


def _rewritten(
    piece: Piece, row: str, writes: Callable[[Piece, str], str]
) -> Iterator[tuple[Span, str]]:
    text = writes(piece, row)
    if text:
        yield piece.span, text
        return
    for part in piece.parts:
        yield from _rewritten(part, row, writes)
