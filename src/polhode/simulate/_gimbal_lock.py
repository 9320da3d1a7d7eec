"""How close a motion comes to attitudes at which its angles are singular."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import sin
from typing import Any

import numpy as np

from polhode.algebra import Expr, Symbol, variables
from polhode.base import ByIdentity
from polhode.derive import Attitude, Equations, attitudes
from polhode.simulate._segment import Segment
from polhode.simulate._three_angles import ThreeAngles
from polhode.simulate._values import evaluate
from polhode.simulate.integrate._arrays import Array

# Share of the velocity of an axis across the direction of the pole below which it goes straight
# through it: the angles are then regular, and the second one changes its sign.
_STRAIGHT = 1e-13
#: Sine of the second angle that is rounding: the other two are then one.
AT_POLE = 1e-15
#: Sine of the second angle below which a motion goes over to turned angles, and above which it
#: returns. Between them it keeps those it has.
NEAR, FAR = 0.02, 0.1
#: The same below which a motion in the declared angles is doubtful: rounding grows by its square.
DOUBTFUL = 3e-4


@dataclass(frozen=True)
class NumericAttitude:
    """An attitude with its axes as numbers."""

    declared: Attitude
    geometry: ThreeAngles

    @property
    def angles(self) -> tuple[Symbol, ...]:
        """The declared angles."""
        return self.declared.angles

    @property
    def turned(self) -> tuple[Symbol, ...]:
        """The angles counted from turned axes."""
        return self.declared.turned_angles


@lru_cache(maxsize=64)
def attitudes_of(key: ByIdentity[Any]) -> tuple[NumericAttitude, ...]:
    """The attitudes of equations of motion that can be described otherwise near gimbal lock.

    Where the motion itself is singular there, as that of a disk that lies flat, there are none.
    """
    equations = key.subject
    if not isinstance(equations, Equations):
        return ()
    singular = variables(equations.assumed_positive)
    return tuple(
        NumericAttitude(attitude, _geometry(attitude))
        for attitude in attitudes(equations.system)
        if attitude.angles[1] not in singular
    )


def _geometry(attitude: Attitude) -> ThreeAngles:
    first, second, last = (np.array([evaluate(c, {}) for c in axis]) for axis in attitude.axes)
    return ThreeAngles(first, second, last)


def passes_straight(
    attitude: NumericAttitude,
    state: Mapping[Symbol, Any],
    values: Callable[[Sequence[Expr]], Array],
) -> bool:
    """Whether an axis goes straight to the pole or away from it, or rests beside it.

    Args:
        attitude: its three rotations.
        state: that it is in.
        values: of expressions there.
    """
    sine = sin(state[attitude.angles[1]] - attitude.geometry.offset)
    if abs(sine) <= AT_POLE:
        return False
    first, second, _ = (Expr.generator(q.derivative()) for q in attitude.angles)
    turning, nodding = values([first, second])
    across = turning * sine
    return bool(abs(across) <= _STRAIGHT * abs(nodding))


@dataclass(frozen=True)
class ClosestApproach:
    """Where a motion in its declared angles is closest to gimbal lock.

    Attributes:
        distance: rad.
        time: s.
        angle: name of the angle that is singular there.
    """

    distance: float
    time: float
    angle: str


def closest_to_gimbal_lock(segments: Iterable[Segment]) -> ClosestApproach | None:
    """The closest approach while the declared angles were integrated; None without any."""
    found: ClosestApproach | None = None
    for segment in segments:
        known = attitudes_of(ByIdentity(segment.dynamics.equations))
        for part in segment.parts if known else ():
            if part.is_in_other_angles:
                continue
            steps = part.solution.steps
            times = steps[steps <= part.end]
            states = dict(zip(part.solution.symbols, part.states(times), strict=True))
            for attitude in known:
                angles = np.array(states[attitude.angles[1]], dtype=float)
                sines = np.abs(np.sin(angles - attitude.geometry.offset))
                k = int(np.argmin(sines))
                if found is not None and sines[k] >= found.distance:
                    continue
                now, here = times[k : k + 1], {q: row[k] for q, row in states.items()}

                def values(
                    wanted: Sequence[Expr], now: Array = now, segment: Segment = segment
                ) -> Array:
                    return np.array(segment.values(wanted, now)[:, 0], dtype=float)

                if not passes_straight(attitude, here, values):
                    name = attitude.angles[1].published
                    found = ClosestApproach(float(sines[k]), float(times[k]), name)
    return found
