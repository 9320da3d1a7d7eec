"""Quantities that texts derive from the basic ones: speeds, tensions, Hamiltonians, periods.

Each is a function of the mechanics of a system, in SI units, and raises `DeclarationError` for a
system that does not have it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

from polhode.algebra import (
    ZERO,
    Expr,
    Symbol,
    SymbolKind,
    Vector,
    cos,
    length,
    linear_parts,
    principal_root,
    sin,
    solve,
    sqrt,
)
from polhode.base import DeclarationError
from polhode.judge.meaning._mechanics import Mechanics
from polhode.model import Body, Contact, Coulomb, Gravity, Pivot

_LONGEST = 120  # terms of a component of a vector whose magnitude is formed


# -- vectors by one number ----------------------------------------------------------------------


def component(mechanics: Mechanics, vector: Vector, direction: str, of: str) -> Expr:
    """The component of a vector along its axis of rotation, along a path or down the slope."""
    match direction:
        case "its axis of rotation":
            return along_rotation(mechanics, vector)
        case "its path":
            return vector.dot(direction_of_path(mechanics, of))
    return vector.dot(down_the_slope(mechanics))


def magnitude(vector: Vector) -> Expr:
    """The length of a vector.

    Raises `DeclarationError` for components so long that their squares would take minutes.
    """
    longest = max(map(length, vector.components))
    if longest > _LONGEST:
        raise DeclarationError(
            f"the magnitude of a vector with components of {longest} terms",
            expected=f"at most {_LONGEST}",
            advice="write its components, or the square of its magnitude",
        )
    return sqrt(vector.dot(vector))


@lru_cache(maxsize=16)  # systems; mechanics are compared by identity
def polar_sines(mechanics: Mechanics) -> tuple[Expr, ...]:
    """The sines of polar angles, which run from 0 to π.

    A polar angle is that of an axis to the vertical, beside an azimuth: Euler's second angle θ.
    """
    if not has_gravity(mechanics):
        return ()
    axes, weight = mechanics.body.axes, mechanics.gravity()
    up = -weight / magnitude(weight)
    found = []
    for axis in (axes[label] for label in axes.labels):
        directions = {s for c in axis.express(axes.root).components for s in c.symbols()}
        for q in mechanics.declared.coordinates:
            angle = Expr.generator(q)
            if axis.dot(up) in (cos(angle), -cos(angle)) and directions != {q}:
                found.append(sin(angle))
    return tuple(dict.fromkeys(found))


def axis_of_rotation(mechanics: Mechanics) -> Vector:
    """The direction of a body's angular velocity, where that never changes.

    Several bodies have one if they turn together.

    It points so that turning counts as the coordinate or speed does that it is proportional to.
    """
    others = (b.angular_velocity for b in mechanics.bodies[1:])
    if not all((mechanics.angular_velocity() - other).is_zero for other in others):
        raise DeclarationError("the axis of rotation", expected="bodies that turn together")
    return _axis_of(mechanics, mechanics.angular_velocity())


def _axis_of(mechanics: Mechanics, angular_velocity: Vector) -> Vector:
    """The direction of an angular velocity, where that never changes."""
    turning = mechanics.in_speeds(angular_velocity)
    assert isinstance(turning, Vector)
    root = mechanics.body.axes.root
    along = turning.express(root).components
    found = [i for i, component in enumerate(along) if component]
    if len(found) != 1:
        raise DeclarationError("the axis of rotation", expected="a body that turns about one axis")
    axis = root[root.labels[found[0]]]
    return axis if _counts_positive(along[found[0]]) else -axis


def along_rotation(mechanics: Mechanics, vector: Vector) -> Expr:
    """The component of a vector along the fixed axis about which a body turns."""
    return vector.dot(axis_of_rotation(mechanics))


def moment_of_inertia(mechanics: Mechanics, about: str) -> Expr:
    """About a point, along the fixed axis about which a body turns, kg m²."""
    axis = axis_of_rotation(mechanics)
    return axis.dot(mechanics.inertia(about=about).of(axis))


def own_moment_of_inertia(mechanics: Mechanics, of: str) -> Expr:
    """Of one of several bodies, such as a pulley, about its centre and along its axis, kg m²."""
    axis = _axis_of(mechanics, mechanics.angular_velocity(of))
    return axis.dot(mechanics.inertia(of).of(axis))


def radius_of_gyration(mechanics: Mechanics, about: str) -> Expr:
    """The distance √(I/M) at which the whole mass has the same moment of inertia I, m.

    I is that about the fixed axis about which a body turns, or one that is the same about all axes.
    """
    try:
        inertia = moment_of_inertia(mechanics, about)
    except DeclarationError:
        inertia = moment_about_any_axis(mechanics, about)
    return sqrt(inertia / mechanics.body.mass)


def moment_about_any_axis(mechanics: Mechanics, about: str) -> Expr:
    """Of a body such as a ball, which has one moment of inertia about all axes, kg m²."""
    rows = mechanics.inertia(about=about).matrix.rows
    size = rows[0][0]
    entries = ((i == j, entry) for i, row in enumerate(rows) for j, entry in enumerate(row))
    if not size or any(entry != (size if is_diagonal else ZERO) for is_diagonal, entry in entries):
        raise DeclarationError(
            f"the moment of inertia about {about}", expected="a body with the same about all axes"
        )
    return size


def down_the_slope(mechanics: Mechanics) -> Vector:
    """The direction of steepest descent of the plane that a body is on."""
    contact = _only_contact(mechanics)
    weight = mechanics.gravity()
    for label in contact.on.tangents:
        pull = weight.dot(contact.on.axes[label])
        if pull:
            axis = contact.on.axes[label]
            return axis if _counts_positive(pull) else -axis
    raise DeclarationError("the direction down a slope", expected="a tilted plane")


def direction_of_path(mechanics: Mechanics, of: str) -> Vector:
    """The direction in which a body of a system with one freedom moves as its speed grows."""
    speeds, root = mechanics.equations.speeds, mechanics.equations.system.root
    if len(speeds) != 1:
        raise DeclarationError("the path of a body", expected="a system with one freedom")
    velocity = mechanics.velocity(of).express(root)
    known = {q.derivative(): rate for q, rate in mechanics.declared.rates.items()}
    in_speeds = (c.subs(known).subs(mechanics.equations.dependent) for c in velocity.components)
    along = (c.diff(speeds[0]) for c in in_speeds)
    return _unit(Vector(tuple(along), root), "the path of a body")


def direction_of_increasing(mechanics: Mechanics, coordinate: str) -> Vector:
    """The direction ∂r/∂q in which the only body moves as one coordinate grows: θ̂."""
    known = {q.published: q for q in mechanics.declared.coordinates}
    if coordinate not in known or len(mechanics.bodies) > 1:
        raise DeclarationError(
            f"the direction of increasing {coordinate}", expected="a coordinate of a single body"
        )
    root = mechanics.equations.system.root
    place = mechanics.position().express(root).components
    tangent = Vector(tuple(c.diff(known[coordinate]) for c in place), root)
    return _unit(tangent, f"the direction of increasing {coordinate}")


def _unit(tangent: Vector, what: str) -> Vector:
    if tangent.is_zero:
        raise DeclarationError(what, expected="a coordinate or speed that moves the body")
    # The polar angle θ runs from 0 to π, so that |∂r/∂φ| is R sin θ without a sign.
    return tangent / principal_root(tangent.dot(tangent))


def outwards(mechanics: Mechanics) -> Vector:
    """The direction from the origin to the first body: r̂."""
    place = mechanics.position()
    if place.is_zero:
        raise DeclarationError("the direction of the position", expected="a body off the origin")
    return place / magnitude(place)


def _counts_positive(expression: Expr) -> bool:
    """Whether the leading coefficient of an expression is positive."""
    _, leading = next(iter(expression.numerator.terms()))
    _, below = next(iter(expression.denominator.terms()))
    return bool(leading * below > 0)


# -- reactions ----------------------------------------------------------------------------------


def tension(mechanics: Mechanics, of: str) -> Expr:
    """The force of a string or light rod on a particle, towards the point that holds it, N."""
    arm = mechanics.arm(of)
    if arm.is_zero:
        raise DeclarationError(f"the tension of {of!r}", expected="a string or a rod with a length")
    return mechanics.force(of).dot(arm) / magnitude(arm)


def normal_force(mechanics: Mechanics, of: str) -> Expr:
    """The force of a support on a body along the support's normal, N."""
    contact = _contact(mechanics, of)
    return mechanics.force(of).dot(contact.on.up)


