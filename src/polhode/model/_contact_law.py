"""What acts where a body touches a support: contacts, and couples beside their forces."""

from __future__ import annotations

import re
from abc import abstractmethod
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, ExprLike, Symbol, SymbolKind, exp, is_positive
from polhode.base import DeclarationError
from polhode.model._body import Body
from polhode.model._declared import Size, not_negative, positive
from polhode.model._element import Element, Friction, Places, Restraint
from polhode.model._support import Support

_ODD = re.compile(r"[^A-Za-z0-9_ ]")  # characters not allowed in the name of a symbol


@dataclass(frozen=True)
class Phase:
    """The state of a contact, on its support or on the table beyond the edge."""

    kind: str
    is_beyond: bool = False

    @property
    def value(self) -> str:
        """In words."""
        return f"{self.kind} on the table" if self.is_beyond else self.kind

    @property
    def rolls(self) -> bool:
        """Whether nothing slips: the point of contact moves with the support, or nothing turns."""
        return self.kind in ("rolling", "held")

    @property
    def slides(self) -> bool:
        """Whether friction opposes a slip."""
        return self.kind in ("sliding", "turning")

    @property
    def flies(self) -> bool:
        """Whether the body is off the support."""
        return self.kind == "flight"

    def beyond(self) -> Phase:
        """The same beyond the edge."""
        return Phase(self.kind, is_beyond=True)


ROLLING, SLIDING = Phase("rolling"), Phase("sliding")
HELD, TURNING = Phase("held"), Phase("turning")
FRICTIONLESS, FLIGHT = Phase("frictionless"), Phase("flight")


class ContactLaw(Element):
    """A contact, or a couple that acts beside its force, with the phases that it can be in.

    Attributes:
        body: that touches.
        on: the support.
    """

    body: Body
    on: Support

    @property
    def spelled(self) -> str:
        """Its name for use in symbols, in ASCII: other characters become code points."""
        return _ODD.sub(lambda found: f"u{ord(found[0]):04x}", self.name)

    @property
    @abstractmethod
    def pressed_by(self) -> str:
        """Name of the contact whose normal force presses the surfaces together: its own, or not."""

    @property
    def is_beside(self) -> bool:
        """Whether it acts beside the force of a contact, with which it closes and opens."""
        return self.pressed_by != self.name

    @abstractmethod
    def component(self, label: str) -> str:
        """Name of the reaction's component along a direction of the support; empty for none."""

    @property
    def components(self) -> tuple[str, ...]:
        """Names of all components: along the normal, then along the support."""
        along = map(self.component, self.on.tangents)
        return (self.component(self.on.normal), *filter(None, along))

    @abstractmethod
    def gap(self, places: Places) -> Expr:
        """Distance of the body from the support, m."""

    @abstractmethod
    def pressing(self, places: Places) -> Restraint:
        """The restraint whose reaction is the normal force."""

    @abstractmethod
    def sliding(self, places: Places) -> tuple[Restraint, ...]:
        """What keeps it from slipping, along one direction or two, where it does not."""

    @abstractmethod
    def phases(self) -> Mapping[Phase, Element]:
        """The element that replaces it in each phase it can be in, those without slip first."""


class DryFriction(ContactLaw):
    """Friction in proportion to the normal force, with a limit up to which nothing slips.

    The coefficient may depend on the slip speed v: mu + viscous·v + (mu_static − mu)
    exp(−v/stribeck).
    """

    mu: Expr
    mu_static: Expr
    viscous: Expr
    stribeck: Expr | None

    def _set_coefficients(
        self,
        mu: ExprLike,
        mu_static: ExprLike | None,
        viscous: ExprLike,
        stribeck: ExprLike | None,
    ) -> None:
        what = f"friction coefficient of contact {self.name!r}"
        kinetic = not_negative(mu, what)
        static = kinetic if mu_static is None else not_negative(mu_static, f"static {what}")
        if is_positive(kinetic - static):
            raise DeclarationError(
                f"mu = {kinetic} above mu_static = {static} at contact {self.name!r}",
                expected="a static coefficient no smaller than the kinetic one",
            )
        slow = None if stribeck is None else positive(stribeck, f"Stribeck speed of {self.name!r}")
        rise = not_negative(viscous, f"viscous part of the {what}")
        self._set(mu=kinetic, mu_static=static, viscous=rise, stribeck=slow)

    @property
    def sizes(self) -> Iterator[Size]:
        yield Size(f"viscous part of the friction of {self.name!r}", self.viscous, may_vanish=True)
        if self.stribeck is not None:
            yield Size(f"Stribeck speed of {self.name!r}", self.stribeck)

    def coefficient(self, slip: Expr, slowness: Expr) -> Expr:
        """Friction over normal force while it slides.

        Args:
            slip: speed, m/s.
            slowness: exp(−slip/stribeck), the remaining fraction of the excess static friction.
        """
        return self.mu + self.viscous * slip + (self.mu_static - self.mu) * slowness

    def slowness(self, slip: Expr) -> Expr:
        """Remaining fraction of the excess of static over kinetic friction at a slip speed."""
        return ZERO if self.stribeck is None else exp(-slip / self.stribeck)

    def friction(self, places: Places) -> tuple[Friction, ...]:
        return (Friction(self.pressing(places), self.mu, self.sliding(places)),)


class Slipping(Element):
    """A law of friction that slips in a direction given by symbols, not by its slip velocity.

    When slipping starts the slip velocity has no direction yet, and shortly after it the direction
    is known far better than rounded velocities would give it.

    Attributes:
        law: as declared.
    """

    law: DryFriction

    @property
    def direction(self) -> tuple[Symbol, Symbol]:
        """Components of the unit vector along the slip velocity."""
        first, second = (
            Symbol(f"e_{label}_{self.law.spelled}", SymbolKind.SPEED)
            for label in self.law.on.tangents
        )
        return first, second

    @property
    def slip_speed(self) -> Symbol:
        """Magnitude of the slip velocity, m/s."""
        return Symbol(f"v_slip_{self.law.spelled}", SymbolKind.SPEED)

    @property
    def slowness(self) -> Symbol:
        """Remaining fraction of the excess static friction in Stribeck's law."""
        return Symbol(f"slowness_{self.law.spelled}", SymbolKind.SPEED)

    def friction(self, places: Places) -> tuple[Friction, ...]:
        sliding = self.law.sliding(places)
        direction = tuple(map(Expr.generator, self.direction))[: len(sliding)]
        excess = ZERO if self.law.stribeck is None else Expr.generator(self.slowness)
        coefficient = self.law.coefficient(Expr.generator(self.slip_speed), excess)
        return (Friction(self.law.pressing(places), coefficient, sliding, direction),)
