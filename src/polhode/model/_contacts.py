"""Contacts of a body with a support: rolling, frictionless, sliding with friction."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import Expr, ExprLike, Vector, coordinate, speed
from polhode.base import DeclarationError
from polhode.model._body import Body
from polhode.model._checks import not_negative, of_type
from polhode.model._element import Element, Friction, Places, Restraint
from polhode.model._supports import Plane
from polhode.model._surface import Surface


@dataclass(frozen=True, init=False)
class Contact(Element):
    """A body that touches a support at one point of its surface.

    Its position along the support is two coordinates with their speeds; its height follows from
    its attitude.

    Args:
        body: the body, with a surface.
        on: the support.
        name: what to call the contact; contact, with the tag of the body, by default.
        force: letter of the reaction's components: F_x, F_y, F_z.
    """

    body: Body
    on: Plane
    name: str
    force: str

    def __init__(
        self, body: Body, *, on: Plane | None = None, name: str = "", force: str = "F"
    ) -> None:
        of_type(body, Body, "what touches", "name the body first: Rolling(disk, on=Plane(lab))")
        called = name or f"contact{body.tag}"
        if not isinstance(on, Plane):
            raise DeclarationError(
                f"contact {called!r} of body {body.name!r} with {_described(on)}",
                expected="a support: Plane, Turntable or Sheet",
                advice="say on=Plane(lab)",
            )
        for field, value in (("body", body), ("on", on), ("name", called), ("force", force)):
            object.__setattr__(self, field, value)
        self._surface()

    def _surface(self) -> Surface:
        if self.body.surface is None:
            raise DeclarationError(
                f"contact {self.name!r} of body {self.body.name!r}, which has no surface",
                expected="a body that can touch something",
                advice="give it rim= or surface=, or make it with disk, hoop or sphere",
            )
        return self.body.surface

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,)

    @cached_property
    def arm(self) -> Vector:
        """From the centre of mass to the point of contact, m."""
        return self._surface().lowest(self.body.axes, self.on.up)

    def _coordinates(self) -> dict[str, Expr]:
        named = {"x": "x", "y": "y", "z": "z"}
        tag = self.body.tag
        return {
            label: coordinate(named.get(label, f"x_{label}") + tag) for label in self.on.tangents
        }

    def rates(self) -> Mapping[Expr, Expr]:
        tag = self.body.tag
        return {x: speed(f"v_{label}{tag}") for label, x in self._coordinates().items()}

    def centre(self, places: Places) -> Mapping[Body, Vector]:
        place = self.on.up * -self.arm.dot(self.on.up)
        for label, x in self._coordinates().items():
            place = place + self.on.axes[label] * x
        return {self.body: place}

    def closures(self, places: Places) -> tuple[Expr, ...]:
        gap = (places[self.body] + self.arm).dot(self.on.up)
        return (gap,) if gap else ()

    def assumed_positive(self) -> tuple[Expr, ...]:
        return self._surface().assumed_positive(self.body.axes, self.on.up)

    def _restraint(self, label: str, places: Places) -> Restraint:
        arm = self.arm
        point = places[self.body] + arm
        velocity = self.on.velocity(point)
        name = f"{self.force}_{label}{self.body.tag}"
        return Restraint(name, self.body, self.on.axes[label], velocity, arm)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        return (self._restraint(self.on.normal, places),)


class Rolling(Contact):
    """The point of contact moves with the support: rolling, pivoting, no slipping."""

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        labels = (*self.on.tangents, self.on.normal)
        return tuple(self._restraint(label, places) for label in labels)


class Smooth(Contact):
    """Contact without friction: only the normal force."""


@dataclass(frozen=True, init=False)
class Coulomb(Contact):
    """Contact that slides, with friction μ times the normal force against the slip velocity.

    Args:
        mu: coefficient of kinetic friction.
    """

    mu: Expr

    def __init__(
        self,
        body: Body,
        *,
        on: Plane | None = None,
        mu: ExprLike,
        name: str = "",
        force: str = "F",
    ) -> None:
        super().__init__(body, on=on, name=name, force=force)
        what = f"friction coefficient of contact {self.name!r}"
        object.__setattr__(self, "mu", not_negative(mu, what))

    def friction(self, places: Places) -> tuple[Friction, ...]:
        first, second = self.on.tangents
        directions = tuple(
            (f"{self.force}_{label}{self.body.tag}", self.on.axes[label])
            for label in (first, second)
        )
        normal = self._restraint(self.on.normal, places)
        return (Friction(normal, self.mu, (directions[0], directions[1])),)


def _described(support: object) -> str:
    return "nothing" if support is None else f"a {type(support).__name__}"
