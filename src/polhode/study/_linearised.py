"""Numerical linearisation about a steady motion, and its eigenvalues."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Compiled, Program, with_jacobian
from polhode.base import NumericError, Shown
from polhode.derive import Equations, derive
from polhode.model import System
from polhode.simulate import Dynamics, idle_parameters, read_parameters, read_start, smooth_at
from polhode.study._columns import Array, Name

# Derivatives are exact to rounding, about 1e-15 times the largest entry; a few cancelling terms
# lose some digits more. Steady states are as good as the start values that were typed.
_ZERO = 1e-11  # relative size below which a derivative at a generic state is zero
_STEADY = 1e-9  # relative size below which a rate is zero
_GENERIC, _ASIDE, _ASIDE_SEED = 2, 1e-2, 20071982  # number of generic states near by, and distance

# A change of 1e-3 moves an accidental zero well above 1e-9, and stays on the same family.
_CHANGE = 1e-3  # relative change of the parameters
_ROUNDING = 1e-9  # relative size below which a singular value at changed parameters is rounding
_STEPS = 25  # of Newton's method
_SEED = 20071955  # fixed, so that results can be repeated


# -- exponents that are zero for all parameters ----------------------------------------------------
#
# They belong to departures along a family of steady motions. At one set of parameters, such an
# exponent cannot be distinguished from one that just passes through zero; one that is also zero at
# slightly changed parameters is zero by structure.


def elsewhere(values: Array) -> Array:
    """Neighbouring values, each changed at random by about a thousandth of itself."""
    random = np.random.default_rng(_SEED)
    # Never by less than half of that: a change near zero would not separate anything.
    shares = random.uniform(0.5, 1, len(values)) * random.choice([-1, 1], len(values))
    return np.asarray(values * (1 + _CHANGE * shares))


def steady_near(state: Array, residual: Callable[[Array], tuple[Array, Array]]) -> Array:
    """The steady state nearest to a state, by Newton's method.

    Args:
        state: first guess.
        residual: returns, at a state, rates that vanish in steady motion, and their derivatives.

    Raises `NumericError` if Newton's method finds none near by.
    """
    near = np.array(state)
    for _ in range(_STEPS):
        left, slopes = residual(near)
        scale = np.max(np.abs(slopes), initial=0.0) * max(1.0, np.max(np.abs(near)))
        if not np.all(np.isfinite(left)) or not np.all(np.isfinite(slopes)):
            break
        if np.max(np.abs(left), initial=0.0) <= _ROUNDING**1.5 * scale:
            return near
        # The derivatives are singular along the family. Dropping small singular values gives the
        # shortest step to the family; keeping them would lead far away along it.
        near = near - np.linalg.lstsq(slopes, left, rcond=_CHANGE**2)[0]
    raise NumericError(
        "no steady motion near this one at slightly different parameters",
        expected="one of a family, on which exponents that are always zero can be counted",
        advice="look at all eigenvalues",
    )


@dataclass(frozen=True)
class Neutral:
    """How many exponents of a matrix are zero by structure.

    Attributes:
        chain: numbers of independent departures that stay constant, grow linearly in time, grow
            as its square, and so on: the Jordan structure of the eigenvalue zero.
    """

    chain: tuple[int, ...]

    @classmethod
    def of(cls, generic: Array) -> Neutral:
        """Count them on a matrix with no accidental zeros.

        The null space is split off repeatedly: eigenvalues of a Jordan block of zeros are
        rounded to the square root of machine precision or worse, singular values are not.
        """
        matrix, chain = generic, list[int]()
        while len(matrix):
            _, sizes, directions = np.linalg.svd(matrix)
            kept = int(np.sum(sizes > _ROUNDING * max(sizes[0], np.finfo(float).tiny)))
            if kept == len(matrix):
                break
            chain.append(len(matrix) - kept)
            matrix = directions[:kept] @ matrix @ directions[:kept].T
        return cls(tuple(chain))

    def removed(self, matrix: Array) -> Array:
        """The matrix without the departures that were counted."""
        for count in self.chain:
            # Right singular vectors are in order of decreasing singular value: the null space is
            # last. Projecting it out leaves the other eigenvalues as they are.
            *_, directions = np.linalg.svd(matrix)
            rest = directions[: len(matrix) - count]
            matrix = rest @ matrix @ rest.T
        return matrix


# -- the linear equations --------------------------------------------------------------------------


@dataclass(frozen=True)
class Linearised(Shown):
    """Small departures from a steady motion: d(departure)/dt = matrix @ departure.

    Attributes:
        states: names of the independent coordinates that matter, and of the independent speeds.
        matrix: shape (states, states); SI.
        nearby: the same matrix at a neighbouring steady motion for slightly different parameters;
            None where none was found. Exponents that are also zero there are zero by structure.
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

        Raises `NumericError` where no neighbouring steady motion was found.
        """
        return sum(self._neutral.chain)

    @cached_property
    def exponents(self) -> NDArray[np.complex128]:
        """The eigenvalues without those that are zero for all parameters, in the same order.

        They decide on stability: it changes where the largest real part changes sign, including
        where a real eigenvalue passes through zero.

        Raises `NumericError` where no neighbouring steady motion was found.
        """
        return _exponents(self._neutral.removed(self.matrix))

    @cached_property
    def _neutral(self) -> Neutral:
        if self.nearby is None:
            raise NumericError(
                "the exponents that are zero by structure, with no steady motion near this one at "
                "slightly different parameters",
                expected="a family of steady motions, on which they can be counted",
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

    Derivatives are exact, by automatic differentiation of the compiled equations. Cyclic
    coordinates are left out, and so are those that closed loops make dependent on the others.

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
    return linearised_about(dynamics, parameters, at)


def linearised_about(
    dynamics: Dynamics, parameters: Mapping[Name, Any], at: Mapping[Name, Any]
) -> Linearised:
    """The same; what is compiled for one motion serves the others of the same dynamics."""
    numbers = read_parameters(dynamics, parameters)
    state = read_start(dynamics, at, numbers).state
    dynamics = smooth_at(dynamics, state.tolist(), numbers)
    given = np.array([numbers[s] for s in dynamics.parameters])
    values, slopes = _with_slopes(dynamics, state, given)
    loops = _Loops.of(dynamics, [slopes, *_generic(dynamics, state, given)])
    # Rates of cyclic coordinates need not vanish: a rolling wheel goes on turning.
    largest = np.max(np.abs(slopes)) * max(1.0, np.max(np.abs(state)))
    for i in loops.free:
        if abs(values[i]) > _STEADY * largest:
            name = dynamics.states[i].derivative().published
            raise NumericError(
                f"a motion that is not steady: {name} = {values[i]:g}",
                expected="constant speeds, and constant coordinates unless nothing depends on them",
                advice="choose a steady state; simulate shows where this one goes",
            )
    states = tuple(dynamics.states[i].published for i in loops.free)
    nearby = _nearby(dynamics, loops, state, elsewhere(given))
    return Linearised(states, loops.reduced(slopes), nearby)


def _with_slopes(dynamics: Dynamics, state: Array, parameters: Array) -> tuple[Array, Array]:
    """Rates of all states and closure conditions of loops, and their derivatives by the states."""
    size = len(state)
    values, slopes = list[float](), list[float]()
    # the program of the rates alone is that by which the start was checked
    for wanted in (dynamics.rates, dynamics.equations.closures):
        program = dynamics.program(wanted, dynamics.arguments)
        found = _with_derivatives(program, size)(*state.tolist(), *parameters.tolist(), 0.0)
        values += found[: len(program.outputs)]
        slopes += found[len(program.outputs) :]
    return np.array(values), np.array(slopes).reshape(len(values), size)


def _nearby(dynamics: Dynamics, loops: _Loops, state: Array, parameters: Array) -> Array | None:
    """The matrix at a neighbouring steady motion for other parameters; None if there is none."""
    kept = [*loops.free, *loops.tied]
    rows = [*loops.free, *range(len(state), len(state) + len(dynamics.equations.closures))]

    def at(changed: Array) -> tuple[Array, Array]:
        whole = np.array(state)
        whole[kept] = changed
        return _with_slopes(dynamics, whole, parameters)

    def residual(changed: Array) -> tuple[Array, Array]:
        values, slopes = at(changed)
        return values[rows], slopes[np.ix_(rows, kept)]

    try:
        return loops.reduced(at(steady_near(state[kept], residual))[1])
    except (NumericError, ArithmeticError, ValueError):
        return None


@lru_cache(maxsize=8)
def _with_derivatives(program: Program, states: int) -> Compiled:
    """The outputs of a program, and their derivatives by its first arguments."""
    return with_jacobian(program, states).function()


def _generic(dynamics: Dynamics, state: Array, parameters: Array) -> Iterator[Array]:
    """Derivatives at neighbouring states, which need not be steady."""
    random = np.random.default_rng(_ASIDE_SEED)
    for _ in range(_GENERIC):
        aside = state + _ASIDE * random.uniform(-1, 1, len(state)) * np.maximum(1, np.abs(state))
        with suppress(ArithmeticError, ValueError), np.errstate(all="ignore"):
            slopes = _with_slopes(dynamics, aside, elsewhere(parameters))[1]
            if np.all(np.isfinite(slopes)):
                yield slopes


@dataclass(frozen=True)
class _Loops:
    """The states that matter, and those that closed loops make dependent on them.

    Attributes:
        free: the independent states, without the coordinates that nothing depends on.
        tied: coordinates that follow from the others.
    """

    free: list[int]
    tied: list[int]

    @classmethod
    def of(cls, dynamics: Dynamics, tables: Sequence[Array]) -> _Loops:
        """Tell them by derivatives at a state and at others near by.

        At a single state a derivative may vanish although the coordinate matters, as where a spring
        just balances the moment of gravity.
        """
        coordinates, size = len(dynamics.equations.coordinates), len(dynamics.states)
        independent = {s.published for s in dynamics.equations.speeds}
        closures = tables[0][size:]

        def matters(j: int, rows: Sequence[int], tables: Sequence[Array]) -> bool:
            return any(np.any(np.abs(t[rows, j]) > _ZERO * np.max(np.abs(t))) for t in tables)

        # The first choice for dependent coordinates are those that no rate depends on, so that
        # loops which move as a whole leave these cyclic; the next, those whose rates are no
        # independent speeds. One is dependent if its column raises the rank of the closures.
        tied: list[int] = []
        for j in sorted(
            range(size),
            key=lambda j: (
                matters(j, range(size), tables),
                dynamics.states[j].derivative().published in independent,
            ),
        ):
            if len(tied) < len(closures):
                rank = np.linalg.matrix_rank(closures[:, [*tied, j]], tol=_ZERO)
                tied += [j] if rank > len(tied) else []
        loops = cls([j for j in range(size) if j not in tied], tied)
        # Repeated: leaving out one coordinate may leave nothing that depends on another.
        while True:
            reduced = [loops.reduced(table) for table in tables]
            rows = range(len(loops.free))
            kept = [
                j for i, j in enumerate(loops.free) if j >= coordinates or matters(i, rows, reduced)
            ]
            if kept == loops.free:
                return loops
            loops = cls(kept, tied)

    def reduced(self, slopes: Array) -> Array:
        """Derivatives of the rates of the free states by the free states."""
        found = slopes[np.ix_(self.free, self.free)]
        if self.tied:
            # C_tied δ_tied + C_free δ_free = 0, solved for the dependent departures
            closures = slopes[slopes.shape[1] :]
            shares = np.linalg.lstsq(closures[:, self.tied], closures[:, self.free], rcond=None)[0]
            found = found - slopes[np.ix_(self.free, self.tied)] @ shares
        return np.asarray(found)
