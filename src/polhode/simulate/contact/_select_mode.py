"""Which contact mode a motion goes on in."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import permutations, product
from typing import Any

import numpy as np

from polhode.base import NumericError
from polhode.model import FLIGHT, FRICTIONLESS, ROLLING, SLIDING, Contact, Coulomb, Phase, Rolling
from polhode.simulate.contact._contact_kinematics import ContactKinematics, State
from polhode.simulate.contact._hybrid_system import CompiledMode, HybridSystem
from polhode.simulate.contact._mode_state import ModeState, directions_of, entered
from polhode.simulate.integrate._arrays import Array

STILL = 1e-12  # slip, relative to the velocities it is the difference of, that is none
_TOLERANCE = 1e-11  # relative, of forces at a limit
_ANGLES = 72


@dataclass(frozen=True)
class ContactStatus:
    """What an event has told about the contacts, by their places in the declaration.

    Attributes:
        apart: do not touch.
        stuck: have no slip.
        slipping: have reached the limit of static friction.
        beyond: are beyond the edge of their support; None where that is to be looked up.
    """

    apart: frozenset[int] = frozenset()
    stuck: frozenset[int] = frozenset()
    slipping: frozenset[int] = frozenset()
    beyond: frozenset[int] | None = None


def select_mode(machine: HybridSystem, place: State, known: ContactStatus) -> ModeState:
    """The mode whose forces are those its contacts can exert.

    Raises:
        NumericError: where none or several are possible.
    """
    beyond = machine.touching.beyond(place) if known.beyond is None else known.beyond
    meetings = machine.touching.at(place, beyond)
    failures = list[str]()
    for phases in _candidates(machine, meetings, replace(known, beyond=beyond)):
        still = [_is_still(machine, i, meeting, known) for i, meeting in enumerate(meetings)]
        starting = frozenset(i for i, phase in enumerate(phases) if phase.slides and still[i])
        entry = entered(machine, place, phases, meetings, starting)
        _refuse_shared(machine.rough, entry.rounded())
        for i in sorted(starting):
            entry.onset[i] = onset_angle(machine, entry, i)
        failure = _objection(machine, entry, known)
        if failure is None:
            return entry
        failures.append(failure)
    raise NumericError(
        f"no contact mode is possible at t = {float(place.time):.9g} s: {'; '.join(failures)}",
        expected="friction and normal forces that some mode can supply",
        advice="lower the friction coefficient, or end the motion before that time",
    )


def _candidates(
    machine: HybridSystem, meetings: Sequence[ContactKinematics], known: ContactStatus
) -> Iterator[tuple[Phase, ...]]:
    """Phases of all contacts, those that stick first."""
    options = [
        list(_options(machine, contact, i, meeting, known))
        for i, (contact, meeting) in enumerate(
            zip(machine.automaton.contacts, meetings, strict=True)
        )
    ]
    yield from product(*options)


def _options(
    machine: HybridSystem,
    contact: Contact,
    i: int,
    meeting: ContactKinematics,
    known: ContactStatus,
) -> Iterator[Phase]:
    if i not in known.apart:
        for phase in _touching(machine, contact, i, meeting, known):
            yield phase.beyond() if i in (known.beyond or ()) else phase
    yield FLIGHT


def _touching(
    machine: HybridSystem,
    contact: Contact,
    i: int,
    meeting: ContactKinematics,
    known: ContactStatus,
) -> Iterator[Phase]:
    if isinstance(contact, Coulomb):
        if _is_still(machine, i, meeting, known) and i not in known.slipping:
            yield ROLLING
        yield SLIDING
    elif isinstance(contact, Rolling):
        yield ROLLING
    else:
        yield FRICTIONLESS


def _is_still(
    machine: HybridSystem, i: int, meeting: ContactKinematics, known: ContactStatus
) -> bool:
    if i in known.stuck or i in known.slipping:
        return True
    slip = machine.numbers.size(meeting.velocity[:2])
    return bool(slip <= machine.numbers.finer(STILL) * meeting.scale)


def _refuse_shared(machine: HybridSystem, entry: ModeState) -> None:
    """Refuse slips that begin at once where each has its say in the direction of the other.

    Raises:
        NumericError: with the contacts.
    """
    mode, angles = machine.mode(entry.phases), np.linspace(0.0, 2 * np.pi, 8)
    for i, j in permutations(entry.onset, 2):
        rates = rates_along(mode, entry, j, i, angles)
        if np.max(np.ptp(rates, axis=1)) > STILL * np.max(np.abs(rates)):
            names = ", ".join(machine.automaton.contacts[k].name for k in entry.onset)
            raise NumericError(
                f"slipping begins at several contacts at once at t = {entry.place.time:.9g} s: "
                f"{names}",
                expected="contacts that do not feel each other: else no direction is determined",
            )


def _objection(machine: HybridSystem, entry: ModeState, known: ContactStatus) -> str | None:
    """Why the forces in a mode are impossible; None if they are not."""
    mode, numbers = machine.mode(entry.phases), machine.numbers
    if entry.slips:
        refuse_jamming(machine.rough, entry.rounded())
    directions = directions_of(entry, numbers)
    forces = mode.contact_forces(entry.state, entry.place.time, directions)
    tolerance = numbers.finer(_TOLERANCE)
    scale = np.max(np.abs(forces), initial=0.0)
    for contact, phase, force in zip(machine.automaton.contacts, entry.phases, forces, strict=True):
        if phase.flies:
            continue
        if force[2] < -tolerance * scale:
            return f"{mode.mode.name} would need {contact.name} to pull"
        if phase.rolls and isinstance(contact, Coulomb):
            static = machine.value(contact.mu_static)
            if numbers.size(force[:2]) > static * force[2] * (1 + tolerance):
                return f"{mode.mode.name} would need more friction than {contact.name} has"
    return None


def refuse_jamming(machine: HybridSystem, entry: ModeState) -> None:
    """Refuse Painlevé's configurations: a rising normal force that pushes the bodies together.

    Raises:
        NumericError: where normal forces and accelerations of sliding are not determined.
    """
    mode = machine.mode(entry.phases)
    if mode.jamming(entry.state, entry.place.time, directions_of(entry)) <= 0:
        names = ", ".join(element.name for element in mode.sliding)
        raise painleve(names, entry.place.time)


def painleve(names: str, time: float) -> NumericError:
    """Friction so strong that sliding has no unique forces."""
    return NumericError(
        f"sliding at {names} jams at t = {float(time):.9g} s (Painlevé's paradox)",
        expected="friction low enough for the normal force to be determined",
        advice="lower the friction coefficient: rigid bodies have no unique motion here",
    )


def onset_angle(machine: HybridSystem, entry: ModeState, i: int) -> Any:
    """The direction (angle, rad) in which a contact that begins to slip slips.

    The slip velocity must grow along itself while friction opposes it.

    Raises:
        NumericError: where no direction, or several, will do.
    """
    near = _rough_angle(machine.rough, entry.rounded(), i)
    mode, numbers = machine.mode(entry.phases), machine.numbers

    def across(angle: Any) -> Any:
        trial = replace(entry, onset={**entry.onset, i: angle})
        directions = directions_of(trial, numbers)
        x, y = mode.slip_rates(entry.state, entry.place.time, directions)[i]
        cos, sin = numbers.direction(angle)
        return y * cos - x * sin

    return numbers.zero(across, near)


def _rough_angle(machine: HybridSystem, entry: ModeState, i: int) -> float:
    """The same in doubles."""
    mode = machine.mode(entry.phases)

    def rate(angle: float) -> Array:
        trial = replace(entry, onset={**entry.onset, i: angle})
        return np.asarray(mode.slip_rates(entry.state, entry.place.time, directions_of(trial))[i])

    def across(angle: float) -> float:
        x, y = rate(angle)
        return float(y * np.cos(angle) - x * np.sin(angle))

    def along(angle: float) -> float:
        x, y = rate(angle)
        return float(x * np.cos(angle) + y * np.sin(angle))

    from scipy.optimize import brentq  # slow to import, and needed only where slip begins

    grid = np.linspace(-np.pi, np.pi, _ANGLES + 1) + 0.0123
    rates = rates_along(mode, entry, i, i, grid)
    values = rates[1] * np.cos(grid) - rates[0] * np.sin(grid)
    found = [
        float(brentq(across, a, b, xtol=1e-15, rtol=1e-15))
        for a, b, u, v in zip(grid[:-1], grid[1:], values[:-1], values[1:], strict=True)
        if u * v < 0 or u == 0
    ]
    size = float(np.max(np.hypot(*rates)))
    growing = [angle for angle in found if along(angle) > -1e-9 * size]
    if len(growing) == 1:
        return growing[0]
    name = machine.automaton.contacts[i].name
    which = "several directions" if growing else "no direction"
    raise NumericError(
        f"at t = {entry.place.time:.9g} s slip can begin at {name} in {which}",
        expected="one direction in which slip grows against the friction it brings",
        advice="the rigid body with this friction has no unique motion from here",
    )


def rates_along(mode: CompiledMode, entry: ModeState, i: int, seen: int, angles: Array) -> Array:
    """Rates of a slip velocity if slip begins in some directions, m/s², shape (2, angles).

    Args:
        i: the contact at which it begins.
        seen: the one whose slip is looked at.
    """
    given: list[Any] = list(directions_of(replace(entry, onset={**entry.onset, i: 0.0})))
    place = 3 * sorted(entry.slips).index(i)
    given[place : place + 3] = [np.cos(angles), np.sin(angles), np.zeros_like(angles)]
    return np.asarray(mode.slip_rates_along(entry.state, entry.place.time, given)[seen])
