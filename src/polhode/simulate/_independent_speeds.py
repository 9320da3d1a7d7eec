"""Changes the independent speeds of a motion where those chosen become singular.

The dependent speeds are D u + d. With every speed multiplied by the root of the inertia that it
moves, the entries of D are pure numbers, and of order one for a good choice: they are the factors
by which the rounding of u is amplified in the dependent speeds. They grow without limit where the
choice becomes singular. The best choice has the columns of [1; D] with the largest volume, found by
Gaussian elimination with pivots (QR factorisation with column pivoting: Businger and Golub, Linear
least squares solutions by Householder transformations, 1965).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from math import inf
from typing import Any, cast

import numpy as np

from polhode.algebra import Expr, Symbol, has_parts, variables
from polhode.base import NumericError
from polhode.derive import (
    Equations,
    inertia_of,
    may_be_singular,
    may_become_singular,
    on_independent,
)
from polhode.simulate._closed_loops import dead_point
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate._names import Name
from polhode.simulate._segment import TrajectoryPiece
from polhode.simulate._start import configuration_at_start
from polhode.simulate._values import Numbers
from polhode.simulate.integrate._arrays import Array, rows

# Entries of D, in the units above. The motion changes its speeds where one exceeds the first limit
# and has grown by as much since they were chosen: between bodies of very different masses, large
# entries are no sign of a singular position. Where it starts, nothing has grown yet.
_LARGE = 10.0
_LARGE_AT_START = 1e4
_UNBOUNDED = 1e14  # ratio of inertias beyond which speeds have lost their meaning
_APART = 1e-5  # rad, m, or s: how far from a singular start the speeds are chosen
_SHORT = 0.3  # of the longest step so far: steps become this short near a singular position
_DEPENDENT = 1e-9  # of the largest singular value of the constraints: rounding
_LEAST = 1e-12  # of the largest inertia: that of a speed which moves nothing by itself


class SpeedDependence:
    """How the dependent speeds of some equations depend on the independent ones.

    Args:
        dynamics: the equations.
    """

    def __init__(self, dynamics: Dynamics) -> None:
        self._dynamics = dynamics
        self.equations = cast(Equations, dynamics.equations)

    @cached_property
    def may_become_singular(self) -> bool:
        """Whether there may be positions at which the independent speeds have to change."""
        kinetics = getattr(self.equations, "kinetics", None)
        return kinetics is not None and may_become_singular(self.equations)

    @cached_property
    def may_be_singular(self) -> bool:
        """The same, or whether they may be singular for the values of the parameters."""
        kinetics = getattr(self.equations, "kinetics", None)
        return kinetics is not None and may_be_singular(self.equations)

    @cached_property
    def has_removable_singularities(self) -> bool:
        """Whether D may be 0/0 where it is regular.

        The denominators of expressions that are written out in full have no sines in them: instead
        of a + b sin α they are a² − b² sin²α, which has zeros of its own. Along a loop that closes,
        these are crossed sooner or later. Named parts keep the denominators as they are.
        """
        if not self.equations.closures:
            return False
        parts = (d for d in self.equations.dependent.values() if not has_parts(d))
        return any(len(variables([d.denominator])) > 1 for d in parts)

    @cached_property
    def coordinates(self) -> frozenset[Symbol]:
        """The coordinates that D depends on."""
        used = variables(self.equations.dependent.values())
        return used.intersection(self.equations.coordinates)

    @cached_property
    def speeds(self) -> tuple[Symbol, ...]:
        """All speeds: the independent ones, then the dependent ones."""
        return (*self.equations.speeds, *self.equations.dependent)

    def amplification(self, coordinates: Array, constants: Array, times: Array) -> Array:
        """The largest entry of D at some times.

        Args:
            coordinates: shape (coordinates, times).
            constants: parameters, in the order of the equations.
            times: s.
        """
        size = len(self.equations.speeds)
        scaled = self._scaled(coordinates, constants, times)
        largest: Array = np.max(np.abs(scaled[size:]), axis=(0, 1), initial=0.0)
        return largest

    def lost_at(self, state: Mapping[Symbol, Any], constants: Array) -> str:
        """In words, that the others do not follow from the independent speeds; empty if they do."""
        places = [float(state.get(q, 0.0)) for q in self.equations.coordinates]
        if not self.may_become_singular or not self.coordinates <= state.keys():
            return ""
        here = np.array(places)
        if self.is_regular(here, constants, 0.0) and not self._is_unbounded(here, constants):
            return ""
        names, others = (
            ", ".join(s.published for s in speeds)
            for speeds in (self.equations.speeds, self.equations.dependent)
        )
        return f"the independent speeds {names} do not determine {others}"

    def _is_unbounded(self, coordinates: Array, constants: Array) -> bool:
        """Whether the inertia of an independent speed is beyond all measure of another one.

        A chosen speed such as J = x v_y - y v_x has the inertia m/y² where it stands for v_x: in
        units in which speeds are comparable v_x stays regular with it.
        """
        masses = np.abs(self._inertias(coordinates[:, None], constants, np.array([0.0])))[:, 0]
        own = masses[: len(self.equations.speeds)]
        return bool(np.max(own) > _UNBOUNDED * np.min(masses[masses > 0], initial=np.inf))

    def is_regular(self, coordinates: Array, constants: Array, time: float) -> bool:
        """Whether the others follow from the independent speeds in one configuration."""
        largest = self.amplification(coordinates[:, None], constants, np.array([time]))[0]
        return bool(largest <= _LARGE_AT_START)

    def best_at_start(self, coordinates: Array, constants: Array) -> tuple[Symbol, ...] | None:
        """The speeds to be independent where a motion starts, if not those of the equations.

        Exactly at a singular position D may be rounding over rounding, as on the rate of the
        coupler of a parallelogram of bars: it is looked at beside the start, and soon after it, as
        well.
        """
        directions = np.sqrt(np.arange(2.0, 2.0 + len(coordinates))) % 1.0 + 0.5
        beside, times = coordinates + _APART * directions, np.array([0.0, _APART])
        sizes = self.amplification(np.array([coordinates, beside]).T, constants, times)
        return None if np.all(sizes <= _LARGE_AT_START) else self.best(beside, constants, _APART)

    def best(self, coordinates: Array, constants: Array, time: float) -> tuple[Symbol, ...]:
        """The speeds to be independent in one configuration, in their order among all speeds.

        Raises:
            NumericError: where none can be chosen.
        """
        times = np.array([time])
        # A rate in the place of which a user chose a speed is none that can be kept.
        known = self.equations.kinetics.all_speeds
        kept = [i for i, speed in enumerate(self.speeds) if speed in known]
        matrix = self._scaled(coordinates[:, None], constants, times)[kept, :, 0]
        if not np.all(np.isfinite(matrix)):
            places = dict(zip(self.equations.coordinates, coordinates, strict=True))
            if lost := dead_point(self._dynamics, places, constants, time):
                raise lost
            free = self._free_motions([self.speeds[i] for i in kept], coordinates, constants, time)
            if free is None:
                raise NumericError(
                    f"speeds that the constraints do not determine at t = {time:.9g} s",
                    expected="constraints that leave the same number of speeds free all along",
                    advice="end the motion before that time, or start elsewhere",
                )
            matrix = free
        chosen = []
        for _ in range(matrix.shape[1]):
            lengths = np.linalg.norm(matrix, axis=1)
            chosen.append(int(np.argmax(lengths)))
            along = matrix[chosen[-1]] / lengths[chosen[-1]]
            matrix = matrix - np.outer(matrix @ along, along)
        return tuple(self.speeds[kept[i]] for i in sorted(chosen))

    def _free_motions(
        self, speeds: Sequence[Symbol], coordinates: Array, constants: Array, time: float
    ) -> Array | None:
        """The motions that the constraints allow, where D is not finite, in the same units.

        Shape (speeds, independent); None where the constraints leave another number of them.
        """
        kinetics, dynamics = self.equations.kinetics, self._dynamics
        count = len(self.equations.speeds)
        if set(speeds) != set(kinetics.all_speeds) or not kinetics.constraints:
            return None
        order = [kinetics.all_speeds.index(s) for s in speeds]
        entries = [row[j] for row in kinetics.constraint_rows() for j in order]
        inertias = [inertia_of(self.equations, speed) for speed in speeds]
        known = (*self.equations.coordinates, *dynamics.parameters, CLOCK)
        function = dynamics.function([*entries, *inertias], known)
        with np.errstate(all="ignore"):
            values = rows(function(*coordinates, *constants, time), 1)[:, 0]
        table, masses = values[: len(entries)].reshape(-1, len(speeds)), values[len(entries) :]
        if not np.all(np.isfinite(values)):
            return None
        scaled = table / np.sqrt(np.maximum(masses, _LEAST * np.max(masses)))
        _, sizes, across = np.linalg.svd(scaled)
        rank = int(np.count_nonzero(sizes > _DEPENDENT * np.max(sizes)))
        return across[rank:].T if len(speeds) - rank == count else None

    def _scaled(self, coordinates: Array, constants: Array, times: Array) -> Array:
        """[1; D] in units in which speeds are comparable, shape (speeds, independent, times)."""
        speeds, dependent = self.equations.speeds, tuple(self.equations.dependent)
        size, count = len(speeds), len(times)
        relations, _ = self._functions
        known = (*constants, times)

        def at(values: Array) -> Array:
            with np.errstate(all="ignore"):
                found: Array = rows(relations(*coordinates, *values, *known), count)
            return found

        rest = at(np.zeros(size))
        slopes = np.array([at(unit) - rest for unit in np.eye(size)]).reshape(
            size, len(dependent), count
        )
        unit = np.repeat(np.eye(size)[:, :, None], count, axis=2)
        matrix = np.concatenate([unit, slopes.transpose(1, 0, 2)])
        masses = self._inertias(coordinates, constants, times)
        roots = np.sqrt(np.maximum(masses, _LEAST * np.max(masses, axis=0)))
        scaled: Array = roots[:, None, :] * matrix / roots[None, :size, :]
        return scaled

    def _inertias(self, coordinates: Array, constants: Array, times: Array) -> Array:
        """Of all speeds, shape (speeds, times)."""
        _, inertias = self._functions
        still = np.zeros(len(self.equations.speeds))
        with np.errstate(all="ignore"):
            found: Array = rows(inertias(*coordinates, *still, *constants, times), len(times))
        return found

    @cached_property
    def _functions(self) -> tuple:  # type: ignore[type-arg]
        dynamics, equations = self._dynamics, self.equations
        own = (*equations.coordinates, *equations.speeds)
        arguments = (*own, *dynamics.parameters, CLOCK)
        dependent = [Expr.generator(symbol) for symbol in equations.dependent]
        inertias = [inertia_of(equations, speed) for speed in self.speeds]
        return dynamics.function(dependent, arguments), dynamics.function(inertias, arguments)


class SpeedChoices:
    """The equations of one system on all choices of independent speeds that a motion needs.

    Args:
        dynamics: the equations as they were derived, of which no sides of absolute values are
            known.
    """

    def __init__(self, dynamics: Dynamics) -> None:
        self._first = dynamics
        self._known = {frozenset(dynamics.equations.speeds): dynamics}
        self._dependences: dict[int, SpeedDependence] = {}

    def on(self, speeds: Iterable[Symbol]) -> Dynamics:
        """The equations on some independent speeds, derived when they are first needed."""
        kept = tuple(speeds)
        chosen = frozenset(kept)
        if chosen not in self._known:
            equations = on_independent(self._first.equations.system, kept)
            self._known[chosen] = replace(self._first, equations=equations)
        return self._known[chosen]

    def dependence(self, dynamics: Dynamics) -> SpeedDependence:
        """How the dependent speeds follow from the independent ones, in some of these equations."""
        return self._dependences.setdefault(id(dynamics), SpeedDependence(dynamics))

    def at_start(
        self, start: Mapping[Name, Any], numbers: Callable[[Dynamics], Numbers]
    ) -> Dynamics:
        """The equations with which a motion starts: as derived, unless they are singular there.

        Args:
            start: given values of coordinates and speeds.
            numbers: the constants of some equations.
        """
        dynamics = self._first
        dependence = self.dependence(dynamics)
        if not dependence.may_be_singular:
            return dynamics
        if dependence.may_become_singular and dependence.has_removable_singularities:
            self._known = {}
            dynamics = self.on(dynamics.equations.speeds)
            dependence = self.dependence(dynamics)
        known = numbers(dynamics)
        found = configuration_at_start(dynamics, start, known)
        coordinates = np.array(list(found.values()))
        constants = np.array([known[s] for s in dynamics.parameters])
        return self.on(
            dependence.best_at_start(coordinates, constants) or dynamics.equations.speeds
        )


class SpeedWatch:
    """Watches along a motion whether its independent speeds become singular.

    Args:
        dependence: of the dependent speeds on the present ones.
    """

    def __init__(self, dependence: SpeedDependence) -> None:
        self._dependence = dependence
        self._equations = dependence.equations
        self._least = inf

    @property
    def is_needed(self) -> bool:
        """Whether they can become singular at all."""
        return self._dependence.may_become_singular

    def overshoot(
        self, core: Sequence[Symbol], constants: Array
    ) -> Callable[[float, Sequence[float]], bool] | None:
        """Whether the speeds are singular at the end of a step; None where a core cannot tell.

        Only steps that have become short are looked at: a singular position shortens them.

        Args:
            core: the states that are integrated.
            constants: parameters, in the order of the equations.
        """
        coordinates = self._equations.coordinates
        places = [core.index(q) if q in core else None for q in coordinates]
        if not self.is_needed or not self._dependence.coordinates <= set(core):
            return None
        last, longest = -inf, 0.0

        def over(time: float, state: Sequence[float]) -> bool:
            nonlocal last, longest
            step, last = time - last, time
            longest = max(longest, step if step < inf else 0.0)
            if self._least < inf and step > _SHORT * longest:
                return False
            here = np.array([[0.0 if i is None else state[i]] for i in places])
            (size,) = self._dependence.amplification(here, constants, np.array([time]))
            self._least = min(self._least, float(size))
            return not size <= self._limit

        return over

    @property
    def _limit(self) -> float:
        return _LARGE * max(self._least, 1.0)

    def regular_part(
        self, piece: TrajectoryPiece
    ) -> tuple[TrajectoryPiece, tuple[Symbol, ...] | None]:
        """A piece up to where other speeds have to be independent, and these; None if nowhere.

        Raises:
            NumericError: where the constraints leave other numbers of speeds free.
        """
        if not self.is_needed:
            return piece, None
        times = piece.solution.steps
        times = times[times <= piece.end]
        coordinates = self._coordinates(piece, times)
        sizes = self._dependence.amplification(coordinates, piece.constants, times)
        for k, size in enumerate(sizes):
            if k and not size <= self._limit:
                best = self._dependence.best(coordinates[:, k], piece.constants, times[k])
                if set(best) != set(self._equations.speeds):
                    # one step earlier, where the factor was still small
                    return replace(piece, end=float(times[max(k - 1, 1)])), best
                self._least = size
            self._least = min(self._least, size)
        return piece, None

    def _coordinates(self, piece: TrajectoryPiece, times: Array) -> Array:
        states = dict(zip(piece.solution.symbols, piece.states(times), strict=True))
        return np.array([states[q] for q in self._equations.coordinates])
