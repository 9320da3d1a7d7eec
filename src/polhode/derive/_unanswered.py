"""Places that move with bodies which do not feel the force there.

What holds a body to a place pushes back on whatever the place belongs to. A place that other bodies
carry along, because it is given by their coordinates and not as a point of theirs, would keep the
motion and lose that force from the balance of those bodies.
"""

from __future__ import annotations

from collections.abc import Iterable

from polhode.algebra import Symbol
from polhode.base import DeclarationError
from polhode.derive._unconstrained import Unconstrained
from polhode.model import Body


def refuse_unanswered(motion: Unconstrained) -> None:
    """Refuse places that move with bodies which do not feel the force there.

    Raises:
        DeclarationError: naming the contact, joint or load, and what moves its place.
    """
    for element in motion.elements:
        for restraint in motion.restraints[element.name]:
            moving = motion.moving(restraint.velocity, restraint.direction)
            held = motion.carried(restraint.body, restraint.other) if moving else set()
            _refuse(element.name, moving, [b for b in motion.movers(moving) if b not in held])
        for friction in element.friction(motion.places):
            for _, direction in friction.directions:
                moving = motion.moving(friction.normal.velocity, direction)
                if moving:
                    _refuse(element.name, moving, motion.movers(moving))
    _refuse_loads(motion)


def _refuse_loads(motion: Unconstrained) -> None:
    for load in motion.system.loads:
        for push in load.on_places(motion.places, motion.velocities):
            moving = motion.gaining(push.velocity)
            held = motion.carried(*load.bodies)
            others = [b for b in motion.movers(moving) if b not in held]
            works = [s for s in moving if motion.slope(push.velocity, s).dot(push.force)]
            _refuse(load.name, moving, others or motion.movers(works))


def _refuse(name: str, moving: Iterable[Symbol], unfeeling: Iterable[Body]) -> None:
    bodies = ", ".join(body.name for body in unfeeling)
    if bodies:
        speeds = ", ".join(s.published for s in dict.fromkeys(moving))
        raise DeclarationError(
            f"{name!r}, whose support moves with {speeds}: {bodies} would not feel the force on it",
            expected="a support that moves with time alone, or a body",
            advice="name the body that carries it: to=body.point(offset), or to=body; strings and "
            "gears are not modelled",
        )
