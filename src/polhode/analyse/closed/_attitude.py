"""Coordinates and speeds of a body from its attitude, for any usual sequence of angles.

R = Rot(m₁, q₁) Rot(m₂, q₂) Rot(m₃, q₃) K with m₂ perpendicular to m₁ and m₃ (P. Davenport, 1973):
every usual sequence of angles has this form, even with reversed signs and constant rotations in
between.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

from polhode.algebra import (
    ONE,
    Arithmetic,
    Expr,
    Matrix,
    Row,
    Symbol,
    SymbolKind,
    arrays,
    compile_program,
    cos,
    dot,
    eliminate,
    linear_parts,
    rotation,
    sin,
    variables,
)
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._reals import Array, DoubleReals, Reals
from polhode.analyse.closed._solution import ExactSolution, Solvable
from polhode.base import NumericError
from polhode.derive import Equations
from polhode.model import Body

Vec = Sequence[Any]

_W = tuple(Symbol(f"turning along {label}") for label in "xyz")


@dataclass(frozen=True)
class Chart:
    """The angles that describe the attitude of a body.

    Attributes:
        body: the body.
        angles: three coordinates, or two for a body whose spin angle is not a coordinate.
        axes: m₁, m₂ and m₃, or the body's axis at q = 0 in place of the last.
        constant: K.
        speeds: on which its angular velocity depends.
        solved: the speeds in terms of the angles and the angular velocity along the root's axes.
    """

    body: Body
    angles: tuple[Symbol, ...]
    axes: tuple[Row, Row, Row]
    constant: Matrix
    speeds: tuple[Symbol, ...]
    solved: Row

    @classmethod
    def of(cls, equations: Equations, body: Body, axis: Row) -> Chart | None:
        """The chart of a body, with an axis along its own; None for angles of another form."""
        fixed = body.fixed_axes
        turns = _turns(body)
        if fixed is None or turns is None:
            return None
        angles, about, constant = turns
        if len(angles) == 2:
            about = (*about, constant.times(axis))
        if len(about) != 3 or dot(about[0], about[1]) or dot(about[1], about[2]):
            return None
        solved = _solved(equations, body, axis, len(angles))
        if solved is None:
            return None
        first, second, third = about
        return cls(body, angles, (first, second, third), constant, *solved)

    @property
    def attitude(self) -> Matrix:
        """Components along axes fixed in the body → along the root's, in terms of the angles."""
        fixed = self.body.fixed_axes or self.body.axes
        return fixed.rotation_to(self.body.axes.root)


def _turns(body: Body) -> tuple[tuple[Symbol, ...], tuple[Row, ...], Matrix] | None:
    """Angles, the directions of their axes at q = 0, and the remaining constant rotation."""
    angles: list[Symbol] = []
    about: list[Row] = []
    constant = Matrix.diagonal([1, 1, 1])
    frames = [] if body.fixed_axes is None else body.fixed_axes.lineage[-2::-1]
    for frame in frames:
        turning = [s for s in frame.angle.symbols() if s.kind.varies]
        rest = frame.angle
        if turning:
            (angle, *more) = turning
            slope = frame.angle.diff(angle)
            if more or angle.kind is not SymbolKind.COORDINATE or slope not in (ONE, -ONE):
                return None
            rest = frame.angle - slope * Expr.generator(angle)
            angles.append(angle)
            about.append(tuple(slope * c for c in constant.times(frame.axis)))
        constant = constant @ rotation(frame.axis, cos(rest), sin(rest))
    return (tuple(angles), tuple(about), constant) if len(set(angles)) == len(about) else None


def _solved(
    equations: Equations, body: Body, axis: Row, count: int
) -> tuple[tuple[Symbol, ...], Row] | None:
    """Speeds of a body, as many as its angles, in terms of its angular velocity."""
    turning = equations.kinetics.velocities[body][1].express(body.axes).components
    speeds = tuple(s for s in equations.speeds if s in variables(turning))
    given = body.axes.root.rotation_to(body.axes).times([Expr.generator(s) for s in _W])
    if count == 2:  # only the part of the angular velocity that moves the axis is known
        turning, given = _across(turning, axis), _across(given, axis)
    try:
        parts = [linear_parts(component, speeds) for component in turning]
    except NumericError:
        return None
    right = [g - rest for g, (_, rest) in zip(given, parts, strict=True)]
    found = eliminate([row for row, _ in parts], right)
    if len(speeds) != count or found.free:
        return None
    return speeds, tuple(found.solved[j][1] for j in range(count))


def _across(vector: Row, axis: Row) -> Row:
    along = dot(vector, axis)
    return tuple(c - along * a for c, a in zip(vector, axis, strict=True))