def friction(mechanics: Mechanics, of: str) -> Expr:
    """The magnitude of the force of a support within its plane, N."""
    return magnitude(tangential_force(mechanics, of))


def tangential_force(mechanics: Mechanics, of: str) -> Vector:
    """The force of a support within its plane: static or sliding friction, N."""
    up, force = _contact(mechanics, of).on.up, mechanics.force(of)
    return force - up * force.dot(up)


def rotation_of_support(mechanics: Mechanics, of: str) -> Vector:
    """The angular velocity of the support of a contact, such as a turntable, rad/s."""
    support = _contact(mechanics, of).on
    return support.angular_velocity


def vertical_force(mechanics: Mechanics, of: str) -> Expr:
    """The force of a support against gravity, N."""
    weight = mechanics.gravity()
    return -mechanics.force(of).dot(weight) / magnitude(weight)


def friction_coefficient(mechanics: Mechanics, of: str) -> Expr:
    """The coefficient of kinetic friction of a contact."""
    contact = _contact(mechanics, of)
    if not isinstance(contact, Coulomb):
        raise DeclarationError(f"the friction of {of!r}", expected="a contact with dry friction")
    return contact.mu


def _contact(mechanics: Mechanics, name: str) -> Contact:
    for element in mechanics.equations.system.elements:
        if element.name == name and isinstance(element, Contact):
            return element
    raise DeclarationError(f"contact {name!r}", expected="a contact of the system")


