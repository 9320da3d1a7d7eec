"""What follows from the wrong lines of a text, each taken in place of what it contradicts.

A later line follows if it holds once a wrong line is solved for a quantity, that value is put in,
and everything else is as on the model: exactly, by the same means as the verdicts. True lines of
the text may stand between: E = T + V carries a wrong T to E. Then the equation between them, with
the wrong value put in, is one more hypothesis.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import islice, permutations

from polhode.algebra import Expr, Symbol, SymbolKind, has_parts
from polhode.base import PolhodeError
from polhode.claims.contexts._contexts import holds
from polhode.claims.meaning._mechanics import Mechanics
from polhode.claims.states._bound_claim import BoundClaim
from polhode.claims.states._claim_domain import TrueMotion
from polhode.derive import Equations
from polhode.review._open_letters import OpenLetters, OpenLine, changed
from polhode.review._rules import Rule, rules

_MOST = 400  # trials for one line
_KEPT = 60  # equations that follow from wrong lines by a true one, the latest first


@dataclass(frozen=True)
class Hypothesis:
    """An equation that holds if a wrong line did.

    Attributes:
        relation: vanishes.
        of: index of the first wrong line that it comes from.
        line: index of the line that states it, or leads to it with a true one.
        steps: true lines used.
    """

    relation: Expr
    of: int
    line: int
    steps: int = 0


class Consequences:
    """The wrong lines of a text so far, and what follows from them.

    Args:
        equations: of the system.
        letters: those of the text.
    """

    def __init__(self, equations: Equations, letters: OpenLetters) -> None:
        self._equations = equations
        self._letters = letters
        self._wrong: list[Hypothesis] = []
        self._derived: list[Hypothesis] = []
        self._facts: list[Expr] = [
            Expr.generator(symbol) - value
            for symbol, value in equations.dependent.items()
            if not has_parts(value)
        ]

    # -- what the text says -----------------------------------------------------------------------

    def add_true(self, line: OpenLine) -> None:
        """Take in a line that holds."""
        for fact in line.relations:
            if fact and fact not in self._facts:
                self._facts.append(fact)
                for wrong in self._wrong:
                    self._derive(wrong, [fact], line)

    def add_wrong(self, line: OpenLine, index: int, of: int) -> None:
        """Take in a line that is wrong, by itself or since line `of` is."""
        for relation in line.relations:
            for each in (relation, *self._of_lagrangian(relation)):
                wrong = Hypothesis(each, of, index)
                self._wrong.insert(0, wrong)
                self._derive(wrong, [*self._facts, *self._sums()], line)

    def _derive(self, wrong: Hypothesis, facts: list[Expr], line: OpenLine) -> None:
        """Take in what a wrong equation makes of true ones."""
        for rule in self._rules(wrong):
            for fact in facts:
                if not rule.applies(fact):
                    continue
                try:
                    found = rule.put(fact).numerator
                except (PolhodeError, ArithmeticError):
                    continue
                if found and not self._is_true(found, line):
                    self._derived.insert(0, replace(wrong, relation=found, steps=1))
        del self._derived[_KEPT:]

    def _sums(self) -> list[Expr]:
        """Equations such as E = T + V that hold between letters of the text."""
        values = {s: e for s, e in self._letters.values.items() if s.kind is SymbolKind.FUNCTION}
        found = []
        for whole, *pair in permutations(islice(values, 12), 3):
            one, other = pair
            generators = [Expr.generator(s) for s in (whole, one, other)]
            if one.published < other.published and values[whole] == values[one] + values[other]:
                found.append(generators[0] - generators[1] - generators[2])
            if values[whole] == values[one] - values[other]:
                found.append(generators[0] - generators[1] + generators[2])
        return found

    def _of_lagrangian(self, relation: Expr) -> Iterator[Expr]:
        """Lagrange's equations of a Lagrangian or a kinetic energy that a wrong line states."""
        mechanics = Mechanics(self._equations)
        for rule in rules(relation, self._letters.values):
            value = self._letters.values.get(rule.symbol)
            if value is None or rule.power > 1:
                continue
            if value == mechanics.lagrangian():
                wrong = rule.value
            elif value == mechanics.kinetic_energy():
                wrong = rule.value - mechanics.potential_energy()
            else:
                continue
            wrong = mechanics.in_rates(self._letters.in_truth(wrong))
            for q in mechanics.declared.coordinates:
                yield wrong.diff(q.derivative()).dt() - wrong.diff(q)

    # -- what follows -----------------------------------------------------------------------------

    def implied(self, line: OpenLine, contexts: tuple[str, ...]) -> Hypothesis | None:
        """The wrong line that a line follows from; None if it follows from none."""
        if line.claim is None or not self._wrong:
            return None
        for used in islice(self._ways(line.claim), _MOST):
            if self._follows(line.claim, used, contexts):
                return used[0][0]
        return None

    def contradicted(self, line: OpenLine) -> Hypothesis | None:
        """The wrong line by which a true line would not hold that gives a value to a quantity.

        Only a value that the wrong line determines, by itself or with a true line before, counts:
        a law between quantities of which some are wrong stays true by itself.
        """
        for relation in line.relations:
            own = {rule.symbol: rule for rule in self._values_in(relation)}
            for wrong in (*self._wrong, *self._derived):
                for rule in self._values_in(wrong.relation):
                    if rule.symbol not in own or rule.power != own[rule.symbol].power:
                        continue
                    if not self._is_true(rule.value - own[rule.symbol].value, line):
                        return wrong
        return None

    def _values_in(self, relation: Expr) -> Iterator[Rule]:
        """What an equation gives to letters, accelerations and reactions by known quantities."""
        for rule in rules(relation, self._letters.values):
            if self._is_unknown(rule.symbol) and not any(
                map(self._is_unknown, rule.value.symbols())
            ):
                yield rule

    def _is_unknown(self, symbol: Symbol) -> bool:
        equations = self._equations
        return (
            symbol.base() in self._letters.values
            or symbol.base() in equations.dependent
            or symbol in equations.acceleration_symbols
            or (symbol.kind is SymbolKind.FUNCTION and symbol.published in equations.components)
        )

    def _ways(self, claim: BoundClaim) -> Iterator[tuple[tuple[Hypothesis, Rule], ...]]:
        """Values that wrong lines give to quantities of a claim, the simplest ways first."""
        used = frozenset().union(
            *(side.symbols() for c in claim.components() for side in (c.left, c.right))
        )
        single = [
            (wrong, rule)
            for wrong in (*self._wrong, *self._derived)
            for rule in self._rules(wrong)
            if any(s.base() == rule.symbol.base() for s in used)
        ]
        yield from ((each,) for each in single)
        every = [(wrong, rule) for wrong in self._wrong for rule in self._rules(wrong)]
        for first, second in permutations(every, 2):
            if first in single and first[1].symbol != second[1].symbol:
                yield first, second
        latest = {rule.symbol: (wrong, rule) for wrong, rule in reversed(every)}
        if len(latest) > 2:
            yield tuple(latest.values())

    def _rules(self, wrong: Hypothesis) -> tuple[Rule, ...]:
        return tuple(rules(wrong.relation, self._letters.values))

    def _follows(
        self,
        claim: BoundClaim,
        used: tuple[tuple[Hypothesis, Rule], ...],
        contexts: tuple[str, ...],
    ) -> bool:
        def image(expression: Expr) -> Expr:
            for _, rule in used:
                if rule.applies(expression):
                    expression = rule.put(expression)
            return self._letters.in_truth(expression)

        try:
            found = changed(claim, image)
            return any(holds(found, context) for context in contexts)
        except (PolhodeError, ArithmeticError):
            return False

    def _is_true(self, relation: Expr, line: OpenLine) -> bool:
        """Whether an equation holds on every true motion under the restrictions of a line."""
        try:
            return self._states(line).vanishing(self._letters.in_truth(relation)).is_zero
        except (PolhodeError, ArithmeticError):
            return False

    def _states(self, line: OpenLine) -> TrueMotion:
        claim = line.claim or BoundClaim(((),), self._equations)
        return claim.states(TrueMotion)
