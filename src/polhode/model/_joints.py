"""Joints: couples that keep a body to an axis, a plane or a rate; pivots and welds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

from polhode.algebra import Expr, ExprLike, Vector, words
from polhode.base import DeclarationError
from polhode.model._body import Body, BodyPoint
from polhode.model._declared import of_type, quantity, unit_vector, without_rates
from polhode.model._element import Element, Places, Restraint, require_two
from polhode.model._frame import Frame


def _directions(only: str | Sequence[str], axes: Frame, called: str) -> tuple[str, ...]:
    """The labels of the directions in which a point is held; all of them for an empty text."""
    if isinstance(only, str) and not only.strip():
        return axes.labels
    found = words(only, f"only= of {called!r}")
    if not found or len(set(found)) < len(found) or not set(found) <= set(axes.labels):
        raise DeclarationError(
            f"only={only!r} of {called!r}",
            expected=f"different directions among {', '.join(axes.labels)}",
            advice="leave it out to hold the point in all directions",
        )
    return found


@dataclass(frozen=True)
class _Couple(Element):
    """Holds the attitude of a body by couples."""

    body: Body
    to: Body | None
    name: str
    torque: str

    def __post_init__(self) -> None:
        if self.to is not None:
            require_two(self.name, self.body, self.to)

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,) if self.to is None else (self.body, self.to)

    def _restraint(self, label: str, direction: Vector, velocity: Vector) -> Restraint:
        name = f"{self.torque}_{label}{self.body.tag}"
        return Restraint(name, self.body, direction, velocity, other=self.to)

    def _support(self) -> Vector:
        """The prescribed angular velocity: the ground's, or zero relative to another body."""
        root = self.body.axes.root
        return root.zero if self.to is not None else root.angular_velocity


@dataclass(frozen=True, init=False)
class Hinge(_Couple):
    """Lets a body turn about one of its axes only; hold a point of it with a `Pivot`.

    Args:
        body: the body held.
        axis: label of the body's axis about which it may turn.
        to: the body it is hinged to, or the ground.
        torque: letter of the components of the reaction couple.
    """

    axis: str

    def __init__(
        self,
        body: Body,
        *,
        axis: str,
        to: Body | None = None,
        name: str = "",
        torque: str = "tau",
    ) -> None:
        super().__init__(body, to, name or f"hinge{body.tag}", torque)
        body.axes[axis]
        object.__setattr__(self, "axis", axis)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        return tuple(
            self._restraint(label, self.body.axes[label], self._support())
            for label in self.body.axes.others(self.axis)
        )


@dataclass(frozen=True, init=False)
class Universal(_Couple):
    """Hooke's joint: the two cross arms stay perpendicular; hold a point with a `Pivot`.

    Args:
        body: the body held.
        arm: unit vector of the cross arm that turns in the body.
        other_arm: unit vector of the cross arm that turns in the other body or the ground.
        to: the other body, or the ground.
    """

    arm: Vector
    other_arm: Vector

    def __init__(
        self,
        body: Body,
        *,
        arm: Vector,
        other_arm: Vector,
        to: Body | None = None,
        name: str = "",
        torque: str = "tau",
    ) -> None:
        super().__init__(body, to, name or f"universal{body.tag}", torque)
        for field, vector in (("arm", arm), ("other_arm", other_arm)):
            object.__setattr__(self, field, unit_vector(vector, f"{field} of {self.name!r}"))
        body.require_direction(arm, f"arm of {self.name!r}")
        if to is not None:
            to.require_direction(other_arm, f"other_arm of {self.name!r}")

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        # d(arm · other_arm)/dt = 0 leaves one component of ω relative to the other body to zero
        across = self.arm.cross(self.other_arm)
        carried = _carrying(self.other_arm) if self.to is None else self._support()
        return (self._restraint("cross", across, carried),)

    def closures(self, places: Places) -> tuple[Expr, ...]:
        angle = self.arm.dot(self.other_arm)
        return (angle,) if angle else ()