def _only_contact(mechanics: Mechanics) -> Contact:
    found = mechanics.equations.system.contacts
    if len(found) != 1:
        raise DeclarationError("the support of the body", expected="a system with one contact")
    return found[0]


def holds_a_particle(pivot: Pivot) -> bool:
    """Whether a joint is the end of a string or light rod: it holds a particle at a distance."""
    return not pivot.at.is_zero and pivot.body.inertia.is_zero


# -- energies -----------------------------------------------------------------------------------


def kinetic_energy_of(mechanics: Mechanics, body: Body) -> Expr:
    """Of one body, J."""
    velocity, turning = mechanics.declared.places[body].dt(), body.angular_velocity
    rotation = turning.dot(mechanics.inertia(body.name).of(turning))
    return (velocity.dot(velocity) * body.mass + rotation) / 2


@dataclass(frozen=True)
class PhaseSpace:
    """The coordinates of a system with the momenta conjugate to them.

    Attributes:
        rates: of the coordinates, each with the symbol of its momentum.
        momenta: those symbols, with the momenta as functions of coordinates and rates.
        rates_by_momenta: the rates as functions of coordinates and momenta.
        cyclic: symbols of the momenta that are conserved, as far as the Lagrangian tells.
    """

    rates: dict[Symbol, Symbol]
    momenta: dict[Symbol, Expr]
    rates_by_momenta: dict[Symbol, Expr]
    cyclic: frozenset[Symbol]

    def is_constant(self, quantity: Expr) -> bool:
        """Whether a function of coordinates and rates is one of cyclic momenta alone."""
        symbols = self.by_momenta(quantity).symbols()
        free = {s for s in symbols if s.kind.varies or s in self.momenta}
        return free <= self.cyclic

    def by_momenta(self, quantity: Expr) -> Expr:
        """A function of coordinates and rates, as one of coordinates and momenta."""
        return quantity.subs(self.rates_by_momenta)

    def by_rates(self, quantity: Expr) -> Expr:
        """A function of coordinates and momenta, as one of coordinates and rates."""
        return quantity.subs(self.momenta)


