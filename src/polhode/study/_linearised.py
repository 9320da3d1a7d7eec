"""Small departures from a steady motion, at numbers: what grows, what dies out, how fast."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import FLOATS, Compiled, Program
from polhode.base import NumericError, Shown
from polhode.derive import Equations, derive
from polhode.model import System
from polhode.simulate import Dynamics, idle_parameters, read_parameters, read_start, smooth_at
from polhode.simulate.batch import Dual, duals
from polhode.study._columns import Array, Name
from polhode.study._neutral import Neutral, elsewhere, steady_near

_ZERO = 1e-11  # of the largest derivative, at states that are nothing special
_STEADY = 1e-9  # of the largest rate that there could be
_GENERIC, _ASIDE, _SEED = 2, 1e-2, 20071982  # states near by, and how far off


@dataclass(frozen=True)
class Linearised(Shown):
    """Small departures from a steady motion: d(departure)/dt = matrix @ departure.

    Attributes:
        states: names of the coordinates that matter and are free, and of the independent speeds.
        matrix: shape (states, states); SI.
        nearby: the same matrix at a steady motion near by for slightly other parameters; none
            where no such motion was found. What is zero there too is zero by structure.
    """

    states: tuple[str, ...]
    matrix: Array
    nearby: Array | None = field(default=None, repr=False)

    @cached_property
    def eigenvalues(self) -> NDArray[np.complex128]:
        """Growth rates and angular frequencies, 1/s; what grows fastest comes first."""
        return _exponents(self.matrix)

    @property
    def neutral(self) -> int:
        """How many eigenvalues are zero whatever the parameters are.

        They belong to departures along the family of steady motions, such as another speed of
        a wheel that runs straight.

        Raises `NumericError` where no steady motion was found near by to count them on.
        """
        return sum(self._neutral.chain)

    @cached_property
    def exponents(self) -> NDArray[np.complex128]:
        """The eigenvalues less those that are zero whatever the parameters are, in the same order.

        The rest decides on stability: where the largest real part changes sign, so does stability,
        also where the eigenvalue that changes sign passes through zero.

        Raises `NumericError` where no steady motion was found near by to tell them apart on.
        """
        return _exponents(self._neutral.removed(self.matrix))

    @cached_property
    def _neutral(self) -> Neutral:
        if self.nearby is None:
            raise NumericError(
                "the exponents that are zero by structure, with no steady motion near by at "
                "slightly other parameters",
                expected="a family of steady motions, to count them on",
                advice="look at all eigenvalues",
            )
        return Neutral.of(self.nearby)


def _exponents(matrix: Array) -> NDArray[np.complex128]:
    found = np.linalg.eigvals(matrix).astype(complex)
    return found[np.lexsort((-found.imag, -found.real))]


def linearise(
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
    given = np.array([numbers[s] for s in dynamics.parameters])
    kept = _essential(dynamics, state, given)
    values, slopes = _with_slopes(dynamics, state, given)
    _refuse_unsteady(dynamics, kept, values, slopes, state)
    loops = _Loops(dynamics, kept, slopes[len(state) :])
    states = tuple(dynamics.states[i].published for i in loops.free)
    nearby = _nearby(dynamics, kept, loops.free, state, elsewhere(given))
    return Linearised(states, loops.reduced(slopes), nearby)


def _with_slopes(dynamics: Dynamics, state: Array, parameters: Array) -> tuple[Array, Array]:
    """Rates of all states, then what closes the loops; and their derivatives by the states."""
    wanted = (*dynamics.rates, *dynamics.equations.closures)
    function = _function(dynamics.program(wanted, dynamics.arguments))
    units = np.eye(len(state))
    found = function(*map(Dual, state.tolist(), units), *parameters.tolist(), 0.0)
    still = np.zeros(len(state))
    pairs = [(n.value, n.slopes) if isinstance(n, Dual) else (n, still) for n in found]
    return np.array([value for value, _ in pairs]), np.array([slopes for _, slopes in pairs])


def _nearby(
    dynamics: Dynamics, kept: Sequence[int], free: Sequence[int], state: Array, parameters: Array
) -> Array | None:
    """The matrix at a steady motion near by at other parameters."""
    size = len(state)
    rows = [*kept, *range(size, size + len(dynamics.equations.closures))]

    def residual(changed: Array) -> tuple[Array, Array]:
        whole = np.array(state)
        whole[kept] = changed
        values, slopes = _with_slopes(dynamics, whole, parameters)
        return values[rows], slopes[np.ix_(rows, kept)]

    try:
        found = np.array(state)
        found[kept] = steady_near(state[kept], residual)
        _, slopes = _with_slopes(dynamics, found, parameters)
    except (NumericError, ArithmeticError, ValueError):
        return None
    loops = _Loops(dynamics, kept, slopes[size:])
    return loops.reduced(slopes) if loops.free == free else None


@lru_cache(maxsize=8)
def _function(program: Program) -> Compiled:
    return program.function(duals(FLOATS))


def _essential(dynamics: Dynamics, state: Array, parameters: Array) -> list[int]:
    """The states less the coordinates that nothing kept depends on.

    At one state a derivative may vanish although the coordinate matters, as that of gravity's
    moment does where a spring balances it: all of them are looked at.
    """
    size, coordinates = len(state), len(dynamics.equations.coordinates)
    tables = [_with_slopes(dynamics, state, parameters)[1], *_generic(dynamics, state, parameters)]
    kept = list(range(size))
    while True:
        rows = [*kept, *range(size, len(tables[0]))]
        idle = {j for j in kept if j < coordinates and all(_is_idle(t, rows, j) for t in tables)}
        if not idle:
            return kept
        kept = [j for j in kept if j not in idle]


def _is_idle(slopes: Array, rows: Sequence[int], column: int) -> bool:
    return bool(np.all(np.abs(slopes[rows, column]) <= _ZERO * np.max(np.abs(slopes))))


def _generic(dynamics: Dynamics, state: Array, parameters: Array) -> Iterator[Array]:
    """Derivatives at states near by, which are not steady."""
    random = np.random.default_rng(_SEED)
    for _ in range(_GENERIC):
        aside = state + _ASIDE * random.uniform(-1, 1, len(state)) * np.maximum(1, np.abs(state))
        with suppress(ArithmeticError, ValueError), np.errstate(all="ignore"):
            slopes = _with_slopes(dynamics, aside, elsewhere(parameters))[1]
            if np.all(np.isfinite(slopes)):
                yield slopes


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
        self._kept = kept

    def reduced(self, slopes: Array) -> Array:
        """Derivatives of the rates of the free states by these alone."""
        return np.asarray(slopes[np.ix_(self.free, self._kept)] @ self.tied)


def _pivots(rows: Array, columns: Sequence[int]) -> list[int]:
    """Columns that are independent of those before them."""
    found: list[int] = []
    for j in columns:
        if len(found) < len(rows):
            rank = np.linalg.matrix_rank(rows[:, [*found, j]], tol=_ZERO)
            found += [j] if rank > len(found) else []
    return found
