"""Maps over two quantities: stability of steady motions, and outcomes of motions."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from polhode.algebra import Expr, ExprLike, Symbol, arrays, as_symbol, compile_program, dimension_of
from polhode.analyse import Stability, SteadyMotion, stability
from polhode.base import PURE, DeclarationError, Dimension, Value, colours, look_up, to_si
from polhode.derive import Equations, is_angle
from polhode.study import Found, Threshold
from polhode.view._quantities import Array, Scale, label, largest, math, scale_for, si_unit
from polhode.view.figures._figure import InFigure, axes_or_new
from polhode.view.figures._style import (
    COLOURS,
    DASHES,
    FAINT,
    INK,
    MUTED,
    SHADES,
    house_style,
    worded,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import QuadMesh
    from matplotlib.colors import Colormap
    from matplotlib.contour import QuadContourSet
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch


_LONGEST = 70  # characters of LaTeX that fit in a legend
_POINTS = 161  # of a stability map, along each side
_FINE = 201  # of a threshold on a map of outcomes, likewise
# A double root has an error of about the square root of machine precision, 1e-8: relative growth
# below this is rounding.
_ROUNDING = 1e-6  # relative growth

_POINT: Mapping[str, Any] = {"marker": "D", "markersize": 5}  # of a threshold

_WORDS = {"duration": "duration (s)"}  # outputs that are no quantity of the system

#: A quantity with the least and the greatest value to draw, such as ("omega_3", "0", "40 rad/s").
Span = tuple[str | Symbol | Expr, Value, Value]


@dataclass(frozen=True)
class StabilityMap(InFigure):
    """The artists drawn by `stability_map`.

    Attributes:
        growth: rate of the fastest growing departure, 1/s, from the roots of the characteristic
            polynomial at every point.
        thresholds: lines on which the exact conditions change sign, one for each condition.
    """

    growth: QuadMesh
    thresholds: tuple[QuadContourSet, ...]

    @property
    def axes(self) -> Axes:
        """The axes it is drawn in."""
        return cast("Axes", self.growth.axes)


@house_style()
def stability_map(
    family: SteadyMotion,
    x: Span,
    y: Span,
    numbers: Mapping[Any, Value] | None = None,
    *,
    at: Mapping[Any, ExprLike] | None = None,
    branch: int = 0,
    ax: Axes | None = None,
) -> StabilityMap:
    """Growth of departures from a steady motion over two quantities, and the exact threshold.

    White is stable. On the lines, conditions derived by `ph.stability` change sign; the shade is
    computed independently of them, from the exponents at every point.

    Args:
        family: from `ph.steady`.
        x: quantity, least and greatest value along the page.
        y: the same up the page.
        numbers: values of the other parameters and state variables that matter.
        at: further exact conditions on the family, as for `ph.stability`.
        branch: which of the family's branches, if a relation gives several; points without such
            a motion are hatched.
        ax: axes to draw in.

    Raises:
        DeclarationError: if a value is missing.
        UnitError: for a value with the wrong unit.
    """
    axes = axes_or_new(ax, 3.2)
    found = stability(family, at)
    field = _Field(found, (_axis(found, x), _axis(found, y)), numbers or {}, branch)
    across, up = (axis.values * axis.scale.factor for axis in field.axes)
    growth = _growth(found, field)
    mesh = axes.pcolormesh(
        across, up, growth, cmap=_shades(), shading="nearest", rasterized=True, vmin=0
    )
    thresholds = [field.values(condition.expression) for condition in found.conditions]
    colour = COLOURS[0]
    lines = tuple(
        _threshold_line(axes, (across, up), values, i, colour)
        for i, values in enumerate(thresholds)
    )
    keys = [
        _threshold_key(condition.expression, i, colour)
        for i, (condition, line) in enumerate(zip(found.conditions, lines, strict=True))
        if any(len(path) for path in line.allsegs[0])
    ]
    nowhere = _gap(axes, (across, up), ~np.isfinite(growth), "////", "no such motion")
    _legend(axes, [*keys, *nowhere])
    axes.figure.colorbar(mesh, ax=axes, label="growth (1/s)", pad=0.03)
    axes.grid(visible=False)
    axes.set_xlabel(field.axes[0].label)
    axes.set_ylabel(field.axes[1].label)
    return StabilityMap(mesh, lines)


@dataclass(frozen=True)
class _MapAxis:
    """A quantity with the values it takes along one side of the map, SI."""

    symbol: Symbol
    values: Array
    scale: Scale

    @property
    def label(self) -> str:
        return label(math(Expr.generator(self.symbol)), self.scale)


def _axis(found: Stability, span: Span) -> _MapAxis:
    if isinstance(span, str) or len(span) != 3:
        raise DeclarationError(
            f"{span!r} along a side of a map",
            expected="a quantity with its least and greatest value",
            advice="for instance ('omega_3', 0, '40 rad/s')",
        )
    name, *ends = span
    equations = found.family.reduced.equations
    symbol = _symbol(equations, name)
    dimension = _dimension(equations, symbol)
    low, high = (to_si(end, dimension, symbol.published) for end in ends)
    unit = si_unit(dimension, angle=is_angle(equations, symbol))
    values = np.linspace(low, high, _POINTS)
    return _MapAxis(symbol, values, scale_for(unit, float(np.max(np.abs(values)))))


def _symbol(equations: Equations, name: str | Symbol | Expr) -> Symbol:
    if not isinstance(name, str):
        return as_symbol(name)
    rates = [q.derivative() for q in equations.coordinates]
    known = [*equations.coordinates, *equations.speeds, *rates, *equations.parameters]
    return look_up(name, {s.published: s for s in known}, f"quantity of {equations.system.name}")


def _dimension(equations: Equations, symbol: Symbol) -> Dimension:
    return dimension_of(Expr.generator(symbol), equations.dimensions) or PURE


@dataclass(frozen=True)
class _Field:
    """Values over the map of expressions on the family."""

    found: Stability
    axes: tuple[_MapAxis, _MapAxis]
    numbers: Mapping[Any, Value]
    branch: int

    def values(self, expression: Expr) -> Array:
        """An expression at every point, shape (up, across); not a number where not real."""
        reduced = expression.subs(self._related)
        first, second = (axis.symbol for axis in self.axes)
        others = tuple(s for s in reduced.symbols() if s not in (first, second))
        known = self._known
        lacking = [s.published for s in others if s not in known]
        if lacking:
            raise DeclarationError(
                f"no value of {', '.join(sorted(lacking))} for a map of stability",
                expected="a number for every quantity that is not along an axis",
            )
        function = compile_program([reduced], (first, second, *others)).function(arrays())
        across, up = np.meshgrid(*(axis.values for axis in self.axes))
        with np.errstate(all="ignore"):
            (found,) = function(across, up, *(known[s] for s in others))
        return np.broadcast_to(np.asarray(found, dtype=float), across.shape)

    @cached_property
    def _known(self) -> dict[Symbol, float]:
        equations = self.found.family.reduced.equations
        symbols = {_symbol(equations, name): value for name, value in self.numbers.items()}
        return {
            symbol: to_si(value, _dimension(equations, symbol), symbol.published)
            for symbol, value in symbols.items()
        }

    @cached_property
    def _related(self) -> dict[Expr, Expr]:
        """The quantity that the family's relation gives, by the others."""
        family = self.found.family
        if len(family.relations) != 1:
            return {}
        given = {*self._known, *(axis.symbol for axis in self.axes)}
        (relation,) = family.relations
        for symbol in (s for s in relation.symbols() if s not in given):
            quantity = Expr.generator(symbol)
            slope, rest = relation.diff(symbol), relation.subs({symbol: Expr.of(0)})
            if symbol not in slope.symbols():
                return {quantity: -rest / slope}
            branches = [b for b in family.branches if b.quantity == quantity]
            return {quantity: branches[self.branch].value} if branches else {}
        return {}


