"""Equations as a text prints them, for terminals and notebooks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from polhode.algebra import Expr, Symbol

if TYPE_CHECKING:
    from polhode.derive._equations import Equations


def equations_text(equations: Equations) -> str:
    """Kinematics, equations of motion and reactions, one to a line."""
    blocks = {
        f"Equations of motion of {equations.system.name}": [
            f"{row.pretty()} = 0" for row in equations.motion
        ],
        "with": _assignments(_told_rates(equations)),
        "Reactions": [f"{name} = {value.pretty()}" for name, value in equations.components.items()],
    }
    lines = []
    for title, block in blocks.items():
        if block:
            lines += [title, *(f"  {line}" for line in block)]
    if equations.undetermined:
        lines.append(f"Not determined: {', '.join(equations.undetermined)}")
    return "\n".join(lines)


def _told_rates(equations: Equations) -> dict[Symbol, Expr]:
    """Rates of coordinates that are not themselves speeds."""
    return {s: e for s, e in equations.kinematics.items() if s not in equations.speeds}


def _assignments(values: Mapping[Symbol, Expr]) -> list[str]:
    return [f"{Expr.generator(s).pretty()} = {value.pretty()}" for s, value in values.items()]


def equations_latex(equations: Equations) -> str:
    """The equations of motion, aligned."""
    rows = r" \\ ".join(f"{row.latex()} &= 0" for row in equations.motion)
    return rf"\begin{{aligned}} {rows} \end{{aligned}}"
