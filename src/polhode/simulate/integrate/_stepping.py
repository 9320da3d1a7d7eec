"""Interfaces of integrators: steps over a span of time, and the solution they give."""

from __future__ import annotations

from functools import cached_property
from typing import Protocol

from polhode.base import NumericError
from polhode.simulate._dynamics import Dynamics
from polhode.simulate.integrate._arrays import Array as Array
from polhode.simulate.integrate._flow import Flow, flow_of

#: Fewest steps over a span if forces depend on time explicitly. Step control sees the forcing only
#: through its derivatives at the beginning of a step: in a long step a pulse would be missed.
FEWEST_STEPS = 64
_SHORTEST = 1e-13  # of the time: no limit on steps needs to be shorter than its rounding
# Degree of a polynomial of time that the series of one step (of order 20 or so) represents: up to
# this degree nothing is missed, whatever the step.
_FORESEEN = 12


def fewest_steps(flow: Flow) -> int:
    """Fewest steps over a span of a motion that is driven by the time itself."""
    return fewest_for(flow.degree)


def fewest_for(degree: float) -> int:
    """The same from the degree to which time occurs explicitly."""
    return int(min(FEWEST_STEPS, 1 + degree / _FORESEEN))


def longest_step(begin: float, end: float, fewest: int) -> float:
    """The longest step, s, that divides a span into so many; not below the rounding of the time."""
    return max((end - begin) / fewest, _SHORTEST * max(abs(begin), abs(end)))


class StepCallback(Protocol):
    """Called after every step."""

    def __call__(self, time: float, state: list[float]) -> bool:
        """Whether to go on."""


class Leg(Protocol):
    """A solution over a span of time, known at every instant of it."""

    @property
    def broken(self) -> bool:
        """Whether it cannot be continued: an acceleration is not finite."""

    @property
    def times(self) -> Array:
        """Where its steps begin and end, s."""

    def at(self, times: Array) -> Array:
        """States, shape (states, times)."""


class Stepper(Protocol):
    """A compiled flow, ready to be integrated from any state with any parameters."""

    def leg(
        self, parameters: Array, begin: float, state: Array, end: float, watch: StepCallback
    ) -> Leg:
        """Integrate the core to `end`, until `watch` returns false, or as far as it goes.

        Raises:
            NumericError: where the motion cannot even begin.
        """


class Integrator(Protocol):
    """A way of integrating flows.

    Attributes:
        name: of the library or method.
    """

    name: str

    def prepare(self, flow: Flow, tolerance: float | None) -> Stepper:
        """Compile a flow; the tolerance is relative, None the best that the method holds."""


class IntegratedEquations:
    """Equations as they are integrated, compiled when they are first needed.

    Args:
        dynamics: the equations.
        integrator: of the motion.
        tolerance: of its steps.
    """

    def __init__(self, dynamics: Dynamics, integrator: Integrator, tolerance: float | None) -> None:
        self.dynamics = dynamics
        self._integrator = integrator
        self._tolerance = tolerance

    @cached_property
    def flow(self) -> Flow:
        """What is integrated."""
        return flow_of(self.dynamics, reduced=True)

    @cached_property
    def stepper(self) -> Stepper:
        """The compiled flow."""
        return self._integrator.prepare(self.flow, self._tolerance)


def broken(time: float) -> NumericError:
    """The error where the motion cannot be continued."""
    return NumericError(
        f"the motion cannot be continued beyond t = {time:.9g} s",
        expected="finite accelerations",
        advice="it reaches a singular position there: end it before, or start elsewhere",
    )
