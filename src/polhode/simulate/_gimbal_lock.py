"""How close a motion comes to attitudes at which its angles are singular."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import ceil, inf, log10, sin
from typing import Any

import numpy as np

from polhode.algebra import Expr, Symbol, variables
from polhode.base import ByIdentity, NumericError
from polhode.derive import AngleTriple, Equations, attitudes, singular_attitudes
from polhode.simulate._segment import Segment
from polhode.simulate._three_angles import AT_POLE, ThreeAngles
from polhode.simulate._values import evaluate
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._stepping import broken

# Share of the velocity of an axis across the direction of the pole below which it goes straight
# through it: the angles are then regular, and the second one changes its sign.
_STRAIGHT = 1e-13
# Sine of the second angle below which a motion goes over to turned angles, and above which it
# returns; by the power with which digits are lost. Between them it keeps those it has.
_NEAR = {1: 0.02, 3: 0.1}
_FAR = {1: 0.1, 3: 0.4}
_LOST = 1e7  # roundings: by the highest powers, a motion that might lose more is doubtful
# Power with which rounding grows over a whole passage. Where one step costs the third power, the
# others are further off and few are so near: balls and tops with distances of 1e-5 to 1e-2 rad lose
# between 0.6 times and a hundredth of this.
_OVER_A_PASSAGE = {1: 1.0, 3: 1.75}


@dataclass(frozen=True)
class NumericAttitude:
    """An attitude with its axes as numbers.

    Attributes:
        declared: the attitude.
        geometry: its axes.
        power: of the inverse distance from gimbal lock by which rounding is amplified there: one in
            the angles alone; three where their rates are speeds, whose accelerations then are
            differences of terms that grow with its square.
        can_be_turned: whether there are equations in which it is regular.
    """

    declared: AngleTriple
    geometry: ThreeAngles
    power: int
    can_be_turned: bool

    @property
    def doubtful(self) -> float:
        """The sine of the second angle below which a motion in the declared angles is doubtful."""
        return float(_LOST ** (-1 / self.power))

    @property
    def near(self) -> float:
        """The sine of the second angle below which a motion goes over to turned angles."""
        return _NEAR[self.power]

    @property
    def far(self) -> float:
        """The sine of the second angle above which a motion returns to the declared angles."""
        return _FAR[self.power]

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
    """The attitudes of equations of motion that are singular in gimbal lock.

    Where the motion itself is singular there, as that of a disk that lies flat, there are none.
    """
    equations = key.subject
    if not isinstance(equations, Equations):
        return ()
    lost = variables(equations.assumed_positive)
    turned = {attitude.last for attitude in attitudes(equations.system)}
    return tuple(
        NumericAttitude(
            attitude, _geometry(attitude), _power(attitude, equations), attitude.last in turned
        )
        for attitude in singular_attitudes(equations.system)
        if attitude.angles[1] not in lost
    )


def _power(attitude: AngleTriple, equations: Equations) -> int:
    own = {*equations.speeds, *equations.dependent}
    angles = set(attitude.angles)
    chosen = (s for _, meaning in equations.system.speeds for s in meaning.symbols())
    is_rate = attitude.angles[2].derivative() in own
    return 3 if is_rate or any(s.order and s.base() in angles for s in chosen) else 1


def _geometry(attitude: AngleTriple) -> ThreeAngles:
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


def broken_at(equations: Any, state: Mapping[Symbol, Any], time: float) -> NumericError:
    """The error where a motion cannot be continued, which names gimbal lock if that is why."""
    for attitude in attitudes_of(ByIdentity(equations)):
        angle = attitude.angles[1]
        if angle in state:
            distance = abs(sin(float(state[angle]) - attitude.geometry.offset))
            if distance < attitude.near:
                return NumericError(
                    f"the motion cannot be continued beyond t = {time:.9g} s, where "
                    f"{angle.published} is {distance:.1e} rad from gimbal lock",
                    expected="attitudes at which the angles are regular",
                    advice="declare the body with spin=ph.Components(), which costs fewer digits, "
                    "or describe its attitude by other angles",
                )
    if chosen := equations.system.speeds if isinstance(equations, Equations) else ():
        names = ", ".join(speed.published for speed, _ in chosen)
        return NumericError(
            f"the motion cannot be continued beyond t = {time:.9g} s",
            expected=f"finite accelerations, and chosen speeds, {names}, that determine all rates",
            advice=f"if {names} cannot determine the velocities there, choose others in "
            "speeds={...}, or leave them out",
        )
    return broken(time)


@dataclass(frozen=True)
class ClosestApproach:
    """Where a motion in its declared angles is closest to gimbal lock.

    Attributes:
        distance: rad.
        time: s.
        attitude: which.
    """

    distance: float
    time: float
    attitude: NumericAttitude

    @property
    def loss(self) -> float:
        """The factor by which rounding is amplified."""
        power = _OVER_A_PASSAGE[self.attitude.power]
        return float(self.distance**-power) if self.distance else inf

    @property
    def doubt(self) -> str:
        """What is lost there; empty if little."""
        if self.distance >= self.attitude.doubtful:
            return ""
        digits = f"up to {ceil(log10(self.loss))}" if self.loss < inf else "all"
        return (
            f"{self.attitude.angles[1].published} comes within {self.distance:.1e} rad of gimbal "
            f"lock at t = {self.time:.6g} s, where {digits} digits of the angles are lost"
        )


def closest_to_gimbal_lock(segments: Iterable[Segment]) -> ClosestApproach | None:
    """Where most is lost while the declared angles are integrated; None if there are no angles."""
    found: ClosestApproach | None = None
    for segment in segments:
        known = attitudes_of(ByIdentity(segment.dynamics.equations))
        for part in segment.parts if known else ():
            steps = part.solution.steps
            times = steps[steps <= part.end]
            states = dict(zip(part.solution.symbols, part.states(times), strict=True))
            for attitude in known:
                if attitude.angles[1] in part.angles_replaced:
                    continue
                angles = np.array(states[attitude.angles[1]], dtype=float)
                sines = np.abs(np.sin(angles - attitude.geometry.offset))
                k = int(np.argmin(sines))
                nearest = ClosestApproach(float(sines[k]), float(times[k]), attitude)
                if found is not None and nearest.loss <= found.loss:
                    continue
                now, here = times[k : k + 1], {q: row[k] for q, row in states.items()}

                def values(
                    wanted: Sequence[Expr], now: Array = now, segment: Segment = segment
                ) -> Array:
                    return np.array(segment.values(wanted, now)[:, 0], dtype=float)

                if not passes_straight(attitude, here, values):
                    found = nearest
    return found