def _growth(found: Stability, field: _Field) -> Array:
    """Greatest real part of the exponents at every point, 1/s."""
    # An even polynomial is solved for the square of the exponent: growth is then exactly zero for
    # a centre, where the roots of the full polynomial would be rounded off the imaginary axis.
    step = 2 if found.is_even else 1
    coefficients = np.array([field.values(c) for c in found.oscillating[::step]])
    flat = coefficients.reshape(len(coefficients), -1)
    real = np.all(np.isfinite(flat), axis=0)
    greatest = np.full(flat.shape[1], np.nan)
    roots = _roots(flat[:, real])
    exponents = np.sqrt(roots.astype(complex)) if found.is_even else roots
    size = np.max(np.abs(exponents), axis=1, initial=0.0)
    growth = np.max(np.abs(exponents.real) if found.is_even else exponents.real, axis=1, initial=0)
    greatest[real] = np.where(growth > _ROUNDING * size, growth, 0.0)
    return greatest.reshape(coefficients.shape[1:])


def _roots(coefficients: Array) -> NDArray[np.complex128]:
    """Roots of polynomials, lowest power first: shape (powers, n) to (n, powers − 1).

    They are the eigenvalues of the companion matrices, all points of the map in one call.
    """
    degree = len(coefficients) - 1
    companion = np.zeros((coefficients.shape[1], degree, degree))
    companion[:, 1:, :-1] = np.eye(degree - 1)
    companion[:, :, -1] = -(coefficients[:-1] / coefficients[-1]).T
    found: NDArray[np.complex128] = np.linalg.eigvals(companion).astype(complex)
    return found


