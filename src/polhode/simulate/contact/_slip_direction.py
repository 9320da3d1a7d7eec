"""The first stretch of slips, from the instant at which their speeds are still zero."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from polhode.algebra import Symbol
from polhode.model import Contact
from polhode.simulate._dynamics import CLOCK
from polhode.simulate._segment import TrajectoryPiece
from polhode.simulate.contact._hybrid_system import CompiledMode
from polhode.simulate.contact._mode_state import ModeState
from polhode.simulate.contact._polar import polar_shape
from polhode.simulate.contact._select_mode import rates_along
from polhode.simulate.contact._slip_onset import slip_onset
from polhode.simulate.integrate._driver import SegmentSolution
from polhode.simulate.integrate._rows import rows
from polhode.simulate.integrate._stepping import Array
from polhode.simulate.integrate._stop_criteria import Stop

_BARELY = 1e-150  # m/s, of a slip that has a direction but no speed yet: its square is a number
_STIFF = 30.0  # ratio of the times of slipping and of turning the slip that explicit steps bear


def onset(
    mode: CompiledMode,
    entry: ModeState,
    state: dict[Symbol, float],
    span: tuple[float, float],
    contacts: Sequence[Contact],
) -> TrajectoryPiece:
    """As far as the slip velocities have to be followed as sizes and directions.

    Args:
        mode: sliding.
        entry: with the directions in which slips begin.
        state: at the beginning.
        span: from when, and until when at most, s.
        contacts: of the automaton.
    """
    shape = polar_shape(mode, entry, contacts)
    starting, symbols, polars = shape.starting, shape.symbols, shape.polars
    arguments = (*symbols, *shape.given, *mode.dynamics.parameters, CLOCK)
    function = mode.dynamics.function(shape.wanted, arguments)
    constants = mode.parameters
    first = len(symbols)

    def polar(states: Array, times: Array) -> Array:
        sizes, psis = states[first::2], states[first + 1 :: 2]
        c, s = np.cos(psis), np.sin(psis)
        directions = np.stack([c, s, sizes], axis=1).reshape(-1, len(times))
        found = function(*states[:first], *directions, *constants, times)
        values: Array = rows(found, len(times), states.dtype)
        along, across = values[first::2].copy(), values[first + 1 :: 2].copy()
        values[first::2] = along * c + across * s
        values[first + 1 :: 2] = across * c - along * s
        return values

    angles = [entry.onset[i] for i in starting]
    start = np.array([*(state[s] for s in symbols), *(x for psi in angles for x in (0.0, psi))])
    pulls = [_pulls(mode, entry, i) for i in starting]
    grips = np.array([grip for grip, _ in pulls])

    def enough(elapsed: float, reached: Array) -> bool:
        return bool(np.all(grips * elapsed < _STIFF * reached[first::2]))

    pull = max(pull for _, pull in pulls)
    found = slip_onset(polar, start, *span, pull, enough, len(starting))
    all_symbols = (*symbols, *polars)

    def at(times: Array) -> Array:
        values = found.at(times)
        sizes, psis = np.maximum(values[first::2], _BARELY), values[first + 1 :: 2].copy()
        values[first::2], values[first + 1 :: 2] = sizes * np.cos(psis), sizes * np.sin(psis)
        return values

    def rest_at(time: float) -> Array:
        values = dict(zip(all_symbols, at(np.array([time]))[:, 0].tolist(), strict=True))
        return mode.flow.rest(values, constants, time)

    stop, vanished = Stop.PAUSE, None
    if found.vanished is not None:
        stop, vanished = Stop.VANISHED, sorted(entry.slips).index(starting[found.vanished])
    times = np.append(found.times[:-1], found.end)
    solution = SegmentSolution(all_symbols, {}, times, stop, vanished, at, _rest_at=rest_at)
    return TrajectoryPiece(entry.place.time, found.end, solution, constants)


def _pulls(mode: CompiledMode, entry: ModeState, i: int) -> tuple[float, float]:
    """How strongly friction pulls at a slip velocity, and that or what else does so, m/s²."""
    along, against = rates_along(mode, entry, i, i, np.array([0.0, np.pi])).T
    grip, rest = (float(np.hypot(*change)) / 2 for change in (along - against, along + against))
    return grip, max(grip, rest)
