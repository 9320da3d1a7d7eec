"""Goes through attitudes at which angles are singular, in angles counted from turned axes.

Near gimbal lock a motion is integrated with the equations of the same system in other angles
(`derive.with_turned_angles`), and read in those of the declaration (`OtherAngles`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from functools import cached_property, partial
from typing import cast

from polhode.algebra import Symbol
from polhode.base import ByIdentity, PolhodeError
from polhode.derive import derive_in_parts, with_turned_angles
from polhode.model import System
from polhode.simulate._absolute_values import Instant
from polhode.simulate._dynamics import Dynamics
from polhode.simulate._gimbal_lock import NumericAttitude, attitudes_of, passes_straight
from polhode.simulate._other_angles import OtherAngles, States
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._stepping import IntegratedEquations, Integrator


class TurnedEquations(IntegratedEquations):
    """The equations of a system with some of its angles counted from turned axes.

    Args:
        dynamics: in the declared angles.
        chosen: the attitudes whose angles are counted otherwise.
        integrator: of the motion.
        tolerance: of its steps.
    """

    def __init__(
        self,
        dynamics: Dynamics,
        chosen: Iterable[NumericAttitude],
        integrator: Integrator,
        tolerance: float | None,
    ) -> None:
        attitudes = tuple(chosen)
        system = cast(System, dynamics.equations.system)
        turned = with_turned_angles(system, (a.declared for a in attitudes))
        equations = derive_in_parts(turned)
        super().__init__(replace(dynamics, equations=equations), integrator, tolerance)
        self.angles = OtherAngles(dynamics, self.dynamics, attitudes)

    def overshoot(self) -> Callable[[float, Sequence[float]], bool]:
        """Whether the declared angles are regular again, or these no longer, at a step's end."""
        core = self.flow.core.symbols
        seen = [(a, [core.index(q) for q in a.turned[:2] if q in core]) for a in self.angles.chosen]
        seen = [(a, places) for a, places in seen if len(places) == 2]

        def over(time: float, state: Sequence[float]) -> bool:
            sines = [(a, *a.geometry.sines(state[i], state[j])) for a, (i, j) in seen]
            left = bool(sines) and all(declared > a.far for a, declared, _ in sines)
            return left or any(own < a.near for a, _, own in sines)

        return over


# -- when to go over ------------------------------------------------------------------------------


class AttitudeChoices:
    """The equations of one system in all choices of angles that a motion needs.

    Args:
        dynamics: in the declared angles.
        integrator: of the motion.
        tolerance: of its steps.
    """

    def __init__(self, dynamics: Dynamics, integrator: Integrator, tolerance: float | None) -> None:
        self._dynamics = dynamics
        self._integrator = integrator
        self._tolerance = tolerance
        self._known: dict[tuple[int, ...], TurnedEquations | None] = {}

    @cached_property
    def attitudes(self) -> tuple[NumericAttitude, ...]:
        """Those that can be described otherwise."""
        if self._dynamics.undecided:
            return ()
        found = attitudes_of(ByIdentity(self._dynamics.equations))
        return tuple(attitude for attitude in found if attitude.can_be_turned)

    def needed(self, state: States, here: Instant, *, is_turned: bool) -> tuple[int, ...]:
        """The attitudes that are near a pole, and do not pass straight through it."""
        near = [
            i
            for i, a in enumerate(self.attitudes)
            if a.geometry.is_near_pole(state[a.angles[1]], a.far if is_turned else a.near)
        ]
        rates = partial(here.values, self._dynamics)
        return tuple(
            i
            for i in near
            if is_turned or not passes_straight(self.attitudes[i], here.state, rates)
        )

    def equations(
        self, needed: tuple[int, ...], state: States, numbers: Callable[[Dynamics], Array]
    ) -> TurnedEquations | None:
        """The equations in which these attitudes are regular; None if there are none."""
        if not needed:
            return None
        if needed not in self._known:
            self._known[needed] = self._derived(needed)
        found = self._known[needed]
        return found if found is not None and found.angles.is_same_motion(state, numbers) else None

    def _derived(self, needed: tuple[int, ...]) -> TurnedEquations | None:
        try:
            chosen = [self.attitudes[i] for i in needed]
            return TurnedEquations(self._dynamics, chosen, self._integrator, self._tolerance)
        except PolhodeError:  # what was declared along the axes between needs them as they are
            return None

    def overshoot(
        self, core: Sequence[Symbol], near: Iterable[int]
    ) -> Callable[[float, Sequence[float]], bool] | None:
        """Whether an attitude has come near a pole at the end of a step, in the declared angles.

        Args:
            core: the states that are integrated.
            near: attitudes that are near one already.
        """
        others = [a for i, a in enumerate(self.attitudes) if i not in set(near)]
        places = [(core.index(a.angles[1]), a) for a in others if a.angles[1] in core]
        if not places:
            return None
        return lambda time, state: any(a.geometry.is_near_pole(state[i], a.near) for i, a in places)

    def near(self, state: States) -> tuple[int, ...]:
        """The attitudes that are near a pole."""
        return tuple(
            i
            for i, a in enumerate(self.attitudes)
            if a.geometry.is_near_pole(state[a.angles[1]], a.near)
        )
