"""Chooses the contact mode in which a motion continues, from the forces that each would need.

Candidates are tried in order: those with more contacts closed first, and rolling before sliding,
contact by contact. A mode is possible if no contact has to pull, and static friction stays within
its limit μ_s N.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import combinations, product
from typing import Any

import numpy as np

from polhode.base import ConstraintError, NumericError
from polhode.derive import Mode
from polhode.model import (
    FLIGHT,
    FRICTIONLESS,
    HELD,
    ROLLING,
    ContactLaw,
    DryFriction,
    Phase,
    Rolling,
)
from polhode.simulate._open_reactions import null_space
from polhode.simulate.contact._at_rest import rests
from polhode.simulate.contact._contact_kinematics import (
    NO_NORMAL_SPEED,
    ContactKinematics,
    State,
)
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._mode_state import ModeState, directions_of, entered
from polhode.simulate.contact._onset_directions import NO_SLIP, begin_slips
from polhode.simulate.contact._regular_speeds import on_regular_speeds
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._number_types import DOUBLES

# A mode ends where a force reaches its limit, so there the force of the next mode is at its own
# limit too, up to the error of the time of the event: it may exceed the limit by this share.
_TOLERANCE = 1e-11
_MOVES = 1e-9  # of the largest velocity by unit speeds: what moves a contact less is rounding


@dataclass(frozen=True)
class ContactStatus:
    """What is known of the contacts at an event, by their places in the declaration.

    Attributes:
        separated: those that do not touch.
        stuck: those without slip.
        slipping: those that have reached the limit of static friction.
        beyond: those beyond the edge of their support; None to take them from the state.
    """

    separated: frozenset[int] = frozenset()
    stuck: frozenset[int] = frozenset()
    slipping: frozenset[int] = frozenset()
    beyond: frozenset[int] | None = None


def select_mode(hybrid: HybridSystem, shared: State, known: ContactStatus) -> ModeState:
    """The first mode, in the order of trial, whose contacts can exert the forces it needs.

    Raises:
        NumericError: where none or several are possible.
    """
    beyond = hybrid.touching.beyond(shared) if known.beyond is None else known.beyond
    points = hybrid.touching.at(shared, beyond)
    failures = list[str]()
    contacts = enumerate(zip(hybrid.automaton.contacts, points, strict=True))
    tried = [
        list(_phases(hybrid, contact, i, point, replace(known, beyond=beyond)))
        for i, (contact, point) in contacts
    ]
    for phases in filter(hybrid.automaton.is_possible, _in_order(tried)):
        if not _can_slip(phases, points):
            continue
        there = on_regular_speeds(hybrid, phases, shared)
        if there is not shared:
            shared, points = there, hybrid.touching.at(there, beyond)
        entry = _attempt(hybrid, shared, phases, points, known)
        if isinstance(entry, ModeState):
            return entry
        failures += [entry] if entry else []
    raise NumericError(
        f"no contact mode is possible at t = {float(shared.time):.9g} s: {'; '.join(failures)}",
        expected="friction and normal forces that some mode can supply",
        advice="lower the friction coefficient, or end the motion before that time",
    )


def _in_order(tried: list[list[Phase]]) -> Iterator[tuple[Phase, ...]]:
    """All combinations of phases: those with more contacts closed first.

    Contacts open where they would have to pull, so with more of them open a mode is looked at only
    where none with fewer is possible.
    """
    closed = [[phase for phase in phases if not phase.flies] for phases in tried]
    able = [i for i, phases in enumerate(closed) if phases]
    for count in range(len(able) + 1):
        for opened in combinations(reversed(able), count):
            yield from product(
                *([FLIGHT] if i in opened or not own else own for i, own in enumerate(closed))
            )


def _attempt(
    hybrid: HybridSystem,
    shared: State,
    phases: tuple[Phase, ...],
    points: list[ContactKinematics],
    known: ContactStatus,
) -> ModeState | str:
    """A mode, entered, if its contacts can exert the forces it needs; why not, otherwise.

    Empty where nothing drives what it says.
    """
    undetermined = _undetermined(hybrid.automaton.mode(phases), shared.time)
    still = [_is_still(hybrid, i, point, known) for i, point in enumerate(points)]
    starting = frozenset(i for i, phase in enumerate(phases) if phase.slides and still[i])
    if not all(_gives_way(hybrid, shared, phases, points, i) for i in starting - known.slipping):
        return ""
    entry = entered(hybrid, shared, phases, points, starting)
    if undetermined:
        failure = begin_slips(hybrid, entry) or _open_objection(
            hybrid.in_doubles, entry.rounded(), undetermined
        )
        return failure or _would_close(hybrid, entry, points, known) or entry
    failure = begin_slips(hybrid, entry) or _objection(hybrid, entry)
    return failure or _would_close(hybrid, entry, points, known) or entry


def _can_slip(phases: tuple[Phase, ...], points: list[ContactKinematics]) -> bool:
    """Whether all contacts that would slide can: where two corners stick, a third cannot slip."""
    sliding = [point for point, phase in zip(points, phases, strict=True) if phase.slides]
    closed = [(i, phase) for i, phase in enumerate(phases) if not phase.flies]
    if not sliding or len(closed) == 1:
        return True
    held = [points[i].jacobian if p.rolls else points[i].jacobian[2:] for i, p in closed]
    rows = DOUBLES.array(np.vstack(held))
    motions = null_space(rows)
    least = _MOVES * np.max(np.abs(rows))
    moved = (DOUBLES.array(point.jacobian[:2]) @ motions for point in sliding)
    return all(np.max(np.abs(slips), initial=0.0) > least for slips in moved)


def _open_objection(
    hybrid: HybridSystem, entry: ModeState, undetermined: tuple[ContactLaw, ...]
) -> str | None:
    """Why contacts with forces that are open cannot hold; None if they can.

    Raises:
        NumericError: where that is open, too.
    """
    mode = hybrid.mode(entry.phases)
    values = mode.balances(entry.state, entry.shared.time, directions_of(entry))
    forces = mode.open_forces
    if forces is not None and forces.are_decided(values):
        return forces.objection(values, hybrid.static_coefficients)
    held = rests(hybrid, entry)
    if held is None:
        raise _open_forces(undetermined, entry.shared.time)
    return None if held else f"{mode.mode.name} would need more friction"


def _phases(
    hybrid: HybridSystem,
    contact: ContactLaw,
    i: int,
    point: ContactKinematics,
    known: ContactStatus,
) -> Iterator[Phase]:
    """The phases of a contact, in the order in which they are tried."""
    closed = [FRICTIONLESS]
    if isinstance(contact, Rolling):
        closed = [ROLLING]
    elif isinstance(contact, DryFriction):
        sticks = _is_still(hybrid, i, point, known) and i not in known.slipping
        closed = [p for p in hybrid.automaton.options[i] if p.slides or (p.rolls and sticks)]
        closed = [p for p in closed if not p.is_beyond]
    # Sticking comes before slip, and contact before flight: where static and kinetic friction
    # differ, or in Painlevé's paradox, several modes may be possible, and a contact keeps to the
    # one with the most constraints.
    if i not in known.separated:
        for phase in closed:
            yield phase.beyond() if i in (known.beyond or ()) else phase
    yield FLIGHT


def _is_still(hybrid: HybridSystem, i: int, point: ContactKinematics, known: ContactStatus) -> bool:
    if i in known.stuck or i in known.slipping:
        return True
    slip = hybrid.numbers.size(point.velocity[:2])
    return bool(slip <= hybrid.numbers.finer(NO_SLIP) * point.scale)


def _gives_way(
    hybrid: HybridSystem,
    shared: State,
    phases: tuple[Phase, ...],
    points: list[ContactKinematics],
    i: int,
) -> bool:
    """Whether a couple could not hold what begins to turn, if all else were as it is.

    Without that nothing drives the motion that it would oppose.
    """
    contact = hybrid.automaton.contacts[i]
    if not contact.is_beside:
        return True
    held = (*phases[:i], HELD, *phases[i + 1 :])
    entry = entered(hybrid, shared, held, points, frozenset())
    forces = hybrid.mode(held).contact_forces(
        entry.state, shared.time, directions_of(entry, hybrid.numbers)
    )
    return _exceeds(hybrid, contact, forces[i])


def _exceeds(hybrid: HybridSystem, contact: ContactLaw, force: Array) -> bool:
    """Whether what keeps a contact from slipping is beyond the limit of its friction."""
    if not isinstance(contact, DryFriction):
        return False
    most = hybrid.value(contact.mu_static) * force[2]
    tolerance = hybrid.numbers.finer(_TOLERANCE)
    return bool(hybrid.numbers.size(force[:2]) > most * (1 + tolerance))


def _undetermined(mode: Mode, time: Any) -> tuple[ContactLaw, ...]:
    """The contacts with forces that Newton's laws leave open.

    Raises:
        ConstraintError: where the joints alone cannot keep the bodies as declared.
    """
    try:
        return mode.undetermined
    except ConstraintError as error:
        raise ConstraintError(
            f"at t = {float(time):.9g} s, {mode.name}: {error.given}",
            expected=error.expected,
            advice="declare what holds the bodies where the contact gives way, or simulate the "
            "equations derived from the declaration, whose contacts stay as they are",
        ) from error


def _open_forces(undetermined: tuple[ContactLaw, ...], time: Any) -> NumericError:
    """The error for contact forces that Newton's laws leave open, and a motion that needs them."""
    rubs = any(isinstance(contact, DryFriction) for contact in undetermined)
    return NumericError(
        f"undetermined forces at {', '.join(c.name for c in undetermined)} at t = "
        f"{float(time):.9g} s, beside contacts with friction",
        expected="contacts whose normal and friction forces Newton's laws determine, or bodies at "
        "rest under loads that stay as they are",
        advice="name a law by which they share a load, System(..., sharing="
        '"equal stiffness"), declare them Rolling or Smooth, or take one of them away'
        if rubs
        else "declare bodies that do not interact as systems of their own",
    )


