"""Where bodies and supports meet, in numbers."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from polhode.algebra import Expr, linear_parts
from polhode.derive import Automaton, Mode, Touch
from polhode.simulate.contact._place import Function, Place
from polhode.simulate.integrate._stepping import Array


class Touching:
    """Where bodies and supports meet, from the shared state."""

    def __init__(self, modes: Automaton, compiled: Callable[[Sequence[Expr]], Function]) -> None:
        self._compiled = compiled
        self._edges = any(touch.reserve for touch in modes.apart.touches)
        self._here = self._seen(modes.apart)
        self._there = self._seen(modes.beyond) if self._edges else self._here
        self._shape = (len(modes.contacts), 3, len(modes.apart.equations.speeds))

    def _seen(self, mode: Mode) -> Function:
        speeds = mode.equations.speeds
        motion = mode.equations.kinetics
        velocities = [v for t in mode.touches for v in (*t.slip, t.closing)]
        parts = [linear_parts(motion.on_speeds(v), speeds) for v in velocities]
        return self._compiled(
            [
                *(t.gap for t in mode.touches),
                *(t.reserve for t in mode.touches),
                *(v for t in mode.touches for v in _support_velocity(mode, t)),
                *(rest for _, rest in parts),
                *(c for row, _ in parts for c in row),
            ]
        )

    def at(self, place: Place, beyond: frozenset[int]) -> list[Meeting]:
        """Every contact, at one instant; some of them beyond the edge of their support."""
        here = self._meetings(self._here, place)
        if not beyond:
            return here
        there = self._meetings(self._there, place)
        return [there[i] if i in beyond else meeting for i, meeting in enumerate(here)]

    def beyond(self, place: Place) -> frozenset[int]:
        """The contacts that are beyond the edge of their support."""
        if not self._edges:
            return frozenset()
        found = enumerate(self._meetings(self._here, place))
        return frozenset(i for i, meeting in found if meeting.reserve < 0)

    def _meetings(self, function: Function, place: Place) -> list[Meeting]:
        state = np.concatenate([place.coordinates, place.speeds])
        found = function(state, place.time, ())
        count = self._shape[0]
        gaps, reserves = found[:count], found[count : 2 * count]
        supports, rests = found[2 * count : 8 * count].reshape(2, count, 3)
        arms = found[8 * count :].reshape(self._shape)
        return [
            Meeting(
                gap,
                reserve,
                rest + arm @ place.speeds,
                arm,
                support,
                np.max(np.abs(rest) + np.abs(arm) @ np.abs(place.speeds), initial=0.0),
            )
            for gap, reserve, support, rest, arm in zip(
                gaps, reserves, supports, rests, arms, strict=True
            )
        ]


@dataclass(frozen=True)
class Meeting:
    """A contact at one instant.

    Attributes:
        gap: m.
        reserve: how far it is on this side of the support's edge, m.
        velocity: of the body's point against the support: along it twice, and away from it, m/s.
        arms: the same per unit of every shared speed, shape (3, speeds).
        support: velocity of the support there, in inertial space, m/s.
        scale: size of what the velocity is the sum of, m/s.
    """

    gap: float
    reserve: float
    velocity: Array
    arms: Array
    support: Array
    scale: float


def _support_velocity(mode: Mode, touch: Touch) -> tuple[Expr, ...]:
    motion = mode.equations.kinetics
    contact = touch.contact
    place = motion.places[contact.body] + contact.arm
    velocity = motion.resolve(contact.on.velocity(place).express(contact.on.axes))
    labels = (*contact.on.tangents, contact.on.normal)
    return tuple(velocity.dot(contact.on.axes[label]) for label in labels)
