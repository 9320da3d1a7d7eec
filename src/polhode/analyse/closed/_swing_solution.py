"""A motion in which one angle swings and all else follows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from polhode.algebra import Symbol
from polhode.analyse.closed._reals import Array, Reals
from polhode.analyse.closed._solution import ExactSolution
from polhode.analyse.closed._swing_start import Swinging


@dataclass(frozen=True)
class SwingSolution(ExactSolution):
    """An angle that swings or turns over.

    Attributes:
        angle: θ.
        rate: θ̇.
        motion: of it.
    """

    angle: Symbol
    rate: Symbol
    motion: Swinging

    @property
    def kind(self) -> str:
        return self.motion.swing.kind

    @property
    def period(self) -> Any:
        return self.motion.swing.period

    @property
    def figures(self) -> dict[str, Any]:
        return self.motion.figures

    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        angle, rate = self.motion.at(reals, times)
        return {self.angle.published: angle, self.rate.published: rate}