def independent(mechanics: Mechanics) -> dict[Symbol, Expr]:
    """The coordinates that constraints determine, as functions of those that they leave free.

    Raises `DeclarationError` where that is not known: rolling constrains velocities only.
    """
    equations, rates = mechanics.equations, mechanics.declared.rates
    speeds = {
        q: {q.derivative(), *rates.get(q, ZERO).symbols()} for q in mechanics.declared.coordinates
    }
    bound = [q for q, used in speeds.items() if not used.isdisjoint(equations.dependent)]
    found: dict[Symbol, Expr] = {}
    for closure in equations.closures:
        rest = closure.subs(found)
        for q in bound:
            slope = rest.diff(q)
            if q not in found and slope and not slope.varies:
                value = -(rest - slope * Expr.generator(q)) / slope
                found = {s: e.subs({q: value}) for s, e in found.items()} | {q: value}
                break
    # A closure that is not solved for a coordinate would leave one too many.
    is_closed = not any(closure.subs(found) for closure in equations.closures)
    if len(found) < len(bound) or not is_closed:
        raise DeclarationError(
            "the conjugate momenta", expected="coordinates between which there is no constraint"
        )
    return found


def _on_constraints(expression: Expr, found: dict[Symbol, Expr]) -> Expr:
    """A function of coordinates and rates, in terms of those that constraints leave free."""
    rates = {q.derivative(): value.dt() for q, value in found.items()}
    return expression.subs(rates).subs(found) if found else expression


def in_independent_rates(mechanics: Mechanics, expression: Expr) -> Expr:
    """With speeds expressed by the rates of coordinates that constraints leave free."""
    return _on_constraints(mechanics.in_rates(expression), independent(mechanics))


@lru_cache(maxsize=16)  # systems
def phase_space(mechanics: Mechanics) -> PhaseSpace:
    """The momenta ∂L/∂q̇ of a system whose rates of coordinates are independent.

    Coordinates that constraints determine by the others are eliminated.
    """
    eliminated = independent(mechanics)
    coordinates = (q for q in mechanics.declared.coordinates if q not in eliminated)
    rates = tuple(q.derivative() for q in coordinates)
    lagrangian = in_independent_rates(mechanics, mechanics.lagrangian())
    if any(s.kind is SymbolKind.SPEED and s not in rates for s in lagrangian.symbols()):
        raise DeclarationError(
            "the conjugate momenta", expected="a system whose rates of coordinates are independent"
        )
    symbols = [Symbol(f"momentum_{rate.base().published}") for rate in rates]
    momenta = [lagrangian.diff(rate) for rate in rates]
    moving = [i for i, momentum in enumerate(momenta) if momentum]
    parts = [linear_parts(momenta[i], [rates[j] for j in moving]) for i in moving]
    right = [Expr.generator(symbols[i]) - rest for i, (_, rest) in zip(moving, parts, strict=True)]
    try:
        found = solve([row for row, _ in parts], right)
    except ZeroDivisionError:
        raise DeclarationError(
            "the rates in terms of momenta", expected="a system with an invertible mass matrix"
        ) from None
    return PhaseSpace(
        dict(zip(rates, symbols, strict=True)),
        dict(zip(symbols, momenta, strict=True)),
        {rates[i]: rate for i, rate in zip(moving, found, strict=True)},
        frozenset(s for s, r in zip(symbols, rates, strict=True) if not lagrangian.diff(r.base())),
    )