@dataclass(frozen=True, init=False)
class Guide(_Couple):
    """Keeps an axis of a body in the plane perpendicular to a direction of the ground.

    The reaction is a couple about the direction in that plane that is perpendicular to the axis.

    Args:
        body: the body held.
        axis: label of the axis that is kept in the plane.
        normal: unit vector perpendicular to the plane; it may turn with time.
        label: of the couple's component, as 2 in tau_2.
    """

    axis: str
    normal: Vector
    label: str

    def __init__(
        self,
        body: Body,
        *,
        axis: str,
        normal: Vector,
        label: str,
        name: str = "",
        torque: str = "tau",
    ) -> None:
        super().__init__(body, None, name or f"guide{body.tag}", torque)
        unit_vector(normal, f"normal of {self.name!r}")
        if not body.keeps(body.axes[axis]):
            raise DeclarationError(
                f"axis {axis!r} of {self.name!r}, which does not turn with body {body.name!r}",
                expected="an axis that is fixed in the body",
                advice="take the axis of spin, or turn the axes with the body by one more angle",
            )
        self._set(axis=axis, normal=normal, label=label)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        direction = self.body.axes[self.axis].cross(self.normal)
        along = direction.express(self.body.axes)
        return (self._restraint(self.label, along, _carrying(self.normal)),)

    def closures(self, places: Places) -> tuple[Expr, ...]:
        rise = self.body.axes[self.axis].dot(self.normal)
        return (rise,) if rise else ()


@dataclass(frozen=True, init=False)
class Motor(_Couple):
    """Keeps a body turning about one of its axes at a given rate relative to a frame.

    Args:
        body: the body driven.
        axis: label of the axis.
        rate: rad/s; may be a function of time.
        relative_to: the frame the rate is relative to; the body's axes by default.
        to: the body that carries the motor and feels the opposite couple, or the ground.
    """

    axis: str
    rate: Expr
    relative_to: Frame

    def __init__(
        self,
        body: Body,
        *,
        axis: str,
        rate: ExprLike,
        relative_to: Frame | None = None,
        to: Body | None = None,
        name: str = "",
        torque: str = "tau",
    ) -> None:
        super().__init__(body, to, name or f"motor{body.tag}", torque)
        frame = body.axes if relative_to is None else relative_to
        body.axes[axis]
        turned = quantity(rate, f"rate of {self.name!r}")
        self._set(axis=axis, rate=turned, relative_to=frame)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        along = self.body.axes[self.axis]
        frame = self.relative_to.angular_velocity
        if self.to is not None:
            frame = frame - self.to.angular_velocity
        return (self._restraint(self.axis, along, frame + along * self.rate),)


def _carrying(direction: Vector) -> Vector:
    """The angular velocity of a unit vector without rotation about itself, rad/s: e × ė."""
    return direction.cross(direction.dt())


# -- joints at a point -----------------------------------------------------------------------------


