"""The interface of every closed form: a family of equations, and solutions from a start."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, ClassVar

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.analyse.closed._exact_data import Data
from polhode.analyse.closed._reals import Array, Reals
from polhode.derive import Equations


class ExactSolution(ABC):
    """One motion, with constants to spare digits."""

    @property
    @abstractmethod
    def kind(self) -> str:
        """The type of motion within the family."""

    @property
    @abstractmethod
    def period(self) -> Any:
        """Of the motion, s; None where it does not repeat."""

    @property
    @abstractmethod
    def figures(self) -> dict[str, Any]:
        """Characteristic numbers of the motion."""

    @abstractmethod
    def at(self, reals: Reals, times: Array) -> dict[str, Array]:
        """Coordinates and speeds by published name at times, s."""

    def besides(self, reals: Reals, times: Array) -> dict[str, Array]:
        """Further quantities of the motion at times, s."""
        return {}


class Solvable(ABC):
    """Equations recognised as those of a family that has a closed form.

    Attributes:
        name: of the family.
        formula: LaTeX of the closed form.
    """

    name: ClassVar[str]
    formula: ClassVar[str]

    @property
    @abstractmethod
    def parts(self) -> dict[str, Expr]:
        """Constants of the formula by their LaTeX, as read off the equations."""

    @property
    @abstractmethod
    def state(self) -> tuple[Symbol, ...]:
        """Variables that form a closed system; all other speeds must be constant."""

    def check(self, data: Data) -> None:
        """Raise `NumericError` for a start that has no closed form and is not steady either."""
        return None

    @abstractmethod
    def solve(self, data: Data) -> ExactSolution:
        """The motion from a start that is not steady."""


def is_constant(expression: Expr) -> bool:
    """Whether only parameters occur."""
    return all(symbol.kind is SymbolKind.PARAMETER for symbol in expression.symbols())


def rates(equations: Equations) -> dict[Symbol, Symbol]:
    """Every speed that is the rate of a coordinate, with that coordinate."""
    pairs = {q: equations.kinematics[q.derivative()].symbol for q in equations.coordinates}
    return {speed: q for q, speed in pairs.items() if speed in equations.speeds}
