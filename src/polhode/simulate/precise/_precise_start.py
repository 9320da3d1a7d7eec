"""Parameters and start of a motion in any precision, after they have been checked in doubles."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from polhode.algebra import Arithmetic, Compiled, Expr, Symbol, compile_program
from polhode.base import ConstraintError, NumericError
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate._names import Name, by_name
from polhode.simulate._start import Start
from polhode.simulate._task import InitialState, Task
from polhode.simulate._values import given_values
from polhode.simulate.integrate._number_types import NumberType, ratio

# Relative size below which a pivot counts as zero: as in doubles, so that the same relations are
# independent in both.
_INDEPENDENT = 1e-12
_ROUNDS = 20  # of Newton's method, each of which doubles the number of correct digits


def evaluated(constants: Sequence[Expr], context: Any) -> list[Any]:
    """Constant expressions in the numbers of an mpmath context."""
    return list(compile_program(constants, ()).function(on(context))())


def on(context: Any) -> Arithmetic:
    """The arithmetic of an mpmath context, one value at a time."""
    return Arithmetic.of(context, lambda number: ratio(context, number))


Values = Mapping[Symbol, Any]


@dataclass(frozen=True)
class Given:
    """The values given for a motion, in numbers with spare bits.

    Attributes:
        parameters: the constants.
        start: coordinates and speeds at the start, of the mode in which it was read.
        initial: the start in doubles, and the equations it was read in.
        context: of mpmath.
    """

    parameters: Values
    start: Values
    initial: InitialState
    context: Any

    def state(self, symbols: tuple[Symbol, ...]) -> dict[Symbol, Any]:
        """Coordinates and speeds of any mode, from those of the mode of the start."""
        dynamics = self.initial.dynamics
        parameters = {s: self.parameters[s] for s in dynamics.parameters}
        wanted = [dynamics.embedding.get(s, Expr.generator(s)) for s in symbols]
        program = dynamics.program(wanted, (*self.start, *parameters, CLOCK))
        zero = self.context.mpf(0)
        function = program.function(on(self.context))
        values = function(*self.start.values(), *parameters.values(), zero)
        return dict(zip(symbols, values, strict=True))


def read_exactly(
    initial: InitialState, known: set[Symbol], task: Task, numbers: NumberType
) -> Given:
    """The given values in higher precision, after they have been checked in doubles.

    Args:
        initial: the start in doubles, and the equations it was read in.
        known: the parameters.

    Raises:
        ConstraintError: where loops do not close to that precision.
    """
    context = numbers.exact

    def values(given: Mapping[Symbol, Expr]) -> dict[Symbol, Any]:
        return dict(zip(given, evaluated(list(given.values()), context), strict=True))

    exact = _exact(task.given, known, {})
    parameters = values(exact)
    equations = initial.dynamics.equations
    rates = (*equations.kinematics, *equations.dependent)
    given = values(_exact(task.start, (*equations.coordinates, *equations.speeds, *rates), exact))
    own = {s: parameters[s] for s in initial.dynamics.parameters}
    start = precise_start(initial.dynamics, initial.start, given, own, context)
    return Given(parameters, start, initial, context)


def _exact(
    given: Mapping[Name, Any], symbols: Iterable[Symbol], known: Mapping[Symbol, Expr]
) -> dict[Symbol, Expr]:
    names = by_name(symbols)
    return {names[v.name]: v.exact(known) for v in given_values(given).values()}


def precise_start(
    dynamics: Dynamics,
    rough: Start,
    given: Mapping[Symbol, Any],
    parameters: Mapping[Symbol, Any],
    context: Any,
) -> dict[Symbol, Any]:
    """Coordinates and independent speeds at the start.

    Args:
        dynamics: equations in which the start was read.
        rough: the start in doubles.
        given: coordinates, speeds and rates, as numbers of the context.
        parameters: their values, as numbers of the context.
        context: of mpmath.

    Raises:
        ConstraintError: where loops do not close to that precision.
    """
    roughly = dict(zip(dynamics.states, map(context.mpf, rough.state.tolist()), strict=True))
    equations = dynamics.equations
    places = {q: given.get(q, roughly[q]) for q in equations.coordinates}
    if equations.closures:
        places = _closed(dynamics, places, given, parameters, context)
    known = {s: value for s, value in given.items() if s not in places}
    return places | _speeds(dynamics, places, known, parameters, context)


def _closed(
    dynamics: Dynamics,
    places: Mapping[Symbol, Any],
    given: Mapping[Symbol, Any],
    parameters: Mapping[Symbol, Any],
    context: Any,
) -> dict[Symbol, Any]:
    """Coordinates that close the loops: those not given are found by Newton's method."""
    free = [q for q in places if q not in given]
    closures = dynamics.equations.closures
    slopes = [closure.diff(q) for closure in closures for q in free]
    function = _function(dynamics, [*closures, *slopes], (*places, *parameters), context)
    found = dict(places)
    smallest = context.mpf(2) ** (8 - context.prec)
    for _ in range(_ROUNDS):
        values = function(*found.values(), *parameters.values(), 0)
        residuals = list(values[: len(closures)])
        if max(map(abs, residuals)) <= smallest:
            return found
        entries = iter(values[len(closures) :])
        matrix = [[next(entries) for _ in free] for _ in closures]
        rows, pivots = _independent(matrix)
        steps = _solved(context, matrix, residuals, rows, pivots)
        for j, step in zip(pivots, steps, strict=True):
            found[free[j]] -= step
    raise ConstraintError(
        f"loops that close only to {float(max(map(abs, residuals))):.1g} m",
        expected="a start at which they close to the requested precision",
        advice="leave out the coordinates that the loops determine",
    )


