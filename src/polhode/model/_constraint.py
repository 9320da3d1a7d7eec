"""Constraints that a user writes as equations in coordinates and speeds."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import permutations

from polhode.algebra import (
    ONE,
    Expr,
    ExprLike,
    Symbol,
    SymbolKind,
    Vector,
    as_symbol,
    coordinate,
    linear_parts,
    read_expression,
    solve,
    sqrt,
    total,
    variables,
)
from polhode.base import DeclarationError, NumericError
from polhode.model._body import Body
from polhode.model._declared import is_rate, is_varying, quantity
from polhode.model._element import Element, Places, Restraint, Share


@dataclass(frozen=True, init=False)
class Constraint(Element):
    """An equation that the motion obeys.

    An equation in coordinates is holonomic; one in speeds or rates of coordinates must be linear
    in them. It acts by generalized forces: for the rate of an angle, a couple on the body that
    turns with the angle and the opposite couple on the body from which it is measured; for the
    rate of a position, a force on the body that moves and the opposite force on the body along
    which it moves. They do no work on any other motion of that body.

    The reaction is the Lagrange multiplier of the equation, differentiated once if it is
    holonomic: of `x - R*theta = 0` the force along x. If no rate has a number as its coefficient,
    the equation is first divided by the length of its gradient: of `x**2 + z**2 - L**2 = 0` it is
    the normal force.

    Args:
        equation: an expression that vanishes, or text such as "x - R*theta = 0".
        on: the bodies whose coordinates and speeds occur in it.
        where: meanings of further names in the text, such as parameters.
        force: name of the reaction.

    Raises:
        DeclarationError: for an equation without coordinates or speeds, or not linear in speeds.
        ParseError: for text that cannot be read.
    """

    equation: Expr
    on: tuple[Body, ...]
    name: str
    force: str

    def __init__(
        self,
        equation: ExprLike,
        *,
        on: Body | Iterable[Body],
        where: Mapping[str, Expr] | None = None,
        name: str = "",
        force: str = "Q",
    ) -> None:
        called = name or "constraint"
        bodies = (on,) if isinstance(on, Body) else tuple(on)
        if not bodies:
            raise DeclarationError(
                f"{called!r} on no body", expected="the bodies that it restrains"
            )
        if isinstance(equation, str):
            equation = _read(equation, {**_names(bodies), **(where or {})})
        vanishing = quantity(equation, f"equation of {called!r}")
        if not any(s.kind in _MOVING for s in vanishing.symbols()):
            raise DeclarationError(
                f"{called!r}: {vanishing} = 0",
                expected="an equation in coordinates or speeds",
                advice="write it as an expression that vanishes, such as x - R*theta",
            )
        values = {"equation": vanishing, "on": bodies, "name": called, "force": force}
        for field, value in values.items():
            object.__setattr__(self, field, value)

    @property
    def bodies(self) -> tuple[Body, ...]:
        return self.on

    @property
    def is_holonomic(self) -> bool:
        """Whether it restrains the configuration, without speeds."""
        return not any(map(is_rate, self.equation.symbols()))

    def closures(self, places: Places) -> tuple[Expr, ...]:
        return (self.equation,) if self.is_holonomic else ()

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        rate = self.equation.dt() if self.is_holonomic else self.equation
        rate = rate.subs(_spin_rates(places))
        speeds = sorted(filter(is_rate, rate.symbols()), key=lambda s: s.published)
        try:
            coefficients, rest = linear_parts(rate, speeds)
        except NumericError as error:
            raise DeclarationError(
                f"{self.name!r}: {self.equation} = 0",
                expected="an equation in coordinates, or one that is linear in speeds",
            ) from error
        # The first share names the reaction: that of a rate with a number as its coefficient, so
        # that the multiplier is a force or a couple; otherwise all are divided by a length.
        plain = [i for i, c in enumerate(coefficients) if not c.symbols()]
        chosen = plain[0] if plain else 0
        scale = ONE if plain else _length(coefficients)
        order = sorted(range(len(speeds)), key=lambda i: i != chosen)
        shares = [
            share
            for i in order
            for share in self._conjugate(speeds[i], coefficients[i] / scale, places)
        ]
        length = shares[0].direction.norm()
        if not any(map(is_varying, length.symbols())):
            scale = scale * length
            shares = [Share(s.body, s.direction / length, s.arm) for s in shares]
        main, more = shares[0], tuple(shares[1:])
        # The velocity is prescribed by its component along the first share, Σ rates = -rest.
        velocity = main.direction * (-rest / scale / main.direction.dot(main.direction))
        return (Restraint(self.force, main.body, main.direction, velocity, main.arm, more=more),)

    def _conjugate(self, speed: Symbol, coefficient: Expr, places: Places) -> Iterator[Share]:
        """The force or couple that does work on one speed alone, times its coefficient."""
        found = [m for m in _relative_motions(places) if speed in m.speeds]
        for motion in sorted(found, key=lambda motion: len(motion.speeds)):
            dual = motion.dual(speed)
            if dual is not None:
                yield from motion.shares(dual * coefficient)
                return
        raise DeclarationError(
            f"{speed.published} in {self.name!r}, which no body moves or turns with alone",
            expected="rates of angles, of positions of centres of mass, and angular velocities",
            advice="write x.dt() for the velocity of a centre of mass, or use a Gear or a Rope",
        )


@dataclass(frozen=True)
class _RelativeMotion:
    """The velocity or the rotation of one body relative to another one or to the ground.

    Attributes:
        body: the first body.
        carrier: the other one; None for the ground.
        velocity: relative velocity of the centre of mass, or relative angular velocity.
        arm: from the centre of mass of the carrier; None for a rotation.
        speeds: that occur.
    """

    body: Body
    carrier: Body | None
    velocity: Vector
    arm: Vector | None
    speeds: tuple[Symbol, ...]

    def dual(self, speed: Symbol) -> Vector | None:
        """The vector c with c · velocity = speed, whatever the other speeds; None if there is none.

        Of the partial velocities w_j it is the combination Σ x_j w_j with w_i · Σ x_j w_j = δ_i.
        """
        partial = [
            Vector(tuple(c.diff(s) for c in self.velocity.components), self.velocity.triad)
            for s in self.speeds
        ]
        gram = [[a.dot(b) for b in partial] for a in partial]
        try:
            shares = solve(gram, [Expr.constant(int(s == speed)) for s in self.speeds])
        except ZeroDivisionError:
            return None
        found = self.body.axes.root.zero
        for partial_velocity, share in zip(partial, shares, strict=True):
            found = found + partial_velocity * share
        return found

    def shares(self, direction: Vector) -> Iterator[Share]:
        """The force or couple on the body, and its opposite on the other one."""
        own = None if self.arm is None else self.body.axes.zero
        yield Share(self.body, direction, own)
        if self.carrier is not None:
            yield Share(self.carrier, -direction, self.arm)


def _relative_motions(places: Places) -> Iterator[_RelativeMotion]:
    """Rotations before translations, relative to the ground before relative to other bodies."""
    rates = _spin_rates(places)
    pairs = [*((body, None) for body in places), *permutations(places, 2)]
    for body, carrier in pairs:
        turning = body.angular_velocity
        if carrier is not None:
            turning = turning - carrier.angular_velocity
        yield _motion(body, carrier, turning, None, rates)
    for body, carrier in pairs:
        moving, arm = places[body].dt(), body.axes.zero
        if carrier is not None:
            arm = places[body] - places[carrier]
            moving = moving - places[carrier].dt() - carrier.angular_velocity.cross(arm)
        yield _motion(body, carrier, moving, arm, rates)


def _motion(
    body: Body,
    carrier: Body | None,
    velocity: Vector,
    arm: Vector | None,
    rates: Mapping[Symbol, Expr],
) -> _RelativeMotion:
    inside = Vector(tuple(c.subs(rates) for c in velocity.components), velocity.triad)
    speeds = sorted(filter(is_rate, variables(inside.components)), key=lambda s: s.published)
    return _RelativeMotion(body, carrier, inside, arm, tuple(speeds))


def _spin_rates(places: Iterable[Body]) -> dict[Symbol, Expr]:
    """Rates of angles of spin in terms of the angular velocities that bodies declare."""
    return {as_symbol(q).derivative(): e for body in places for q, e in body.rates.items()}


def _length(coefficients: Iterable[Expr]) -> Expr:
    """The length of a gradient."""
    return sqrt(total(c * c for c in coefficients))


# -- equations as text -----------------------------------------------------------------------------

_MOVING = (SymbolKind.COORDINATE, SymbolKind.SPEED)


def _read(text: str, known: Mapping[str, Expr]) -> Expr:
    left, equals, right = text.partition("=")
    found = read_expression(left, known)
    return found - read_expression(right, known) if equals else found


def _names(bodies: Iterable[Body]) -> dict[str, Expr]:
    """Coordinates, speeds and parameters of bodies by their published names."""
    found: list[Expr] = []
    for body in bodies:
        inertia = (entry for row in body.inertia.rows for entry in row)
        given = (body.mass, *inertia, *(frame.angle for frame in body.axes.lineage), *body.speeds)
        found += map(Expr.generator, variables(given))
        found += (*body.rates, *(coordinate(q + body.tag) for q in ("x", "y", "z")))
    coordinates = [e for e in found if as_symbol(e).kind is SymbolKind.COORDINATE]
    every = (*found, *(q.dt() for q in coordinates))
    return {as_symbol(e).published: e for e in every}