def _shades() -> Colormap:
    """White where nothing grows, darker the faster it grows."""
    from matplotlib.colors import LinearSegmentedColormap

    return LinearSegmentedColormap.from_list(
        "growth", ["#ffffff", SHADES[1], COLOURS[1], colours("figures")["deepest"]]
    )


# --- outcomes of motions ---


@dataclass(frozen=True)
class OutcomeMap(InFigure):
    """The artists drawn by `outcome_map`.

    Attributes:
        mesh: the outcomes.
        thresholds: lines on which exact conditions of stability change sign, and points of those
            that concern one value along an axis only.
        conditions: the threshold that each of them shows.
    """

    mesh: QuadMesh
    thresholds: tuple[QuadContourSet | Line2D, ...]
    conditions: tuple[Threshold, ...]

    @property
    def axes(self) -> Axes:
        """The axes it is drawn in."""
        return cast("Axes", self.mesh.axes)


@house_style()
def outcome_map(found: Found, *, ax: Axes | None = None) -> OutcomeMap:
    """An output of a sweep over its two axes; lines are exact thresholds of steady motions.

    A line runs where starts of the map are close to the steady motion of its threshold. Where
    they are at one value along an axis only, as at θ = π/2 for an upright disk, the threshold is a
    point. Angles are in degrees. Motions that could not be simulated are hatched.

    Args:
        found: from `ph.study.found_in`.
        ax: axes to draw in.
    """
    axes = axes_or_new(ax, 3.4)
    names = tuple(found.axes)
    scales = [_scale(found, name, values) for name, values in found.axes.items()]
    sides = [values * s.factor for values, s in zip(found.axes.values(), scales, strict=True)]
    across, up = sides
    scale = _scale(found, found.output, found.values)
    shown = found.values.T * scale.factor
    mesh = axes.pcolormesh(across, up, shown, shading="nearest", rasterized=True)
    keys = [*(_codes(found, mesh) if found.labels else ())]
    empty = ~np.isfinite(shown)
    failed = empty & (found.failed.T if found.failed is not None else False)
    keys += _gap(axes, (across, up), failed, "////", "could not be simulated")
    keys += _gap(axes, (across, up), empty & ~failed, "....", "no result")
    if not found.labels:
        axes.figure.colorbar(mesh, ax=axes, label=_label(found, found.output, scale), pad=0.03)
    lines, conditions = _thresholds(axes, found, scales)
    keys_of_lines = [_key_of(found, c, i) for i, c in enumerate(conditions)]
    _legend(axes, [*keys, *keys_of_lines])
    axes.grid(visible=False)
    axes.set_xlabel(_label(found, names[0], scales[0]))
    axes.set_ylabel(_label(found, names[1], scales[1]))
    return OutcomeMap(mesh, lines, conditions)


def _thresholds(
    axes: Axes, found: Found, scales: list[Scale]
) -> tuple[tuple[QuadContourSet | Line2D, ...], tuple[Threshold, ...]]:
    """Thresholds that run through the map."""
    sides = [_fine(values) for values in found.axes.values()]
    drawn: dict[Threshold, QuadContourSet | Line2D] = {}
    for threshold in found.thresholds:
        # one value is enough along an axis on which only that one belongs to the steady motion
        own = [np.array([threshold.only_at.get(n, np.nan)]) for n in found.axes]
        pinned = [name in threshold.only_at for name in found.axes]
        along = [o if p else side for o, p, side in zip(own, pinned, sides, strict=True)]
        grid = np.array(np.meshgrid(*along))
        first, second = found.axes
        heights = threshold.values((first, second), found.numbers, grid)
        if not np.min(heights) < 0 < np.max(heights):
            continue
        shown = (grid[0] * scales[0].factor, grid[1] * scales[1].factor)
        draw = _threshold_points if any(pinned) else _threshold_line
        drawn[threshold] = draw(axes, shown, heights, len(drawn), INK)
    return tuple(drawn.values()), tuple(drawn)


