"""A disk on a table: rolling, with friction, without any; the text's axes."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

import polhode as ph
from oracles.sliding_disk import Disk
from polhode.derive import Automaton, automaton

M, A, G = ph.symbols("m a g", positive=True)
MU, MU_S, E = ph.symbols("mu mu_s e")


def body(lab: ph.Frame, first: str = "z", second: str = "x") -> ph.Body:
    theta, phi = ph.coordinates("theta phi")
    axes = lab.rotated(phi, first).rotated(theta, second, labels="1 2 3", name="axes")
    return ph.disk("disk", mass=M, radius=A, axes=axes)


@cache
def with_friction() -> Automaton:
    lab = ph.Frame("lab")
    touch = ph.Coulomb(body(lab), on=ph.Plane(lab), mu=MU, mu_static=MU_S, restitution=E)
    return automaton(ph.System(touch, ph.Gravity(G)))


@cache
def rolling() -> Automaton:
    lab = ph.Frame("lab")
    return automaton(ph.System(ph.Rolling(body(lab), on=ph.Plane(lab)), ph.Gravity(G)))


@cache
def frictionless() -> Automaton:
    lab = ph.Frame("lab")
    touch = ph.Smooth(body(lab), on=ph.Plane(lab), restitution=E)
    return automaton(ph.System(touch, ph.Gravity(G)))


def numbers(mu: float, mu_static: float | None = None, e: float = 0.0) -> dict[str, Any]:
    known = {"m": 0.1, "a": 0.05, "g": 9.81, "e": e}
    return known | {"mu": mu, "mu_s": mu if mu_static is None else mu_static}


def plain(e: float = 0.0) -> dict[str, Any]:
    return {"m": 0.1, "a": 0.05, "g": 9.81, "e": e}


def oracle_disk(mu: float) -> Disk:
    m, a = 0.1, 0.05
    return Disk(m, a, m * a * a / 4, m * a * a / 2, mu, 9.81)


def in_the_lab(values: dict[str, Any]) -> np.ndarray:
    """x, y, v_x, v_y, axis and angular velocity in the lab of a state by name."""
    theta, phi = float(values["theta"]), float(values["phi"])
    first = np.array([np.cos(phi), np.sin(phi), 0.0])
    axis = np.array([np.sin(theta) * np.sin(phi), -np.sin(theta) * np.cos(phi), np.cos(theta)])
    second = np.cross(axis, first)
    omega = (
        float(values["theta_dot"]) * first
        + float(values["phi_dot"]) * np.sin(theta) * second
        + float(values["omega_3"]) * axis
    )
    own = [float(values[name]) for name in ("x", "y", "v_x", "v_y")]
    return np.array([*own, *axis, *omega])
