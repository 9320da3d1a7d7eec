"""Joints that guide one point: a slider along a straight guide, and a knife edge."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from polhode.algebra import Expr, Vector, coordinate
from polhode.base import DeclarationError
from polhode.model._body import Body, BodyPoint
from polhode.model._declared import of_type
from polhode.model._element import Element, Places, Restraint
from polhode.model._frame import Frame
from polhode.model._joints import Hold, Weld, require_place, turns_with


@dataclass(frozen=True, init=False)
class Slider(Element):
    """A body that slides along a straight guide without turning in it.

    Its distance along the guide is a coordinate. The reaction is a force across the guide, and a
    couple that keeps the body from turning in it.

    Args:
        body: the slider, with axes that turn with the guide.
        axis: label of the direction of the guide.
        along: frame of the guide, which may turn with a body or with time; by default the axes of
            the body that carries it, or the root frame.
        to: the guide: a point of a body, or a place in the ground; the origin by default.
        at: the sliding point from the centre of mass of the slider, m.
        distance: name of the coordinate along the guide, m.
        force: letter of the components of the force.
        torque: letter of the components of the couple.

    Raises:
        DeclarationError: for a frame of the guide that does not turn with the body that carries
            it, and for axes of the slider that do not turn with the guide.
    """

    body: Body
    axis: str
    along: Frame
    to: Vector | BodyPoint
    at: Vector
    distance: str
    name: str
    force: str
    torque: str

    def __init__(
        self,
        body: Body,
        *,
        axis: str,
        along: Frame | None = None,
        to: Vector | BodyPoint | None = None,
        at: Vector | None = None,
        distance: str = "s",
        name: str = "",
        force: str = "F",
        torque: str = "tau",
    ) -> None:
        called = name or f"slider{getattr(body, 'tag', '')}"
        of_type(body, Body, f"the body of {called!r}", "give the body that slides")
        require_place(to, f"to= of {called!r}")
        root = body.axes.root
        carrier = to.body if isinstance(to, BodyPoint) else None
        guide = along or (root if carrier is None else carrier.axes)
        _require_guide(called, guide, body, carrier)
        self._set(
            body=body,
            axis=axis,
            along=guide,
            to=to if to is not None else root.zero,
            at=at if at is not None else body.axes.zero,
            distance=distance,
            name=called,
            force=force,
            torque=torque,
        )
        _ = self._weld

    @property
    def _weld(self) -> Weld:
        """All that it holds: two components of the force and all of the couple."""
        return Weld(
            self.body,
            at=self.at,
            to=self.to,
            along=self.along,
            only=" ".join(self.along.others(self.axis)),
            name=self.name,
            force=self.force,
            torque=self.torque,
        )

    @property
    def bodies(self) -> tuple[Body, ...]:
        return self._weld.bodies

    def _start(self, places: Places) -> Vector:
        """The point of the guide from which the distance is measured."""
        if isinstance(self.to, BodyPoint):
            return places[self.to.body] + self.to.offset
        return self.to

    def centre(self, places: Places) -> Mapping[Body, Vector]:
        if isinstance(self.to, BodyPoint) and self.to.body not in places:
            return {}
        (moved,) = self.introduced()
        return {self.body: self._start(places) + self.along[self.axis] * moved - self.at}

    def introduced(self) -> tuple[Expr]:
        return (coordinate(self.distance + self.body.tag),)

    def closures(self, places: Places) -> tuple[Expr, ...]:
        return self._weld.closures(places)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        # The guide holds the slider where it is: at this vector from the start of the guide.
        along = places[self.body] + self.at - self._start(places)
        if isinstance(self.to, BodyPoint):
            carrier, other_arm = self.to.body, self.to.offset + along
            velocity = turning = self.body.axes.root.zero
        else:
            carrier, other_arm = None, None
            turning = self.along.angular_velocity
            velocity = self.to.dt() + turning.cross(along)
        body, tag = self.body, self.body.tag
        forces = (
            Restraint(
                f"{self.force}_{label}{tag}",
                body,
                self.along[label],
                velocity,
                self.at,
                carrier,
                other_arm,
            )
            for label in self.along.others(self.axis)
        )
        couples = (
            Restraint(
                f"{self.torque}_{label}{tag}", body, self.along[label], turning, other=carrier
            )
            for label in self.along.labels
        )
        return (*forces, *couples)


def _require_guide(name: str, guide: Frame, body: Body, carrier: Body | None) -> None:
    """Refuse a guide that does not turn with its carrier, or a slider not with the guide."""
    if carrier is not None and not turns_with(guide, carrier):
        raise DeclarationError(
            f"{name!r} along {guide.name!r}, which does not turn with body {carrier.name!r}",
            expected="a frame fixed in the body that carries the guide",
            advice="leave out along, or take axes that turn with that body",
        )
    if not (guide.angular_velocity - body.axes.angular_velocity).is_zero:
        raise DeclarationError(
            f"{name!r} of body {body.name!r}, whose axes do not turn with the guide",
            expected=f"a slider with the axes of the guide, {guide.name!r}",
            advice="declare the body with axes= those of the guide, also if it is a point mass",
        )


@dataclass(frozen=True, init=False)
class KnifeEdge(Element):
    """A sharp wheel, skate or blade: a point of a body cannot move across the edge.

    Args:
        body: the body that carries the edge.
        across: label of the body's axis perpendicular to the edge; of a wheel, its axis of spin.
        at: from its centre of mass to the edge, m.
        force: letter of the reaction.

    Raises:
        DeclarationError: for an edge that does not turn with the body.
    """

    body: Body
    across: str
    at: Vector
    name: str
    force: str

    def __init__(
        self,
        body: Body,
        *,
        across: str,
        at: Vector | None = None,
        name: str = "",
        force: str = "F",
    ) -> None:
        called = name or f"edge{body.tag}"
        body.require_direction(body.axes[across], f"direction across {called!r}")
        self._set(
            body=body,
            across=across,
            at=at if at is not None else body.axes.zero,
            name=called,
            force=force,
        )

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        axes, force = self.body.axes, self.force
        return Hold(
            self.body, at=self.at, along=axes, only=self.across, name=self.name, force=force
        ).restraints(places)
