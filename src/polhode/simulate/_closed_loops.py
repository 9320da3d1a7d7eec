"""Closed loops: coordinates that are not given, and configurations in which a loop is singular."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from math import inf, isfinite, pi, remainder
from typing import Any, TypedDict

import numpy as np

from polhode.algebra import Expr, Row, Symbol
from polhode.base import ConstraintError, NumericError
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate._segment import Segment
from polhode.simulate._values import Numbers
from polhode.simulate._zero_gradients import refuse_zero_gradients
from polhode.simulate.integrate._arrays import Array

# The residual over its largest slope estimates the error of the coordinates, in rad or m: a loop
# counts as closed below this. Newton's method ends far below; a loop that cannot close, far above.
_CLOSED = 1e-9
_GUESSES = 40  # starting points of Newton's method, of which the first is zero
# Singular values, of the largest, that count as zero where configurations are compared: a double
# zero such as x² = 0 is found to half of the digits only.
_DOUBLE = 1e-7
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
            singular one does, or the gradient of a constraint vanishes.
    """
    coordinates = dynamics.equations.coordinates
    free = tuple(q for q in coordinates if q not in given)
    if not dynamics.equations.closures:
        places = {q: given.get(q, 0.0) for q in coordinates}
        refuse_zero_gradients(dynamics, places, parameters)
        return places, {q.published: 0.0 for q in free}
    loop = _Loop(dynamics, given, free, parameters)
    found = loop.closed()
    values = {**given, **dict(zip(free, (float(x) for x in found), strict=True))}
    chosen = len(free) > loop.rank(found)
    assumed = {q.published: values[q] for q in free} if chosen else {}
    places = {q: values[q] for q in coordinates}
    refuse_zero_gradients(dynamics, places, parameters)
    _refuse_dead_point(dynamics, places, parameters)
    return places, assumed


def determined_by_loops(
    dynamics: Dynamics, places: Numbers, parameters: Numbers, given: Collection[str] = ()
) -> tuple[Symbol, ...]:
    """Coordinates that follow from the others where the loops are closed.

    Args:
        dynamics: the equations.
        places: all coordinates, of a configuration in which the loops are closed.
        parameters: values.
        given: names of coordinates that are to be chosen, as far as the loops leave them free.
    """
    loop, here = _Loop(dynamics, {}, tuple(places), parameters), np.array(list(places.values()))
    by_name = [(q.published in given, q) for q in reversed(tuple(places))]
    found = list[Symbol]()
    for _, q in sorted(by_name, key=lambda one: one[0]):
        if loop.rank(here, _FOLDED, [*found, q]) > len(found):
            found.append(q)
    return tuple(q for q in places if q in found)


# -- dead points -----------------------------------------------------------------------------------

# Singular values of the loops' Jacobian that count as zero, of the largest: where a motion starts,
# where it cannot be continued, and where it has passed at the distance of a step.
_FOLDED = 1e-9
_NEAR = 1e-3
_PASSED = 0.05


def _refuse_dead_point(dynamics: Dynamics, places: Numbers, parameters: Numbers) -> None:
    """Refuse a configuration in which the loops determine fewer speeds than the equations suppose.

    These are derived for the rank of the loops' Jacobian in general. Where bars lie folded onto
    each other or in line it may be less, and the bodies can move in ways that they leave out.

    Raises:
        ConstraintError: with the configuration.
    """
    loop, here = _Loop(dynamics, {}, tuple(places), parameters), np.array(list(places.values()))
    freedom, usual = loop.freedom(here, _FOLDED)
    expected = len(dynamics.equations.speeds)
    if usual < freedom > expected:
        raise ConstraintError(**_dead_point("at the start", places, freedom, usual))
    if (freedom := _free_motions(dynamics, places, parameters)) > expected:
        raise ConstraintError(
            **_dead_point("at the start", places, freedom, expected, "constraints")
        )


def _free_motions(
    dynamics: Dynamics,
    places: Numbers,
    parameters: Numbers,
    time: float = 0.0,
    smallest: float = _FOLDED,
) -> int:
    """The motions against inertia that all constraints, rolling included, leave in one place.

    Closures alone do not tell: a wheel that rolls may only there be free to turn as well.
    """
    kinetics = getattr(dynamics.equations, "kinetics", None)
    if kinetics is None:
        return 0

    def matrix(rows: Sequence[Row]) -> Array:
        entries = [entry for row in rows for entry in row]
        function = dynamics.program(entries, (*places, *parameters, CLOCK)).function()
        values = _values(function, (*places.values(), *parameters.values(), time), len(entries))
        return values.reshape(len(rows), len(kinetics.all_speeds))

    held = matrix(kinetics.constraint_rows())
    if not np.all(np.isfinite(held)):
        return 0
    _, sizes, directions = np.linalg.svd(held)
    free = directions[np.count_nonzero(sizes > smallest * max(sizes, default=0.0)) :]
    if len(free) <= len(dynamics.equations.speeds):
        return len(free)  # at most: the longer velocities of the bodies are not needed
    moving = matrix(kinetics.moving_rows())
    if not np.all(np.isfinite(moving)):
        return 0
    least = _FOLDED * np.linalg.norm(moving)
    return int(np.linalg.matrix_rank(moving @ free.T, tol=least))


