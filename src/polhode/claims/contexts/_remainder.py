"""What is left of a claim on small quantities, and the order to which it has to vanish."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import Expr, Vector
from polhode.base import NumericError
from polhode.claims.contexts._scaling import leading_orders, scaled, stated_order, weights
from polhode.claims.latex._tree import Node
from polhode.claims.meaning._meaning import Side
from polhode.claims.meaning._relations import PrintedRelation, ScalarRelation, Term, triad_of
from polhode.claims.states._bound_claim import EQUALITY, BoundClaim
from polhode.claims.states._claim_domain import ClaimDomain

_HIGHEST = 6
_LIMIT = 12  # order beyond which nothing is expanded
_LOWEST = -4


@dataclass(frozen=True)
class PrintedOrders:
    """The orders of the terms that one component of a claim prints.

    Attributes:
        kept: of those that are to be right: all on the right side, and all where one side is zero.
        left_aside: the highest of those on the left side that may have been left out on the right.
    """

    kept: tuple[int, ...] = ()
    left_aside: int = _LOWEST


@dataclass(frozen=True)
class _Terms:
    """How many terms there are, and the orders of those that contribute."""

    count: int
    orders: tuple[int, ...]

    @property
    def several(self) -> tuple[int, ...]:
        """The orders, where there is more than one term to cancel."""
        return self.orders if self.count > 1 else ()


@dataclass(frozen=True)
class Remainder:
    """What is left of one component: as a power series in the smallness.

    Attributes:
        component: which.
        states: where it is asked to hold.
        left: its left side there, scaled.
        right: its right side.
        positive: what is taken as positive.
        asked: the claim.
        is_root: whether the left side is a root of the relation between steady speeds.
    """

    component: ScalarRelation
    states: ClaimDomain
    left: Expr
    right: Expr
    positive: tuple[Expr, ...]
    asked: BoundClaim
    is_root: bool = False

    @cached_property
    def orders(self) -> dict[int, Expr]:
        """The first coefficient that is not zero, by its order."""
        return self.series(self.left - self.right, self.highest)

    @cached_property
    def highest(self) -> int:
        """The order up to which it is expanded: no term is printed beyond."""
        if self.left == self.right:
            return _HIGHEST
        printed = self.printed
        return max((_HIGHEST, self.stated, printed.left_aside, *printed.kept))

    def series(self, expression: Expr, highest: int = _HIGHEST) -> dict[int, Expr]:
        """The first coefficient that does not vanish, by its order, with all signs told."""
        lowest = _LOWEST * max(weights(self.asked.small))
        return leading_orders(expression, lowest, highest, self.positive)

    @cached_property
    def stated(self) -> int:
        """The order that the claim is to be true to by what is said of it, if only by ≈."""
        said = stated_order(self.asked.small)
        return self._leading if said is None else said

    @cached_property
    def _leading(self) -> int:
        """Order of the larger side, or of the largest of the terms that are to cancel."""
        if (not self.left or not self.right) and self.printed.kept:
            return min(self.printed.kept)
        both = map(self.series, (self.left, self.right))
        return min((order for orders in both for order in orders), default=0)

    def objection(self, order: int) -> str:
        """Why it must not differ from zero at an order; empty where it may."""
        if order <= self.stated:
            return f"the sides differ at order {order} already"
        highest = max(self.printed.kept, default=order - 1)
        if order <= highest:
            return (
                f"the sides differ at order {order} already, and terms of order {highest} are "
                "printed"
            )
        sign = self.asked.members[self.component.member].sign
        if sign in EQUALITY and stated_order(self.asked.small) is None:
            return f"the sides differ at order {order}, and = is exact where no order is stated"
        return ""

    # -- terms as printed -----------------------------------------------------------------------

    @cached_property
    def printed(self) -> PrintedOrders:
        """The orders of the terms that are printed."""
        printed = self.asked.members[self.component.member].printed
        if printed is None:
            return PrintedOrders()
        right = self._terms(printed.terms(printed.right))
        if self.is_root:
            return PrintedOrders(right.orders, self._order(self.left))
        left = self._terms(printed.terms(printed.left))
        if not left.count or not right.count:
            alone = printed.left if left.count else printed.right
            return PrintedOrders(self._to_vanish(printed, alone))
        aside = left.orders if printed.is_first else ()
        return PrintedOrders(right.orders, max((_LOWEST, *aside)))

    def _terms(self, terms: Iterable[Term]) -> _Terms:
        """How many terms of a side this component has, and the orders of what they contribute.

        A vector counts in the components in which it is largest: only there is it tested.
        """
        spoken = [(t, parts) for t in terms if (parts := self._parts(t.contribution))[self._place]]
        found = []
        for term, parts in spoken:
            shares = [scaled(self.states.on(part), self.asked.small) for part in parts]
            if shares[self._place] and not self._is_argument(term):
                order = self._order(shares[self._place])
                if order <= min(self._order(share) for share in shares if share):
                    found.append(order)
        return _Terms(len(spoken), tuple(found))

    @cached_property
    def _place(self) -> int:
        """Which of the components of its member it is."""
        alike = [c for c in self.asked.components() if c.member == self.component.member]
        return [c.label for c in alike].index(self.component.label)

    def _parts(self, side: Side) -> tuple[Expr, ...]:
        """The components of a side along the directions in which the member is taken apart."""
        relation = self.asked.members[self.component.member]
        triad = triad_of(relation.left, relation.right)
        if isinstance(side, Vector):
            return side.components if triad is None else side.express(triad).components
        return (side,) if triad is None else (side,) * 3  # 0 stands for a vector

    def _is_argument(self, term: Term) -> bool:
        """Whether it is as large as the argument it stands in, and so no correction to it."""
        if not term.among:
            return False
        own, whole = (scaled(self.states.on(e), self.asked.small) for e in (term.own, term.among))
        return not own or not whole or self._order(own) <= self._order(whole)

    def _to_vanish(self, printed: PrintedRelation, node: Node) -> tuple[int, ...]:
        """Of the terms of a side that is to vanish; a factor that does not is no part of it.

        A single term that is said to vanish is a statement about its size alone.
        """
        factors = printed.factors(node)
        if len(factors) < 2 or not all(isinstance(value, Expr) for _, value in factors):
            return self._terms(printed.terms(node)).several
        sizes = [self._size(value) for _, value in factors if isinstance(value, Expr)]
        return tuple(
            order + sum(sizes) - size
            for (factor, _), size in zip(factors, sizes, strict=True)
            if size > 0
            for order in self._terms(printed.terms(factor)).several
        )

    def _size(self, factor: Expr) -> int:
        """The order of a factor of a side that is to vanish; high where it vanishes itself."""
        there = scaled(self.states.on(factor), self.asked.small)
        return self._order(there) if there else _HIGHEST

    def _order(self, share: Expr) -> int:
        """Raises `NumericError` for what is smaller than anything that is expanded."""
        found = self.series(share, _LIMIT)
        if not found:
            raise NumericError(
                f"a term of an order above {_LIMIT} in what is small, which was read",
                expected="terms of lower orders",
            )
        return next(iter(found))
