"""Equations solved for one quantity, to be put into others."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind

_LONGEST = 200  # terms of an equation that is solved; longer ones are not a line of a text
_KINDS = (SymbolKind.FUNCTION, SymbolKind.SPEED, SymbolKind.COORDINATE)


@dataclass(frozen=True)
class Rule:
    """The value that an equation gives to a quantity, or to its square.

    Attributes:
        symbol: the quantity.
        power: 1, or 2 for its square.
        value: without the quantity itself.
    """

    symbol: Symbol
    power: int
    value: Expr

    def applies(self, expression: Expr) -> bool:
        """Whether the quantity, or a rate of it, occurs in an expression."""
        base = self.symbol.base()
        return any(s.base() == base and s.order >= self.symbol.order for s in expression.symbols())

    def put(self, expression: Expr) -> Expr:
        """An expression with the value in place of the quantity, and with its rates likewise.

        A square is replaced only where it occurs by itself.
        """
        if self.power == 2:
            above, below = expression.numerator, expression.denominator
            return self._square(above) / self._square(below)
        images: dict[Symbol, Expr] = {}
        value, symbol = self.value, self.symbol
        for _ in range(_highest(expression, symbol) + 1):
            images[symbol] = value
            symbol, value = symbol.derivative(), value.dt()
        return expression.subs(images)

    def _square(self, polynomial: Expr) -> Expr:
        found = ZERO
        for powers, coefficient in polynomial.terms():
            term = Expr.of(coefficient)
            for generator, power in powers.items():
                if generator == self.symbol:
                    half, odd = divmod(power, 2)
                    term *= self.value**half * Expr.generator(generator) ** odd
                else:
                    term *= Expr.generator(generator) ** power
            found += term
        return found


def _highest(expression: Expr, symbol: Symbol) -> int:
    """How many more derivatives of a symbol than itself an expression contains."""
    orders = [s.order for s in expression.symbols() if s.base() == symbol.base()]
    return max([*orders, symbol.order]) - symbol.order


def rules(equation: Expr, letters: Collection[Symbol]) -> Iterator[Rule]:
    """What an equation says of each quantity that it determines, letters of the text first.

    Parameters of the model are determined only by an equation without anything that varies.
    """
    relation = equation.numerator
    if sum(1 for _ in relation.terms()) > _LONGEST:
        return
    is_constant = not any(symbol.kind.varies for symbol in relation.symbols())
    order = sorted(
        relation.symbols(), key=lambda s: (s not in letters, -s.order, s.kind.name, s.published)
    )
    for symbol in order:
        is_letter = symbol.base() in letters
        if not is_letter and not is_constant and not _is_determined(symbol):
            continue
        if symbol.kind is SymbolKind.TIME:
            continue
        rule = _linear(relation, symbol) or _squared(relation, symbol)
        if rule is not None:
            yield rule


def _is_determined(symbol: Symbol) -> bool:
    """Whether a quantity of the model may follow from others: not a coordinate or a parameter."""
    return symbol.kind in _KINDS and (symbol.kind is not SymbolKind.COORDINATE or symbol.order > 0)


def _linear(relation: Expr, symbol: Symbol) -> Rule | None:
    slope = relation.diff(symbol)
    if not slope or symbol in slope.symbols():
        return None
    rest = relation - slope * Expr.generator(symbol)
    # A rate beside its quantity, as in v̇ = -k v, is solved for the rate alone.
    if any(s.base() == symbol.base() and s.order >= symbol.order for s in rest.symbols()):
        return None
    return Rule(symbol, 1, -rest / slope)


def _squared(relation: Expr, symbol: Symbol) -> Rule | None:
    slope = rest = ZERO
    for powers, coefficient in relation.terms():
        if any(symbol in g.symbols() for g in powers if g != symbol):
            return None
        power = powers.get(symbol, 0)
        others = [(g, n) for g, n in powers.items() if g != symbol]
        term = Expr.of(coefficient)
        for generator, exponent in others:
            term *= Expr.generator(generator) ** exponent
        if power == 2:
            slope += term
        elif power == 0:
            rest += term
        else:
            return None
    if not slope or any(s.base() == symbol.base() for s in (slope + rest).symbols()):
        return None
    return Rule(symbol, 2, -rest / slope)
