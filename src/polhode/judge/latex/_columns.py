"""Columns, matrices and cases: what stands in rows."""

from __future__ import annotations

from abc import abstractmethod

from polhode.judge.latex import _lexicon as lexicon
from polhode.judge.latex._letters import LetterReader
from polhode.judge.latex._tokens import Token
from polhode.judge.latex._tree import (
    Case,
    Cases,
    ComponentList,
    Magnitude,
    Node,
    Number,
    Omitted,
    PrintedMatrix,
    Relation,
)

_EMPTY = Number("0")  # an empty place in a matrix


class ColumnReader(LetterReader):
    """Reads environments with rows."""

    @abstractmethod
    def _sum(self) -> Node:
        """Terms with signs between them."""

    @abstractmethod
    def _relation(self) -> Relation:
        """Quantities with signs between them; a single quantity has none."""

    def _environment(self) -> Node:
        if self._token.text in lexicon.CASES:
            return self._cases()
        if self._token.text not in lexicon.STACKS:
            raise self._unexpected("cases, a matrix or a display")
        is_determinant = self._token.text in lexicon.DETERMINANTS
        matrix = self._matrix()
        return Magnitude(matrix, span=matrix.span) if is_determinant else matrix

    def _matrix(self) -> Node:
        """A column, or rows of equal length, in which empty places are zeros."""
        start = self._start
        rows: list[list[Node]] = [[]]
        with self._within():
            rows[0].append(self._cell())
            while self._token.kind == "row" or self._at("&"):
                if self._take().kind == "row":
                    rows.append([])
                rows[-1].append(self._cell())
        # A row without anything in it is only space: a zero that is printed is another object.
        printed = [row for row in rows if len(row) > 1 or row[0] is not _EMPTY]
        rows = printed or rows[:1]
        span = self._since(start)
        widths = {len(row) for row in rows}
        if len(widths) > 1:
            lengths = " and ".join(str(width) for width in sorted(widths))
            raise self._refused(span, f"a matrix with rows of {lengths} entries", "equal rows")
        if widths == {1}:
            self._columns.add(span)
            return ComponentList(tuple(row[0] for row in rows), span=span)
        return PrintedMatrix(tuple(ComponentList(tuple(row)) for row in rows), span=span)

    def _cell(self) -> Node:
        if self._ends_cell(self._token):
            return _EMPTY
        if self._at("·", ".") and self._ends_cell(self._next):
            return Omitted(span=self._take().span)  # a dot for one that is left out
        return self._sum()

    def _ends_cell(self, token: Token) -> bool:
        return token.kind in ("row", "end") or token.is_mark("&")

    def _cases(self) -> Node:
        start = self._start
        with self._within():
            cases = [self._case()]
            while self._token.kind == "row":
                self._take()
                if self._token.kind != "end":
                    cases.append(self._case())
        return Cases(tuple(cases), span=self._since(start))

    def _case(self) -> Case:
        start = self._start
        value = self._sum()
        conditions: list[Relation] = []
        words: list[str] = []
        while self._token.kind not in ("row", "end"):
            if self._token.kind == "words":
                words.append(self._take().text)
            elif self._at("&", ",", ";", "."):
                self._take()
            else:
                conditions.append(self._relation())
        return Case(value, tuple(conditions), " ".join(words), span=self._since(start))
