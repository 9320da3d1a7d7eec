"""The state that all contact modes share, and the kinematics of every contact in it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from polhode.algebra import Expr, linear_parts
from polhode.derive import Automaton, Mode, velocities_of_support
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._number_types import DOUBLES, NumberType

#: A compiled function of a state, a time, and the values of extra symbols.
Function = Callable[[Array, float, Sequence[float]], Array]


@dataclass(frozen=True)
class State:
    """A state that all modes share: in terms of the mode in which nothing touches.

    Attributes:
        coordinates: of that mode.
        speeds: of that mode.
        work: done so far by everything that is not in the potential, J.
    """

    time: float
    coordinates: Array
    speeds: Array
    work: float = 0.0

    def rounded(self) -> State:
        """This state in doubles."""
        double = DOUBLES.array
        return State(
            float(self.time), double(self.coordinates), double(self.speeds), float(self.work)
        )

    def with_impulse(self, change: Array, work: Any) -> State:
        """After an impulse has changed the speeds and done work."""
        return replace(self, speeds=self.speeds + change, work=self.work + work)


# A distance from an edge is a difference of positions: this many units in their last place are
# rounding and count as zero.
_ROUNDING = 16


class Touching:
    """The kinematics of all contacts as functions of the shared state."""

    def __init__(
        self,
        modes: Automaton,
        compiled: Callable[[Sequence[Expr]], Function],
        numbers: NumberType,
    ) -> None:
        self._compiled = compiled
        self._numbers = numbers
        self._edges = any(touch.reserve for touch in modes.separated.touches)
        self._here = self._seen(modes.separated)
        self._there = self._seen(modes.beyond) if self._edges else self._here
        self._shape = (len(modes.contacts), 3, len(modes.separated.equations.speeds))

    def _seen(self, mode: Mode) -> Function:
        return self._compiled(kinematic_expressions(mode))

    def at(self, shared: State, beyond: frozenset[int]) -> list[ContactKinematics]:
        """The kinematics of every contact, of which some are beyond the edge of their support."""
        here = self._points(self._here, shared)
        if not beyond:
            return here
        there = self._points(self._there, shared)
        return [there[i] if i in beyond else point for i, point in enumerate(here)]

    def scale(self, shared: State, beyond: frozenset[int]) -> Any:
        """Largest of the terms that cancel in slip velocities, m/s: it sets their rounding."""
        return max((point.scale for point in self.at(shared, beyond)), default=0.0)

    def beyond(self, shared: State) -> frozenset[int]:
        """The contacts that are beyond the edge of their support, or are about to be."""
        if not self._edges:
            return frozenset()
        found = enumerate(self._points(self._here, shared))
        return frozenset(
            i
            for i, point in found
            if point.is_beyond(_ROUNDING * self._numbers.spacing(point.extent))
        )

    def _points(self, function: Function, shared: State) -> list[ContactKinematics]:
        state = np.concatenate([shared.coordinates, shared.speeds])
        found = function(state, shared.time, ())
        count = self._shape[0]
        gaps, reserves, drifts = found[: 3 * count].reshape(3, count)
        supports, positions, rests = found[3 * count : 12 * count].reshape(3, count, 3)
        jacobian = found[12 * count :].reshape(self._shape)
        return [
            ContactKinematics(
                gap,
                reserve,
                drift,
                rest + arm @ shared.speeds,
                arm,
                support,
                # the velocity's sum with every term positive: the size of what cancels in it
                np.max(np.abs(rest) + np.abs(arm) @ np.abs(shared.speeds), initial=0.0),
                max(*np.abs(position), abs(position[2] - gap)),
            )
            for gap, reserve, drift, support, position, rest, arm in zip(
                gaps, reserves, drifts, supports, positions, rests, jacobian, strict=True
            )
        ]


def kinematic_expressions(mode: Mode) -> list[Expr]:
    """What the kinematics of the contacts follow from, in a mode in which nothing touches.

    For every contact its gap, its distance to the edge and the rate of that, the velocity of the
    support and the place of the centre of mass along the support's axes; then of the velocity
    J u + rest against the support, along the same, the rests and the rows of J.
    """
    motion = mode.equations.kinetics
    positions = list[Expr]()  # of the centres of mass
    for touch in mode.touches:
        centre, surface = motion.places[touch.contact.body], touch.contact.on
        labels = (*surface.tangents, surface.normal)
        positions += [centre.dot(surface.axes[label]) for label in labels]
    velocities = [v for t in mode.touches for v in (*t.slip, t.closing)]
    # Velocities are linear in the speeds, v = J u + rest: J is also what maps impulses at the
    # contacts to changes of momentum.
    parts = [linear_parts(motion.on_speeds(v), mode.equations.speeds) for v in velocities]
    return [
        *(t.gap for t in mode.touches),
        *(t.reserve for t in mode.touches),
        *(t.reserve.chain(motion.rate) for t in mode.touches),
        *(v for t in mode.touches for v in velocities_of_support(motion, t.contact)),
        *positions,
        *(rest for _, rest in parts),
        *(c for row, _ in parts for c in row),
    ]


@dataclass(frozen=True)
class ContactKinematics:
    """The kinematics of one contact at an instant.

    Attributes:
        gap: m.
        reserve: how far it is on this side of the support's edge, m.
        drift: rate of that, m/s.
        velocity: of the body's point against the support: along it twice, and away from it, m/s.
        jacobian: of that velocity by the shared speeds, shape (3, speeds).
        support: velocity of the support there, in inertial space, m/s.
        scale: size of the terms that the velocity is the sum of, m/s.
        extent: size of the terms that the gap and the reserve are differences of, m.
    """

    gap: float
    reserve: float
    drift: float
    velocity: Array
    jacobian: Array
    support: Array
    scale: float
    extent: float

    def is_beyond(self, rounding: float) -> bool:
        """Whether it is beyond the edge; at the edge itself, whether it is not moving back.

        Args:
            rounding: distance from the edge that counts as zero, m.
        """
        if abs(self.reserve) <= rounding:
            return bool(self.drift <= 0)
        return bool(self.reserve < 0)

    def edge_distance(self, *, is_beyond: bool) -> Any:
        """Distance to the edge, on the side whose surface it touches, m."""
        return max(-self.reserve if is_beyond else self.reserve, 0.0)

    def leaving(self, *, is_beyond: bool) -> Any:
        """Speed away from the edge, m/s."""
        return -self.drift if is_beyond else self.drift


# -- the first instants of a contact that has opened -----------------------------------------------

#: Normal velocity that counts as zero, relative to the terms that cancel in it: some 50 roundings.
NO_NORMAL_SPEED = 1e-14


@dataclass(frozen=True)
class LiftOff:
    """A contact that opens.

    Attributes:
        speed: of opening, at first, m/s.
        still: speed that counts as zero, m/s.
    """

    speed: float
    still: float

    def mean(self, heights: Array, passed: Array) -> Array:
        """The mean speed of opening, height over time, which is zero where the height is.

        The height itself is zero at first, where its root would be found again. Where a contact
        opens without speed, the mean is zero at first too, and is raised by the rounding.

        Args:
            passed: time since the contact opened, s; zero where heights are only rounding.
        """
        now = passed == 0
        mean = np.where(now, self.speed, heights / np.where(now, 1.0, passed))
        return np.asarray(mean + self.still if abs(self.speed) <= self.still else mean)


def fall_of(height: Any, rise: Any, fall: Any) -> Any:
    """Time until height + rise·t + fall·t²/2 is zero again; `fall` is negative."""
    return (rise + max(rise * rise - 2 * height * fall, 0) ** 0.5) / -fall
