"""The equations of slips that begin, on their speeds and directions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from polhode.algebra import Expr, Symbol
from polhode.model import Contact
from polhode.simulate._dynamics import WORK
from polhode.simulate.contact._carried import slip_symbols
from polhode.simulate.contact._hybrid_system import CompiledMode
from polhode.simulate.contact._mode_state import ModeState


@dataclass(frozen=True)
class PolarShape:
    """What has to be computed of slips that begin, and what of.

    Attributes:
        starting: the contacts, by their places in the declaration.
        symbols: all other states.
        polars: slip velocities of those contacts, two of each.
        given: of each of them, cosine and sine of the direction of its slip, and its size.
        wanted: rates of the other states, then of the slip velocities.
    """

    starting: tuple[int, ...]
    symbols: tuple[Symbol, ...]
    polars: tuple[Symbol, ...]
    given: tuple[Symbol, ...]
    wanted: tuple[Expr, ...]


def polar_shape(mode: CompiledMode, entry: ModeState, contacts: Sequence[Contact]) -> PolarShape:
    """The same for a mode in which some contacts begin to slip.

    Args:
        contacts: of the automaton.
    """
    starting = tuple(sorted(entry.onset))
    touching = [contacts[i] for i in starting]
    polars = tuple(symbol for contact in touching for symbol in slip_symbols(contact))
    own = tuple(s for s in mode.dynamics.states if s not in polars and s != WORK)
    rates = dict(zip(mode.dynamics.states, mode.dynamics.rates, strict=True))
    slips = [slip for i in starting for slip in mode.slip_changes[2 * i : 2 * i + 2]]
    turning = [mode.sliding_at(contact) for contact in touching]
    return PolarShape(
        starting,
        (*own, WORK),
        polars,
        tuple(s for e in turning for s in (*e.direction, e.slip_speed)),
        (*(rates[s] for s in own), mode.mode.equations.power, *slips),
    )