@dataclass(frozen=True)
class NumericChart:
    """A chart with numbers for all constants.

    Attributes:
        chart: the chart.
        data: exact values of parameters and start.
    """

    chart: Chart
    data: Data

    @cached_property
    def initial_attitude(self) -> list[list[Any]]:
        """The attitude at t = 0."""
        return [[self.data.number(entry) for entry in row] for row in self.chart.attitude.rows]

    @cached_property
    def _directions(self) -> tuple[list[Any], ...]:
        """m₁, m₂, m₁ × m₂ and m₃."""
        first, second, third = ([self.data.number(c) for c in row] for row in self.chart.axes)
        return first, second, cross(first, second), third

    @cached_property
    def _lag(self) -> Any:
        """λ, the angle from m₁ to m₃ at q = 0, in the plane perpendicular to m₂."""
        first, _, beside, third = self._directions
        return self.data.context.atan2(scalar(third, beside), scalar(third, first))

    @cached_property
    def _side(self) -> int:
        """Sign of sin(λ - q₂), constant on motions that avoid the singular position.

        (q₁, q₂) and (q₁ + π, 2λ - q₂) place m₃ alike: the start decides which is meant.
        """
        return 1 if self.data.context.sin(self._lag - self.initial_angles[1]) > 0 else -1

    def angles(self, reals: Reals, attitude: Sequence[Vec], axis: Vec) -> list[Array]:
        """The angles, up to whole turns, for an attitude and direction of the body's axis."""
        if len(self.chart.angles) == 2:
            return self._two(reals, axis)
        m1, m2, _, m3 = (list(map(reals.number, v)) for v in self._directions)
        constant = [
            [reals.number(self.data.number(e)) for e in r] for r in self.chart.constant.rows
        ]
        turned = [[scalar(row, line) for line in constant] for row in attitude]  # R Kᵀ
        first, second = self._two(reals, [scalar(row, m3) for row in turned])
        across = [scalar(row, m2) for row in turned]
        back = _rotated(reals, m2, -second, _rotated(reals, m1, -first, across))
        third = reals.atan2(scalar(back, cross(m3, m2)), scalar(back, m2))
        return [first, second, third]

    def _two(self, reals: Reals, image: Vec) -> list[Array]:
        """The first two angles, which place the image of m₃."""
        m1, m2, beside, _ = (list(map(reals.number, v)) for v in self._directions)
        along, sideways, ahead = (scalar(image, v) for v in (m1, m2, beside))
        lean = self._side * reals.atan2(reals.sqrt(sideways**2 + ahead**2), along)
        first = reals.atan2(-self._side * sideways, self._side * ahead)
        return [first, reals.number(self._lag) - lean]

    def speeds(self, reals: Reals, angles: Sequence[Array], turning: Vec) -> dict[str, Array]:
        """Speeds at these angles and this angular velocity along the root's axes."""
        import numpy as np

        known = (*self.chart.angles, *_W)
        constants = sorted(variables(self.chart.solved) - set(known), key=lambda s: s.published)
        program = compile_program(self.chart.solved, (*known, *constants))
        numbers = [self.data.number(Expr.generator(s)) for s in constants]
        values: Iterable[Array]
        lanes = np.broadcast_arrays(*angles, *turning)
        if isinstance(reals, DoubleReals):
            found = program.function(arrays())(*lanes, *map(float, numbers))
            values = (np.asarray(v, dtype=float) for v in found)
        else:
            context = self.data.context
            exact = Arithmetic.of(context, lambda q: context.mpf(q.numerator) / q.denominator)
            function = program.function(exact)
            places = zip(*(v.ravel() for v in lanes), strict=True)
            rows = [function(*place, *numbers) for place in places]
            columns = (np.array(c, dtype=object) for c in zip(*rows, strict=True))
            values = (c.reshape(lanes[0].shape) for c in columns)
        return {s.published: v for s, v in zip(self.chart.speeds, values, strict=True)}

    @property
    def initial_angles(self) -> list[Any]:
        """The angles at t = 0."""
        return [self.data.number(Expr.generator(q)) for q in self.chart.angles]


def scalar(a: Vec, b: Vec) -> Any:
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def product(a: Sequence[Vec], b: Sequence[Vec]) -> list[list[Any]]:
    """Product of two 3 × 3 matrices."""
    size = range(3)
    return [[sum(a[i][k] * b[k][j] for k in size) for j in size] for i in size]


def cross(a: Vec, b: Vec) -> list[Any]:
    """Vector product."""
    return [a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)]


