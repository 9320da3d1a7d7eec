"""How a motion enters its first contact mode."""

from __future__ import annotations

from dataclasses import replace

from polhode.base import ConstraintError
from polhode.model import Contact
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._lift_off import STILL
from polhode.simulate.contact._mode_state import ModeState
from polhode.simulate.contact._select_mode import ContactStatus, select_mode
from polhode.simulate.contact._state import State

_ROUNDING = 1e-12  # height above a support, over the size of the place, that is none


def begun_at(machine: HybridSystem, place: State, apart: frozenset[int]) -> ModeState:
    """The first mode of a motion.

    Args:
        apart: contacts that start at a given height. Where that is none, and does not change, they
            may touch.

    Raises:
        ConstraintError: for a body that starts within its support.
        NumericError: where no mode is possible.
    """
    meetings = machine.touching.at(place, machine.touching.beyond(place))
    rounding = _ROUNDING * max((abs(float(q)) for q in place.coordinates), default=0.0)
    for i in apart:
        if meetings[i].gap < -rounding:
            raise _below(machine.automaton.contacts[i], -meetings[i].gap)
    met = {i for i in apart if meetings[i].gap <= rounding}
    resting = {i for i in met if abs(meetings[i].velocity[2]) <= STILL * meetings[i].scale}
    entry = select_mode(machine, place, ContactStatus(apart - resting))
    return replace(entry, gaps={i: 0.0 for i in met if entry.phases[i].flies})


def _below(contact: Contact, depth: float) -> ConstraintError:
    height = contact.on.normal + contact.body.tag
    return ConstraintError(
        f"{contact.body.name} starts {depth:g} m below its support",
        expected=f"a height {height} at which it touches or is above",
        advice=f"leave out {height} to start in contact",
    )
