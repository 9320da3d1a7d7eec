"""How a motion depends on its parameters and on its start."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from polhode.algebra import Expr, Symbol, as_symbol
from polhode.base import NumericError, Shown, look_up
from polhode.simulate import Dynamics, Event, Experiment, Trajectory, refuse_doubt
from polhode.simulate.batch import ConstantInterval, VariationalEquations
from polhode.study._columns import Array, Name, published_names, several
from polhode.study._ensemble_runner import Subject
from polhode.study._output import Quantity

# Where modes change, derivatives are differences of motions, extrapolated to zero difference:
# C. J. F. Ridders, Advances in Engineering Software 4 (1982) 75.
_FIRST = 1e-3  # first difference, relative to the quantity that is varied
_FINER = 4  # each further difference is smaller by this factor
_DIFFERENCES = 6
_ENOUGH = 1e-10  # relative error


class Slope(NamedTuple):
    """A derivative and its uncertainty."""

    value: Array
    error: Array


def slope(values: Callable[[float], Array | None], middle: Array, size: float) -> Slope | None:
    """The derivative of values, element by element, by extrapolated differences.

    Args:
        values: as a function of the difference; None where they cannot be compared.
        middle: values for zero difference.
        size: of the quantity varied; differences are relative to it.

    Returns:
        None if values cannot be compared even for the smallest difference. Where the derivative
        jumps, the mean of both sides with half the jump as its error.
    """
    best: Slope | None = None
    # Central differences [f(h) - f(-h)]/2h, whose error is even in h, and half the difference of
    # the one-sided ones, [f(h) - 2f(0) + f(-h)]/2h, which does not vanish where the derivative
    # jumps. Both are extrapolated to h = 0.
    rising, folded = list[Array](), list[Array]()
    for number in range(_DIFFERENCES):
        step = _FIRST * size / _FINER**number
        ahead, behind = values(step), values(-step)
        if ahead is None or behind is None:
            rising, folded = [], []
            continue
        rising = _extrapolated((ahead - behind) / (2 * step), rising, 2)
        folded = _extrapolated((ahead - 2 * middle + behind) / (2 * step), folded, 1)
        if len(rising) == 1:
            best = best or Slope(rising[0], np.full_like(rising[0], np.inf))
            continue
        error = np.abs(rising[-1] - rising[-2]) + np.abs(folded[-1])
        best = _better(best, Slope(rising[-1], error))
        if np.all(best.error <= _ENOUGH * np.abs(best.value)):
            break
    return best


def _extrapolated(finest: Array, coarser: list[Array], first: int) -> list[Array]:
    """A row of Neville's table, removing the powers first, first + 2, ... of the step."""
    row = [finest]
    for number, coarse in enumerate(coarser):
        row.append(row[-1] + (row[-1] - coarse) / (_FINER ** (2 * number + first) - 1))
    return row


def _better(one: Slope | None, other: Slope) -> Slope:
    """Element by element, the estimate of smaller error."""
    if one is None:
        return other
    surer = other.error < one.error
    return Slope(np.where(surer, other.value, one.value), np.where(surer, other.error, one.error))


@dataclass(frozen=True)
class Sensitivities(Shown):
    """Quantities along a motion, and their derivatives by parameters and start values; all SI.

    Attributes:
        times: s.
        values: by quantity, shape (times,).
        derivatives: by quantity, and by parameter or start value, shape (times,).
        errors: their uncertainties, likewise; 0 for motions in one contact mode, whose derivatives
            are accurate to rounding.
    """

    times: Array
    values: Mapping[str, Array]
    derivatives: Mapping[str, Mapping[str, Array]]
    errors: Mapping[str, Mapping[str, Array]]


def sensitivities(
    subject: Subject,
    parameters: Mapping[Name, Any],
    start: Mapping[Name, Any],
    duration: Any,
    *,
    of: Sequence[Quantity],
    by: Sequence[Name],
    times: ArrayLike | None = None,
    forcing: Mapping[Name, Any] | None = None,
) -> Sensitivities:
    """Derivatives of quantities along a motion.

    A derivative by a start value is taken at constant parameters and all other coordinates and
    independent speeds at the start; one by a parameter, at a constant start. Within one contact
    mode they obey the variational equations. Where a contact slides or changes its mode, and where
    a support's velocity jumps, they are extrapolated differences of motions with the same sequence
    of events; at the instant of a switch they jump, and their error shows it.

    Args:
        subject: a declaration, its automaton, or equations derived from it.
        parameters: the value of every parameter.
        start: coordinates and speeds at the start.
        duration: s.
        of: quantities, by published name or as expressions.
        by: parameters, and coordinates or independent speeds at the start.
        times: s; by default the end.
        forcing: prescribed motions: expressions of time, samples, or Python functions.

    Raises:
        DeclarationError: for a name that is not a quantity, parameter or state.
        NumericError: where the motion ends earlier, or the smallest change alters its events.
    """
    experiment = Experiment(subject, duration, samples=2, forcing=forcing)
    when = np.asarray([experiment.duration] if times is None else times, dtype=float)
    names = list(published_names(dict.fromkeys(several(by, "to differentiate by"), 0)))
    quantities = several(of, "to differentiate")
    varied = VariedMotion(experiment, names, quantities)
    found = varied.along(published_names(parameters), published_names(start), when)
    labels = [_name(quantity) for quantity in quantities]
    by_quantity = [
        {q: dict(zip(names, rows, strict=True)) for q, rows in zip(labels, table, strict=True)}
        for table in (found.slopes, found.errors)
    ]
    return Sensitivities(when, dict(zip(labels, found.values, strict=True)), *by_quantity)


