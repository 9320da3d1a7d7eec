"""Maps of outcomes that are refined only at the boundaries between them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr
from polhode.base import DeclarationError, Progress, SilentProgress
from polhode.derive import Automaton, Equations
from polhode.study._columns import Array, Column, Members, Name, published_names
from polhode.study._ensemble_runner import EnsembleRunner, EnsembleSpec, Subject, options_of
from polhode.study._grid import split_axes
from polhode.study._maps import Found, measured, plain_numbers, thresholds
from polhode.study._output import Output
from polhode.study._outputs import Fate
from polhode.study._refused import parameter_names, refuse_mistakes

_MOST = 16_385  # points along an axis


@dataclass(frozen=True)
class Refined:
    """A map whose boundaries are resolved to the finest grid.

    Attributes:
        found: the map, as `outcome_map` draws it; points that were not computed, away from
            boundaries, have the outcome of their neighbours.
        computed: which points were computed, shape of the map.
    """

    found: Found
    computed: NDArray[np.bool_]

    @property
    def members(self) -> int:
        """How many motions were simulated."""
        return int(np.sum(self.computed))


def refine_map(
    subject: Subject,
    axes: Mapping[Name, tuple[float, float]],
    parameters: Mapping[Name, Any],
    start: Mapping[Name, Any],
    duration: Any,
    *,
    outcome: Output | None = None,
    coarse: int = 17,
    levels: int = 4,
    forcing: Mapping[Name, Expr] | None = None,
    near_flat: float | None = None,
    until: Sequence[str] | None = None,
    progress: Progress | None = None,
) -> Refined:
    """The outcome of motions over two quantities, refined where outcomes differ.

    Every cell of a coarse grid whose corners differ, and every neighbour of such a cell, is divided
    into four, repeatedly. Regions thinner than a coarse cell may be missed.

    Args:
        subject: a declaration, its automaton, or equations derived from it.
        axes: least and greatest value of two quantities, SI.
        parameters: the value of every other parameter.
        start: other start values.
        duration: s.
        outcome: an output that is one code; by default the `Fate`.
        coarse: points of the coarse grid along each axis.
        levels: how often a cell is divided: the map has (coarse − 1)·2^levels + 1 points a side.
        forcing, near_flat, until: as in `ensemble`.
        progress: called for every member.

    Raises:
        DeclarationError: unless there are two axes, and the outcome is a code.
    """
    options = options_of(forcing=forcing, near_flat=near_flat, until=until)
    chosen = outcome or Fate()
    spec = EnsembleSpec(subject, duration, {"outcome": chosen}, options)
    _check(axes, chosen, spec, coarse, levels)
    side = (coarse - 1) * 2**levels + 1
    ends = published_names(axes)
    spans = {name: np.linspace(*_ends(name, span), side) for name, span in ends.items()}
    fixed = (published_names(parameters), published_names(start))
    own, others = split_axes(list(spans), parameter_names(spec))
    refuse_mistakes(
        spec,
        {**fixed[0], **{name: Column(spans[name]) for name in own}},
        {**fixed[1], **{name: Column(spans[name]) for name in others}},
    )
    shown = progress or SilentProgress()
    shown.begin("members")
    try:
        points = _Points(spec, spans, fixed, shown)
        computed = _refined(points, side, 2**levels)
    finally:
        shown.finish()
    numbers = plain_numbers({**fixed[0], **fixed[1]})
    return Refined(_found(spec, spans, points.codes, numbers), computed)


def _ends(name: str, span: Any) -> tuple[float, float]:
    ends = np.asarray(span)
    if ends.shape != (2,) or ends.dtype.kind not in "fiu" or not np.all(np.isfinite(ends)):
        raise DeclarationError(
            f"the axis {name} = {span!r}"[:200], expected="its least and greatest value in SI units"
        )
    return float(ends[0]), float(ends[1])


def _check(
    axes: Mapping[Name, Any],
    outcome: Output,
    spec: EnsembleSpec,
    coarse: int,
    levels: int,
) -> None:
    if len(axes) != 2:
        raise DeclarationError(f"a map over {len(axes)} axes", expected="two")
    if outcome.shape or not outcome.labels(spec.legend):
        raise DeclarationError(f"the outcome {outcome}", expected="one code, such as Fate()")
    if coarse < 2 or levels < 0 or (coarse - 1) * 2**levels >= _MOST:
        raise DeclarationError(
            f"a grid of {coarse} points a side divided {levels} times",
            expected=f"at least two points, and at most {_MOST} a side on the finest grid",
        )


class _Points:
    """Outcomes at points of the finest grid, computed on demand."""

    def __init__(
        self,
        spec: EnsembleSpec,
        spans: Mapping[str, Array],
        fixed: tuple[Mapping[str, Any], Mapping[str, Any]],
        progress: Progress,
    ) -> None:
        side = len(next(iter(spans.values())))
        self.codes = np.full((side, side), -1.0)
        self._runner = EnsembleRunner(spec)
        self._spans = spans
        self._fixed = fixed
        self._constants = parameter_names(spec)
        self._progress = progress

    def compute(self, where: NDArray[np.bool_]) -> None:
        """Compute the points of a mask."""
        places = np.nonzero(where)
        columns = {
            name: Column(span[place])
            for (name, span), place in zip(self._spans.items(), places, strict=True)
        }
        own = {name: c for name, c in columns.items() if name in self._constants}
        moved = {name: c for name, c in columns.items() if name not in self._constants}
        parameters, start = self._fixed
        members = Members(len(places[0]), {**parameters, **own}, {**start, **moved})
        results = self._runner.follow(members, self._progress.advance)
        self.codes[where] = results.values["outcome"]


def _refined(points: _Points, side: int, stride: int) -> NDArray[np.bool_]:
    """Compute the points that are needed, and give all others the outcome of their neighbours."""
    computed = np.zeros((side, side), dtype=bool)
    computed[::stride, ::stride] = True
    points.compute(computed)
    active = np.ones(((side - 1) // stride,) * 2, dtype=bool)
    while stride > 1:
        codes = points.codes[::stride, ::stride]
        corners = np.stack([codes[:-1, :-1], codes[1:, :-1], codes[:-1, 1:], codes[1:, 1:]])
        mixed = np.any(corners != corners[0], axis=0)
        # A cell is divided if it or one of its eight neighbours is mixed: a boundary may enter a
        # cell between two corners that agree.
        padded = np.pad(mixed, 1)
        rows, columns = mixed.shape
        neighbours = [padded[i : i + rows, j : j + columns] for i in range(3) for j in range(3)]
        active &= np.any(np.stack(neighbours), axis=0)
        half = stride // 2
        needed = np.zeros_like(computed)
        for i, j in np.argwhere(active) * stride:
            needed[i : i + stride + 1 : half, j : j + stride + 1 : half] = True
        new = needed & ~computed
        points.compute(new)
        computed |= new
        _inherit(points.codes, computed, stride)
        active = np.repeat(np.repeat(active, 2, axis=0), 2, axis=1)  # each cell is now four
        stride = half
    return computed


def _inherit(codes: Array, computed: NDArray[np.bool_], stride: int) -> None:
    """Points between those of the coarser grid take the code of its nearest, unless computed."""
    half = stride // 2
    rows = np.arange(0, len(codes), half)
    nearest = (rows + half // 2) // stride * stride
    finer = codes[np.ix_(rows, rows)]
    known = computed[np.ix_(rows, rows)]
    codes[np.ix_(rows, rows)] = np.where(known, finer, codes[np.ix_(nearest, nearest)])


def _found(
    spec: EnsembleSpec, spans: Mapping[str, Array], codes: Array, numbers: Mapping[str, float]
) -> Found:
    derived = spec.derived
    equations: Equations = derived.together.equations if isinstance(derived, Automaton) else derived
    return Found(
        system=equations.system.name,
        output="outcome",
        labels=spec.outputs["outcome"].labels(spec.legend),
        axes=dict(spans),
        values=np.where(codes < 0, np.nan, codes),
        thresholds=tuple(thresholds(equations, spans, numbers)),
        numbers=numbers,
        origin="",
        measured=measured(equations, spans),
        failed=codes < 0,
    )
