"""Numbers, start and end of a motion exactly as they were given."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from polhode.algebra import Expr, Symbol
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate._task import InitialState, Task
from polhode.simulate.integrate._number_types import NumberType
from polhode.simulate.precise._exactly import evaluated, exact_value, exact_values, on
from polhode.simulate.precise._precise_start import precise_start

Values = Mapping[Symbol, Any]


@dataclass(frozen=True)
class Given:
    """What was given, in numbers with bits to spare.

    Attributes:
        parameters: the constants.
        start: coordinates and speeds at the start, of the mode in which it was read.
        begun: how it was read.
        context: of mpmath.
    """

    parameters: Values
    start: Values
    begun: InitialState
    context: Any

    def state(self, symbols: tuple[Symbol, ...]) -> dict[Symbol, Any]:
        """Coordinates and speeds of any mode, from those in which the start was read."""
        dynamics = self.begun.dynamics
        parameters = {s: self.parameters[s] for s in dynamics.parameters}
        wanted = [dynamics.lifted.get(s, Expr.generator(s)) for s in symbols]
        program = dynamics.program(wanted, (*self.start, *parameters, CLOCK))
        zero = self.context.mpf(0)
        function = program.function(on(self.context))
        values = function(*self.start.values(), *parameters.values(), zero)
        return dict(zip(symbols, values, strict=True))


def read_exactly(begun: InitialState, known: set[Symbol], task: Task, numbers: NumberType) -> Given:
    """What was given, once it has been read and checked as doubles.

    Args:
        begun: how the start was read.
        known: the parameters.

    Raises:
        ConstraintError: where loops do not close to the precision.
    """
    context = numbers.exact

    def values(given: Mapping[Symbol, Expr]) -> dict[Symbol, Any]:
        return dict(zip(given, evaluated(list(given.values()), {}, context), strict=True))

    exact = exact_values(task.given, known, {})
    parameters = values(exact)
    given = values(exact_values(task.start, _startable(begun.dynamics), exact))
    own = {s: parameters[s] for s in begun.dynamics.parameters}
    start = precise_start(begun.dynamics, begun.start, given, own, context)
    return Given(parameters, start, begun, context)


def exactly(duration: Any, numbers: NumberType) -> Any:
    """A duration, s, with bits to spare."""
    (found,) = evaluated([exact_value(duration, {})], {}, numbers.exact)
    return found


def _startable(dynamics: Dynamics) -> tuple[Symbol, ...]:
    equations = dynamics.equations
    rates = (*equations.kinematics, *equations.dependent)
    return (*equations.coordinates, *equations.speeds, *rates)
