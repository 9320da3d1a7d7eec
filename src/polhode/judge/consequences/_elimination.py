"""Equations of motion that follow once the vectors in a law are put in: dL/dt = r × F.

The author has L and F by their components, one of them wrong, and a law between them. What the law
then says of the accelerations, or in steady motion of a speed, is what the next line prints.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from itertools import combinations, islice

from polhode.algebra import Expr, Symbol
from polhode.judge.consequences._blocks import EquationBlock, Group, blocks
from polhode.judge.consequences._equations_of_text import Equation, Solving, Unknown
from polhode.judge.consequences._open_letters import OpenLetters

_CHOICES = 4  # of the accelerations for which a law is solved


@dataclass(frozen=True)
class Eliminating:
    """Puts what lines say of letters into laws between them.

    Attributes:
        letters: of the text.
        lines: that are true, the latest first.
    """

    letters: OpenLetters
    lines: Sequence[Sequence[Equation]]

    def ways(
        self, block: EquationBlock, unknown: Sequence[Symbol], together: bool
    ) -> Iterator[Solving]:
        """Equations to be solved together, given a wrong line.

        Args:
            block: what the wrong line gives.
            unknown: accelerations or speeds, of which a law determines some.
            together: whether all components of a law are taken at once; otherwise one by one.
        """
        for law in self.lines:
            if all(e.symbols.isdisjoint(block.unknowns) for e in law):
                continue
            for rows in [tuple(law)] if together else [(e,) for e in law]:
                yield from self._solving(block, rows, unknown)

    def _solving(
        self, block: EquationBlock, law: Sequence[Equation], unknown: Sequence[Symbol]
    ) -> Iterator[Solving]:
        needed = {s for e in law for s in e.symbols if s.base() in self.letters.values}
        pairs = [pair for stage in block.stages if _gives(stage, needed) for pair in stage]
        for symbol in sorted(needed - block.unknowns, key=lambda s: s.key):
            if all(symbol != known.symbol for _, known in pairs):
                pairs += self._definition(symbol, law)
        present = frozenset().union(*(e.symbols for e, _ in pairs))
        in_law = frozenset().union(*(e.symbols for e in law))
        found = [s for s in unknown if s in present and s not in in_law]
        if len(found) < len(law):
            return
        for chosen in islice(combinations(found, len(law)), _CHOICES):
            solved = [
                (e, Unknown(s, 1, Expr.generator(s))) for e, s in zip(law, chosen, strict=True)
            ]
            yield (*pairs, *solved)

    def _definition(
        self, symbol: Symbol, law: Sequence[Equation]
    ) -> list[tuple[Equation, Unknown]]:
        """What a line of the text gives a letter, or else what it is in truth."""
        group: Group = next(g for g in self.letters.groups if symbol.base() in g)
        for line in self.lines:
            if line is law or any(e in law for e in line):
                continue
            for found in blocks(line, [group]):
                if symbol in found.unknowns:
                    return [
                        pair for stage in found.stages if _gives(stage, {symbol}) for pair in stage
                    ]
        value = self.letters.value(symbol)
        if value is None:
            return []
        equation = Equation((Expr.generator(symbol) - value).numerator, self.letters.values)
        known = equation.unknowns.get(symbol)
        return [] if known is None else [(equation, known)]


def _gives(stage: Solving, needed: AbstractSet[Symbol]) -> bool:
    return any(unknown.symbol in needed for _, unknown in stage)
