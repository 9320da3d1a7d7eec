"""Bodies that meet although no contact between them is declared: they pass through each other.

A contact is declared for one body and one support. All other pairs are looked at here, after the
motion: particles and balls with one another and with the supports of other bodies. The motion goes
on as it was declared, with an event where a pair first meets, and a doubt.

Pairs that are left out: bodies that a joint links; bodies between which a potential acts, which
says how they act on each other at any distance; pairs that overlap at the start, such as gimbals
and rings. Other shapes are not watched; those pairs are listed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import combinations, permutations
from typing import Any

import numpy as np

from polhode.algebra import ZERO, Expr, Vector
from polhode.base import ByIdentity, bisected
from polhode.model import (
    Body,
    CentralForce,
    Constraint,
    Contact,
    Plane,
    Potential,
    Rope,
    Round,
    Support,
    System,
)
from polhode.simulate._event import Event
from polhode.simulate._segment import Segment
from polhode.simulate.integrate._arrays import Array

# -- which pairs -----------------------------------------------------------------------------------


@dataclass(frozen=True)
class Ground:
    """The support of another body.

    Attributes:
        surface: the support.
        of: the body for which it is declared.
    """

    surface: Support
    of: Body

    @property
    def name(self) -> str:
        """In words."""
        return f"the support of {self.of.name}"


Pair = tuple[Body, Body | Ground]


@dataclass(frozen=True)
class Pairs:
    """The pairs of a system that may meet without a contact.

    Attributes:
        watched: particles and balls, with one another and with supports.
        unwatched: those with other shapes.
    """

    watched: tuple[Pair, ...]
    unwatched: tuple[Pair, ...]


@lru_cache(maxsize=8)  # few: the cache keeps the systems alive
def pairs_of(key: ByIdentity[System]) -> Pairs:
    """The pairs of bodies, and of bodies and supports, whose meeting nothing declared covers."""
    system = key.subject
    links = _Links(system)
    massive = [body for body in system.bodies if not body.is_massless]
    grounds = {
        c.on.under(""): Ground(c.on, c.body)
        for c in reversed(system.contacts)
        if c.on.carrier is None
    }
    found: list[Pair] = [pair for pair in combinations(massive, 2) if not links.joined(*pair)]
    found += [
        (body, ground)
        for ground in reversed(grounds.values())
        for body in massive
        if not links.touches(body, ground.surface)
    ]
    watched = tuple(pair for pair in found if all(map(_has_shape, pair)))
    others = tuple(pair for pair in found if pair not in watched and not links.connected(*pair))
    return Pairs(watched, others)


class _Links:
    """What holds the bodies of a system together."""

    def __init__(self, system: System) -> None:
        self._system = system

    @cached_property
    def _joints(self) -> list[set[Body]]:
        loose = (Contact, Rope, Constraint)  # bodies that these act on may meet all the same
        joints = [set(e.bodies) for e in self._system.elements if not isinstance(e, loose)]
        return [bodies for bodies in joints if len(bodies) > 1]

    @cached_property
    def _joined(self) -> set[tuple[Body, Body]]:
        """Pairs that a joint links, or between which a potential acts, in both orders."""
        laws = (load for load in self._system.loads if isinstance(load, CentralForce | Potential))
        touching = (set(contact.bodies) for contact in self._system.contacts)
        groups = [*self._joints, *(set(law.bodies) for law in laws), *touching]
        return {pair for bodies in groups for pair in permutations(bodies, 2)}

    @cached_property
    def _parts(self) -> list[set[Body]]:
        """Bodies that joints connect, if over others."""
        parts: list[set[Body]] = []
        for bodies in self._joints:
            apart = [part for part in parts if part.isdisjoint(bodies)]
            met = [part for part in parts if not part.isdisjoint(bodies)]
            parts = [*apart, bodies.union(*met)]
        return parts

    @cached_property
    def _held(self) -> set[Body]:
        """Bodies that a joint holds to the ground."""
        elements = self._system.elements
        return {e.bodies[0] for e in elements if len(e.bodies) == 1 and not isinstance(e, Contact)}

    def joined(self, one: Body, other: Body) -> bool:
        """Whether a joint links two bodies, or a potential acts between them."""
        return (one, other) in self._joined

    def touches(self, body: Body, surface: Support) -> bool:
        """Whether a contact of a body with a support is declared."""
        own = (c for c in self._system.contacts if c.body == body)
        return any(c.on.under("") == surface.under("") for c in own)

    def connected(self, one: Body, other: Body | Ground) -> bool:
        """Whether joints connect two bodies, or a body to one on the support or to the ground."""
        part = next((p for p in self._parts if one in p), {one})
        if isinstance(other, Body):
            return other in part
        return bool(part & self._held) or any(self.touches(b, other.surface) for b in part)


def _has_shape(part: Body | Ground) -> bool:
    """Whether it is a particle, a ball or a plane."""
    if isinstance(part, Ground):
        return isinstance(part.surface, Plane)
    if isinstance(part.surface, Round):
        return True
    return part.surface is None and part.inertia.is_zero


def _ball(body: Body, place: Vector) -> tuple[Vector, Expr]:
    """Centre and radius of a particle or ball whose centre of mass is at a place."""
    surface = body.surface
    if not isinstance(surface, Round):
        return place, ZERO
    return place + body.axes[surface.axis] * surface.offset, surface.radius


def gaps_of(equations: Any) -> Iterator[Expr]:
    """Distances that stay positive until a watched pair meets, m, as expressions."""
    system = getattr(equations, "system", None)
    if not isinstance(system, System) or not hasattr(equations, "kinetics"):
        return
    places = equations.kinetics.places
    for one, other in pairs_of(ByIdentity(system)).watched:
        centre, radius = _ball(one, places[one])
        if isinstance(other, Ground):
            surface = other.surface
            yield (centre - surface.base).dot(surface.up) - radius
        else:
            second, far = _ball(other, places[other])
            yield (second - centre).norm() - radius - far


# -- where they meet -------------------------------------------------------------------------------

_PARTS = 8  # of a step, between which distances are looked at
_MOST = 4_000  # steps that are looked at at a time
# Of the sizes of a pair, or of its distances: less than this is rounding, not an overlap.
_ROUNDING = 1e-9
_NARROWED = 60  # times by a third, when a distance that is least between two looks is sought


@dataclass(frozen=True)
class Meeting:
    """Where a pair first meets.

    Attributes:
        pair: the two.
        time: s.
        segment: of the motion.
    """

    pair: Pair
    time: float
    segment: Segment

    @property
    def event(self) -> Event:
        """The event that marks it."""
        one, other = self.pair
        mode = self.segment.mode
        kind = f"{one.name} meets {other.name}"
        return Event(self.time, kind, mode, mode, self.segment, self.segment)


def meetings(segments: Sequence[Segment], pairs: Pairs) -> list[Meeting]:
    """Where each pair first meets, of those that are apart at the start; in order of time.

    Args:
        segments: of the motion, in doubles.
    """
    waiting = {pair: _Approach(pair) for pair in pairs.watched}
    geometries: dict[int, _Geometry] = {}
    found = []
    for segment in segments:
        if not waiting:
            break
        geometry = geometries.get(id(segment.dynamics)) or _Geometry(segment, pairs.watched)
        geometries[id(segment.dynamics)] = geometry
        for times in _looks(segment):
            values = segment.values(geometry.expressions, times)
            for pair, approach in list(waiting.items()):
                when = approach.meets(times, values, geometry, segment)
                if when is not None:
                    found.append(Meeting(pair, when, segment))
                if when is not None or approach.is_exempt:
                    del waiting[pair]
    return sorted(found, key=lambda meeting: meeting.time)


def _looks(segment: Segment) -> Iterator[Array]:
    """Times at which a segment is looked at, not too many at once; parts share their ends."""
    steps = segment.steps
    parts = np.linspace(0.0, 1.0, _PARTS, endpoint=False)
    for k in range(0, max(len(steps) - 1, 1), _MOST):
        knots = steps[k : k + _MOST + 1]
        inside = knots[:-1, None] + np.diff(knots)[:, None] * parts
        yield np.append(inside.ravel(), knots[-1])


class _Geometry:
    """Centres, radii and normals of all that is watched, in the terms of one contact mode.

    Attributes:
        expressions: all components, three of each vector along the root frame, and radii; of a
            plane its normal, and its height.
    """

    def __init__(self, segment: Segment, pairs: Sequence[Pair]) -> None:
        equations: Any = segment.dynamics.equations
        root = equations.system.root
        self.expressions: list[Expr] = []
        self._rows: dict[Body | Ground, int] = {}
        for part in dict.fromkeys(part for pair in pairs for part in pair):
            self._rows[part] = len(self.expressions)
            if isinstance(part, Ground):
                # of a plane, its height over the origin stands for the radius
                vector, radius = part.surface.up, part.surface.base.dot(part.surface.up)
            else:
                vector, radius = _ball(part, equations.kinetics.places[part])
            self.expressions += [*vector.express(root).components, radius]

    def rows(self, pair: Pair) -> list[int]:
        """Places of what belongs to a pair among the expressions."""
        return [self._rows[part] + k for part in pair for k in range(4)]


class _Approach:
    """How far a pair is apart along a motion, up to where it meets.

    Attributes:
        is_exempt: whether it overlaps at the start.
    """

    def __init__(self, pair: Pair) -> None:
        self.is_exempt = False
        self._is_with_ground = isinstance(pair[1], Ground)
        self._pair = pair
        self._has_begun = False
        self._size = 0.0

    def meets(
        self, times: Array, values: Array, geometry: _Geometry, segment: Segment
    ) -> float | None:
        """The first of some times, or a time between two, at which the pair meets.

        Args:
            values: of the expressions of the geometry.
        """
        rows = geometry.rows(self._pair)
        own = [geometry.expressions[row] for row in rows]

        def at(time: float) -> Array:
            return segment.values(own, np.array([time]))

        here = values[rows]
        reach = float(here[3, 0] + (0.0 if self._is_with_ground else here[7, 0]))
        self._size = max(self._size, float(np.max(np.abs(here), initial=0.0)))
        least = _ROUNDING * (reach or self._size)
        gaps, are_points = self._gaps(here), not reach and not self._is_with_ground
        if not self._has_begun:
            self._has_begun = True
            self.is_exempt = bool(gaps[0] <= least if are_points else gaps[0] < -least)
        if self.is_exempt:
            return None
        if are_points:
            return _first_passage(times, self._between(here), lambda t: self._between(at(t)), least)
        return _first_overlap(times, gaps, lambda t: float(self._gaps(at(t))[0]), least)

    @staticmethod
    def _between(values: Array) -> Array:
        """From the centre of one to that of the other, shape (3, times)."""
        found: Array = values[4:7] - values[:3]
        return found

    def _gaps(self, values: Array) -> Array:
        """Distances of the surfaces, negative where they overlap, shape (times,)."""
        if self._is_with_ground:
            heights = np.sum(values[:3] * values[4:7], axis=0)
            return np.asarray(heights - values[3] - values[7])
        return np.asarray(np.linalg.norm(self._between(values), axis=0) - values[3] - values[7])


def _first_passage(
    times: Array, vectors: Array, vector: Callable[[float], Array], least: float
) -> float | None:
    """Where two particles pass through each other: their distance vector turns round."""
    turned = np.sum(vectors[:, :-1] * vectors[:, 1:], axis=0) <= 0
    for k in np.flatnonzero(turned):
        before = vectors[:, k]

        def along(time: float, before: Array = before) -> float:
            return float(before @ vector(time)[:, 0])

        when = bisected(along, float(times[k]), float(times[k + 1]))
        if float(np.linalg.norm(vector(when))) <= least:
            return when
    return None


def _first_overlap(
    times: Array, gaps: Array, gap: Callable[[float], float], least: float
) -> float | None:
    """Where a gap first falls below zero."""
    for k in _suspects(gaps, least):
        end = float(times[k + 1])
        if gaps[k + 1] >= -least:  # apart at both ends: the least distance in between
            end = _lowest(gap, float(times[k]), end)
        if gap(end) < -least:
            return bisected(gap, float(times[k]), end) if gaps[k] > least else float(times[k])
    return None


def _suspects(gaps: Array, least: float) -> Iterator[int]:
    """Intervals at whose end, or within which, there may be an overlap.

    Within one, a smooth gap dips by less than it changes from it to the intervals beside it.
    """
    changes = np.abs(np.diff(gaps))
    beside = changes.copy()
    beside[1:] = np.maximum(beside[1:], changes[:-1])
    beside[:-1] = np.maximum(beside[:-1], changes[1:])
    for k in np.flatnonzero(np.minimum(gaps[:-1], gaps[1:]) - beside < -least):
        before = gaps[k - 1] if k else np.inf
        after = gaps[k + 2] if k + 2 < len(gaps) else np.inf
        is_around_least = before >= gaps[k] and after >= gaps[k + 1]
        if gaps[k + 1] < -least or is_around_least:
            yield int(k)


def _lowest(function: Callable[[float], float], left: float, right: float) -> float:
    """Where a function is least between two places."""
    for _ in range(_NARROWED):
        third = (right - left) / 3
        if function(left + third) < function(right - third):
            right -= third
        else:
            left += third
    return (left + right) / 2


# -- what a trajectory says of them ----------------------------------------------------------------

_FEW = 6  # pairs that are listed one by one


def unwatched(pairs: Pairs) -> dict[str, float]:
    """What is assumed of the pairs that are not watched: that they do not overlap."""
    names = [f"overlap of {one.name} and {other.name}" for one, other in pairs.unwatched]
    if len(names) > _FEW:
        bodies = dict.fromkeys(part.name for pair in pairs.unwatched for part in pair)
        names = [f"overlaps of {', '.join(bodies)}"]
    return dict.fromkeys(names, 0.0)


def doubt_of(found: Sequence[Meeting]) -> str:
    """Why a motion in which some pairs meet is doubtful; empty if none does."""
    if not found:
        return ""
    first, *others = found
    one, other = first.pair
    more = f" (and {len(others)} more)" if others else ""
    return (
        f"{one.name} meets {other.name} at t = {first.time:.6g} s, and no contact between them is "
        f"declared: from then on they pass through each other{more}"
    )
