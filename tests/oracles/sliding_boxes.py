"""A box that slides on a plane on its four lower corners, which share its weight as springs do.

Newton's and Euler's equations in the plane, with pressures that are an affine function of the place
on the plane; integrated by SciPy's DOP853.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp


@dataclass(frozen=True)
class SlidingBox:
    """A uniform box of sides a, b, c, on a plane tilted by `slope` that falls along −y."""

    m: float
    a: float
    b: float
    c: float
    g: float
    mu: float
    slope: float = 0.0

    def pressures(self, heading: float, velocity: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Normal forces at the corners, and all forces along the plane, shape (4, 2)."""
        arms = self._arms(heading)
        slips = velocity[:2] + velocity[2] * np.stack([-arms[:, 1], arms[:, 0]], axis=1)
        rubbed = -self.mu * slips / np.linalg.norm(slips, axis=1)[:, None]
        # about the axes of the plane through the centre of mass no couple is left over
        rows = np.array(
            [
                np.ones(4),
                arms[:, 1] + self.c / 2 * rubbed[:, 1],
                -arms[:, 0] - self.c / 2 * rubbed[:, 0],
            ]
        )
        affine = np.stack([np.ones(4), *arms.T], axis=1)
        weight = np.array([self.m * self.g * np.cos(self.slope), 0.0, 0.0])
        normal = affine @ np.linalg.solve(rows @ affine, weight)
        return normal, rubbed * normal[:, None]

    def at(self, times: np.ndarray, velocity: tuple[float, float, float]) -> np.ndarray:
        """x, y, heading and their rates, shape (6, times), from a push at the origin."""
        inertia = self.m * (self.a**2 + self.b**2) / 12

        def rates(_: float, state: np.ndarray) -> np.ndarray:
            _, forces = self.pressures(state[2], state[3:])
            arms = self._arms(state[2])
            couple = np.sum(arms[:, 0] * forces[:, 1] - arms[:, 1] * forces[:, 0])
            pulled = np.array([0.0, -self.g * np.sin(self.slope)])
            along = np.sum(forces, axis=0) / self.m + pulled
            return np.array([*state[3:], *along, couple / inertia])

        found = solve_ivp(
            rates,
            (0.0, times[-1]),
            [0.0, 0.0, 0.0, *velocity],
            method="DOP853",
            t_eval=times,
            rtol=1e-13,
            atol=1e-14,
        )
        return np.asarray(found.y)

    def _arms(self, heading: float) -> np.ndarray:
        cosine, sine = np.cos(heading), np.sin(heading)
        turned = np.array([[cosine, -sine], [sine, cosine]])
        corners = [(i * self.a / 2, j * self.b / 2) for i in (1, -1) for j in (1, -1)]
        return np.array(corners) @ turned.T