def dead_point(
    dynamics: Dynamics, state: Mapping[Symbol, Any], constants: Array, time: float
) -> NumericError | None:
    """The error for a motion that its constraints no longer determine, if it ends for that reason.

    Args:
        state: where it ends.
        constants: parameters, in the order of the equations.
        time: s.
    """
    places = {q: float(state[q]) for q in dynamics.equations.coordinates if q in state}
    if not dynamics.equations.closures or len(places) < len(dynamics.equations.coordinates):
        return None
    parameters = dict(zip(dynamics.parameters, map(float, constants), strict=True))
    loop, where = _Loop(dynamics, {}, tuple(places), parameters, time), f"at t = {time:.6g} s"
    freedom, usual = loop.freedom(np.array(list(places.values())), _NEAR)
    if freedom > usual:
        return NumericError(**_dead_point(where, places, freedom, usual))
    freedom = _free_motions(dynamics, places, parameters, time, _NEAR)
    if freedom > (usual := len(dynamics.equations.speeds)):
        return dead_point_error(where, places, freedom, usual, "constraints")
    return None


def passed_dead_point(segments: Sequence[Segment]) -> NumericError | None:
    """The error for a motion whose balance is lost, if its loops were singular on the way."""
    for segment in segments:
        for nearest, time, places, usual in _passages(segment.rounded()):
            if nearest <= _PASSED:
                where = f"near t = {time:.4g} s"
                return NumericError(**_dead_point(where, places, usual + 1, usual))
    return None


def _passages(segment: Segment) -> Iterator[tuple[float, float, dict[Symbol, float], int]]:
    """At every step: how singular the loops are, the time, the configuration, the freedom."""
    dynamics, coordinates = segment.dynamics, segment.dynamics.equations.coordinates
    for part in segment.parts if dynamics.equations.closures else ():
        symbols, steps = part.solution.symbols, part.solution.steps
        if not set(coordinates) <= set(symbols):
            continue
        parameters = dict(zip(dynamics.parameters, part.constants.tolist(), strict=True))
        rows = [symbols.index(q) for q in coordinates]
        times = steps[steps <= part.end]
        for time, place in zip(times, part.solution.at(times)[rows].T, strict=True):
            loop = _Loop(dynamics, {}, coordinates, parameters, float(time))
            _, usual = loop.freedom(place, _FOLDED)
            sizes = loop.singular_values(place)
            nearest = float(sizes[len(coordinates) - usual - 1])
            yield nearest, float(time), dict(zip(coordinates, place, strict=True)), usual


class _Words(TypedDict):
    given: str
    expected: str
    advice: str


def dead_point_error(
    where: str, places: Numbers, freedom: int, usual: int, holding: str
) -> NumericError:
    """The error for a motion that meets a configuration in which `holding` leave more freedom."""
    return NumericError(**_dead_point(where, places, freedom, usual, holding))


def _dead_point(
    where: str, places: Numbers, freedom: int, usual: int, holding: str = "closed loops"
) -> _Words:
    """The words for a configuration in which constraints leave more freedom than elsewhere."""
    known = {q.published: value for q, value in places.items() if np.isfinite(value)}
    named = ", ".join(f"{name} = {value:g}" for name, value in known.items())
    return {
        "given": f"a dead point {where} ({named}), where the {holding} leave {freedom} degrees "
        f"of freedom, not {usual} as elsewhere",
        "expected": "a motion that the declaration determines: here motions of different kinds "
        "meet, as they do where bars lie folded onto each other or in line, or where two wheels or "
        "blades hold the same velocity",
        "advice": "start beside it, end the motion before it, or change the lengths; of a "
        "mechanism that moves only because of its special lengths, leave out the redundant bar; "
        "what is held there all the time, declare along axes that do not turn",
    }


def _values(function: Callable[..., Any], arguments: Sequence[float], count: int) -> Array:
    """Values of so many expressions; not-a-number if they are not finite."""
    try:
        return np.array(function(*arguments), dtype=float)
    except (ArithmeticError, ValueError):
        return np.full(count, np.nan)


# -- the loops as functions ------------------------------------------------------------------------


