"""Textbook equations of motion written by hand, and their numerical integration."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp

from polhode.analyse.closed._closed_form import ClosedForm

Rates = Callable[[Any, Sequence[Any]], Sequence[Any]]


def integrated(rates: Rates, start: Sequence[float], times: Sequence[float]) -> np.ndarray:
    """The state at times, one row for each, by DOP853 at its tightest."""
    times = np.asarray(times, dtype=float)
    found = solve_ivp(
        rates, (0.0, times[-1]), start, "DOP853", times, rtol=3e-14, atol=1e-14, max_step=np.inf
    )
    assert found.success
    return found.y.T


def slopes(motion: ClosedForm, at: str) -> tuple[dict[str, object], dict[str, object]]:
    """Quantities at a time, and their derivatives by differences correct to 40 digits.

    The motion must be one of 50 digits or more, which carries as many to spare.
    """
    context = motion.data.context
    time, step = context.mpf(at), context.mpf(10) ** -25
    before, after = motion.at(time - step), motion.at(time + step)
    return motion.at(time), {name: (after[name] - before[name]) / (2 * step) for name in after}


def assert_obeys(motion: ClosedForm, rates: Rates, names: Sequence[str], at: str) -> None:
    """To 35 digits at t = 0 and at a time, and in doubles at both to rounding.

    No error of an integration comes in, which near a separatrix would hide everything. The motion
    must be one of 50 digits, and the constants in `rates` mpmath numbers; `at` is some binary
    fraction.
    """
    start = {symbol.published: motion.data.number(v) for symbol, v in motion.data.values.items()}
    begun = motion.at(0)
    for name in names:
        assert abs(begun[name] - start[name]) < 1e-40 * (1 + abs(start[name]))
    now, slope = slopes(motion, at)
    for name, rate in zip(names, rates(0, [now[name] for name in names]), strict=True):
        assert abs(slope[name] - rate) < 1e-35 * (1 + abs(rate))
    rounded = replace(motion, digits=None)
    for time, exact in (("0", begun), (at, now)):
        found = rounded.at(float(time))
        for name in names:
            size = 1 + abs(float(exact[name]))
            assert abs(found[name] - float(exact[name])) < 2e-12 * size, name


def euler(I_1: float, I_2: float, I_3: float) -> Rates:
    """Euler's equations without torque."""
    return lambda t, w: (
        (I_2 - I_3) / I_1 * w[1] * w[2],
        (I_3 - I_1) / I_2 * w[2] * w[0],
        (I_1 - I_2) / I_3 * w[0] * w[1],
    )


def top(kappa: float, mu: float, n: float) -> Rates:
    """Symmetric top: θ, θ̇, φ, φ̇, ψ, from the conservation of both momenta (Goldstein, 5.7)."""

    def rates(t: float, y: np.ndarray) -> Sequence[float]:
        theta, theta_dot, _, phi_dot, _ = y
        sin, cos = _sin(theta), _cos(theta)
        return (
            theta_dot,
            sin * (phi_dot**2 * cos - kappa * n * phi_dot + mu),
            phi_dot,
            theta_dot * (kappa * n - 2 * phi_dot * cos) / sin,
            n - phi_dot * cos,
        )

    return rates


def coin(a: float, g: float, n: float) -> Rates:
    """Uniform thin disk on a smooth table: θ, θ̇, φ, φ̇, ψ (equation 24, with the lift of 16)."""

    def rates(t: float, y: np.ndarray) -> Sequence[float]:
        theta, theta_dot, _, phi_dot, _ = y
        sin, cos = _sin(theta), _cos(theta)
        pull = sin * (phi_dot**2 * cos - 2 * n * phi_dot) - 4 * g * cos / a
        return (
            theta_dot,
            (pull + 4 * theta_dot**2 * sin * cos) / (1 + 4 * cos**2),
            phi_dot,
            2 * theta_dot * (n - phi_dot * cos) / sin,
            n - phi_dot * cos,
        )

    return rates


def gyrocompass(ratio: float, Omega: float, colatitude: float) -> Rates:
    """Free rotor on the turning Earth: θ, θ̇, ω (equation 72, all orders in Ω)."""
    across = Omega * _sin(colatitude)

    def rates(t: float, y: np.ndarray) -> Sequence[float]:
        theta, theta_dot, omega = y
        pull = (1 - ratio) * across * _cos(theta) - ratio * omega
        return theta_dot, across * _sin(theta) * pull, across * theta_dot * _sin(theta)

    return rates


def _sin(x: Any) -> Any:
    return x.context.sin(x) if hasattr(x, "context") else np.sin(x)


def _cos(x: Any) -> Any:
    return x.context.cos(x) if hasattr(x, "context") else np.cos(x)
