"""Follows a motion through all contact modes, as the forces demand."""

from __future__ import annotations

from collections.abc import Mapping

from polhode.algebra import Symbol
from polhode.base import ConstraintError, Progress
from polhode.derive import Automaton
from polhode.model import FLIGHT, FRICTIONLESS, Apart, Coulomb, Phase
from polhode.simulate._dynamics import Dynamics
from polhode.simulate._names import published
from polhode.simulate._start import read_start
from polhode.simulate._task import Guarded, InitialState, MotionResult, Task, timed
from polhode.simulate._values import idle_parameters, read_parameters
from polhode.simulate.contact._checks import check_numbers
from polhode.simulate.contact._hybrid_integrator import HybridIntegrator
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._initial_mode import begun_at
from polhode.simulate.contact._mode_state import ModeState
from polhode.simulate.contact._state import State
from polhode.simulate.forcing._prescribed_motion import prescribed_motion


class ThroughModes:
    """Through all contact modes, as the forces demand."""

    def __init__(self, modes: Automaton, task: Task) -> None:
        with timed(task, "derive"):
            self._drive = prescribed_motion(modes.functions, task.forcing, task.end)
            idle = idle_parameters(modes.together.equations, task.given)
            constants = (*modes.parameters, *idle)
            equations = modes.together.equations
            self._dynamics = Dynamics(equations, self._drive.expressions, constants)
        self._modes = modes
        self._machine: HybridSystem | None = None

    def follow(self, task: Task, progress: Progress) -> MotionResult:
        numbers = read_parameters(self._dynamics, task.given, self._drive.constants(0.0))
        machine = self._with(numbers, task)
        check_numbers(machine)
        with timed(task, "compile"):
            walk = HybridIntegrator(machine, task.near_flat, progress, task.until)
            place, begun, apart = _begin(machine, task)
            first = begun_at(machine, place, apart)
            machine.mode(first.phases).stepper  # noqa: B018
        with timed(task, "integrate"):
            course = walk.along(first, task.end)
        return MotionResult(
            course.segments,
            course.changes,
            course.ending,
            {symbol.published: value for symbol, value in numbers.items()},
            begun.start.assumed,
            unguarded=False,
            begun=begun,
            drive=self._drive,
            guarded=Guarded(machine, apart),
        )

    def _with(self, numbers: Mapping[Symbol, float], task: Task) -> HybridSystem:
        """The machine with these numbers; what it has compiled stays."""
        if self._machine is None:
            self._machine = HybridSystem(
                self._modes, self._drive, numbers, task.integrator, task.tolerance
            )
        self._machine.take(numbers)
        return self._machine


def first_entry(machine: HybridSystem, task: Task) -> tuple[ModeState, InitialState]:
    """The first mode of a motion, and the start as it was read."""
    place, begun, apart = _begin(machine, task)
    return begun_at(machine, place, apart), begun


def _begin(machine: HybridSystem, task: Task) -> tuple[State, InitialState, frozenset[int]]:
    """Where it starts, and which contacts are apart there.

    Contacts touch unless a height is given, and stick where they can unless that contradicts what
    is given: to their supports, or to what is beyond the edges of those.
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
        return (*_read_on_surfaces(machine, apart, task, slips=True), apart)
    try:
        return (*_read_on_surfaces(machine, apart, task, slips=False), apart)
    except ConstraintError:
        if not any(isinstance(contact, Coulomb) for contact in modes.contacts):
            raise
        return (*_read_on_surfaces(machine, apart, task, slips=True), apart)


def _read_on_surfaces(
    machine: HybridSystem, apart: frozenset[int], task: Task, *, slips: bool
) -> tuple[State, InitialState]:
    """The start as it is read on the supports, or where they end on what is beyond their edges."""
    phases = _phases(machine.automaton, apart, slips=slips)
    place, begun = _read(machine, phases, task)
    beyond = machine.touching.beyond(place) - apart
    if not beyond:
        return place, begun
    there = (p.beyond() if i in beyond else p for i, p in enumerate(phases))
    return _read(machine, tuple(there), task)


def _phases(modes: Automaton, apart: frozenset[int], *, slips: bool) -> tuple[Phase, ...]:
    """Phases in which the start values are read: friction does not matter to them."""
    found = []
    for i, option in enumerate(modes.options):
        free = FRICTIONLESS if slips and FRICTIONLESS in option else next(iter(option))
        found.append(FLIGHT if i in apart else free)
    return tuple(found)


def _read(
    machine: HybridSystem, phases: tuple[Phase, ...], task: Task
) -> tuple[State, InitialState]:
    mode = machine.mode(phases)
    plain = mode.dynamics.without_carried
    numbers = dict(zip(plain.parameters, mode.parameters.tolist(), strict=True))
    start = read_start(plain, task.start, numbers)
    state = dict(zip(plain.states, (float(x) for x in start.state), strict=True))
    return mode.lifted(0.0, state, 0.0), InitialState(plain, start)
