"""How large the quantities of a motion are, by unit: what is rounding beside that is zero.

A quantity that vanishes by symmetry is computed as some 1e-17 of the terms that cancel in it. On an
axis of its own, or as a number beside a picture, that would look like a motion.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from polhode.base import LENGTH, MASS, PURE, TIME, Dimension
from polhode.derive import is_angle
from polhode.simulate import Trajectory
from polhode.view._quantities import (
    ENERGY,
    UNITS,
    Array,
    equations_of,
    instants,
    largest,
    quantity,
)

# Terms of size 1 cancel to a few units of 1e-16, and over a long motion to some more.
_ROUNDING = 1e-14
_INSTANTS = 201  # at which sizes are taken
_NAMED = [
    *UNITS.items(),
    (PURE, "rad"),
    (ENERGY, "J"),
    (MASS * LENGTH**2 / TIME, "kg m²/s"),
]
_DISPARATE = 25.0  # ratio of sizes above which quantities do not share an axis
_SPANNED = 1e-9  # from the dimensions of the parameters, within which one is made of them


@dataclass(frozen=True)
class Magnitudes:
    """Sizes in a motion, by SI unit.

    Attributes:
        reached: greatest size of a coordinate, speed or reaction; not of angles, which may have
            gone round many times.
        natural: what parameters alone give, as √(g/a) for rad/s.
    """

    reached: Mapping[str, float]
    natural: Mapping[str, float]

    def without_rounding(self, values: Array, unit: str) -> Array:
        """Values (in the SI unit, of any shape) of which those that are only rounding are zero."""
        known = (self.reached.get(unit, 0.0), self.natural.get(unit, 0.0), _greatest(values))
        shown: Array = np.where(np.abs(values) < _ROUNDING * max(known), 0.0, values)
        return shown


def magnitudes_of(run: Trajectory) -> Magnitudes:
    """Sizes of the coordinates, speeds and reactions of a motion, and of its parameters."""
    equations = equations_of(run)
    t = np.linspace(0.0, run.duration, _INSTANTS)
    names = [s.published for s in (*equations.coordinates, *equations.speeds)]
    reached: dict[str, float] = {}
    for name in (*names, *run.reactions):
        unit = quantity(run, name).unit
        if unit != "rad":
            reached[unit] = max(reached.get(unit, 0.0), _greatest(run.evaluate(name, t)))
    return Magnitudes(reached, _natural(run))


def panels(run: Trajectory, names: Sequence[str], sizes: Magnitudes) -> list[list[str]]:
    """A group of names split into those that can share an axis: one unit, comparable sizes."""
    found: list[list[tuple[str, str, float]]] = []
    for name in names:
        unit, values = quantity(run, name).unit, run.evaluate(name, instants(run))
        size = largest(sizes.without_rounding(values, unit))
        for group in found:
            others = [other for _, _, other in group if other]
            comparable = not size or all(1 / _DISPARATE < size / s < _DISPARATE for s in others)
            if comparable and unit == group[0][1]:
                group.append((name, unit, size))
                break
        else:
            found.append([(name, unit, size)])
    return [[name for name, _, _ in group] for group in found]


def _natural(run: Trajectory) -> dict[str, float]:
    """Products of powers of the parameters with the dimension of each unit, if there are any.

    Of several such products, the geometric mean: the smallest solution of the linear equations
    for the logarithms of a mass, a length and a time.
    """
    equations = equations_of(run)
    known = {
        s.published: d
        for s, d in equations.dimensions.items()
        if d != PURE and not is_angle(equations, s)
    }
    given = {n: abs(float(v)) for n, v in run.parameters.items() if n in known and v}
    exponents = np.array([_exponents(known[name]) for name in given]).reshape(-1, 3)
    inverse = np.linalg.pinv(exponents)
    logs = inverse @ np.log(list(given.values()))
    found = {}
    for dimension, unit in _NAMED:
        powers = _exponents(dimension)
        if np.linalg.norm(powers @ inverse @ exponents - powers) < _SPANNED:
            found[unit] = float(np.exp(powers @ logs))
    return found


def _exponents(dimension: Dimension) -> Array:
    return np.array([float(p) for p in (dimension.mass, dimension.length, dimension.time)])


def _greatest(values: Array) -> float:
    finite = np.abs(values[np.isfinite(values)])
    return float(np.max(finite, initial=0.0))
