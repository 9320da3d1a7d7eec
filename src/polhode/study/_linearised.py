"""Small departures from a steady motion, at numbers: what grows, what dies out, how fast."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import FLOATS, Compiled, Program
from polhode.base import NumericError, Shown
from polhode.derive import Equations, derive
from polhode.model import System
from polhode.simulate import Dynamics, idle_parameters, read_parameters, read_start, smooth_at
from polhode.simulate.many import Dual, duals
from polhode.study._columns import Array, Name

_ZERO = 1e-11  # of the largest derivative: a coordinate on which nothing depends
_STEADY = 1e-9  # of the largest rate that there could be


@dataclass(frozen=True)
class Linearised(Shown):
    """Small departures from a steady motion: d(departure)/dt = matrix @ departure.

    Attributes:
        states: names of the coordinates that matter and are free, and of the independent speeds.
        matrix: shape (states, states); SI.
    """

    states: tuple[str, ...]
    matrix: Array

    @cached_property
    def eigenvalues(self) -> NDArray[np.complex128]:
        """Growth rates and angular frequencies, 1/s; what grows fastest comes first."""
        found = np.linalg.eigvals(self.matrix).astype(complex)
        return found[np.lexsort((-found.imag, -found.real))]


def linearised(
    subject: System | Equations, parameters: Mapping[Name, Any], at: Mapping[Name, Any]
) -> Linearised:
    """The linear equations of small departures from a steady motion.

    Derivatives are exact: every step of the compiled equations carries them along. Coordinates
    that nothing depends on are left out, and those that closed loops tie to the others.

    Args:
        subject: a declaration, or equations derived from it; one contact mode.
        parameters: the value of every parameter.
        at: coordinates and speeds of the steady motion, given as a start is given to `simulate`.

    Raises:
        ConstraintError: for values that contradict each other or the constraints.
        DeclarationError: for names that are not known, and for supports moved in a given way.
        NumericError: for a motion that is not steady, or where the equations are not smooth.
        UnitError: for a value that cannot be read.
    """
    equations = subject if isinstance(subject, Equations) else derive(subject)
    dynamics = Dynamics(equations, {}, idle_parameters(equations, parameters))
    numbers = read_parameters(dynamics, parameters)
    state = read_start(dynamics, at, numbers).state
    dynamics = smooth_at(dynamics, state.tolist(), numbers)
    values, slopes = _with_slopes(dynamics, state, [numbers[s] for s in dynamics.parameters])
    size = len(state)
    kept = _essential(slopes, len(equations.coordinates), size)
    _refuse_unsteady(dynamics, kept, values, slopes, state)
    told = _Loops(dynamics, kept, slopes[size:])
    states = tuple(dynamics.states[i].published for i in told.free)
    return Linearised(states, slopes[np.ix_(told.free, kept)] @ told.tied)


def _with_slopes(
    dynamics: Dynamics, state: Array, parameters: Sequence[float]
) -> tuple[Array, Array]:
    """Rates of all states, then what closes the loops; and their derivatives by the states."""
    wanted = (*dynamics.rates, *dynamics.equations.closures)
    function = _function(dynamics.program(wanted, dynamics.arguments))
    units = np.eye(len(state))
    found = function(*map(Dual, state.tolist(), units), *parameters, 0.0)
    still = np.zeros(len(state))
    pairs = [(n.value, n.slopes) if isinstance(n, Dual) else (n, still) for n in found]
    return np.array([value for value, _ in pairs]), np.array([slopes for _, slopes in pairs])


@lru_cache(maxsize=8)
def _function(program: Program) -> Compiled:
    return program.function(duals(FLOATS))


def _essential(slopes: Array, coordinates: int, size: int) -> list[int]:
    """The states less the coordinates that nothing kept depends on."""
    kept = list(range(size))
    least = _ZERO * np.max(np.abs(slopes))
    while True:
        rows = [*kept, *range(size, len(slopes))]
        idle = {j for j in kept if j < coordinates and np.all(np.abs(slopes[rows, j]) <= least)}
        if not idle:
            return kept
        kept = [j for j in kept if j not in idle]


def _refuse_unsteady(
    dynamics: Dynamics, kept: Sequence[int], values: Array, slopes: Array, state: Array
) -> None:
    largest = np.max(np.abs(slopes)) * max(1.0, np.max(np.abs(state)))
    for i in kept:
        if abs(values[i]) > _STEADY * largest:
            name = dynamics.states[i].derivative().published
            raise NumericError(
                f"a motion that is not steady: {name} = {values[i]:g}",
                expected="speeds, and coordinates on which anything depends, that stay as they are",
                advice="choose the state so that it does; simulate tells where it goes",
            )


class _Loops:
    """Which of the kept states closed loops tie to the others, and how.

    Attributes:
        free: the states that are not tied.
        tied: departures of all kept states for unit departures of the free ones.
    """

    def __init__(self, dynamics: Dynamics, kept: Sequence[int], closures: Array) -> None:
        independent = {s.published for s in dynamics.equations.speeds}
        order = sorted(kept, key=lambda i: dynamics.states[i].derivative().published in independent)
        tied = _pivots(closures, order)
        self.free = [i for i in kept if i not in tied]
        self.tied = np.array([[float(i == j) for j in self.free] for i in kept])
        if tied:
            shares = -np.linalg.lstsq(closures[:, tied], closures[:, self.free], rcond=None)[0]
            for i, share in zip(tied, shares, strict=True):
                self.tied[list(kept).index(i)] = share


def _pivots(rows: Array, columns: Sequence[int]) -> list[int]:
    """Columns that are independent of those before them."""
    found: list[int] = []
    for j in columns:
        if len(found) < len(rows):
            rank = np.linalg.matrix_rank(rows[:, [*found, j]], tol=_ZERO)
            found += [j] if rank > len(found) else []
    return found
