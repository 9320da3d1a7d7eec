"""Ropes of constant length, through points of bodies and of the ground.

A rope restrains the sum of the velocities along it, and its tension acts on every point that it
passes, by the principle of virtual power.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from polhode.algebra import ZERO, Expr, Vector, kept_length, kept_sums, total
from polhode.base import DeclarationError
from polhode.model._body import Body, BodyPoint, TwoPointLink
from polhode.model._conjugate import spin_rates
from polhode.model._declared import of_type, unit_vector, without_rates
from polhode.model._element import Element, Places, Restraint, Share
from polhode.model._frame import Frame


@dataclass(frozen=True, init=False)
class Rope(Element):
    """A taut massless rope of constant length through two or more points.

    Between its ends it runs over points without friction: small pulleys or eyes. The reaction is
    its tension, positive for a pull. A rope can only pull: where it would have to push, a run goes
    on, and its event "goes slack" says from when on that is not the motion. A run is refused where
    a stretch has no length left: an end has met the next point. An end where the rope leaves the
    rim of a drum, a point that does not turn with the drum, is wound up without slipping.

    Args:
        points: of bodies, or places in the ground (m from the origin of the root frame).
        directions: a unit vector for each stretch, from one point to the next, if other parts keep
            them; otherwise they are computed from the places. A run is refused that starts with a
            stretch against its direction.
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
        self._set(
            points=through,
            directions=tuple(unit_vector(d, f"direction of {called!r}") for d in directions),
            name=called,
            tension=tension,
        )

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

    def length(self, places: Places) -> Expr:
        """From its first point to its last, m."""
        return total(stretch.norm() for stretch in self._stretches(places))

    def stretches(self, places: Places) -> Iterator[tuple[Expr, ...]]:
        """Components of every stretch, m: along its direction, or else along the root frame."""
        root = self.bodies[0].axes.root
        for i, stretch in enumerate(self._stretches(places)):
            if self.directions:
                yield (self.directions[i].dot(stretch),)
            else:
                yield stretch.express(root).components

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
        root = self.bodies[0].axes.root
        stretches = self.directions or [_unit(s, root) for s in self._stretches(places)]
        self._refuse_slipping(self.points[0], stretches[0], places)
        self._refuse_slipping(self.points[-1], stretches[-1], places)
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
        along = root.zero
        if driven:
            along = first.direction * (driven / first.direction.dot(first.direction))
        name = self.tension + self.bodies[0].tag
        return (Restraint(name, first.body, first.direction, along, first.arm, more=tuple(others)),)


def _unit(stretch: Vector, root: Frame) -> Vector:
    """The direction of a stretch, with its length as one quantity."""
    kept = kept_sums(stretch, root)
    return kept / kept_length(kept.components)
