"""The forces of a figure: the reactions of one state of the motion, so that its arrows balance."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import cycle
from math import hypot

import numpy as np

from polhode.algebra import Expr, Symbol, Vector
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.model import Contact, Element, Gravity, Smooth
from polhode.solution._figure_numbers import FigureState, Point, value_of

_PUSHED = 0.4  # second derivatives of prescribed functions, of which all else is zero
_MOVING = (0.5, 0.8, 0.35)  # independent speeds, where forces at rest would hide something
_SHORT = 0.08  # of the greatest force, below which an arrow is not seen
_UPRIGHT = 1e-6  # of a force along a support, beside which it is along the normal
_WEIGHT, _LONGEST = 0.7, 1.5  # of the greatest weight, and of the greatest force
_STILL = 1e-9


@dataclass(frozen=True)
class FigureForces:
    """Forces at one instant.

    Attributes:
        reactions: force on its body by the name of what exerts it, along the laboratory's axes.
        unit: length of an arrow for a force of one.
        starts: whether all bodies are at rest at that instant.
    """

    reactions: Mapping[str, Point]
    unit: float
    starts: bool


def forces_of(state: FigureState) -> FigureForces | None:
    """All reactions where the system is released from rest, or at an instant of a motion.

    Released from rest, some forces vanish, and friction may; then bodies move. None where the
    equations are too long for that, or have no solution at these values.
    """
    equations = state.equations
    if equations.in_parts:
        return None
    found = [forces for speeds in ((0.0,), _MOVING) if (forces := _forces(state, speeds))]
    return min(found, key=lambda forces: _hidden(state, forces), default=None)


def _forces(state: FigureState, speeds: tuple[float, ...]) -> FigureForces | None:
    equations = state.equations
    try:
        values = _instant(state, speeds)
        reactions = {
            name: _components(equations, reaction.force, values)
            for name, reaction in equations.reactions.items()
        }
    except (PolhodeError, ArithmeticError, np.linalg.LinAlgError, KeyError):
        return None
    weights = [value_of(weight, values) for weight in _weights(equations)]
    largest = max([*(hypot(*force) for force in reactions.values()), *weights], default=0.0)
    if not np.isfinite(largest) or not largest:
        return None
    unit = min(_WEIGHT / max(weights, default=0.5 * largest), _LONGEST / largest)
    moving = [v for pair in equations.kinetics.velocities.values() for v in pair]
    starts = all(hypot(*_components(equations, v, values)) < _STILL for v in moving)
    return FigureForces(reactions, unit, starts)


def _instant(state: FigureState, speeds: tuple[float, ...]) -> dict[Symbol, float]:
    """Values of all that forces depend on: coordinates, speeds and the accelerations they have."""
    equations = state.equations
    values = dict(state.values)
    values |= {f.derivative().derivative(): _PUSHED for f in equations.functions}
    values |= dict(zip(equations.speeds, cycle(speeds)))
    values |= {s: value_of(e, values) for s, e in equations.kinetics.in_speeds.items()}
    mass = np.array([[value_of(entry, values) for entry in row] for row in equations.mass.rows])
    forcing = np.array([value_of(entry, values) for entry in equations.forcing])
    rates = np.linalg.solve(mass, forcing) if len(forcing) else forcing
    return values | dict(zip(equations.acceleration_symbols, map(float, rates), strict=True))


def _components(equations: Equations, vector: Vector, values: dict[Symbol, float]) -> Point:
    """Along the laboratory's axes; components that the laws leave open are the least possible."""
    least = {Expr.generator(Symbol(n)): equations.least[n] for n in equations.undetermined}
    along = vector.subs(least) if least else vector
    root = equations.system.root
    x, y, z = (
        value_of(equations.kinetics.on_speeds(c), values) for c in along.express(root).components
    )
    return x, y, z


def _weights(equations: Equations) -> Iterator[Expr]:
    for load in equations.system.loads:
        if isinstance(load, Gravity):
            yield from (body.mass * load.g for body in equations.system.bodies if body.mass)


def _hidden(state: FigureState, forces: FigureForces) -> int:
    """How many forces vanish or hide their friction, which they do not always do."""
    equations = state.equations
    largest = max(hypot(*force) for force in forces.reactions.values())
    hidden = 0
    for name, reaction in equations.reactions.items():
        force, element = forces.reactions[name], equations.system.element(name)
        is_small = hypot(*force) < _SHORT * largest and not reaction.force.is_zero
        hidden += is_small or _is_upright(state, element, force)
    return hidden


def _is_upright(state: FigureState, element: Element, force: Point) -> bool:
    """Whether there could be friction and is none."""
    if not isinstance(element, Contact) or isinstance(element, Smooth):
        return False
    normal = state.point(element.on.up)
    push = sum(a * b for a, b in zip(force, normal, strict=True))
    return hypot(*force) - abs(push) < _UPRIGHT * hypot(*force)
