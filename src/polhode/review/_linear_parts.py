"""Which wrong equation a line about small motions is the linear part of."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import islice, product

from polhode.algebra import ZERO, Expr, Symbol
from polhode.claims.building_blocks import Mechanics
from polhode.derive import Equations
from polhode.review._equations_of_text import Equation
from polhode.review._open_letters import OpenLetters

_MOST = 400  # pairs of a wrong equation and a true one


@dataclass(frozen=True)
class LinearParts:
    """Linear parts of equations of a text.

    Attributes:
        equations: of the system.
        letters: of the text, which are as they are in truth.
        small: the coordinates that are small, with their rates.
    """

    equations: Equations
    letters: OpenLetters
    small: Sequence[Symbol]

    def source(
        self, stated: Iterable[Expr], wrong: Iterable[Equation], true: Iterable[Equation]
    ) -> Equation | None:
        """The wrong equation from whose linear part a line follows, by itself or with a true one.

        Args:
            stated: the differences of both sides of the line.
            wrong: the wrong equations before it.
            true: those of which one may be used too.
        """
        linear = [part for each in stated if (part := self._linear(each))]
        parts = ((equation, self._linear(equation.relation)) for equation in wrong)
        hypotheses = [(equation, part) for equation, part in parts if part.varies]
        if not linear:
            return None
        for equation, part in hypotheses:
            if _are_multiples(linear, part):
                return equation
        facts = [part for each in true if (part := self._linear(each.relation))]
        for (equation, part), fact in islice(product(hypotheses, facts), _MOST):
            for symbol in (s for s in part.symbols() & fact.symbols() if s.kind.varies):
                slope = part.diff(symbol)
                if slope and not slope.varies:
                    put_in = fact - fact.diff(symbol) / slope * part
                    if put_in.varies and _are_multiples(linear, put_in):
                        return equation
        return None

    def _linear(self, relation: Expr) -> Expr:
        mechanics = Mechanics(self.equations)
        rates = [(s, s.derivative(), s.derivative().derivative()) for s in self.small]
        symbols = [symbol for each in rates for symbol in each]
        rest = dict.fromkeys(symbols, ZERO)
        known = mechanics.in_rates(self.letters.in_truth(relation))
        terms = (Expr.generator(s) * known.diff(s).subs(rest) for s in symbols)
        return known.subs(rest) + sum(terms, ZERO)


def _are_multiples(relations: Iterable[Expr], relation: Expr) -> bool:
    return all(not (each / relation).varies for each in relations)