def _speeds(
    dynamics: Dynamics,
    places: Mapping[Symbol, Any],
    given: Mapping[Symbol, Any],
    parameters: Mapping[Symbol, Any],
    context: Any,
) -> dict[Symbol, Any]:
    """Independent speeds that the given speeds and rates fix, with the others at rest."""
    unknowns = dynamics.equations.speeds
    ordered = sorted(given, key=lambda symbol: symbol not in unknowns)
    wanted = [Expr.generator(symbol) for symbol in ordered]
    function = _function(dynamics, wanted, (*places, *unknowns, *parameters), context)

    def at(speeds: Sequence[int]) -> list[Any]:
        return list(function(*places.values(), *speeds, *parameters.values(), 0))

    size = len(unknowns)
    constant = at([0] * size)
    columns = [at([int(i == j) for i in range(size)]) for j in range(size)]
    matrix = [[columns[j][i] - constant[i] for j in range(size)] for i in range(len(ordered))]
    rows, pivots = _independent(matrix)
    right = [given[symbol] - c for symbol, c in zip(ordered, constant, strict=True)]
    found = _solved(context, matrix, right, rows, pivots)
    at_rest = dict.fromkeys(unknowns, context.mpf(0))
    return at_rest | {unknowns[j]: value for j, value in zip(pivots, found, strict=True)}


def _function(
    dynamics: Dynamics, wanted: Sequence[Expr], arguments: tuple[Symbol, ...], context: Any
) -> Compiled:
    compiled = dynamics.program(wanted, (*arguments, CLOCK)).function(on(context))

    def function(*values: Any) -> tuple[Any, ...]:
        try:
            return compiled(*map(context.mpf, values))
        except ArithmeticError as error:
            raise NumericError(
                "kinematic relations without a finite value at the start",
                expected="coordinates where they are regular",
                advice="start away from the singular position (such as theta = 0)",
            ) from error

    return function


def _independent(matrix: Sequence[Sequence[Any]]) -> tuple[list[int], list[int]]:
    """Independent rows, and the unknown that each is solved for."""
    reduced = [list(row) for row in matrix]
    rows, pivots = list[int](), list[int]()
    for i, row in enumerate(reduced):
        size = max(map(abs, matrix[i]), default=0)
        j = max(range(len(row)), key=lambda k: abs(row[k]), default=0)
        if not size or abs(row[j]) <= _INDEPENDENT * size:
            continue
        for other in reduced[i + 1 :]:
            share = other[j] / row[j]
            other[:] = [b - share * a for a, b in zip(row, other, strict=True)]
        rows.append(i)
        pivots.append(j)
    return rows, pivots


def _solved(
    context: Any,
    matrix: Sequence[Sequence[Any]],
    right: Sequence[Any],
    rows: list[int],
    pivots: list[int],
) -> list[Any]:
    if not rows:
        return []
    square = context.matrix([[matrix[i][j] for j in pivots] for i in rows])
    return list(context.lu_solve(square, context.matrix([right[i] for i in rows])))
