"""Integrals, and sums and products over an index."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable

from polhode.judge.latex._columns import ColumnReader
from polhode.judge.latex._derivatives import measured
from polhode.judge.latex._tree import (
    Differential,
    Integral,
    Name,
    Node,
    Span,
    Summation,
    walk,
)

_Limits = tuple[Node | None, Node | None]

LONGEST_CHAIN = 12  # of slashes, signs, entries of a diagonal, or products between vectors


class IntegralReader(ColumnReader):
    """Reads integrals with their differentials, and sums with their indices."""

    @abstractmethod
    def _product(self) -> Node:
        """Factors side by side."""

    @abstractmethod
    def _chain(self) -> Node:
        """Products with the sign of one between them."""

    @abstractmethod
    def _chained(self, left: Node, start: int) -> Node:
        """The first product with all that is multiplied on."""

    @abstractmethod
    def _multiplied(self, read: Callable[[], Node]) -> Node:
        """What stands behind a sign of multiplication."""

    def _integral(self) -> Node:
        """Integral signs with their limits, and the quantity with a differential for each.

        The last sign belongs to the first differential. Of ``\\iint`` dA may be the only one.
        """
        start = self._start
        signs: list[_Limits | None] = []
        with self._deeper():
            while self._token.kind == "integral":
                count = int(self._take().text)
                signs.append(self._limits())
                signs += [None] * (count - 1)
                if len(signs) > LONGEST_CHAIN:
                    raise self._unexpected(f"at most {LONGEST_CHAIN} integrals in a row")
            of_start = self._start
            of = self._product()
            if measured(of, of.span) is None:
                of = self._chained(of, of_start)
        span = self._since(start)
        return self._integrated(of, signs, span)

    def _integrated(self, of: Node, signs: list[_Limits | None], span: Span) -> Node:
        variables: list[Node] = []
        while len(variables) < len(signs) and (found := measured(of, of.span)) is not None:
            of, by = found
            variables.append(by)
        while None in signs and len(signs) > len(variables):
            signs.remove(None)
        if not variables or len(variables) < len(signs):
            is_path = any(isinstance(piece, Differential) for piece in walk(of))
            problem = (
                "an integral along a path" if is_path else "an integral without a differential"
            )
            raise self._refused(span, problem, "the variable of integration, as in dx")
        for by in variables:
            of = Integral(of, by, *(signs.pop() or (None, None)), span=span)
        if any(isinstance(piece, Differential) and piece.sign == "d" for piece in walk(of)):
            problem = "an integral with a second differential"
            raise self._refused(span, problem, "one for each integral sign")
        return of

    def _limits(self) -> _Limits:
        """What stands below and above a sign; below alone, perhaps a word for a region."""
        limits: dict[str, Node] = {}
        while self._at("_", "^"):
            mark = self._take()
            self._refuse_second(mark.text in limits, mark)
            inside = self._inside()
            if inside[0].kind == "words" and len(inside) == 1 and inside[0].text.isalpha():
                limits[mark.text] = Name(inside[0].text, span=inside[0].span)
                self._pass(inside)
            else:
                limits[mark.text] = self._argument()
        return limits.get("_"), limits.get("^")

    def _summation(self) -> Node:
        r"""A sum or product over its indices, up to the next plus or minus sign."""
        token = self._take()
        start = token.span[0]
        indices: list[Name | None] = []
        lower = upper = None
        with self._deeper():
            while self._at("_", "^"):
                mark = self._take()
                if mark.text == "^":
                    self._refuse_second(upper is not None, mark)
                    upper = self._argument()
                else:
                    self._refuse_second(bool(indices), mark)
                    indices, lower = self._indices()
            of = self._multiplied(self._chain)
        span = self._since(start)
        if len(set(indices)) < len(indices):
            raise self._refused(span, "an index named twice under one sign", "each index once")
        for index in reversed(indices or [None]):
            of = Summation(of, index, lower, upper, token.text, span=span)
        return of

    def _indices(self) -> tuple[list[Name | None], Node | None]:
        """The indices under a Σ, and the value at which they begin, if it is stated."""
        if not self._at("{"):
            return [self._index()], None
        with self._within():
            indices: list[Name | None] = [self._index()]
            while self._took(",") or self._token.kind == "letter":
                indices.append(self._index())
            lower = None
            if self._token.kind == "sign":
                if self._token.text != "=":
                    raise self._unexpected("an index with its range, as in i = 1")
                self._take()
                lower = self._sum()
        return indices, lower

    def _index(self) -> Name:
        if self._token.kind != "letter":
            raise self._unexpected("the letter of an index")
        token = self._take()
        return Name(token.text, span=token.span)
