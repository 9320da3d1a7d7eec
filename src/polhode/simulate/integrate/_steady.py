"""Motions that begin in equilibrium, to the last digit of where they begin."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from polhode.simulate.integrate._flow import Flow
from polhode.simulate.integrate._stepping import Array

_APART = 1e-6  # of a state, or of one: how far off slopes are measured


@dataclass(frozen=True)
class Constant:
    """A solution that does not change.

    Attributes:
        times: where it begins and ends, s.
        state: all along.
    """

    times: Array
    state: Array
    broken: bool = False

    def at(self, times: Array) -> Array:
        """States, shape (states, times)."""
        return np.repeat(self.state[:, None], len(times), axis=1)


def is_steady(flow: Flow, parameters: Array, state: Array) -> bool:
    """Whether rates of the core are zero but for the rounding of where it is.

    An angle of 90° has no double: the rates of a disk that stands upright are what the last digit
    of that angle makes of them, and in an unstable equilibrium they would grow without limit.
    Rates that are zero need no such care.
    """
    core = flow.core
    size = len(state)
    if flow.degree > 0:
        return False
    apart = _APART * np.maximum(np.abs(state), 1.0)
    columns = np.repeat(state[:, None], size + 1, axis=1)
    columns[:, 1:] += np.diag(apart)
    others = [0.0] * (len(core.program.arguments) - size - len(parameters) - 1)
    with np.errstate(all="ignore"):
        found = core.rates(*columns, *others, *parameters, 0.0)
    rates = np.array([np.broadcast_to(np.asarray(rate, dtype=float), size + 1) for rate in found])
    slopes = np.abs(rates[:, 1:] - rates[:, :1]) / apart
    rounding = slopes @ np.where(state == 0, 0.0, np.spacing(np.abs(state)))
    now = np.abs(rates[:, 0])
    return bool(np.any(now > 0) and np.all(now <= rounding))
