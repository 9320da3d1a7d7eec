"""Quantities from the top down: sums, chains of products, and slashes."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from polhode.judge.latex._brackets import Paired
from polhode.judge.latex._derivatives import Operator
from polhode.judge.latex._factors import FactorReader
from polhode.judge.latex._integrals import LONGEST_CHAIN
from polhode.judge.latex._slashes import Slash
from polhode.judge.latex._tree import (
    Cross,
    Dot,
    Negative,
    Node,
    Number,
    Outer,
    PlusMinus,
    Sum,
    factors_of,
    product,
)

_ADDING = ("+", "-", "±", "∓")
_MULTIPLYING = ("×", "·", "*", "⊗")
_MULTIPLIED: dict[str, type[Cross | Dot | Outer]] = {"×": Cross, "⊗": Outer}


class QuantityReader(FactorReader):
    """Reads sums, chains and products of factors."""

    def __init__(self, source: str, paired: Paired) -> None:
        super().__init__(source, paired)
        self._begins = 0  # where the relation begins that is read

    # -- sums, chains and products --------------------------------------------------------------

    def _sum(self) -> Node:
        self._skip_breaks()
        start = self._start
        terms = [self._term()]
        while self._continues(_ADDING):
            terms.append(self._term())
        return terms[0] if len(terms) == 1 else Sum(tuple(terms), span=self._since(start))

    def _term(self) -> Node:
        """A chain with the sign before it; a plus sign is dropped."""
        start = self._start
        if not self._at(*_ADDING):
            return self._chain()
        sign = self._take().text
        self._skip_breaks()
        with self._deeper():
            of = self._behind_sign(self._term)
        span = self._since(start)
        if sign == "+":
            return of
        return Negative(of, span=span) if sign == "-" else PlusMinus(of, sign, span=span)

    def _behind_sign(self, read: Callable[[], Node]) -> Node:
        """The quantity behind a sign; a further sign counts as a level of nesting."""
        if not self._at(*_ADDING):
            return read()
        before = self._tokens[max(0, self._place - LONGEST_CHAIN) : self._place]
        if len(before) == LONGEST_CHAIN and all(token.is_mark(*_ADDING) for token in before):
            raise self._unexpected(f"at most {LONGEST_CHAIN} signs in a row")
        with self._deeper():
            return read()

    def _chain(self) -> Node:
        r"""Products with ``\times`` or ``\cdot`` between them; a·b×c is a·(b×c)."""
        start = self._start
        return self._chained(self._product(), start)

    def _chained(self, left: Node, start: int, signs: tuple[str, ...] = _MULTIPLYING) -> Node:
        """The first product with all that is multiplied on."""
        for _ in range(LONGEST_CHAIN):
            if not self._continues(signs):
                return left
            kind = _MULTIPLIED.get(self._take().text, Dot)
            self._skip_breaks()
            right_start = self._start
            right = self._multiplied(self._product)
            if kind is Dot:
                right = self._chained(right, right_start, ("×",))
            left = kind(left, right, span=self._since(start))
        raise self._unexpected(f"at most {LONGEST_CHAIN} products in a row")

    def _multiplied(self, read: Callable[[], Node]) -> Node:
        r"""What stands behind a ``\times`` or a ``\sum``, even with a minus sign."""
        start = self._start
        if not self._took("-"):
            return read()
        with self._deeper():
            of = self._behind_sign(lambda: self._multiplied(read))
        return Negative(of, span=self._since(start))

    def _product(self) -> Node:
        start = self._start
        first = self._factor()
        for _ in range(LONGEST_CHAIN):
            above = product([first, *self._beside(first)], self._since(start))
            if not self._at("/"):
                return above
            first = self._over_slash(above, start)
        raise self._unexpected(f"at most {LONGEST_CHAIN} slashes in a row")

    def _beside(self, before: Node, ends: Callable[[], bool] = lambda: False) -> Iterator[Node]:
        """The factors that stand beside the one before."""
        while self._starts_factor() and not ends():
            if isinstance(before, Number) and self._token.kind == "number":
                raise self._refused(self._token.span, "two numbers side by side", "one number")
            before = self._factor()
            yield before

    def _over_slash(self, above: Node, start: int) -> Node:
        """All factors before a slash over all behind it, up to a vector.

        Texts print g/3a for g over 3a, and v/r ẑ for (v/r) ẑ: nothing is divided by a vector.

        Raises `UnclearSlashError` where writers differ in what the slash divides.
        """
        place = self._take().span[0]
        begin = self._start
        if self._at_differential():
            first = self._factor()
            factors = [first, *self._beside(first, lambda: not self._at_differential())]
        else:
            factors, ends = [self._factor()], [self._since(begin)[1]]
            for factor in self._beside(factors[0], self._starts_vector):
                factors.append(factor)
                ends.append(self._since(begin)[1])
            slash = Slash(self._source, start, place, factors_of(above), factors, ends)
            slash.refuse_unclear()
        over = self._over(above, product(factors, self._since(begin)), start)
        return self._with_operand(over) if isinstance(over, Operator) else over

    def _starts_vector(self) -> bool:
        return self._token.kind == "decoration" and self._token.text in ("hat", "vector")

    # -- breaks between the lines of a display --------------------------------------------------

    def _skip_breaks(self) -> None:
        """Skip a new line before a quantity, where lines are not entries."""
        while self._around == "" and (self._token.kind in ("row", "gap") or self._at("&")):
            self._take()

    def _past_breaks(self, place: int) -> int:
        while self._tokens[place].kind in ("row", "gap") or self._tokens[place].is_mark("&"):
            place += 1
        return place

    def _continues(self, operators: tuple[str, ...]) -> bool:
        """Whether an operator continues this quantity, perhaps on the next line; go there."""
        place = self._past_breaks(self._place) if self._around == "" else self._place
        if not self._tokens[place].is_mark(*operators):
            return False
        if self._tokens[place].is_mark("-") and not self._subtracts(place):
            return False
        self._place = place
        return True

    def _subtracts(self, place: int) -> bool:
        """Whether a minus sign subtracts, rather than begins a new statement on the next line.

        It subtracts if a column mark stands before it, if the relation before it has no sign yet,
        or if neither its line nor those that continue it have one.
        """
        is_new_line = any(token.kind == "row" for token in self._tokens[self._place : place])
        if not is_new_line or self._tokens[place - 1].is_mark("&"):
            return True
        if not self._relates(self._begins, place):
            return True
        end = place
        while self._tokens[end].is_mark(*_ADDING):
            while self._tokens[end].kind not in ("row", "close"):
                end = self._partner.get(end, end) + 1
            if self._relates(place, end):
                return False
            end = self._past_breaks(end)
        return True

    def _relates(self, begin: int, end: int) -> bool:
        """Whether the sign of a relation stands between two places, outside brackets."""
        while begin < end:
            if self._tokens[begin].kind == "sign":
                return True
            begin = self._partner.get(begin, begin) + 1
        return False
