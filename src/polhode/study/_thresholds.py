"""Where steady motions lose stability, as exact curves over the axes of a map."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from polhode.algebra import Expr, Symbol, arrays, compile_program, pi
from polhode.analyse import SteadyMotion, stability, steady
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.study._columns import Array

_QUARTERS = (Fraction(0), Fraction(1, 2), Fraction(1))
_NEAR = 0.1  # of the length of an axis: how far beyond its ends a steady attitude is looked for


@dataclass(frozen=True)
class Threshold:
    """Where a family of steady motions changes between stable and unstable.

    Attributes:
        family: in words.
        condition: positive where it is stable; of the axes and the numbers.
    """

    family: str
    condition: Expr

    def values(self, names: tuple[str, str], numbers: Mapping[str, float], grid: Array) -> Array:
        """The condition over a grid of two quantities, shape (2, …) to (…)."""
        symbols = {s.published: s for s in self.condition.symbols()}
        given = tuple(s for name, s in symbols.items() if name in (*names, *numbers))
        function = compile_program([self.condition], given).function(arrays())
        along = dict(zip(names, grid, strict=True))
        known = [along.get(s.published, numbers.get(s.published)) for s in given]
        with np.errstate(all="ignore"):
            return np.broadcast_to(np.asarray(function(*known)[0], dtype=float), grid.shape[1:])


def thresholds(
    equations: Equations, axes: Mapping[str, Array], numbers: Mapping[str, float]
) -> list[Threshold]:
    """The exact thresholds that are curves over two axes.

    Attitudes that are looked at are 0, π/2 and π, where they are on an axis or the start.

    Args:
        axes: values of two quantities, by name.
        numbers: values of everything else.
    """
    known = {*axes, *numbers, "pi"}
    found: dict[Expr, Threshold] = {}
    for at in _attitudes(equations, axes, numbers):
        try:
            families = steady(equations, at)
        except PolhodeError:
            continue  # it has no steady motions there, or they could not be found
        for family in families:
            for condition in _conditions(family):
                names = {s.published for s in condition.symbols()}
                if names <= known and names & set(axes):
                    found.setdefault(condition, Threshold(str(family), condition))
    return list(found.values())


def _conditions(family: SteadyMotion) -> list[Expr]:
    try:
        return [condition.expression for condition in stability(family).conditions]
    except PolhodeError:
        return []


def _attitudes(
    equations: Equations, axes: Mapping[str, Array], numbers: Mapping[str, float]
) -> Iterator[dict[Symbol | Expr | str, Expr]]:
    for coordinate in equations.coordinates:
        name = coordinate.published
        values = axes.get(name, np.array([numbers[name]]) if name in numbers else np.empty(0))
        if not len(values):
            continue
        low, high = float(np.min(values)), float(np.max(values))
        margin = _NEAR * max(high - low, 1.0)
        for quarter in _QUARTERS:
            if low - margin <= float(quarter) * np.pi <= high + margin:
                yield {coordinate: Expr.constant(quarter) * pi}
