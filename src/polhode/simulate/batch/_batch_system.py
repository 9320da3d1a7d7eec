"""What is followed many times over: a system with its contact modes, or equations of one mode."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Protocol

from polhode.algebra import Symbol
from polhode.derive import Automaton
from polhode.model import Contact, Coulomb
from polhode.simulate._dynamics import Dynamics, EquationsOfMotion
from polhode.simulate._names import Name
from polhode.simulate._readable import readable
from polhode.simulate._task import AS_DECLARED, Task
from polhode.simulate._values import idle_parameters, read_parameters
from polhode.simulate.batch._batch_results import BatchResults
from polhode.simulate.batch._batch_scheduler import BatchScheduler
from polhode.simulate.batch._batch_segment import BatchSegment, Quantity
from polhode.simulate.batch._endings import endings_of, sides_of, vanishings_of
from polhode.simulate.batch._forcing_intervals import ForcingIntervals
from polhode.simulate.batch._mode_batch import ModeBatch, Phases, Starts
from polhode.simulate.batch._single_trajectory import SingleTrajectoryStepper
from polhode.simulate.contact._checks import check_numbers
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.forcing._prescribed_motion import prescribed_motion
from polhode.simulate.integrate._stepping import Integrator


@dataclass(frozen=True)
class Plan:
    """What is common to all motions.

    Attributes:
        parameters: of one of them: names and values as `simulate` takes them.
        start: likewise.
        duration: s.
        forcing: prescribed motions.
        tolerance: relative, of one step.
        near_flat: as in `simulate`.
        until: events that end a motion.
        quantities: that are to be read.
    """

    parameters: Mapping[Name, Any]
    start: Mapping[Name, Any]
    duration: float
    forcing: Mapping[Name, Any]
    tolerance: float | None
    near_flat: float
    until: Collection[str]
    quantities: Collection[Quantity]

    def task(self, integrator: Integrator) -> Task:
        """The same for one motion."""
        return Task(
            given=self.parameters,
            start=self.start,
            forcing=self.forcing,
            end=self.duration,
            integrator=integrator,
            tolerance=self.tolerance,
            near_flat=self.near_flat,
            seconds={},
            until=frozenset(self.until),
        )


class BatchSystem(Protocol):
    """What is followed many times over."""

    @property
    def stretches(self) -> ForcingIntervals:
        """Of its prescribed motions."""
        ...

    @property
    def phases(self) -> Phases:
        """Of the contacts in the mode that motions are expected to start in."""
        ...

    @property
    def dynamics(self) -> Dynamics:
        """The equations of that mode."""
        ...

    @property
    def contacts(self) -> tuple[Contact, ...]:
        """Whose coefficients count."""
        ...

    @property
    def numbers(self) -> Mapping[Symbol, float]:
        """All parameters of one motion."""
        ...

    def stay(self, phases: Phases) -> BatchSegment:
        """What motions do in a mode."""
        ...

    def company(self, sightings: BatchResults, starts: Starts) -> ModeBatch:
        """What follows them."""
        ...


@dataclass(frozen=True)
class OneMode:
    """Equations that are kept to."""

    dynamics: Dynamics
    numbers: Mapping[Symbol, float]
    plan: Plan
    stretches: ForcingIntervals
    phases: Phases = ()
    contacts: tuple[Contact, ...] = ()

    def stay(self, phases: Phases) -> BatchSegment:
        return self._stay

    @cached_property
    def _stay(self) -> BatchSegment:
        plan, sides = self.plan, self.dynamics.equations.assumed_positive
        return BatchSegment(
            self.dynamics,
            AS_DECLARED,
            (*sides_of(sides), *vanishings_of(self.dynamics, AS_DECLARED)),
            plan.quantities,
            (),
            plan.tolerance,
            self.stretches,
        )

    def company(self, sightings: BatchResults, starts: Starts) -> ModeBatch:
        return ModeBatch(self.stay, sightings)


@dataclass(frozen=True)
class AllModes:
    """A system that goes from contact mode to contact mode."""

    machine: HybridSystem
    plan: Plan
    numbers: Mapping[Symbol, float]
    stretches: ForcingIntervals
    _known: dict[Phases, BatchSegment] = field(default_factory=dict)

    @property
    def phases(self) -> Phases:
        return self.machine.automaton.together.phases

    @property
    def dynamics(self) -> Dynamics:
        return self.machine.mode(self.phases).dynamics

    @property
    def contacts(self) -> tuple[Contact, ...]:
        return self.machine.automaton.contacts

    @cached_property
    def goes_on(self) -> bool:
        """Whether motions are followed beyond their first mode.

        Where nothing rubs or jerks they hardly ever leave it, and need not be known in full.
        """
        if len(self.stretches.jerks):
            return True
        rubs = any(isinstance(contact, Coulomb) for contact in self.contacts)
        endings = endings_of(self.machine.mode(self.phases), 0.0, self.plan.until)
        return rubs and not all(ending.kind for ending in endings)

    def stay(self, phases: Phases) -> BatchSegment:
        if phases not in self._known:
            self._known[phases] = self._made(phases)
        return self._known[phases]

    def _made(self, phases: Phases) -> BatchSegment:
        mode, plan = self.machine.mode(phases), self.plan
        return BatchSegment(
            mode.dynamics,
            mode.mode.name,
            endings_of(mode, plan.near_flat, plan.until),
            plan.quantities,
            readable(self.dynamics, {}),
            plan.tolerance,
            self.stretches,
            whole=self.goes_on,
            square=mode.mode.equations.mass if mode.can_jam else None,
        )

    def company(self, sightings: BatchResults, starts: Starts) -> ModeBatch:
        if not self.goes_on:
            return ModeBatch(self.stay, sightings)
        pilot = SingleTrajectoryStepper(
            self.machine, self.plan.task(self.machine.integrator), self.stretches
        )
        return BatchScheduler(self.stay, sightings, pilot, starts)


def one_mode(equations: EquationsOfMotion, plan: Plan) -> OneMode | None:
    """Equations that are kept to; None where their supports jerk on the way, or loops close."""
    drive = prescribed_motion(equations.functions, plan.forcing, plan.duration)
    stretches = ForcingIntervals(drive, plan.duration)
    if len(stretches.jerks) or equations.closures:
        return None
    dynamics = Dynamics(equations, drive.expressions, idle_parameters(equations, plan.parameters))
    numbers = read_parameters(dynamics, plan.parameters, drive.constants(0.0))
    return OneMode(dynamics, numbers, plan, stretches)


def all_modes(modes: Automaton, plan: Plan, integrator: Integrator) -> AllModes:
    """A system with its modes."""
    drive = prescribed_motion(modes.functions, plan.forcing, plan.duration)
    equations = modes.together.equations
    idle = idle_parameters(equations, plan.parameters)
    common = Dynamics(equations, drive.expressions, (*modes.parameters, *idle))
    numbers = read_parameters(common, plan.parameters, drive.constants(0.0))
    machine = HybridSystem(modes, drive, numbers, integrator, plan.tolerance)
    check_numbers(machine)
    return AllModes(machine, plan, numbers, ForcingIntervals(drive, plan.duration))
