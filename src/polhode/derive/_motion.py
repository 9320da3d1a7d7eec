"""Kinematics: coordinates, independent speeds, and the velocity of every body in terms of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import (
    Expr,
    Matrix,
    Symbol,
    SymbolKind,
    Vector,
    variables,
)
from polhode.base import ConstraintError, DeclarationError
from polhode.derive._constraints import Speeds, against, dependent_speeds
from polhode.derive._form import IN_PARTS, Form
from polhode.derive._second_spins import refuse_second_spins
from polhode.derive._unanswered import refuse_unanswered
from polhode.derive._unconstrained import Unconstrained
from polhode.model import Body, Element, Restraint, System


@dataclass(frozen=True)
class Kinematics:
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
        form: closed, or in named parts.
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
    form: Form

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
        return Expr.constant(1 if symbol.kind is SymbolKind.TIME else 0)

    def on_speeds(self, expression: Expr) -> Expr:
        """With rates and dependent speeds put in terms of the independent speeds."""
        table = {**self.kinematics, **self.dependent}
        return expression.subs({s: e for s, e in table.items() if s not in self.speeds})

    def resolve(self, vector: Vector) -> Vector:
        """A vector with rates and dependent speeds put in terms of the independent speeds."""
        settled = Vector(tuple(self.on_speeds(c) for c in vector.components), vector.triad)
        return self.form.kept(settled, self.speeds)

    def derivative(self, vector: Vector) -> Vector:
        """Time derivative in inertial space along the motion."""
        components = tuple(c.chain(self.rate) for c in vector.components)
        turning = self.resolve(vector.triad.angular_velocity)
        rate = Vector(components, vector.triad) + turning.cross(vector)
        return self.form.kept(rate, self.accelerations)

    def spin(self, body: Body) -> Vector:
        """Angular momentum of a body about its centre of mass, kg m²/s, along its axes."""
        inertia = Matrix(
            tuple(tuple(self.form.keep(entry, ()) for entry in row) for row in body.inertia.rows)
        )
        angular = self.velocities[body][1]
        spin = Vector(inertia.times(angular.components), angular.triad)
        return self.form.kept(spin, self.speeds)

    def slip(self, restraint: Restraint) -> Vector:
        """Velocity of the restrained point (or of the body's rotation) against its support."""
        own = against(restraint, self.velocities, self.form, self.speeds)
        return own - self.resolve(restraint.velocity)


def motion_of(system: System, form: Form) -> Kinematics:
    """Place every body, gather coordinates and speeds, and solve the velocity constraints.

    Where places of contact are in named parts already, so is all that follows.

    Raises:
        DeclarationError: for bodies that share coordinates, or independent speeds that are none.
        ConstraintError: for constraints that contradict one another.
    """
    elements, places, brought = _placed(system)
    _refuse_gaps(elements, places)
    restraints = {e.name: e.restraints(places) for e in elements}
    prescribed = [r for group in restraints.values() for r in group]
    if any(r.is_in_parts for r in prescribed):
        form = IN_PARTS
    given = _given_rates(system, brought)
    coordinates = _coordinates(system, places, given)
    bare = tuple(q.derivative() for q in coordinates if q not in given)
    quasi = tuple(_quasi_speeds(system, brought))
    rates = {q.derivative(): rate for q, rate in given.items()}
    speeds = bare + quasi
    raw = {
        body: _kept(_raw_velocity(body, places[body], rates), form, speeds)
        for body in system.bodies
    }
    unconstrained = Unconstrained(system, elements, places, restraints, raw, rates, speeds)
    refuse_second_spins(unconstrained)
    refuse_unanswered(unconstrained)
    ranks = _ranks(system, bare, quasi, brought)
    dependent = dependent_speeds(prescribed, raw, rates, ranks, form)
    independent = tuple(s for s in speeds if s not in dependent)
    kinematics = {q.derivative(): Expr.generator(q.derivative()) for q in coordinates} | rates
    return Kinematics(
        system,
        elements,
        places,
        coordinates,
        independent,
        {rate: form.keep(e.subs(dependent), independent) for rate, e in kinematics.items()},
        dependent,
        restraints,
        {body: _settled(body, pair, dependent, form, independent) for body, pair in raw.items()},
        form,
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
                    first, _ = brought.setdefault(_symbol(coordinate), (body, rate))
                    if first != body:
                        raise _shared(f"coordinate {coordinate}", first, body)
        return progress

    while len(places) < len(system.bodies):
        if not place(system.elements):
            waiting = system.flights(places)[:1]
            flights += waiting
            place(waiting)
    return system.elements + flights, places, brought


def _shared(what: str, first: Body, second: Body) -> DeclarationError:
    return DeclarationError(
        f"the {what} of both {first.name!r} and {second.name!r}",
        expected="coordinates and speeds of its own for every body that moves by itself",
        advice="give one of them a tag, such as tag='2'",
    )


def _refuse_gaps(elements: Iterable[Element], places: Mapping[Body, Vector]) -> None:
    """A loop that no configuration closes."""
    for element in elements:
        for gap in element.closures(places):
            if not any(s.kind is SymbolKind.COORDINATE for s in gap.symbols()):
                raise ConstraintError(
                    f"{element.name!r}, which never closes: {gap} would have to vanish",
                    expected="bodies that can be where all contacts and joints want them",
                    advice="check lengths and places, or leave this one out",
                )


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
            if symbol.kind is SymbolKind.COORDINATE:
                found.setdefault(symbol.base())
    for symbol in given:
        found.setdefault(symbol)
    return tuple(found)


def _published(symbol: Symbol) -> str:
    return symbol.published


def _quasi_speeds(system: System, brought: Brought) -> dict[Symbol, None]:
    rotational: dict[Symbol, Body] = {}
    for body in system.bodies:
        for speed in map(_symbol, body.speeds):
            first = rotational.setdefault(speed, body)
            if (first.axes, first.spin) != (body.axes, body.spin):
                raise _shared(f"speed {speed.published}", first, body)
    return dict.fromkeys([*rotational, *(_symbol(rate) for _, rate in brought.values())])


def _raw_velocity(body: Body, place: Vector, rates: Mapping[Symbol, Expr]) -> tuple[Vector, Vector]:
    velocity = place.dt()
    moved = Vector(tuple(c.subs(rates) for c in velocity.components), velocity.triad)
    angular = body.angular_velocity
    return moved, Vector(tuple(c.subs(rates) for c in angular.components), angular.triad)


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
    _refuse_unknown(system.independent, ranks)
    return ranks | dict.fromkeys(system.independent, 4)


def _refuse_unknown(wanted: Iterable[Symbol], speeds: Mapping[Symbol, int]) -> None:
    for symbol in wanted:
        if symbol not in speeds:
            raise DeclarationError(
                f"independent={symbol.published}",
                expected=f"one of the speeds {', '.join(s.published for s in speeds)}",
                advice="name the rate of a coordinate, as in theta.dt()",
            )


Pair = tuple[Vector, Vector]


def _kept(pair: Pair, form: Form, speeds: Speeds) -> Pair:
    first, second = (form.kept(vector, speeds) for vector in pair)
    return first, second


def _settled(
    body: Body, pair: Pair, dependent: Mapping[Symbol, Expr], form: Form, speeds: Speeds
) -> Pair:
    """Both in terms of the independent speeds, along the body's axes."""

    def settled(vector: Vector) -> Vector:
        solved = Vector(tuple(c.subs(dependent) for c in vector.components), vector.triad)
        along = form.express(form.kept(solved, speeds), body.axes)
        return form.kept(along, speeds)

    velocity, angular = map(settled, pair)
    return velocity, angular
