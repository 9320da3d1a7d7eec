"""Boxes that touch a plane with their lower corners."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any

import polhode as ph

M, A, B, C, G = ph.symbols("m a b c g", positive=True)
MU, MU_S = ph.symbols("mu mu_s")
NUMBERS: dict[Any, float] = {M: 1.3, A: 0.2, B: 0.3, C: 0.1, G: 9.81}


def over_an_edge() -> ph.System:
    """A box that can only turn about the direction of one edge, and touches with its middle."""
    lab = ph.Frame("N")
    axes = lab.rotated(ph.coordinate("theta"), "y")
    box = ph.box("box", mass=M, sides=(A, B, C), axes=axes)
    edge = ph.Coulomb(
        box, on=ph.Plane(lab), at=axes.vector(A / 2, 0, -C / 2), mu=MU, name="edge", force="P"
    )
    return ph.System(edge, ph.Hinge(box, axis="y"), ph.Gravity(G))


def on_corners(
    plane: Callable[[ph.Frame], Any] = ph.Plane,
    corners: tuple[tuple[int, int], ...] = ((1, 1), (1, -1), (-1, 1), (-1, -1)),
    sharing: str = "equal stiffness",
    mu_static: Any = None,
    faces: tuple[int, ...] = (-1,),
) -> ph.System:
    """On some of its corners.

    Args:
        plane: in the laboratory.
        corners: on which side of the centre each is.
        faces: of the lower face, -1, or the upper one, 1.
    """
    lab = ph.Frame("N")
    on = plane(lab)
    axes = on.axes
    for angle, label in zip(ph.coordinates("psi theta phi"), "zyx", strict=True):
        axes = axes.rotated(angle, label)
    box = ph.box("box", mass=M, sides=(A, B, C), axes=axes)
    contacts = [
        ph.Coulomb(
            box,
            on=on,
            at=axes.vector(i * A / 2, j * B / 2, k * C / 2),
            mu=MU,
            mu_static=mu_static,
            name=f"corner {name}",
            force=name,
        )
        for name, (k, (i, j)) in zip("PQRSTUVW", product(faces, corners), strict=False)
    ]
    gravity = ph.Gravity(G, up=lab["z"])
    return ph.System(*contacts, gravity, impacts="Moreau", sharing=sharing)
