"""What Lagrange's method makes of an energy or a Lagrangian that a text states wrongly."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import Expr
from polhode.derive import Equations
from polhode.judge.consequences._equations_of_text import Equation
from polhode.judge.consequences._open_letters import OpenLetters
from polhode.judge.meaning._mechanics import Mechanics


def stated_lagrangians(
    equation: Equation, letters: OpenLetters, equations: Equations
) -> Iterator[Expr]:
    """The Lagrangian, in rates, that a wrong line states, or that has the energy in it."""
    mechanics = Mechanics(equations)
    for unknown in equation.unknowns.values():
        letter = letters.values.get(unknown.symbol)
        if letter is None or unknown.power > 1:
            continue
        stated = letters.solved(equation.relation, unknown.symbol, unknown.slope)
        if stated is None:
            continue
        if letter == mechanics.kinetic_energy():
            yield mechanics.in_rates(stated - mechanics.potential_energy())
        elif letter == mechanics.potential_energy():
            yield mechanics.in_rates(mechanics.kinetic_energy() - stated)
        elif letter == mechanics.lagrangian():
            yield mechanics.in_rates(stated)
        elif letter in (mechanics.rotational_energy(), mechanics.translational_energy()):
            yield mechanics.in_rates(mechanics.lagrangian() + stated - letter)


def equations_of_lagrangian(
    lagrangian: Expr, letters: OpenLetters, equations: Equations
) -> Iterator[Equation]:
    """Lagrange's equations, and momenta for which the text has letters."""
    mechanics = Mechanics(equations)
    values = letters.values
    in_rates = {symbol: mechanics.in_rates(value) for symbol, value in values.items()}
    for q in mechanics.declared.coordinates:
        momentum = lagrangian.diff(q.derivative())
        yield Equation((momentum.dt() - lagrangian.diff(q)).numerator, values)
        right = mechanics.in_rates(mechanics.conjugate(q.published))
        for symbol, value in in_rates.items():
            if value == right:
                yield Equation((Expr.generator(symbol) - momentum).numerator, values)