def generalised_force(mechanics: Mechanics, coordinate: str) -> Expr:
    """-∂V/∂q of a system in which only loads with a potential do work, in N or N m."""
    if mechanics.has_other_loads:
        raise DeclarationError("a generalised force", expected="loads that have a potential")
    found = {r.base().published: r.base() for r in phase_space(mechanics).rates}
    if coordinate not in found:
        raise DeclarationError(
            f"the generalised force of {coordinate}", expected=f"one of {', '.join(found)}"
        )
    return -in_independent_rates(mechanics, mechanics.potential_energy()).diff(found[coordinate])


def conjugate_momentum(mechanics: Mechanics, coordinate: str) -> Expr:
    """∂L/∂q̇, where coordinates are eliminated that constraints determine by the others."""
    try:
        eliminated = independent(mechanics)
    except DeclarationError:
        eliminated = {}
    if not eliminated or coordinate in {q.published for q in eliminated}:
        return mechanics.conjugate(coordinate)
    space = phase_space(mechanics)
    found = (space.momenta[p] for r, p in space.rates.items() if r.base().published == coordinate)
    return next(found, None) or mechanics.conjugate(coordinate)


def hamiltonian(mechanics: Mechanics) -> Expr:
    """Σ p q̇ - L, J: the energy, unless constraints move or axes turn as prescribed."""
    space = phase_space(mechanics)
    lagrangian = in_independent_rates(mechanics, mechanics.lagrangian())
    work = (Expr.generator(rate) * space.momenta[symbol] for rate, symbol in space.rates.items())
    return sum(work, ZERO) - lagrangian


def routhian(mechanics: Mechanics) -> Expr:
    """Σ p q̇ - L with the sum over cyclic coordinates, J; others define it with the opposite sign.

    See Goldstein, Classical Mechanics, § 8.3.
    """
    space = phase_space(mechanics)
    cyclic = [(r, p) for r, p in space.rates.items() if p in space.cyclic]
    if not cyclic:
        raise DeclarationError("the Routhian", expected="a system with cyclic coordinates")
    work = sum((Expr.generator(r) * space.momenta[p] for r, p in cyclic), ZERO)
    return work - in_independent_rates(mechanics, mechanics.lagrangian())


def effective_potential(mechanics: Mechanics) -> Expr:
    """The energy with the other coordinates at rest and the momenta of cyclic ones held, J.

    It is a function of the coordinates and these momenta: the negative of the Routhian at rest
    (Goldstein, Classical Mechanics, § 8.3). Where constraints move, as on a hoop that is kept
    turning, it contains the energy of that motion: V - mω²R² sin²θ/2.
    """
    space = phase_space(mechanics)
    lagrangian = in_independent_rates(mechanics, mechanics.lagrangian())
    cyclic = {rate for rate, momentum in space.rates.items() if momentum in space.cyclic}
    resting = lagrangian.subs({rate: ZERO for rate in space.rates if rate not in cyclic})
    is_carried = resting != -in_independent_rates(mechanics, mechanics.potential_energy())
    if len(cyclic) == len(space.rates) or not (cyclic or is_carried):
        raise DeclarationError(
            "the effective potential",
            expected="a system with cyclic and other coordinates, or with moving constraints",
        )
    order = tuple(sorted(cyclic, key=lambda symbol: symbol.published))
    parts = [linear_parts(resting.diff(rate), order) for rate in order]
    right = [Expr.generator(space.rates[r]) - p[1] for r, p in zip(order, parts, strict=True)]
    rates = dict(zip(order, solve([row for row, _ in parts], right), strict=True))
    routhian = resting.subs(rates) - sum(
        (Expr.generator(space.rates[rate]) * rates[rate] for rate in order), ZERO
    )
    return space.by_rates(-routhian)


def has_gravity(mechanics: Mechanics) -> bool:
    """Whether the system is declared with gravity."""
    return any(isinstance(load, Gravity) for load in mechanics.equations.system.loads)
