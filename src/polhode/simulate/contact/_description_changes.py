"""Other coordinates or independent speeds for all contact modes, where those become singular.

The contacts stay as they are.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from polhode.algebra import ONE, Symbol
from polhode.derive import Guard
from polhode.model import Phase
from polhode.simulate._mode_integration import StateValues
from polhode.simulate._names import Name
from polhode.simulate._start import configuration_at_start
from polhode.simulate.contact._auxiliary_states import slip_symbols
from polhode.simulate.contact._contact_kinematics import State
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._mode_state import ModeState, beyond, entered
from polhode.simulate.contact._regular_speeds import in_terms_of, regular_speeds
from polhode.simulate.contact._transition import ModeExit


@dataclass(frozen=True)
class DescriptionChange(Guard):
    """Ends a piece where the modes have to be described otherwise."""

    @abstractmethod
    def applied(self, hybrid: HybridSystem, phases: tuple[Phase, ...], shared: State) -> State:
        """Go on in the other description, of which a shared state is made then.

        Args:
            hybrid: the modes.
            phases: of the one that the motion is in.
            shared: in terms of the description before.
        """


@dataclass(frozen=True)
class SpeedChange(DescriptionChange):
    """Ends a piece where other speeds have to be independent.

    Attributes:
        speeds: these.
    """

    speeds: tuple[Symbol, ...] = ()

    def applied(self, hybrid: HybridSystem, phases: tuple[Phase, ...], shared: State) -> State:
        return in_terms_of(hybrid, self.speeds, shared)


def speed_change(
    hybrid: HybridSystem, phases: tuple[Phase, ...], state: StateValues, time: float
) -> SpeedChange:
    """The change to speeds that are regular in a state of a contact mode, in doubles."""
    mode = hybrid.mode(phases)
    coordinates = np.array([state[q] for q in mode.mode.equations.coordinates])
    speeds = regular_speeds(hybrid, mode, coordinates, time, at_start=False)
    return SpeedChange(None, "other speeds", ONE, speeds)


def choose_at_start(
    hybrid: HybridSystem, phases: tuple[Phase, ...], start: Mapping[Name, Any]
) -> None:
    """Choose independent speeds that are regular where a motion starts.

    Equations in which they may become singular are evaluated in named parts, which have no
    removable zeros in their denominators.
    """
    hybrid.on_speeds(())
    if not hybrid.automaton.may_become_singular:
        return
    mode = hybrid.mode(phases)
    plain = mode.dynamics.without_auxiliary
    numbers = dict(zip(plain.parameters, mode.parameters.tolist(), strict=True))
    found = configuration_at_start(plain, start, numbers)
    coordinates = np.array(list(found.values()))
    hybrid.on_speeds(regular_speeds(hybrid, mode, coordinates, 0.0, at_start=True))


def described_otherwise(
    hybrid: HybridSystem,
    change: DescriptionChange,
    entry: ModeState,
    leaving: ModeExit,
    state: StateValues,
) -> ModeState:
    """Go on in the same contact mode in another description.

    Args:
        change: to it.
        entry: where the mode was entered.
        leaving: where a piece of it ended.
        state: the same, with the slip velocities as they were integrated.
    """
    there = change.applied(hybrid, entry.phases, leaving.shared)
    points = hybrid.touching.at(there, beyond(entry.phases))
    again = entered(hybrid, there, entry.phases, points, frozenset())
    contacts = enumerate(hybrid.automaton.contacts)
    integrated = {
        i: hybrid.numbers.array([state[s] for s in slip_symbols(contact)])
        for i, contact in contacts
        if i in again.slips and state.keys() >= set(slip_symbols(contact))
    }
    return replace(
        again,
        slips=again.slips | integrated,
        gaps={i: leaving.gaps[i] for i in leaving.gaps if entry.phases[i].flies},
        edge_distances={i: leaving.edge_distances[i] for i in again.edge_distances},
    )
