"""The directions in which contacts begin to slip, against the friction that is to come."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import permutations, product
from typing import Any

import numpy as np

from polhode.base import NumericError
from polhode.simulate.contact._hybrid_system import CompiledMode, HybridSystem
from polhode.simulate.contact._mode_state import ModeState, beyond, directions_of
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._crossing import bracketed_zeros

#: Slip that counts as none, relative to the velocities that it is the difference of.
NO_SLIP = 1e-12
_PULLS = 1e-9  # of the largest force: less is rounding
_ANGLES = 72  # directions of slip, 5° apart, between which roots are bracketed


def begin_slips(hybrid: HybridSystem, entry: ModeState) -> str | None:
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


def onset_angle(hybrid: HybridSystem, entry: ModeState, i: int) -> Any:
    """The direction (angle, rad) in which a contact begins to slip.

    Kinetic friction opposes the slip to come, and the slip starts along its own rate: the direction
    ŝ solves ṡ(ŝ) × ŝ = 0 with ṡ(ŝ) · ŝ ≥ 0. The result is None if no direction does and another
    contact may slip instead.

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
    pressed = [
        angle
        for angle in growing
        if _presses(hybrid, replace(entry, onset={**entry.onset, i: angle}), [i])
    ]
    if len(pressed) == 1:
        return pressed[0]
    # Where it would have to pull in every direction, it opens.
    if not pressed and (growing or len(hybrid.automaton.contacts) > 1):
        return None
    name = hybrid.automaton.contacts[i].name
    which = "several directions" if pressed else "no direction"
    raise NumericError(
        f"at t = {entry.shared.time:.9g} s slip can begin at {name} in {which}",
        expected="one direction in which slip grows against the friction that opposes it",
        advice="end the motion before that time, or lower the friction coefficient: from here on a "
        "rigid body with this friction has no unique motion",
    )


def _presses(hybrid: HybridSystem, entry: ModeState, places: list[int]) -> bool:
    """Whether no contact has to pull, of those that begin to slip in the directions of an entry.

    Where sliding jams, a normal force below zero says nothing: it may grow beyond all bounds.
    """
    mode, given = hybrid.mode(entry.phases), (entry.state, entry.shared.time, directions_of(entry))
    forces = mode.contact_forces(*given)
    pulls = np.min(forces[places, 2]) < -_PULLS * np.max(np.abs(forces))
    return not pulls or mode.jamming(*given) <= 0


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


# -- slips that begin together -------------------------------------------------------------------


def _influence_one_another(hybrid: HybridSystem, entry: ModeState) -> bool:
    """Whether slips that begin together influence one another's direction."""
    mode, angles = hybrid.mode(entry.phases), np.linspace(0.0, 2 * np.pi, 8)
    found = (rates_along(mode, entry, j, i, angles) for i, j in permutations(entry.onset, 2))
    return any(np.max(np.ptp(r, axis=1)) > NO_SLIP * np.max(np.abs(r)) for r in found)


def joint_onset(hybrid: HybridSystem, entry: ModeState) -> dict[int, float] | None:
    """The directions (angles, rad) in which several contacts begin to slip together.

    Each slip starts along its own rate, on which the friction of all depends. Found by iteration
    from the directions that there would be without friction, and from their opposites; where a
    body slips at several points, from those of the slip of all together.

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
    depend = _depend_on_one_another(hybrid, entry, places)
    first, found = free / np.hypot(*free.T)[:, None], list[Array]()
    for signs in product((1.0, -1.0), repeat=1 if depend else len(rows)):
        if depend:
            units = _settled_together(rates, free * signs[0], felt)
        else:
            units = _settled(rates, first * np.array(signs)[:, None], felt)
        if units is None or any(np.max(np.abs(units - u)) <= 1e-6 for u in found):
            continue
        if _presses(hybrid, replace(entry, onset=_angles(places, units)), places):
            found.append(units)
    if len(found) > 1:
        names = ", ".join(hybrid.automaton.contacts[k].name for k in places)
        raise NumericError(
            f"slip begins at several contacts at the same time, t = {entry.shared.time:.9g} s: "
            f"{names}, in {len(found)} ways",
            expected="friction with which the directions of slip are determined",
            advice="end the motion before that time, or change one coefficient of friction",
        )
    return _angles(places, found[0]) if found else None


def _angles(places: list[int], units: Array) -> dict[int, float]:
    """Directions as angles (rad), by contact."""
    return {i: float(np.arctan2(y, x)) for i, (x, y) in zip(places, units, strict=True)}


def _depend_on_one_another(hybrid: HybridSystem, entry: ModeState, places: list[int]) -> bool:
    """Whether slips determine one another, as those at two points of one body do."""
    points = hybrid.touching.at(entry.shared, beyond(entry.phases))
    _, allowed = hybrid.mode(entry.phases).allowed(entry.shared)
    moved = np.vstack([points[i].jacobian[:2] for i in places]) @ allowed
    return int(np.linalg.matrix_rank(moved, _DEPENDENT * np.max(np.abs(moved)))) < len(moved)


_DEPENDENT = 1e-10  # of the largest: what moves slips less is rounding
_ROUNDS = 500  # of the iteration; its changes shrink by a factor, or do not end
_SETTLED = 1e-12  # of a direction: changes that rounding leaves


def _settled_together(rates: Callable[[Array], Array], slips: Array, felt: Array) -> Array | None:
    """The same for slips that determine one another: a motion of all, along its own rate."""
    units, change = slips / np.hypot(*slips.T)[:, None], np.inf
    for _ in range(_ROUNDS):
        before, slips = units, np.max(felt) * slips / np.linalg.norm(slips) + rates(units)
        sizes = np.hypot(*slips.T)
        if not np.all(np.isfinite(sizes)) or np.min(sizes) == 0:
            return None
        units = slips / sizes[:, None]
        change = float(np.max(np.abs(units - before)))
        if change < 1e-15:
            break
    grows = np.sum(rates(units) * units, axis=1)
    return units if change < _SETTLED and np.all(grows > -1e-9 * felt[:, 0]) else None


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
