"""Rates of coordinates and speeds of any order, in terms of the independent ones."""

from __future__ import annotations

from polhode.algebra import Expr, Symbol
from polhode.derive import Equations


def on_constraints(expression: Expr, equations: Equations) -> Expr:
    """With every rate that the constraints give put in terms of independent speeds and their rates.

    Accelerations of the independent speeds stay as they are: they are not asked of the dynamics.
    """
    given = {s: e for s in expression.symbols() if (e := _given(s, equations)) is not None}
    return expression.subs(given) if given else expression


def on_motion(expression: Expr, equations: Equations) -> Expr:
    """With the accelerations besides replaced by those of the true motion, whatever the order."""
    settled = on_constraints(expression, equations)
    accelerations = {
        s: _true_rate(s, equations) for s in settled.symbols() if _is_acceleration(s, equations)
    }
    return settled.subs(accelerations) if accelerations else settled


def _given(symbol: Symbol, equations: Equations) -> Expr | None:
    base, motion = symbol.base(), equations.kinetics
    rate = base.derivative()
    if base in equations.dependent:
        first, times = equations.dependent[base], symbol.order
    elif symbol.order and rate in motion.kinematics and rate not in equations.speeds:
        first, times = motion.kinematics[rate], symbol.order - 1
    else:
        return None
    for _ in range(times):
        first = on_constraints(first.chain(motion.rate), equations)
    return first


def _is_acceleration(symbol: Symbol, equations: Equations) -> bool:
    return any(s.base() == symbol.base() and s.order < symbol.order for s in equations.speeds)


def _true_rate(symbol: Symbol, equations: Equations) -> Expr:
    speed = next(s for s in equations.speeds if s.base() == symbol.base())
    value = equations.accelerations[speed.derivative()]
    for _ in range(symbol.order - speed.order - 1):
        value = equations.rate(value)
    return value
