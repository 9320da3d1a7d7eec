"""Fits of parameters and start values to a measured motion."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from polhode.base import DeclarationError, NumericError, Shown, extra
from polhode.simulate import Experiment
from polhode.study._columns import Array, Name, published_names, several
from polhode.study._ensemble_runner import Subject
from polhode.study._sensitivity import VariedMotion

_TOLERANCE = 1e-12  # relative change of values and residuals at which a fit has converged


@dataclass(frozen=True)
class Fit(Shown):
    """The values that fit best, in SI units.

    Attributes:
        values: by name.
        uncertainties: one standard deviation of each, from the derivatives at the best fit.
        covariance: of all of them, in the order of `values`.
        residuals: measured less fitted, by quantity, shape (times,).
        scatter: standard deviation of the residuals relative to that of the measurements; where
            that was not given, relative to one, and the uncertainties are scaled by it.
        evaluations: number of motions simulated.
    """

    values: Mapping[str, float]
    uncertainties: Mapping[str, float]
    covariance: Array
    residuals: Mapping[str, Array]
    scatter: float
    evaluations: int


def fit(
    subject: Subject,
    parameters: Mapping[Name, Any],
    start: Mapping[Name, Any],
    times: ArrayLike,
    measured: Mapping[str, ArrayLike],
    *,
    vary: Sequence[Name],
    deviation: Mapping[str, float] | None = None,
    forcing: Mapping[Name, Any] | None = None,
) -> Fit:
    """Fit parameters and start values to a measured motion, by least squares.

    Args:
        subject: a declaration, its automaton, or equations derived from it.
        parameters: the value of every parameter; a first guess for those that vary.
        start: likewise.
        times: of the measurements, s, increasing.
        measured: quantities by published name, SI, shape (times,); not-a-number where missing.
        vary: names to fit: parameters, and coordinates or independent speeds at the start.
        deviation: standard deviation of the measurements of each quantity, SI. Without it, all
            are taken to have the same one, which is estimated from the residuals.
        forcing: prescribed motions: expressions of time, samples, or Python functions.

    Raises:
        DeclarationError: for measurements of different lengths, or unknown names.
        NumericError: where the best fit is not found or not determined.
    """
    when = np.asarray(times, dtype=float)
    data = {name: np.asarray(values, dtype=float) for name, values in measured.items()}
    _check(when, data)
    names = list(published_names(dict.fromkeys(several(vary, "to vary"), 0)))
    measurements = sum(int(np.sum(np.isfinite(values))) for values in data.values())
    if measurements < len(names):
        raise NumericError(
            f"{measurements} measurements for {len(names)} values",
            expected="at least as many measurements as values to fit",
        )
    numbers = (published_names(parameters), published_names(start))
    weights = np.array([[1 / (deviation or {}).get(name, 1.0)] for name in data])
    experiment = Experiment(subject, float(when[-1]), samples=2, forcing=forcing)
    problem = _Problem(
        VariedMotion(experiment, names, list(data)), names, numbers, when, data, weights
    )
    return problem.solved(scaled=deviation is None)


def _check(times: Array, data: Mapping[str, Array]) -> None:
    rising = times.ndim == 1 and len(times) > 0 and np.all(np.diff(times) > 0) and times[0] >= 0
    if not rising or times[-1] <= 0:
        raise DeclarationError("the times of measurements", expected="increasing times, from 0 on")
    for name, values in data.items():
        if values.shape != times.shape:
            raise DeclarationError(
                f"{len(values)} measurements of {name} at {len(times)} times",
                expected="one for every time, not-a-number where it is missing",
            )
    if not data:
        raise DeclarationError("no measurements", expected="at least one quantity")


@dataclass
class _Problem:
    """Weighted residuals of a fit and their derivatives by the fitted values."""

    varied: VariedMotion
    names: list[str]
    numbers: tuple[dict[str, Any], dict[str, Any]]  # parameters and start values
    times: Array
    data: Mapping[str, Array]
    weights: Array
    evaluations: int = 0
    _last: tuple[Array, Array, Array] | None = field(default=None)

    def solved(self, *, scaled: bool) -> Fit:
        with extra("SciPy", "study"):
            from scipy.optimize import least_squares

        guess = self.varied.first_values(*self.numbers)
        size = np.where(guess == 0, 1.0, np.abs(guess))
        # x_scale: values of very different size, such as a mass and a moment of inertia
        best = least_squares(
            self._residual, guess, self._slopes, method="lm", x_scale=size,
            xtol=_TOLERANCE, ftol=_TOLERANCE, gtol=_TOLERANCE,
        )  # fmt: skip
        if not best.success:
            raise NumericError(
                "no best fit was found",
                expected="first guesses near enough to the measured motion",
                advice="fit a shorter part of the motion first",
            )
        degrees_of_freedom = len(best.fun) - len(self.names)
        chi_squared = best.fun @ best.fun
        scatter = float(np.sqrt(chi_squared / degrees_of_freedom)) if degrees_of_freedom else 0.0
        covariance = self._covariance(best.jac) * (scatter**2 if scaled else 1.0)
        fitted, _ = self._at(best.x)
        values = [float(x) for x in best.x]
        deviations = [float(d) for d in np.sqrt(np.diag(covariance))]
        return Fit(
            values=dict(zip(self.names, values, strict=True)),
            uncertainties=dict(zip(self.names, deviations, strict=True)),
            covariance=covariance,
            residuals={n: v - fitted[i] for i, (n, v) in enumerate(self.data.items())},
            scatter=scatter,
            evaluations=self.evaluations,
        )

    def _covariance(self, slopes: Array) -> Array:
        """The covariance (JᵀJ)⁻¹ of the fitted values, J the derivatives of the residuals."""
        normal = slopes.T @ slopes
        # Scaled to a unit diagonal, so that its rank does not depend on the units of the values.
        size = np.sqrt(np.diag(normal))
        scaled = normal / np.outer(size, size) if np.all(size > 0) else np.zeros_like(normal)
        if np.linalg.matrix_rank(scaled, tol=1e-10) < len(normal):
            raise NumericError(
                f"the measurements do not determine {', '.join(self.names)} together",
                expected="values whose effects on the measurements differ",
                advice="vary fewer of them, or measure more quantities",
            )
        return np.asarray(np.linalg.inv(scaled) / np.outer(size, size))

    def _at(self, values: Array) -> tuple[Array, Array]:
        # The solver asks for residuals and then for derivatives at the same values.
        if self._last is None or not np.array_equal(self._last[0], values):
            given = dict(zip(self.names, values.tolist(), strict=True))
            parameters, start = self.numbers
            own = {name: given.pop(name) for name in list(given) if name in parameters}
            motion = self.varied.along({**parameters, **own}, {**start, **given}, self.times)
            self._last = (values.copy(), motion.values, motion.slopes)
            self.evaluations += 1
        return self._last[1], self._last[2]

    @property
    def _is_measured(self) -> NDArray[np.bool_]:
        return np.asarray(np.isfinite(np.array(list(self.data.values()))))

    def _residual(self, values: Array) -> Array:
        fitted, _ = self._at(values)
        residual = (fitted - np.array(list(self.data.values()))) * self.weights
        return np.asarray(residual[self._is_measured])

    def _slopes(self, values: Array) -> Array:
        _, slopes = self._at(values)
        weighted = slopes * self.weights[:, :, None]
        return np.asarray(np.moveaxis(weighted, 1, 2)[self._is_measured])
