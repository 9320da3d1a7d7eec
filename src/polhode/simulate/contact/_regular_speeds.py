"""Independent speeds that are regular in a contact mode, for all modes."""

from __future__ import annotations

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.model import Phase
from polhode.simulate.contact._contact_kinematics import State
from polhode.simulate.contact._hybrid_system import CompiledMode, HybridSystem
from polhode.simulate.integrate._arrays import Array


def on_regular_speeds(hybrid: HybridSystem, phases: tuple[Phase, ...], shared: State) -> State:
    """A shared state on speeds that are regular in a mode, with which all modes then go on.

    In the mode before they may have been any: without the constraints of contacts that close, all
    of them are independent.
    """
    if not hybrid.automaton.may_become_singular:
        return shared
    rough, there = hybrid.in_doubles, shared.rounded()
    mode = rough.mode(phases)
    coordinates = mode.coordinates(there)
    if mode.dependence.is_regular(coordinates, mode.parameters, there.time):
        return shared
    speeds = regular_speeds(rough, mode, coordinates, there.time, at_start=True)
    return in_terms_of(hybrid, speeds, shared)


def regular_speeds(
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


def in_terms_of(hybrid: HybridSystem, speeds: tuple[Symbol, ...], shared: State) -> State:
    """Go on with other independent speeds, of which a shared state is made then."""
    before = hybrid.separated
    hybrid.on_speeds(speeds)
    wanted = [Expr.generator(speed) for speed in hybrid.separated.mode.equations.speeds]
    here = np.concatenate([shared.coordinates, shared.speeds])
    values = before.function(wanted)(here, shared.time, ())
    return State(shared.time, shared.coordinates, values, shared.work)