def _key_of(found: Found, threshold: Threshold, number: int) -> Line2D:
    """The entry of a threshold in the legend."""
    key = _threshold_key(threshold.condition, number, INK)
    for name, value in threshold.only_at.items():
        scale = _scale(found, name, np.array([value]))
        known = found.measured[name]
        own = f"{math(Expr.generator(known.symbol))} = {value * scale.factor:.4g} {scale.unit}"
        key.set(label=f"{key.get_label()} at {own.strip()}", linestyle="none", **_POINT)
    return key


def _scale(found: Found, name: str, values: Array) -> Scale:
    """The unit in which a quantity of the system is shown; other outputs are not scaled."""
    known = found.measured.get(name)
    if known is None:
        return Scale("", 1.0)
    return scale_for(si_unit(known.dimension, angle=known.is_angle), largest(_finite(values)))


def _label(found: Found, name: str, scale: Scale) -> str:
    known = found.measured.get(name)
    if known is None:
        return _WORDS.get(name, worded(name))
    return label(math(Expr.generator(known.symbol)), scale)


def _codes(found: Found, mesh: QuadMesh) -> list[Patch]:
    from matplotlib.colors import BoundaryNorm, ListedColormap
    from matplotlib.patches import Patch

    colours = [COLOURS[k % len(COLOURS)] for k in range(len(found.labels))]
    mesh.set_cmap(ListedColormap(colours))
    mesh.set_norm(BoundaryNorm(np.arange(len(colours) + 1) - 0.5, len(colours)))
    present = np.unique(_finite(found.values)).astype(int)
    return [Patch(color=colours[code], label=worded(found.labels[code])) for code in present]


def _finite(values: Array) -> Array:
    return values[np.isfinite(values)]


def _fine(values: Array) -> Array:
    return np.linspace(float(np.min(values)), float(np.max(values)), _FINE)


# --- thresholds, gaps and the legend of both ---


def _threshold_line(
    axes: Axes, grid: tuple[Array, Array], values: Array, number: int, colour: str
) -> QuadContourSet:
    """The line on which a condition changes sign; each has a different dash pattern."""
    dashes = [DASHES[number % len(DASHES)]]
    style: dict[str, Any] = {"colors": [colour], "linewidths": 1.7, "linestyles": dashes}
    return axes.contour(*grid, values, [0.0], **style)


def _threshold_points(
    axes: Axes, grid: tuple[Array, Array], values: Array, number: int, colour: str
) -> Line2D:
    """The points of one side of a map at which a condition changes sign."""
    across, up, heights = grid[0].ravel(), grid[1].ravel(), values.ravel()
    at = np.flatnonzero(np.signbit(heights[:-1]) != np.signbit(heights[1:]))
    share = heights[at] / (heights[at] - heights[at + 1])
    points = [c[at] + share * (c[at + 1] - c[at]) for c in (across, up)]
    (drawn,) = axes.plot(*points, color=colour, linestyle="none", clip_on=False, **_POINT)
    return drawn


def _threshold_key(condition: Expr, number: int, colour: str) -> Line2D:
    """The entry of such a line in the legend."""
    from matplotlib.lines import Line2D

    formula = f"${condition.latex()} = 0$"
    label = f"threshold: {formula}" if _is_legible(formula) else "threshold of stability"
    return Line2D([], [], color=colour, linestyle=DASHES[number % len(DASHES)], label=label)


def _gap(
    axes: Axes, grid: tuple[Array, Array], where: NDArray[np.bool_], hatch: str, label: str
) -> list[Patch]:
    """Hatch points, shape (up, across); returns their entry in the legend, if there are any."""
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    if not np.any(where):
        return []
    style: dict[str, Any] = {"hatch": hatch, "edgecolor": MUTED, "linewidth": 0}
    shown = np.ma.masked_where(~where, np.zeros(where.shape))
    cells = axes.pcolor(*grid, shown, cmap=ListedColormap([FAINT]), shading="nearest", zorder=0)
    cells.set(**style)
    return [Patch(facecolor=FAINT, label=label, **style)]


def _legend(axes: Axes, handles: Sequence[Line2D | Patch]) -> None:
    """A legend above the axes, in two columns where there is more than one entry."""
    if handles:
        columns = min(len(handles), 2)
        axes.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns)


def _is_legible(formula: str) -> bool:
    from matplotlib.mathtext import MathTextParser

    if len(formula) > _LONGEST:
        return False
    try:
        MathTextParser("path").parse(formula)
    except ValueError:  # LaTeX that matplotlib does not support
        return False
    return True
