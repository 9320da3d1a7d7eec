"""The remainder of a claim about small quantities, and the order to which it has to vanish."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from math import lcm

from polhode.algebra import ONE, ZERO, Expr, Symbol, SymbolKind, Vector
from polhode.base import NumericError
from polhode.judge.latex._tree import Node
from polhode.judge.meaning._meaning import Side, complex_parts, with_signs
from polhode.judge.meaning._relations import PrintedRelation, ScalarRelation, Term, triad_of
from polhode.judge.states._bound_claim import EQUALITY, BoundClaim, Small
from polhode.judge.states._claim_domain import ClaimDomain

#: The ε by whose powers all small quantities are scaled.
SMALLNESS = Symbol("smallness", positive=True)

_HIGHEST_RATE = 3  # derivatives of a small quantity count as equally small, up to this one
_HIGHEST = 6  # order up to which a remainder is expanded; further if printed terms are smaller
_LIMIT = 12  # order up to which a single term is expanded
_LOWEST = -4  # order of the highest pole expanded, in units of the weight of a small quantity
_TARGET = Symbol("departure")

# -- small quantities scaled together, and series in the smallness --------------------------------


def scaled(expression: Expr, small: Sequence[Small]) -> Expr:
    """An expression with every small quantity multiplied by its power of the smallness.

    The symbol that a small quantity is formed of then stands for the departure itself: with
    ε = θ - π/2 small, θ becomes π/2 + smallness · θ. Its rates are taken as equally small.
    """
    return expression.subs(images_of(tuple(small)))


def weights(small: Sequence[Small]) -> tuple[int, ...]:
    """The power of the smallness that each small quantity stands for.

    Quantities kept to a higher order are larger: with θ to the third order and Ω to the first, θ
    counts as ε and Ω as ε³, so that θ³ and Ω are kept and θ²Ω is left out. A quantity kept to order
    zero is smaller than all terms kept.
    """
    whole = stated_order(small)
    if not whole:
        return (1,) * len(small)
    orders = (1 if each.order is None else each.order for each in small)
    return tuple(whole // order if order else whole + 1 for order in orders)


def stated_order(small: Sequence[Small]) -> int | None:
    """The power of the smallness up to which terms are kept; None where no order is stated."""
    orders = [each.order for each in small if each.order is not None]
    return lcm(*filter(None, orders)) if any(orders) else (0 if orders else None)


def vanished(small: Sequence[Small]) -> dict[Symbol, Expr]:
    """The values of symbols in the limit, where every small quantity is zero."""
    images = images_of(tuple(small))
    return {symbol: value.subs({SMALLNESS: ZERO}) for symbol, value in images.items()}


def restored(expression: Expr, small: Sequence[Small]) -> Expr:
    """A coefficient with the symbol of each departure replaced by the small quantity itself."""
    formed = formed_of(tuple(small))
    return expression.subs({s: each.quantity for (s, _), each in zip(formed, small, strict=True)})


def eliminating(small: Sequence[Small], kept: Collection[Symbol]) -> tuple[Small, ...]:
    """Small quantities that eliminate none of the symbols kept, where others could be eliminated.

    With 1/(ψ̇ + φ̇ cos θ) small, a claim that gives φ̇ is about φ̇ as a function of that quantity.
    """
    found = []
    for each in small:
        others = [symbol for symbol, _ in _forms_of(each) if symbol not in kept]
        is_chosen = each.symbol in others or not others
        found.append(each if is_chosen else replace(each, symbol=others[0]))
    return tuple(found)


def large_symbols(small: Sequence[Small]) -> Iterator[Symbol]:
    """The symbols that stand for the small reciprocals of large quantities."""
    for (symbol, _), each in zip(formed_of(tuple(small)), small, strict=True):
        if symbol in each.quantity.denominator.symbols():
            yield symbol


@lru_cache(maxsize=64)
def images_of(small: tuple[Small, ...]) -> dict[Symbol, Expr]:
    """The scaled forms of the symbols of small quantities and of their rates."""
    found: dict[Symbol, Expr] = {}
    for (symbol, image), weight in zip(formed_of(small), weights(small), strict=True):
        found[symbol] = image
        scale = Expr.generator(SMALLNESS) ** weight
        for _ in range(_HIGHEST_RATE if symbol.kind.varies else 0):
            symbol = symbol.derivative()
            found[symbol] = scale * Expr.generator(symbol)
    return found


@lru_cache(maxsize=64)
def formed_of(small: tuple[Small, ...]) -> tuple[tuple[Symbol, Expr], ...]:
    """The symbol that each small quantity is formed of, with its scaled form.

    Quantities that share speeds, as components of an angular velocity do, are solved for together.
    """
    found: dict[Symbol, Expr] = {}
    symbols: dict[Expr, Symbol] = {}
    for each, weight in zip(small, weights(small), strict=True):
        quantity = each.quantity
        shared = {s for s in quantity.symbols() & found.keys() if _is_speed(s)}
        if quantity in symbols or quantity.symbol in shared:  # it is small to two orders
            shared = set()
        if shared:
            each = Small(quantity.subs(found), each.order)
        symbol, value = _formed_of(each, shared)
        symbols[quantity] = symbol
        image = value.subs({_TARGET: Expr.generator(SMALLNESS) ** weight * Expr.generator(symbol)})
        if _is_speed(symbol):
            found = {s: v if s == symbol else v.subs({symbol: image}) for s, v in found.items()}
        found[symbol] = image
    formed = (symbols[each.quantity] for each in small)
    return tuple((symbol, found[symbol]) for symbol in formed)


def _is_speed(symbol: Symbol) -> bool:
    return symbol.kind is SymbolKind.SPEED or symbol.order == 1


def _formed_of(small: Small, others: Collection[Symbol] = ()) -> tuple[Symbol, Expr]:
    """The symbol that a small quantity is formed of, and its value in terms of `_TARGET`.

    It is none of the others, of which further small quantities are formed.

    Raises `NumericError` for a quantity that is neither linear in a symbol nor the reciprocal of
    such an expression.
    """
    for symbol, value in _forms_of(small):
        if small.symbol in (None, symbol) and symbol not in others:
            return symbol, value
    raise NumericError(
        f"{small.quantity} as a small quantity",
        expected="a symbol, a departure such as theta - pi/2, or one over a large symbol",
    )


def _forms_of(small: Small) -> Iterator[tuple[Symbol, Expr]]:
    """Every symbol in which the quantity or its reciprocal is linear, and its value.

    Those with a constant coefficient come first: ω = ψ̇ + φ̇ cos θ is the spin rather than φ̇.
    """
    target, quantity = Expr.generator(_TARGET), small.quantity
    reciprocal = ONE / quantity if quantity else ZERO
    found = []
    for symbol in sorted(quantity.symbols(), key=lambda s: (not s.kind.varies, s.published)):
        x = Expr.generator(symbol)
        for form, value in ((quantity, target), (reciprocal, ONE / target)):
            slope = form.diff(symbol)
            if slope and symbol not in slope.symbols():
                varies = slope.varies
                found.append((varies, symbol, (value - (form - slope * x)) / slope))
                break
    yield from ((symbol, value) for varies, symbol, value in found if not varies)
    yield from ((symbol, value) for varies, symbol, value in found if varies)


def leading_orders(
    expression: Expr, lowest: int, highest: int, positive: Collection[Expr] = ()
) -> dict[int, Expr]:
    """The first nonzero coefficient of the series in the smallness, by its order.

    Negative orders are poles. Empty if all coefficients up to the highest order vanish. |f| becomes
    f for every f known to be positive.
    """
    below = expression.denominator
    if SMALLNESS not in below.symbols() or _has_poles_inside(expression):
        return _leading(expression, lowest, highest, positive)
    # Numerator and denominator are expanded separately, since derivatives of a quotient grow fast:
    # (a εⁱ + …) / (b εʲ + …) = (a/b) εⁱ⁻ʲ + …
    least = _leading(below, lowest, highest - lowest, positive)
    order, share = next(iter(least.items()), (0, ZERO))
    if not share:
        return _leading(expression, lowest, highest, positive)
    found = _leading(expression.numerator, lowest + order, highest + order, positive)
    return {power - order: coefficient / share for power, coefficient in found.items()}


def _has_poles_inside(expression: Expr) -> bool:
    """Whether a root or another function has 1/ε in its argument."""
    arguments = (a for g in expression.generators for a in g.arguments)
    return any(SMALLNESS in a.denominator.symbols() or _has_poles_inside(a) for a in arguments)


def _leading(
    expression: Expr, lowest: int, highest: int, positive: Collection[Expr]
) -> dict[int, Expr]:
    """Taylor coefficients of ε^(-order) times the expression, for the lowest pole it is finite at.

    Multiplying by rising powers of ε removes the pole; then the coefficients are derivatives at 0.
    """
    scale = Expr.generator(SMALLNESS)
    for order in range(0, lowest - 1, -1):
        derivative, factorial = expression * scale**-order, 1
        try:
            value = derivative.subs({SMALLNESS: ZERO})
        except ZeroDivisionError:
            continue
        for power in range(highest - order + 1):
            if power:
                derivative, factorial = derivative.diff(SMALLNESS), factorial * power
                value = derivative.subs({SMALLNESS: ZERO})
            signed = with_signs(value, positive)
            if signed:
                return {order + power: signed / factorial}
        return {}
    raise NumericError(f"a pole of order above {-lowest} in a small quantity")


# -- the remainder of one component ---------------------------------------------------------------


@dataclass(frozen=True)
class PrintedOrders:
    """The orders of the terms that one component of a claim prints.

    Attributes:
        kept: orders of the terms that have to be right: all on the right side, or all on the other
            side where one side is zero.
        left_aside: highest order of a term on the left side that the right side may have dropped.
    """

    kept: tuple[int, ...] = ()
    left_aside: int = _LOWEST


@dataclass(frozen=True)
class _Terms:
    """The number of terms, and the orders of those that contribute."""

    count: int
    orders: tuple[int, ...]

    @property
    def several(self) -> tuple[int, ...]:
        """The orders, if there is more than one term, so that terms can cancel."""
        return self.orders if self.count > 1 else ()


@dataclass(frozen=True)
class Remainder:
    """The remainder of one component, left minus right, as a power series in the smallness.

    Attributes:
        component: the component.
        states: where the claim should hold.
        positive: quantities taken as positive.
        claim: the claim.
        root: a speed in steady motion with its value there, scaled; empty for any motion.
    """

    component: ScalarRelation
    states: ClaimDomain
    positive: tuple[Expr, ...]
    claim: BoundClaim
    root: Mapping[Symbol, Expr]

    @cached_property
    def left(self) -> Expr:
        """The left side, scaled."""
        return self._scaled(self.component.left)

    @cached_property
    def right(self) -> Expr:
        """The right side, scaled."""
        return self._scaled(self.component.right)

    def _scaled(self, expression: Expr) -> Expr:
        """An expression on the states, in terms of what is small."""
        found = scaled(self.states.on(expression), self.claim.small)
        return found.subs(self.root) if self.root else found

    @cached_property
    def orders(self) -> dict[int, Expr]:
        """The first coefficient that is not zero, by its order."""
        return self.series(self.left - self.right, self.highest)

    @cached_property
    def highest(self) -> int:
        """The order up to which it is expanded, at least that of every printed term."""
        if self.left == self.right:
            return _HIGHEST
        printed = self.printed
        return max((_HIGHEST, self.stated, printed.left_aside, *printed.kept))

    def series(self, expression: Expr, highest: int = _HIGHEST) -> dict[int, Expr]:
        """The first nonzero coefficient of an expression, by its order."""
        lowest = _LOWEST * max(weights(self.claim.small))
        return leading_orders(expression, lowest, highest, self.positive)

    @cached_property
    def stated(self) -> int:
        """The order to which the claim has to hold: as stated, otherwise the leading one.

        Where a term O(x³) is printed, it has to hold up to that order as well.
        """
        order = stated_order(self.claim.small)
        left_out = self.claim.members[self.component.member].left_out
        first = min((o for each in left_out for o in self.series(self._scaled(each))), default=0)
        return max(self._leading if order is None else order, first - 1)

    @cached_property
    def _leading(self) -> int:
        """Order of the larger side; where one side is zero, of the largest of the other's terms."""
        if (not self.left or not self.right) and self.printed.kept:
            return min(self.printed.kept)
        both = map(self.series, (self.left, self.right))
        return min((order for orders in both for order in orders), default=0)

    def objection(self, order: int) -> str:
        """Why the sides must not differ at this order; empty if they may."""
        if order <= self.stated:
            return f"the sides already differ at order {order}"
        highest = max(self.printed.kept, default=order - 1)
        if order <= highest:
            return (
                f"the sides already differ at order {order}, and terms of order {highest} are "
                "printed"
            )
        sign = self.claim.members[self.component.member].sign
        if sign in EQUALITY and stated_order(self.claim.small) is None:
            return f"the sides differ at order {order}, and = is exact where no order is stated"
        return ""

    # -- terms as printed -----------------------------------------------------------------------

    @cached_property
    def printed(self) -> PrintedOrders:
        """The orders of the terms that are printed."""
        printed = self.claim.members[self.component.member].printed
        if printed is None:
            return PrintedOrders()
        right = self._terms(printed.terms(printed.right))
        left = self._terms(printed.terms(printed.left))
        # In 0 = A ≈ B, A vanishes on the states, and the second sign claims that B does too.
        if not left.count or not right.count or not self.left:
            alone = printed.left if left.count and self.left else printed.right
            return PrintedOrders(self._orders_to_vanish(printed, alone))
        aside = left.orders if printed.is_first else ()
        return PrintedOrders(right.orders, max((_LOWEST, *aside)))

    def _terms(self, terms: Iterable[Term]) -> _Terms:
        """The number of terms of a side that this component has, and the orders they contribute.

        A vector term counts only in the components in which it is largest: only there is it tested.
        """
        present = [(t, parts) for t in terms if (parts := self._parts(t.contribution))[self._place]]
        found = []
        for term, parts in present:
            shares = [self._scaled(part) for part in parts]
            if shares[self._place] and not self._is_argument(term):
                order = self._order(shares[self._place])
                if order <= min(self._order(share) for share in shares if share):
                    found.append(order)
        return _Terms(len(present), tuple(found))

    @cached_property
    def _place(self) -> int:
        """Its position among the components of its member."""
        alike = [c for c in self.claim.components() if c.member == self.component.member]
        return [c.label for c in alike].index(self.component.label)

    def _parts(self, side: Side) -> tuple[Expr, ...]:
        """The components of a side along the directions in which the member is taken apart."""
        relation = self.claim.members[self.component.member]
        triad = triad_of(relation.left, relation.right)
        if isinstance(side, Vector):
            return side.components if triad is None else side.express(triad).components
        if self.component.label and triad is None:
            return complex_parts(side)
        return (side,) if triad is None else (side,) * 3  # 0 stands for a vector

    def _is_argument(self, term: Term) -> bool:
        """Whether a term is as large as the argument of the function that it stands in.

        In sin(α + x) with x small, x is a correction; in sin x it is the argument itself.
        """
        if not term.among:
            return False
        own, whole = (self._scaled(e) for e in (term.own, term.among))
        return not own or not whole or self._order(own) <= self._order(whole)

    def _orders_to_vanish(self, printed: PrintedRelation, node: Node) -> tuple[int, ...]:
        """Orders of the terms of a side claimed to vanish.

        In x (a + b) = 0, the orders of a and b are shifted by that of x. A single term claimed to
        vanish is a statement about its size alone, and has no terms to be tested.
        """
        factors = printed.factors(node)
        values = [value for _, value in factors if isinstance(value, Expr)]
        if len(factors) < 2 or len(values) < len(factors):
            return self._terms(printed.terms(node)).several
        shares = (self._scaled(value) for value in values)
        sizes = [self._order(share) if share else _HIGHEST for share in shares]
        return tuple(
            order + sum(sizes) - size
            for (factor, _), size in zip(factors, sizes, strict=True)
            if size > 0
            for order in self._terms(printed.terms(factor)).several
        )

    def _order(self, share: Expr) -> int:
        """The order of an expression that does not vanish.

        Raises `NumericError` if it is beyond the highest order expanded.
        """
        found = self.series(share, _LIMIT)
        if not found:
            raise NumericError(
                f"a term of an order above {_LIMIT} in the small quantities, which was read",
                expected="terms of lower orders",
            )
        return next(iter(found))
