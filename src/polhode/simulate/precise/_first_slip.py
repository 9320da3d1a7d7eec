"""The first stretch of slips that begin, in numbers of higher precision."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from polhode.base import NumericError
from polhode.model import Contact
from polhode.simulate._dynamics import CLOCK
from polhode.simulate.contact._hybrid_system import CompiledMode
from polhode.simulate.contact._mode_state import ModeState
from polhode.simulate.contact._slip_onset import polar_shape
from polhode.simulate.integrate._flint import SlipSeries
from polhode.simulate.integrate._number_types import NumberType
from polhode.simulate.integrate._stop_criteria import Stop
from polhode.simulate.precise._precise_piece import PrecisePiece, StateValues


def first_slip(
    mode: CompiledMode,
    entry: ModeState,
    state: StateValues,
    end: Any,
    contacts: Sequence[Contact],
    numbers: NumberType,
) -> PrecisePiece:
    """As far as a power series about its first instant reaches.

    Args:
        mode: sliding.
        entry: with the directions in which slips begin.
        state: at the beginning.
        end: s, at the latest.
        contacts: of the automaton.
        numbers: to compute in.

    Raises:
        NumericError: where no slip grows.
    """
    shape = polar_shape(mode, entry, contacts)
    others = (*mode.dynamics.parameters, CLOCK)
    program = mode.dynamics.program(shape.wanted, (*shape.symbols, *shape.given, *others))
    constants = mode.parameters.tolist()
    begin = entry.place.time
    start = [state[s] for s in shape.symbols]
    angles = [entry.onset[i] for i in shape.starting]
    series = SlipSeries(program, others, numbers, constants, start, angles, begin, end).series()
    if series is None:
        names = ", ".join(contacts[i].name for i in shape.starting)
        raise NumericError(
            f"slip that begins at {names} at t = {float(begin):.9g} s cannot be followed in "
            f"{numbers.name} precision",
            expected="a direction in which it grows steadily",
            advice="compute the motion in doubles, or end it before that time",
        )
    return PrecisePiece((*shape.symbols, *shape.polars), series, constants, Stop.PAUSE, begin)
