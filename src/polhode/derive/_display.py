"""Equations as a text prints them, for terminals and notebooks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING

from polhode.algebra import Expr, Symbol, dot, under_letters

if TYPE_CHECKING:
    from polhode.derive._equations import Equations


def equations_text(equations: Equations) -> str:
    """Kinematics, equations of motion and reactions, one to a line."""
    lines = [f"Equations of motion of {equations.system.name}"]
    lines += _in_parts(equations) if equations.motion_in_parts else _closed(equations)
    if equations.undetermined:
        lines.append(f"Not determined: {', '.join(equations.undetermined)}")
    return "\n".join(lines)


def _closed(equations: Equations) -> Iterator[str]:
    yield from (f"  {row.pretty()} = 0" for row in equations.motion)
    if rates := _told_rates(equations):
        yield "with"
        yield from (f"  {line}" for line in _assignments(rates))
    if equations.components:
        yield "Reactions"
        values, legend = lettered(equations, equations.components.values())
        named = zip(equations.components, values, strict=True)
        yield from (f"  {name} = {value.pretty()}" for name, value in named)
        yield from legend


def _in_parts(equations: Equations) -> Iterator[str]:
    rows, legend = lettered(equations, _rows(equations))
    yield from (f"  {row.pretty()} = 0" for row in rows)
    yield from legend
    yield f"Reactions: {', '.join(line.name for line in equations.lines)}"


def lettered(
    equations: Equations, expressions: Iterable[Expr]
) -> tuple[tuple[Expr, ...], tuple[str, ...]]:
    """Expressions with a letter for everything that stands under a name, and what these are.

    No symbol of the equations has such a letter. The second is a line, or none without letters.
    """
    written, parts = under_letters(tuple(expressions), _known(equations))
    names = [Expr.generator(symbol).pretty() for symbol in parts]
    if not names:
        return written, ()
    one = f"{names[0]} is a long expression"
    several = f"{names[0]}, ..., {names[-1]} are long expressions"
    told = one if len(names) == 1 else several
    return written, (f"where {told} of coordinates and speeds, kept under names",)


def _known(equations: Equations) -> tuple[Symbol, ...]:
    return (*equations.coordinates, *equations.kinetics.dependent, *equations.parameters)


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
    if equations.motion_in_parts:
        written, _ = lettered(equations, _rows(equations))
    rows = r" \\ ".join(f"{row.latex()} &= 0" for row in written)
    return rf"\begin{{aligned}} {rows} \end{{aligned}}"