class _Loop:
    """The closures as functions of the free coordinates."""

    def __init__(
        self,
        dynamics: Dynamics,
        given: Numbers,
        free: tuple[Symbol, ...],
        parameters: Numbers,
        time: float = 0.0,
    ) -> None:
        self._closures = dynamics.equations.closures
        self._free = free
        self._given = given
        slopes = [closure.diff(q) for closure in self._closures for q in free]
        places = dynamics.equations.coordinates
        arguments, known = (*places, *parameters, CLOCK), (*parameters.values(), time)

        def of_free(expressions: Sequence[Expr]) -> Callable[[Array], Array]:
            # one order of the arguments, whichever are given: what is compiled serves all loops
            function = dynamics.program(expressions, arguments).function()

            def evaluated(place: Array) -> Array:
                values = {**given, **dict(zip(free, map(float, place), strict=True))}
                return _values(function, (*(values[q] for q in places), *known), len(expressions))

            return evaluated

        self._residual, self._slopes = of_free(self._closures), of_free(slopes)
        self._sides = of_free(dynamics.equations.assumed_positive)

    def closed(self) -> Array:
        """Free coordinates that close the loops, each angle within half a turn of zero.

        Where branches of configurations meet, as where a rhombus is folded flat, the loops
        determine fewer coordinates than elsewhere: such a configuration is only taken if no other
        is found, and likewise one on a side for which the equations were not derived.
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
                complete = self._merit(place) == (True, min(len(self._closures), len(self._free)))
                if complete or len(found) == _CHOICES:
                    break
            tried.append(place)
        if found:
            return self._unwound(max(found, key=self._merit))
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

    def _merit(self, place: Array) -> tuple[bool, int]:
        """Whether it is on the side of the equations, and how many coordinates are determined."""
        return bool(np.all(self._sides(place) > 0)), self.rank(place, _DOUBLE)

    def rank(
        self, place: Array, smallest: float | None = None, among: Sequence[Symbol] | None = None
    ) -> int:
        """How many coordinates the loops determine there.

        Args:
            place: values of the free coordinates.
            smallest: share of the largest singular value that is not rounding.
            among: which coordinates; by default all free ones.
        """
        if not self._free:
            return 0
        if smallest is None:
            smallest = max(len(self._closures), len(self._free)) * float(np.finfo(float).eps)
        return int(np.count_nonzero(self.singular_values(place, among) > smallest))

    def singular_values(self, place: Array, among: Sequence[Symbol] | None = None) -> Array:
        """Of the Jacobian, in terms of the largest there or elsewhere; zero if not finite."""
        columns = [self._free.index(q) for q in (self._free if among is None else among)]
        jacobian = self._jacobian(place)[:, columns]
        elsewhere = self._jacobian(self._general)
        if not np.all(np.isfinite(jacobian)):
            return np.zeros(min(jacobian.shape))
        found = np.linalg.svd(jacobian, compute_uv=False)
        usual = np.linalg.norm(elsewhere[np.isfinite(elsewhere)])
        sizes: Array = found / (max(found[0], usual) or 1.0)
        return sizes

    def freedom(self, place: Array, smallest: float) -> tuple[int, int]:
        """Degrees of freedom that the loops leave there, and in general."""
        ranks = self.rank(place, smallest), self.rank(self._general, _FOLDED)
        return len(place) - ranks[0], len(place) - ranks[1]

    @property
    def _general(self) -> Array:
        """A place at which the loops are not closed, but as independent as they are in general."""
        place: Array = 0.5 + np.sqrt(np.arange(2.0, 2.0 + len(self._free))) % 1.0
        return place

    def _misfit(self, place: Array) -> float:
        slopes = np.max(np.abs(self._jacobian(place)), initial=0.0) if self._free else 1.0
        found = float(np.max(np.abs(self._residual(place))) / (slopes or 1.0))
        return found if isfinite(found) else inf

    def _jacobian(self, place: Array) -> Array:
        return np.reshape(self._slopes(place), (len(self._closures), len(self._free)))

    def _newton(self, place: Array) -> Array:
        """Damped Gauss-Newton steps of least length: halved until the residual falls."""
        for _ in range(_STEPS if self._free else 0):
            residual, slopes = self._residual(place), self._jacobian(place)
            if not (np.all(np.isfinite(residual)) and np.all(np.isfinite(slopes))):
                break
            step = np.linalg.lstsq(slopes, -residual, rcond=1e-12)[0]
            size, now = 1.0, np.linalg.norm(residual)
            while size > 1e-3 and np.linalg.norm(self._residual(place + size * step)) >= now:
                size /= 2
            if size <= 1e-3:
                break
            place = place + size * step
        return place
