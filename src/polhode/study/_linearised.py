"""Linear equations of small departures from a steady motion, at numbers, and their eigenvalues."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
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

_ZERO = 1e-11  # relative size below which a derivative at a generic state is zero
_STEADY = 1e-9  # relative size below which a rate is zero
_GENERIC, _ASIDE, _ASIDE_SEED = 2, 1e-2, 20071982  # number of generic states near by, and distance

_CHANGE = 1e-3  # relative change of the parameters
_ROUNDING = 1e-9  # relative size below which a singular value at changed parameters is rounding
_STEPS = 25  # of Newton's method
_SEED = 20071955


# -- exponents that are zero for all parameters ----------------------------------------------------
#
# They belong to departures along a family of steady motions. The size of an exponent does not show
# whether it is zero by structure or just passes through zero; one that is zero at slightly changed
# parameters as well is zero by structure.


def elsewhere(values: Array) -> Array:
    """Values near by, each changed at random by about a thousandth."""
    random = np.random.default_rng(_SEED)
    shares = random.uniform(0.5, 1, len(values)) * random.choice([-1, 1], len(values))
    return np.asarray(values * (1 + _CHANGE * shares))


def steady_near(state: Array, residual: Callable[[Array], tuple[Array, Array]]) -> Array:
    """The steady state nearest to a state, by Newton's method.

    Args:
        state: where to begin.
        residual: gives, at a state, what vanishes for steady motions, and its derivatives.

    Raises `NumericError` where there is none near by.
    """
    found = np.array(state)
    for _ in range(_STEPS):
        left, slopes = residual(found)
        scale = np.max(np.abs(slopes), initial=0.0) * max(1.0, np.max(np.abs(found)))
        if not np.all(np.isfinite(left)) or not np.all(np.isfinite(slopes)):
            break
        if np.max(np.abs(left), initial=0.0) <= _ROUNDING**1.5 * scale:
            return found
        # Steps along directions of small singular values would lead far away: they are left out.
        found = found - np.linalg.lstsq(slopes, left, rcond=_CHANGE**2)[0]
    raise NumericError(
        "no steady motion near this one at other parameters",
        expected="one of a family, on which the exponents that are always zero can be counted",
        advice="look at all eigenvalues",
    )


@dataclass(frozen=True)
class Neutral:
    """How many exponents of a matrix are zero by structure.

    Attributes:
        chain: numbers of independent departures that stay constant, that grow linearly in time
            towards these, that grow as its square, and so on.
    """

    chain: tuple[int, ...]

    @classmethod
    def of(cls, generic: Array) -> Neutral:
        """Count them on a matrix with no accidental zeros."""
        return cls(tuple(_falling(generic)))

    def removed(self, matrix: Array) -> Array:
        """The matrix without the departures that were counted."""
        for count in self.chain:
            *_, directions = np.linalg.svd(matrix)
            rest = directions[: len(matrix) - count]
            matrix = rest @ matrix @ rest.T
        return matrix


def _falling(matrix: Array) -> Iterator[int]:
    while len(matrix):
        _, sizes, directions = np.linalg.svd(matrix)
        kept = int(np.sum(sizes > _ROUNDING * max(sizes[0], np.finfo(float).tiny)))
        if kept == len(matrix):
            return
        yield len(matrix) - kept
        matrix = directions[:kept] @ matrix @ directions[:kept].T


# -- the linear equations --------------------------------------------------------------------------


@dataclass(frozen=True)
class Linearised(Shown):
    """Small departures from a steady motion: d(departure)/dt = matrix @ departure.

    Attributes:
        states: names of the coordinates that matter and are free, and of the independent speeds.
        matrix: shape (states, states); SI.
        nearby: the same matrix at a steady motion near by for slightly different parameters; None
            where no such motion was found. What is zero there too is zero by structure.
    """

    states: tuple[str, ...]
    matrix: Array
    nearby: Array | None = field(default=None, repr=False)

    @cached_property
    def eigenvalues(self) -> NDArray[np.complex128]:
        """Growth rates and angular frequencies, 1/s, in order of decreasing growth rate."""
        return _exponents(self.matrix)

    @property
    def neutral(self) -> int:
        """How many eigenvalues are zero for all values of the parameters.

        They belong to departures along the family of steady motions, such as another speed of
        a wheel that runs straight.

        Raises `NumericError` where no steady motion was found near by to count them on.
        """
        return sum(self._neutral.chain)

    @cached_property
    def exponents(self) -> NDArray[np.complex128]:
        """The eigenvalues without those that are zero for all parameters, in the same order.

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

    Derivatives are exact, by automatic differentiation of the compiled equations. Coordinates that
    nothing depends on are left out, and so are those that closed loops tie to the others.

    Args:
        subject: a declaration, or equations derived from it; one contact mode.
        parameters: the value of every parameter.
        at: coordinates and speeds of the steady motion, given as a start is given to `simulate`.

    Raises:
        ConstraintError: for values that contradict each other or the constraints.
        DeclarationError: for unknown names, and for supports whose motion is prescribed.
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
    largest = np.max(np.abs(slopes)) * max(1.0, np.max(np.abs(state)))
    for i in kept:
        if abs(values[i]) > _STEADY * largest:
            name = dynamics.states[i].derivative().published
            raise NumericError(
                f"a motion that is not steady: {name} = {values[i]:g}",
                expected="constant speeds, and constant coordinates unless nothing depends on them",
                advice="choose a steady state; simulate shows where this one goes",
            )
    loops = _Loops(dynamics, kept, slopes[len(state) :])
    states = tuple(dynamics.states[i].published for i in loops.free)
    nearby = _nearby(dynamics, kept, loops.free, state, elsewhere(given))
    return Linearised(states, loops.reduced(slopes), nearby)


