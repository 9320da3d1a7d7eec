"""Random numbers for the systems, and two velocities of the ball on paper worked by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from .parts import Array

DISK = "m a g I_1 I_3 theta phi psi theta_dot phi_dot omega_3"
TOP = "M a g I_1 I_2 theta phi psi omega_1"
COMPASS = "I_1 I_3 Omega lambda_ theta theta_dot omega"
FREE = "I_1 I_2 I_3 omega_1 omega_2 omega_3 phi theta psi"
BALL = "m a k g x y v_x v_y omega_z"
SHEET = "X Y angle X_dot Y_dot angle_dot X_ddot Y_ddot angle_ddot"
TABLE = "m a I g alpha Omega Omega_dot x_2 x_3 v_2 v_3 omega_1"
PENDULUM = "m_1 m_2 l_1 l_2 g theta_1 theta_2 theta_1_dot theta_2_dot"
FOUR_BAR = "m_1 m_2 m_3 l_1 l_2 l_3 d g branch theta_1 theta_1_dot"
WHEELS = "m I_1 I_3 a b c M J g alpha phi psi_1_dot psi_2_dot"
GIMBALS = "m a g I_1 I_3 C_o A_i B_i C_i theta phi psi theta_dot phi_dot omega_3"
ELLIPSOID = "m g b_1 b_2 b_3 I_1 I_2 I_3 phi theta psi omega_1 omega_2 omega_3"

seeds = pytest.mark.parametrize("seed", range(5))


def draw(names: str, seed: int, **fixed: float) -> dict[str, float]:
    """Every named number at random between 0.5 and 1.2, one in three of the velocities negative."""
    rng = np.random.default_rng(seed)
    values = {name: float(rng.uniform(0.5, 1.2)) for name in names.split()}
    for name in values:
        if name.endswith("_dot") or name.startswith(("omega", "v_")):
            values[name] *= float(rng.choice([1, 1, -1]))
    return values | {k: v for k, v in fixed.items() if k in values}


def near(expected: Any) -> Any:
    return pytest.approx(expected, rel=1e-11, abs=1e-11)


def sheet_velocity(s: dict[str, float]) -> Array:
    """Of the sheet's matter under the ball."""
    away = np.array([s["X"] - s["x"], s["Y"] - s["y"]])
    return np.array([s["X_dot"] + s["angle_dot"] * away[1], s["Y_dot"] - s["angle_dot"] * away[0]])


def sliding_contact(s: dict[str, float]) -> Array:
    """Velocity of the ball's matter at its lowest point."""
    return np.array([s["v_x"] - s["a"] * s["omega_y"], s["v_y"] + s["a"] * s["omega_x"]])
