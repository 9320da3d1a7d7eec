"""How a motion depends on its parameters and on its start."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from polhode.algebra import Expr, Symbol, as_symbol
from polhode.base import NumericError, look_up
from polhode.simulate import Dynamics, Experiment, Trajectory
from polhode.simulate.many import Stretch, Tangents
from polhode.study._block import Subject
from polhode.study._columns import Array, Name, published_names, several
from polhode.study._extremes import Quantity


@dataclass(frozen=True)
class Sensitivities:
    """Quantities along a motion, and their derivatives by parameters and start values; all SI.

    Attributes:
        times: s.
        values: by quantity, shape (times,).
        derivatives: by quantity, and by what it is differentiated by, shape (times,).
    """

    times: Array
    values: Mapping[str, Array]
    derivatives: Mapping[str, Mapping[str, Array]]


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
    """Derivatives of quantities along a motion, by the variational equations.

    Derivatives by a start value hold all other start values and parameters; those by a parameter
    hold the start values.

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
        NumericError: where the motion changes its contact mode: the derivatives jump there.
    """
    experiment = Experiment(subject, duration, samples=2, forcing=forcing)
    when = np.asarray([experiment.duration] if times is None else times, dtype=float)
    names = list(published_names(dict.fromkeys(several(by, "to differentiate by"), 0)))
    quantities = several(of, "to differentiate")
    varied = Varied(experiment, names, quantities)
    values, slopes = varied.along(published_names(parameters), published_names(start), when)
    told = [_told(quantity) for quantity in quantities]
    return Sensitivities(
        times=when,
        values=dict(zip(told, values, strict=True)),
        derivatives={
            q: dict(zip(names, s, strict=True)) for q, s in zip(told, slopes, strict=True)
        },
    )


class Varied:
    """A system whose motions are wanted with their derivatives; compiled for the first of them."""

    def __init__(self, experiment: Experiment, by: Sequence[str], of: Sequence[Quantity]) -> None:
        self._experiment = experiment
        self._by = by
        self._of = of
        self._tangents: Tangents | None = None

    def along(
        self, parameters: Mapping[Any, Any], start: Mapping[Any, Any], times: Array
    ) -> tuple[Array, Array]:
        """Values, shape (quantities, times), and derivatives, shape (quantities, by, times)."""
        run = self._experiment.run({**parameters}, {**start})
        refuse_switching(run, float(np.max(times)))
        dynamics = run.segments[0].dynamics.without_carried
        if self._tangents is None:
            self._tangents = self._compiled(run, dynamics)
        states = [Expr.generator(symbol) for symbol in dynamics.states]
        begin = run.segments[0].values(states, np.zeros(1))[:, 0]
        return self._tangents.follow(begin, list(_stretches(run)), times)

    def _compiled(self, run: Trajectory, dynamics: Dynamics) -> Tangents:
        known = {s.published: s for s in (*dynamics.parameters, *dynamics.states)}
        by = [look_up(name, known, "parameter or state at the start") for name in self._by]
        return Tangents(dynamics, by, [_expression(run, quantity) for quantity in self._of])


def _stretches(run: Trajectory) -> Iterator[Stretch]:
    """As the motion was followed: sampled supports have other coefficients from knot to knot."""
    for segment in run.segments:
        for part in segment.parts:
            yield Stretch(part.begin, part.end, part.constants)


def refuse_switching(run: Trajectory, end: float) -> None:
    """Refuse a motion that changes its contact mode, or slides, up to a time.

    Raises:
        NumericError: with what happens, and when.
    """
    changes = [e for e in run.events if e.before is not None and e.after is not None]
    felt = [e for e in changes if (e.before != e.after or e.kind == "jerk") and e.time <= end]
    told = [f"there is the event {e.kind!r} at t = {e.time:.6g} s" for e in felt]
    if any(symbol.published.startswith("slip_") for symbol in run.dynamics.carried):
        told = ["a contact slides"]
    if run.duration < end:
        told = told or [f"the motion ends at t = {run.duration:.6g} s"]
    if told:
        raise NumericError(
            f"sensitivities where {told[0]}",
            expected="a motion that stays in one contact mode, without sliding",
            advice="end before that time, or difference the results of an ensemble",
        )


def _expression(run: Trajectory, quantity: Quantity) -> Expr:
    if isinstance(quantity, str):
        return look_up(quantity, run.quantities, "quantity of this system")
    return Expr.generator(quantity) if isinstance(quantity, Symbol) else quantity


def _told(quantity: Quantity) -> str:
    if isinstance(quantity, str):
        return quantity
    return as_symbol(quantity).published if isinstance(quantity, Symbol) else str(quantity)
