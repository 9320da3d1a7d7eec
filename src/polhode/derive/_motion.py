"""Kinematics: coordinates, independent speeds, and the velocity of every body in terms of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import (
    Expr,
    Kind,
    Matrix,
    Row,
    Symbol,
    Vector,
    eliminate,
    linear_parts,
    variables,
)
from polhode.base import ConstraintError
from polhode.model import Body, Element, Restraint, System


@dataclass(frozen=True)
class Motion:
    """How everything moves, once the independent speeds are known.

    Attributes:
        elements: contacts and joints, with free flight for bodies that nothing places.
        places: centre of mass of every body, from the origin of the root frame, m.
        coordinates: all of them, in order of appearance.
        speeds: the independent ones.
        kinematics: rate of every coordinate.
        dependent: the other speeds.
        restraints: what every contact and joint prescribes, by its name.
        velocities: velocity of the centre of mass and angular velocity of every body, in inertial
            space, along the body's axes.
    """

    system: System
    elements: tuple[Element, ...]
    places: dict[Body, Vector]
    coordinates: tuple[Symbol, ...]
    speeds: tuple[Symbol, ...]
    kinematics: dict[Symbol, Expr]
    dependent: dict[Symbol, Expr]
    restraints: dict[str, tuple[Restraint, ...]]
    velocities: dict[Body, tuple[Vector, Vector]]

    @cached_property
    def accelerations(self) -> tuple[Symbol, ...]:
        """Time derivatives of the independent speeds."""
        return tuple(speed.derivative() for speed in self.speeds)

    def rate(self, symbol: Symbol) -> Expr:
        """Time derivative of a symbol along the motion."""
        if symbol.derivative() in self.kinematics and symbol not in self.speeds:
            return self.kinematics[symbol.derivative()]
        if symbol.kind.varies:
            return Expr.generator(symbol.derivative())
        return Expr.constant(1 if symbol.kind is Kind.TIME else 0)

    def on_speeds(self, expression: Expr) -> Expr:
        """With rates and dependent speeds put in terms of the independent speeds."""
        table = {**self.kinematics, **self.dependent}
        return expression.subs({s: e for s, e in table.items() if s not in self.speeds})

    def resolve(self, vector: Vector) -> Vector:
        """A vector with rates and dependent speeds put in terms of the independent speeds."""
        return Vector(tuple(self.on_speeds(c) for c in vector.components), vector.triad)

    def derivative(self, vector: Vector) -> Vector:
        """Time derivative in inertial space along the motion."""
        components = tuple(c.chain(self.rate) for c in vector.components)
        turning = self.resolve(vector.triad.angular_velocity)
        return Vector(components, vector.triad) + turning.cross(vector)

    def point_velocity(self, body: Body, arm: Vector) -> Vector:
        """Velocity of the point of a body at `arm` from its centre of mass, m/s."""
        velocity, angular = self.velocities[body]
        return velocity + angular.cross(arm.express(body.axes))

    def slip(self, restraint: Restraint) -> Vector:
        """Velocity of the restrained point (or of the body's rotation) against its support."""
        own = _against(restraint, self.velocities)
        return own - self.resolve(restraint.velocity)


def motion_of(system: System) -> Motion:
    """Place every body, gather coordinates and speeds, and solve the velocity constraints."""
    elements, places, brought = _placed(system)
    given = _given_rates(system, brought)
    coordinates = _coordinates(system, places, given)
    bare = tuple(q.derivative() for q in coordinates if q not in given)
    quasi = tuple(_quasi_speeds(system, brought))
    rates = {q.derivative(): rate for q, rate in given.items()}
    raw = {body: _raw_velocity(body, places[body], rates) for body in system.bodies}
    restraints = {e.name: e.restraints(places) for e in elements}
    speeds = bare + quasi
    prescribed = [r for group in restraints.values() for r in group]
    dependent = _dependent(prescribed, raw, rates, speeds, _ranks(system, bare, quasi, brought))
    independent = tuple(s for s in speeds if s not in dependent)
    kinematics = {q.derivative(): Expr.generator(q.derivative()) for q in coordinates} | rates
    return Motion(
        system,
        elements,
        places,
        coordinates,
        independent,
        {rate: value.subs(dependent) for rate, value in kinematics.items()},
        dependent,
        restraints,
        {body: _settled(body, pair, dependent) for body, pair in raw.items()},
    )


Brought = Mapping[Symbol, tuple[Body, Expr]]


def _placed(system: System) -> tuple[tuple[Element, ...], dict[Body, Vector], Brought]:
    """Bodies placed by contacts and joints, in whatever order that works; the rest fly freely."""
    places: dict[Body, Vector] = {}
    brought: dict[Symbol, tuple[Body, Expr]] = {}
    flights: tuple[Element, ...] = ()

    def place(elements: Iterable[Element]) -> bool:
        progress = False
        for element in elements:
            if element.bodies[0] in places:
                continue
            for body, centre in element.centre(places).items():
                places[body] = centre
                progress = True
                for coordinate, rate in element.rates().items():
                    brought[_symbol(coordinate)] = (body, rate)
        return progress

    while len(places) < len(system.bodies):
        if not place(system.elements):
            waiting = system.flights(places)[:1]
            flights += waiting
            place(waiting)
    return system.elements + flights, places, brought


def _symbol(expression: Expr) -> Symbol:
    (symbol,) = expression.symbols()
    return symbol


def _given_rates(system: System, brought: Brought) -> dict[Symbol, Expr]:
    given = {_symbol(q): rate for body in system.bodies for q, rate in body.rates.items()}
    return given | {q: rate for q, (_, rate) in brought.items()}


def _coordinates(
    system: System, places: Mapping[Body, Vector], given: Mapping[Symbol, Expr]
) -> tuple[Symbol, ...]:
    found: dict[Symbol, None] = {}
    for body in system.bodies:
        angles = [frame.angle for frame in reversed(body.axes.lineage)]
        own = [_symbol(q) for q in body.rates]
        ordered = [*(sorted(variables([a]), key=_published) for a in angles), own]
        ordered.append(sorted(variables(places[body].components), key=_published))
        for symbol in (s for group in ordered for s in group):
            if symbol.kind is Kind.COORDINATE:
                found.setdefault(symbol.base())
    for symbol in given:
        found.setdefault(symbol)
    return tuple(found)


def _published(symbol: Symbol) -> str:
    return symbol.published


def _quasi_speeds(system: System, brought: Brought) -> dict[Symbol, None]:
    rotational = [s for body in system.bodies for s in body.speeds]
    return dict.fromkeys(_symbol(s) for s in [*rotational, *(r for _, r in brought.values())])


def _raw_velocity(body: Body, place: Vector, rates: Mapping[Symbol, Expr]) -> tuple[Vector, Vector]:
    velocity = place.dt()
    moved = Vector(tuple(c.subs(rates) for c in velocity.components), velocity.triad)
    angular = body.angular_velocity
    return moved, Vector(tuple(c.subs(rates) for c in angular.components), angular.triad)


def _against(restraint: Restraint, velocities: Mapping[Body, tuple[Vector, Vector]]) -> Vector:
    def of(body: Body, arm: Vector | None) -> Vector:
        velocity, angular = velocities[body]
        return angular if arm is None else velocity + angular.cross(arm)

    own = of(restraint.body, restraint.arm)
    if restraint.other is None:
        return own
    return own - of(restraint.other, restraint.other_arm)


def _ranks(
    system: System,
    bare: tuple[Symbol, ...],
    quasi: tuple[Symbol, ...],
    brought: Brought,
) -> dict[Symbol, int]:
    """How readily each speed is given up: translation first, but for balls their rotation.

    That is how a text eliminates: a disk is described by its rotation, a ball by its velocity.
    """
    ranks = dict.fromkeys(bare, 3) | dict.fromkeys(quasi, 1)
    for body, rate in brought.values():
        ranks[_symbol(rate)] = 2 if body.is_isotropic else 0
    return ranks | dict.fromkeys(system.independent, 4)


def _dependent(
    restraints: list[Restraint],
    velocities: Mapping[Body, tuple[Vector, Vector]],
    rates: Mapping[Symbol, Expr],
    speeds: tuple[Symbol, ...],
    ranks: Mapping[Symbol, int],
) -> dict[Symbol, Expr]:
    rows: list[Row] = []
    right: list[Expr] = []
    names: list[str] = []
    for restraint in restraints:
        slip = (_against(restraint, velocities) - restraint.velocity).dot(restraint.direction)
        coefficients, rest = linear_parts(slip.subs(rates), speeds)
        if any(coefficients) or rest:
            rows.append(coefficients)
            right.append(-rest)
            names.append(restraint.name)
    outcome = eliminate(rows, right, [ranks[s] for s in speeds])
    if outcome.contradictory:
        named = ", ".join(names[i] for i in outcome.contradictory)
        raise ConstraintError(
            f"constraints that contradict one another, at {named}",
            expected="constraints that some motion obeys",
            advice="remove one of them, or let the support move as the others demand",
        )
    free = [Expr.generator(speeds[j]) for j in outcome.free]
    return {
        speeds[j]: sum((c * u for c, u in zip(row, free, strict=True)), constant)
        for j, (row, constant) in outcome.solved.items()
    }


def _settled(
    body: Body, pair: tuple[Vector, Vector], dependent: Mapping[Symbol, Expr]
) -> tuple[Vector, Vector]:
    velocity, angular = (
        Vector(tuple(c.subs(dependent) for c in v.components), v.triad).express(body.axes)
        for v in pair
    )
    return velocity, angular


def inertia_times(inertia: Matrix, vector: Vector) -> Vector:
    """Inertia about the centre of mass times angular velocity, both along one triad."""
    return Vector(inertia.times(vector.components), vector.triad)
