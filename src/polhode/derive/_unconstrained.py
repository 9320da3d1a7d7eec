"""Velocities before any constraint is imposed, and declarations refused because of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from polhode.algebra import Expr, Symbol, SymbolKind, Vector, linear_parts, variables
from polhode.base import DeclarationError
from polhode.derive._constraints import partial_velocity
from polhode.model import Body, Element, Places, Restraint, System, Velocities


@dataclass(frozen=True)
class Unconstrained:
    """Velocities of all bodies before any constraint is imposed.

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

    def speeds_along(self, velocity: Vector, direction: Vector) -> list[Symbol]:
        """The speeds on which the velocity of a place depends along a direction."""
        if not depends_on_motion(velocity):
            return []
        along = velocity.dot(direction).subs(self.rates)
        slopes, _ = linear_parts(along, self.speeds)
        return [speed for speed, slope in zip(self.speeds, slopes, strict=True) if slope]

    def speeds_of(self, velocity: Vector) -> list[Symbol]:
        """The speeds on which the velocity of a place depends."""
        return [
            s
            for s in self.speeds
            if depends_on_motion(velocity) and not self.slope(velocity, s).is_zero
        ]

    def slope(self, velocity: Vector, speed: Symbol) -> Vector:
        """The partial velocity of a place, with its rates in terms of the speeds."""
        return partial_velocity(velocity.subs(self.rates), speed)

    def bodies_moved(self, speeds: Iterable[Symbol]) -> list[Body]:
        """The bodies that move, or turn against inertia, with one of these speeds."""
        chosen, moved = set(speeds), []
        for body in self.system.bodies:
            velocity, angular = self.velocities[body]
            resists = not body.inertia.is_zero
            moving = (*velocity.components, *(angular.components if resists else ()))
            if chosen & variables(moving):
                moved.append(body)
        return moved

    def placed_with(self, speeds: Iterable[Symbol]) -> set[Body]:
        """Bodies whose own place in the ground moves with one of these speeds, and all they carry.

        Their forces follow from their own balances, as those of two particles that are placed by
        the coordinates of their common centre of mass.
        """
        chosen = set(speeds)
        return self.carried(
            *(
                restraint.body
                for group in self.restraints.values()
                for restraint in group
                if restraint.other is None
                and chosen.intersection(self.speeds_along(restraint.velocity, restraint.direction))
            )
        )

    def carried(self, *bodies: Body | None) -> set[Body]:
        """Some bodies, and all that hang from them."""
        found = {body for body in bodies if body is not None}
        while True:
            more = []
            for element in self.elements:
                body, *others = element.bodies
                hangs = body not in found and not found.isdisjoint(others)
                if hangs and body in element.centre(self.places):
                    more.append(body)
            if not more:
                return found
            found.update(more)


def depends_on_motion(velocity: Vector) -> bool:
    """Whether a velocity depends on the speeds of the system, not on positions and time alone."""
    return any(
        s.kind is SymbolKind.SPEED or (s.kind is SymbolKind.COORDINATE and s.order > 0)
        for s in variables(velocity.components)
    )


# Supports carried by bodies that do not feel the reaction.
#
# The reaction to a supporting force acts on the body to which the supporting point belongs. If the
# point is given by the coordinates of other bodies, but not declared as a point of theirs, the
# equations of motion are correct, but the balance of those bodies lacks that force.


def refuse_unfelt_forces(motion: Unconstrained) -> None:
    """Refuse supports and loads whose place moves with bodies that do not feel the force there.

    Raises:
        DeclarationError: naming the contact, joint or load, and what moves its place.
    """
    for element in motion.elements:
        for restraint in motion.restraints[element.name]:
            moving = motion.speeds_along(restraint.velocity, restraint.direction)
            held = motion.carried(restraint.body, restraint.other) if moving else set()
            held |= motion.placed_with(moving) if moving else set()
            others = [b for b in motion.bodies_moved(moving) if b not in held]
            _refuse_unfelt(element.name, moving, others, element.on_moving_body)
        for friction in element.friction(motion.places):
            for restraint in friction.sliding:
                moving = motion.speeds_along(restraint.velocity, restraint.direction)
                carriers = motion.bodies_moved(moving)
                _refuse_unfelt(element.name, moving, carriers, element.on_moving_body)
    for load in motion.system.loads:
        for push in load.on_places(motion.places, motion.velocities):
            moving = motion.speeds_of(push.velocity)
            held = motion.carried(*load.bodies)
            others = [b for b in motion.bodies_moved(moving) if b not in held]
            works = [s for s in moving if motion.slope(push.velocity, s).dot(push.force)]
            carriers = others or motion.bodies_moved(works)
            _refuse_unfelt(load.name, moving, carriers, Element.on_moving_body)


def _refuse_unfelt(
    name: str, moving: Iterable[Symbol], carriers: Iterable[Body], advice: str
) -> None:
    bodies = ", ".join(body.name for body in carriers)
    if bodies:
        speeds = ", ".join(s.published for s in dict.fromkeys(moving))
        raise DeclarationError(
            f"{name!r}, whose support moves with {speeds}: {bodies} would not feel the force on it",
            expected="a support that moves with time alone, or a body",
            advice=advice,
        )


# Axes that already turn about the axis of spin: the rotation of the axes and the spin would then be
# one motion described by two coordinates, and the mass matrix singular.


def refuse_second_spins(motion: Unconstrained) -> None:
    """Refuse axes that turn about the axis of spin with a coordinate that moves nothing else.

    Raises:
        DeclarationError: naming the body and the coordinate.
    """
    for body in motion.system.bodies:
        loose = body.spin.loose(body.axes)
        angles = variables(frame.angle for frame in body.axes.lineage) if loose else ()
        idle = [s for s in angles if s.kind is SymbolKind.COORDINATE and _is_idle(motion, body, s)]
        if idle:
            raise DeclarationError(
                f"body {body.name!r}, which spins about {', '.join(loose)} while its axes turn "
                f"about the same axis with {', '.join(sorted(s.published for s in idle))}",
                expected="axes that do not turn about the axis of spin, or turn with other bodies",
                advice="use spin=WithAxes() if the axes are fixed in the body, or leave out that "
                "rotation",
            )


def _is_idle(motion: Unconstrained, body: Body, angle: Symbol) -> bool:
    """Whether a coordinate moves the system in the same way as the spin of a body."""
    rate = angle.derivative()
    if rate not in motion.speeds or set(motion.bodies_moved([rate])) - {body}:
        return False
    held = (r.velocity for group in motion.restraints.values() for r in group)
    if any(rate in variables(velocity.components) for velocity in held):
        return False
    velocity, angular = motion.velocities[body]
    axes = [body.axes[label] for label in body.spin.loose(body.axes)]
    turned = motion.slope(angular, rate)
    across = turned if len(axes) > 1 else turned.cross(axes[0])
    return across.is_zero and rate not in variables(velocity.components)
