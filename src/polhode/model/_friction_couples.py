"""Couples beside the force of a contact: rolling resistance, and friction against spinning.

Each is set-valued like Coulomb's friction: up to a limit, in proportion to the normal force, it
keeps the body from rolling or spinning, and beyond that it opposes the motion (Leine and van de
Wouw, Stability and Convergence of Mechanical Systems with Unilateral Constraints, 2008, ch. 5).
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import ClassVar

from polhode.algebra import Expr, ExprLike, Vector
from polhode.base import DeclarationError
from polhode.model._body import Body
from polhode.model._contact_law import (
    FLIGHT,
    FRICTIONLESS,
    HELD,
    TURNING,
    DryFriction,
    Phase,
    Slipping,
)
from polhode.model._contacts import Contact
from polhode.model._declared import of_type
from polhode.model._element import Element, Friction, Places, Restraint
from polhode.model._support import Support


@dataclass(frozen=True, init=False)
class FrictionCouple(DryFriction):
    """A couple beside the force of a contact, with a limit in proportion to the normal force."""

    of: Contact
    mu: Expr
    mu_static: Expr
    viscous: Expr
    stribeck: Expr | None
    name: str
    force: str

    def __init__(
        self,
        of: Contact,
        *,
        mu: ExprLike,
        mu_static: ExprLike | None = None,
        viscous: ExprLike = 0,
        stribeck: ExprLike | None = None,
        name: str = "",
        force: str = "",
    ) -> None:
        what = type(self).__name__
        of_type(of, Contact, f"what a {what} belongs to", f"give the contact: {what}(contact, ...)")
        called = name or f"{self._words}{of.body.tag}"
        self._set(of=of, name=called, force=force or self._letter)
        self._set_coefficients(mu, mu_static, viscous, stribeck)
        if of.on.beyond is not None:
            raise DeclarationError(
                f"{called!r} on a support that ends at an edge",
                expected="a support without an edge",
                advice="leave the edge out, or the couple",
            )
        if not self.axes():
            raise DeclarationError(
                f"{called!r} of body {of.body.name!r}, which touches at a point that stays the "
                "same, or with a face",
                expected="a body that rolls: a sphere, a disk or a hoop, a cylinder, an ellipsoid",
            )

    #: Words for its name, the letter of its components, and whether it opposes a travel.
    _words: ClassVar[str] = ""
    _letter: ClassVar[str] = ""
    _of_travel: ClassVar[bool] = False

    @abstractmethod
    def axes(self) -> tuple[Vector, ...]:
        """Vectors k, one or two, of which ω·k is what it opposes: the components' couples, m."""

    @property
    def body(self) -> Body:  # type: ignore[override]
        return self.of.body

    @property
    def on(self) -> Support:  # type: ignore[override]
        return self.of.on

    @property
    def bodies(self) -> tuple[Body, ...]:
        return self.of.bodies

    @property
    def spelled(self) -> str:
        return f"{self.force}{self.body.tag}"

    @property
    def pressed_by(self) -> str:
        return self.of.name

    def component(self, label: str) -> str:
        if label == self.on.normal:
            return self.of.component(label)
        place, count = self.on.tangents.index(label), len(self.axes())
        if count == 2:
            return f"{self.force}_{label}{self.body.tag}"
        return f"{self.force}{self.body.tag}" if place == 0 else ""

    def gap(self, places: Places) -> Expr:
        return self.of.gap(places)

    def pressing(self, places: Places) -> Restraint:
        return self.of.pressing(places)

    def sliding(self, places: Places) -> tuple[Restraint, ...]:
        body, carrier, turning = self.body, self.on.carrier, self.on.angular_velocity
        still = turning * 0 if carrier is not None else turning
        return tuple(
            Restraint(
                self.component(label), body, axis, still, other=carrier, of_travel=self._of_travel
            )
            for label, axis in zip(self.on.tangents, self.axes(), strict=False)
        )

    def friction(self, places: Places) -> tuple[Friction, ...]:
        (law,) = super().friction(places)
        return (replace(law, letter=f"v_{self.force}{self.body.tag}"),)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        return ()

    def phases(self) -> Mapping[Phase, Element]:
        return {
            HELD: Held(self),
            TURNING: Turning(self),
            FRICTIONLESS: NoCouple(self),
            FLIGHT: NoCouple(self),
        }


class RollingResistance(FrictionCouple):
    """Rolling resistance: it opposes the travel of the point of contact over the body's surface.

    It dissipates mu N v, with v the speed of that travel as of a body that turns so on a plane: of
    a wheel or a ball that rolls upright, that of its centre, against which mu N acts. A disk that
    leans also loses mu N v along its rim (the contour friction of Leine, Arch. Appl. Mech. 79,
    1063, 2009). It does not act during impacts: a system with it refuses them.

    Args:
        of: the contact.
        mu: coefficient: resistance over normal force (the dimensionless C_rr of tyres).
        mu_static: up to which the body stays at rest; the same by default.
        viscous: rise of the coefficient with that speed, s/m.
        stribeck: speed over which it falls from static to kinetic, m/s.
        name: "rolling resistance" with the tag of the body by default.
        force: letter of its components R_x, R_y, in N; of a rim one, R.
    """

    _words, _letter, _of_travel = "rolling resistance", "R", True

    def axes(self) -> tuple[Vector, ...]:
        first, second = (self.on.axes[label] for label in self.on.tangents)
        surface = self.of.surface
        return surface.rolling_axes(self.body.axes, self.on.up, (first, second))


class DrillingFriction(FrictionCouple):
    """Friction against spinning about the normal: of a small patch of contact.

    Args:
        of: the contact.
        mu: couple over normal force, m: of an evenly pressed patch with the radius ρ and the
            coefficient of friction μ it is 2μρ/3.
        mu_static: up to which the body does not spin; the same by default.
        viscous: rise of mu with the angular velocity, m s.
        stribeck: angular velocity over which it falls from static to kinetic, rad/s.
        name: "drilling friction" with the tag of the body by default.
        force: letter of the couple, C, in N m.
    """

    _words, _letter = "drilling friction", "C"

    def axes(self) -> tuple[Vector, ...]:
        return () if self.of.surface.is_face else (self.on.up,)


# -- the elements that replace it in its phases ----------------------------------------------------


@dataclass(frozen=True)
class _InPhase(Element):
    """A couple in one of its phases."""

    law: FrictionCouple

    @property
    def name(self) -> str:  # type: ignore[override]
        return self.law.name

    @property
    def bodies(self) -> tuple[Body, ...]:
        return self.law.bodies

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        return ()


class Held(_InPhase):
    """Nothing rolls, or spins: the couple is what that needs."""

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        return self.law.sliding(places)


class NoCouple(_InPhase):
    """No couple: off the support, or before it is known which way a body turns."""

    def absent(self) -> tuple[str, ...]:
        return self.law.components[1:]


class Turning(_InPhase, Slipping):
    """It opposes a motion in a direction given by symbols."""

    law: FrictionCouple
