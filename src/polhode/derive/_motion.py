"""Kinematics: coordinates, independent speeds, and the velocity of every body in terms of them.

Steps: contacts and joints place the bodies; coordinates and speeds are collected; every velocity is
written in all of these speeds; the constraints eliminate the dependent speeds
(`derive._constraints`, which also gives their order); velocities are resolved along the axes of
their bodies in the independent speeds alone.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import (
    Expr,
    Matrix,
    Row,
    Symbol,
    SymbolKind,
    Vector,
    linear_parts,
    variables,
)
from polhode.base import ConstraintError, DeclarationError
from polhode.derive._chosen_speeds import chosen_speeds
from polhode.derive._constraints import (
    VelocityConstraint,
    dependent_speeds,
    elimination_ranks,
    further_velocity,
    refuse_redundant,
    relative_velocity,
    velocity_at,
    velocity_constraints,
)
from polhode.derive._form import IN_PARTS, Form
from polhode.derive._unconstrained import Unconstrained, refuse_second_spins, refuse_unfelt_forces
from polhode.derive._zero_gradients import refuse_zero_gradients
from polhode.model import Body, Constraint, Contact, Element, Frame, Load, Restraint, Share, System

_RATE = 3  # rank of the rate of a coordinate that nobody chose as a speed


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
        unconstrained: the same in terms of all speeds, independent and dependent.
        all_speeds: these.
        rates: of the coordinates that are not speeds themselves, in terms of all speeds.
        constraints: what every restraint prescribes, in terms of all speeds.
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
    unconstrained: dict[Body, tuple[Vector, Vector]]
    all_speeds: tuple[Symbol, ...]
    rates: dict[Symbol, Expr]
    constraints: tuple[VelocityConstraint, ...]
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

    def potential(self, load: Load) -> Expr | None:
        """The potential energy of a load, J, if it has one."""
        stored = load.potential(self.system.bodies, self.places)
        return None if stored is None else self.form.lengths(stored)

    def on_speeds(self, expression: Expr) -> Expr:
        """With rates and dependent speeds expressed in the independent speeds."""
        return expression.subs(self.in_speeds)

    @cached_property
    def in_speeds(self) -> dict[Symbol, Expr]:
        """Rates and dependent speeds, each by the independent speeds."""
        table, own = {**self.kinematics, **self.dependent}, set(self.speeds)
        return {s: e for s, e in table.items() if s not in own}

    def resolve(self, vector: Vector) -> Vector:
        """A vector with rates and dependent speeds expressed in the independent speeds."""
        return self.form.kept(vector.mapped(self.on_speeds), self.speeds)

    def derivative(self, vector: Vector) -> Vector:
        """Time derivative in inertial space along the motion: d/dt along the triad, plus Ω ×.

        Goldstein, Classical Mechanics, § 4.9; problem set, eq. (5).
        """
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

    def speeds_of(self, body: Body) -> frozenset[Symbol]:
        """The independent speeds with which a body moves."""
        found = variables(c for vector in self.velocities[body] for c in vector.components)
        return frozenset(self.speeds) & found

    def slip(self, restraint: Restraint) -> Vector:
        """Velocity of the restrained point (or of the body's rotation) relative to its support."""
        own = relative_velocity(restraint, self.velocities, self.form, self.speeds)
        return own - self.resolve(restraint.velocity)

    def excluded(self, restraint: Restraint) -> Expr:
        """The velocity that a restraint keeps at zero, m/s or rad/s."""
        along = self.slip(restraint).dot(restraint.direction)
        return along + further_velocity(restraint, self.velocities, self.form, self.speeds)

    def constraint_rows(self) -> list[Row]:
        """The coefficients of all speeds in what every restraint keeps at zero."""
        return [constraint.coefficients for constraint in self.constraints]

    def moving_rows(self) -> list[Row]:
        """The coefficients of all speeds in the velocities and rotations of bodies that resist."""
        rows = []
        for body, (velocity, angular) in self.unconstrained.items():
            resisting = (velocity, body.mass != 0), (angular, not body.inertia.is_zero)
            components = (c for vector, resists in resisting if resists for c in vector.components)
            rows += [linear_parts(c, self.all_speeds)[0] for c in components]
        return rows

    def velocity_along(self, share: Share) -> Expr:
        """The velocity of a point or rotation along a reaction's direction, in all speeds."""
        moved = velocity_at(share.body, share.arm, self.unconstrained, self.form, self.all_speeds)
        return share.direction.dot(moved)


def motion_of(system: System, form: Form) -> Kinematics:
    """Place every body, gather coordinates and speeds, and solve the velocity constraints.

    Speeds are rates of coordinates or, where a body or contact declares them, quasi-velocities
    (generalized speeds of Kane and Levinson): angular velocities along the body's axes, velocities
    of centres of mass. If points of contact are in named parts, so are all results.

    Raises:
        DeclarationError: for bodies that share coordinates, or unknown independent speeds.
        ConstraintError: for constraints that contradict one another.
    """
    elements, places, contact_rates = _placed(system)
    _refuse_open_loops(elements, places)
    refuse_zero_gradients(elements, places)
    restraints = {
        e.name: tuple(r.mapped(form.directions) for r in e.restraints(places)) for e in elements
    }
    prescribed = [r for group in restraints.values() for r in group]
    if any(r.is_in_parts for r in prescribed):
        form = IN_PARTS
    quasi_rates = {_symbol(q): rate for body in system.bodies for q, rate in body.rates.items()}
    quasi_rates |= {q: rate for q, (_, rate) in contact_rates.items()}
    coordinates = _coordinates(system, places, quasi_rates)
    bare = tuple(q.derivative() for q in coordinates if q not in quasi_rates)
    rotations = _rotational_speeds(system)
    translations = {_symbol(rate): body for body, rate in contact_rates.values()}
    speeds = bare + tuple(dict.fromkeys([*rotations, *translations]))
    rates = _in_speeds({q.derivative(): rate for q, rate in quasi_rates.items()}, form, speeds)
    own = chosen_speeds(
        system.speeds,
        speeds,
        rates,
        {s: 1 if s in translations or s in rotations else 0 for s in speeds},
        form,
    )
    if own.chosen:
        speeds = (*(s for s in speeds if s not in own.replaced), *own.chosen)
        inserted = {q: form.keep(rate.subs(own.replaced), speeds) for q, rate in rates.items()}
        rates = {**inserted, **own.replaced}
    raw = {}
    for body in system.bodies:
        pair = (places[body].dt(), body.angular_velocity)
        velocity, angular = (form.kept(v.subs(rates), speeds) for v in pair)
        raw[body] = velocity, angular
    unconstrained = Unconstrained(system, elements, places, restraints, raw, rates, speeds)
    refuse_second_spins(unconstrained)
    refuse_unfelt_forces(unconstrained)
    # the rate of a coordinate may be a speed of another name, as v_x of x
    named = {q: s for q, e in rates.items() for s in speeds if e == Expr.generator(s)}
    kept = [named.get(s, s) for s in system.independent]
    ranks = elimination_ranks(bare, rotations, translations, own.chosen, kept)
    ranks |= {speed: 0 for speed in _along_supports(elements) if ranks.get(speed) == _RATE}
    ranks = {speed: ranks[speed] for speed in speeds}
    constraints = velocity_constraints(prescribed, raw, rates, form, speeds)
    dependent = dependent_speeds(constraints, ranks, form)
    given = {e.name: restraints[e.name] for e in elements if isinstance(e, Constraint)}
    refuse_redundant(given, constraints, ranks, form)
    independent = tuple(s for s in speeds if s not in dependent)

    def along_axes(vector: Vector, body: Body) -> Vector:
        solved = form.kept(vector.subs(dependent), independent)
        return form.kept(form.express(solved, body.axes), independent)

    places_rates = {q.derivative(): Expr.generator(q.derivative()) for q in coordinates}
    kinematics = places_rates | {rate: e for rate, e in rates.items() if rate in places_rates}
    others = {
        speed: form.keep(e.subs(dependent), independent)
        for speed, e in own.replaced.items()
        if speed not in places_rates
    }
    return Kinematics(
        system,
        elements,
        places,
        coordinates,
        independent,
        {rate: form.keep(e.subs(dependent), independent) for rate, e in kinematics.items()},
        dependent | others,
        restraints,
        {b: (along_axes(v, b), along_axes(w, b)) for b, (v, w) in raw.items()},
        raw,
        speeds,
        rates,
        constraints,
        form,
    )


def _along_supports(elements: Iterable[Element]) -> Iterator[Symbol]:
    """Rates of where curved supports are touched by bodies whose attitude matters.

    Like a disk on a plane, these are described by their rotation; a ball, and a wheel whose axle
    does not turn, by where they are.
    """
    for contact in (e for e in elements if isinstance(e, Contact)):
        body = contact.body
        if body.axes.turns_freely and not body.is_isotropic and not contact.rates():
            yield from (_symbol(q).derivative() for q in contact.introduced())


def _in_speeds(
    rates: dict[Symbol, Expr], form: Form, speeds: tuple[Symbol, ...]
) -> dict[Symbol, Expr]:
    """Rates in terms of speeds alone.

    The rates of the angles of a body on axes that another body carries contain those of the other
    body, whose angular velocity may be declared as well.
    """
    while any(not rates.keys().isdisjoint(rate.symbols()) for rate in rates.values()):
        rates = {q: form.keep(rate.subs(rates), speeds) for q, rate in rates.items()}
    return rates


#: Coordinates that contacts and joints introduce: the body they place, and the rate.
ContactRates = Mapping[Symbol, tuple[Body, Expr]]


def _placed(system: System) -> tuple[tuple[Element, ...], dict[Body, Vector], ContactRates]:
    """Centres of mass by contacts and joints, in any order that works; other bodies fly freely."""
    places: dict[Body, Vector] = {}
    contact_rates: dict[Symbol, tuple[Body, Expr]] = {}
    owners: dict[Symbol, Body] = {}
    flights: tuple[Element, ...] = ()

    def place(elements: Iterable[Element]) -> bool:
        progress = False
        for element in elements:
            if element.bodies[0] in places:
                continue
            for body, centre in element.centre(places).items():
                places[body] = centre
                progress = True
                for coordinate in element.introduced():
                    first = owners.setdefault(_symbol(coordinate), body)
                    if first != body:
                        raise _shared(f"coordinate {coordinate}", first, body)
                for coordinate, rate in element.rates().items():
                    contact_rates[_symbol(coordinate)] = (body, rate)
        return progress

    while len(places) < len(system.bodies):
        if not place(system.elements):
            waiting = system.flights(places)[:1]
            flights += waiting
            place(waiting)
    return system.elements + flights, places, contact_rates


def _refuse_open_loops(elements: Iterable[Element], places: Mapping[Body, Vector]) -> None:
    """Refuse loops that no configuration closes."""
    for element in elements:
        for gap in element.closures(places):
            if not any(s.kind is SymbolKind.COORDINATE for s in gap.symbols()):
                raise ConstraintError(
                    f"{element.name!r}, which never closes: {gap} would have to vanish",
                    expected="a configuration that satisfies all contacts and joints",
                    advice="check lengths and positions, or leave this one out",
                )


def _shared(what: str, first: Body, second: Body) -> DeclarationError:
    return DeclarationError(
        f"the {what} of both {first.name!r} and {second.name!r}",
        expected="separate coordinates and speeds for every body that moves independently",
        advice="give one of them a tag, such as tag='2'",
    )


def _coordinates(
    system: System, places: Mapping[Body, Vector], quasi_rates: Mapping[Symbol, Expr]
) -> tuple[Symbol, ...]:
    """In order of appearance: angles of the axes from the root on, spin, place, body by body."""

    def varying(expressions: Iterable[Expr]) -> list[Symbol]:
        return sorted(variables(expressions), key=lambda symbol: symbol.published)

    found: dict[Symbol, None] = {}
    for body in system.bodies:
        symbols = [s for frame in reversed(body.axes.lineage) for s in varying([frame.angle])]
        symbols += [_symbol(q) for q in body.rates]
        symbols += varying(places[body].components)
        # on a curved support the triad at the contact turns with the place
        symbols += [s for f in reversed(_lineage(places[body])) for s in varying([f.angle])]
        for symbol in symbols:
            if symbol.kind is SymbolKind.COORDINATE:
                found.setdefault(symbol.base())
    return tuple(found | dict.fromkeys(quasi_rates))


def _lineage(vector: Vector) -> tuple[Frame, ...]:
    """The frame along which a vector is resolved, its parent, and so on to the root."""
    return vector.triad.lineage if isinstance(vector.triad, Frame) else ()


def _rotational_speeds(system: System) -> list[Symbol]:
    """Angular velocities that bodies declare; only bodies that turn alike may share one."""
    owners: dict[Symbol, Body] = {}
    for body in system.bodies:
        for speed in map(_symbol, body.speeds):
            first = owners.setdefault(speed, body)
            if (first.axes, first.spin) != (body.axes, body.spin):
                raise _shared(f"speed {speed.published}", first, body)
    return list(owners)


def _symbol(expression: Expr) -> Symbol:
    (symbol,) = expression.symbols()
    return symbol
