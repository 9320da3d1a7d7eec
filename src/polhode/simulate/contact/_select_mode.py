"""Chooses the contact mode in which a motion continues, from the forces that each would need.

Candidates are tried in order: rolling before sliding before flight, contact by contact. A mode is
possible if no contact has to pull, and static friction stays within its limit μ_s N.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import permutations, product
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
from polhode.simulate.contact._at_rest import rests
from polhode.simulate.contact._contact_kinematics import (
    NO_NORMAL_SPEED,
    ContactKinematics,
    State,
)
from polhode.simulate.contact._hybrid_system import CompiledMode, HybridSystem
from polhode.simulate.contact._mode_state import ModeState, directions_of, entered
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._crossing import bracketed_zeros

#: Slip that counts as none, relative to the velocities that it is the difference of.
NO_SLIP = 1e-12
# A mode ends where a force reaches its limit, so there the force of the next mode is at its own
# limit too, up to the error of the time of the event: it may exceed the limit by this share.
_TOLERANCE = 1e-11
_ANGLES = 72  # directions of slip, 5° apart, between which roots are bracketed


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
    for phases in product(*tried):
        if not hybrid.automaton.is_possible(phases):
            continue
        undetermined = _undetermined(hybrid.automaton.mode(phases), shared.time)
        still = [_is_still(hybrid, i, point, known) for i, point in enumerate(points)]
        starting = frozenset(i for i, phase in enumerate(phases) if phase.slides and still[i])
        if not all(
            _gives_way(hybrid, shared, phases, points, i) for i in starting - known.slipping
        ):
            continue
        entry = entered(hybrid, shared, phases, points, starting)
        if undetermined:
            held = rests(hybrid.in_doubles, entry.rounded())
            if held is None:
                raise _open_forces(undetermined, shared.time)
            if held:
                return entry
            failures.append(f"{hybrid.mode(phases).mode.name} would need more friction")
            continue
        failure = _begins(hybrid, entry) or _objection(hybrid, entry)
        failure = failure or _would_close(hybrid, entry, points, known)
        if failure is None:
            return entry
        failures.append(failure)
    raise NumericError(
        f"no contact mode is possible at t = {float(shared.time):.9g} s: {'; '.join(failures)}",
        expected="friction and normal forces that some mode can supply",
        advice="lower the friction coefficient, or end the motion before that time",
    )


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
        advice="declare the contacts Rolling or Smooth, or take one of them away"
        if rubs
        else "declare bodies that do not interact as systems of their own",
    )


def _begins(hybrid: HybridSystem, entry: ModeState) -> str | None:
    """Find the directions in which slips begin; or say why they do not.

    Raises:
        NumericError: where there is no direction, or more than one.
    """
    if _influence_one_another(hybrid.in_doubles, entry.rounded()):
        found = joint_onset(hybrid.in_doubles, entry.rounded())
        if found is None:
            name = hybrid.mode(entry.phases).mode.name
            return f"{name} has no directions in which all slips that begin together grow"
        entry.onset.update(found)
        return None
    for i in entry.onset:
        angle = onset_angle(hybrid, entry, i)
        if angle is None:
            mode, contact = hybrid.mode(entry.phases).mode, hybrid.automaton.contacts[i]
            return f"{mode.name} has no direction in which slip grows at {contact.name}"
        entry.onset[i] = angle
    return None


def _influence_one_another(hybrid: HybridSystem, entry: ModeState) -> bool:
    """Whether slips that begin together influence one another's direction."""
    mode, angles = hybrid.mode(entry.phases), np.linspace(0.0, 2 * np.pi, 8)
    found = (rates_along(mode, entry, j, i, angles) for i, j in permutations(entry.onset, 2))
    return any(np.max(np.ptp(r, axis=1)) > NO_SLIP * np.max(np.abs(r)) for r in found)


def joint_onset(hybrid: HybridSystem, entry: ModeState) -> dict[int, float] | None:
    """The directions (angles, rad) in which several contacts begin to slip together.

    Each slip starts along its own rate, on which the friction of all depends. Found by iteration
    from the directions that there would be without friction, and from their opposites.

    Raises:
        NumericError: where different directions are possible.
    """
    mode, places = hybrid.mode(entry.phases), sorted(entry.onset)
    rows = [sorted(entry.slips).index(i) for i in places]
    given = np.array(directions_of(entry), dtype=float).reshape(-1, 3)

    def rates(units: Array) -> Array:
        given[rows] = np.hstack([units, np.zeros((len(rows), 1))])
        found = mode.slip_rates(entry.state, entry.shared.time, given.ravel().tolist())
        return np.asarray(found[places], dtype=float)

    free = rates(np.zeros((len(rows), 2)))
    # How much the friction of all may change each rate.
    felt = np.zeros((len(rows), 1))
    for k, axis in product(range(len(rows)), range(2)):
        unit = np.zeros_like(free)
        unit[k, axis] = 1.0
        felt += np.linalg.norm(rates(unit) - free, axis=1, keepdims=True)
    if np.min(np.hypot(*free.T)) <= NO_SLIP * np.max(np.abs(free)):
        return None
    first, found = free / np.hypot(*free.T)[:, None], list[Array]()
    for signs in product((1.0, -1.0), repeat=len(rows)):
        units = _settled(rates, first * np.array(signs)[:, None], felt)
        if units is not None and all(np.max(np.abs(units - u)) > 1e-6 for u in found):
            found.append(units)
    if len(found) > 1:
        names = ", ".join(hybrid.automaton.contacts[k].name for k in places)
        raise NumericError(
            f"slip begins at several contacts at the same time, t = {entry.shared.time:.9g} s: "
            f"{names}, in {len(found)} ways",
            expected="friction with which the directions of slip are determined",
            advice="end the motion before that time, or change one coefficient of friction",
        )
    if not found:
        return None
    return {i: float(np.arctan2(y, x)) for i, (x, y) in zip(places, found[0], strict=True)}


