"""Other independent speeds for all contact modes, where those of a motion become singular."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from polhode.algebra import ONE, Expr, Symbol
from polhode.derive import Guard
from polhode.model import Phase
from polhode.simulate._mode_integration import StateValues
from polhode.simulate._names import Name
from polhode.simulate._start import configuration_at_start
from polhode.simulate.contact._auxiliary_states import slip_symbols
from polhode.simulate.contact._contact_kinematics import State
from polhode.simulate.contact._hybrid_system import CompiledMode, HybridSystem
from polhode.simulate.contact._mode_state import ModeState, beyond, entered
from polhode.simulate.contact._transition import ModeExit, index_of
from polhode.simulate.integrate._arrays import Array

_CLOSING = ("touches down", "sticks")  # what a contact does that adds constraints


@dataclass(frozen=True)
class SpeedChange(Guard):
    """Ends a piece where other speeds have to be independent; the contacts stay as they are.

    Attributes:
        speeds: these.
    """

    speeds: tuple[Symbol, ...] = ()


def speed_change(
    hybrid: HybridSystem, phases: tuple[Phase, ...], state: StateValues, time: float
) -> SpeedChange:
    """The change to speeds that are regular in a state of a contact mode, in doubles."""
    mode = hybrid.mode(phases)
    coordinates = np.array([state[q] for q in mode.mode.equations.coordinates])
    speeds = _regular(hybrid, mode, coordinates, time, at_start=False)
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
    hybrid.on_speeds(_regular(hybrid, mode, coordinates, 0.0, at_start=True))


def _regular(
    hybrid: HybridSystem, mode: CompiledMode, coordinates: Array, time: float, *, at_start: bool
) -> tuple[Symbol, ...]:
    """Speeds to be independent: those of a mode, then the others of the one without contacts."""
    separated = hybrid.separated
    shared = separated.mode.equations.coordinates
    known = mode.mode.embedding
    places = mode.function([known.get(q, Expr.generator(q)) for q in shared])
    at_rest = np.concatenate([coordinates, np.zeros(len(mode.mode.equations.speeds))])
    chosen = list[Symbol]()
    for one, there in ((mode, coordinates), (separated, places(at_rest, time, ()))):
        speeds: tuple[Symbol, ...] | None
        if at_start:
            speeds = one.dependence.best_at_start(there, one.parameters)
        else:
            speeds = one.dependence.best(there, one.parameters, time)
        chosen += one.mode.equations.speeds if speeds is None else speeds
    return tuple(dict.fromkeys(chosen))


def closing_on_regular(
    hybrid: HybridSystem, phases: tuple[Phase, ...], leaving: ModeExit
) -> ModeExit:
    """Where a mode ends because a contact closes or sticks, on speeds that are regular after it.

    In the mode that ends they may have been any: without the constraints of that contact all of
    them are independent.

    Args:
        phases: of the mode that ends.
    """
    guard, modes = leaving.guard, hybrid.automaton
    if guard is None or guard.kind not in _CLOSING or not modes.may_become_singular:
        return leaving
    i = index_of(guard, hybrid)
    closed = next(iter(modes.options[i]))
    after = tuple(
        (closed.beyond() if p.is_beyond else closed) if k == i else p for k, p in enumerate(phases)
    )
    rough, shared = hybrid.in_doubles, leaving.shared
    mode, there = rough.mode(after), shared.rounded()
    coordinates = mode.coordinates(there)
    if mode.dependence.is_regular(coordinates, mode.parameters, there.time):
        return leaving
    speeds = _regular(rough, mode, coordinates, there.time, at_start=True)
    return replace(leaving, shared=_in_terms_of(hybrid, speeds, shared))


def _in_terms_of(hybrid: HybridSystem, speeds: tuple[Symbol, ...], shared: State) -> State:
    """Go on with other independent speeds, of which a shared state is made then."""
    before = hybrid.separated
    hybrid.on_speeds(speeds)
    wanted = [Expr.generator(speed) for speed in hybrid.separated.mode.equations.speeds]
    here = np.concatenate([shared.coordinates, shared.speeds])
    values = before.function(wanted)(here, shared.time, ())
    return State(shared.time, shared.coordinates, values, shared.work)


def on_other_speeds(
    hybrid: HybridSystem,
    speeds: tuple[Symbol, ...],
    entry: ModeState,
    leaving: ModeExit,
    state: StateValues,
) -> ModeState:
    """Go on in the same contact mode on other independent speeds.

    Args:
        speeds: those that become independent.
        entry: where the mode was entered.
        leaving: where a piece of it ended.
        state: the same, with the slip velocities as they were integrated.
    """
    there = _in_terms_of(hybrid, speeds, leaving.shared)
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
