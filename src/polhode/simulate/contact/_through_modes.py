"""Integrates a motion through all its contact modes: checks, the first mode, and the whole run."""

from __future__ import annotations

from dataclasses import replace

from polhode.base import ConstraintError, DeclarationError, Progress
from polhode.derive import Automaton
from polhode.model import (
    FLIGHT,
    FRICTIONLESS,
    Apart,
    Contact,
    ContactLaw,
    Coulomb,
    DryFriction,
    Phase,
    Rolling,
)
from polhode.simulate._dynamics import Dynamics
from polhode.simulate._names import published
from polhode.simulate._start import check_start, unchecked_start
from polhode.simulate._task import Guarded, InitialState, MotionResult, Task, timed
from polhode.simulate._values import idle_parameters, read_parameters
from polhode.simulate.contact._attitude_charts import in_regular_angles, is_regular_in_other_angles
from polhode.simulate.contact._contact_kinematics import NO_NORMAL_SPEED, State
from polhode.simulate.contact._description_changes import choose_at_start
from polhode.simulate.contact._hybrid_integrator import HybridIntegrator
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._mode_pieces import double_pieces
from polhode.simulate.contact._mode_state import ModeState
from polhode.simulate.contact._select_mode import ContactStatus, select_mode
from polhode.simulate.forcing._prescribed_motion import prescribed_motion

# Coefficients of friction other than zero: beyond these limits friction is lost in the rounding of
# the other forces, or the other forces in that of friction.
_LEAST, _MOST = 1e-9, 1e9


def can_be_followed(modes: Automaton) -> bool:
    """Whether changes of contact are followed; otherwise all contacts stay as declared.

    They stay where no contact has friction and Newton's laws do not determine all contact forces,
    unless a law of impacts says that they are to be followed.
    """
    rubs = any(isinstance(contact, DryFriction) for contact in modes.contacts)
    return rubs or bool(modes.system.impacts) or not modes.together.undetermined


def check_numbers(hybrid: HybridSystem) -> None:
    """Refuse coefficients that no contact can have.

    Raises:
        DeclarationError: with the contact and the value.
    """
    for contact in hybrid.automaton.contacts:
        given = [hybrid.value(contact.restitution)] if isinstance(contact, Contact) else []
        if isinstance(contact, Rolling) and contact.tangential is not None:
            given.append(hybrid.value(contact.tangential))
        for value in given:
            if not 0 <= value <= 1:
                raise _impossible("restitution", value, contact, "a number from 0 to 1")
        if isinstance(contact, DryFriction):
            kinetic, static = (hybrid.value(mu) for mu in (contact.mu, contact.mu_static))
            if kinetic < 0:
                raise _impossible("friction coefficient mu", kinetic, contact, "zero or more")
            for what, value in (("mu", kinetic), ("mu_static", static)):
                if value and not _LEAST <= value <= _MOST:
                    expected = f"zero, or a number from {_LEAST:g} to {_MOST:g}"
                    raise _impossible(f"friction coefficient {what}", value, contact, expected)
            if static < kinetic:
                expected = f"no less than mu = {kinetic:g}"
                raise _impossible("friction coefficient mu_static", static, contact, expected)


def _impossible(what: str, value: float, contact: ContactLaw, expected: str) -> DeclarationError:
    return DeclarationError(f"{what} = {value:g} of contact {contact.name!r}", expected=expected)


# -- the first contact mode ------------------------------------------------------------------------

# A height this small counts as zero, of the distance from the origin of the support.
_ROUNDING = 1e-12


def initial_mode(hybrid: HybridSystem, shared: State, separated: frozenset[int]) -> ModeState:
    """The first mode of a motion.

    Args:
        separated: contacts that start at a given height. Zero height with zero vertical velocity
            counts as contact.

    Raises:
        ConstraintError: for a body that starts within its support.
        NumericError: where no mode is possible.
    """
    shared = in_regular_angles(hybrid, shared)
    points = hybrid.touching.at(shared, hybrid.touching.beyond(shared))
    rounding = [_ROUNDING * float(point.extent) for point in points]
    for i in separated:
        if points[i].gap < -rounding[i]:
            contact = hybrid.automaton.contacts[i]
            height = contact.on.normal + contact.body.tag
            raise ConstraintError(
                f"{contact.body.name} starts {-points[i].gap:g} m below its support",
                expected=f"a height {height} at which it touches or is above",
                advice=f"leave out {height} to start in contact",
            )
    met = {i for i in separated if points[i].gap <= rounding[i]}
    resting = {i for i in met if abs(points[i].velocity[2]) <= NO_NORMAL_SPEED * points[i].scale}
    entry = select_mode(hybrid, shared, ContactStatus(separated - resting))
    return replace(entry, gaps={i: 0.0 for i in met if entry.phases[i].flies})


