"""Joints: what holds a body at a point, about an axis, in a plane, or at a rate."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from polhode.algebra import Expr, ExprLike, Vector
from polhode.model._body import Body, BodyPoint
from polhode.model._element import Element, Places, Restraint
from polhode.model._frame import Frame


@dataclass(frozen=True, init=False)
class Pivot(Element):
    """A point of a body held at a point of the ground or of another body.

    Args:
        body: the body held.
        at: from its centre of mass to the point, m.
        to: the point: from the origin of the root frame (m; it may move with time), or a point of
            another body; the origin by default.
        along: frame whose directions name the components of the reaction.
        only: labels of the directions in which it holds; all three by default.
        force: letter of the components.
    """

    body: Body
    at: Vector
    to: Vector | BodyPoint
    along: Frame
    only: tuple[str, ...]
    name: str
    force: str

    def __init__(
        self,
        body: Body,
        *,
        at: Vector | None = None,
        to: Vector | BodyPoint | None = None,
        along: Frame | None = None,
        only: str = "",
        name: str = "pivot",
        force: str = "F",
    ) -> None:
        root = body.axes.root
        axes = along or root
        values = {
            "body": body,
            "at": at if at is not None else body.axes.zero,
            "to": to if to is not None else root.zero,
            "along": axes,
            "only": tuple(only.split()) or axes.labels,
            "name": name,
            "force": force,
        }
        for field, value in values.items():
            object.__setattr__(self, field, value)

    @property
    def other(self) -> Body | None:
        """The body that holds, if it is not the ground."""
        return self.to.body if isinstance(self.to, BodyPoint) else None

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,) if self.other is None else (self.body, self.other)

    def _target(self, places: Places) -> Vector:
        if isinstance(self.to, BodyPoint):
            return places[self.to.body] + self.to.offset
        return self.to

    def centre(self, places: Places) -> Mapping[Body, Vector]:
        partial = set(self.only) != set(self.along.labels)
        if partial or (self.other is not None and self.other not in places):
            return {}
        return {self.body: self._target(places) - self.at}

    def closures(self, places: Places) -> tuple[Expr, ...]:
        gap = places[self.body] + self.at - self._target(places)
        return tuple(c for label in self.only if (c := gap.dot(self.along[label])))

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        held = isinstance(self.to, BodyPoint)
        velocity = self.body.axes.zero if held else self._target(places).dt()
        arm = self.to.offset if isinstance(self.to, BodyPoint) else None
        return tuple(
            Restraint(
                f"{self.force}_{label}{self.body.tag}",
                self.body,
                self.along[label],
                velocity,
                self.at,
                self.other,
                arm,
            )
            for label in self.only
        )


@dataclass(frozen=True, init=False)
class Hold(Element):
    """A point of a body kept at rest wherever it happens to be, along some directions or all.

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
        only: str = "",
        name: str = "hold",
        force: str = "Fprime",
    ) -> None:
        axes = along or body.axes.root
        values = {
            "body": body,
            "at": at,
            "along": axes,
            "only": tuple(only.split()) or axes.labels,
            "name": name,
            "force": force,
        }
        for field, value in values.items():
            object.__setattr__(self, field, value)

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


@dataclass(frozen=True)
class _Couple(Element):
    """Holds the attitude of a body by couples."""

    body: Body
    to: Body | None
    name: str
    torque: str

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,) if self.to is None else (self.body, self.to)

    def _restraint(self, label: str, direction: Vector, velocity: Vector) -> Restraint:
        name = f"{self.torque}_{label}{self.body.tag}"
        return Restraint(name, self.body, direction, velocity, other=self.to)

    def _support(self) -> Vector:
        """Angular velocity of what holds the body; other bodies' are accounted for by theirs."""
        root = self.body.axes.root
        return root.zero if self.to is not None else root.angular_velocity


@dataclass(frozen=True, init=False)
class Hinge(_Couple):
    """Lets a body turn about one of its axes only; hold a point of it with a `Pivot`.

    Args:
        body: the body held.
        axis: label of the direction of the body's axes that it may turn about.
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
        name: str = "hinge",
        torque: str = "tau",
    ) -> None:
        super().__init__(body, to, name, torque)
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
        name: str = "universal",
        torque: str = "tau",
    ) -> None:
        super().__init__(body, to, name, torque)
        object.__setattr__(self, "arm", arm)
        object.__setattr__(self, "other_arm", other_arm)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        across = self.arm.cross(self.other_arm)
        return (self._restraint("cross", across, self._support()),)

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
        normal: unit vector perpendicular to the plane, fixed to the ground.
        label: names the component of the couple: tau_2.
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
        name: str = "guide",
        torque: str = "tau",
    ) -> None:
        super().__init__(body, None, name, torque)
        for field, value in (("axis", axis), ("normal", normal), ("label", label)):
            object.__setattr__(self, field, value)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        direction = self.body.axes[self.axis].cross(self.normal)
        carried = self.normal.triad.angular_velocity
        return (self._restraint(self.label, direction.express(self.body.axes), carried),)

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
        name: str = "motor",
        torque: str = "tau",
    ) -> None:
        super().__init__(body, to, name, torque)
        frame = body.axes if relative_to is None else relative_to
        values = {"axis": axis, "rate": Expr.of(rate), "relative_to": frame}
        for field, value in values.items():
            object.__setattr__(self, field, value)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        along = self.body.axes[self.axis]
        frame = self.relative_to.angular_velocity
        if self.to is not None:
            frame = frame - self.to.angular_velocity
        return (self._restraint(self.axis, along, frame + along * self.rate),)
