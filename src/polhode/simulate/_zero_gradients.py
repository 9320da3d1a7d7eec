"""Constraints whose gradient vanishes where a motion starts: they restrain nothing there.

`derive` refuses equations whose gradient vanishes wherever they hold. Others meet such places with
some values of the coordinates or the parameters only: x y = 0 at the origin, cos θ = k for k = 1.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from math import hypot, nan, sqrt

from polhode.base import LENGTH, ConstraintError
from polhode.model import Constraint
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate._values import Numbers

# Length of a gradient that is rounding, of its length elsewhere. Where the equation has a double
# zero, Newton's method finds the place to half of the digits only.
_NOTHING = 1e-7


def refuse_zero_gradients(dynamics: Dynamics, places: Numbers, parameters: Numbers) -> None:
    """Refuse a start at which the gradient of a constraint vanishes.

    Args:
        places: all coordinates.

    Raises:
        ConstraintError: naming the constraint.
    """
    for element in getattr(dynamics.equations.system, "elements", ()):
        if isinstance(element, Constraint):
            _refuse_zero_gradient(element, dynamics, places, parameters)


def _refuse_zero_gradient(
    constraint: Constraint, dynamics: Dynamics, places: Numbers, parameters: Numbers
) -> None:
    gradient = constraint.gradient
    known = {*places, *parameters, CLOCK}
    if not {s for slope in gradient for s in slope.symbols() if s.kind.varies} <= known:
        return  # prescribed functions of time occur
    program = dynamics.program(gradient, (*places, *parameters, CLOCK))

    def size(at: Iterable[float]) -> float:
        try:
            slopes = program.function()(*at, *parameters.values(), 0.0)
        except (ArithmeticError, ValueError):
            return nan
        return hypot(*slopes)

    if size(places.values()) <= _NOTHING * size(_elsewhere(dynamics, places)):
        named = ", ".join(f"{q.published} = {value:g}" for q, value in places.items())
        raise ConstraintError(
            f"{constraint.name!r}: {constraint.equation} = 0, whose gradient vanishes at the start "
            f"({named})",
            expected="an equation whose rate of change restrains the motion there",
            advice="start elsewhere, or write an equation that has a simple zero there: theta = 0 "
            "instead of cos(theta) = 1",
        )


def _elsewhere(dynamics: Dynamics, places: Numbers) -> Iterator[float]:
    """Coordinates of a place that is as special as any other, at distances of the same size."""
    dimensions = getattr(dynamics.equations, "dimensions", {})
    distances = [abs(x) for q, x in places.items() if dimensions.get(q) == LENGTH]
    far = max(distances, default=0.0) or 1.0
    for k, q in enumerate(places):
        yield (0.5 + sqrt(2.0 + k) % 1.0) * (far if dimensions.get(q) == LENGTH else 1.0)
