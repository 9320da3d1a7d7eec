"""Quantities that texts derive from the basic ones: speeds, tensions, Hamiltonians, periods.

Each is a function of the mechanics of a system, in SI units, and raises `DeclarationError` for a
system that does not have it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

from polhode.algebra import (
    ZERO,
    Expr,
    Symbol,
    SymbolKind,
    Vector,
    linear_parts,
    pi,
    solve,
    sqrt,
)
from polhode.base import DeclarationError, PolhodeError
from polhode.claims.meaning._mechanics import Mechanics
from polhode.model import Body, Contact, Coulomb, Gravity, Pivot

_FEW = 3  # speeds of a system whose small oscillations are sought; more take seconds


# -- vectors by one number ----------------------------------------------------------------------


def magnitude(vector: Vector) -> Expr:
    """The length of a vector."""
    return sqrt(vector.dot(vector))


def rate_of_turning(mechanics: Mechanics) -> Expr:
    """The angular velocity of a body whose axis of rotation keeps its direction, rad/s.

    It is signed: positive as the coordinate or speed that it is proportional to.
    """
    turning = mechanics.in_speeds(mechanics.angular_velocity())
    assert isinstance(turning, Vector)
    along = turning.express(mechanics.body.axes.root).components
    found = [component for component in along if component]
    if len(found) != 1:
        raise DeclarationError("the rate of turning", expected="a body that turns about one axis")
    return _counted_positive(found[0])


def acceleration_down(mechanics: Mechanics) -> Expr:
    """The acceleration of the centre of mass down the slope that a body is on, m/s²."""
    contact = _only_contact(mechanics)
    weight = mechanics.gravity()
    for label in contact.on.tangents:
        along = contact.on.axes[label]
        pull = weight.dot(along)
        if pull:
            acceleration = mechanics.acceleration().dot(along)
            return acceleration if _counted_positive(pull) == pull else -acceleration
    raise DeclarationError("the acceleration down a slope", expected="a tilted plane")


def _counted_positive(expression: Expr) -> Expr:
    """The expression or its opposite, whichever has a positive leading coefficient."""
    _, leading = next(iter(expression.numerator.terms()))
    _, below = next(iter(expression.denominator.terms()))
    return expression if leading * below > 0 else -expression


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
    contact = _contact(mechanics, of)
    force = mechanics.force(of)
    return magnitude(force - contact.on.up * force.dot(contact.on.up))


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
    found = [e for e in mechanics.equations.system.elements if isinstance(e, Contact)]
    if len(found) != 1:
        raise DeclarationError("the support of the body", expected="a system with one contact")
    return found[0]


def holds_a_particle(pivot: Pivot) -> bool:
    """Whether a joint is the end of a string or light rod: it holds a particle at a distance."""
    return not pivot.at.is_zero and not any(any(row) for row in pivot.body.inertia.rows)


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
    """

    rates: dict[Symbol, Symbol]
    momenta: dict[Symbol, Expr]
    rates_by_momenta: dict[Symbol, Expr]

    def by_momenta(self, quantity: Expr) -> Expr:
        """A function of coordinates and rates, as one of coordinates and momenta."""
        return quantity.subs(self.rates_by_momenta)

    def by_rates(self, quantity: Expr) -> Expr:
        """A function of coordinates and momenta, as one of coordinates and rates."""
        return quantity.subs(self.momenta)


@lru_cache(maxsize=16)  # systems
def phase_space(mechanics: Mechanics) -> PhaseSpace:
    """The momenta ∂L/∂q̇ of a system whose rates of coordinates are independent."""
    lagrangian = mechanics.in_rates(mechanics.lagrangian())
    rates = tuple(q.derivative() for q in mechanics.declared.coordinates)
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
    )


def hamiltonian(mechanics: Mechanics) -> Expr:
    """Σ p q̇ - L, J: the energy, unless constraints move or axes turn as prescribed."""
    space = phase_space(mechanics)
    lagrangian = mechanics.in_rates(mechanics.lagrangian())
    work = (Expr.generator(rate) * space.momenta[symbol] for rate, symbol in space.rates.items())
    return sum(work, ZERO) - lagrangian


def effective_potential(mechanics: Mechanics) -> Expr:
    """The energy with the other coordinates at rest and the momenta of cyclic ones held, J.

    It is a function of the coordinates and these momenta: the negative of the Routhian at rest
    (Goldstein, Classical Mechanics, § 8.3).
    """
    space = phase_space(mechanics)
    lagrangian = mechanics.in_rates(mechanics.lagrangian())
    cyclic = {rate for rate in space.rates if not lagrangian.diff(rate.base())}
    if not cyclic or len(cyclic) == len(space.rates):
        raise DeclarationError(
            "the effective potential", expected="a system with cyclic and other coordinates"
        )
    resting = lagrangian.subs({rate: ZERO for rate in space.rates if rate not in cyclic})
    order = tuple(sorted(cyclic, key=lambda symbol: symbol.published))
    parts = [linear_parts(resting.diff(rate), order) for rate in order]
    right = [Expr.generator(space.rates[r]) - p[1] for r, p in zip(order, parts, strict=True)]
    rates = dict(zip(order, solve([row for row, _ in parts], right), strict=True))
    routhian = resting.subs(rates) - sum(
        (Expr.generator(space.rates[rate]) * rates[rate] for rate in order), ZERO
    )
    return space.by_rates(-routhian)


# -- small oscillations -------------------------------------------------------------------------


@lru_cache(maxsize=16)  # systems
def frequencies(mechanics: Mechanics) -> dict[str, Expr]:
    """The frequency of small oscillations about each steady motion that has just one, rad/s.

    Frequencies that depend on the state, such as on the rate of a precession, are left out.
    """
    from polhode.analyse import stability, steady  # loaded only for the few texts that need it

    if len(mechanics.equations.speeds) > _FEW:
        return {}

    def found() -> Iterator[tuple[str, Expr]]:
        for family in steady(mechanics.equations):
            try:
                values = stability(family).frequencies
            except (PolhodeError, ZeroDivisionError):
                continue  # such as for an upright top in angles that are singular there
            if len(values) == 1 and not any(s.kind.varies for s in values[0].symbols()):
                yield str(family), values[0]

    try:
        return dict(found())
    except (PolhodeError, ZeroDivisionError):
        return {}


def frequency(mechanics: Mechanics, about: str = "") -> Expr:
    """Of small oscillations about a steady motion, rad/s."""
    known = frequencies(mechanics)
    if about in known:
        return known[about]
    if len(known) != 1 or about:
        raise DeclarationError(
            "the frequency of small oscillations",
            expected=f"one about {' or about '.join(known)}" if known else "a system that has one",
        )
    return next(iter(known.values()))


def period(mechanics: Mechanics, about: str = "") -> Expr:
    """Of small oscillations about a steady motion, s."""
    return 2 * pi / frequency(mechanics, about)


def has_gravity(mechanics: Mechanics) -> bool:
    """Whether the system is declared with gravity."""
    return any(isinstance(load, Gravity) for load in mechanics.equations.system.loads)
