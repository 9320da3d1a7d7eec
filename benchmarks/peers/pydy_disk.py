"""Peer: derive the rolling disk with its contact force, integrate 10 s of it, evaluate the force.

SymPy derives, PyDy generates the right-hand side, SciPy integrates. Nothing is simplified: shared
subexpressions serve the evaluation as well, and `trigsimp` would only add to the time.
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from importlib.metadata import version
from time import perf_counter

import numpy as np
import sympy as sm
from kane import Kane, Motion, solved
from kane_disk import rolling_disk
from pydy.codegen.ode_function_generators import generate_ode_function
from scipy.integrate import odeint, solve_ivp

PARAMETERS = {"m": 0.2, "a": 0.03, "g": 9.81}
CONSTANTS = sm.symbols("m a g", positive=True)
VALUES = np.array([PARAMETERS[c.name] for c in CONSTANTS])
START = np.array([np.deg2rad(80), 0, 0, 0, 1, 40])  # theta, phi, psi, theta_dot, phi_dot, omega_3
TIMES = np.linspace(0, 10, 1000)
TOLERANCE = 1e-13

RightHandSide = Callable[[float, np.ndarray], np.ndarray]


def right_hand_side(kane: Kane, motion: Motion, generator: str) -> RightHandSide:
    """The explicit form with array arguments, which PyDy documents as its fastest."""
    rates = kane.method.kindiffdict()
    kinematics = sm.Matrix([rates[q.diff()] for q in kane.method.q])
    generated = generate_ode_function(
        kinematics.col_join(motion.accelerations),
        list(kane.method.q),
        list(kane.method.u),
        list(CONSTANTS),
        generator=generator,
        constants_arg_type="array",
        time_first=True,
    )
    # The Cython form returns one buffer again and again, and DOP853 keeps what it was given.
    return lambda time, state: generated(time, state, VALUES).copy()


def by_dop853(rhs: RightHandSide) -> np.ndarray:
    span = (TIMES[0], TIMES[-1])
    tight = {"rtol": TOLERANCE, "atol": TOLERANCE}
    return solve_ivp(rhs, span, START, method="DOP853", t_eval=TIMES, **tight).y


def by_odeint(rhs: RightHandSide) -> np.ndarray:
    tight = {"rtol": TOLERANCE, "atol": TOLERANCE, "mxstep": 100_000}
    return odeint(rhs, START, TIMES, tfirst=True, **tight).T


INTEGRATORS = {"DOP853": by_dop853, "odeint": by_odeint}


def contact_force(kane: Kane, motion: Motion, states: np.ndarray) -> np.ndarray:
    arguments = [list(kane.method.q), list(kane.method.u), list(CONSTANTS)]
    force = sm.lambdify(arguments, list(motion.reactions), modules="numpy", cse=True)
    return np.array(force(states[:3], states[3:], VALUES))


def energy(states: np.ndarray) -> np.ndarray:
    m, a, g = VALUES
    theta, _, _, theta_dot, phi_dot, omega_3 = states
    travel = m * a**2 * (omega_3**2 + theta_dot**2)
    turning = m * a**2 / 4 * (theta_dot**2 + (phi_dot * np.sin(theta)) ** 2 + 2 * omega_3**2)
    return (travel + turning) / 2 + m * g * a * np.sin(theta)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--generator", choices=("lambdify", "cython"), default="lambdify")
    parser.add_argument("--integrator", choices=INTEGRATORS, default="DOP853")
    choice = parser.parse_args()

    clock = [perf_counter()]
    kane = rolling_disk()
    motion = solved(kane)
    clock.append(perf_counter())
    rhs = right_hand_side(kane, motion, choice.generator)
    clock.append(perf_counter())
    states = INTEGRATORS[choice.integrator](rhs)
    clock.append(perf_counter())
    force = contact_force(kane, motion, states)
    clock.append(perf_counter())

    energies = energy(states)
    final = states[[0, 3, 4, 5], -1].tolist() + force[:, -1].tolist()
    names = ("theta", "theta_dot", "phi_dot", "omega_3", "F_1", "F_across", "F_z")
    parts = ("derive", "generate", "integrate", "forces")
    document = {
        "energy_error": float(np.max(np.abs(energies / energies[0] - 1))),
        "answer": dict(zip(names, final, strict=True)),
        "parts": dict(zip(parts, np.diff(clock).tolist(), strict=True)),
        "generator": choice.generator,
        "integrator": choice.integrator,
        "versions": {name: version(name) for name in ("pydy", "sympy", "numpy", "scipy")},
    }
    print(json.dumps(document))


if __name__ == "__main__":
    main()
