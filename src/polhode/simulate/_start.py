"""Start values: those not given follow from the others, are solved for, or are zero."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import pi, remainder
from typing import Any

import numpy as np

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.base import ConstraintError, NumericError
from polhode.simulate._absolute_values import Instant, sides_at
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate._names import Name, by_name
from polhode.simulate._values import Numbers, evaluate, read_values
from polhode.simulate.integrate._arrays import Array

# -- closed loops: coordinates that are not given are solved for -----------------------------------


# The residual over its largest slope estimates the error of the coordinates, in rad or m: a loop
# counts as closed below this. Newton's method ends far below; a loop that cannot close, far above.
_CLOSED = 1e-9
_GUESSES = 40  # starting points of Newton's method, of which the first is zero
_STEPS = 60  # of Newton's method from each; convergence takes about ten
_CHOICES = 5  # closed configurations that are compared where loops are redundant, or degenerate


def close(
    dynamics: Dynamics, given: Numbers, parameters: Numbers
) -> tuple[dict[Symbol, float], dict[str, float]]:
    """All coordinates at the start, and which of them had to be assumed.

    Without closed loops, coordinates that are not given start at zero. With them they are solved
    for by Newton's method, from zero and then from guesses spread over a turn.

    Raises:
        ConstraintError: where no configuration with the given coordinates closes the loops, or a
            singular one does.
    """
    coordinates = dynamics.equations.coordinates
    free = tuple(q for q in coordinates if q not in given)
    if not dynamics.equations.closures:
        return (
            {q: given.get(q, 0.0) for q in coordinates},
            {q.published: 0.0 for q in free},
        )
    loop = _Loop(dynamics, given, free, parameters)
    found = loop.closed()
    values = {**given, **dict(zip(free, (float(x) for x in found), strict=True))}
    chosen = len(free) > loop.rank(found)
    assumed = {q.published: values[q] for q in free} if chosen else {}
    places = {q: values[q] for q in coordinates}
    _refuse_singular(dynamics, places, parameters)
    return places, assumed


_FOLDED = 1e-9  # of the largest singular value of the loops' Jacobian: one that is rounding


def _refuse_singular(dynamics: Dynamics, places: Numbers, parameters: Numbers) -> None:
    """Refuse a configuration in which the loops determine fewer speeds than the equations suppose.

    These are derived for the rank of the loops' Jacobian in general. Where bars lie folded onto
    each other or in line it may be less, and the bodies can move in ways that they leave out.

    Raises:
        ConstraintError: with the configuration.
    """
    loop = _Loop(dynamics, {}, tuple(places), parameters)
    here = np.array(list(places.values()))
    general = here + 0.5 + np.sqrt(np.arange(2.0, 2.0 + len(here))) % 1.0
    rank, expected = loop.rank(here, _FOLDED), loop.rank(general, _FOLDED)
    freedom, supposed = len(here) - rank, len(dynamics.equations.speeds)
    if rank >= expected or freedom <= supposed:
        return
    named = ", ".join(f"{q.published} = {value:g}" for q, value in places.items())
    raise ConstraintError(
        f"a singular configuration at the start ({named}), where the closed loops leave "
        f"{freedom} degrees of freedom, not {len(here) - expected} as elsewhere",
        expected="a start where motions of different kinds do not meet, as they do where bars lie "
        "folded onto each other or in line",
        advice="start beside it, or in another configuration with the same lengths; of a mechanism "
        "that moves only because of its special lengths, leave out the redundant bar",
    )


class _Loop:
    """The closures as functions of the free coordinates."""

    def __init__(
        self, dynamics: Dynamics, given: Numbers, free: tuple[Symbol, ...], parameters: Numbers
    ) -> None:
        self._closures = dynamics.equations.closures
        self._free = free
        self._given = given
        slopes = [closure.diff(q) for closure in self._closures for q in free]
        self._residual = _of_free(dynamics, self._closures, given, free, parameters)
        self._slopes = _of_free(dynamics, slopes, given, free, parameters)

    def closed(self) -> Array:
        """Free coordinates that close the loops, each angle within half a turn of zero.

        Where branches of configurations meet, as where a rhombus is folded flat, the loops
        determine fewer coordinates than elsewhere: such a configuration is only taken if no other
        is found.
        """
        tried, found = list[Array](), list[Array]()
        # Zero, then points that fill the cube of one turn evenly (Weyl's sequence k √p mod 1).
        primes = np.array([p for p in range(2, 400) if all(p % d for d in range(2, p))])
        slopes = np.sqrt(primes[: len(self._free)]) % 1.0
        for k in range(_GUESSES if self._free else 1):
            guess = 2 * pi * ((k * slopes + 0.5) % 1.0 - 0.5)
            place = self._newton(guess)
            if self._misfit(place) <= _CLOSED:
                found.append(place)
                complete = self.rank(place) == min(len(self._closures), len(self._free))
                if complete or len(found) == _CHOICES:
                    break
            tried.append(place)
        if found:
            return self._unwound(max(found, key=self.rank))
        residual = np.abs(self._residual(min(tried, key=self._misfit)))
        worst = self._closures[int(np.argmax(residual))]
        names = ", ".join(f"{q.published} = {v:g}" for q, v in self._given.items())
        raise ConstraintError(
            f"no configuration with {names or 'these lengths'} closes the loop {worst} = 0",
            expected=f"a residual of zero, not {np.max(residual):.3g} m at best",
            advice="leave out the coordinates that the loop determines, or change the lengths",
        )

    def _unwound(self, place: Array) -> Array:
        """Without the whole turns that leave the loops closed."""
        for i, value in enumerate(place):
            turned = place.copy()
            turned[i] = remainder(value, 2 * pi)
            if self._misfit(turned) <= _CLOSED:
                place = turned
        return place

    def rank(self, place: Array, smallest: float | None = None) -> int:
        """How many coordinates the loops determine there.

        Args:
            place: values of the free coordinates.
            smallest: share of the largest singular value that is not rounding.
        """
        if not self._free:
            return 0
        jacobian = self._jacobian(place)
        known = bool(np.all(np.isfinite(jacobian)))
        return int(np.linalg.matrix_rank(jacobian, rtol=smallest)) if known else 0

    def _misfit(self, place: Array) -> float:
        slopes = np.max(np.abs(self._jacobian(place)), initial=0.0) if self._free else 1.0
        return float(np.max(np.abs(self._residual(place))) / (slopes or 1.0))

    def _jacobian(self, place: Array) -> Array:
        return np.reshape(self._slopes(place), (len(self._closures), len(self._free)))

    def _newton(self, place: Array) -> Array:
        """Damped Gauss-Newton steps of least length: halved until the residual falls."""
        for _ in range(_STEPS if self._free else 0):
            residual = self._residual(place)
            step = np.linalg.lstsq(self._jacobian(place), -residual, rcond=1e-12)[0]
            size, now = 1.0, np.linalg.norm(residual)
            while size > 1e-3 and np.linalg.norm(self._residual(place + size * step)) >= now:
                size /= 2
            if size <= 1e-3:
                break
            place = place + size * step
        return place


def _of_free(
    dynamics: Dynamics,
    expressions: Sequence[Expr],
    given: Numbers,
    free: tuple[Symbol, ...],
    parameters: Numbers,
) -> Callable[[Array], Array]:
    arguments = (*free, *given, *parameters, CLOCK)
    function = dynamics.program(expressions, arguments).function()
    known = (*given.values(), *parameters.values(), 0.0)
    return lambda place: np.array(function(*(float(x) for x in place), *known), dtype=float)


_AGREE = 1e-9  # relative difference up to which start values that depend on each other agree
_INDEPENDENT = 1e-12  # relative size below which a pivot is rounding


@dataclass(frozen=True)
class Start:
    """Where a motion starts.

    Attributes:
        state: values of all states, SI.
        assumed: names and values of what was not given and had to be assumed.
    """

    state: Array
    assumed: Mapping[str, float]


def read_start(dynamics: Dynamics, given: Mapping[Name, Any], parameters: Numbers) -> Start:
    """The state a motion starts from at t = 0.

    Coordinates, speeds, rates of coordinates and dependent speeds may be given in any mixture.

    Raises:
        ConstraintError: for values that contradict each other or the constraints.
        DeclarationError: for an unknown name.
        NumericError: where the equations of motion have no finite solution.
        UnitError: for a value that cannot be read or has the wrong dimension.
    """
    start = unchecked_start(dynamics, given, parameters)
    if dynamics.undecided:
        known = dict(zip(dynamics.states, start.state, strict=True))
        here = Instant(known, list(parameters.values()), 0.0)
        dynamics = dynamics.on(sides_at(dynamics, here))
    check_start(dynamics, start, parameters)
    return start


def unchecked_start(dynamics: Dynamics, given: Mapping[Name, Any], parameters: Numbers) -> Start:
    """The same where the equations themselves may have no finite solution.

    Raises:
        ConstraintError, DeclarationError, NumericError, UnitError: as `read_start`.
    """
    equations = dynamics.equations
    places, values = _values(dynamics, given, parameters)
    configuration, assumed = close(dynamics, places, parameters)
    speeds = _Relations(dynamics, configuration, parameters, values).solution()
    resting = [speed for speed in equations.speeds if speed not in speeds]
    assumed |= dict.fromkeys((speed.published for speed in resting), 0.0)
    state = [configuration[q] for q in equations.coordinates]
    state += [speeds.get(u, 0.0) for u in equations.speeds]
    return Start(np.array(state), assumed)


def configuration_at_start(
    dynamics: Dynamics, given: Mapping[Name, Any], parameters: Numbers
) -> dict[Symbol, float]:
    """The coordinates that a motion starts with, as `read_start` finds them."""
    places, _ = _values(dynamics, given, parameters)
    return close(dynamics, places, parameters)[0]


def _values(
    dynamics: Dynamics, given: Mapping[Name, Any], parameters: Numbers
) -> tuple[dict[Symbol, float], dict[Symbol, float]]:
    """Given values of coordinates, and of speeds and rates."""
    equations = dynamics.equations
    rates = (*equations.kinematics, *equations.dependent)
    names = by_name((*equations.coordinates, *equations.speeds, *rates))
    dimensions = getattr(equations, "dimensions", {})
    values = read_values(given, names, "coordinate or speed", dimensions, parameters)
    places = {symbol: values.pop(symbol) for symbol in equations.coordinates if symbol in values}
    return places, values


class _Relations:
    """Given rates and speeds as linear equations in the independent speeds."""

    def __init__(
        self,
        dynamics: Dynamics,
        configuration: Numbers,
        parameters: Numbers,
        given: Numbers,
    ) -> None:
        self._unknowns = dynamics.equations.speeds
        direct = [symbol for symbol in given if symbol in self._unknowns]
        others = [symbol for symbol in given if symbol not in self._unknowns]
        self._given = {symbol: given[symbol] for symbol in (*direct, *others)}
        function = dynamics.function([Expr.generator(symbol) for symbol in self._given])
        fixed = list(configuration.values())

        def at(speeds: Array) -> Array:
            with np.errstate(all="ignore"):
                values = function(*np.array([*fixed, *speeds, *parameters.values(), 0.0]))
            return np.array(values, dtype=float)

        self._constant = at(np.zeros(len(self._unknowns)))
        # The relations are linear in the speeds: unit speeds, one after the other, give the matrix.
        columns = [at(unit) - self._constant for unit in np.eye(len(self._unknowns))]
        self._matrix = np.reshape(columns, (len(self._unknowns), len(self._given))).T
        finite = np.isfinite(self._constant) & np.isfinite(self._matrix).all(axis=1)
        for symbol, good in zip(self._given, finite, strict=True):
            if not good:
                raise _undefined(symbol, dynamics)

    def solution(self) -> dict[Symbol, float]:
        """Independent speeds that the given values fix, with the others at rest."""
        rows, pivots = self._independent()
        matrix = self._matrix[np.ix_(rows, pivots)]
        right = np.array(list(self._given.values()))[rows] - self._constant[rows]
        found = np.zeros(len(self._unknowns))
        found[pivots] = np.linalg.solve(matrix, right)
        implied = self._constant + self._matrix @ found
        scale = np.abs(self._constant) + np.abs(self._matrix) @ np.abs(found)
        for i, (symbol, value) in enumerate(self._given.items()):
            if abs(value - implied[i]) > _AGREE * max(scale[i], abs(value)):
                names = ", ".join(s.published for k, s in enumerate(self._given) if k in rows)
                cause = f"which follows from {names}" if names else "as the constraints demand"
                raise ConstraintError(
                    f"{symbol.published} = {value:g} at the start contradicts the constraints",
                    expected=f"{float(implied[i]):.12g}, {cause}",
                    advice=f"leave {symbol.published} out, or change the others",
                )
        return {self._unknowns[j]: float(found[j]) for j in pivots}

    def _independent(self) -> tuple[list[int], list[int]]:
        """Linearly independent relations, and the speed that each is solved for.

        Gaussian elimination, with the largest entry of each row as its pivot. Relations stay in
        their order, in which given speeds come first: a rate never replaces one of these.
        """
        rows, pivots = list[int](), list[int]()
        reduced = self._matrix.copy()
        for i, row in enumerate(reduced):
            size = np.max(np.abs(self._matrix[i]), initial=0.0)
            j = int(np.argmax(np.abs(row))) if row.size else 0
            if size == 0.0 or abs(row[j]) <= _INDEPENDENT * size:
                continue
            reduced[i + 1 :] -= np.outer(reduced[i + 1 :, j] / row[j], row)
            rows.append(i)
            pivots.append(j)
        return rows, pivots


def _undefined(symbol: Symbol, dynamics: Dynamics) -> NumericError:
    """The error for a speed or rate that does not follow from the independent speeds."""
    dependent = dynamics.equations.dependent
    rate = dynamics.equations.kinematics.get(symbol)
    follows = rate is not None and any(
        speed in rate.symbols() or value == rate for speed, value in dependent.items()
    )
    if symbol in dependent or follows:
        names = ", ".join(speed.published for speed in dynamics.equations.speeds)
        return NumericError(
            f"the speed {symbol.published}, which does not follow from {names} at the start",
            expected="independent speeds that determine all others there",
            advice=f"keep other speeds: System(..., independent=[...]) with {symbol.published}",
        )
    return NumericError(
        f"{symbol.published} is not defined at the start",
        expected="coordinates where the rates of all angles follow from the speeds",
        advice="start away from the angles at which axes coincide (such as theta = 0)",
    )


def check_start(dynamics: Dynamics, start: Start, parameters: Numbers) -> None:
    """Refuse a start at which the equations do not hold or have no finite solution.

    Raises:
        ConstraintError: for a state on a side for which they were not derived.
        NumericError: for a singular one, or masses and lengths that are impossible.
    """
    point = (*start.state, *parameters.values(), 0.0)
    equations = dynamics.equations
    named = ", ".join(
        f"{symbol.published} = {value:g}"
        for symbol, value in zip(dynamics.states, start.state, strict=True)
        if symbol.kind is SymbolKind.COORDINATE and not symbol.order
    )
    for sign in equations.assumed_positive:
        (value,) = _evaluated(dynamics, [sign], point)
        if not value > 0:
            raise ConstraintError(
                f"{sign} = {value:g} at the start ({named})",
                expected="a positive value, for which the equations were derived",
                advice="start on the other side: by symmetry the motion is the same",
            )
    if not all(np.isfinite(_evaluated(dynamics, dynamics.rates, point))):
        raise NumericError(
            f"the equations of motion have no finite solution at the start ({named})",
            expected="a start away from singular positions, and finite reactions",
            advice="give a value to every angle, away from those at which axes coincide (such as "
            "theta = 0); a brake that its own friction locks has no finite reaction",
        )
    _refuse_cancelled(dynamics, parameters)
    matrix = equations.mass
    if matrix != matrix.T:  # with sliding friction it is not symmetric
        return
    entries = _evaluated(dynamics, [e for row in matrix.rows for e in row], point)
    if np.any(np.linalg.eigvalsh(np.reshape(entries, matrix.shape)) <= 0):
        raise NumericError(
            "the mass matrix is not positive definite at the start",
            expected="positive masses, moments of inertia and lengths",
            advice="check their signs and that none is zero",
        )


# Of the sum of its terms: a difference of parameters that is smaller is their rounding alone.
_CANCELLED = 1e-13


def _refuse_cancelled(dynamics: Dynamics, parameters: Numbers) -> None:
    """Refuse forces over a difference of parameters that is zero but for rounding.

    Raises:
        NumericError: with the difference, such as c − e μ of a brake that locks.
    """
    equations = dynamics.equations
    below = {row.denominator for row in equations.forcing}
    for difference in below:
        terms = list(difference.terms())
        if len(terms) < 2:
            continue
        symbols = [s for s in difference.symbols() if s in parameters]
        if len(symbols) < len(difference.symbols()):
            continue
        known = {s: parameters[s] for s in symbols}
        parts = [abs(evaluate(_term(powers, number), known)) for powers, number in terms]
        if abs(evaluate(difference, known)) <= _CANCELLED * sum(parts):
            raise NumericError(
                f"forces over {difference}, which is zero to rounding with these values",
                expected="values for which it is not, since rounding alone decides on the motion",
                advice="a brake that its own friction locks has no finite reaction",
            )


def _term(powers: Mapping[Any, int], number: Any) -> Expr:
    found = Expr.constant(number)
    for generator, power in powers.items():
        found = found * Expr.generator(generator) ** power
    return found


def _evaluated(dynamics: Dynamics, expressions: Sequence[Expr], point: Sequence[float]) -> Array:
    with np.errstate(all="ignore"):
        return np.array(dynamics.function(expressions)(*np.array(point)), dtype=float)
