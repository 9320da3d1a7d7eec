"""Where bodies and supports touch, or would: gaps, slips and how far the edge is."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from polhode.algebra import Expr
from polhode.derive._equations import Equations
from polhode.derive._motion import Kinematics
from polhode.model import Contact, Phase


@dataclass(frozen=True)
class Touch:
    """Where a body and a support are, or would be, in contact; along the axes of the support.

    Attributes:
        contact: as declared.
        reserve: how far the place is on this side of the support's edge, m.
        room: how far it is from that edge on the side whose surface it touches, m; zero where
            there is no edge.
        gap: height of the lowest point of the body above the support, m.
        closing: its rate, m/s.
        slip: velocity of that point along the support, m/s.
    """

    contact: Contact
    reserve: Expr
    room: Expr
    gap: Expr
    closing: Expr
    slip: tuple[Expr, Expr]

    @property
    def expressions(self) -> tuple[Expr, ...]:
        """All of it."""
        return (self.reserve, self.gap, self.closing, *self.slip)


def touch_of(equations: Equations, declared: Contact, phase: Phase) -> Touch:
    """What is known of a contact where it rolls, slides or is apart, as the equations have it."""
    motion = equations.kinetics
    contact = _where(declared, phase)
    place = motion.places[contact.body]
    gap = (place + contact.arm).dot(contact.on.up)
    slips = slips_along(motion, contact, (*contact.on.tangents, contact.on.normal))
    reserve = declared.on.reserve(place + contact.arm)
    room = -reserve if phase.is_beyond else reserve
    return Touch(contact, reserve, room, gap, slips[2], (slips[0], slips[1]))


def slips_along(motion: Kinematics, contact: Contact, labels: Iterable[str]) -> list[Expr]:
    """Velocity of a body against its support where they touch, along axes of the support, m/s."""
    return [
        motion.slip(contact.restraint(label, motion.places)).dot(contact.on.axes[label])
        for label in labels
    ]


def _where(contact: Contact, phase: Phase) -> Contact:
    """The contact on its support, or on what lies beyond the edge."""
    beyond = contact.on.beyond
    return contact.on_support(beyond) if phase.is_beyond and beyond is not None else contact
