"""Supports and bodies of the tests, with their surfaces as plain formulas."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

import polhode as ph

M, G, A, B, C, LARGE, SMALL, ALPHA = ph.symbols("m g a b c R r alpha")
MASS, R, TUBE, HALF = 0.3, 0.5, 0.15, 0.6
VALUES = {M: MASS, G: 9.81, A: 0.05, B: 0.04, C: 0.06, LARGE: R, SMALL: TUBE, ALPHA: HALF}

Surface = Callable[[np.ndarray, float], tuple[np.ndarray, np.ndarray]]


@dataclass
class Ground:
    """A support with its surface: distance of points on its outer side, and the normal."""

    support: ph.Sphere | ph.Cylinder | ph.Cone | ph.Torus
    surface: Surface
    start: dict[str, float]


def _signed(distance: np.ndarray, outwards: np.ndarray, inside: bool):
    return (-distance, -outwards) if inside else (distance, outwards)


def sphere(lab: ph.Frame, inside: bool) -> Ground:
    def surface(points: np.ndarray, time: float):
        size = np.linalg.norm(points, axis=1)
        return _signed(size - R, points / size[:, None], inside)

    return Ground(ph.Sphere(lab, radius=LARGE, inside=inside), surface, {"u": 0.2, "v": -0.3})


def cylinder(lab: ph.Frame, inside: bool) -> Ground:
    def surface(points: np.ndarray, time: float):
        across = points * [1, 0, 1]
        size = np.linalg.norm(across, axis=1)
        return _signed(size - R, across / size[:, None], inside)

    return Ground(ph.Cylinder(lab, radius=LARGE, inside=inside), surface, {"u": 0.3, "v": 0.1})


def cone(lab: ph.Frame, inside: bool) -> Ground:
    """Inside it opens upwards, outside downwards."""
    sense = 1 if inside else -1

    def surface(points: np.ndarray, time: float):
        outwards = points * [1, 1, 0]
        size = np.linalg.norm(outwards, axis=1)
        outwards = outwards / size[:, None]
        up = np.array([0, 0, sense])
        normal = outwards * np.cos(HALF) - up * np.sin(HALF)
        return _signed(np.sum(points * normal, axis=1), normal, inside)

    support = ph.Cone(lab, half_angle=ALPHA, inside=inside)
    return Ground(support, surface, {"u": 0.4, "v": 0.6})


def torus(lab: ph.Frame, inside: bool) -> Ground:
    def surface(points: np.ndarray, time: float):
        across = points * [1, 1, 0]
        middle = R * across / np.linalg.norm(across, axis=1)[:, None]
        away = points - middle
        size = np.linalg.norm(away, axis=1)
        return _signed(size - TUBE, away / size[:, None], inside)

    start = {"u": 0.4, "v": -1.2 if inside else 1.2}
    return Ground(ph.Torus(lab, radius=LARGE, tube=SMALL, inside=inside), surface, start)


KINDS = {"sphere": sphere, "cylinder": cylinder, "cone": cone, "torus": torus}


@dataclass
class Thing:
    """A body with points of its surface along its axes."""

    body: ph.Body
    moments: tuple[float, float, float]
    points: np.ndarray
    start: dict[str, float]


_A, _B, _C = VALUES[A], VALUES[B], VALUES[C]


def _unit_vectors() -> np.ndarray:
    found = np.random.default_rng(5).normal(size=(4000, 3))
    return found / np.linalg.norm(found, axis=1)[:, None]


def _angles(lab: ph.Frame) -> tuple[ph.Frame, ph.Frame]:
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = lab.rotated(phi, "z").rotated(theta, "x")
    return axes, axes.rotated(psi, "z", labels="1 2 3")


def ball(lab: ph.Frame) -> Thing:
    body = ph.sphere("ball", mass=M, radius=A, axes=lab)
    moment = 0.4 * MASS * _A**2
    return Thing(body, (moment,) * 3, _unit_vectors() * _A, {"omega_x": 2.0, "omega_z": -3.0})


def pebble(lab: ph.Frame) -> Thing:
    _, axes = _angles(lab)
    halves = np.array([_A, _B, _C])
    body = ph.ellipsoid("pebble", mass=M, half_axes=(A, B, C), axes=axes, spin=ph.Components())
    a, b, c = MASS * halves**2 / 5
    start = {"phi": 0.3, "theta": 0.9, "psi": 0.2, "omega_1": 3.0, "omega_2": -2.0, "omega_3": 4.0}
    return Thing(body, (b + c, c + a, a + b), _unit_vectors() * halves, start)


def coin(lab: ph.Frame) -> Thing:
    axes, _ = _angles(lab)
    body = ph.disk("coin", mass=M, radius=A, axes=axes)
    across = MASS * _A**2 / 4
    angle = np.linspace(0, 2 * np.pi, 2000)
    points = _A * np.array([np.cos(angle), np.sin(angle), 0 * angle]).T
    start = {"phi": 0.3, "theta": 1.2, "theta_dot": 1.0, "omega_3": 8.0}
    return Thing(body, (across, across, 2 * across), points, start)


THINGS = {"ball": ball, "pebble": pebble, "coin": coin}


def numbers(system: ph.System) -> dict:
    """Values of the parameters that a system has."""
    known = {str(symbol): value for symbol, value in VALUES.items()}
    return {p.published: known[p.published] for p in ph.automaton(system).parameters}
