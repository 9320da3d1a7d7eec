"""Positions, rotations, supports and loads of a declaration, ready for numbers."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property, lru_cache

from polhode.algebra import (
    Expr,
    Symbol,
    SymbolKind,
    Vector,
    eliminate,
    lengths_written_out,
    linear_parts,
    variables,
)
from polhode.model import Action, Body, Element, Friction, Load, Restraint, System


@dataclass(frozen=True, eq=False)
class Placement:
    """A declaration with every body placed.

    Attributes:
        system: the declaration.
        places: centre of mass of every body from the origin of the root frame, m.
        rates: of the coordinates whose rate is declared, in terms of speeds.
        coordinates: all of them.
        speeds: the rates of the other coordinates, quasi-velocities such as ω₃, and speeds that the
            user chose.
        replaced: the speeds whose places those took, in terms of all that remain.
        restraints: velocities that supports prescribe.
        frictions: laws of dry friction, by the name of the normal reaction.
    """

    system: System
    places: dict[Body, Vector]
    rates: dict[Symbol, Expr]
    coordinates: tuple[Symbol, ...]
    speeds: tuple[Symbol, ...]
    replaced: dict[Symbol, Expr]
    restraints: tuple[Restraint, ...]
    frictions: dict[str, tuple[Friction, ...]]

    @cached_property
    def functions(self) -> tuple[Symbol, ...]:
        """Prescribed functions of time that occur, without their rates."""
        return self._of_kind(SymbolKind.FUNCTION)

    @cached_property
    def parameters(self) -> tuple[Symbol, ...]:
        """Constants that occur, even those on which the motion does not depend."""
        return self._of_kind(SymbolKind.PARAMETER)

    def _of_kind(self, kind: SymbolKind) -> tuple[Symbol, ...]:
        found = {
            s.base() for s in variables(self._expressions()) if s.kind is kind and s.name != "pi"
        }
        return tuple(sorted(found, key=_name))

    def _expressions(self) -> Iterator[Expr]:
        """Every expression of the declaration."""
        root = self.system.root
        for body in self.system.bodies:
            yield body.mass
            yield from body.inertia.entries
            yield from (frame.angle for frame in body.axes.lineage)
        for vector in self._vectors():
            yield from vector.express(root).components
        yield from (f.coefficient for laws in self.frictions.values() for f in laws)

    def _vectors(self) -> Iterator[Vector]:
        yield from self.places.values()
        yield self.system.root.angular_velocity
        for body in self.system.bodies:
            yield body.angular_velocity
        for restraint in self.restraints:
            yield from (restraint.direction, restraint.velocity)
            arms = (restraint.arm, restraint.other_arm)
            yield from (arm for arm in arms if arm is not None)
            for share in restraint.more:
                yield share.direction
                yield from filter(None, (share.arm,))
        for action in self.declared_actions:
            yield from (action.force, action.arm, action.couple)

    @cached_property
    def declared_actions(self) -> tuple[Action, ...]:
        """Forces and couples of all loads as declared, with reactions by their declared symbols."""
        return tuple(action for load in self.system.loads for action in self._declared_of(load))

    def _declared_of(self, load: Load) -> tuple[Action, ...]:
        bodies = self.system.bodies
        velocities = {b: (self.places[b].dt(), b.angular_velocity) for b in bodies}
        actions = load.actions(bodies, self.places, velocities)
        return tuple(action.mapped(lengths_written_out) for action in actions)

    @cached_property
    def actions(self) -> tuple[Action, ...]:
        """Forces and couples of all loads, in terms of velocities and reactions."""
        return tuple(action for load in self.system.loads for action in self.actions_of(load))

    def actions_of(self, load: Load) -> tuple[Action, ...]:
        """Forces and couples of one load, in terms of velocities and reactions."""
        return tuple(
            action.subs({s: Expr.generator(reaction_symbol(s.name)) for s in action.reactions})
            for action in self._declared_of(load)
        )


@lru_cache(maxsize=64)
def declared(system: System) -> Placement:
    """The declaration with every body placed."""
    places: dict[Body, Vector] = {}
    elements: tuple[Element, ...] = system.elements
    # An element places its first body from bodies placed before, so the order is found by
    # repetition. A body that no element places is free and gets coordinates of its own.
    while len(places) < len(system.bodies):
        before = len(places)
        for element in elements:
            if element.bodies[0] not in places:
                places |= element.centre(places)
        if len(places) == before:
            flight = system.flights(places)[0]
            places |= flight.centre(places)
            elements = (*elements, flight)
    rates = {_only(q): rate for b in system.bodies for q, rate in b.rates.items()}
    rates |= {_only(q): rate for e in elements for q, rate in e.rates().items()}
    geometry: list[Expr] = []
    for body in system.bodies:
        geometry += [*places[body].components, *body.angular_velocity.components]
        geometry += [frame.angle for frame in body.axes.lineage]
    found = {s.base() for s in variables(geometry) if s.kind is SymbolKind.COORDINATE}
    coordinates = found | rates.keys()
    plain_rates = {q.derivative() for q in coordinates if q not in rates}
    quasi_velocities = {
        s.base() for rate in rates.values() for s in rate.symbols() if s.kind is SymbolKind.SPEED
    }
    own = {_only(s) for body in system.bodies for s in body.speeds}
    speeds = plain_rates | quasi_velocities | own
    replaced: dict[Symbol, Expr] = {}
    if system.speeds:
        replaced = _replaced(system, rates, sorted(speeds, key=_name))
        rates = {q: rate.subs(replaced) for q, rate in rates.items()}
        rates |= {q: replaced[q.derivative()] for q in coordinates if q.derivative() in replaced}
        speeds = (speeds - replaced.keys()) | {symbol for symbol, _ in system.speeds}
    return Placement(
        system,
        places,
        rates,
        tuple(sorted(coordinates, key=_name)),
        tuple(sorted(speeds, key=_name)),
        replaced,
        tuple(r.mapped(lengths_written_out) for e in elements for r in e.restraints(places)),
        _by_normal(f for e in elements for f in e.friction(places)),
    )


def _by_normal(frictions: Iterable[Friction]) -> dict[str, tuple[Friction, ...]]:
    found: dict[str, tuple[Friction, ...]] = {}
    for friction in frictions:
        name = friction.normal.name
        found[name] = (*found.get(name, ()), friction)
    return found


def _replaced(
    system: System, rates: dict[Symbol, Expr], speeds: list[Symbol]
) -> dict[Symbol, Expr]:
    """Speeds in terms of those that the user chose, as many as there are of these.

    Velocities of points and rates of angles are replaced before angular velocities.
    """
    table = {q.derivative(): rate for q, rate in rates.items()}
    parts = [
        (symbol, *linear_parts(meaning.subs(table), speeds)) for symbol, meaning in system.speeds
    ]
    right = [Expr.generator(symbol) - rest for symbol, _, rest in parts]
    turning = {_only(s) for body in system.bodies for s in body.speeds}
    found = eliminate([row for _, row, _ in parts], right, [int(s in turning) for s in speeds])
    return found.in_free(speeds)


def _only(expression: Expr) -> Symbol:
    (symbol,) = expression.symbols()
    return symbol


def _name(symbol: Symbol) -> str:
    return symbol.published


def reaction_symbol(name: str) -> Symbol:
    """The symbol of a reaction component in claims: a function of time, unlike a parameter."""
    return Symbol(name, SymbolKind.FUNCTION)
