"""The reduced system: the equations without their ignorable coordinates."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from polhode.algebra import Expr, Row, Symbol, SymbolKind, variables
from polhode.base import NumericError
from polhode.derive import Equations


@dataclass(frozen=True)
class Reduced:
    """Essential coordinates and speeds, closed under the equations of motion.

    Attributes:
        equations: of the whole system.
        essential: coordinates that the accelerations depend on, directly or through one another.
        speeds: all independent speeds.
        rates: of the essential coordinates.
    """

    equations: Equations
    essential: tuple[Symbol, ...]
    speeds: tuple[Symbol, ...]
    rates: Row

    @property
    def state(self) -> tuple[Symbol, ...]:
        """Essential coordinates, then speeds."""
        return self.essential + self.speeds


def reduced(equations: Equations) -> Reduced:
    """Drop the coordinates that nothing depends on.

    Raises `NumericError` for equations that depend on time explicitly, or are in named parts.
    """
    refuse_parts(equations)
    return reduced_in_parts(equations)


def reduced_in_parts(equations: Equations) -> Reduced:
    """The same, also of equations in named parts.

    Raises `NumericError` for equations that depend on time explicitly.
    """
    entries = (*equations.mass.entries, *equations.forcing)
    driven = [s for s in variables(entries) if s.kind in (SymbolKind.FUNCTION, SymbolKind.TIME)]
    if driven:
        names = ", ".join(sorted(s.published for s in driven))
        raise NumericError(
            f"equations that depend on time through {names}",
            expected="autonomous equations: steady motions and integrals need them",
            advice="let the supports rest or move steadily",
        )
    found, pending = set[Symbol](), list[Expr](entries)
    while pending:
        used = variables(pending)
        new = [
            q
            for q in equations.coordinates
            if q in used and q not in found and _depends(equations, pending, q)
        ]
        found.update(new)
        # coordinates on which the rates of essential ones depend are essential too
        pending = [equations.kinematics[q.derivative()] for q in new]
    essential = tuple(q for q in equations.coordinates if q in found)
    return Reduced(
        equations,
        essential,
        equations.speeds,
        tuple(equations.kinematics[q.derivative()] for q in essential),
    )


def _depends(equations: Equations, expressions: Iterable[Expr], q: Symbol) -> bool:
    """Whether expressions in which a coordinate occurs depend on it; in parts it may cancel."""
    return not equations.motion_in_parts or any(e.diff(q) for e in expressions)


def refuse_parts(equations: Equations) -> None:
    """Refuse equations that are too long to be written out, with `NumericError`."""
    if equations.motion_in_parts:
        raise NumericError(
            f"equations of {equations.system.name!r} in named parts",
            expected="equations in closed form, short enough to be written out",
            advice="give numbers: linearise finds the eigenvalues about a motion, modes follows "
            "them along a parameter; or simulate",
        )
