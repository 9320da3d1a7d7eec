"""From one contact mode to the next: what is known where a mode ends, and shocks on landing."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from polhode.base import NumericError
from polhode.derive import Guard
from polhode.model import Coulomb, Phase, Rolling
from polhode.simulate.contact._machine import Machine
from polhode.simulate.contact._place import Place
from polhode.simulate.contact._settle import Entry, Known, settle
from polhode.simulate.contact._shock import Roughness, coulomb_shock, rough_shock, smooth_shock

_REBOUND = 1e-13  # of the hardest landing: a rebound that is none
_STILL = 1e-14  # approach, relative to the velocities it is the difference of, that is none


class Transitions:
    """The changes of mode along one motion; remembers the hardest landing.

    Args:
        machine: the modes.
    """

    def __init__(self, machine: Machine) -> None:
        self._machine = machine
        self._hardest = 0.0

    def next(self, entry: Entry, guard: Guard | None, place: Place) -> tuple[str, Entry]:
        """What happens where a mode ends, and how the motion enters the mode that follows."""
        apart = frozenset(k for k, phase in enumerate(entry.phases) if phase.flies)
        if guard is None:
            self._machine.move_on(place.time)
            return "jerk", settle(self._machine, place, Known(apart))
        i = index_of(guard, self._machine)
        still = frozenset(k for k, phase in enumerate(entry.phases) if phase.rolls)
        if guard.kind == "touches down":
            return self._land(entry, place, i, apart)
        if guard.kind == "lifts off":
            known = Known(apart | {i}, still - {i}, beyond=beyond(entry.phases))
            found = settle(self._machine, place, known)
            return "lifts off", replace(found, gaps={i: 0.0})
        far = beyond(entry.phases)
        if guard.kind == "crosses the edge":
            known = Known(apart, still - {i}, beyond=far ^ {i})
        elif guard.kind == "slips":
            known = Known(apart, still - {i}, frozenset({i}), far)
        else:
            known = Known(apart, still | {i}, beyond=far)
        return guard.kind, settle(self._machine, place, known)

    def _land(self, entry: Entry, place: Place, i: int, apart: frozenset[int]) -> tuple[str, Entry]:
        """A shock, then contact or another flight."""
        contact = self._machine.automaton.contacts[i]
        if len(apart) < len(entry.phases):
            raise NumericError(
                f"{contact.name} lands at t = {place.time:.9g} s while another contact touches",
                expected="one contact at a time: several shocks at once are not determined",
                advice="end the motion before that time",
            )
        meeting = self._machine.touching.at(place, self._machine.touching.beyond(place))[i]
        if meeting.velocity[2] >= -_STILL * meeting.scale:
            return "touches down", settle(self._machine, place, Known(apart - {i}))
        mass = self._machine.apart.mass(place)
        felt = meeting.arms @ np.linalg.solve(mass, meeting.arms.T)
        restitution = self._machine.value(contact.restitution)
        if isinstance(contact, Coulomb):
            kinetic, static = (self._machine.value(m) for m in (contact.mu, contact.mu_static))
            shock = coulomb_shock(felt, meeting.velocity, Roughness(kinetic, static, restitution))
        elif isinstance(contact, Rolling):
            shock = rough_shock(felt, meeting.velocity, restitution)
        else:
            shock = smooth_shock(felt, meeting.velocity, restitution)
        work = shock.impulse @ (meeting.support + (meeting.velocity + shock.velocity) / 2)
        change = np.asarray(np.linalg.solve(mass, meeting.arms.T @ shock.impulse), dtype=float)
        after = place.kicked(change, float(work))
        self._hardest = max(self._hardest, -float(meeting.velocity[2]))
        if shock.velocity[2] > _REBOUND * self._hardest:
            bounced = settle(self._machine, after, Known(apart))
            return "bounces", replace(bounced, gaps={i: 0.0})
        stuck_ = frozenset({i}) if shock.sticks else frozenset()
        return "touches down", settle(self._machine, after, Known(apart - {i}, stuck_))


def beyond(phases: tuple[Phase, ...]) -> frozenset[int]:
    """The contacts that are beyond the edge of their support."""
    return frozenset(i for i, phase in enumerate(phases) if phase.is_beyond)


def index_of(guard: Guard, machine: Machine) -> int:
    """Which contact a guard watches; -1 for none."""
    names = [contact.name for contact in machine.automaton.contacts]
    return names.index(guard.contact.name) if guard.contact is not None else -1
