"""Follows a motion: within one contact mode as declared, or through all of them."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any, Protocol

import numpy as np

from polhode.algebra import Symbol
from polhode.base import ConstraintError, DeclarationError, Progress
from polhode.derive import Automaton, Mode, automaton
from polhode.model import FLIGHT, FRICTIONLESS, Apart, Coulomb, Phase, System
from polhode.simulate._dynamics import WORK, Dynamics, EquationsOfMotion
from polhode.simulate._memory import Same
from polhode.simulate._names import Name, published
from polhode.simulate._segment import Part, Segment, state_at
from polhode.simulate._start import Start, read_start
from polhode.simulate._values import idle_parameters, read_parameters
from polhode.simulate.contact._begin import begun_at
from polhode.simulate.contact._checks import can_be_followed, check_numbers
from polhode.simulate.contact._course import Change, Walk
from polhode.simulate.contact._machine import Machine
from polhode.simulate.contact._place import Place
from polhode.simulate.contact._settle import Entry
from polhode.simulate.forcing._drive import Drive, drive_of
from polhode.simulate.integrate._driver import Stop, integrate, stuck
from polhode.simulate.integrate._flow import Flow, flow_of
from polhode.simulate.integrate._integrators import Integrator, Stepper

AS_DECLARED = "as declared"


@dataclass(frozen=True)
class Task:
    """What is asked for: numbers, a start, and how to go on from it."""

    given: Mapping[Name, Any]
    start: Mapping[Name, Any]
    forcing: Mapping[Name, Any]
    end: float
    integrator: Integrator
    tolerance: float | None
    near_flat: float
    seconds: dict[str, float]
    until: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Begun:
    """The start as it was read, and the equations in which it was."""

    dynamics: Dynamics
    start: Start


@dataclass(frozen=True)
class Motion:
    """What came of it.

    Attributes:
        unguarded: whether the contacts were taken as declared, and not looked after.
        begun: how the start was read.
        mode: the contact mode it begins in, where contacts are looked after.
    """

    segments: tuple[Segment, ...]
    changes: tuple[Change, ...]
    ending: str
    parameters: Mapping[str, float]
    assumed: Mapping[str, float]
    unguarded: bool
    begun: Begun
    mode: Mode | None = None


class Prepared(Protocol):
    """A system with its equations compiled, ready for any numbers and any start."""

    def follow(self, task: Task, progress: Progress) -> Motion:
        """The motion from its start to its end.

        Args:
            task: what is asked for; only values and start may differ from what was prepared for.
        """
        ...


def prepared(subject: System | Automaton | EquationsOfMotion, task: Task) -> Prepared:
    """All that does not depend on the numbers, done once for every motion of a kind."""
    if isinstance(subject, System):
        subject = _modes(Same(subject))
    if isinstance(subject, Automaton):
        if subject.contacts and can_be_followed(subject):
            return _ThroughModes(subject, task)
        with _timed(task, "derive"):
            return _AsDeclared(subject.together.equations, task)
    return _AsDeclared(subject, task)


@lru_cache(maxsize=8)
def _modes(declared: Same[System]) -> Automaton:
    """The modes of a system, derived once however often it is simulated."""
    return automaton(declared.thing)


# -- one mode -----------------------------------------------------------------------------------


class _AsDeclared:
    """The contacts as they are declared, and kept to."""

    def __init__(self, equations: EquationsOfMotion, task: Task) -> None:
        with _timed(task, "derive"):
            self._drive = drive_of(equations.functions, task.forcing, task.end)
            idle = idle_parameters(equations, task.given)
            self._dynamics = Dynamics(equations, self._drive.expressions, idle)
        self._integrator = task.integrator
        self._tolerance = task.tolerance

    @cached_property
    def _flow(self) -> Flow:
        return flow_of(self._dynamics, reduced=self._integrator.dense)

    @cached_property
    def _stepper(self) -> Stepper:
        return self._integrator.prepare(self._flow, self._tolerance)

    def follow(self, task: Task, progress: Progress) -> Motion:
        dynamics, drive = self._dynamics, self._drive
        numbers = read_parameters(dynamics, task.given, drive.constants(0.0))
        _refuse_jerks(drive, task.end)
        at_start = {s: (numbers | drive.constants(0.0))[s] for s in dynamics.parameters}
        begin = read_start(dynamics, task.start, at_start)
        with _timed(task, "compile"):
            flow, stepper = self._flow, self._stepper
        state = {**dict(zip(dynamics.states, begin.state, strict=True)), WORK: 0.0}
        parts = []
        with _timed(task, "integrate"):
            for span in drive.stretches(task.end):
                known = numbers | drive.constants(span[0])
                constants = np.array([known[s] for s in dynamics.parameters])
                start = np.array([state[s] for s in flow.states], dtype=float)
                solution = integrate(flow, stepper, constants, start, span, progress)
                if solution.stop is Stop.STUCK:
                    raise stuck(solution)
                if solution.stop is Stop.INTERRUPTED:
                    parts.append(Part(span[0], float(solution.steps[-1]), solution, constants))
                    break
                parts.append(Part(*span, solution, constants))
                state = state_at(parts[-1], span[1])
        segment = Segment(AS_DECLARED, 0.0, parts[-1].end, dynamics, tuple(parts))
        return Motion(
            (segment,),
            (),
            AS_DECLARED,
            {symbol.published: value for symbol, value in numbers.items()},
            begin.assumed,
            unguarded=True,
            begun=Begun(dynamics, begin),
        )


def _refuse_jerks(drive: Drive, end: float) -> None:
    felt = [time for time in drive.jerks if 0 < time < end]
    if felt:
        raise DeclarationError(
            f"a support that jerks at t = {min(felt):g} s, under one contact mode",
            expected="the declaration itself, whose contacts can slip and stick",
            advice="simulate the System, not the equations derived from it",
        )


# -- all modes ----------------------------------------------------------------------------------


class _ThroughModes:
    """Through all contact modes, as the forces demand."""

    def __init__(self, modes: Automaton, task: Task) -> None:
        with _timed(task, "derive"):
            self._drive = drive_of(modes.functions, task.forcing, task.end)
            idle = idle_parameters(modes.together.equations, task.given)
            constants = (*modes.parameters, *idle)
            equations = modes.together.equations
            self._dynamics = Dynamics(equations, self._drive.expressions, constants)
        self._modes = modes
        self._machine: Machine | None = None

    def follow(self, task: Task, progress: Progress) -> Motion:
        numbers = read_parameters(self._dynamics, task.given, self._drive.constants(0.0))
        machine = self._with(numbers, task)
        check_numbers(machine)
        with _timed(task, "compile"):
            walk = Walk(machine, task.near_flat, progress, task.until)
            first, begun = first_entry(machine, task)
            machine.mode(first.phases).stepper  # noqa: B018
        with _timed(task, "integrate"):
            course = walk.along(first, task.end)
        return Motion(
            course.segments,
            course.changes,
            course.ending,
            {symbol.published: value for symbol, value in numbers.items()},
            begun.start.assumed,
            unguarded=False,
            begun=begun,
            mode=machine.mode(first.phases).mode,
        )

    def _with(self, numbers: Mapping[Symbol, float], task: Task) -> Machine:
        """The machine with these numbers; what it has compiled stays."""
        if self._machine is None:
            self._machine = Machine(
                self._modes, self._drive, numbers, task.integrator, task.tolerance
            )
        self._machine.take(numbers)
        return self._machine


def first_entry(machine: Machine, task: Task) -> tuple[Entry, Begun]:
    """The first mode of a motion, and the start as it was read."""
    place, begun, apart = _begin(machine, task)
    return begun_at(machine, place, apart), begun


def _begin(machine: Machine, task: Task) -> tuple[Place, Begun, frozenset[int]]:
    """Where it starts, and which contacts are apart there.

    Contacts touch unless a height is given, and stick where they can unless that contradicts what
    is given.
    """
    given = {published(name) for name in task.start}
    modes = machine.automaton
    apart = frozenset(
        i
        for i, option in enumerate(modes.options)
        if isinstance(above := option[FLIGHT], Apart)
        and given & {above.height.published, above.rise.published}
    )
    if apart:
        place, begun = _read(machine, _phases(modes, apart, slips=True), task)
        return place, begun, apart
    try:
        return (*_read(machine, _phases(modes, apart, slips=False), task), apart)
    except ConstraintError:
        if not any(isinstance(contact, Coulomb) for contact in modes.contacts):
            raise
        return (*_read(machine, _phases(modes, apart, slips=True), task), apart)


def _phases(modes: Automaton, apart: frozenset[int], *, slips: bool) -> tuple[Phase, ...]:
    """Phases in which the start values are read: friction does not matter to them."""
    found = []
    for i, option in enumerate(modes.options):
        free = FRICTIONLESS if slips and FRICTIONLESS in option else next(iter(option))
        found.append(FLIGHT if i in apart else free)
    return tuple(found)


def _read(machine: Machine, phases: tuple[Phase, ...], task: Task) -> tuple[Place, Begun]:
    mode = machine.mode(phases)
    plain = mode.dynamics.without_carried
    numbers = dict(zip(plain.parameters, mode.parameters.tolist(), strict=True))
    start = read_start(plain, task.start, numbers)
    state = dict(zip(plain.states, (float(x) for x in start.state), strict=True))
    return mode.lifted(0.0, state, 0.0), Begun(plain, start)


@contextmanager
def _timed(task: Task, what: str) -> Iterator[None]:
    began = time.perf_counter()
    yield
    task.seconds[what] = task.seconds.get(what, 0.0) + time.perf_counter() - began
