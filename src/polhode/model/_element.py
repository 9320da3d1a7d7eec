"""Common to contacts and joints: they place bodies, and they restrain them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar, NamedTuple

from polhode.algebra import Expr, Vector, coordinate, has_parts, speed
from polhode.base import DeclarationError
from polhode.model._body import Body, TwoPointLink
from polhode.model._declared import Declared, of_type

#: Position of the centre of mass of every body placed so far, from the origin of the root frame.
Places = Mapping[Body, Vector]


@dataclass(frozen=True)
class Share:
    """The force or couple that one unit of a reaction exerts on a body.

    Attributes:
        body: the body.
        direction: of the force, or without an arm of the couple; its length is the ratio to the
            reaction.
        arm: from the centre of mass to the point, m.
    """

    body: Body
    direction: Vector
    arm: Vector | None = None

    def mapped(self, change: Callable[[Expr], Expr]) -> Share:
        """The same with every component of the direction changed."""
        return replace(self, direction=self.direction.mapped(change))


@dataclass(frozen=True)
class Restraint:
    """One relative speed that a support prescribes, and the reaction by which it does so.

    A force along `direction` acts on `body` at `arm` from its centre of mass, and its opposite on
    `other` if there is one; without an arm the reaction is a couple about `direction`. A screw or a
    rope restrains a combination of several velocities: `more` has the others, and by the principle
    of virtual power the reaction acts on each of them in proportion.

    Attributes:
        name: of the reaction component, such as F_rho.
        body: the body held.
        direction: unit vector.
        velocity: prescribed velocity of the point (m/s), or angular velocity (rad/s) for a
            couple; relative to `other` where there is one.
        arm: from the centre of mass to the point, m.
        other: the body that supports, if not the ground.
        other_arm: from its centre of mass to the point, m.
        more: further points and rotations: Σ direction · velocity over all of them is prescribed.
        of_travel: whether, without an arm, the direction is a length by which a rotation makes the
            point of contact travel; its reaction is then a force, against that travel.
    """

    name: str
    body: Body
    direction: Vector
    velocity: Vector
    arm: Vector | None = None
    other: Body | None = None
    other_arm: Vector | None = None
    more: tuple[Share, ...] = ()
    of_travel: bool = False

    def shares(self, direction: Vector | None = None) -> tuple[Share, ...]:
        """All bodies on which one unit of the reaction acts.

        Args:
            direction: instead of the restraint's own, for a normal force with friction.
        """
        along = self.direction if direction is None else direction
        own: tuple[Share, ...] = (Share(self.body, along, self.arm),)
        if self.other is not None:
            own += (Share(self.other, -along, self.other_arm),)
        return own + self.more

    def mapped(self, change: Callable[[Expr], Expr]) -> Restraint:
        """The same with every component of directions and velocity changed."""
        return replace(
            self,
            direction=self.direction.mapped(change),
            velocity=self.velocity.mapped(change),
            more=tuple(share.mapped(change) for share in self.more),
        )

    @property
    def is_couple(self) -> bool:
        """Whether the reaction is a couple rather than a force."""
        return self.arm is None and not self.of_travel

    @property
    def is_in_parts(self) -> bool:
        """Whether its direction or an arm is written with named parts."""
        vectors = [self.direction, self.arm]
        vectors += [v for share in self.more for v in (share.direction, share.arm)]
        return any(has_parts(c) for v in vectors if v is not None for c in v.components)


@dataclass(frozen=True)
class Friction:
    """Dry friction: coefficient times the normal reaction, against a slip velocity.

    Attributes:
        normal: the restraint whose reaction presses the surfaces together.
        coefficient: kinetic friction coefficient.
        sliding: what would keep it from slipping along two directions, or along one: their
            reactions are the components of friction. Without arms these are couples, as of rolling
            resistance.
        slip: components of the unit vector along the slip; that of the slip velocity if None.
        letter: of the slip speed, where it is printed; empty for that of sliding, v_c.
    """

    normal: Restraint
    coefficient: Expr
    sliding: tuple[Restraint, ...]
    slip: tuple[Expr, ...] | None = None
    letter: str = ""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the components."""
        return tuple(restraint.name for restraint in self.sliding)

    @property
    def is_couple(self) -> bool:
        """Whether it acts by a couple instead of a force at the point of contact."""
        return self.sliding[0].arm is None


class Limit(NamedTuple):
    """Where the description of a contact ends.

    Attributes:
        kind: the event that ends a motion there.
        positive: until then.
    """

    kind: str
    positive: Expr


class Element(Declared, ABC):
    """A contact or a joint."""

    name: str

    #: What to declare instead where the place that supports it moves with another body.
    on_moving_body: ClassVar[str] = (
        "name the body that carries it: to=body.point(offset), or to=body; for a string or a gear "
        "declare a Rope or a Gear"
    )

    @property
    @abstractmethod
    def bodies(self) -> tuple[Body, ...]:
        """The bodies it acts on."""

    @abstractmethod
    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        """Its restraints, given the positions of the bodies."""

    def centre(self, places: Places) -> Mapping[Body, Vector]:
        """The position it gives to the centre of mass of a body that is not yet placed."""
        return {}

    def rates(self) -> Mapping[Expr, Expr]:
        """Rates of the coordinates it introduces, in terms of the speeds it introduces."""
        return {}

    def introduced(self) -> Iterable[Expr]:
        """The coordinates it introduces for the body that it places."""
        return self.rates()

    @property
    def push(self) -> str | None:
        """The component of its force that must not be negative; None where it may pull."""
        return None

    def closures(self, places: Places) -> tuple[Expr, ...]:
        """Expressions of the configuration that must vanish (m)."""
        return ()

    def strays(self, places: Places) -> tuple[Expr, ...]:
        """Velocities (m/s, rad/s) that other parts must rule out, because it does not itself."""
        return ()

    def misaligned(self, stray: Expr) -> DeclarationError:
        """The error where the motion does not rule one of these velocities out."""
        return DeclarationError(
            f"{self.name!r}, which also moves with {stray}",
            expected="other joints that rule this motion out",
        )

    def friction(self, places: Places) -> tuple[Friction, ...]:
        """Laws of sliding friction."""
        return ()

    @property
    def links(self) -> tuple[TwoPointLink, ...]:
        """What is drawn between two points."""
        return ()

    def absent(self) -> tuple[str, ...]:
        """Names of the reactions that are zero, because nothing touches."""
        return ()

    def assumed_positive(self) -> tuple[Expr, ...]:
        """Expressions whose sign is assumed to be positive."""
        return ()

    @property
    def limits(self) -> tuple[Limit, ...]:
        """What is positive as long as a curved support is touched, or is nearest, at one point."""
        return ()


def require_two(name: str, body: Body, other: Body) -> None:
    """Refuse a joint of a body to itself, or to something else."""
    of_type(other, Body, f"the other body of {name!r}", "give the body itself")
    if body == other:
        raise DeclarationError(
            f"{name!r}, which joins body {body.name!r} to itself",
            expected="another body, or none for the ground",
        )


# -- free flight -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Flight(Element):
    """Free motion of the centre of mass, by components along the root frame."""

    body: Body
    name: str = "flight"

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,)

    def rates(self) -> Mapping[Expr, Expr]:
        tag = self.body.tag
        labels = self.body.axes.root.labels
        return {coordinate(f"{label}{tag}"): speed(f"v_{label}{tag}") for label in labels}

    def centre(self, places: Places) -> Mapping[Body, Vector]:
        return {self.body: Vector(tuple(self.rates()), self.body.axes.root)}

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        return ()