def _rotated(reals: Reals, axis: Vec, angle: Array, vector: Vec) -> list[Array]:
    """A vector rotated about a unit axis."""
    c, s = reals.cos(angle), reals.sin(angle)
    along, beside = scalar(axis, vector), cross(axis, vector)
    return [
        c * v + s * b + (1 - c) * along * a for v, b, a in zip(vector, beside, axis, strict=True)
    ]


_REFINEMENTS = 6  # how often steps are halved where an angle changes too far in one
_MOST = 400_000  # steps
_FAR = 1.5  # rad in a step, with a margin: np.unwrap misses a turn beyond π


class Attitude(NamedTuple):
    """Attitude and angular velocity of a body, along the root's axes.

    Attributes:
        rows: matrix from components along axes fixed in the body.
        axis: of symmetry, or any axis of the body.
        turning: angular velocity, 1/s.
    """

    rows: Sequence[Vec]
    axis: Vec
    turning: Vec


@dataclass(frozen=True)
class AttitudeFamily(Solvable):
    """A family whose motion is the attitude of a body, in any angles.

    Attributes:
        chart: the angles.
    """

    chart: Chart

    @property
    def state(self) -> tuple[Symbol, ...]:
        return (*self.chart.angles, *self.chart.speeds)


@dataclass(frozen=True)
class AttitudeSolution(ExactSolution):
    """The attitude of a body at all times, in the coordinates and speeds of its chart.

    Attributes:
        placed: the chart, with numbers.
        solution: the motion in other variables, such as Euler's angles from the vertical.
    """

    placed: NumericChart
    solution: ExactSolution

    @abstractmethod
    def attitude(self, reals: Reals, times: Array) -> Attitude:
        """The attitude at times, s."""

    @property
    @abstractmethod
    def step(self) -> float:
        """A time in which all angles change little, s."""

    @property
    def kind(self) -> str:
        return self.solution.kind

    @property
    def period(self) -> Any:
        return self.solution.period

    @property
    def figures(self) -> dict[str, Any]:
        return self.solution.figures

    def besides(self, reals: Reals, times: Array) -> dict[str, Array]:
        return self.solution.besides(reals, times)

    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        found = self.attitude(reals, times)
        angles = self.placed.angles(reals, found.rows, found.axis)
        circle = reals.number(2 * self.placed.data.context.pi)
        turns = self._whole_turns(times, angles)
        whole = [a + circle * n for a, n in zip(angles, turns, strict=True)]
        names = (q.published for q in self.placed.chart.angles)
        speeds = self.placed.speeds(reals, angles, found.turning)
        return {**dict(zip(names, whole, strict=True)), **speeds}

    def _whole_turns(self, times: Array, angles: Sequence[Array]) -> list[Array]:
        """Whole turns to be added to angles at times, counted from the start on.

        The attitude does not contain them: the angles are followed in doubles along a grid, which
        is refined until none of them changes by more than about half of π in one step.
        """
        import numpy as np

        moments = np.asarray(times, dtype=float)
        first, last = min(0.0, float(np.min(moments))), max(0.0, float(np.max(moments)))
        step = self.step
        for _ in range(_REFINEMENTS):
            count = int((last - first) / step) + 2
            if count > _MOST:
                raise NumericError(
                    f"angles whose turns are counted over {count} steps",
                    expected=f"at most {_MOST}",
                    advice="choose times closer to the start, or use Euler's angles from the "
                    "vertical",
                )
            even = np.linspace(first, last, count)
            grid = np.unique(np.concatenate([even, moments.ravel(), [0.0]]))
            paths = self._paths(grid)
            if max(float(np.max(np.abs(np.diff(p)), initial=0.0)) for p in paths) < _FAR:
                break
            step = step / 2
        else:
            raise NumericError(
                "a motion that comes close to a position where its angles are singular",
                expected="angles that change steadily, so that their turns can be counted",
                advice="describe the attitude by other angles",
            )
        places = np.searchsorted(grid, moments)
        return [
            np.rint((p[places] - np.asarray(a, dtype=float)) / (2 * np.pi)).astype(int)
            for p, a in zip(paths, angles, strict=True)
        ]

    def _paths(self, grid: Array) -> list[Array]:
        """The angles along a grid, without jumps, and with their given values at the start."""
        import numpy as np

        doubles = DoubleReals()
        found = self.attitude(doubles, grid)
        angles = self.placed.angles(doubles, found.rows, found.axis)
        start, paths = int(np.searchsorted(grid, 0.0)), []
        for angle, initial in zip(angles, self.placed.initial_angles, strict=True):
            path = np.unwrap(np.broadcast_to(angle, grid.shape))
            turns = np.rint((float(initial) - path[start]) / (2 * np.pi))
            paths.append(path + 2 * np.pi * turns)
        return paths
