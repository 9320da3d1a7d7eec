"""Lengths that vanish during a motion: of vectors under roots, and of the stretches of ropes.

What follows is not determined there, or no longer what the equations describe.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from polhode.algebra import Expr
from polhode.base import ConstraintError, NumericError
from polhode.model import Rope
from polhode.simulate._dynamics import Dynamics
from polhode.simulate._segment import TrajectoryPiece, values_of
from polhode.simulate.integrate._arrays import Array
from polhode.simulate.integrate._crossing import first_zero_vector

_PLACES = np.linspace(0.0, 1.0, 9)  # of a step, at which lengths are evaluated


def refuse_vanishing(dynamics: Dynamics, piece: TrajectoryPiece) -> None:
    """Refuse a piece on which a length vanishes.

    Raises:
        ConstraintError: for a rope that starts against its declared directions.
        NumericError: with the length and the time.
    """
    if not piece.end > piece.begin:
        return
    _refuse_end_of_stretch(dynamics, piece)
    _refuse_vanishing_roots(dynamics, piece)


def _times(piece: TrajectoryPiece) -> Array:
    """Times at which every step of a piece is looked at, shape (steps, places)."""
    steps = piece.solution.steps
    knots = np.append(steps[steps < piece.end], piece.end)
    found: Array = knots[:-1, None] + np.diff(knots)[:, None] * _PLACES
    return found


# -- stretches of ropes ----------------------------------------------------------------------------
#
# A stretch is a vector that keeps its direction while it shortens: beyond zero it would point the
# other way, with the end of the rope on the far side of its pulley or eye.

_GONE = 1e-9  # of the longest that a stretch is on a piece: where it turns round it is this short
# Of the longest stretch: where the equations have no direction for a stretch this short, and the
# motion cannot be continued, that is the reason.
_ALMOST_GONE = 1e-6


@dataclass(frozen=True)
class _Stretch:
    """A stretch of a rope.

    Attributes:
        rope: the rope.
        number: of the stretch, from one.
        components: along its declared direction; without one, along the root frame, m.
    """

    rope: Rope
    number: int
    components: tuple[Expr, ...]


def _stretches(dynamics: Dynamics) -> Iterator[_Stretch]:
    equations: Any = dynamics.equations
    for rope in getattr(equations.system, "elements", ()):
        if isinstance(rope, Rope):
            for k, stretch in enumerate(rope.stretches(equations.kinetics.places)):
                yield _Stretch(rope, k + 1, stretch)


def stretches_of(dynamics: Dynamics) -> Iterator[Expr]:
    """Lengths of the stretches of ropes that keep their declared directions, m."""
    for stretch in _stretches(dynamics):
        if stretch.rope.directions:
            yield stretch.components[0]


def _refuse_end_of_stretch(dynamics: Dynamics, piece: TrajectoryPiece) -> None:
    """Refuse a piece on which an end of a rope passes the point that the rope runs over.

    Lengths that are zero at the start are taken as not given: accelerations do not depend on them.
    """
    for stretch in _stretches(dynamics):
        values = _lengthwise(dynamics, piece, stretch)
        if stretch.rope.directions and piece.begin == 0:
            _refuse_opposite(stretch, values(_times(piece)[0])[0])
        when = first_zero_vector(values, np.unique(_times(piece)), _GONE)
        if when is not None:
            raise _no_length(stretch, when)


def _refuse_opposite(stretch: _Stretch, lengths: Array) -> None:
    """Refuse a start at which a stretch points against its declared direction."""
    if lengths[0] < -_GONE * np.max(np.abs(lengths)):
        direction = stretch.rope.directions[stretch.number - 1]
        raise ConstraintError(
            f"stretch {stretch.number} of {stretch.rope.name!r} points against its direction "
            f"{direction} at the start: it is {lengths[0]:.6g} m long along it",
            expected="a direction from each point of the rope to the next",
            advice="turn the direction round, or start with the body on the other side",
        )


def refuse_lost_stretch(dynamics: Dynamics, piece: TrajectoryPiece) -> None:
    """Refuse a piece that cannot be continued because a stretch of a rope has vanished.

    Raises:
        NumericError: with the rope and the time.
    """
    times = piece.solution.steps[-2:]
    sizes = [
        (stretch, np.linalg.norm(_lengthwise(dynamics, piece, stretch)(times), axis=0))
        for stretch in _stretches(dynamics)
    ]
    longest = max((float(size[-1]) for _, size in sizes), default=0.0)
    for stretch, (before, after) in sizes:
        if before > after and after <= _ALMOST_GONE * longest:
            passed = float(times[1] - times[0])
            raise _no_length(stretch, float(times[1] + passed * after / (before - after)))


def _lengthwise(
    dynamics: Dynamics, piece: TrajectoryPiece, stretch: _Stretch
) -> Callable[[Array], Array]:
    inside = replace(piece)  # a copy has its own cache: that of the piece is for its readers
    return lambda times: values_of(dynamics, inside, stretch.components, times)


def _no_length(stretch: _Stretch, when: float) -> NumericError:
    return NumericError(
        f"stretch {stretch.number} of {stretch.rope.name!r} has no length left at t = "
        f"{when:.9g} s: its ends meet there",
        expected="a rope whose ends stay at a distance from the points that it runs over",
        advice=f"end the motion before that time, for instance at {0.99 * when:.3g} s",
    )


# -- lengths under roots ---------------------------------------------------------------------------
#
# Along a straight line |v| = √(v_x² + v_y²) is a multiple of |t − t₀|, and a Taylor series about an
# earlier instant continues it as a multiple of t₀ − t: friction along v/|v| would drive the motion.
# Steps that see the branch point of the root are shorter than the way to it, so that within one
# step a length changes little. A length that falls to almost nothing within a step has vanished
# unnoticed.

_SMALL = 0.05  # of the largest radicand within a step: below, its minimum is searched for
_NOTHING = 1e-6  # of the same: below, the length has vanished within the step
_NARROWED = 60  # times by a third


def _refuse_vanishing_roots(dynamics: Dynamics, piece: TrajectoryPiece) -> None:
    roots = dynamics.lengths
    if not roots:
        return
    times = _times(piece)
    inside = replace(piece)  # a copy has its own cache: that of the piece is for its readers

    def radicands(times: Array) -> Array:
        found = values_of(dynamics, inside, [root.radicand for root in roots], times.ravel())
        return found.reshape(len(roots), *times.shape)

    values = radicands(times)
    largest, least = values.max(axis=2), values.min(axis=2)
    for k, step in zip(*np.nonzero(least < _SMALL * largest), strict=True):
        when = _lowest(radicands, int(k), times[step], values[k, step])
        if radicands(np.array([when]))[k, 0] < _NOTHING * largest[k, step]:
            raise NumericError(
                f"sqrt({roots[k].radicand}) vanishes at t = {when:.9g} s, and has no direction "
                "there",
                expected="a length that stays positive, since what follows is not determined",
                advice="start elsewhere; describe a motion along a line by one coordinate, whose "
                "absolute value may pass through zero; or declare dry friction as ph.Coulomb",
            )


def _lowest(functions: Callable[[Array], Array], k: int, times: Array, values: Array) -> float:
    """Where one of some functions is least within a step, near the least of its values."""
    place = int(np.argmin(values))
    left, right = times[max(place - 1, 0)], times[min(place + 1, len(times) - 1)]
    for _ in range(_NARROWED):
        third = (right - left) / 3
        first, second = functions(np.array([left + third, right - third]))[k]
        left, right = (left, right - third) if first < second else (left + third, right)
    return float((left + right) / 2)
