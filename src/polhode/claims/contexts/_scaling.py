"""Small quantities made small together, and what then is left to each order."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from functools import lru_cache
from math import lcm

from polhode.algebra import ONE, ZERO, Expr, Symbol
from polhode.base import NumericError
from polhode.claims.meaning._meaning import with_signs
from polhode.claims.states._bound_claim import Small

#: Scales everything small.
SMALLNESS = Symbol("smallness", positive=True)

_HIGHEST_RATE = 3


def scaled(expression: Expr, small: Sequence[Small]) -> Expr:
    """An expression with every small quantity multiplied by its power of the smallness.

    The symbol that a small quantity is formed of then stands for the departure itself: with
    ε = θ - π/2 small, θ becomes π/2 + smallness · θ. Rates of it are as small.
    """
    return expression.subs(_images(tuple(small)))


def weights(small: Sequence[Small]) -> tuple[int, ...]:
    """The power of the smallness that each small quantity stands for.

    Those kept to a higher order are larger: with θ to the third order and Ω to the first, a
    product such as θ²Ω is left out. What is kept to order zero is smaller than all that is kept.
    """
    whole = stated_order(small) or 0
    return tuple(_weight(each.order, whole) for each in small)


def _weight(order: int | None, whole: int) -> int:
    if not whole:
        return 1
    if order is None:
        return whole
    return whole // order if order else whole + 1


def stated_order(small: Sequence[Small]) -> int | None:
    """The power of the smallness up to which terms are kept; None where no order is stated."""
    orders = [each.order for each in small if each.order is not None]
    return lcm(*filter(None, orders)) if any(orders) else (0 if orders else None)


def vanished(small: Sequence[Small]) -> dict[Symbol, Expr]:
    """The values that symbols have where every small quantity is zero."""
    images = _images(tuple(small))
    return {symbol: value.subs({SMALLNESS: ZERO}) for symbol, value in images.items()}


def restored(expression: Expr, small: Sequence[Small]) -> Expr:
    """A coefficient with departures written as the small quantities they are."""
    return expression.subs({_formed_of(each.quantity)[0]: each.quantity for each in small})


@lru_cache(maxsize=64)
def _images(small: tuple[Small, ...]) -> dict[Symbol, Expr]:
    pairs = zip(small, weights(small), strict=True)
    return {s: value for each, weight in pairs for s, value in _images_of(each.quantity, weight)}


def _images_of(quantity: Expr, weight: int) -> Iterator[tuple[Symbol, Expr]]:
    scale = Expr.generator(SMALLNESS) ** weight
    symbol, value = _formed_of(quantity)
    departure = Expr.generator(symbol)
    yield symbol, value.subs({_TARGET: scale * departure})
    if symbol.kind.varies:
        for _ in range(_HIGHEST_RATE):
            symbol = symbol.derivative()
            yield symbol, scale * Expr.generator(symbol)


_TARGET = Symbol("departure")


def _formed_of(quantity: Expr) -> tuple[Symbol, Expr]:
    """The symbol that a small quantity is formed of, and its value when the quantity has another.

    Raises `NumericError` for a quantity that is neither linear in a symbol nor one over it.
    """
    target = Expr.generator(_TARGET)
    for symbol in sorted(quantity.symbols(), key=lambda s: (not s.kind.varies, s.published)):
        x = Expr.generator(symbol)
        for form, value in ((quantity, target), (_reciprocal(quantity), ONE / target)):
            slope = form.diff(symbol)
            if slope and symbol not in slope.symbols():
                rest = form - slope * x
                return symbol, (value - rest) / slope
    raise NumericError(
        f"{quantity} as a small quantity",
        expected="a symbol, a departure such as theta - pi/2, or one over a large symbol",
    )


def _reciprocal(quantity: Expr) -> Expr:
    return ONE / quantity if quantity else ZERO


def leading_orders(
    expression: Expr, lowest: int, highest: int, positive: Collection[Expr] = ()
) -> dict[int, Expr]:
    """The first coefficient of the series in the smallness that is not zero, by its order.

    Negative orders are poles. Empty where all up to the highest order vanish; roots of squares of
    what is positive are resolved.
    """
    below = expression.denominator
    if SMALLNESS not in below.symbols() or _has_poles_inside(expression):
        return _leading(expression, lowest, highest, positive)
    # far less grows when what stands above and below the bar are expanded one by one
    least = _leading(below, lowest, highest - lowest, positive)
    order, share = next(iter(least.items()), (0, ZERO))
    if not share:
        return _leading(expression, lowest, highest, positive)
    found = _leading(expression.numerator, lowest + order, highest + order, positive)
    return {power - order: coefficient / share for power, coefficient in found.items()}


def _has_poles_inside(expression: Expr) -> bool:
    """Whether a root or the like holds one over the smallness."""
    arguments = (a for g in expression.generators for a in g.arguments)
    return any(SMALLNESS in a.denominator.symbols() or _has_poles_inside(a) for a in arguments)


def _leading(
    expression: Expr, lowest: int, highest: int, positive: Collection[Expr]
) -> dict[int, Expr]:
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