def _objection(hybrid: HybridSystem, entry: ModeState) -> str | None:
    """Why the forces in a mode are impossible; None if they are possible.

    Signorini: N ≥ 0. Coulomb while sticking: |T| ≤ μ_s N. Friction of sliding contacts obeys its
    law in the equations already.
    """
    mode, numbers = hybrid.mode(entry.phases), hybrid.numbers
    if entry.slips:
        refuse_jamming(hybrid.in_doubles, entry.rounded())
    directions = directions_of(entry, numbers)
    forces = mode.contact_forces(entry.state, entry.shared.time, directions)
    tolerance = numbers.finer(_TOLERANCE)
    scale = np.max(np.abs(forces), initial=0.0)
    for contact, phase, force in zip(hybrid.automaton.contacts, entry.phases, forces, strict=True):
        if phase.flies:
            continue
        if force[2] < -tolerance * scale:
            return f"{mode.mode.name} would need {contact.name} to pull"
        if phase.rolls and _exceeds(hybrid, contact, force):
            return f"{mode.mode.name} would need more friction than {contact.name} has"
    return None


#: Acceleration that counts as none, of those without contact.
_NO_ACCELERATION = 1e-9


def _would_close(
    hybrid: HybridSystem,
    entry: ModeState,
    points: list[ContactKinematics],
    known: ContactStatus,
) -> str | None:
    """Why a contact cannot open in a mode: without its force it would be pressed on its support.

    One contact opens where it would have to pull; of several that is to be looked at.
    """
    contacts, time = hybrid.automaton.contacts, entry.shared.time
    opening = [
        i
        for i, phase in enumerate(entry.phases)
        if phase.flies
        and i not in known.separated
        and not contacts[i].is_beside
        and points[i].velocity[2] <= hybrid.numbers.finer(NO_NORMAL_SPEED) * points[i].scale
    ]
    if len(contacts) == 1 or not opening:
        return None
    mode, free = hybrid.mode(entry.phases), hybrid.separated
    rates = mode.closing_rates(entry.state, time, directions_of(entry, hybrid.numbers))
    shared = np.concatenate([entry.shared.coordinates, entry.shared.speeds])
    least = -_NO_ACCELERATION * np.max(np.abs(free.closing_rates(shared, time, ())))
    for i in opening:
        if rates[i] < least:
            return f"{mode.mode.name} would press {contacts[i].name} on its support"
    return None


def refuse_jamming(hybrid: HybridSystem, entry: ModeState) -> None:
    """Refuse Painlevé's configurations, in which a normal force accelerates the bodies together.

    Raises:
        NumericError: where normal forces and accelerations of sliding are not determined.
    """
    mode = hybrid.mode(entry.phases)
    if mode.jamming(entry.state, entry.shared.time, directions_of(entry)) <= 0:
        names = ", ".join(element.name for element in mode.sliding)
        raise painleve(names, entry.shared.time)


def painleve(names: str, time: float) -> NumericError:
    """The error for friction so strong that sliding has no unique forces."""
    return NumericError(
        f"sliding at {names} jams at t = {float(time):.9g} s (Painlevé's paradox)",
        expected="friction low enough for the normal force to be determined",
        advice="lower the friction coefficient: a rigid body has no unique motion here",
    )
