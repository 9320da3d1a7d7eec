"""Drift of conserved quantities: energy less work done, closed loops, and invariants."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from polhode.algebra import Expr, SymbolKind
from polhode.base import Shown
from polhode.simulate._dynamics import WORK
from polhode.simulate._segment import Segment
from polhode.simulate.integrate._arrays import Array, ascending

_MOST_CHECKED = 20_000  # steps of a segment at which drift is evaluated
_FEW = 64  # the same, for the check that every motion undergoes
_NEGLIGIBLE = 1e-6  # size of a loop's lengths, relative to those of the largest loop


@dataclass(frozen=True)
class Drift(Shown):
    """Largest departures along a trajectory.

    Attributes:
        energy: of energy − energy at the start − work done, over the energy scale: the largest
            kinetic plus absolute potential energy, or work.
        constraint: residual of the closed loops, m; zero where there are none.
        invariants: of each invariant from its value at the start, over the largest sum of the
            sizes of its terms.
    """

    energy: float
    constraint: float
    invariants: Mapping[str, float]

    def as_json(self) -> dict[str, Any]:
        """As plain numbers under the names of the attributes."""
        return {
            "energy": self.energy,
            "constraint": self.constraint,
            "invariants": dict(self.invariants),
        }


def drift_of(segments: Sequence[Segment], invariants: Mapping[str, Expr], samples: Array) -> Drift:
    """The drift over the steps of the integrator and the samples.

    The energy is compared with the work done from the start through all contact modes.
    """
    checked = [_CheckedSegment(segment, _instants(segment, samples)) for segment in segments]
    found = {}
    for name, invariant in invariants.items():
        values = np.concatenate([one.values([invariant])[0] for one in checked])
        terms = [np.sum(np.abs(one.values(_terms(invariant))), axis=0) for one in checked]
        sizes = np.concatenate(terms)
        # As an expression it may be 0/0 at a single instant, such as that of the start.
        # Numbers of more digits are objects, which NumPy judges as doubles only.
        finite = np.isfinite(values.astype(float)) & np.isfinite(sizes.astype(float))
        if np.any(finite):
            values, sizes = values[finite], sizes[finite]
        found[name] = _relative(np.max(np.abs(values - values[0])), float(np.max(sizes)))
    return Drift(
        energy=_energy(checked),
        constraint=max(one.gap() for one in checked),
        invariants=found,
    )


def imbalance_of(segments: Sequence[Segment]) -> dict[str, float]:
    """Imbalance of energy and closed loops at a few instants, relative to the size of their terms.

    A few instants are enough: an imbalance, once there, does not disappear again.
    """
    checked = [
        _CheckedSegment(segment, _instants(segment, segment.steps[:0], _FEW))
        for segment in segments
    ]
    found = {"the energy balance": _energy(checked)}
    if any(segment.dynamics.equations.closures for segment in segments):
        found["a closed loop"] = max(one.relative_gap() for one in checked)
    return found


def _instants(segment: Segment, samples: Array, most: int = _MOST_CHECKED) -> Array:
    steps = segment.steps
    picked = steps[:: len(steps) // most + 1]
    inside = samples[(samples >= segment.begin) & (samples < segment.end)]
    # Just before its end: at the end itself the next mode has begun.
    return ascending([np.array([segment.begin, segment.end]), picked, inside])


@dataclass(frozen=True)
class _CheckedSegment:
    """A segment at chosen instants."""

    segment: Segment
    times: Array

    def values(self, expressions: list[Expr]) -> Array:
        return self.segment.values(expressions, self.times)

    def gap(self) -> float:
        closures = list(self.segment.dynamics.equations.closures)
        return float(np.max(np.abs(self.values(closures)), initial=0.0)) if closures else 0.0

    def relative_gap(self) -> float:
        """The largest gap of a loop, relative to the sum of the lengths in it.

        Where these are next to nothing, as heights that stay zero, the other loops set the scale;
        where angles in it stay zero, as of a block that stands, what they would move by a radian.
        """
        gaps, sizes = [0.0], [0.0]
        for closure in self.segment.dynamics.equations.closures:
            (values,) = self.values([closure])
            gaps.append(float(np.max(np.abs(values))))
            size, turned = (self._size(part) for part in (_terms(closure), _by_angles(closure)))
            sizes.append(size if size > _NEGLIGIBLE * turned else turned)
        least = _NEGLIGIBLE * max(sizes)
        pairs = zip(gaps, sizes, strict=True)
        return max(_relative(gap, max(size, least)) for gap, size in pairs)

    def _size(self, parts: list[Expr]) -> float:
        """The largest sum of the sizes of some expressions."""
        return float(np.max(np.sum(np.abs(self.values(parts)), axis=0), initial=0.0))


def _by_angles(closure: Expr) -> list[Expr]:
    """Slopes of a closure by the coordinates that it knows in functions alone: angles, mostly."""
    alone = {s for s in closure.symbols() if s.kind is SymbolKind.COORDINATE}
    return [closure.diff(s) for s in alone.difference(closure.generators)]


def _energy(checked: Sequence[_CheckedSegment]) -> float:
    """max |E − E₀ − W| over the energy scale: max (|T| + |V| + |W|)."""
    found = []
    for one in checked:
        equations = one.segment.dynamics.equations
        # E at zero speeds: potential energy, and the kinetic energy of prescribed motions, if any.
        potential_energy = equations.energy.subs(dict.fromkeys(equations.speeds, 0))
        found.append(one.values([equations.energy, potential_energy, Expr.generator(WORK)]))
    total, potential, work = (np.concatenate(part) for part in zip(*found, strict=True))
    done = work - work[0]
    scale = np.max(np.abs(total - potential) + np.abs(potential) + np.abs(done))
    return _relative(np.max(np.abs(total - total[0] - done)), scale)


def _terms(expression: Expr) -> list[Expr]:
    return [term / expression.denominator for term in expression.summands()]


def _relative(size: float, scale: float) -> float:
    return float(size / scale) if scale > 0 else float(size)
