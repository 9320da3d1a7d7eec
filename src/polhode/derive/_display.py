"""Equations as a text prints them, for terminals and notebooks."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from polhode.algebra import Expr, Symbol, dot, under_letters

if TYPE_CHECKING:
    from polhode.derive._equations import Equations


def equations_text(equations: Equations) -> str:
    """Kinematics, equations of motion and reactions, one to a line."""
    title = f"Equations of motion of {equations.system.name}"
    if equations.in_parts:
        return "\n".join([title, *_in_parts(equations)])
    blocks = {
        title: [f"{row.pretty()} = 0" for row in equations.motion],
        "with": _assignments(_told_rates(equations)),
        "Reactions": [f"{name} = {value.pretty()}" for name, value in equations.components.items()],
    }
    lines = []
    for heading, block in blocks.items():
        if block:
            lines += [heading, *(f"  {line}" for line in block)]
    if equations.undetermined:
        lines.append(f"Not determined: {', '.join(equations.undetermined)}")
    return "\n".join(lines)


def _in_parts(equations: Equations) -> list[str]:
    rows, parts = under_letters(_rows(equations))
    names = [Expr.generator(symbol).pretty() for symbol in parts]
    return [
        *(f"  {row.pretty()} = 0" for row in rows),
        f"where {names[0]}, ..., {names[-1]} are long expressions of coordinates and speeds, kept"
        " under names",
        f"Reactions: {', '.join(line.name for line in equations.lines)}",
    ]


def _rows(equations: Equations) -> tuple[Expr, ...]:
    """Mass times accelerations less forcing."""
    accelerations = [Expr.generator(symbol) for symbol in equations.acceleration_symbols]
    pairs = zip(equations.mass.rows, equations.forcing, strict=True)
    return tuple(dot(row, accelerations) - force for row, force in pairs)


def _told_rates(equations: Equations) -> dict[Symbol, Expr]:
    """Rates of coordinates that are not themselves speeds."""
    return {s: e for s, e in equations.kinematics.items() if s not in equations.speeds}


def _assignments(values: Mapping[Symbol, Expr]) -> list[str]:
    return [f"{Expr.generator(s).pretty()} = {value.pretty()}" for s, value in values.items()]


def equations_latex(equations: Equations) -> str:
    """The equations of motion, aligned."""
    written = equations.motion
    if equations.in_parts:
        written, _ = under_letters(_rows(equations))
    rows = r" \\ ".join(f"{row.latex()} &= 0" for row in written)
    return rf"\begin{{aligned}} {rows} \end{{aligned}}"