@dataclass(frozen=True, init=False)
class Pivot(Element):
    """A point of a body held at a point of the ground or of another body.

    Args:
        body: the body held.
        at: from its centre of mass to the point, m.
        to: the point: a vector from the origin of the root frame (m; it may move with time), or a
            point of another body; the origin by default. The vector may contain coordinates of
            this body alone: derivation refuses those that move other bodies, which would feel the
            force. Coordinates that leave the point free, as `axes["x"] * r` on axes turned by
            theta does in the plane, describe its place, and the reaction has no component
            along which they move it.
        along: frame whose directions name the components of the reaction.
        only: labels of the directions in which it holds; all three by default. These directions
            may turn: two of three along axes of the other body make a slot of that body in which
            the point slides; along axes of its own body, a slot that slides over a fixed pin.
        force: letter of the components.
        pulls: whether its force may have either sign. One that stands for a contact does not pull:
            it holds in one direction, along which it pushes, and where it would have to pull a run
            has the event "NAME pulls".

    Raises:
        DeclarationError: for a point that is not fixed in its body, and for one that does not pull
            but holds in several directions.
    """

    omitted: ClassVar[tuple[str, ...]] = ("pulls",)

    body: Body
    at: Vector
    to: Vector | BodyPoint
    along: Frame
    only: tuple[str, ...]
    name: str
    force: str
    pulls: bool | None

    def __init__(
        self,
        body: Body,
        *,
        at: Vector | None = None,
        to: Vector | BodyPoint | None = None,
        along: Frame | None = None,
        only: str | Sequence[str] = "",
        name: str = "",
        force: str = "F",
        pulls: bool | None = None,
    ) -> None:
        called = name or f"pivot{getattr(body, 'tag', '')}"
        of_type(body, Body, f"the body of {called!r}", "give the body that it holds")
        require_place(to, f"to= of {called!r}")
        if at is not None:
            of_type(at, Vector, f"at= of {called!r}", "give it along a frame: axes['z'] * l")
        root = body.axes.root
        axes = along or root
        of_type(axes, Frame, f"along= of {called!r}", "give a frame: along=lab")
        self._set(
            body=body,
            at=at if at is not None else body.axes.zero,
            to=to if to is not None else root.zero,
            along=axes,
            only=_directions(only, axes, called),
            name=called,
            force=force,
            pulls=None if pulls is None or pulls else False,
        )
        if self.pulls is not None and len(self.only) > 1:
            raise DeclarationError(
                f"{called!r}, which does not pull and holds along {', '.join(self.only)}",
                expected="one direction, along which it pushes",
                advice=f"as in only={self.only[-1]!r}, with another Pivot for the others",
            )
        body.point(self.at).require_fixed(f"point of {self.name!r}")
        if isinstance(self.to, BodyPoint):
            self.to.require_fixed(f"other point of {self.name!r}")
            require_two(self.name, body, self.to.body)
        else:
            without_rates(self.to.components, f"the place of {self.name!r}")

    @property
    def other(self) -> Body | None:
        """The supporting body, if it is not the ground."""
        return self.to.body if isinstance(self.to, BodyPoint) else None

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,) if self.other is None else (self.body, self.other)

    def _target(self, places: Places) -> Vector:
        if isinstance(self.to, BodyPoint):
            return places[self.to.body] + self.to.offset
        # In polar coordinates a place is given along axes that the body need not have. The angles
        # of these axes are coordinates of the body: along its own axes or the root they are seen.
        axes, along = self.body.axes, self.to.triad
        hidden = isinstance(along, Frame) and along.turns_freely and along not in axes.lineage
        return self.to.express(axes.root) if hidden else self.to

    @property
    def push(self) -> str | None:
        return None if self.pulls is None else self.component(self.only[0])

    def component(self, label: str) -> str:
        """Name of the reaction's component along a direction."""
        return f"{self.force}_{label}{self.body.tag}"

    @property
    def is_partial(self) -> bool:
        """Whether it leaves the point free in some direction."""
        return set(self.only) != set(self.along.labels)

    @property
    def is_at_rest(self) -> bool:
        """Whether it keeps the point at rest in the root frame."""
        if isinstance(self.to, BodyPoint) or self.is_partial:
            return False
        return not any(c.dt() for c in self.to.express(self.body.axes.root).components)

    def centre(self, places: Places) -> Mapping[Body, Vector]:
        if self.is_partial or (self.other is not None and self.other not in places):
            return {}
        return {self.body: self._target(places) - self.at}

    def _gap(self, places: Places) -> Vector:
        """From the place to the point that is held there."""
        return places[self.body] + self.at - self._target(places)

    def _free_gap(self, places: Places) -> Vector:
        """The same along the directions in which the point is free."""
        gap = self._gap(places)
        free = (self.along[label] for label in self.along.labels if label not in self.only)
        return sum((axis * gap.dot(axis) for axis in free), self.along.zero)

    def closures(self, places: Places) -> tuple[Expr, ...]:
        gap = self._gap(places)
        return tuple(c for label in self.only if (c := gap.dot(self.along[label])))

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        held = isinstance(self.to, BodyPoint)
        velocity = self.body.axes.zero if held else self._target(places).dt()
        arm, other_arm = self.at, self.to.offset if isinstance(self.to, BodyPoint) else None
        if self.is_partial:
            # In the free directions the held point is at a distance from the declared place. It is
            # held there by a slot of the other body, by a pin at the place in a slot of its own
            # body, or by a slot that turns with the directions: velocity and arms are for that
            # material point. In the held directions the distance is zero by the closures: were it
            # kept as an expression, directions that turn would seem to be held from turning.
            gap = self._free_gap(places)
            if other_arm is not None and turns_with(self.along, self.other):
                other_arm = other_arm + gap
            elif self.along.turns_freely and turns_with(self.along, self.body):
                arm = arm - gap
            else:
                velocity = velocity + self.along.angular_velocity.cross(gap)
        return tuple(
            Restraint(
                self.component(label),
                self.body,
                self.along[label],
                velocity,
                arm,
                self.other,
                other_arm,
            )
            for label in self.only
        )


