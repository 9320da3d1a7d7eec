"""Guards: expressions that stay positive while a contact mode lasts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from polhode.algebra import ZERO, Expr
from polhode.derive._equations import Equations
from polhode.derive._touch import Touch
from polhode.model import Contact, Coulomb, Phase


@dataclass(frozen=True)
class Guard:
    """An expression whose reaching zero ends a mode.

    Attributes:
        contact: what it belongs to; None for the side on which the equations hold.
        kind: "slips", "sticks", "lifts off", "touches down", "crosses the edge" or "near-flat".
        positive: greater than zero while the mode lasts.
    """

    contact: Contact | None
    kind: str
    positive: Expr


def guards_of(
    equations: Equations, touches: tuple[Touch, ...], phases: tuple[Phase, ...]
) -> Iterator[Guard]:
    """The guards of a mode, exact; accelerations and reactions stand in them as derived."""
    for touch, phase in zip(touches, phases, strict=True):
        if phase.flies:
            yield Guard(touch.contact, "touches down", touch.gap)
            continue
        contact = touch.contact
        yield Guard(
            contact, "lifts off", equations.components[contact.component(contact.on.normal)]
        )
        if phase.rolls and isinstance(contact, Coulomb):
            yield Guard(contact, "slips", _reserve(equations, contact))
        if touch.reserve:
            yield Guard(contact, "crosses the edge", touch.room)
        if phase.slides:
            first, second = touch.slip
            yield Guard(contact, "sticks", first * first + second * second)
    for side in equations.assumed_positive:
        yield Guard(None, "near-flat", side)


def _reserve(equations: Equations, contact: Coulomb) -> Expr:
    """How far the square of the friction force is below its static limit, N²."""
    normal = equations.components[contact.component(contact.on.normal)]
    friction = (equations.components[name] for name, _ in contact.directions())
    return (contact.mu_static * normal) ** 2 - sum((f * f for f in friction), ZERO)
