"""Joints at a point: pivots, welds, and points kept at rest."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from polhode.algebra import Expr, Vector
from polhode.model._body import Body, BodyPoint
from polhode.model._checks import without_rates
from polhode.model._element import Element, Places, Restraint, require_two
from polhode.model._frame import Frame


@dataclass(frozen=True, init=False)
class Pivot(Element):
    """A point of a body held at a point of the ground or of another body.

    Args:
        body: the body held.
        at: from its centre of mass to the point, m.
        to: the point: from the origin of the root frame (m; it may move with time), or a point of
            another body; the origin by default. A place may contain coordinates of this body
            alone: derivation refuses those that move other bodies, which would feel the force.
        along: frame whose directions name the components of the reaction.
        only: labels of the directions in which it holds; all three by default. These directions
            may turn: with two of three along axes of the other body, the point slides in a slot
            of that body; along axes of its own body, it is the slot that slides over the place.
        force: letter of the components.

    Raises:
        DeclarationError: for a point that is not fixed in its body.
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
        name: str = "",
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
            "name": name or f"pivot{body.tag}",
            "force": force,
        }
        for field, value in values.items():
            object.__setattr__(self, field, value)
        body.point(self.at).require_fixed(f"point of {self.name!r}")
        if isinstance(self.to, BodyPoint):
            self.to.require_fixed(f"other point of {self.name!r}")
            require_two(self.name, body, self.to.body)
        else:
            without_rates(self.to.components, f"the place of {self.name!r}")

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

    @property
    def is_partial(self) -> bool:
        """Whether it leaves the point free in some direction."""
        return set(self.only) != set(self.along.labels)

    def centre(self, places: Places) -> Mapping[Body, Vector]:
        if self.is_partial or (self.other is not None and self.other not in places):
            return {}
        return {self.body: self._target(places) - self.at}

    def _gap(self, places: Places) -> Vector:
        """From the place to the point that is held there."""
        return places[self.body] + self.at - self._target(places)

    def closures(self, places: Places) -> tuple[Expr, ...]:
        gap = self._gap(places)
        return tuple(c for label in self.only if (c := gap.dot(self.along[label])))

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        held = isinstance(self.to, BodyPoint)
        velocity = self.body.axes.zero if held else self._target(places).dt()
        arm, other_arm = self.at, self.to.offset if isinstance(self.to, BodyPoint) else None
        if self.is_partial:
            # Away from the place the point is held by the matter that is where the point is: by a
            # slot of the other body; by a pin at the place in a slot of its own body; or by what
            # turns with the directions.
            gap = self._gap(places)
            turns = self.along.turns_freely
            if turns and other_arm is not None and _turns_with(self.along, self.other):
                other_arm = other_arm + gap
            elif turns and _turns_with(self.along, self.body):
                arm = arm - gap
            else:
                velocity = velocity + self.along.angular_velocity.cross(gap)
        return tuple(
            Restraint(
                f"{self.force}_{label}{self.body.tag}",
                self.body,
                self.along[label],
                velocity,
                arm,
                self.other,
                other_arm,
            )
            for label in self.only
        )


def _turns_with(frame: Frame, body: Body | None) -> bool:
    """Whether the directions of a frame are fixed in a body."""
    return body is not None and (frame.angular_velocity - body.angular_velocity).is_zero


@dataclass(frozen=True, init=False)
class Weld(Pivot):
    """Two bodies made one: held at a point as by a `Pivot`, and kept from turning.

    Give both the same axes and the same spin, so that they turn together; or weld a body whose
    axes are at rest to the ground.

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
        name: str = "",
        force: str = "Fprime",
    ) -> None:
        axes = along or body.axes.root
        values = {
            "body": body,
            "at": at,
            "along": axes,
            "only": tuple(only.split()) or axes.labels,
            "name": name or f"hold{body.tag}",
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
