"""How everything moves as long as no constraint is kept: what depends on which speeds."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from polhode.algebra import Expr, Symbol, SymbolKind, Vector, linear_parts, variables
from polhode.model import Body, Element, Places, Restraint, System, Velocities


@dataclass(frozen=True)
class Unconstrained:
    """How everything moves as long as no constraint is kept.

    Attributes:
        system: the declaration.
        elements: contacts and joints.
        places: centre of mass of every body, from the origin of the root frame, m.
        restraints: what every contact and joint prescribes, by its name.
        velocities: velocity of the centre of mass and angular velocity of every body.
        rates: of the coordinates that are not speeds themselves.
        speeds: all of them.
    """

    system: System
    elements: tuple[Element, ...]
    places: Places
    restraints: Mapping[str, tuple[Restraint, ...]]
    velocities: Velocities
    rates: Mapping[Symbol, Expr]
    speeds: tuple[Symbol, ...]

    def moving(self, velocity: Vector, direction: Vector) -> list[Symbol]:
        """The speeds on which the component of a place's velocity along a direction depends."""
        if not is_moved(velocity):
            return []
        along = velocity.dot(direction).subs(self.rates)
        slopes, _ = linear_parts(along, self.speeds)
        return [speed for speed, slope in zip(self.speeds, slopes, strict=True) if slope]

    def gaining(self, velocity: Vector) -> list[Symbol]:
        """The speeds on which a place's velocity depends in any direction."""
        return [
            s for s in self.speeds if is_moved(velocity) and not self.slope(velocity, s).is_zero
        ]

    def slope(self, velocity: Vector, speed: Symbol) -> Vector:
        """What a velocity gains with a speed."""
        given = (c.subs(self.rates) for c in velocity.components)
        return Vector(tuple(c.diff(Expr.generator(speed)) for c in given), velocity.triad)

    def movers(self, speeds: Iterable[Symbol]) -> list[Body]:
        """The bodies that move, or turn and resist it, with one of these speeds."""
        wanted = set(speeds)
        return [body for body in self.system.bodies if wanted & self._moving(body)]

    def _moving(self, body: Body) -> frozenset[Symbol]:
        velocity, angular = self.velocities[body]
        resists = any(entry for row in body.inertia.rows for entry in row)
        return variables((*velocity.components, *(angular.components if resists else ())))

    def carried(self, *bodies: Body | None) -> set[Body]:
        """Some bodies, and all that hang on them."""
        found = {body for body in bodies if body is not None}
        while more := [e.bodies[0] for e in self.elements if self._hangs(e, found)]:
            found.update(more)
        return found

    def _hangs(self, element: Element, carriers: set[Body]) -> bool:
        body, *others = element.bodies
        free = body not in carriers and not carriers.isdisjoint(others)
        return free and body in element.centre(self.places)


def is_moved(velocity: Vector) -> bool:
    """Whether a velocity depends on how the system moves, and not on places and time alone."""
    return any(map(_is_free, variables(velocity.components)))


def _is_free(symbol: Symbol) -> bool:
    rate = symbol.kind is SymbolKind.COORDINATE and symbol.order > 0
    return rate or symbol.kind is SymbolKind.SPEED
