"""How a motion depends on its parameters and on its start."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from polhode.algebra import Expr, Symbol, as_symbol
from polhode.base import NumericError, Shown, look_up
from polhode.simulate import Dynamics, Event, Experiment, Trajectory, refuse_doubt
from polhode.simulate.batch import ConstantInterval, VariationalEquations
from polhode.study._columns import Array, Name, published_names, several
from polhode.study._differences import Slope, slope
from polhode.study._ensemble_runner import Subject
from polhode.study._extremes import Quantity


@dataclass(frozen=True)
class Sensitivities(Shown):
    """Quantities along a motion, and their derivatives by parameters and start values; all SI.

    Attributes:
        times: s.
        values: by quantity, shape (times,).
        derivatives: by quantity, and by what it is differentiated by, shape (times,).
        errors: what they are uncertain by, likewise: nothing but rounding, told as 0, for motions
            in one contact mode.
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

    Derivatives by a start value hold all other coordinates and independent speeds at the start,
    and the parameters; those by a parameter hold the start. Within one contact mode they obey the
    variational equations. Where a contact slides or changes its mode, and where a support jerks,
    they are extrapolated differences of motions to which the same happens in the same order; at
    the instant of a switch they jump, and their error tells so.

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
        DeclarationError: for a name that is no quantity, parameter or state.
        NumericError: where the motion ends before, or the least change alters what happens to it.
    """
    experiment = Experiment(subject, duration, samples=2, forcing=forcing)
    when = np.asarray([experiment.duration] if times is None else times, dtype=float)
    names = list(published_names(dict.fromkeys(several(by, "to differentiate by"), 0)))
    quantities = several(of, "to differentiate")
    varied = Varied(experiment, names, quantities)
    found = varied.along(published_names(parameters), published_names(start), when)
    told = [_told(quantity) for quantity in quantities]
    by_quantity = [
        {q: dict(zip(names, rows, strict=True)) for q, rows in zip(told, table, strict=True)}
        for table in (found.slopes, found.errors)
    ]
    return Sensitivities(when, dict(zip(told, found.values, strict=True)), *by_quantity)


class Along(NamedTuple):
    """Quantities along a motion.

    Attributes:
        values: shape (quantities, times).
        slopes: their derivatives, shape (quantities, by, times).
        errors: what those are uncertain by, shaped alike.
    """

    values: Array
    slopes: Array
    errors: Array


class Varied:
    """A system whose motions are wanted with their derivatives; compiled for the first of them."""

    def __init__(self, experiment: Experiment, by: Sequence[str], of: Sequence[Quantity]) -> None:
        self._experiment = experiment
        self._by = by
        self._of = of
        self._tangents: VariationalEquations | None = None

    def along(self, parameters: Mapping[Any, Any], start: Mapping[Any, Any], times: Array) -> Along:
        """One motion: by the variational equations, or by differences where modes change."""
        run = self._experiment.run({**parameters}, {**start})
        refuse_doubt(run)
        _refuse_end(run, float(np.max(times)))
        dynamics = run.segments[0].dynamics.without_auxiliary
        known = {s.published: s for s in (*dynamics.parameters, *dynamics.states)}
        by = [look_up(name, known, "parameter or state at the start") for name in self._by]
        if _switches(run, float(np.max(times))):
            return self._differenced(run, times)
        if self._tangents is None:
            of = [_expression(run, quantity) for quantity in self._of]
            self._tangents = VariationalEquations(dynamics, by, of)
        begin = np.array(list(_begin(run, dynamics).values()))
        values, slopes = self._tangents.follow(begin, list(_stretches(run)), times)
        return Along(values, slopes, np.zeros_like(slopes))

    def _differenced(self, run: Trajectory, times: Array) -> Along:
        """Motions to which the same happens in the same order are known to rounding throughout."""
        dynamics = run.segments[0].dynamics.without_auxiliary
        start: dict[Any, Any] = {s.published: x for s, x in _begin(run, dynamics).items()}
        middle = self._read(run, times)
        found = [self._slope(run, middle, start, name, times) for name in self._by]
        return Along(
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
            return self._read(other, times) if _course(other) == _course(run) else None

        found = slope(values, middle, abs(value) or 1.0)
        if found is None:
            raise NumericError(
                f"derivatives by {name} at {value:g}, where the order of events changes",
                expected="a value on one side of such a change",
                advice="differentiate a little above it, or below",
            )
        return found

    def _read(self, run: Trajectory, times: Array) -> Array:
        return np.array([run.evaluate(quantity, times) for quantity in self._of])


def _stretches(run: Trajectory) -> Iterator[ConstantInterval]:
    """As the motion was followed: sampled supports have other coefficients from knot to knot."""
    for segment in run.segments:
        for part in segment.parts:
            yield ConstantInterval(part.begin, part.end, part.constants)


def _begin(run: Trajectory, dynamics: Dynamics) -> dict[Symbol, float]:
    """States at the start."""
    states = [Expr.generator(symbol) for symbol in dynamics.states]
    values = run.segments[0].values(states, np.zeros(1))[:, 0]
    return dict(zip(dynamics.states, values.tolist(), strict=True))


def _switches(run: Trajectory, end: float) -> bool:
    """Whether a contact slides, or changes its mode, or a support jerks, up to a time."""
    slides = any(symbol.published.startswith("slip_") for symbol in run.dynamics.auxiliary)
    return slides or any(0 < event.time <= end for event in _felt(run))


def _course(run: Trajectory) -> list[tuple[str, str | None]]:
    """What happens, in order."""
    return [(event.kind, event.after) for event in _felt(run)]


def _felt(run: Trajectory) -> list[Event]:
    """Events that change the equations or the speeds."""
    inside = (event for event in run.events if event.after is not None)
    return [event for event in inside if event.divides]


def _refuse_end(run: Trajectory, end: float) -> None:
    if run.duration < end:
        raise NumericError(
            f"derivatives up to {end:g} s of a motion that ends at t = {run.duration:.6g} s",
            expected="times within the motion",
            advice="ask for earlier ones",
        )


def _expression(run: Trajectory, quantity: Quantity) -> Expr:
    if isinstance(quantity, str):
        return look_up(quantity, run.quantities, "quantity of this system")
    return Expr.generator(quantity) if isinstance(quantity, Symbol) else quantity


def _told(quantity: Quantity) -> str:
    if isinstance(quantity, str):
        return quantity
    return as_symbol(quantity).published if isinstance(quantity, Symbol) else str(quantity)