def require_place(to: object, what: str) -> None:
    """Refuse anything but a point of a body, a place in the ground, or None."""
    if to is not None and not isinstance(to, BodyPoint):
        advice = "name a point of a body as body.point(offset), a place as lab['x'] * R"
        of_type(to, Vector, what, advice)


def turns_with(frame: Frame, body: Body | None) -> bool:
    """Whether the directions of a frame are fixed in a body."""
    if body is None:
        return False
    # An angular velocity that is declared as a speed is that of these axes, too.
    fixed = body.fixed_axes
    turning = body.angular_velocity if fixed is None else fixed.angular_velocity
    return (frame.angular_velocity - turning).is_zero


@dataclass(frozen=True, init=False)
class Weld(Pivot):
    """Joins two bodies rigidly: held at a point as by a `Pivot`, and kept from turning.

    Give both the same axes and the same spin, so that they turn together; or weld a body with axes
    at rest to the ground.

    Args:
        torque: letter of the components of the reaction couple; the others are those of `Pivot`.
    """

    torque: str

    def __init__(self, body: Body, *, name: str = "", torque: str = "tau", **more: Any) -> None:
        super().__init__(body, name=name or f"weld{body.tag}", **more)
        object.__setattr__(self, "torque", torque)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        root = self.body.axes.root
        velocity = root.zero if self.other is not None else root.angular_velocity
        couples = (
            Restraint(
                f"{self.torque}_{label}{self.body.tag}",
                self.body,
                self.along[label],
                velocity,
                other=self.other,
            )
            for label in self.along.labels
        )
        return (*super().restraints(places), *couples)


@dataclass(frozen=True, init=False)
class Hold(Element):
    """A point of a body kept at rest wherever it is, along some or all directions.

    Args:
        body: the body held.
        at: from its centre of mass to the point, m.
        along: frame whose directions name the components of the reaction.
        only: labels of the directions in which it holds; all three by default.
        force: letter of the components.
    """

    body: Body
    at: Vector
    along: Frame
    only: tuple[str, ...]
    name: str
    force: str

    def __init__(
        self,
        body: Body,
        *,
        at: Vector,
        along: Frame | None = None,
        only: str | Sequence[str] = "",
        name: str = "",
        force: str = "Fprime",
    ) -> None:
        axes = along or body.axes.root
        called = name or f"hold{body.tag}"
        self._set(
            body=body,
            at=at,
            along=axes,
            only=_directions(only, axes, called),
            name=called,
            force=force,
        )

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        point = places[self.body] + self.at
        carried = self.body.axes.root.angular_velocity.cross(point)
        tag = self.body.tag
        return tuple(
            Restraint(f"{self.force}_{label}{tag}", self.body, self.along[label], carried, self.at)
            for label in self.only
        )
