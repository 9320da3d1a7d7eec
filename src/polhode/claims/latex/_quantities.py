"""Quantities and chains of relations read: sums of products, cases, columns."""

from __future__ import annotations

from collections.abc import Callable

from polhode.claims.latex import _lexicon as lexicon
from polhode.claims.latex._differentials import derivative, product
from polhode.claims.latex._factors import FactorReader
from polhode.claims.latex._tree import (
    Case,
    Cases,
    ComponentList,
    Cross,
    Dot,
    Negative,
    Node,
    Number,
    PlusMinus,
    Quotient,
    Relation,
    Sum,
)

LONGEST_CHAIN = 40  # of slashes, or of products between vectors, one after another

_ADDING = ("+", "-", "±", "∓")
_MULTIPLYING = ("×", "·", "*")


class QuantityReader(FactorReader):
    """Reads a whole quantity, or a chain of relations between quantities."""

    def _relation(self) -> Relation:
        """Quantities with signs between; one quantity alone has none."""
        start = self._start
        sides, signs = [self._side()], []
        while self._at_sign():
            signs.append(self._take().text)
            sides.append(self._side())
        return Relation(tuple(sides), tuple(signs), span=self._since(start))

    def _side(self) -> Node:
        """One side of a relation."""
        return self._sum()

    def _at_sign(self) -> bool:
        return self._token.kind == "sign"

    def _sum(self) -> Node:
        self._skip_breaks()
        start = self._start
        terms = [self._term()]
        while self._continues(_ADDING):
            terms.append(self._term())
        return terms[0] if len(terms) == 1 else Sum(tuple(terms), span=self._since(start))

    def _term(self) -> Node:
        """A product with the sign before it; a plus sign says nothing."""
        start = self._start
        if not self._at(*_ADDING):
            return self._cross()
        sign = self._take().text
        self._skip_breaks()
        with self._deeper():
            of = self._behind_sign(self._term)
        span = self._since(start)
        if sign == "+":
            return of
        return Negative(of, span=span) if sign == "-" else PlusMinus(of, sign, span=span)

    def _behind_sign(self, read: Callable[[], Node]) -> Node:
        """What stands behind a sign; a further sign counts as if it stood in a bracket."""
        if not self._at(*_ADDING):
            return read()
        with self._deeper():
            return read()

    def _cross(self) -> Node:
        r"""Products with ``\times`` or ``\cdot`` between them, from left to right."""
        start = self._start
        left = self._product()
        for _ in range(LONGEST_CHAIN):
            if not self._continues(_MULTIPLYING):
                return left
            kind = Cross if self._take().text == "×" else Dot
            self._skip_breaks()
            left = kind(left, self._multiplied(), span=self._since(start))
        raise self._unexpected(f"at most {LONGEST_CHAIN} products in a row")

    def _multiplied(self) -> Node:
        r"""What stands behind a ``\times``: a product, even with a minus sign."""
        start = self._start
        if not self._took("-"):
            return self._product()
        with self._deeper():
            of = self._behind_sign(self._multiplied)
        return Negative(of, span=self._since(start))

    def _product(self) -> Node:
        start = self._start
        factors = self._beside([self._factor()])
        for _ in range(LONGEST_CHAIN):
            if not self._took("/"):
                return product(factors, self._since(start))
            factors = self._beside([self._over_slash(product(factors, self._since(start)), start)])
        raise self._unexpected(f"at most {LONGEST_CHAIN} slashes in a row")

    def _beside(self, factors: list[Node], ends: Callable[[], bool] = lambda: False) -> list[Node]:
        """The factors and all that stand beside them."""
        while self._starts_factor() and not ends():
            if isinstance(factors[-1], Number) and self._token.kind == "number":
                raise self._refused(self._token.span, "two numbers side by side", "one number")
            factors.append(self._factor())
        return factors

    def _over_slash(self, above: Node, start: int) -> Node:
        """All before a slash over all behind it, but a vector is never below.

        Texts print g/3a for g over 3a, and F ẑ/2 or v/r ẑ without brackets.
        """
        if self._at_differential():
            return self._over_differentials(above, start)
        below_start = self._start
        factors = self._beside([self._factor()], self._starts_vector)
        below = product(factors, self._since(below_start))
        return Quotient(above, below, span=self._since(start))

    def _over_differentials(self, above: Node, start: int) -> Node:
        below_start = self._start
        factors = [self._factor()]
        while self._at_differential():
            factors.append(self._factor())
        below = product(factors, self._since(below_start))
        span = self._since(start)
        return derivative(above, below, span) or Quotient(above, below, span=span)

    def _starts_vector(self) -> bool:
        return self._token.kind == "decoration" and self._token.text in ("hat", "vector")

    def _skip_breaks(self) -> None:
        """Over a new line before a quantity, where lines are not entries."""
        while self._around == "" and (self._token.kind in ("row", "gap") or self._at("&")):
            self._take()

    def _continues(self, operators: tuple[str, ...]) -> bool:
        """Whether an operator goes on with this quantity, perhaps on the next line."""
        place = self._place
        while self._around == "" and self._is_break(place):
            place += 1
        if not self._tokens[place].is_mark(*operators):
            return False
        is_minus = self._tokens[place].is_mark("-")
        if is_minus and self._crosses_row(place) and not self._goes_on(place):
            return False
        self._place = place
        return True

    def _is_break(self, place: int) -> bool:
        return self._tokens[place].kind in ("row", "gap") or self._tokens[place].is_mark("&")

    def _crosses_row(self, place: int) -> bool:
        return any(token.kind == "row" for token in self._tokens[self._place : place])

    def _goes_on(self, place: int) -> bool:
        """Whether the line that begins with a minus sign goes on with the one before.

        It does where the columns say so, and where it relates nothing itself.
        """
        if self._tokens[place - 1].is_mark("&"):
            return True
        while self._tokens[place].kind not in ("row", "close"):
            if self._tokens[place].kind == "sign":
                return False
            place = self._partner.get(place, place) + 1
        return True

    def _environment(self) -> Node:
        if self._token.text in lexicon.CASES:
            return self._cases()
        if self._token.text not in lexicon.STACKS:
            raise self._unexpected("cases, a column or a display")
        start = self._start
        breaks = set()
        with self._within():
            entries = [self._sum()]
            while self._token.kind == "row" or self._at("&"):
                breaks.add(self._take().text)
                entries.append(self._sum())
        span = self._since(start)
        if len(breaks) > 1:
            raise self._refused(span, "a matrix", "one row or one column")
        return ComponentList(tuple(entries), span=span)

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
