"""The number π and the cosines of its simple fractions."""

from __future__ import annotations

from fractions import Fraction

from polhode.algebra._expression import ONE, ZERO, Expr
from polhode.algebra._generators import Symbol, SymbolKind
from polhode.algebra._roots import sqrt
from polhode.base import NumericError

#: The ratio of a circle's circumference to its diameter.
PI = Expr.generator(Symbol("pi", SymbolKind.PARAMETER, 0, positive=True))


def cosine_of_turn(multiple: Fraction) -> Expr:
    """cos(multiple · π), exact for multiples of π/12."""
    multiple = abs(multiple) % 2
    if multiple > 1:
        multiple = 2 - multiple
    if multiple > Fraction(1, 2):
        return -cosine_of_turn(1 - multiple)
    twelfths = multiple * 12
    if twelfths.denominator > 1:
        raise NumericError(
            f"the angle {multiple}*pi inside a sine or cosine",
            expected="a multiple of pi/12 (15 degrees), whose sine is a square root",
            advice="use a symbol for the angle and give it its value as a number",
        )
    return _twelfth(int(twelfths))


def _twelfth(number: int) -> Expr:
    root2, root3 = sqrt(2), sqrt(3)
    table = (
        ONE,
        root2 * (root3 + 1) / 4,
        root3 / 2,
        root2 / 2,
        ONE / 2,
        root2 * (root3 - 1) / 4,
        ZERO,
    )
    return table[number]