class MotionDerivatives(NamedTuple):
    """Quantities along a motion and their derivatives.

    Attributes:
        values: shape (quantities, times).
        slopes: their derivatives, shape (quantities, by, times).
        errors: of the derivatives, of the same shape.
    """

    values: Array
    slopes: Array
    errors: Array


class VariedMotion:
    """A system simulated with derivatives of its motions; compiles equations for the first."""

    def __init__(self, experiment: Experiment, by: Sequence[str], of: Sequence[Quantity]) -> None:
        self._experiment = experiment
        self._by = by
        self._of = of
        self._tangents: VariationalEquations | None = None

    def first_values(self, parameters: Mapping[Any, Any], start: Mapping[Any, Any]) -> Array:
        """The values that the derivatives are by, SI, as a motion begins with them."""
        run = self._experiment.run({**parameters}, {**start})
        known = {s.published: x for s, x in _initial_states(run, _independent(run)).items()}
        known |= run.parameters
        return np.array([look_up(n, known, "parameter or state at the start") for n in self._by])

    def along(
        self, parameters: Mapping[Any, Any], start: Mapping[Any, Any], times: Array
    ) -> MotionDerivatives:
        """One motion, by the variational equations, or by differences where modes change."""
        run = self._experiment.run({**parameters}, {**start})
        refuse_doubt(run)
        end = float(np.max(times))
        if run.duration < end:
            raise NumericError(
                f"derivatives up to {end:g} s of a motion that ends at t = {run.duration:.6g} s",
                expected="times within the motion",
                advice="choose earlier times",
            )
        dynamics = _independent(run)
        known = {s.published: s for s in (*dynamics.parameters, *dynamics.states)}
        by = [look_up(name, known, "parameter or state at the start") for name in self._by]
        # The variational equations lack the auxiliary states of a sliding contact.
        slides = any(symbol.published.startswith("slip_") for symbol in run.dynamics.auxiliary)
        if slides or any(0 < event.time <= end for event in _dividing_events(run)):
            return self._differenced(run, times)
        if self._tangents is None:
            of = [_expression(run, quantity) for quantity in self._of]
            self._tangents = VariationalEquations(dynamics, by, of)
        begin = np.array(list(_initial_states(run, dynamics).values()))
        # The intervals of the run itself: the coefficients of a sampled support's motion change
        # from knot to knot.
        intervals = [
            ConstantInterval(part.begin, part.end, part.constants)
            for segment in run.segments
            for part in segment.parts
        ]
        values, slopes = self._tangents.follow(begin, intervals, times)
        return MotionDerivatives(values, slopes, np.zeros_like(slopes))

    def _differenced(self, run: Trajectory, times: Array) -> MotionDerivatives:
        """By differences of motions with the same events, which depend smoothly on the start."""
        start: dict[Any, Any] = {
            s.published: x for s, x in _initial_states(run, _independent(run)).items()
        }
        middle = self._read(run, times)
        found = [self._slope(run, middle, start, name, times) for name in self._by]
        return MotionDerivatives(
            middle,
            np.stack([one.value for one in found], axis=1),
            np.stack([one.error for one in found], axis=1),
        )

    def _slope(
        self, run: Trajectory, middle: Array, start: dict[Any, Any], name: str, times: Array
    ) -> Slope:
        given = dict[Any, Any](run.parameters)
        value = float(given[name] if name in given else start[name])

        def values(departure: float) -> Array | None:
            moved = {name: value + departure}
            numbers = given | moved if name in given else given
            begin = start if name in given else start | moved
            other = self._experiment.run(numbers, begin)
            is_alike = _event_sequence(other) == _event_sequence(run)
            return self._read(other, times) if is_alike else None

        found = slope(values, middle, abs(value) or 1.0)
        if found is None:
            raise NumericError(
                f"derivatives by {name} at {value:g}, where the order of events changes",
                expected="a value on one side of the change",
                advice="differentiate at a slightly larger or smaller value",
            )
        return found

    def _read(self, run: Trajectory, times: Array) -> Array:
        return np.array([run.evaluate(quantity, times) for quantity in self._of])


def _independent(run: Trajectory) -> Dynamics:
    """The dynamics at the start, in states that may be chosen."""
    return run.segments[0].dynamics.without_auxiliary


def _initial_states(run: Trajectory, dynamics: Dynamics) -> dict[Symbol, float]:
    """Values of the states at the start."""
    states = [Expr.generator(symbol) for symbol in dynamics.states]
    values = run.segments[0].values(states, np.zeros(1))[:, 0]
    return dict(zip(dynamics.states, values.tolist(), strict=True))


def _event_sequence(run: Trajectory) -> list[tuple[str, str | None]]:
    """Kinds of the events that divide the motion, and the modes after them."""
    return [(event.kind, event.after) for event in _dividing_events(run)]


def _dividing_events(run: Trajectory) -> list[Event]:
    """Events that change the equations or the speeds."""
    inside = (event for event in run.events if event.after is not None)
    return [event for event in inside if event.divides]


def _expression(run: Trajectory, quantity: Quantity) -> Expr:
    if isinstance(quantity, str):
        return look_up(quantity, run.quantities, "quantity of this system")
    return Expr.generator(quantity) if isinstance(quantity, Symbol) else quantity


def _name(quantity: Quantity) -> str:
    if isinstance(quantity, str):
        return quantity
    return as_symbol(quantity).published if isinstance(quantity, Symbol) else str(quantity)
