"""Motions that no equations follow: through where all constraints together leave more freedom.

Closures alone do not tell. Hinges whose axes meet in one point hold a linkage on a sphere without
any, and where it folds flat its bars may go on together or apart, too.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial

import numpy as np

from polhode.algebra import Expr
from polhode.base import NumericError
from polhode.derive import Equations, inertia_of, may_become_singular
from polhode.simulate._closed_loops import dead_point_error
from polhode.simulate._dynamics import CLOCK
from polhode.simulate._segment import Segment
from polhode.simulate.integrate._arrays import Array, rows

# The smallest singular value of the constraints that counts, of the largest. Below the first, the
# rounding of a motion decides how it goes on. The directions in which it comes and goes are taken
# where it has the second value; a motion that is smooth turns by as little in between.
_MET = 1e-5
_BESIDE = 1e-3
_TURNED = 0.05
_SHORT = 0.3  # of the longest step: steps become this short where a motion turns abruptly
_HALVINGS = 60
_BALANCING = 10  # passes in which rows and columns are brought to length one, in turn


def turned_at_dead_point(segments: Sequence[Segment]) -> NumericError | None:
    """The error for a motion that turns abruptly where its constraints leave more freedom.

    A motion may pass such a configuration smoothly, as a bead on a ring through its centre does.
    """
    for segment in segments:
        own = segment.as_integrated
        equations = own.dynamics.equations
        if not isinstance(equations, Equations) or not may_become_singular(equations):
            continue
        constraints = _Constraints(own.rounded(), equations)
        for time in constraints.met():
            if constraints.turning(time) > _TURNED:
                state, usual = segment.rounded().state(time), len(equations.speeds)
                coordinates = segment.dynamics.equations.coordinates
                places = {q: state[q.published] for q in coordinates}
                return dead_point_error(
                    f"near t = {time:.4g} s", places, usual + 1, usual, "constraints"
                )
    return None


class _Constraints:
    """The coefficients of the speeds in the velocity constraints along a part of a motion.

    Rows and columns are divided by their lengths in general, so that neither units nor sizes
    matter. Inertias would not do for that: a massless link has none.
    """

    def __init__(self, segment: Segment, equations: Equations) -> None:
        self._segment = segment
        kinetics = equations.kinetics
        self._speeds = kinetics.all_speeds
        self._rank = len(self._speeds) - len(equations.speeds)
        self._entries = [entry for row in kinetics.constraint_rows() for entry in row]
        self._inertias = [inertia_of(equations, speed) for speed in self._speeds]
        self._lengths = self._usual_lengths()

    def met(self) -> Iterator[float]:
        """When the motion meets a singular configuration: the nearest of successive steps, s."""
        steps = self._segment.steps
        spans = np.diff(steps)
        if not self._rank or not np.any(spans < _SHORT * np.max(spans, initial=0.0)):
            return
        nearest = self.nearest(steps)
        close = np.flatnonzero(nearest <= _MET)
        for run in np.split(close, np.flatnonzero(np.diff(close) > 1) + 1):
            if run.size:
                yield float(steps[run[np.argmin(nearest[run])]])

    def nearest(self, times: Array) -> Array:
        """How singular the constraints are: zero where they leave more freedom than elsewhere."""
        lengths, columns = self._lengths
        matrices = self._matrices(self._segment.values(self._entries, times))
        sizes = np.linalg.svd(matrices / lengths[:, None] / columns, compute_uv=False)
        found: Array = sizes[:, self._rank - 1] / np.where(sizes[:, 0] > 0, sizes[:, 0], 1.0)
        return found

    def turning(self, time: float) -> float:
        """By how much the velocities change from before an instant to after it, of the largest."""
        before, after = (self._momenta(self._beside(time, end)) for end in self._ends)
        scale = max(np.linalg.norm(before), np.linalg.norm(after)) or 1.0
        return float(np.linalg.norm(after - before) / scale)

    @property
    def _ends(self) -> tuple[float, float]:
        return float(self._segment.begin), float(self._segment.end)

    def _beside(self, time: float, end: float) -> float:
        """The instant nearest to another one at which the constraints are regular again."""
        times = time + (end - time) * 0.5 ** np.arange(_HALVINGS, -1.0, -1.0)
        regular = np.flatnonzero(self.nearest(times) > _BESIDE)
        return float(times[regular[0]]) if regular.size else end

    def _momenta(self, time: float) -> Array:
        """Every speed times the root of its inertia."""
        at = partial(self._segment.values, times=np.array([time]))
        speeds = at(map(Expr.generator, self._speeds))[:, 0]
        found: Array = np.sqrt(np.maximum(at(self._inertias)[:, 0], 0.0)) * speeds
        return found

    def _usual_lengths(self) -> tuple[Array, Array]:
        """By which rows and columns become unit vectors at a place away from all special ones."""
        dynamics, part = self._segment.dynamics, self._segment.parts[0]
        coordinates = dynamics.equations.coordinates
        general = 0.5 + np.sqrt(np.arange(2.0, 2.0 + len(coordinates))) % 1.0
        known = (*coordinates, *dynamics.parameters, CLOCK)
        function = dynamics.function(self._entries, known)
        with np.errstate(all="ignore"):  # it may lie beyond where a support ends
            values = rows(function(*general, *part.constants, float(part.begin)), 1)
        matrix = self._matrices(values)[0]
        lengths = np.ones(matrix.shape[0]), np.ones(matrix.shape[1])
        for _ in range(_BALANCING):
            for axis, found in ((1, lengths[0]), (0, lengths[1])):
                balanced = matrix / lengths[0][:, None] / lengths[1]
                norms = np.linalg.norm(balanced, axis=axis)
                found *= np.where(norms > 0, norms, 1.0)
        return lengths

    def _matrices(self, entries: Array) -> Array:
        """Shape (times, constraints, speeds)."""
        finite = np.where(np.isfinite(entries), entries, 0.0)
        found: Array = finite.reshape(-1, len(self._speeds), entries.shape[1]).transpose(2, 0, 1)
        return found
