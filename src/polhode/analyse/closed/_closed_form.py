"""Closed forms: equations recognised by their structure, and solved from a start."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.analyse._reduced import reduced
from polhode.analyse.closed import (
    _coin,
    _free_body,
    _gyrocompass,
    _heavy_top,
    _marble,
    _pendulum,
    _symmetric,
)
from polhode.analyse.closed._exact_data import Data, exact_data
from polhode.analyse.closed._reals import Array, Digits, DoubleReals, Reals
from polhode.analyse.closed._solution import ExactSolution, Solvable
from polhode.base import ConstraintError, NumericError, Shown
from polhode.derive import Equations, equations_only

# -- quantities that are constant or grow uniformly: ignorable angles, spins, steady motions -------


@dataclass(frozen=True)
class Uniform:
    """Quantities that change at constant rates.

    Attributes:
        values: (at t = 0, rate) of each by published name.
    """

    values: dict[str, tuple[Any, Any]]

    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        """Values at times, s."""
        return {
            name: reals.number(value) + reals.number(rate) * times
            for name, (value, rate) in self.values.items()
        }


@dataclass(frozen=True)
class SteadySolution(ExactSolution):
    """A motion in which only angles change, uniformly."""

    kind = "steady motion"
    period = None

    @property
    def figures(self) -> dict[str, Any]:
        """No characteristic numbers."""
        return {}

    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        """Empty: all quantities are in `Uniform`."""
        return {}


def is_steady(equations: Equations, data: Data) -> bool:
    """Whether every speed and every essential coordinate is constant from this start."""
    system = reduced(equations)
    rates = (*system.rates, *equations.accelerations.values())
    return not any(data.number(rate) for rate in rates)


def uniform(equations: Equations, data: Data, steady: bool) -> Uniform:
    """The quantities that change uniformly on every motion, or on a steady one."""
    still = [s for s in equations.speeds if not equations.accelerations[s.derivative()]]
    if steady:
        still = [*reduced(equations).essential, *equations.speeds]
    zero = data.context.zero
    values = {s.published: (data.number(Expr.generator(s)), zero) for s in still}
    for q in equations.coordinates:
        rate = equations.kinematics[q.derivative()]
        if all(s.kind is SymbolKind.PARAMETER or s in still for s in rate.symbols()):
            values[q.published] = (data.number(Expr.generator(q)), data.number(rate))
    return Uniform(values)


#: Digits of a double, with one for rounding.
_DOUBLE = 17
#: Sensitivities are difference quotients. Their relative step is smaller than the last digit by so
#: many more, as it must be small compared with the distance to a separatrix too.
_FINER = 30
#: Points of a period at which the sensitivity to the state is determined.
_STOPS = 8

_FAMILIES: tuple[Callable[[Equations], Solvable | None], ...] = (
    _free_body.recognise,
    _heavy_top.recognise,
    _coin.recognise,
    _pendulum.recognise,
    _gyrocompass.recognise,
    _marble.recognise,
    _symmetric.recognise,
    _free_body.recognise_in_any_angles,
)


@dataclass(frozen=True, repr=False)
class ClosedForm(Shown):
    """The exact motion from one start.

    Attributes:
        family: the equations as recognised.
        data: exact values of parameters and start.
        solution: its constants, with spare digits.
        uniform: the other quantities, which change uniformly.
        digits: of the values given; None for doubles.
    """

    family: Solvable
    data: Data
    solution: ExactSolution
    uniform: Uniform
    digits: int | None

    @property
    def name(self) -> str:
        """Of the family."""
        return self.family.name

    @property
    def kind(self) -> str:
        """The type of motion within the family, such as "cusps" or "separatrix"."""
        return self.solution.kind

    def latex(self) -> str:
        """LaTeX of the closed form and of its constants in terms of the parameters."""
        parts = [f"{name} = {value.latex()}" for name, value in self.family.parts.items()]
        return r", \quad ".join([self.family.formula, *parts])

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex()}$"

    def __str__(self) -> str:
        repeats = "no period" if self.solution.period is None else f"period {self.period} s"
        return f"{self.name}: {self.kind}, {repeats}"

    __repr__ = __str__

    @cached_property
    def quantities(self) -> tuple[str, ...]:
        """Published names of the quantities that `at` returns."""
        return tuple(self.at(0))

    def at(self, times: Any) -> dict[str, Array]:
        """Coordinates and speeds at times (s, any shape), in SI units and arrays of that shape.

        Doubles are correct to rounding; with `digits`, arrays of mpmath numbers.
        """
        reals = self._reals
        times = reals.array(times)
        return self.solution.at(reals, times) | self.uniform.at(reals, times)

    def besides(self, times: Any) -> dict[str, Array]:
        """Further quantities at times, s, such as the attitude of a free body."""
        reals = self._reals
        return self.solution.besides(reals, reals.array(times))

    @property
    def period(self) -> Any:
        """Of the motion, s.

        Raises `NumericError` on a steady motion and on a separatrix, which have none.
        """
        if self.solution.period is None:
            raise NumericError(
                f"the period of {self.name}: {self.kind}",
                expected="a motion that repeats",
                advice="change the start a little: motions close to this one have a period",
            )
        return self._reals.number(self.solution.period)

    @property
    def figures(self) -> dict[str, Any]:
        """Characteristic numbers of the motion, by name, in SI units."""
        return {name: self._reals.number(v) for name, v in self.solution.figures.items()}

    @cached_property
    def conditioning(self) -> float | None:
        """Largest relative change of the period for a relative change of one datum.

        A relative error ε of the data moves the motion, after n periods, by n · conditioning · ε
        of a period. None where there is no period.
        """
        if self.solution.period is None:
            return None
        return self._sensitivity(self.data, self.data.values)

    @cached_property
    def stepwise_conditioning(self) -> float | None:
        """The same for errors of the state during the motion, as in numerical integration.

        The largest at eight points of a period. Near a separatrix it is far greater, since the
        distance to the separatrix is smallest relative to the state where the motion is fastest.
        """
        period = self.solution.period
        if period is None:
            return None
        digits = Digits(self.data.context)
        stops = digits.array([period * i / _STOPS for i in range(_STOPS)])
        passed = self.solution.at(digits, stops)
        tracks = {s: map(digits.exact, passed[s.published]) for s in self.family.state}
        places = (map(Expr.constant, place) for place in zip(*tracks.values(), strict=True))
        starts = (self.data.changed(dict(zip(tracks, place, strict=True))) for place in places)
        return max(self._sensitivity(start, self.family.state) or 0.0 for start in starts)

    def _sensitivity(self, data: Data, symbols: Iterable[Symbol]) -> float | None:
        period = self.family.solve(data).period
        if period is None:
            return None
        change, largest = Fraction(1, 10 ** (data.digits + _FINER)), 0.0
        for symbol, value in ((s, data.values[s]) for s in symbols if data.values[s]):
            moved = self.family.solve(data.changed({symbol: value * (1 + change)})).period
            relative = float("inf") if moved is None else float(abs(moved / period - 1) / change)
            largest = max(largest, relative)
        return largest

    @cached_property
    def _reals(self) -> Reals:
        return DoubleReals() if self.digits is None else Digits(self.data.context)


def recognise(equations: Equations) -> Solvable:
    """The family of closed forms that the equations belong to, by their structure alone.

    Raises `NumericError` if none is known.
    """
    try:
        is_solved = not equations.functions and bool(equations.accelerations)
    except NumericError:  # too many coupled speeds
        is_solved = False
    for family in _FAMILIES if is_solved else ():
        found = family(equations)
        if found is not None:
            others = (s for s in equations.speeds if s not in found.state)
            if not any(equations.accelerations[s.derivative()] for s in others):
                return found
    raise NumericError(
        f"{equations.system.name} has no closed form that is known here",
        expected=(
            "a free body, a symmetric top, a coin on a smooth table, a pendulum, a gyrocompass "
            "or a marble on a turntable"
        ),
        advice="simulate it",
    )


def closed_form(
    equations: Equations,
    parameters: Mapping[Any, Any],
    start: Mapping[Any, Any],
    digits: int | None = None,
) -> ClosedForm:
    """The exact motion of recognised equations from a start.

    Args:
        equations: derived equations.
        parameters: values by name: SI numbers, text with a unit, or constant expressions.
        start: coordinates and independent speeds at t = 0, as values or expressions of parameters;
            those not given are zero.
        digits: decimal digits of the values; doubles if not given.

    Raises:
        NumericError: where there is no closed form for the system or from this start.
        DeclarationError, UnitError: for values that cannot be read.
        ConstraintError: for a start where an expression assumed to be positive is not.
    """
    equations_only(equations, "the closed form")
    family = recognise(equations)
    data = exact_data(equations, parameters, start, digits or _DOUBLE)
    for sign in equations.assumed_positive:
        value = data.number(sign)
        if value <= 0:
            raise ConstraintError(
                f"{sign} = {float(value):g} at the start",
                expected="a positive value, for which the equations were derived",
                advice="start from the mirror image, by symmetry",
            )
    family.check(data)
    steady = is_steady(equations, data)
    solution = SteadySolution() if steady else family.solve(data)
    return ClosedForm(family, data, solution, uniform(equations, data, steady), digits)
