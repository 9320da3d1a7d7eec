"""Random states in a prime field, at which it is decided whether an expression vanishes.

Parameters, coordinates and independent speeds are drawn; a sine and a cosine come from a drawn
tangent of half the angle. Everything else follows from them as on a real state: dependent speeds
from the constraints, accelerations from linear equations with numbers in them, reactions from the
balances. Nothing is multiplied out.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import prod

from polhode.algebra import (
    Expr,
    FieldPoint,
    Generator,
    NoResidueError,
    Residue,
    Symbol,
    Vanishing,
    dot,
    has_parts,
    under_name,
    vanishing,
)
from polhode.derive import Equations


@dataclass(frozen=True, eq=False)
class FieldStates:
    """States of a domain in a prime field.

    Attributes:
        equations: of the system.
        given: symbols restricted to values.
        reactions: those that Newton's laws determine; none where forces are free.
        has_dynamics: whether accelerations follow from the equations of motion, or are free.
        closed: symbols given by the conditions that loops are closed, with their values.
        on: reduces an expression on the domain exactly; for functions of determined quantities.
        signs: whether the signs of some quantities are stated, which `on` then takes into account.
    """

    equations: Equations
    given: Mapping[Symbol, Expr]
    reactions: Mapping[Symbol, Expr]
    has_dynamics: bool
    closed: Mapping[Symbol, Expr]
    on: Callable[[Expr], Expr]
    signs: bool

    def vanishing(self, *factors: Expr) -> Vanishing:
        """Whether a product vanishes on all states.

        Raises `NoResidueError` where that cannot be decided in this way.
        """
        if not self.are_drawn:
            raise NoResidueError("a restriction of quantities that follow from others")

        def value(point: FieldPoint) -> Residue:
            found = [factor.residue(point) for factor in factors]
            degree = sum(r.degree for r in found)
            roots = frozenset().union(*(r.roots for r in found))
            return Residue(prod(r.value for r in found), degree, roots)

        return vanishing(value, self.point)

    @cached_property
    def fixed(self) -> dict[Symbol, Expr]:
        """Symbols with a value that restrictions and closures of loops give them."""
        return {**self.closed, **self.given}

    @cached_property
    def are_drawn(self) -> bool:
        """Whether the restrictions fix quantities that would otherwise be drawn."""
        used = {s for image in self.given.values() for s in image.symbols()}
        return all(map(self.is_drawn, {*self.given, *used})) and not used & self.given.keys()

    def point(self, number: int) -> FieldPoint:
        """One of the random states."""
        if number not in self._points:
            self._points[number] = _StatePoint(self, f"state {number}")
        return self._points[number]

    @cached_property
    def _points(self) -> dict[int, FieldPoint]:
        return {}

    @cached_property
    def is_long(self) -> bool:
        """Whether accelerations, solved for, have long expressions under names."""
        return any(map(has_parts, self.equations.accelerations.values()))

    def is_drawn(self, symbol: Symbol) -> bool:
        """Whether nothing but a restriction or the closure of a loop determines a symbol."""
        equations, base = self.equations, symbol.base()
        if base in self.reactions or base in equations.dependent:
            return False
        speed = self.speed_of(symbol)
        if speed is not None:
            return symbol.order <= speed.order or not self.has_dynamics
        return not symbol.order or base.derivative() not in equations.kinematics

    def speed_of(self, symbol: Symbol) -> Symbol | None:
        """The independent speed that a symbol is, or is a rate of."""
        for speed in self.equations.speeds:
            if speed.base() == symbol.base() and speed.order <= symbol.order:
                return speed
        return None

    def determined(self, symbol: Symbol) -> Expr | None:
        """The value that constraints or balances give to a symbol, in terms of other symbols.

        None for one that is drawn, and for accelerations, which are solved for.
        """
        equations, base = self.equations, symbol.base()
        if base in self.reactions:
            value, times = self.reactions[base], symbol.order
        elif base in equations.dependent:
            value, times = equations.dependent[base], symbol.order
        elif symbol.order and self.speed_of(symbol) is None:
            if base.derivative() not in equations.kinematics:
                return None
            value, times = equations.kinematics[base.derivative()], symbol.order - 1
        else:
            return None
        for _ in range(times):
            value = value.dt()
        return value

    def forcing(self, order: int) -> Sequence[Expr]:
        """The right-hand sides of the equations for the accelerations, or for a rate of them.

        From M u̇ = f follows M ü = ḟ - Ṁ u̇, and so on.
        """
        while len(self._forcing) <= order:
            rates = list(self.equations.acceleration_symbols)
            for _ in range(len(self._forcing) - 1):
                rates = [s.derivative() for s in rates]
            solved = [Expr.generator(s) for s in rates]
            sides = zip(self._forcing[-1], self._mass_rates, strict=True)
            self._forcing.append(tuple(f.dt() - dot(row, solved) for f, row in sides))
        return self._forcing[order]

    @cached_property
    def _forcing(self) -> list[Sequence[Expr]]:
        return [self.equations.forcing]

    @cached_property
    def _mass_rates(self) -> tuple[tuple[Expr, ...], ...]:
        return tuple(tuple(entry.dt() for entry in row) for row in self.equations.mass.rows)


class _StatePoint(FieldPoint):
    """One state of a domain."""

    def __init__(
        self, states: FieldStates, seed: str, negative: frozenset[str] = frozenset()
    ) -> None:
        super().__init__(seed, negative)
        self._states = states
        self._rates: dict[int, dict[Symbol, Residue]] = {}

    def _remade(self, negative: frozenset[str]) -> FieldPoint:
        return _StatePoint(self._states, self.seed, negative)

    def _found(self, generator: Generator) -> Residue:
        if isinstance(generator, Symbol):
            return self._of_symbol(generator)
        states = self._states
        # The root of a square is resolved by known signs once the square is seen, and the sine of a
        # right angle is a number: both are found exactly.
        is_settled = all(s not in states.given and states.is_drawn(s) for s in generator.symbols())
        if under_name(generator) is None and (not is_settled or states.signs):
            whole = Expr.generator(generator)
            image = states.on(whole)
            if image != whole:
                return image.residue(self)
        return super()._found(generator)

    def _of_symbol(self, symbol: Symbol) -> Residue:
        states = self._states
        known = states.fixed.get(symbol)
        if known is None:
            known = states.determined(symbol)
        if known is not None:
            return known.residue(self)
        if states.is_drawn(symbol):
            return super()._found(symbol)
        return self._rate(symbol)

    def _rate(self, symbol: Symbol) -> Residue:
        """An acceleration, or a higher rate of an independent speed."""
        speed = self._states.speed_of(symbol)
        assert speed is not None
        order = symbol.order - speed.order - 1
        if order not in self._rates:
            right = [side.residue(self) for side in self._states.forcing(order)]
            mass = [[m.residue(self) for m in row] for row in self._states.equations.mass.rows]
            solved = solved_residues(mass, right)
            speeds = self._states.equations.speeds
            self._rates[order] = {s.base(): r for s, r in zip(speeds, solved, strict=True)}
        return self._rates[order][symbol.base()]


def solved_residues(rows: list[list[Residue]], right: list[Residue]) -> list[Residue]:
    """The solution of A x = b; raises `ZeroDivisionError` where A is singular.

    By Cramer's rule x is a quotient of two determinants, each of a degree of at most that of all
    entries together.
    """
    entries = [*(entry for row in rows for entry in row), *right]
    degree = sum(entry.degree for entry in entries)
    roots = frozenset().union(*(entry.roots for entry in entries))
    pairs = zip(rows, right, strict=True)
    table = [[*(entry.value for entry in row), side.value] for row, side in pairs]
    for column in range(len(table)):
        pivot = next((row for row in table[column:] if row[column] != 0), None)
        if pivot is None:
            raise ZeroDivisionError("the equations are singular")
        table.remove(pivot)
        scaled = [entry / pivot[column] for entry in pivot]
        table = [[a - row[column] * b for a, b in zip(row, scaled, strict=True)] for row in table]
        table.insert(column, scaled)
    return [Residue(row[-1], degree, roots) for row in table]
