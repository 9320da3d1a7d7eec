"""Transmissions between turning bodies: gears, racks and screws.

A transmission restrains a combination of velocities of one or more bodies. By the principle of
virtual power its single reaction (the force between two teeth, along a thread) acts on each of
these bodies in proportion to its share of that combination.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from polhode.algebra import Expr, ExprLike, Vector, coordinate, pi
from polhode.base import DeclarationError
from polhode.model._body import Body
from polhode.model._declared import (
    Size,
    of_type,
    positive,
    quantity,
    unit_vector,
    without_coordinates,
    without_rates,
)
from polhode.model._element import Element, Places, Restraint, Share, require_two
from polhode.model._spin import WithAxes


@dataclass(frozen=True, init=False)
class Gear(Element):
    """Two toothed wheels in mesh: their pitch circles roll on each other.

    The wheels turn about parallel axes through their centres of mass, which hinges or a carrier
    keep at the distance of the sum of the radii, or of their difference for internal teeth. The
    reaction is the tangential force of the second wheel on the first at the pitch point.

    Args:
        wheel: the first wheel.
        radius: of its pitch circle, m.
        to: the second wheel.
        other_radius: of its pitch circle, m.
        axis: unit vector along the axes.
        teeth: "external", or "internal" where the smaller wheel runs inside the larger one.
        force: letter of the reaction.

    Raises:
        DeclarationError: for radii that are not positive, for an axis that is not fixed in both
            wheels, and, when the equations are derived, for centres at another distance.
    """

    wheel: Body
    radius: Expr
    to: Body
    other_radius: Expr
    axis: Vector
    teeth: str
    name: str
    force: str

    def __init__(
        self,
        wheel: Body,
        *,
        radius: ExprLike,
        to: Body,
        other_radius: ExprLike,
        axis: Vector,
        teeth: str = "external",
        name: str = "",
        force: str = "F",
    ) -> None:
        called = name or f"gear{wheel.tag}"
        require_two(called, wheel, to)
        if teeth not in ("external", "internal"):
            raise DeclarationError(
                f"teeth={teeth!r} of {called!r}", expected="'external' or 'internal'"
            )
        radii = [positive(r, f"a radius of {called!r}") for r in (radius, other_radius)]
        unit_vector(axis, f"axis of {called!r}")
        wheel.require_direction(axis, f"axis of {called!r}")
        if not to.keeps(axis):
            raise _bevel(called, wheel, to, radii)
        without_coordinates(radii, f"a radius of {called!r}", "use a Constraint between the angles")
        self._set(
            wheel=wheel,
            radius=radii[0],
            to=to,
            other_radius=radii[1],
            axis=axis,
            teeth=teeth,
            name=called,
            force=force,
        )

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.wheel, self.to)

    @property
    def sizes(self) -> Iterator[Size]:
        radii = (self.radius, self.other_radius)
        return (Size(f"a radius of {self.name!r}", radius) for radius in radii)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        apart = places[self.to] - places[self.wheel]
        # From the first centre the pitch point lies at `radius` towards the second one; with
        # internal teeth beyond it, or on the far side if the first wheel is the smaller one.
        sign = -1 if self.teeth == "internal" else 1
        reach = self.radius + sign * self.other_radius
        if reach.is_zero:
            raise DeclarationError(
                f"{self.name!r} between two equal wheels with internal teeth",
                expected="a smaller wheel inside a larger one",
            )
        if not (apart.dot(apart) - reach * reach).is_zero or not apart.dot(self.axis).is_zero:
            raise DeclarationError(
                f"{self.name!r}: the centres of {self.wheel.name!r} and {self.to.name!r} are not "
                f"{reach} apart at right angles to the axis",
                expected="wheels held at a distance that is the sum of their radii, or the "
                "difference for internal teeth",
                advice="hold each centre with a Pivot whose place is written with these radii",
            )
        outward = apart / reach
        arm = outward * self.radius
        along = self.axis.cross(outward)
        return (
            Restraint(
                f"{self.force}_t{self.wheel.tag}",
                self.wheel,
                along,
                self.wheel.axes.zero,
                arm,
                self.to,
                arm - apart,
            ),
        )


def _bevel(called: str, wheel: Body, to: Body, radii: Sequence[Expr]) -> DeclarationError:
    """The error for axes that are not parallel, with the constraint of bevel gears."""
    own, other = (
        body.axes.angle if isinstance(body.spin, WithAxes) else coordinate(name)
        for body, name in ((wheel, "psi_1"), (to, "psi_2"))
    )
    equation = radii[0] * own - radii[1] * other
    names = dict.fromkeys(symbol.published for radius in radii for symbol in radius.symbols())
    where = ", ".join(f"'{name}': {name}" for name in names)
    declared = f"Constraint('{equation} = 0', on=({wheel.name}, {to.name}), where={{{where}}})"
    return DeclarationError(
        f"{called!r} with an axis that is not fixed in body {to.name!r}",
        expected="parallel axes; bevel gears are declared by a Constraint",
        advice=f"use {declared}, with angles counted from the carrier of both axles, and with the "
        "other sign where the wheels turn in opposite senses about their axes",
    )


@dataclass(frozen=True, init=False)
class Rack(Element):
    """A pinion in mesh with a rack that slides without turning, or with a rack in the ground.

    The reaction is the force of the rack on the pinion along the rack, at the pitch point.

    Args:
        pinion: the wheel.
        at: from its centre of mass to the pitch point, m.
        along: unit vector along the rack.
        to: the body that carries the rack, or the ground.
        force: letter of the reaction.

    Raises:
        DeclarationError: for a direction that is not fixed in the rack, or not perpendicular to the
            radius; and, when the equations are derived, for a pinion whose centre may come nearer
            to the rack, or that may turn about another axis.
    """

    pinion: Body
    at: Vector
    along: Vector
    to: Body | None
    name: str
    force: str

    def __init__(
        self,
        pinion: Body,
        *,
        at: Vector,
        along: Vector,
        to: Body | None = None,
        name: str = "",
        force: str = "F",
    ) -> None:
        called = name or f"rack{pinion.tag}"
        if to is not None:
            require_two(called, pinion, to)
        of_type(at, Vector, f"at of {called!r}", "give it along a frame: lab['z'] * -R")
        what = f"direction of {called!r}"
        unit_vector(along, what)
        if to is not None:
            to.require_direction(along, what)
        else:
            in_ground = along.express(pinion.axes.root).components
            without_coordinates(in_ground, what, "take it along the root frame")
        if at.is_zero or not at.dot(along).is_zero:
            raise DeclarationError(
                f"at=({', '.join(map(str, at.components))}) of {called!r}",
                expected="the radius to the pitch point, perpendicular to the rack",
            )
        self._set(pinion=pinion, at=at, along=along, to=to, name=called, force=force)

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.pinion,) if self.to is None else (self.pinion, self.to)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        name, still = f"{self.force}_t{self.pinion.tag}", self.pinion.axes.zero
        if self.to is None:
            place = places[self.pinion] + self.at
            ground = self.pinion.axes.root.angular_velocity.cross(place)
            return (Restraint(name, self.pinion, self.along, ground, self.at),)
        other = places[self.pinion] + self.at - places[self.to]
        return (Restraint(name, self.pinion, self.along, still, self.at, self.to, other),)

    def strays(self, places: Places) -> tuple[Expr, ...]:
        # The pitch point stays on the pitch line where the centre of the pinion moves along the
        # rack, at the same distance, and the pinion turns about the axis across both.
        turning, moving = self.pinion.angular_velocity, places[self.pinion].dt()
        if self.to is None:
            carried = self.pinion.axes.root.angular_velocity
            velocity = moving - carried.cross(places[self.pinion])
        else:
            carried = self.to.angular_velocity
            gap = places[self.pinion] - places[self.to]
            velocity = moving - places[self.to].dt() - carried.cross(gap)
        rotation = turning - carried
        return (velocity.dot(self.at), rotation.dot(self.at), rotation.dot(self.along))

    def misaligned(self, stray: Expr) -> DeclarationError:
        return DeclarationError(
            f"{self.name!r}: the pitch point of {self.pinion.name!r} does not stay on the pitch "
            f"line, since the pinion also moves with {stray}",
            expected="a pinion whose centre keeps its distance from the rack, and whose axis stays "
            "across it",
            advice="hold the centre with a Pivot or a Slider along the rack, and the axis with a "
            "Hinge; at points from the centre to the rack",
        )


@dataclass(frozen=True, init=False)
class Screw(Element):
    """A body that advances along an axis as it turns about it.

    Other joints guide the axis. The reaction is the axial force on the body; with it comes the
    couple -pitch/2π times that force about the axis.

    Args:
        body: the screw.
        axis: unit vector along the axis.
        pitch: advance per turn, m; negative for a left-handed thread.
        at: from its centre of mass to a point of the axis, m.
        to: the nut, or the ground.
        force: letter of the reaction.

    Raises:
        DeclarationError: for a pitch of zero, and for an axis that is not fixed in screw and nut.
    """

    body: Body
    axis: Vector
    pitch: Expr
    at: Vector
    to: Body | None
    name: str
    force: str

    def __init__(
        self,
        body: Body,
        *,
        axis: Vector,
        pitch: ExprLike,
        at: Vector | None = None,
        to: Body | None = None,
        name: str = "",
        force: str = "F",
    ) -> None:
        called = name or f"screw{body.tag}"
        if to is not None:
            require_two(called, body, to)
        unit_vector(axis, f"axis of {called!r}")
        for turning in (body, to) if to is not None else (body,):
            turning.require_direction(axis, f"axis of {called!r}")
        advance = quantity(pitch, f"pitch of {called!r}")
        without_rates([advance], f"pitch of {called!r}")
        if advance.is_zero:
            raise DeclarationError(
                f"pitch of {called!r}: 0",
                expected="an advance per turn other than zero",
                advice="a body that turns without advancing needs a Hinge and a Pivot",
            )
        self._set(
            body=body,
            axis=axis,
            pitch=advance,
            at=at if at is not None else body.axes.zero,
            to=to,
            name=called,
            force=force,
        )

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,) if self.to is None else (self.body, self.to)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        # v · axis - (pitch/2π) ω · axis = 0, relative to the nut
        turning = self.axis * (-self.pitch / (2 * pi))
        more: tuple[Share, ...] = (Share(self.body, turning),)
        root, place = self.body.axes.root, places[self.body] + self.at
        velocity, other_arm = root.zero, None
        if self.to is None:
            turned = root.angular_velocity
            slope = turned.dot(turning)
            velocity = turned.cross(place) + self.axis * slope
        else:
            other_arm = place - places[self.to]
            more += (Share(self.to, -turning),)
        name = f"{self.force}_a{self.body.tag}"
        return (Restraint(name, self.body, self.axis, velocity, self.at, self.to, other_arm, more),)
