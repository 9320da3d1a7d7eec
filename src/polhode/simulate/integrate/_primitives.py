"""What of a coordinate or a speed is a function of time alone, and need not be integrated.

A body that keeps to a shaken support goes where the support goes: summed up over many periods, its
velocity would carry it away by rounding.
"""

from __future__ import annotations

from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind
from polhode.simulate._dynamics import Dynamics


@dataclass(frozen=True)
class Primitive:
    """A rate, taken apart.

    Attributes:
        known: an expression of prescribed functions of time, whose derivative is part of the rate.
        rest: of the rate.
    """

    known: Expr
    rest: Expr


def primitive(dynamics: Dynamics, state: Symbol, rate: Expr) -> Primitive:
    """The part of a state's rate that is a constant times the rates of prescribed functions."""
    full = _written_out(dynamics, state)
    if full is None:
        return Primitive(ZERO, rate)
    driving = [s for s in full.generators if isinstance(s, Symbol) and _is_rate(s)]
    known = ZERO
    for symbol in driving:
        coefficient = full.diff(symbol)
        if _is_constant(coefficient):
            known = known + coefficient * Expr.generator(_integrated(symbol))
            full = full - coefficient * Expr.generator(symbol)
    return Primitive(known, full) if known else Primitive(ZERO, rate)


def _written_out(dynamics: Dynamics, state: Symbol) -> Expr | None:
    """The rate of a coordinate, or of a speed that has a row of the equations to itself."""
    equations, own = dynamics.equations, state.derivative()
    if own in equations.kinematics:
        return dynamics.on_side(equations.kinematics[own].subs(equations.dependent))
    if own not in dynamics.accelerations.unknowns:
        return None
    row = dynamics.accelerations.unknowns.index(own)
    masses = dynamics.accelerations.matrix.rows[row]
    alone = not any(mass for k, mass in enumerate(masses) if k != row)
    return dynamics.accelerations.right[row] / masses[row] if alone else None


def _is_rate(symbol: Symbol) -> bool:
    return symbol.kind is SymbolKind.FUNCTION and symbol.order > 0


def _integrated(symbol: Symbol) -> Symbol:
    return Symbol(symbol.name, symbol.kind, symbol.order - 1)


def _is_constant(coefficient: Expr) -> bool:
    return all(s.kind is SymbolKind.PARAMETER for s in coefficient.symbols())