# -- the whole motion ------------------------------------------------------------------------------


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
        self._hybrid: HybridSystem | None = None

    def follow(self, task: Task, progress: Progress) -> MotionResult:
        numbers = read_parameters(self._dynamics, task.given, self._drive.constants(0.0))
        hybrid = self._hybrid or HybridSystem(
            self._modes, self._drive, numbers, task.integrator, task.tolerance
        )
        self._hybrid = hybrid  # what it has compiled serves further runs
        hybrid.set_constants(numbers)
        check_numbers(hybrid)
        with timed(task, "compile"):
            pieces = double_pieces(hybrid, task.near_flat, progress)
            integrator = HybridIntegrator(hybrid, pieces, task.until)
            shared, initial, separated = _begin(hybrid, task)
            assumed = {**initial.start.assumed, **_assumed_to_roll(hybrid, shared, task)}
            first = initial_mode(hybrid, shared, separated)
            speeds = hybrid.speeds_in(())
            hybrid.mode(first.phases).stepper  # noqa: B018
        with timed(task, "integrate"):
            solution = integrator.integrate(first, task.end)
        hybrid.in_angles(())
        hybrid.on_speeds(speeds)
        return MotionResult(
            solution.segments,
            solution.changes,
            solution.ending,
            {symbol.published: value for symbol, value in numbers.items()},
            assumed,
            unguarded=False,
            initial=initial,
            drive=self._drive,
            guarded=Guarded(hybrid, separated, solution.speed_changes),
        )


def first_entry(hybrid: HybridSystem, task: Task) -> tuple[ModeState, InitialState]:
    """The first mode of a motion, and the start as it was read."""
    shared, initial, separated = _begin(hybrid, task)
    return initial_mode(hybrid, shared, separated), initial


def _begin(hybrid: HybridSystem, task: Task) -> tuple[State, InitialState, frozenset[int]]:
    """The shared state at the start, the start as read, and the contacts that are open there.

    Contacts touch unless a height is given. They stick, if they can, unless the given speeds
    contradict that; then the start is read again with slip allowed.
    """
    given = {published(name) for name in task.start}
    modes = hybrid.automaton
    separated = frozenset(
        i
        for i, option in enumerate(modes.options)
        if isinstance(above := option[FLIGHT], Apart)
        and given & {above.height.published, above.rise.published}
    )
    if separated:
        return (*_read_on_surfaces(hybrid, separated, task, slips=True), separated)
    try:
        return (*_read_on_surfaces(hybrid, separated, task, slips=False), separated)
    except ConstraintError:
        if not any(isinstance(contact, Coulomb) for contact in modes.contacts):
            raise
        return (*_read_on_surfaces(hybrid, separated, task, slips=True), separated)


def _assumed_to_roll(hybrid: HybridSystem, shared: State, task: Task) -> dict[str, float]:
    """The speeds that were not given, of a start that moves because a contact is taken to stick.

    Without that they would be zero. A contact that is declared to roll is no assumption.
    """
    modes, separated = hybrid.automaton, hybrid.separated
    if not any(isinstance(contact, Coulomb) for contact in modes.contacts):
        return {}
    plain = separated.dynamics.without_auxiliary
    numbers = dict(zip(plain.parameters, separated.parameters.tolist(), strict=True))
    free = unchecked_start(plain, task.start, numbers).assumed
    rises = {
        above.rise.published
        for option in modes.options
        if isinstance(above := option[FLIGHT], Apart)
    }
    names = (symbol.published for symbol in separated.mode.equations.speeds)
    values = {n: float(v) + 0.0 for n, v in zip(names, shared.speeds, strict=True)}  # no −0
    left = {name: values[name] for name in values if name in free and name not in rises}
    return left if any(left.values()) else {}


def _read_on_surfaces(
    hybrid: HybridSystem, separated: frozenset[int], task: Task, *, slips: bool
) -> tuple[State, InitialState]:
    """The start as read on the supports; or, for contacts beyond an edge, on what lies there."""
    phases = list[Phase]()
    for i, option in enumerate(hybrid.automaton.options):
        # A slip can be read without friction: start values do not depend on forces.
        free = slips or hybrid.automaton.contacts[i].is_beside
        closed = FRICTIONLESS if free and FRICTIONLESS in option else next(iter(option))
        phases.append(FLIGHT if i in separated else closed)
    shared, initial = _read(hybrid, tuple(phases), task)
    beyond = hybrid.touching.beyond(shared) - separated
    if not beyond:
        return shared, initial
    there = (p.beyond() if i in beyond else p for i, p in enumerate(phases))
    return _read(hybrid, tuple(there), task)


def _read(
    hybrid: HybridSystem, phases: tuple[Phase, ...], task: Task
) -> tuple[State, InitialState]:
    choose_at_start(hybrid, phases, task.start)
    mode = hybrid.mode(phases)
    plain = mode.dynamics.without_auxiliary
    numbers = dict(zip(plain.parameters, mode.parameters.tolist(), strict=True))
    start = unchecked_start(plain, task.start, numbers)
    state = dict(zip(plain.states, (float(x) for x in start.state), strict=True))
    if not is_regular_in_other_angles(hybrid, phases, state):
        check_start(plain, start, numbers)
    return mode.embedding(0.0, state, 0.0), InitialState(plain, start)
