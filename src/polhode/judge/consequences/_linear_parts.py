"""Which wrong equation a line about small motions is the linear part of."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import islice, product

from polhode.algebra import PI, ZERO, Expr, Symbol, is_positive
from polhode.derive import Equations
from polhode.judge.consequences._equations_of_text import Equation
from polhode.judge.consequences._open_letters import OpenLetters
from polhode.judge.meaning._mechanics import Mechanics

_MOST = 400  # pairs of a wrong equation and a true one


@dataclass(frozen=True)
class LinearParts:
    """Linear parts of equations of a text.

    Attributes:
        equations: of the system.
        letters: of the text, which are as they are in truth.
        small: the coordinates, or else the speeds, that stay close to a value, with this.
    """

    equations: Equations
    letters: OpenLetters
    small: Mapping[Symbol, Expr]

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
        hypotheses = [(equation, part) for equation, part in parts if self._moves(part)]
        if not linear:
            return None
        for equation, part in hypotheses:
            if self._are_multiples(linear, part):
                return equation
        facts = [part for each in true if (part := self._linear(each.relation))]
        for (equation, part), fact in islice(product(hypotheses, facts), _MOST):
            for symbol in (s for s in part.symbols() & fact.symbols() if s.kind.varies):
                slope = part.diff(symbol)
                if slope and not self._moves(slope):
                    put_in = fact - fact.diff(symbol) / slope * part
                    if self._moves(put_in) and self._are_multiples(linear, put_in):
                        return equation
        return None

    def source_of_stability(self, difference: Expr, wrong: Iterable[Equation]) -> Equation | None:
        """The wrong equation q'' + c q = 0 of whose motions an inequality says that c is positive.

        Args:
            difference: what the inequality says to be positive.
            wrong: the wrong equations before it.
        """
        difference = self._in_variables(self.letters.in_truth(difference)).subs(self._rest)
        for equation in wrong:
            part = self._linear(equation.relation)
            moving = {s for s in part.symbols() if s.base() in self._moving}
            accelerations = [s for s in moving if s.order == 2]
            if len(accelerations) != 1 or moving != {*accelerations, accelerations[0].base()}:
                continue
            inertia, stiffness = (part.diff(s) for s in (accelerations[0], accelerations[0].base()))
            if stiffness and is_positive(difference * inertia / stiffness):
                return equation
        return None

    def _moves(self, expression: Expr) -> bool:
        """Whether it contains what is small or a rate of that; a large spin counts as constant."""
        return any(symbol.base() in self._moving for symbol in expression.symbols())

    def _are_multiples(self, relations: Iterable[Expr], relation: Expr) -> bool:
        return all(not self._moves(each / relation) for each in relations)

    @cached_property
    def _moving(self) -> frozenset[Symbol]:
        return frozenset(symbol.base() for symbol in self.small)

    def _linear(self, relation: Expr) -> Expr:
        known, rest = self._in_variables(self.letters.in_truth(relation)), self._rest
        terms = ((Expr.generator(s) - at) * known.diff(s).subs(rest) for s, at in rest.items())
        return known.subs(rest) + sum(terms, ZERO)

    @cached_property
    def _rest(self) -> Mapping[Symbol, Expr]:
        """The values in the motion that small ones are close to, where their rates vanish."""
        rest = dict(self.small)
        for symbol in self.small:
            rest[symbol.derivative()] = rest[symbol.derivative().derivative()] = ZERO
        return rest

    def _in_variables(self, relation: Expr) -> Expr:
        """By the rates of coordinates that are small; of small speeds, with the rates of the others
        as they are in truth."""
        if any(s in self.equations.coordinates for s in self.small):
            return Mechanics(self.equations).in_rates(relation)
        others = {
            acceleration: value
            for acceleration, value in self.equations.accelerations.items()
            if acceleration.base() not in self.small
        }
        return relation.subs(others)


def frequency_or_period(equation: Equation, letter: Symbol) -> Iterator[Expr]:
    """What q'' + c q = 0 says of a letter: ω² = c if it is the frequency, T² c = 4π² the period."""
    moving = {s for s in equation.symbols if s.kind.varies}
    acceleration = next((s for s in moving if s.order == 2), None)
    if acceleration is None or moving != {acceleration, acceleration.base()}:
        return
    q = acceleration.base()
    slopes = [equation.relation.diff(symbol) for symbol in (acceleration, q)]
    if any(s.kind.varies for slope in slopes for s in slope.symbols()) or not all(slopes):
        return
    inertia, stiffness = slopes
    square = Expr.generator(letter) ** 2
    yield (square * inertia - stiffness).numerator
    yield (square * stiffness - 4 * Expr.generator(PI) ** 2 * inertia).numerator
