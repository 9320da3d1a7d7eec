"""A system, with all its contact modes or in one of them, for batches of motions."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from operator import attrgetter
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, Matrix, Symbol, variables
from polhode.derive import Automaton
from polhode.model import Contact, ContactLaw, DryFriction
from polhode.simulate._dynamics import Dynamics, EquationsOfMotion, readable
from polhode.simulate._names import Name, by_name, published
from polhode.simulate._task import AS_DECLARED, Task
from polhode.simulate._values import idle_parameters, read_parameters, read_values
from polhode.simulate.batch._batch_results import BatchResults
from polhode.simulate.batch._batch_scheduler import BatchScheduler, SingleTrajectoryStepper
from polhode.simulate.batch._batch_segment import (
    BatchSegment,
    Quantity,
    endings_of,
    gimbal_locks_of,
    sides_of,
    vanishings_of,
)
from polhode.simulate.batch._forcing_intervals import ForcingIntervals
from polhode.simulate.batch._mode_batch import Group, ModeBatch, Phases, Starts
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._through_modes import can_be_followed, check_numbers
from polhode.simulate.forcing._prescribed_motion import prescribed_motion
from polhode.simulate.integrate._arrays import Array, rows
from polhode.simulate.integrate._integrators import chosen, heyoka_is_used
from polhode.simulate.integrate._stepping import Integrator

# -- start values of many motions, and which of them need individual treatment ---------------------

# Relative. Flat bodies are at the limit of the triangle inequality of their principal moments,
# I₁ + I₂ = I₃, which rounding may violate.
_ROUNDING = 1e-9

Mask = NDArray[np.bool_]


def filled(
    symbols: Sequence[Symbol],
    common: Mapping[Symbol, float],
    columns: Mapping[str, Array],
    count: int,
) -> dict[Symbol, Array]:
    """Values of symbols for every motion: from its column, else the common value, else zero."""
    return {
        s: np.asarray(columns.get(s.published, np.full(count, common.get(s, 0.0))), dtype=float)
        for s in symbols
    }


@dataclass(frozen=True)
class BatchStart:
    """Many motions at time 0.

    Attributes:
        dynamics: the equations of the mode in which they start.
        states: by symbol, shape (motions,).
        constants: of all parameters, likewise.
        contacts: whose coefficients count.
    """

    dynamics: Dynamics
    states: Mapping[Symbol, Array]
    constants: Mapping[Symbol, Array]
    contacts: Sequence[ContactLaw]

    @property
    def _count(self) -> int:
        return len(next(iter((*self.states.values(), *self.constants.values()))))

    def possible(self) -> Mask:
        """The motions whose parameters are possible for bodies and contacts."""
        fine = np.ones(self._count, dtype=bool)
        for symbol, values in self.constants.items():
            fine &= np.isfinite(values) & ((values > 0) | (not symbol.positive))
        for body in getattr(self.dynamics.equations.system, "bodies", ()):
            if self._are_given([body.mass]):
                fine &= (self._values([body.mass])[0] > 0) | body.is_massless
            if self._are_given(body.inertia.entries):
                first, second, third = self._moments(body.inertia, fine).T
                fine &= (first >= 0) & (first + second >= third * (1 - _ROUNDING))
        for contact in self.contacts:
            if isinstance(contact, Contact):
                (restitution,) = self._values([contact.restitution])
                fine &= (restitution >= 0) & (restitution <= 1)
            if isinstance(contact, DryFriction):
                kinetic, static = self._values([contact.mu, contact.mu_static])
                fine &= (kinetic >= 0) & (static >= kinetic)
        return fine

    def regular(self) -> Mask:
        """The motions with finite rates and a positive definite mass matrix at the start."""
        fine = np.all(np.isfinite(self._values(self.dynamics.rates)), axis=0)
        mass = self.dynamics.equations.mass
        if mass == mass.T:
            fine &= self._moments(mass, fine)[:, 0] > 0
        return np.asarray(fine)

    def _are_given(self, expressions: Iterable[Expr]) -> bool:
        """Whether all values are known: that of a mass which does not move may be left out."""
        return variables(expressions) <= {*self.constants, *self.states}

    def _moments(self, matrix: Matrix, fine: Mask) -> Array:
        """Eigenvalues of a symmetric matrix for every motion, rising; shape (motions, size)."""
        size = len(matrix.rows)
        entries = self._values([e for row in matrix.rows for e in row])
        finite = fine & np.all(np.isfinite(entries), axis=0)
        matrices = np.where(finite, entries, np.eye(size).reshape(-1, 1)).T
        return np.asarray(np.linalg.eigvalsh(matrices.reshape(-1, size, size)))

    def _values(self, expressions: Sequence[Expr]) -> Array:
        """Values at the start, shape (expressions, motions)."""
        states = [self.states[s] for s in self.dynamics.states]
        constants = [self.constants[s] for s in self.dynamics.parameters]
        with np.errstate(all="ignore"):
            found = self.dynamics.function(expressions)(*states, *constants, 0.0)
        values: Array = rows(found, self._count)
        return values


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
        """The task of a single motion."""
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
    """A system of which many motions are integrated."""

    @property
    def intervals(self) -> ForcingIntervals:
        """Of its prescribed motions."""

    @property
    def phases(self) -> Phases:
        """Phases of the contacts in the mode that motions are expected to start in."""

    @property
    def dynamics(self) -> Dynamics:
        """The equations of that mode."""

    @property
    def contacts(self) -> tuple[ContactLaw, ...]:
        """The contacts whose coefficients are checked."""

    @property
    def numbers(self) -> Mapping[Symbol, float]:
        """All parameters of one motion."""

    def batch_segment(self, phases: Phases) -> BatchSegment:
        """A mode, for many motions."""

    def batch(self, results: BatchResults, starts: Starts) -> ModeBatch:
        """Integrates a batch of motions."""


@dataclass(frozen=True)
class OneMode:
    """Equations of one mode, whose contacts are kept as declared."""

    dynamics: Dynamics
    numbers: Mapping[Symbol, float]
    plan: Plan
    intervals: ForcingIntervals
    phases: Phases = ()
    contacts: tuple[ContactLaw, ...] = ()

    def batch_segment(self, phases: Phases) -> BatchSegment:
        return self._only_segment

    @cached_property
    def _only_segment(self) -> BatchSegment:
        plan, sides = self.plan, self.dynamics.equations.assumed_positive
        return BatchSegment(
            self.dynamics,
            AS_DECLARED,
            (
                *sides_of(sides),
                *vanishings_of(self.dynamics, AS_DECLARED),
                *gimbal_locks_of(self.dynamics, AS_DECLARED, attrgetter("near")),
            ),
            plan.quantities,
            (),
            plan.tolerance,
            self.intervals,
        )

    def batch(self, results: BatchResults, starts: Starts) -> ModeBatch:
        return ModeBatch(self.batch_segment, results)


@dataclass(frozen=True)
class AllModes:
    """A system that goes from contact mode to contact mode."""

    hybrid: HybridSystem
    plan: Plan
    numbers: Mapping[Symbol, float]
    intervals: ForcingIntervals
    _known: dict[Phases, BatchSegment] = field(default_factory=dict)

    @property
    def phases(self) -> Phases:
        return self.hybrid.automaton.together.phases

    @property
    def dynamics(self) -> Dynamics:
        return self.hybrid.mode(self.phases).dynamics

    @property
    def contacts(self) -> tuple[ContactLaw, ...]:
        return self.hybrid.automaton.contacts

    @cached_property
    def goes_on(self) -> bool:
        """Whether motions are integrated beyond their first mode.

        Without friction or jerks they hardly ever leave it: then only the states that the requested
        quantities depend on are integrated.
        """
        if len(self.intervals.jerks):
            return True
        rubs = any(isinstance(contact, DryFriction) for contact in self.contacts)
        endings = endings_of(self.hybrid.mode(self.phases), 0.0, self.plan.until)
        return rubs and not all(ending.kind for ending in endings)

    def batch_segment(self, phases: Phases) -> BatchSegment:
        if phases not in self._known:
            mode, plan = self.hybrid.mode(phases), self.plan
            self._known[phases] = BatchSegment(
                mode.dynamics,
                mode.mode.name,
                endings_of(mode, plan.near_flat, plan.until),
                plan.quantities,
                readable(self.dynamics, {}),
                plan.tolerance,
                self.intervals,
                whole=self.goes_on,
                square=mode.mode.equations.mass if mode.can_jam else None,
            )
        return self._known[phases]

    def batch(self, results: BatchResults, starts: Starts) -> ModeBatch:
        if not self.goes_on:
            return ModeBatch(self.batch_segment, results)
        stepper = SingleTrajectoryStepper(
            self.hybrid, self.plan.task(self.hybrid.integrator), self.intervals
        )
        return BatchScheduler(self.batch_segment, results, stepper, starts)


def one_mode(equations: EquationsOfMotion, plan: Plan) -> OneMode | None:
    """Equations of one mode; None if a support jerks on the way, or loops close."""
    drive = prescribed_motion(equations.functions, plan.forcing, plan.duration)
    intervals = ForcingIntervals(drive, plan.duration)
    if len(intervals.jerks) or equations.closures:
        return None
    dynamics = Dynamics(equations, drive.expressions, idle_parameters(equations, plan.parameters))
    numbers = read_parameters(dynamics, plan.parameters, drive.constants(0.0))
    return OneMode(dynamics, numbers, plan, intervals)


def all_modes(modes: Automaton, plan: Plan, integrator: Integrator) -> AllModes:
    """A system with its modes."""
    drive = prescribed_motion(modes.functions, plan.forcing, plan.duration)
    equations = modes.together.equations
    idle = idle_parameters(equations, plan.parameters)
    common = Dynamics(equations, drive.expressions, (*modes.parameters, *idle))
    numbers = read_parameters(common, plan.parameters, drive.constants(0.0))
    hybrid = HybridSystem(modes, drive, numbers, integrator, plan.tolerance)
    check_numbers(hybrid)
    return AllModes(hybrid, plan, numbers, ForcingIntervals(drive, plan.duration))


# -- the whole batch -------------------------------------------------------------------------------
#
# A motion that is doubtful in any way is left out, to be integrated individually.


@dataclass(frozen=True)
class BatchSolution:
    """The motions of a batch.

    Attributes:
        kept: which of them are complete; the others are to be integrated individually.
        seen: their states and events.
    """

    kept: NDArray[np.bool_]
    seen: BatchResults


class SingleModeBatch:
    """A batch of motions of one system.

    Args:
        subject: the system.
        start: SI start values of one motion, where all of them are states of the first mode.
    """

    def __init__(self, subject: BatchSystem, start: Mapping[Symbol, float] | None) -> None:
        self._subject = subject
        self._start = start

    @property
    def keeps_to_one_mode(self) -> bool:
        """Whether contacts are kept as declared."""
        return not self._subject.contacts

    def follow(
        self,
        count: int,
        columns: Mapping[str, Array],
        times: Array,
        starts: Starts,
    ) -> BatchSolution:
        """Integrate all motions together.

        Args:
            count: of motions.
            columns: SI values of what differs, by published name, shape (motions,).
            times: of the samples, s, increasing from 0 to the duration.
            starts: start values of one motion, as `simulate` takes them.
        """
        subject, dynamics = self._subject, self._subject.dynamics
        constants = filled(tuple(subject.numbers), subject.numbers, columns, count)
        states = filled(dynamics.states, self._start or {}, columns, count)
        at_once = subject.intervals.from_then(np.zeros(count))
        begun = BatchStart(dynamics, states, constants | at_once, subject.contacts)
        possible = begun.possible()
        usual = possible & begun.regular() & (self._start is not None)
        first = subject.batch_segment(subject.phases).mode
        results = BatchResults.of(count, times, constants, subject.intervals, first)
        batch = subject.batch(results, starts)
        rows = np.flatnonzero(usual)
        zero, own = np.zeros(len(rows)), {s: values[rows] for s, values in states.items()}
        group = Group(rows, zero, own, zero, [None] * len(rows), [0] * len(rows))
        batch.together(subject.phases, group)
        for row in np.flatnonzero(possible & ~usual).tolist():
            batch.start(row)
        batch.run()
        possible[sorted(batch.lost)] = False
        return BatchSolution(possible, batch.results)


def batch_of(subject: Automaton | EquationsOfMotion, plan: Plan) -> SingleModeBatch | None:
    """A system prepared for batches of motions; None if they cannot be integrated together.

    Raises:
        DeclarationError: for numbers that are not known, missing or impossible.
    """
    if not heyoka_is_used():
        return None
    if isinstance(subject, Automaton) and not (subject.contacts and can_be_followed(subject)):
        subject = subject.together.equations
    found: BatchSystem | None
    if isinstance(subject, Automaton):
        if subject.may_become_singular:
            return None  # motions change their independent speeds at different times
        found = all_modes(subject, plan, chosen())
    else:
        found = one_mode(subject, plan)
    if found is None or found.dynamics.undecided:
        return None  # motions change the sides of absolute values at different times
    names = by_name(found.dynamics.states)
    start: dict[Name, Any] = {published(name): value for name, value in plan.start.items()}
    if not start.keys() <= names.keys():
        return SingleModeBatch(found, None)
    dimensions = getattr(found.dynamics.equations, "dimensions", {})
    values = read_values(start, names, "state of this mode", dimensions, found.numbers)
    return SingleModeBatch(found, values)
