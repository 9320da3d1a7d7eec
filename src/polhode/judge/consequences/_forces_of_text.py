"""Equations of motion in which a force or a torque of a text stands: I d²θ/dt² = τ."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import islice, product

from polhode.algebra import Expr, Symbol
from polhode.derive import Equations
from polhode.judge.consequences._equations_of_text import Equation
from polhode.judge.consequences._open_letters import OpenLetters

_LETTERS = 12  # of a text that are sought
_TERMS = 3  # of a force or torque


def equations_of_motion_with(
    values: Mapping[Symbol, Expr], letters: OpenLetters, equations: Equations
) -> Iterator[Equation]:
    """Equations of motion with a letter in place of the terms that are what it stands for.

    They are true whatever the letter is, so that no more than these terms has to be recognised.

    Args:
        values: of the letters, in truth.
        letters: of the text.
        equations: of the system.
    """
    rates = frozenset(equations.acceleration_symbols)
    for (symbol, value), row in product(islice(values.items(), _LETTERS), equations.motion):
        terms, whole = list(value.summands()), list(row.summands())
        if not 0 < len(terms) <= _TERMS or value.symbols() & rates:
            continue
        for factor in (term / terms[0] for term in whole):
            rest = row.numerator - factor * value
            if len(list(rest.summands())) == len(whole) - len(terms):
                relation = rest + factor * Expr.generator(symbol)
                yield Equation(relation.numerator, letters.values)