_ROUNDS = 500  # of the iteration; its changes shrink by a factor, or do not end


def _settled(rates: Callable[[Array], Array], units: Array, felt: Array) -> Array | None:
    """Directions along their own rates, near some others; None where there are none.

    The direction in which a little of the slip of each turns: at its fixed point the rate is along
    it, and there are such points even where slip begins gently, with no rate at first.
    """
    for _ in range(_ROUNDS):
        found = rates(units)
        turned = felt * units + found
        sizes = np.hypot(*turned.T)
        if not np.all(np.isfinite(sizes)) or np.min(sizes) == 0:
            return None
        after: Array = turned / sizes[:, None]
        change, units = np.max(np.abs(after - units)), after
        if change < 1e-15:
            break
    else:
        return None
    grows = np.sum(rates(units) * units, axis=1)
    return units if np.all(grows > -1e-9 * felt[:, 0]) else None


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


def onset_angle(hybrid: HybridSystem, entry: ModeState, i: int) -> Any:
    """The direction (angle, rad) in which a contact begins to slip.

    Kinetic friction opposes the slip to come, and the slip starts along its own rate: the direction
    ŝ solves ṡ(ŝ) × ŝ = 0 with ṡ(ŝ) · ŝ ≥ 0. None where there is none, and others may slip instead.

    Raises:
        NumericError: where no direction, or more than one, is possible.
    """
    near = _rough_angle(hybrid.in_doubles, entry.rounded(), i)
    if near is None:
        return None
    mode, numbers = hybrid.mode(entry.phases), hybrid.numbers

    def across(angle: Any) -> Any:
        trial = replace(entry, onset={**entry.onset, i: angle})
        directions = directions_of(trial, numbers)
        x, y = mode.slip_rates(entry.state, entry.shared.time, directions)[i]
        cos, sin = numbers.direction(angle)
        return y * cos - x * sin

    return numbers.zero(across, near)


def _rough_angle(hybrid: HybridSystem, entry: ModeState, i: int) -> float | None:
    """The direction in double precision, from brackets all around the circle."""
    mode = hybrid.mode(entry.phases)

    def rate(angle: float) -> Array:
        trial = replace(entry, onset={**entry.onset, i: angle})
        return np.asarray(mode.slip_rates(entry.state, entry.shared.time, directions_of(trial))[i])

    def across(angle: float) -> float:
        x, y = rate(angle)
        return float(y * np.cos(angle) - x * np.sin(angle))

    def along(angle: float) -> float:
        x, y = rate(angle)
        return float(x * np.cos(angle) + y * np.sin(angle))

    # Turned by an odd angle: roots in symmetric directions (0, π/2, …) fall between grid points.
    grid = np.linspace(-np.pi, np.pi, _ANGLES + 1) + 0.0123
    rates = rates_along(mode, entry, i, i, grid)
    values = rates[1] * np.cos(grid) - rates[0] * np.sin(grid)
    size = float(np.max(np.hypot(*rates)))
    found = bracketed_zeros(across, grid, values) if size else []
    # Slip may begin gently, with no acceleration at first: then its growth is zero to rounding.
    growing = [angle for angle in found if along(angle) > -1e-9 * size]
    if len(growing) == 1:
        return growing[0]
    if not growing and len(hybrid.automaton.contacts) > 1:
        return None
    name = hybrid.automaton.contacts[i].name
    which = "several directions" if growing else "no direction"
    raise NumericError(
        f"at t = {entry.shared.time:.9g} s slip can begin at {name} in {which}",
        expected="one direction in which slip grows against the friction that opposes it",
        advice="end the motion before that time, or lower the friction coefficient: from here on a "
        "rigid body with this friction has no unique motion",
    )


def rates_along(mode: CompiledMode, entry: ModeState, i: int, seen: int, angles: Array) -> Array:
    """Rates of a slip velocity if slip begins in some directions, m/s², shape (2, angles).

    Args:
        i: the contact at which it begins.
        seen: the contact whose slip rates are returned.
    """
    given: list[Any] = list(directions_of(replace(entry, onset={**entry.onset, i: 0.0})))
    place = 3 * sorted(entry.slips).index(i)
    given[place : place + 3] = [np.cos(angles), np.sin(angles), np.zeros_like(angles)]
    return np.asarray(mode.slip_rates_along(entry.state, entry.shared.time, given)[seen])
