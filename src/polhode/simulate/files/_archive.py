"""A computed motion as plain data: what a file of it holds, and all that is needed to go on."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev

from polhode.base import provenance
from polhode.simulate.integrate._quadrature import resolved
from polhode.simulate.integrate._stepping import Array

_NODES = chebyshev.chebpts1(16)


def _analysis() -> Array:
    """From values at the nodes to coefficients; refined, as the nodes themselves are rounded."""
    values = chebyshev.chebvander(_NODES.astype(np.longdouble), 15)
    rough = np.linalg.inv(values.astype(float))
    return np.asarray(rough + (np.eye(16) - rough @ values) @ rough, dtype=float)


_ANALYSIS = _analysis()
_ROUNDING = 2.0**-50  # of the largest coefficient: what the last ones have of rounding


@dataclass(frozen=True, eq=False)
class ChebyshevPiece:
    """What was integrated in one go, as Chebyshev series between knots.

    Attributes:
        segment: number of the segment of the motion that it belongs to.
        mode: name of the contact mode.
        states: names of the states.
        constants: values of the constants of that stretch, by name.
        steps: where the steps of the integrator begin and end, s.
        knots: ends of the pieces, s, shape (pieces + 1,).
        series: coefficients over each piece, shape (pieces, order, states).
    """

    segment: int
    mode: str
    states: tuple[str, ...]
    constants: Mapping[str, float]
    steps: Array
    knots: Array
    series: Array

    @property
    def begin(self) -> float:
        """s."""
        return float(self.knots[0])

    @property
    def end(self) -> float:
        """s."""
        return float(self.knots[-1])

    def at(self, times: Array) -> Array:
        """The states at some times, shape (states, times)."""
        piece = np.clip(np.searchsorted(self.knots, times, "right") - 1, 0, len(self.knots) - 2)
        left, right = self.knots[piece], self.knots[piece + 1]
        place = (2 * times - left - right) / (right - left)
        return np.asarray(chebyshev.chebval(place, np.moveaxis(self.series[piece], 0, 2), False))


def series_of(states: Callable[[Array], Array], steps: Array) -> tuple[Array, Array]:
    """Knots and Chebyshev series, to rounding, of states that are smooth within each step.

    Args:
        states: at some times, shape (states, times).
        steps: increasing times, s.
    """
    left, right, _ = resolved(states, steps)
    times = (left[:, None] + right[:, None] + (right - left)[:, None] * _NODES) / 2
    values = states(times.ravel())
    values = values.reshape(len(values), len(left), len(_NODES))
    offset = values[:, :, :1]  # taken out, since rounding is relative to what goes in
    series = _without_noise((values - offset) @ _ANALYSIS.T)
    series[:, :, :1] += offset
    return np.append(left, right[-1:]), np.moveaxis(series, 0, 2)


def _without_noise(series: Array) -> Array:
    """Series whose last coefficients, where they are rounding, are nothing."""
    sizes = np.abs(series)
    told = sizes > _ROUNDING * np.max(sizes, axis=2, keepdims=True)
    followed = np.logical_or.accumulate(told[:, :, ::-1], axis=2)[:, :, ::-1]
    return np.where(followed, series, 0.0)


@dataclass(frozen=True, eq=False)
class Sampled:
    """Samples of one quantity.

    Attributes:
        unit: SI, empty for a pure number.
        values: shape (times,).
    """

    unit: str
    values: Array


@dataclass(frozen=True, eq=False)
class Archive:
    """A motion with all it was made of.

    Attributes:
        declaration: document of the system.
        parameters: values by name, in SI units.
        stretches: in order of time.
        events: each by its time, kind and modes.
        times: of the samples, s.
        details: whatever else belongs to it and can be written as JSON.
        origin: schema, versions and seed it was made with.
    """

    declaration: str
    parameters: Mapping[str, float]
    stretches: tuple[ChebyshevPiece, ...]
    events: tuple[Mapping[str, Any], ...]
    times: Array
    details: Mapping[str, Any] = field(default_factory=dict)
    origin: Mapping[str, Any] = field(default_factory=lambda: dict(provenance()))
