r"""A corrected formula in the author's own spelling: the source with the changed places patched.

Only what differs is written anew, so that \tfrac, brackets and the order of factors stay as they
were printed. What comes out is read back; where it does not say what was meant, a larger piece is
written anew.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import gcd, prod
from typing import Any, cast

from polhode.base import PolhodeError
from polhode.judge.latex import read_latex, write_latex
from polhode.judge.latex._tree import (
    Call,
    Derivative,
    Differential,
    Dots,
    Name,
    Negative,
    Node,
    Number,
    Piece,
    Power,
    Product,
    Quotient,
    Relation,
    Statement,
    Sum,
    mapped,
    walk,
)
from polhode.judge.repair._places import ONE, ZERO, over, tidied, times

_PLACEHOLDER = "Q"
_HELD = re.compile(rf"{_PLACEHOLDER}_\{{(\d+)\}}")
_BEFORE = re.compile(r"(?:[-+]|\\[,;:! ]|\s|\\quad|\\qquad)*\Z")
_OPENING = re.compile(r"\\(?:left|[bB]igg?l?)\s*\Z")  # before a bracket, which spans begin with
_FRACTION = re.compile(r"\\[tdc]?frac")
_DOLLARS = re.compile(r"\$+|\\n(?![A-Za-z])")  # \n: a line end of a transcript
_TURNED = {"<": ">", ">": "<", r"\l": r"\g", r"\g": r"\l", "≤": "≥", "≥": "≤"}
_TURNING = re.compile(r"[<>≤≥]|\\[lg](?=e|eq|eqslant|eqq|t)")
_GAPS = re.compile(r"\s+")
#: Before an argument that may be a single character without braces, as in \frac35.
_BARE_ARGUMENT = re.compile(r"\\[td]?frac *(?:[0-9A-Za-z]|\{[^{}]*\})?\Z")
_STOP = re.compile(r"(?:[\s.,;:]|\\[,;! ]|\\q?quad)+\Z")


def spelled(latex: str, statement: Statement, corrected: Statement) -> str:
    """The corrected statement as LaTeX.

    Args:
        latex: the formula as printed.
        statement: its tree.
        corrected: the tree with some changes.
    """
    printed = {piece for piece in walk(statement) if isinstance(piece, Quotient)}
    corrected = _in_lowest_terms(_with_plain_fractions(corrected), printed)
    meant = _tidied(corrected)
    author = _Author(latex, statement)
    for found in author.candidates(_trimmed(statement, corrected)):
        if _says(found, meant):
            return found
    return write_latex(meant)


def _with_plain_fractions(piece: Any) -> Any:
    """The piece with 5/7 for a fraction (25/7)/5 of numbers."""
    piece = mapped(piece, _with_plain_fractions)
    match piece:
        case Quotient(Quotient() as above, below) | Quotient(above, Quotient() as below):
            return over(above, below)
    return piece


def _in_lowest_terms(piece: Any, printed: Collection[Piece]) -> Any:
    """The piece with mga for 3mga/3 and 5I/8 for 10I/16; fractions that were printed stay."""
    if piece in printed:
        return piece
    piece = mapped(piece, lambda part: _in_lowest_terms(part, printed))
    if not isinstance(piece, Quotient):
        return piece
    above: list[Node] = []
    below: list[Node] = [*_factors(piece.below)]
    for factor in _factors(piece.above):
        if isinstance(factor, Quotient) and factor not in printed:
            above += _factors(factor.above)
            below += _factors(factor.below)
        else:
            above.append(factor)
    sizes = [prod([_whole(factor) for factor in side]) for side in (above, below)]
    if gcd(*sizes) < 2:
        return piece
    value = Fraction(*sizes)
    numbers = (str(value.numerator), str(value.denominator))
    rests = ([factor for factor in side if _whole(factor) == 1] for side in (above, below))
    return over(*(times(Number(n), *rest) for n, rest in zip(numbers, rests, strict=True)))


def _factors(side: Node) -> tuple[Node, ...]:
    return side.factors if isinstance(side, Product) else (side,)


def _whole(node: Node) -> int:
    """The value of a whole number; 1 for anything else."""
    return int(node.text) or 1 if isinstance(node, Number) and node.text.isdigit() else 1


def _says(latex: str, meant: Statement) -> bool:
    """Whether a text is read as the statement that is meant."""
    try:
        found = _tidied(read_latex(latex))
    except (PolhodeError, ArithmeticError):
        return False
    same = (found.relations, found.conditions, found.assumptions)
    return bool(same == (meant.relations, meant.conditions, meant.assumptions))


def _tidied(statement: Statement) -> Statement:
    found: Any = tidied(statement)
    return cast(Statement, found)


def _trimmed(old: Any, new: Any) -> Any:
    """The new piece without the ones and zeros that a change has left, and else as it is."""
    if old == new:
        return old
    if _alike(old, new):
        parts = iter([_trimmed(a, b) for a, b in zip(old.parts, new.parts, strict=True)])
        new = mapped(new, lambda _: next(parts))
    left = any(part in (ONE, ZERO) and part not in old.parts for part in new.parts)
    return tidied(new) if left else new


@dataclass(frozen=True)
class _Patch:
    """A stretch of the source, and what is to stand there."""

    start: int
    end: int
    text: str


@dataclass(frozen=True, eq=False)
class _Author:
    """A printed formula, and how its author spells things."""

    latex: str
    statement: Statement

    def candidates(self, corrected: Statement) -> Iterator[str]:
        """The source with the smallest patches first, then with whole sides written anew."""
        whole = self._patched(self._patches(self.statement, corrected))
        yield from (_plain(whole), whole)
        sides = []
        for old, new in zip(self.statement.relations, corrected.relations, strict=True):
            for before, after in zip(old.sides, new.sides, strict=True):
                if before != after:
                    sides.append(_Patch(*before.span, write_latex(tidied(after))))
        whole = self._patched(sides)
        yield from (_plain(whole), whole)

    def _patched(self, patches: Sequence[_Patch]) -> str:
        text = self.latex
        for patch in sorted(patches, key=lambda p: (p.start, p.end), reverse=True):
            new = patch.text
            before, after = text[: patch.start], text[patch.end :]
            if re.search(r"\\[A-Za-z]+\Z", before) and new[:1].isalpha():
                before += " "
            if re.search(r"\\[A-Za-z]+\Z", new) and after[:1].isalpha():
                new += " "
            if not new and before.endswith("{"):
                after = after.lstrip(" ")
            if len(new) > 1 and _BARE_ARGUMENT.search(before):
                new = f"{{{new}}}"
            text = before + new + after
        return text.strip()

    # -- what differs ----------------------------------------------------------------------------

    def _patches(self, old: Piece, new: Piece, end: int | None = None) -> list[_Patch]:
        """The patches that turn a piece into another; `end` cuts its span short."""
        if old == new:
            return []
        stop = old.span[1] if end is None else end
        ways = (self._of_relations, self._of_differentials, self._of_signs, self._of_sums)
        for way in (*ways, self._of_powers, self._of_products):
            found = way(old, new, stop)
            if found is not None:
                return found
        if _alike(old, new):
            pairs = zip(old.parts, new.parts, strict=True)
            return [patch for a, b in pairs for patch in self._patches(a, b)]
        return [_Patch(old.span[0], stop, self._text(new))]

    def _of_sums(self, old: Piece, new: Piece, stop: int) -> list[_Patch] | None:
        """Changed terms, or terms left out or added at the end."""
        if not isinstance(old, Sum):
            return None
        terms = old.terms
        others = list(new.terms) if isinstance(new, Sum) else [new] if isinstance(new, Node) else []
        added: list[Node] = []
        if tuple(others[: len(terms)]) == terms:
            added = others[len(terms) :]
        for i, term in enumerate(terms):
            if len(others) < len(terms) and (i == len(others) or others[i] != term):
                others.insert(i, ZERO)
        if len(others) - len(added) != len(terms):
            return None
        pairs = zip(terms, others, strict=False)
        left = next((i for i, other in enumerate(others) if other != ZERO), 0)  # the first term
        found = [p for i, (a, b) in enumerate(pairs) for p in self._of_term(i, terms, a, b, left)]
        for term in added:
            sign, bare = ("-", term.of) if isinstance(term, Negative) else ("+", term)
            found.append(_Patch(stop, stop, f" {sign} {self._text(bare)}"))
        return found

    def _of_relations(self, old: Piece, new: Piece, stop: int) -> list[_Patch] | None:
        """An inequality turned round."""
        if not isinstance(old, Relation) or not isinstance(new, Relation) or old.sides != new.sides:
            return None
        found = []
        for k, (one, other) in enumerate(zip(old.signs, new.signs, strict=True)):
            between = old.sides[k].span[1], old.sides[k + 1].span[0]
            text = self.latex[slice(*between)]
            if one != other:
                turned = _TURNING.sub(lambda found: _TURNED[found[0]], text)
                found.append(_Patch(*between, turned))
        return found

    def _of_differentials(self, old: Piece, new: Piece, stop: int) -> list[_Patch] | None:
        """The d that a derivative has lost."""
        match old, new:
            case Quotient(above, Differential(by)), Derivative(of, variable) if (above, by) == (
                of,
                variable,
            ) and _FRACTION.match(self.latex, old.span[0]):
                return [_Patch(above.span[0], above.span[0], "d")]
        return None

    def _of_signs(self, old: Piece, new: Piece, stop: int) -> list[_Patch] | None:
        start = old.span[0]
        match old, new:
            case Negative(of), _ if of == new:
                sign = self.latex.index("-", start)
                return [_Patch(sign, sign + 1, "")]
            case Sum(), Negative(Sum() as of):
                opened, closed = _Patch(start, start, r"-\left("), _Patch(stop, stop, r"\right)")
                return [opened, *self._patches(old, of), closed]
            case _, Negative(of) if old == of:
                start -= len(_last(_OPENING, self.latex[:start]))
                before = self.latex[:start].rstrip()
                plus = len(before) - 1 if before.endswith("+") else start
                return [_Patch(plus, start, "-")]
        return None

    def _of_powers(self, old: Piece, new: Piece, stop: int) -> list[_Patch] | None:
        """Changed bases, functions and letters under dots, whose spans overlap with exponents."""
        match old, new:
            case Power(base, exponent), Power(root, power):
                hat = self.latex.rfind("^", base.span[0], exponent.span[0])
                behind = not isinstance(base, Call) and hat > 0
                cut = hat if behind else base.span[1]
                return [*self._patches(base, root, cut), *self._patches(exponent, power)]
            case Call(function, angle), Call(name, its_angle) if angle == its_angle:
                at = old.span[0]
                if self.latex.startswith(f"\\{function}", at):
                    return [_Patch(at, at + 1 + len(function), f"\\{name}")]
            case Call(_, angle), Call(_, Sum()) if not isinstance(angle, Sum):
                return [_Patch(old.span[0], stop, self._text(new))]  # with a bracket
            case Dots(of, dots), Dots(letter, count) if dots == count:
                return self._patches(of, letter, stop)
        return None

    def _of_products(self, old: Piece, new: Piece, stop: int) -> list[_Patch] | None:
        """One factor more or less."""
        if not (isinstance(old, Product) and isinstance(new, Node)):
            return None
        factors = old.factors
        others = new.factors if isinstance(new, Product) else (new,)
        if len(others) == len(factors) + 1:
            patch = self._inserted(factors, others)
            return None if patch is None else [patch]
        if len(others) == len(factors) - 1:
            for i, factor in enumerate(factors):
                if (*factors[:i], *factors[i + 1 :]) == tuple(others):
                    return [_Patch(*factor.span, "")]
        return None

    def _of_term(
        self, i: int, terms: Sequence[Node], old: Node, new: Node, left: int
    ) -> list[_Patch]:
        """The patches of one term of a sum, with the sign before it unless it becomes the first."""
        if old == new:
            return []
        first, last = (terms[i].span[0], terms[i].span[1])
        operator = first
        if i and not isinstance(old, Negative):
            operator = first - len(_last(_BEFORE, self.latex[:first]))
        if new == ZERO:
            if i:
                return [_Patch(operator, last, "")]
            following = terms[1]
            between = following.span[0] - last
            skipped = 0 if isinstance(following, Negative) else between
            return [_Patch(first, last + skipped, "")]
        if i and isinstance(new, Negative) and not isinstance(old, Negative):
            rest = self._patches(old, new.of)
            plus = self.latex.find("+", operator, first)
            if plus >= 0:
                return [_Patch(plus, plus + 1, "-"), *rest]
        if isinstance(old, Negative) and not isinstance(new, Negative):
            minus = self.latex.index("-", first)
            return [_Patch(minus, minus + 1, "+" if i > left else ""), *self._patches(old.of, new)]
        return self._patches(old, new)

    def _inserted(self, factors: Sequence[Node], others: Sequence[Node]) -> _Patch | None:
        """One factor more in a product."""
        for i, new in enumerate(others):
            if (*others[:i], *others[i + 1 :]) == tuple(factors):
                text = self._text(new)
                if isinstance(new, Sum):
                    text = rf"\left({text}\right)"
                if i == len(factors):
                    at = factors[-1].span[1]
                    return _Patch(at, at, " " + text)
                at = factors[i].span[0]
                return _Patch(at, at, text + " ")
        return None

    # -- new pieces, of pieces the author has written ---------------------------------------------

    def _text(self, new: Piece) -> str:
        """A new piece, with all that the author has written somewhere in the author's spelling."""
        written: list[str] = []

        def held(piece: Piece) -> Piece:
            if isinstance(piece, Power) and isinstance(piece.base, Call):
                function = mapped(piece.base, held)  # sin² θ, whose square is no part of sin θ
                return replace(piece, base=function)
            if piece in self._words and isinstance(piece, Node):
                written.append(self._words[piece])
                return Name(_PLACEHOLDER, str(len(written) - 1))
            return mapped(piece, held)

        text = write_latex(held(tidied(new)))
        for _ in range(2):
            text = _HELD.sub(lambda found: written[int(found[1])], text)
        for mark in "^_":
            if re.search(rf"\{mark}\d", self.latex):
                text = re.sub(rf"\{mark}\{{(\d)\}}", rf"{mark}\1", text)
        return text

    @cached_property
    def _words(self) -> dict[Piece, str]:
        """How the author spells letters, functions and fractions."""
        found: dict[Piece, str] = {}
        for piece in walk(self.statement):
            text = self.latex[slice(*piece.span)]
            fraction = isinstance(piece, Quotient) and _FRACTION.match(text)
            letter = isinstance(piece, Name | Dots | Call) and "^" not in text
            if fraction or letter or isinstance(piece, Product):
                found.setdefault(piece, text)
        return {p: text for p, text in found.items() if _is_read_as(text, p)}


def _is_read_as(text: str, piece: Piece) -> bool:
    try:
        (relation,) = read_latex(text).relations
    except (PolhodeError, ArithmeticError, ValueError):
        return False
    return relation.sides == (piece,)


def _alike(old: Piece, new: Piece) -> bool:
    """Whether two pieces differ only in their parts, each of which has a place in the source."""
    if type(old) is not type(new) or len(old.parts) != len(new.parts):
        return False
    parts = iter(new.parts)
    if mapped(old, lambda _: next(parts)) != new:
        return False
    return all(part.span[1] > part.span[0] for part in old.parts)


def _last(pattern: re.Pattern[str], text: str) -> str:
    found = pattern.search(text)
    return found[0] if found else ""


def _plain(latex: str) -> str:
    """A formula without dollar signs, line ends of a transcript, and the stop behind it."""
    return _STOP.sub("", _GAPS.sub(" ", _DOLLARS.sub(" ", latex))).strip()
