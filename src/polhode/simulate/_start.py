"""Start values: those not given follow from the others, are solved for, or are zero."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.base import ConstraintError, NumericError
from polhode.model import MISFIT, Element, Limit
from polhode.simulate._absolute_values import Instant, sides_at
from polhode.simulate._closed_loops import close
from polhode.simulate._dynamics import Dynamics
from polhode.simulate._names import Name, by_name
from polhode.simulate._values import Numbers, evaluate, read_values
from polhode.simulate.integrate._arrays import Array

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
            advice=_advice(symbol, dynamics),
        )
    return NumericError(
        f"{symbol.published} is not defined at the start",
        expected="coordinates where the rates of all angles follow from the speeds",
        advice="start away from the angles at which axes coincide (such as theta = 0)",
    )


def _advice(symbol: Symbol, dynamics: Dynamics) -> str:
    """What to do about speeds that do not determine another one."""
    kinetics = getattr(dynamics.equations, "kinetics", None)
    chosen = kinetics.system.speeds if kinetics and symbol not in kinetics.all_speeds else ()
    if not chosen:
        return f"keep other speeds: System(..., independent=[...]) with {symbol.published}"
    names = ", ".join(s.published for s, _ in chosen)
    return (
        f"{names} of speeds={{...}} took its place: choose speeds that determine it there, start "
        "elsewhere, or leave them out"
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
    kinetics = getattr(equations, "kinetics", None)
    elements = kinetics.elements if kinetics is not None else ()
    for element in elements:
        for limit in element.limits:
            (value,) = _evaluated(dynamics, [limit.positive], point)
            if not value > 0:
                raise _beyond(element, limit, named)
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


def _beyond(element: Element, limit: Limit, named: str) -> ConstraintError:
    """The error for a start at which a curved support is not touched at one point."""
    body = element.bodies[0].name
    if limit.kind == MISFIT:
        return ConstraintError(
            f"{body!r} is too large for the hollow it starts in ({named})",
            expected="a body that is more strongly curved than its support where it touches",
            advice="make it smaller, or start it where the support is flatter",
        )
    return ConstraintError(
        f"{body!r} starts where it {limit.kind} on its support ({named})",
        expected=f"{limit.positive} > 0",
        advice="start it elsewhere, or turn the support by axis=...",
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
        terms = list(difference.summands())
        if len(terms) < 2:
            continue
        symbols = [s for s in difference.symbols() if s in parameters]
        if len(symbols) < len(difference.symbols()):
            continue
        known = {s: parameters[s] for s in symbols}
        parts = [abs(evaluate(term, known)) for term in terms]
        if abs(evaluate(difference, known)) <= _CANCELLED * sum(parts):
            raise NumericError(
                f"forces over {difference}, which is zero to rounding with these values",
                expected="values for which it is not, since rounding alone decides on the motion",
                advice="a brake that its own friction locks has no finite reaction",
            )


def _evaluated(dynamics: Dynamics, expressions: Sequence[Expr], point: Sequence[float]) -> Array:
    with np.errstate(all="ignore"):
        return np.array(dynamics.function(expressions)(*np.array(point)), dtype=float)
