"""The first stretch of a slip, from the instant at which its speed is still zero."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from polhode.algebra import Symbol
from polhode.model import Contact
from polhode.simulate._dynamics import CLOCK, WORK
from polhode.simulate._segment import Part
from polhode.simulate.contact._creep import creep
from polhode.simulate.contact._machine import ModeMachine, slip_symbols
from polhode.simulate.contact._settle import Entry
from polhode.simulate.integrate._driver import Solution, Stop
from polhode.simulate.integrate._integrators import Array

_STIFF = 30.0  # ratio of the times of slipping and of turning the slip that explicit steps bear


def onset(
    mode: ModeMachine,
    entry: Entry,
    state: dict[Symbol, float],
    span: tuple[float, float],
    contacts: Sequence[Contact],
) -> Part:
    """As far as the slip velocity has to be followed as a size and a direction.

    Args:
        mode: sliding.
        entry: with the direction in which the slip begins.
        state: at the beginning.
        span: from when, and until when at most, s.
        contacts: of the automaton.
    """
    ((i, angle),) = entry.onset.items()
    contact = contacts[i]
    element = mode.mode.element(contact)
    polars = slip_symbols(contact)
    own = tuple(s for s in mode.dynamics.states if s not in polars and s != WORK)
    symbols = (*own, WORK)
    slips = mode.slip_changes[2 * i : 2 * i + 2]
    rates = dict(zip(mode.dynamics.states, mode.dynamics.rates, strict=True))
    wanted = [*(rates[s] for s in own), mode.mode.equations.power, *slips]
    turning = (*element.direction, element.slip_speed)  # type: ignore[attr-defined]
    arguments = (*symbols, *turning, *mode.dynamics.parameters, CLOCK)
    function = mode.dynamics.function(wanted, arguments)
    constants = mode.parameters

    def polar(states: Array, times: Array) -> Array:
        size, psi = states[-2], states[-1]
        c, s = np.cos(psi), np.sin(psi)
        found = function(*states[:-2], c, s, size, *constants, times)
        values = np.array([np.broadcast_to(v, states[0].shape) for v in found])
        along, across = values[-2], values[-1]
        return np.vstack([values[:-2], [along * c + across * s], [across * c - along * s]]).reshape(
            states.shape
        )

    start = np.array([*(state[s] for s in symbols), 0.0, angle])

    grip, pull = _pulls(mode, start[: len(own)], entry.place.time, i)

    def enough(elapsed: float, reached: Array) -> bool:
        return grip * elapsed < _STIFF * float(reached[-2])

    found = creep(polar, start, *span, pull, enough)

    def at(times: Array) -> Array:
        values = found.at(times)
        size, psi = values[-2], values[-1]
        return np.vstack([values[:-2], size * np.cos(psi), size * np.sin(psi)])

    stop, vanished = (
        (Stop.VANISHED, sorted(entry.slips).index(i)) if found.ends else (Stop.PAUSE, None)
    )
    times = np.append(found.times[:-1], found.end)
    solution = Solution((*symbols, *slip_symbols(contact)), {}, times, stop, vanished, at)
    return Part(entry.place.time, found.end, solution, constants)


def _pulls(mode: ModeMachine, state: Array, time: float, i: int) -> tuple[float, float]:
    """How strongly friction pulls at the slip velocity, and that or what else does so, m/s²."""
    along = mode.slip_rates(state, time, [1.0, 0.0, 0.0])[i]
    against = mode.slip_rates(state, time, [-1.0, 0.0, 0.0])[i]
    grip, rest = (float(np.hypot(*change)) / 2 for change in (along - against, along + against))
    return grip, max(grip, rest)
