"""What a contact can be doing: the element that stands for it in each of its phases."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, Vector, as_symbol, coordinate, speed
from polhode.model._body import Body
from polhode.model._contacts import Contact, Coulomb, Rolling, Smooth
from polhode.model._element import Element, Friction, Places, Restraint


@dataclass(frozen=True)
class Phase:
    """What a contact is doing, and whether on what lies beyond the edge of its support."""

    kind: str
    is_beyond: bool = False

    @property
    def value(self) -> str:
        """In words."""
        return f"{self.kind} on the table" if self.is_beyond else self.kind

    @property
    def rolls(self) -> bool:
        """Whether the point of contact moves with the support."""
        return self.kind == "rolling"

    @property
    def slides(self) -> bool:
        """Whether friction opposes a slip."""
        return self.kind == "sliding"

    @property
    def flies(self) -> bool:
        """Whether nothing touches."""
        return self.kind == "flight"

    def beyond(self) -> Phase:
        """The same beyond the edge."""
        return Phase(self.kind, is_beyond=True)


ROLLING, SLIDING = Phase("rolling"), Phase("sliding")
FRICTIONLESS, FLIGHT = Phase("frictionless"), Phase("flight")


@dataclass(frozen=True)
class Apart(Element):
    """A body above the support that it touches in other phases.

    Its centre of mass has the coordinates it has in contact, and its height besides.
    """

    contact: Contact

    @property
    def name(self) -> str:  # type: ignore[override]
        return self.contact.name

    @property
    def bodies(self) -> tuple[Body, ...]:
        return self.contact.bodies

    @property
    def height(self) -> Symbol:
        """Coordinate: height of the centre of mass above the support's origin, m."""
        normal, tag = self.contact.on.normal, self.contact.body.tag
        plain = normal if normal in "xyz" else f"x_{normal}"
        return as_symbol(coordinate(plain + tag))

    @property
    def rise(self) -> Symbol:
        """Speed: rate of the height, m/s."""
        return as_symbol(speed(f"v_{self.contact.on.normal}{self.contact.body.tag}"))

    def rates(self) -> Mapping[Expr, Expr]:
        rise = Expr.generator(self.rise)
        return {**self.contact.rates(), Expr.generator(self.height): rise}

    def centre(self, places: Places) -> Mapping[Body, Vector]:
        contact = self.contact
        place = contact.on.up * Expr.generator(self.height)
        for label, x in zip(contact.on.tangents, contact.rates(), strict=True):
            place = place + contact.on.axes[label] * x
        return {contact.body: place}

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        return self.contact.couples()

    def assumed_positive(self) -> tuple[Expr, ...]:
        return self.contact.assumed_positive()


class Sliding(Contact):
    """A contact that slides in a direction given by symbols instead of by its slip velocity.

    At the instant at which slipping begins the slip velocity has no direction yet, and near it
    the direction is known far better than from rounded velocities.
    """

    law: Coulomb

    def __init__(self, law: Coulomb) -> None:
        super().__init__(
            law.body, on=law.on, name=law.name, force=law.force, restitution=law.restitution
        )
        object.__setattr__(self, "law", law)

    @property
    def direction(self) -> tuple[Symbol, Symbol]:
        """Components of the unit vector along the slip velocity."""
        first, second = (
            Symbol(f"e_{label}_{self.spelled}", SymbolKind.SPEED) for label in self.on.tangents
        )
        return first, second

    @property
    def slip_speed(self) -> Symbol:
        """Magnitude of the slip velocity, m/s."""
        return Symbol(f"v_slip_{self.spelled}", SymbolKind.SPEED)

    @property
    def slowness(self) -> Symbol:
        """What the law of Stribeck leaves of the static friction."""
        return Symbol(f"slowness_{self.spelled}", SymbolKind.SPEED)

    def friction(self, places: Places) -> tuple[Friction, ...]:
        first, second = (Expr.generator(symbol) for symbol in self.direction)
        felt = ZERO if self.law.stribeck is None else Expr.generator(self.slowness)
        coefficient = self.law.coefficient(Expr.generator(self.slip_speed), felt)
        normal = self.restraint(self.on.normal, places)
        return (Friction(normal, coefficient, self.law.directions(), (first, second)),)


def phases(contact: Contact) -> Mapping[Phase, Element]:
    """The element that stands for a contact in each phase it can be in, sticking ones first."""
    found = _touching(contact)
    if contact.on.beyond is not None:
        there = _touching(contact.on_support(contact.on.beyond))
        found |= {phase.beyond(): element for phase, element in there.items()}
    return {**found, FLIGHT: Apart(contact)}


def _touching(contact: Contact) -> dict[Phase, Element]:
    if isinstance(contact, Coulomb):
        bare: Any = {"on": contact.on, "name": contact.name, "force": contact.force}
        return {
            ROLLING: Rolling(contact.body, **bare),
            SLIDING: Sliding(contact),
            FRICTIONLESS: Smooth(contact.body, **bare),
        }
    return {ROLLING if isinstance(contact, Rolling) else FRICTIONLESS: contact}
