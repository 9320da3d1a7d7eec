"""A train of trailers on knife edges, as a user would declare it, and the same by hand."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

import polhode as ph


def train(size: int, *, hitch: bool = True, redundant: bool = False) -> ph.System:
    """Trailers that go where their wheels point, each hitched to the one before.

    Args:
        size: how many.
        hitch: whether the hitch is behind the axle, or at its middle.
        redundant: whether a hitch holds its trailer up too, which its floor does already.
    """
    m, J, b, c, g = ph.symbols("m J b c g", positive=True)
    lab = ph.Frame("lab")
    parts: list[ph.Pivot | ph.Hinge | ph.Hold] = []
    before: ph.Body | None = None
    for k in range(size):
        axes = lab.rotated(ph.coordinate(f"phi_{k}"), "z")
        trailer = ph.Body(f"trailer {k}", mass=m, inertia=(J, J, J), axes=axes, tag=str(k))
        parts += [
            ph.Pivot(trailer, only="z", name=f"floor {k}"),
            ph.Hinge(trailer, axis="z", name=f"level {k}"),
            ph.Hold(trailer, at=axes.zero, along=axes, only="y", name=f"wheels {k}", force="W"),
        ]
        if before is not None:
            end = before.point(before.axes["x"] * -(c if hitch else 0))
            only = "" if redundant else "x y"
            at = axes["x"] * b
            parts.append(ph.Pivot(trailer, at=at, to=end, name=f"hitch {k}", force="H", only=only))
        before = trailer
    return ph.System(*parts, ph.Gravity(g), name=f"{size} trailers")


def by_hand(size: int, state: Mapping[str, float], *, hitch: bool = True) -> dict[str, float]:
    """Newton and Euler for every trailer in the plane, with its constraints differentiated once."""
    m, J, b = (state[name] for name in ("m", "J", "b"))
    c = state["c"] if hitch else 0.0
    turn = [state[f"phi_{k}"] for k in range(size)]
    spin = [state[f"phi_{k}_dot"] for k in range(size)]
    speed = [np.array([state[f"x_{k}_dot"], state[f"y_{k}_dot"]]) for k in range(size)]
    along = [np.array([np.cos(a), np.sin(a)]) for a in turn]
    across = [np.array([-np.sin(a), np.cos(a)]) for a in turn]
    names = [f"W_y_{k}" for k in range(size)]
    names += [f"H_{i}_{k}" for k in range(1, size) for i in "xy"]
    accelerations = 3 * size
    total = accelerations + len(names)
    matrix, right = np.zeros((total, total)), np.zeros(total)

    def reacts(name: str, k: int, force: np.ndarray, arm: np.ndarray) -> None:
        """A unit of a reaction on one trailer."""
        column = accelerations + names.index(name)
        matrix[3 * k : 3 * k + 2, column] -= force
        matrix[3 * k + 2, column] -= arm[0] * force[1] - arm[1] * force[0]

    row = accelerations
    for k in range(size):
        matrix[3 * k : 3 * k + 3, 3 * k : 3 * k + 3] = np.diag([m, m, J])
        reacts(f"W_y_{k}", k, across[k], np.zeros(2))
        matrix[row, 3 * k : 3 * k + 2] = across[k]
        right[row] = spin[k] * speed[k] @ along[k]
        assert abs(speed[k] @ across[k]) < 1e-11
        row += 1
    for k in range(1, size):
        front, rear = b * along[k], -c * along[k - 1]
        swept = spin[k] * b * across[k] + spin[k - 1] * c * across[k - 1]
        assert np.allclose(speed[k] + swept, speed[k - 1], atol=1e-11)
        for i, unit in enumerate(np.eye(2)):
            reacts(f"H_{'xy'[i]}_{k}", k, unit, front)
            reacts(f"H_{'xy'[i]}_{k}", k - 1, -unit, rear)
            matrix[row, 3 * k + i], matrix[row, 3 * k - 3 + i] = 1, -1
            matrix[row, 3 * k + 2] = (b * across[k])[i]
            matrix[row, 3 * k - 1] = (c * across[k - 1])[i]
            right[row] = (spin[k] ** 2 * front - spin[k - 1] ** 2 * rear)[i]
            row += 1
    found = np.linalg.solve(matrix, right)
    named = dict(zip(names, found[accelerations:], strict=True))
    for k in range(size):
        named[f"phi_{k}_ddot"] = found[3 * k + 2]
    return {name: float(value) for name, value in named.items()}
