"""Transmissions: gears, racks, screws and ropes, and the joints that guide one point.

A transmission restrains a combination of velocities of one or more bodies. By the principle of
virtual power its single reaction (the force between two teeth, the tension of a rope) acts on each
of these bodies in proportion to its share of that combination.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

from polhode.algebra import ZERO, Expr, ExprLike, Vector, coordinate, pi
from polhode.base import DeclarationError
from polhode.model._body import Body, BodyPoint, TwoPointLink
from polhode.model._conjugate import spin_rates
from polhode.model._declared import (
    of_type,
    positive,
    quantity,
    unit_vector,
    without_coordinates,
    without_rates,
)
from polhode.model._element import Element, Places, Restraint, Share, require_two
from polhode.model._frame import Frame
from polhode.model._joints import Hold, Weld, require_place, turns_with


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
        for turning in (wheel, to):
            turning.require_direction(axis, f"axis of {called!r}")
        without_coordinates(radii, f"a radius of {called!r}", "use a Constraint between the angles")
        values = {
            "wheel": wheel,
            "radius": radii[0],
            "to": to,
            "other_radius": radii[1],
            "axis": axis,
            "teeth": teeth,
            "name": called,
            "force": force,
        }
        for field, value in values.items():
            object.__setattr__(self, field, value)

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.wheel, self.to)

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
        values = {
            "pinion": pinion,
            "at": at,
            "along": along,
            "to": to,
            "name": called,
            "force": force,
        }
        for field, value in values.items():
            object.__setattr__(self, field, value)

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
        values = {
            "body": body,
            "axis": axis,
            "pitch": advance,
            "at": at if at is not None else body.axes.zero,
            "to": to,
            "name": called,
            "force": force,
        }
        for field, value in values.items():
            object.__setattr__(self, field, value)

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


@dataclass(frozen=True, init=False)
class Rope(Element):
    """A taut massless rope of constant length through two or more points.

    Between its ends it runs over points without friction: small pulleys or eyes. The reaction is
    its tension, positive for a pull. A rope can only pull: watch the sign. An end where the rope
    leaves the rim of a drum, a point that does not turn with the drum, is wound up without
    slipping.

    Args:
        points: of bodies, or places in the ground (m from the origin of the root frame).
        directions: a unit vector for each stretch, from one point to the next, if other parts keep
            them; otherwise they are computed from the places.
        tension: letter of the reaction.

    Raises:
        DeclarationError: for fewer than two points, none of them on a body; for points on the way
            that are not fixed in their body; and, when the equations are derived, for points that
            coincide, directions not along the rope, ends that are neither fixed in their body nor
            where the rope leaves a rim, and a rope that pulls at no body.
    """

    points: tuple[BodyPoint | Vector, ...]
    directions: tuple[Vector, ...]
    name: str
    tension: str

    def __init__(
        self,
        points: Sequence[BodyPoint | Vector],
        *,
        directions: Sequence[Vector] = (),
        name: str = "",
        tension: str = "S",
    ) -> None:
        called = name or "rope"
        for given in (points, directions):
            of_type(
                given, Sequence, f"{called!r}", "give lists: Rope([a, b, c], directions=[d, e])"
            )
        through = tuple(points)
        if len(through) < 2 or not any(isinstance(point, BodyPoint) for point in through):
            raise DeclarationError(
                f"{called!r} through {len(through)} points",
                expected="two points or more, at least one of them on a body",
                advice="name points of bodies as body.point(offset)",
            )
        if len(directions) not in (0, len(through) - 1):
            raise DeclarationError(
                f"{len(directions)} directions of {called!r}",
                expected=f"one for each of its {len(through) - 1} stretches, or none",
            )
        for point in through:
            if isinstance(point, Vector):
                without_rates(point.components, f"a place of {called!r}")
            else:
                of_type(point, BodyPoint, f"a point of {called!r}", "or a place from the origin")
        for point in through[1:-1]:
            if isinstance(point, BodyPoint):
                point.require_fixed(f"a point on the way of {called!r}")
        values = {
            "points": through,
            "directions": tuple(unit_vector(d, f"direction of {called!r}") for d in directions),
            "name": called,
            "tension": tension,
        }
        for field, value in values.items():
            object.__setattr__(self, field, value)

    @property
    def bodies(self) -> tuple[Body, ...]:
        return tuple(dict.fromkeys(p.body for p in self.points if isinstance(p, BodyPoint)))

    @property
    def links(self) -> tuple[TwoPointLink, ...]:
        return tuple(TwoPointLink("rope", *ends) for ends in pairwise(self.points))

    def _stretches(self, places: Places) -> Iterator[Vector]:
        """The vectors from one point to the next, m."""
        spots = [places[p.body] + p.offset if isinstance(p, BodyPoint) else p for p in self.points]
        for first, second in pairwise(spots):
            stretch = second - first
            if stretch.is_zero:
                raise DeclarationError(
                    f"two points of {self.name!r} that coincide",
                    expected="points at a distance from one another",
                )
            yield stretch

    def strays(self, places: Places) -> tuple[Expr, ...]:
        return tuple(across.dt() for across in self.closures(places))

    def misaligned(self, stray: Expr) -> DeclarationError:
        return DeclarationError(
            f"{self.name!r}, whose declared directions are not along it: it also moves across "
            f"them, with {stray}",
            expected="directions along the lines between the points",
            advice="guide the bodies so that they stay on these lines, take the points where the "
            "rope touches, or leave out directions",
        )

    def closures(self, places: Places) -> tuple[Expr, ...]:
        return tuple(
            component
            for direction, stretch in zip(self.directions, self._stretches(places), strict=False)
            for component in direction.cross(stretch).express(direction.triad).components
            if component
        )

    def _refuse_slipping(self, end: BodyPoint | Vector, stretch: Vector, places: Places) -> None:
        """Refuse an end that moves through its body otherwise than by winding the rope up."""
        if isinstance(end, Vector) or end.body.keeps(end.offset):
            return
        through = end.offset.dt() - end.body.angular_velocity.cross(end.offset)
        rates = spin_rates(places)
        if any(c.subs(rates) for c in through.cross(stretch).components):
            raise DeclarationError(
                f"an end of {self.name!r}, ({', '.join(map(str, end.offset.components))}) from the "
                f"centre of body {end.body.name!r}",
                expected="a point fixed in the body, or where the rope leaves the rim of a drum",
                advice="attach it to a body that moves along this one; at a rim give directions",
            )

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        # d(length)/dt = Σ e · (v of the next point - v of this point) = 0. A tension of one unit
        # pulls every point along each of its stretches.
        stretches = self.directions or [s / s.norm() for s in self._stretches(places)]
        self._refuse_slipping(self.points[0], stretches[0], places)
        self._refuse_slipping(self.points[-1], stretches[-1], places)
        root = self.bodies[0].axes.root
        shares, driven = [], ZERO
        for point, before, after in zip(
            self.points, (root.zero, *stretches), (*stretches, root.zero), strict=True
        ):
            pull = after - before
            if not isinstance(point, BodyPoint):
                driven = driven - pull.dot(point.dt())
            elif not pull.is_zero:  # a straight rope does not pull at a point on its way
                shares.append(Share(point.body, pull, point.offset))
        if not shares:
            raise DeclarationError(
                f"{self.name!r}, which pulls at no body",
                expected="a body at an end of the rope, or where it bends",
            )
        first, *others = shares
        along = first.direction * (driven / first.direction.dot(first.direction))
        name = self.tension + self.bodies[0].tag
        return (Restraint(name, first.body, first.direction, along, first.arm, more=tuple(others)),)


# -- joints that guide a point ---------------------------------------------------------------------


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
        values = {
            "body": body,
            "axis": axis,
            "along": guide,
            "to": to if to is not None else root.zero,
            "at": at if at is not None else body.axes.zero,
            "distance": distance,
            "name": called,
            "force": force,
            "torque": torque,
        }
        for field, value in values.items():
            object.__setattr__(self, field, value)
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
        values = {
            "body": body,
            "across": across,
            "at": at if at is not None else body.axes.zero,
            "name": called,
            "force": force,
        }
        for field, value in values.items():
            object.__setattr__(self, field, value)

    @property
    def bodies(self) -> tuple[Body, ...]:
        return (self.body,)

    def restraints(self, places: Places) -> tuple[Restraint, ...]:
        axes, force = self.body.axes, self.force
        return Hold(
            self.body, at=self.at, along=axes, only=self.across, name=self.name, force=force
        ).restraints(places)
