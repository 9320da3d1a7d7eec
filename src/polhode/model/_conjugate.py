"""Generalized forces as forces and couples on bodies.

A generalized force Q conjugate to a speed u has the virtual power Q u. Of all forces and couples
with that power, the one chosen acts on the body that moves or turns with u, and its opposite on the
body relative to which it does, along the combination of partial velocities that does no work on any
other speed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import permutations

from polhode.algebra import (
    ZERO,
    Expr,
    Symbol,
    Vector,
    as_symbol,
    dependent_columns,
    linear_parts,
    solve,
    variables,
)
from polhode.base import DeclarationError
from polhode.model._body import Body
from polhode.model._declared import is_rate
from polhode.model._element import Places, Share

#: What to declare where no body has a coordinate.
OWN_COORDINATES = (
    "place a body by coordinates of its own with a Pivot, such as Pivot(body, to=axes['x']*r)"
)


def conjugate_shares(
    speed: Symbol, coefficient: Expr, places: Places, name: str
) -> Iterator[Share]:
    """The force or couple that does work on one speed alone, times its coefficient.

    Raises `DeclarationError`, with the name of the part, for a speed of no body.
    """
    best: tuple[_RelativeMotion, Vector] | None = None
    for motion in _relative_motions(speed, places):
        if best is not None and len(motion.speeds) >= len(best[0].speeds):
            continue
        dual = motion.dual(speed)
        if dual is not None:
            best = motion, dual
            if len(motion.speeds) == 1:
                break
    if best is not None:
        motion, dual = best
        yield from motion.shares(dual * coefficient)
        return
    if found := next(_joint_duals(speed, places), None):
        yield from (Share(s.body, s.direction * coefficient, s.arm) for s in found)
        return
    if next(_relative_motions(speed, places), None) is None:
        raise DeclarationError(
            f"{speed.published} in {name!r}, with which no body moves or turns",
            expected="coordinates and speeds of the bodies",
            advice=OWN_COORDINATES,
        )
    raise DeclarationError(
        f"{speed.published} in {name!r}, which no body moves or turns with alone",
        expected="rates of angles, of positions of centres of mass, and angular velocities",
        advice="write x.dt() for the velocity of a centre of mass, or use a Gear or a Rope",
    )


def shares_of_power(power: Expr, places: Places, name: str) -> tuple[tuple[Share, ...], Expr]:
    """The forces and couples with a given virtual power, linear in rates and speeds.

    Returns them with the excess of their power on the motion over the given one: they also do work
    on prescribed motions, such as that of a frame that turns with time or of the Earth.
    """
    in_speeds = power.subs(spin_rates(places))
    speeds = sorted(filter(is_rate, in_speeds.symbols()), key=lambda s: s.published)
    coefficients, rest = linear_parts(in_speeds, speeds)
    shares = tuple(
        share
        for speed, coefficient in zip(speeds, coefficients, strict=True)
        for share in conjugate_shares(speed, coefficient, places, name)
    )
    return shares, power_at_rest(shares, places) - rest


def power_at_rest(shares: Iterable[Share], places: Places) -> Expr:
    """The power of forces and couples on the prescribed motion, with all speeds at zero."""
    rates, power = spin_rates(places), ZERO
    for share in shares:
        moved = share.body.angular_velocity
        if share.arm is not None:
            moved = places[share.body].dt() + moved.cross(share.arm)
        in_speeds = share.direction.dot(moved).subs(rates)
        still = {s: ZERO for s in in_speeds.symbols() if is_rate(s)}
        power = power + in_speeds.subs(still)
    return power


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


def _relative_motions(speed: Symbol, places: Places) -> Iterator[_RelativeMotion]:
    """The relative motions in which a speed occurs, those of fewer speeds and simpler ones first.

    Rotations before translations, relative to the ground before relative to other bodies. Most
    speeds are the rate of one angle: the first few candidates then suffice, however many bodies
    there are.
    """
    rates = spin_rates(places)
    turning = {body: body.angular_velocity.subs(rates) for body in places}
    rates_of = {body: _rates_in(velocity) for body, velocity in turning.items()}
    for body, velocity in turning.items():
        if speed in rates_of[body]:
            yield _RelativeMotion(body, None, velocity, None, _ordered(rates_of[body]))
    # A speed that occurs in one of two rotations only cannot drop out of their difference, so that
    # there are at least as many speeds in it as occur in one of them only.
    pairs = [
        (body, other)
        for body, other in permutations(places, 2)
        if speed in rates_of[body] or speed in rates_of[other]
    ]
    for body, other in sorted(pairs, key=lambda pair: len(rates_of[pair[0]] ^ rates_of[pair[1]])):
        relative = turning[body] - turning[other]
        if speed in (occurring := _rates_in(relative)):
            yield _RelativeMotion(body, other, relative, None, _ordered(occurring))
    moving = {body: place.dt().subs(rates) for body, place in places.items()}
    for body, velocity in moving.items():
        if speed in (occurring := _rates_in(velocity)):
            yield _RelativeMotion(body, None, velocity, body.axes.zero, _ordered(occurring))
    for body, other in permutations(places, 2):
        arm = places[body] - places[other]
        relative = moving[body] - moving[other] - turning[other].cross(arm)
        if speed in (occurring := _rates_in(relative)):
            yield _RelativeMotion(body, other, relative, arm, _ordered(occurring))


def _joint_duals(speed: Symbol, places: Places) -> Iterator[tuple[Share, Share]]:
    """A couple and a force on one body that together do work on a speed alone.

    A wheel on axes turned by its place on a curve turns with two angles about one axis; a couple on
    it does work on both, and the force along the curve takes one share of it back.
    """
    rates = spin_rates(places)
    for body, place in places.items():
        turning, moving = body.angular_velocity.subs(rates), place.dt().subs(rates)
        speeds = _ordered(_rates_in(turning) | _rates_in(moving))
        if speed not in speeds:
            continue
        partial = [[v.diff(s) for s in speeds] for v in (turning, moving)]
        bases = [_basis(vectors) for vectors in partial]
        if sum(map(len, bases)) != len(speeds):
            continue  # more than one pair would do
        rows = [
            [b.dot(own[j]) for own, basis in zip(partial, bases, strict=True) for b in basis]
            for j in range(len(speeds))
        ]
        try:
            parts = iter(solve(rows, [Expr.constant(int(s == speed)) for s in speeds]))
        except ZeroDivisionError:
            continue
        zero = body.axes.root.zero
        couple, force = (sum((b * next(parts) for b in basis), zero) for basis in bases)
        yield Share(body, couple), Share(body, force, body.axes.zero)


def _basis(vectors: Sequence[Vector]) -> list[Vector]:
    """The first of some vectors that are independent."""
    table = list(zip(*(v.express(vectors[0].triad).components for v in vectors), strict=True))
    dependent = dependent_columns(table)
    return [v for j, v in enumerate(vectors) if j not in dependent]


def _rates_in(velocity: Vector) -> frozenset[Symbol]:
    return frozenset(filter(is_rate, variables(velocity.components)))


def _ordered(symbols: Iterable[Symbol]) -> tuple[Symbol, ...]:
    return tuple(sorted(symbols, key=lambda s: s.published))


def spin_rates(places: Iterable[Body]) -> dict[Symbol, Expr]:
    """Rates of angles of spin in terms of the angular velocities that bodies declare."""
    return {as_symbol(q).derivative(): e for body in places for q, e in body.rates.items()}
