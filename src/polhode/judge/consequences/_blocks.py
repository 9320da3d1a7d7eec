"""Equations of one line that are solved together: for a vector, or for a letter, and for its rate.

A wrong line that gives a vector changes its three components at once, and the rates of them: what
an author works out from **L** is dL/dt as well. A true line between vectors carries that on.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from polhode.algebra import Symbol
from polhode.judge.consequences._equations_of_text import Equation, Solving

#: Components of a vector of the text, or one letter.
Group = tuple[Symbol, ...]


@dataclass(frozen=True, eq=False)
class EquationBlock:
    """Equations of one line with the components of a letter that they determine.

    Attributes:
        stages: equations to be solved together, one stage after the other.
    """

    stages: tuple[Solving, ...]

    @property
    def unknowns(self) -> frozenset[Symbol]:
        """What they determine."""
        return frozenset(unknown.symbol for stage in self.stages for _, unknown in stage)

    @property
    def symbols(self) -> frozenset[Symbol]:
        """All symbols in them."""
        return frozenset().union(*(e.symbols for stage in self.stages for e, _ in stage))


def blocks(equations: Sequence[Equation], groups: Sequence[Group]) -> Iterator[EquationBlock]:
    """The ways in which the equations of a line determine a letter, its rates first."""
    for group in groups:
        rates = tuple(symbol.derivative() for symbol in group)
        for wanted in (rates, group):
            found = _solving(equations, wanted)
            if found is not None:
                yield EquationBlock(found)


def _solving(equations: Sequence[Equation], wanted: Group) -> tuple[Solving, ...] | None:
    """The equations with the components that they determine, then their rates; None if unfit."""
    within = [e for e in equations if not e.symbols.isdisjoint(wanted)]
    unknowns = [symbol for symbol in wanted if any(symbol in e.symbols for e in within)]
    if not unknowns or len(within) != len(unknowns):
        return None
    if any(symbol.derivative() in equation.symbols for symbol in unknowns for equation in within):
        return None  # an equation for dL/dt, not for L
    pairs = _paired(within, unknowns)
    if pairs is None:
        return None
    rates = [equation.rate for equation, _ in pairs]
    of_rates = _paired(rates, [unknown.symbol.derivative() for _, unknown in pairs])
    return (pairs,) if of_rates is None else (pairs, of_rates)


def _paired(equations: Sequence[Equation], unknowns: Sequence[Symbol]) -> Solving | None:
    """Each equation with one of the symbols, if all are linear in all of them."""
    found = []
    for equation, symbol in zip(equations, unknowns, strict=True):
        unknown = next(
            (e.unknowns[symbol] for e in (equation, *equations) if symbol in e.unknowns), None
        )
        if unknown is None or unknown.power != 1:
            return None
        found.append((equation, unknown))
    return tuple(found)
