"""Equations between open letters, and random states at which some of them are imposed.

At a random state of a prime field every letter has the value that it has in truth. An equation of
the text that is wrong there is imposed by changing one quantity in which it is linear, or whose
square it is linear in; with further equations that shall go on to hold, as many quantities change.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from polhode.algebra import (
    ZERO,
    Expr,
    FieldPoint,
    Residue,
    Symbol,
    SymbolKind,
)
from polhode.judge.states._field_states import solved_residues

_LONGEST = 300  # terms of an equation that is solved; longer ones are not a line of a text


@dataclass(frozen=True)
class Unknown:
    """A quantity that an equation determines.

    Attributes:
        symbol: the quantity.
        power: 1 where the equation is linear in it, 2 where it is so in its square.
        slope: the coefficient of that power.
    """

    symbol: Symbol
    power: int
    slope: Expr


@dataclass(frozen=True, eq=False)
class Equation:
    """What an equation of a text says of letters, accelerations, reactions and speeds.

    Attributes:
        relation: a polynomial that vanishes.
        letters: open letters of the text.
        settled: quantities that it does not determine, since another equation does.
    """

    relation: Expr
    letters: Collection[Symbol]
    settled: frozenset[Symbol] = frozenset()

    @cached_property
    def symbols(self) -> frozenset[Symbol]:
        """All symbols in it."""
        return self.relation.symbols()

    @cached_property
    def unknowns(self) -> dict[Symbol, Unknown]:
        """The quantities that it determines, letters of the text first.

        Parameters of the model are determined only by an equation without anything that varies.
        """
        if sum(1 for _ in self.relation.terms()) > _LONGEST:
            return {}
        is_constant = not any(symbol.kind.varies for symbol in self.symbols)
        found = (
            _unknown(self.relation, symbol)
            for symbol in sorted(self.symbols - self.settled, key=self._order)
            if symbol.base() in self.letters or is_constant or _may_follow(symbol)
        )
        return {unknown.symbol: unknown for unknown in found if unknown is not None}

    def _order(self, symbol: Symbol) -> tuple[bool, int, str]:
        return symbol.base() not in self.letters, -symbol.order, symbol.published

    @property
    def rate(self) -> Equation:
        """The same equation, differentiated with respect to time; it determines new rates only."""
        return Equation(self.relation.dt().numerator, self.letters, self.symbols)


def _may_follow(symbol: Symbol) -> bool:
    """Whether a quantity of the model may follow from others: not a coordinate or a parameter."""
    kinds = (SymbolKind.FUNCTION, SymbolKind.SPEED)
    return symbol.kind in kinds or (symbol.kind is SymbolKind.COORDINATE and symbol.order > 0)


def _unknown(relation: Expr, symbol: Symbol) -> Unknown | None:
    """A quantity with the coefficient of the one power of it that occurs."""
    slopes = {1: ZERO, 2: ZERO}
    for powers, coefficient in relation.terms():
        if any(symbol in g.symbols() for g in powers if g != symbol):
            return None
        power = powers.get(symbol, 0)
        if not power:
            continue
        if power not in slopes:
            return None
        others = {generator: p for generator, p in powers.items() if generator != symbol}
        slopes[power] += Expr.product(others, coefficient)
    kept = [power for power, slope in slopes.items() if slope]
    return Unknown(symbol, kept[0], slopes[kept[0]]) if len(kept) == 1 else None


# -- states ----------------------------------------------------------------------------------------


class UndeterminedError(Exception):
    """Equations do not determine the quantities for which they are solved, at any state."""


class ChangedPoint(FieldPoint):
    """A random state at which some quantities have other values, and letters those they stand for.

    Args:
        base: the state as it is.
        letters: the values of open letters and of their rates, in truth; None for other symbols.
        changed: quantities with their other values.
    """

    def __init__(
        self,
        base: FieldPoint,
        letters: Callable[[Symbol], Expr | None],
        changed: Mapping[Symbol, Residue],
    ) -> None:
        super().__init__(base.seed)
        self._base, self._letters, self._changed = base, letters, changed
        self._values: dict[Expr, Residue] = {}

    def changing(self, more: Mapping[Symbol, Residue]) -> ChangedPoint:
        """With further quantities changed."""
        return ChangedPoint(self._base, self._letters, {**self._changed, **more})

    def value(self, expression: Expr) -> Residue:
        """The value of an expression, kept for the next time."""
        if expression not in self._values:
            self._values[expression] = expression.residue(self)
        return self._values[expression]

    def root(self, key: str, radicand: Residue, *, is_number: bool) -> Residue:
        """A square root, of the sign that it has at the state."""
        return self._base.root(key, radicand, is_number=is_number)

    def _found(self, generator: Any) -> Residue:
        if isinstance(generator, Symbol):
            return self._of_symbol(generator)
        if not any(s in self._changed or self._letters(s) for s in generator.symbols()):
            return self._base.of(generator)
        if not hasattr(generator, "radicand"):
            raise UndeterminedError
        found: Residue = generator.residue(self)
        return found

    def _of_symbol(self, symbol: Symbol) -> Residue:
        if symbol in self._changed:
            return self._changed[symbol]
        value = self._letters(symbol)
        return self._base.of(symbol) if value is None else value.residue(self._base)


#: Equations, each with the quantity that it determines.
Solving = Sequence[tuple[Equation, Unknown]]


def imposed(point: ChangedPoint, stages: Sequence[Solving]) -> ChangedPoint:
    """The state at which equations hold, each by a change of the quantity that it determines.

    Raises `UndeterminedError` where they do not determine them.
    """
    for stage in stages:
        rows = [
            [point.value(_slope(equation, unknown)) for _, unknown in stage]
            for equation, _ in stage
        ]
        wrong = [point.value(equation.relation) for equation, _ in stage]
        try:
            changes = solved_residues(rows, wrong)
        except ZeroDivisionError:
            raise UndeterminedError from None
        new = {
            unknown.symbol: _changed_value(point, unknown, change)
            for (_, unknown), change in zip(stage, changes, strict=True)
        }
        point = point.changing(new)
    return point


def _changed_value(point: ChangedPoint, unknown: Unknown, change: Residue) -> Residue:
    now = point.of(unknown.symbol)
    value = now.value**unknown.power - change.value
    degree = now.degree * unknown.power + change.degree
    found = Residue(value, degree, now.roots | change.roots)
    if unknown.power == 1:
        return found
    return point.root(f"changed {unknown.symbol.key}", found, is_number=False)


def _slope(equation: Equation, unknown: Unknown) -> Expr:
    """The coefficient of a quantity in an equation that has been found to be linear in it."""
    found = equation.unknowns.get(unknown.symbol)
    return ZERO if found is None else found.slope


def stages(solving: Solving) -> Sequence[Solving]:
    """Equations to be solved together where they are linear in all quantities, else in turn.

    Empty where neither is possible.
    """
    quantities = {unknown.symbol for _, unknown in solving}
    if all(_is_linear(equation, solving, quantities) for equation, _ in solving):
        return (solving,)
    for place, (equation, _) in enumerate(solving):
        if {unknown.symbol for _, unknown in solving[place + 1 :]} & equation.symbols:
            return ()
    return tuple(solving[place : place + 1] for place in range(len(solving)))


def _is_linear(equation: Equation, solving: Solving, quantities: Collection[Symbol]) -> bool:
    for _, unknown in solving:
        if unknown.symbol not in equation.symbols:
            continue
        found = equation.unknowns.get(unknown.symbol)
        if found is None or found.power != unknown.power:
            return False
        if not found.slope.symbols().isdisjoint(quantities):
            return False
    return True


# -- chains of equations --------------------------------------------------------------------------


def carrying(
    start: tuple[Equation, Unknown], others: Iterable[Equation]
) -> Iterator[tuple[Equation, Unknown]]:
    """Equations with the quantity that changes, each with another one that changes with it."""
    equation, changed = start
    for other in others:
        if other is equation or changed.symbol not in other.symbols:
            continue
        for unknown in other.unknowns.values():
            if unknown.symbol != changed.symbol:
                yield other, unknown


def with_another_factor(solving: Solving, place: int) -> Iterator[Solving]:
    """The same equations, the one at a place solved for each of its other quantities."""
    equation, _ = solving[place]
    solved = {unknown.symbol for _, unknown in solving}
    for unknown in equation.unknowns.values():
        if unknown.symbol not in solved:
            yield (*solving[:place], (equation, unknown), *solving[place + 1 :])


def is_rate_of_acceleration(symbol: Symbol) -> bool:
    """Whether it is a rate of an acceleration, or of a rate of that."""
    highest = {SymbolKind.SPEED: 1, SymbolKind.COORDINATE: 2}
    return symbol.order > highest.get(symbol.kind, symbol.order)
