"""What is left of a claim on small quantities, and the order to which it has to vanish."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import Expr
from polhode.base import NumericError
from polhode.claims.contexts._scaling import leading_orders, scaled, stated_order, weights
from polhode.claims.latex._tree import Node
from polhode.claims.meaning._components import Component, Side, components, triad_of, zero_like
from polhode.claims.meaning._printed_terms import Printed, Term
from polhode.claims.states._asked import EQUALITY, Asked
from polhode.claims.states._circumstances import Circumstances

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

    component: Component
    states: Circumstances
    left: Expr
    right: Expr
    positive: tuple[Expr, ...]
    asked: Asked
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
            return f"the sides differ at order {order} already, and terms of order {highest} are printed"
        sign = self.asked.members[self.component.member].sign
        if sign in EQUALITY and stated_order(self.asked.small) is None:
            return f"the sides differ at order {order}; = is exact where --small states no order"
        return ""

    # -- terms as printed -----------------------------------------------------------------------

    @cached_property
    def printed(self) -> PrintedOrders:
        """The orders of the terms that are printed."""
        printed = self.asked.members[self.component.member].printed
        if printed is None:
            return PrintedOrders()
        left = (self._order(self.left),) if self.is_root else self._orders(printed, printed.left)
        right = self._orders(printed, printed.right)
        if not left or not right:
            return PrintedOrders(self._to_vanish(printed, printed.left if left else printed.right))
        return PrintedOrders(right, max(left) if printed.is_first else _LOWEST)

    def _orders(self, printed: Printed, node: Node) -> tuple[int, ...]:
        """Of the terms of a side that contribute to this component."""
        return tuple(self._of_terms(printed.terms(node)))

    def _of_terms(self, terms: Iterable[Term]) -> Iterator[int]:
        for term in terms:
            share = self._share(term.contribution)
            if share and not self._is_argument(term):
                yield self._order(share)

    def _share(self, side: Side) -> Expr:
        """What a side contributes to this component, scaled."""
        relation = self.asked.members[self.component.member]
        triad = triad_of(relation.left, relation.right)
        turned = side if isinstance(side, Expr) or triad is None else side.express(triad)
        parts = components(self.component.member, turned, zero_like(turned))
        part = next((c for c in parts if c.label == self.component.label), None)
        return scaled(self.states.on(part.left), self.asked.small) if part else Expr.of(0)

    def _is_argument(self, term: Term) -> bool:
        """Whether it is as large as the argument it stands in, and so no correction to it."""
        if not term.among:
            return False
        own, whole = (scaled(self.states.on(e), self.asked.small) for e in (term.own, term.among))
        return not own or not whole or self._order(own) <= self._order(whole)

    def _to_vanish(self, printed: Printed, node: Node) -> tuple[int, ...]:
        """Of the terms of a side that is to vanish; a factor that does not is no part of it.

        A single term that is said to vanish is a statement about its size alone.
        """
        factors = printed.factors(node)
        if len(factors) < 2 or not all(isinstance(value, Expr) for _, value in factors):
            found = self._orders(printed, node)
            return found if len(found) > 1 else ()
        sizes = [self._size(value) for _, value in factors if isinstance(value, Expr)]
        vanishing = [(f, size) for (f, _), size in zip(factors, sizes, strict=True) if size > 0]
        found = tuple(
            order + sum(sizes) - size
            for factor, size in vanishing
            for order in self._within(printed, factor)
        )
        return found

    def _within(self, printed: Printed, factor: Node) -> tuple[int, ...]:
        """Of the terms of a scalar factor; of a single one none."""
        orders = [
            self._order(share)
            for term in printed.terms(factor)
            if isinstance(term.contribution, Expr)
            and (share := scaled(self.states.on(term.contribution), self.asked.small))
            and not self._is_argument(term)
        ]
        return tuple(orders) if len(orders) > 1 else ()

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
