"""Letters that a text introduces for the coordinates of a point: x = l sin θ, z_C = ½ l cos θ.

A text chooses where it counts from, and along which axes. What it calls x is a coordinate of a
centre of mass if its gradient is that of the position along one direction of unit length, the
same in all states: x = n · r + const.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, Symbol, Vector
from polhode.derive import Equations
from polhode.judge._verdict import Answer, Verdict
from polhode.judge.latex._tree import Name, Node
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.meaning._mechanics import Mechanics
from polhode.judge.states._numeric import numbers

_COORDINATES = ("x", "y", "z")
_MASS_CENTRE = frozenset({"cm", "CM", "com", "COM", "C", "c", "G", "S"})  # labels of it
_STATES, _DRAWS = 8, 2  # states that are compared, for each draw of the parameters
_ROUNDING = 1e-9


def as_coordinate_of_a_point(judged: JudgedLine, equations: Equations) -> JudgedLine:
    """A definition of such a letter: true of a centre of mass, or perhaps wrong by its label."""
    bound = judged.bound
    if bound is None or judged.verdict.answer is not Answer.DEFINITION or len(bound.defined) != 1:
        return judged
    ((letter, value),) = bound.defined.items()
    if not isinstance(letter, Name) or letter.letter not in _COORDINATES or letter.decoration:
        return judged
    if not isinstance(value, Expr) or not value.varies:
        return judged
    points = dict(_points(letter, Mechanics(equations)))
    point = next((p for p, at in points.items() if _is_coordinate(value, at, equations)), "")
    if point:
        reason = f"a coordinate of {point}, along a direction at rest"
        return _with(judged, Answer.HOLDS, reason)
    if letter.subscript in _MASS_CENTRE and not _may_be_of_small_angles(value, points, equations):
        reason = "it is no coordinate of the centre of mass along a direction at rest"
        return _with(judged, Answer.FAILS, reason)
    return judged


def _may_be_of_small_angles(
    value: Expr, points: Mapping[str, Vector], equations: Equations
) -> bool:
    """Whether it may be what small angles leave of a coordinate: x = lθ + Lφ, y = ½lθ²."""
    if not all(isinstance(g, Symbol) for g in value.generators):
        return False
    is_linear = not any(value.diff(s).varies for s in value.symbols() if s.kind.varies)
    near = (_is_coordinate(value, at, equations, near=True) for at in points.values())
    return not is_linear or any(near)


def _with(judged: JudgedLine, answer: Answer, reason: str) -> JudgedLine:
    verdict = Verdict(answer, "identity", reason=reason, readings=judged.verdict.readings)
    return replace(judged, judgement=replace(judged.judgement, verdict=verdict, corrected=None))


def _points(letter: Node, mechanics: Mechanics) -> Iterator[tuple[str, Vector]]:
    """The points of which a letter may be a coordinate, with their positions."""
    yield "the centre of mass", mechanics.position("cm")
    is_of_whole = isinstance(letter, Name) and letter.subscript in _MASS_CENTRE
    for body in mechanics.bodies if len(mechanics.bodies) > 1 and not is_of_whole else ():
        yield f"the centre of mass of {body.name}", mechanics.position(body.name)


def _is_coordinate(
    value: Expr, position: Vector, equations: Equations, *, near: bool = False
) -> bool:
    """Whether a length is one, by the gradients at drawn states.

    Args:
        value: the length.
        position: of the point.
        equations: of the system.
        near: to first order about the state in which all coordinates vanish.
    """
    along = position.express(equations.system.root).components
    symbols = sorted(
        {s for e in (value, *along) for s in e.symbols() if s.name != "pi"},
        key=lambda s: s.published,
    )
    moving = [s for s in symbols if s.kind.varies]
    gradients = [[e.diff(s) for s in moving] for e in (value, *along)]
    draw = np.random.default_rng(1)
    for _ in range(_DRAWS):
        parameters = {s: draw.uniform(0.5, 1.5) for s in symbols if not s.kind.varies}
        states = np.zeros(1) if near else draw.uniform(-1.5, 1.5, (len(moving), _STATES))
        at = {s: states[k] if not near else np.zeros(1) for k, s in enumerate(moving)}
        rows = [_values(row, {**parameters, **at}, 1 if near else _STATES) for row in gradients]
        if not _is_along_unit(rows[0], np.stack(rows[1:], axis=1)):
            return False
    return True


def _values(
    row: Sequence[Expr], at: dict[Symbol, float | NDArray[np.float64]], count: int
) -> NDArray[np.float64]:
    return numbers(row, at, (count,)).ravel()


def _is_along_unit(slopes: NDArray[np.float64], of_position: NDArray[np.float64]) -> bool:
    """Whether slopes are those of a position along one direction of unit length."""
    if not (np.isfinite(slopes).all() and np.isfinite(of_position).all()):
        return False
    direction = np.linalg.lstsq(of_position, slopes, rcond=1e-10)[0]
    left_over = np.abs(of_position @ direction - slopes).max(initial=0.0)
    size = float(np.linalg.norm(direction))
    return left_over <= _ROUNDING * (1 + np.abs(slopes).max(initial=0.0)) and (
        abs(size - 1) <= _ROUNDING
    )
