"""Which quantities are angles, that people read in degrees."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import Expr, Symbol, dimension_of
from polhode.base import PURE
from polhode.derive._equations import Equations

_CIRCULAR = ("sin", "cos")


def is_angle(equations: Equations, symbol: Symbol) -> bool:
    """Whether a quantity is an angle: a coordinate that is a pure number, or a pure parameter of
    which, or of a sum with which, a sine or cosine is taken."""
    if dimension_of(Expr.generator(symbol), equations.dimensions) not in (PURE, None):
        return False
    if symbol in equations.coordinates:
        return True
    slopes = (argument.diff(symbol) for argument in _arguments(equations, symbol))
    return any(slope and not slope.symbols() for slope in slopes)


def _arguments(equations: Equations, symbol: Symbol) -> Iterator[Expr]:
    """What sines and cosines are taken of in the equations, where it depends on a symbol."""
    for row in (*equations.motion, equations.potential_energy):
        for generator in row.generators:
            if getattr(generator, "name", "") in _CIRCULAR and symbol in generator.symbols():
                yield from generator.arguments
