"""Slips from the instant at which they begin, as power series of the time since then.

With the slip velocity s = ρ (cos ψ, sin ψ) the equations ρ' = ṡ·ŝ and ρ ψ' = ṡ·ŝ' are singular at
ρ = 0. With ρ = ρ₁ τ + ρ₂ τ² + … and G = ṡ·ŝ', which vanishes at first, the coefficients of ψ
follow one after the other from (n ρ₁ − ∂G/∂ψ) ψₙ = Gₙ − Σ ρₖ (n + 1 − k) ψₙ₊₁₋ₖ (k ≥ 2, Gₙ
without ψₙ). Where slip begins gently, ρ₁ = 0, the point is irregular and the series asymptotic: it
is used only as far as its terms fall to the rounding of the numbers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import flint
import numpy as np

from polhode.algebra import Program, Symbol
from polhode.simulate.integrate._balls import (
    arithmetic,
    ball,
    by_step,
    cap,
    clocked,
    limbs_in,
    order_of,
    series_of,
    step_of,
    term,
    working,
)
from polhode.simulate.integrate._number_types import NumberType
from polhode.simulate.integrate._series import TaylorSolution

_GROWING = 64  # places within a step at which the slips are looked at
_HALVES = 200
_BARELY = 500  # bits


@dataclass(frozen=True)
class SlipSeries:
    """Slips that begin.

    Attributes:
        program: rates of the other states and of the slip velocities, of the other states, of
            cosine, sine and size of every slip, of parameters and time.
        others: which parameters, and the time.
        numbers: what it is to be computed in.
        constants: of the parameters.
        start: of the other states.
        angles: of the slips to come.
        begin: s.
        end: s, at the latest.
    """

    program: Program
    others: Sequence[Symbol]
    numbers: NumberType
    constants: Sequence[Any]
    start: Sequence[Any]
    angles: Sequence[Any]
    begin: Any
    end: Any

    def series(self) -> TaylorSolution | None:
        """The other states and the slip velocities over one step; None where no slip grows."""
        order = order_of(self.numbers)
        with working(self.numbers, order):
            return _Lengthening(self, order).series()


class _Lengthening:
    """The coefficients of all states, which are found one after the other."""

    def __init__(self, beginning: SlipSeries, order: int) -> None:
        self._numbers = beginning.numbers
        self._order = order
        self._begin, self._end = ball(beginning.begin), ball(beginning.end)
        self._rates = beginning.program.function(arithmetic())
        constants = [ball(value) for value in beginning.constants]
        self._given = clocked(beginning.others, constants, self._begin)
        self._states = [[ball(value)] for value in beginning.start]
        self._angles = [[ball(value)] for value in beginning.angles]
        self._sizes = [[flint.arb(0)] for _ in beginning.angles]

    def series(self) -> TaylorSolution | None:
        felt = self._felt()
        for known in range(self._order):
            self._lengthen(known)
            self._turn(known + 1, felt)
        rows = [*self._states, *self._sizes, *self._angles]
        step = step_of(rows, self._order)
        step = None if step is None else self._growing(min(step, self._end - self._begin))
        if step is None:
            return None
        every = [*self._states, *self._slips()]
        steps = [[limbs_in(by_step(row, step), self._numbers) for row in every]]
        return series_of(self._numbers, [self._begin, (self._begin + step).mid()], steps)

    def _felt(self) -> list[Any]:
        """How the turning of each slip changes with its direction."""
        turned = [[*row, flint.arb(1)] for row in self._angles]
        with cap(2):
            (_, _, now), (_, _, then) = self._found(self._angles), self._found(turned)
            return [term(y, 1) - term(x, 1) for x, y in zip(now, then, strict=True)]

    def _turn(self, known: int, felt: Sequence[Any]) -> None:
        """The next coefficient of every direction."""
        with cap(known + 1):
            _, _, across = self._found(self._angles)
        for sizes, angles, turning, own in zip(
            self._sizes, self._angles, across, felt, strict=True
        ):
            behind = sum(
                (sizes[k] * ((known + 1 - k) * angles[known + 1 - k]) for k in range(2, known + 1)),
                flint.arb(0),
            )
            angles.append(((term(turning, known) - behind) / (known * sizes[1] - own)).mid())

    def _lengthen(self, known: int) -> None:
        """The next coefficient of everything else."""
        with cap(known + 1):
            rates, along, _ = self._found(self._angles)
        for row, rate in zip([*self._states, *self._sizes], [*rates, *along], strict=True):
            row.append((term(rate, known) / (known + 1)).mid())

    def _found(self, angles: Sequence[list[Any]]) -> tuple[list[Any], list[Any], list[Any]]:
        """Rates of the other states, and of every slip along and across itself."""
        units = [_unit(row) for row in angles]
        sizes = [flint.arb_series(row) for row in self._sizes]
        directions = [x for unit, size in zip(units, sizes, strict=True) for x in (*unit, size)]
        states = [flint.arb_series(row) for row in self._states]
        found = self._rates(*states, *directions, *self._given)
        slips = found[len(states) :]
        pairs = list(zip(slips[::2], slips[1::2], units, strict=True))
        along = [x * cos + y * sin for x, y, (cos, sin) in pairs]
        across = [y * cos - x * sin for x, y, (cos, sin) in pairs]
        return list(found[: len(states)]), along, across

    def _growing(self, step: Any) -> Any:
        """A step within which every slip grows from nothing without vanishing again, if any."""
        shares = np.arange(1, _GROWING + 1) / _GROWING
        for _ in range(_HALVES):
            rows = [[float(value) for value in by_step(row, step)[1:]] for row in self._sizes]
            scale = [max(map(abs, row)) for row in rows]
            means = [np.polynomial.polynomial.polyval(shares, row) for row in rows]
            if all(np.min(mean) > 0 and s > 0 for mean, s in zip(means, scale, strict=True)):
                return step
            step = step / 2
        return None

    def _slips(self) -> list[list[Any]]:
        """Slip velocities along the two tangents of each support.

        They begin with a direction, and with less of a speed than their digits tell from none.
        """
        found, barely = [], flint.arb(2) ** -max(_BARELY, 2 * self._numbers.bits)
        for sizes, angles in zip(self._sizes, self._angles, strict=True):
            size = flint.arb_series([barely, *sizes[1:]])
            for part in _unit(angles):
                series = size * part
                found.append([term(series, k).mid() for k in range(self._order + 1)])
        return found


def _unit(angles: Sequence[Any]) -> tuple[Any, Any]:
    angle = flint.arb_series(list(angles))
    return angle.cos(), angle.sin()
