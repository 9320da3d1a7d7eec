"""Bodies at rest on contacts whose forces Newton's laws leave open, as a ladder on floor and wall.

Where all speeds and their rates vanish and nothing changes with time, bodies stay at rest if the
contacts can hold them: if some of the forces that balance the loads lie within all cones of
friction. Which of these they are stays open, but the motion does not depend on it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from polhode.algebra import Expr, SymbolKind, Vector
from polhode.derive import Mode
from polhode.model import DryFriction
from polhode.simulate.contact._hybrid_system import HybridSystem
from polhode.simulate.contact._mode_state import ModeState
from polhode.simulate.integrate._arrays import Array

_EQUILIBRIUM = 1e-12  # of the largest load: what is left over of the balances is rounding
_HELD = 1e-10  # of the largest force: forces this far outside their cones are at its edge


def rests(hybrid: HybridSystem, entry: ModeState) -> bool | None:
    """Whether the contacts of a mode can hold everything at rest; None where it is not at rest."""
    mode = hybrid.mode(entry.phases)
    if entry.slips:
        return None
    expressions = list(_balances(mode.mode))
    if np.any(np.asarray(entry.speeds) != 0) or any(map(_changes, expressions)):
        return None
    rates = [Expr.generator(s.derivative()) for s in mode.mode.equations.speeds]
    if np.any(mode.function(rates)(entry.state, entry.shared.time, ()) != 0):
        return None
    table = mode.function(expressions)(entry.state, entry.shared.time, ())
    names = [line.name for line in mode.mode.equations.lines]
    table = np.asarray(table, dtype=float).reshape(-1, 1 + len(names))
    required, columns = table[:, 0], table[:, 1:]
    size = np.max(np.abs(required), initial=0.0)
    particular = np.asarray(np.linalg.lstsq(columns, required, rcond=None)[0], dtype=float)
    if np.max(np.abs(columns @ particular - required), initial=0.0) > _EQUILIBRIUM * size:
        return None
    free = _null_space(columns)
    cones = [
        _Cone(most, *(_affine(particular, free, names, n) for n in (normal, *along)))
        for most, normal, along in _limits(hybrid, mode.mode)
    ]
    return _can_hold(cones, free.shape[1], np.max(np.abs(particular), initial=0.0))


def _balances(mode: Mode) -> Iterator[Expr]:
    """What the reactions must supply to each body, followed by what one unit of each supplies."""
    equations = mode.equations
    for body, wrench in equations.required.items():
        columns = [line.with_loads.get(body) for line in equations.lines]
        for part in ("force", "couple"):
            needed: Vector = getattr(wrench, part)
            own = [None if c is None else getattr(c, part).express(needed.triad) for c in columns]
            for axis in range(3):
                yield equations.kinetics.on_speeds(needed.components[axis])
                for vector in own:
                    value = Expr.of(0) if vector is None else vector.components[axis]
                    yield equations.kinetics.on_speeds(value)


def _changes(expression: Expr) -> bool:
    """Whether it changes with time even at rest."""
    return any(s.kind in (SymbolKind.FUNCTION, SymbolKind.TIME) for s in expression.symbols())


def _null_space(columns: Array) -> Array:
    """Changes of the reactions that the bodies do not feel, shape (reactions, changes)."""
    _, sizes, rows = np.linalg.svd(columns)
    rank = int(np.sum(sizes > 1e-10 * np.max(sizes, initial=0.0)))
    return np.asarray(rows[rank:].T)


def _limits(hybrid: HybridSystem, mode: Mode) -> Iterator[tuple[float, str, list[str]]]:
    """Of each contact its coefficient, infinite without slip, and the names of its forces."""
    for contact, phase in zip(hybrid.automaton.contacts, mode.phases, strict=True):
        if phase.flies:
            continue
        normal, *along = contact.components
        if isinstance(contact, DryFriction):
            yield float(hybrid.value(contact.mu_static)), normal, along
        else:
            yield np.inf, normal, []


_Affine = tuple[float, Array]


def _affine(particular: Array, free: Array, names: list[str], name: str) -> _Affine:
    """A reaction as a constant, and its changes with the free ones."""
    if name not in names:  # of a frictionless contact there is no force along the support
        return 0.0, np.zeros(free.shape[1])
    place = names.index(name)
    return float(particular[place]), free[place]


# -- the largest reserve of all cones of friction --------------------------------------------------


class _Cone:
    """μ N - |T| of a contact, where N and T depend on the free reactions; or N, with no limit."""

    def __init__(self, most: float, normal: _Affine, *along: _Affine) -> None:
        factor = 1.0 if np.isinf(most) else most
        self._normal = factor * normal[0], factor * normal[1]
        self._constants = np.array([c for c, _ in along])
        self._slopes = np.array([s for _, s in along]).reshape(len(along), len(normal[1]))

    def reserve(self, free: Array) -> float:
        """How far the force is within the cone, N."""
        constant, slope = self._normal
        along = self._constants + self._slopes @ free
        return float(constant + slope @ free - np.sqrt(along @ along))

    def barrier(self, free: Array, least: float) -> tuple[Array, Array]:
        """Gradient and Hessian of -log((μ N - least)² - |T|²) by `free` and `least`."""
        constant, slope = self._normal
        height = constant + slope @ free - least
        along = self._constants + self._slopes @ free
        inside = height**2 - along @ along
        rise = np.append(slope, -1.0)  # of the height
        turns = np.hstack([self._slopes, np.zeros((len(along), 1))])
        first = 2 * (height * rise - along @ turns)
        second = 2 * (np.outer(rise, rise) - turns.T @ turns)
        return -first / inside, np.outer(first, first) / inside**2 - second / inside


@dataclass
class _Search:
    """Reactions that raise the least reserve of all cones, by a barrier (Boyd and Vandenberghe,
    Convex Optimization, 2004, sect. 11.3)."""

    cones: list[_Cone]
    free: Array
    least: float

    def centred(self, weight: float) -> None:
        """Newton's method for the largest weight · least + Σ log inside."""
        for _ in range(50):
            parts = [cone.barrier(self.free, self.least) for cone in self.cones]
            gradient = sum((g for g, _ in parts), np.zeros(len(self.free) + 1))
            gradient[-1] -= weight
            hessian = sum((h for _, h in parts), np.zeros((len(gradient), len(gradient))))
            step = np.asarray(-np.linalg.lstsq(hessian, gradient, rcond=1e-14)[0], dtype=float)
            decrement = float(-gradient @ step)
            # damped as for self-concordant functions
            share = 1.0 if decrement < 0.25 else 1 / (1 + decrement**0.5)
            while not self._is_inside(step, share) and share > 1e-12:
                share /= 2
            self.free = self.free + share * step[:-1]
            self.least += share * float(step[-1])
            if decrement < 1e-10 or share <= 1e-12:
                return

    def _is_inside(self, step: Array, share: float) -> bool:
        free, least = self.free + share * step[:-1], self.least + share * step[-1]
        return all(cone.reserve(free) > least for cone in self.cones)


def _can_hold(cones: list[_Cone], count: int, scale: float) -> bool:
    """Whether some choice of the free reactions lies within all cones."""
    free = np.zeros(count)

    def reserve(at: Array) -> float:
        return min((cone.reserve(at) for cone in cones), default=0.0)

    if reserve(free) >= -_HELD * scale:
        return True
    if not count:
        return False
    search = _Search(cones, free, reserve(free) - scale)
    weight: Any = 1 / scale
    while 2 * len(cones) / weight > _HELD * scale / 10:
        search.centred(weight)
        if reserve(search.free) >= -_HELD * scale:
            return True
        weight *= 8
    return False
