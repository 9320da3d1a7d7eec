"""Contacts of a body with a support: rolling, frictionless, with dry friction, and their phases."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, Self

from polhode.algebra import Expr, ExprLike, Symbol, Vector, as_symbol, is_positive
from polhode.base import DeclarationError
from polhode.model._body import Body
from polhode.model._contact_law import (
    FLIGHT,
    FRICTIONLESS,
    ROLLING,
    SLIDING,
    ContactLaw,
    DryFriction,
    Phase,
    Slipping,
)
from polhode.model._declared import not_negative, of_type
from polhode.model._element import Element, Limit, Places, Restraint
from polhode.model._support import MISFIT, NO_FOOT, Support
from polhode.model._surface import LowerEdge, MaterialPoint, Round, Surface


@dataclass(frozen=True, init=False)
class Contact(ContactLaw):
    """A body that touches a support at one point of its surface.

    Its position along the support is two coordinates; on a plane its height follows from its
    attitude.

    Args:
        body: the body, with a surface.
        on: the support.
        name: of the contact; "contact" with the tag of the body by default.
        force: letter of the reaction's components: F_x, F_y, F_z.
        restitution: from 0 to 1, the square root of the fraction of the compression energy that an
            impact returns (Stronge's energetic coefficient).
        at: the point of the body that touches, from its centre of mass (m), such as the end of a
            rod; None for that of its surface.
    """

    body: Body
    on: Support
    name: str
    force: str
    restitution: Expr
    at: Vector | None

    omitted: ClassVar[tuple[str, ...]] = ("at",)

    on_moving_body: ClassVar[str] = (
        "give the body itself, as in Rolling(wheel, on=Plane(cart)), and it will feel the force"
    )

    def __init__(
        self,
        body: Body,
        *,
        on: Support | None = None,
        name: str = "",
        force: str = "F",
        restitution: ExprLike = 0,
        at: Vector | None = None,
    ) -> None:
        of_type(body, Body, "body of a contact", "give it first: Rolling(disk, on=Plane(lab))")
        called = name or f"contact{body.tag}"
        if at is not None:
            body.point(at).require_fixed(f"the point of contact {called!r}")
        if not isinstance(on, Support):
            raise DeclarationError(
                f"contact {called!r} of body {body.name!r} with {_described(on)}",
                expected="a support: Plane, Turntable, Sheet, Sphere, Cylinder, Cone, Torus, "
                "Graph, Revolution or Parametric",
                advice=_meant(on),
            )
        self._set(
            body=body,
            on=on.under(body.tag),
            name=called,
            force=force,
            restitution=restitution_of(restitution, called),
            at=at,
        )
        _ = self.surface  # raises for a body without a surface

    @property
    def surface(self) -> Surface:
        """That of the body, or its point that touches."""
        if self.at is not None:
            return MaterialPoint(self.at)
        if self.body.surface is None and self.body.inertia.is_zero:
            return MaterialPoint()
        if self.body.surface is None:
            raise DeclarationError(
                f"contact {self.name!r} of body {self.body.name!r}, which has no surface",
                expected="a body with a surface",
                advice="give it rim= or surface=, make it with disk, hoop or sphere, or say which "
                "point touches: at=axes['x'] * l",
            )
        if not self.body.surface.touches:
            raise DeclarationError(
                f"contact {self.name!r} of body {self.body.name!r}, which does not say where",
                expected="the corner that touches",
                advice="say which: at=axes.vector(a/2, b/2, -c/2), with a contact for each corner",
            )
        return self.body.surface

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,) if self.on.carrier is None else (self.body, self.on.carrier)

    def on_support(self, support: Support) -> Self:
        """The same contact on another support."""
        return self._changed(on=support)

    @cached_property
    def arm(self) -> Vector:
        """From the centre of mass to the point of contact, m."""
        return self.surface.lowest(self.body.axes, self.on.up)

    @property
    def may_fall_flat(self) -> bool:
        """Whether the centre of mass may come down to the support while the body touches it."""
        return not self.surface.encloses_centre

    def introduced(self) -> tuple[Expr, ...]:
        return self.on.introduced(self.body.tag)

    def rates(self) -> Mapping[Expr, Expr]:
        return self.on.rates(self.body.tag)

    def base(self, places: Places) -> Vector:
        """The reference point of the support, from the origin of the root frame, m."""
        carrier = self.on.carrier
        return self.on.base if carrier is None else places[carrier] + self.on.base

    def gap(self, places: Places) -> Expr:
        """Distance of the body from the support, m."""
        return self.on.gap(places[self.body] - self.base(places), self.arm)

    def height_of_centre(self, places: Places) -> Expr:
        """Height of the centre of mass over the tangent plane of the support, m."""
        return (places[self.body] - self.base(places) - self.on.foot).dot(self.on.up)

    def height(self, places: Places) -> Expr:
        """The value that the coordinate of the height has where it is no coordinate, m."""
        return self.on.height_at(places[self.body] - self.base(places), self.arm)

    def is_placed(self, places: Places) -> bool:
        """Whether the support has its place already."""
        return self.on.carrier is None or self.on.carrier in places

    def centre(self, places: Places) -> Mapping[Body, Vector]:
        if not self.is_placed(places):
            return {}
        return {self.body: self.base(places) + self.on.placed(self.body.tag, self.arm)}

    def closures(self, places: Places) -> tuple[Expr, ...]:
        gap = self.gap(places)
        if gap and self.on.needs_own_coordinates:
            raise DeclarationError(
                f"contact {self.name!r} of body {self.body.name!r}, which another contact or joint "
                "places already",
                expected="at most one curved support of a body, before its other contacts",
                advice=f"list {self.name!r} first in the System",
            )
        return (gap,) if gap else ()

    def assumed_positive(self) -> tuple[Expr, ...]:
        return self.surface.assumed_positive(self.body.axes, self.on.up)

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        return self.on.limits(self.arm)

    @property
    def pressed_by(self) -> str:
        return self.name

    def component(self, label: str) -> str:
        """Name of the reaction's component along a direction of the support."""
        return f"{self.force}_{label}{self.body.tag}"

    @property
    def push(self) -> str:
        return self.component(self.on.normal)

    def restraint(self, label: str, places: Places) -> Restraint:
        """The restraint of the point of contact along one direction of the support."""
        arm, along, name = self.arm, self.on.axes[label], self.component(label)
        carrier, point = self.on.carrier, places[self.body] + self.arm
        if carrier is None:
            return Restraint(name, self.body, along, self.on.velocity(point), arm)
        still, other_arm = self.on.axes.root.zero, point - places[carrier]
        return Restraint(name, self.body, along, still, arm, carrier, other_arm)

    def pressing(self, places: Places) -> Restraint:
        return self.restraint(self.on.normal, places)

    def sliding(self, places: Places) -> tuple[Restraint, ...]:
        return tuple(self.restraint(label, places) for label in self.on.tangents)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        return (self.pressing(places), *self.couples())

    def phases(self) -> Mapping[Phase, Element]:
        elements = self._touching()
        if self.on.beyond is not None:
            outside = self.on_support(self.on.beyond)._touching()
            elements |= {phase.beyond(): element for phase, element in outside.items()}
        return {**elements, FLIGHT: Apart(self)}

    def _touching(self) -> dict[Phase, Element]:
        return {FRICTIONLESS: self}

    def couples(self) -> tuple[Restraint, ...]:
        """The couples that hold the attitude of a body lying on a face."""
        if not self.surface.is_face:
            return ()
        body, axes, carrier = self.body, self.on.axes, self.on.carrier
        turning = axes.angular_velocity if carrier is None else axes.root.zero
        return tuple(
            Restraint(f"C_{label}{body.tag}", body, axes[label], turning, other=carrier)
            for label in (*self.on.tangents, self.on.normal)
        )


@dataclass(frozen=True, init=False)
class Rolling(Contact):
    """The point of contact moves with the support: rolling, pivoting, no slipping.

    Args:
        body, on, name, force, at: as of any contact.
        restitution: of impacts, or two of them, normal and tangential: the second is the fraction
            by which an impact reverses the slip, 1 for a superball (Garwin, Am. J. Phys. 37, 88,
            1969).
        tangential: the second alone; none by default: an impact ends without slip.
    """

    tangential: Expr | None

    omitted: ClassVar[tuple[str, ...]] = ("at", "tangential")

    def __init__(
        self,
        body: Body,
        *,
        on: Support | None = None,
        name: str = "",
        force: str = "F",
        restitution: ExprLike | tuple[ExprLike, ExprLike] = 0,
        at: Vector | None = None,
        tangential: ExprLike | None = None,
    ) -> None:
        normal, along = restitution if isinstance(restitution, tuple) else (restitution, tangential)
        super().__init__(body, on=on, name=name, force=force, restitution=normal, at=at)
        reversed_ = None if along is None else restitution_of(along, self.name)
        self._set(tangential=reversed_)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        return (*self.sliding(places), self.pressing(places), *self.couples())

    def _touching(self) -> dict[Phase, Element]:
        return {ROLLING: self}


class Smooth(Contact):
    """Contact without friction: only the normal force."""


@dataclass(frozen=True, init=False)
class Coulomb(Contact, DryFriction):
    """Contact with dry friction: it sticks up to a limit, and slides against a friction force.

    Sliding friction is the normal force times a coefficient, opposite to the slip velocity. The
    coefficient may depend on the slip speed v: mu + viscous·v + (mu_static − mu) exp(−v/stribeck).

    Args:
        mu: coefficient of kinetic friction.
        mu_static: coefficient of static friction; the kinetic one by default.
        viscous: rise of the coefficient with the slip speed, s/m.
        stribeck: slip speed over which friction falls from static to kinetic, m/s; zero by
            default.
    """

    mu: Expr
    mu_static: Expr
    viscous: Expr
    stribeck: Expr | None

    def __init__(
        self,
        body: Body,
        *,
        on: Support | None = None,
        mu: ExprLike,
        mu_static: ExprLike | None = None,
        viscous: ExprLike = 0,
        stribeck: ExprLike | None = None,
        name: str = "",
        force: str = "F",
        restitution: ExprLike = 0,
        at: Vector | None = None,
    ) -> None:
        super().__init__(body, on=on, name=name, force=force, restitution=restitution, at=at)
        self._set_coefficients(mu, mu_static, viscous, stribeck)

    def _touching(self) -> dict[Phase, Element]:
        # frictionless: at zero slip with no friction force the direction of sliding is undefined
        bare: Any = {"on": self.on, "name": self.name, "force": self.force, "at": self.at}
        return {
            ROLLING: Rolling(self.body, **bare),
            SLIDING: Sliding(self),
            FRICTIONLESS: Smooth(self.body, **bare),
        }


def restitution_of(value: ExprLike, contact: str) -> Expr:
    """A coefficient of restitution, refused where it is outside [0, 1]."""
    what = f"restitution of contact {contact!r}"
    checked = not_negative(value, what)
    if is_positive(checked - 1):
        raise DeclarationError(f"{what}: {checked}", expected="a number from 0 to 1")
    return checked


def _described(support: object) -> str:
    return "nothing" if support is None else f"a {type(support).__name__}"


def _meant(support: object) -> str:
    """What may have been meant by something that is no support."""
    if isinstance(support, Body) and isinstance(support.surface, Round | LowerEdge):
        kind = "Sphere" if isinstance(support.surface, Round) else "Cylinder"
        return f"did you mean ph.{kind}(lab, radius=...), a support? ph.{kind.lower()} is a body"
    return "give on=Plane(lab)"


# -- the elements that replace a contact in its phases ---------------------------------------------


@dataclass(frozen=True)
class Apart(Element):
    """A body off the support that it touches in other phases.

    Its centre of mass has the coordinates it has in contact, and its height in addition.
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
        """Coordinate: height above the support, m."""
        return as_symbol(self.contact.on.height(self.contact.body.tag))

    @property
    def rise(self) -> Symbol:
        """Speed: rate of the height, m/s."""
        return as_symbol(self.contact.on.rise(self.contact.body.tag))

    def introduced(self) -> tuple[Expr, ...]:
        return (*self.contact.introduced(), Expr.generator(self.height))

    def rates(self) -> Mapping[Expr, Expr]:
        own = self.contact.rates()
        rise = {Expr.generator(self.height): Expr.generator(self.rise)}
        return {**own, **rise} if own else {}

    def centre(self, places: Places) -> Mapping[Body, Vector]:
        contact, height = self.contact, Expr.generator(self.height)
        if not contact.is_placed(places):
            return {}
        apart = contact.on.placed(contact.body.tag, contact.arm, height)
        return {contact.body: contact.base(places) + apart}

    @cached_property
    def limits(self) -> tuple[Limit, ...]:
        # off its support a body is described like one that is larger by the gap, and touches
        on, height = self.contact.on, Expr.generator(self.height)
        found = on.limits(self.contact.arm - on.up * height)
        return tuple(x._replace(kind=NO_FOOT) if x.kind == MISFIT else x for x in found)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        return self.contact.couples()

    def absent(self) -> tuple[str, ...]:
        on = self.contact.on
        return tuple(self.contact.component(label) for label in (*on.tangents, on.normal))

    def assumed_positive(self) -> tuple[Expr, ...]:
        return self.contact.assumed_positive()


class Sliding(Contact, Slipping):
    """A contact that slides in a direction given by symbols."""

    law: Coulomb

    def __init__(self, law: Coulomb) -> None:
        super().__init__(
            law.body,
            on=law.on,
            name=law.name,
            force=law.force,
            restitution=law.restitution,
            at=law.at,
        )
        object.__setattr__(self, "law", law)