def _with_slopes(dynamics: Dynamics, state: Array, parameters: Array) -> tuple[Array, Array]:
    """Rates of all states and closure conditions of loops, and their derivatives by the states."""
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
    """The states without the coordinates that nothing depends on.

    At a single state a derivative may vanish although the coordinate matters, as for the moment of
    gravity balanced by a spring: so several states are looked at.
    """
    size, coordinates = len(state), len(dynamics.equations.coordinates)
    tables = [_with_slopes(dynamics, state, parameters)[1], *_generic(dynamics, state, parameters)]
    kept = list(range(size))
    while True:
        rows = [*kept, *range(size, len(tables[0]))]
        idle = {
            j
            for j in kept
            if j < coordinates
            and all(np.all(np.abs(t[rows, j]) <= _ZERO * np.max(np.abs(t))) for t in tables)
        }
        if not idle:
            return kept
        kept = [j for j in kept if j not in idle]


def _generic(dynamics: Dynamics, state: Array, parameters: Array) -> Iterator[Array]:
    """Derivatives at states near by, which are not steady."""
    random = np.random.default_rng(_ASIDE_SEED)
    for _ in range(_GENERIC):
        aside = state + _ASIDE * random.uniform(-1, 1, len(state)) * np.maximum(1, np.abs(state))
        with suppress(ArithmeticError, ValueError), np.errstate(all="ignore"):
            slopes = _with_slopes(dynamics, aside, elsewhere(parameters))[1]
            if np.all(np.isfinite(slopes)):
                yield slopes


class _Loops:
    """The kept states that closed loops tie to the others.

    Attributes:
        free: the states that are not tied.
        tied: departures of all kept states for unit departures of the free ones.
    """

    def __init__(self, dynamics: Dynamics, kept: Sequence[int], closures: Array) -> None:
        independent = {s.published for s in dynamics.equations.speeds}
        candidates = sorted(
            kept, key=lambda i: dynamics.states[i].derivative().published in independent
        )
        tied: list[int] = []
        for j in candidates:  # tied if its column is independent of those before it
            if len(tied) < len(closures):
                rank = np.linalg.matrix_rank(closures[:, [*tied, j]], tol=_ZERO)
                tied += [j] if rank > len(tied) else []
        self.free = [i for i in kept if i not in tied]
        self.tied = np.array([[float(i == j) for j in self.free] for i in kept])
        if tied:
            shares = -np.linalg.lstsq(closures[:, tied], closures[:, self.free], rcond=None)[0]
            for i, share in zip(tied, shares, strict=True):
                self.tied[list(kept).index(i)] = share
        self._kept = kept

    def reduced(self, slopes: Array) -> Array:
        """Derivatives of the rates of the free states by the free states."""
        return np.asarray(slopes[np.ix_(self.free, self._kept)] @ self.tied)
