"""Integrals that are not elementary functions: speeds that obey a linear equation in an angle.

For a disk or any solid of revolution that rolls on a plane, the rates of steering and spinning
change only as the tilt does: du/dt = (dθ/dt) A(θ) u, so that u as a function of θ alone solves
du/dθ = A(θ) u (Chaplygin 1897; Legendre or hypergeometric functions). Its constants of
integration are first integrals.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from polhode.algebra import (
    ZERO,
    Compiled,
    Expr,
    Matrix,
    Row,
    Symbol,
    compile_program,
    linear_parts,
    variables,
)
from polhode.analyse._reduced import reduced
from polhode.base import NumericError, Shown, integrated
from polhode.derive import Equations, equations_only

_TOLERANCE = 1e-13  # of the integration by the angle, relative


@dataclass(frozen=True)
class LinearIntegrals(Shown):
    """Speeds u with du/dθ = A(θ) u along every motion.

    Attributes:
        angle: θ.
        speeds: u, as many as there are integrals.
        matrix: A, in terms of θ and parameters.
    """

    angle: Symbol
    speeds: tuple[Symbol, ...]
    matrix: Matrix

    def __str__(self) -> str:
        angle = Expr.generator(self.angle).pretty()
        speeds = (Expr.generator(u).pretty() for u in self.speeds)
        slopes = (slope.pretty() for slope in self.slopes)
        return "\n".join(f"d{u}/d{angle} = {s}" for u, s in zip(speeds, slopes, strict=True))

    @cached_property
    def slopes(self) -> tuple[Expr, ...]:
        """A u: the rate of change of each speed with the angle."""
        speeds = [Expr.generator(s) for s in self.speeds]
        return tuple(
            sum((entry * u for entry, u in zip(row, speeds, strict=True)), ZERO)
            for row in self.matrix.rows
        )

    def known(self, integrals: Iterable[Expr]) -> int:
        """How many of these integrals depend on u and θ alone."""
        own = {self.angle, *self.speeds}
        varying = ({s for s in i.symbols() if s.kind.varies} for i in integrals)
        return sum(bool(symbols) and symbols <= own for symbols in varying)

    @cached_property
    def _parameters(self) -> tuple[Symbol, ...]:
        used = variables(e for row in self.matrix.rows for e in row) - {self.angle}
        return tuple(sorted(used, key=lambda s: s.published))

    @cached_property
    def _entries(self) -> Compiled:
        entries = [entry for row in self.matrix.rows for entry in row]
        return compile_program(entries, (self.angle, *self._parameters)).function()

    def values(self, parameters: Mapping[str, float], state: Mapping[str, Any], at: float) -> Any:
        """The integrals: the speeds at the moment when the angle is `at`, rad/s.

        Args:
            parameters: by published name, SI.
            state: the angle and the speeds by published name, one value each.
            at: the angle to refer them to, rad, with no singular angle in between.
        """
        import numpy as np

        constants = [parameters[s.published] for s in self._parameters]
        size = len(self.speeds)

        def slope(angle: float, speeds: Any) -> Any:
            entries = np.reshape(self._entries(np.float64(angle), *constants), (size, size))
            return entries @ speeds

        start = np.array([state[s.published] for s in self.speeds], dtype=float)
        here = float(state[self.angle.published])
        if here == at:
            return start
        try:
            # close to the rounding of doubles: runs are held to the value as to a constant
            return integrated(slope, here, at, start, _TOLERANCE)
        except NumericError as error:
            raise NumericError(
                f"the integrals between {self.angle.published} = {here} and {at}",
                expected="no singular angle between the two",
                advice="refer them to an angle that the motion passes through",
            ) from error

    def latex(self) -> str:
        """The differential equation."""
        angle = Expr.generator(self.angle).latex()
        column = r" \\ ".join(Expr.generator(s).latex() for s in self.speeds)
        vector = rf"\begin{{bmatrix}} {column} \end{{bmatrix}}"
        return rf"\frac{{d}}{{d {angle}}} {vector} = {self.matrix.latex()} {vector}"


def linear_integrals(equations: Equations) -> LinearIntegrals | None:
    """Speeds that obey a linear equation in an essential angle; None where there are none."""
    equations_only(equations, "linear integrals")
    system = reduced(equations)
    for angle in system.essential:
        rate = angle.derivative()
        if rate in system.speeds:
            found = _closed_set(equations, angle, rate)
            if found is not None:
                return found
    return None


def _closed_set(equations: Equations, angle: Symbol, rate: Symbol) -> LinearIntegrals | None:
    """The largest set of speeds whose slopes are linear in the set itself.

    Speeds whose slope fails are dropped until the rest is closed.
    """
    slopes = {
        speed: equations.accelerations[speed.derivative()] / Expr.generator(rate)
        for speed in equations.speeds
        if speed != rate
    }
    kept = tuple(slopes)
    while True:
        rows: dict[Symbol, Row] = {}
        for speed in kept:
            try:
                row, rest = linear_parts(slopes[speed], kept)
            except NumericError:  # not a polynomial in these speeds
                continue
            varying = {s for entry in row for s in entry.symbols() if s.kind.varies}
            if not rest and varying <= {angle}:
                rows[speed] = row
        if len(rows) == len(kept):
            break
        kept = tuple(rows)
    if not any(slopes[speed] for speed in kept):
        return None
    return LinearIntegrals(angle, kept, Matrix(tuple(rows.values())))
