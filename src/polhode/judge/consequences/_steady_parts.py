"""Which wrong equation a line about steady motion, or about departures from it, comes from."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, linear_parts, solve
from polhode.base import ByIdentity, PolhodeError
from polhode.derive import Equations
from polhode.judge.consequences._equations_of_text import Equation
from polhode.judge.consequences._open_letters import OpenLetters
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.lines._near_steady import kept_values, steady_momenta
from polhode.judge.lines._vacuous import vanishing_in_steady_motion
from polhode.judge.lines._weaker_meanings import with_steady_values
from polhode.judge.meaning._mechanics import Mechanics, on_constraints
from polhode.judge.text._text_line import TextLine


@dataclass(frozen=True)
class SteadyParts:
    """What equations of a text say of steady motions, and of small departures from them.

    Attributes:
        equations: of the system.
        letters: of the text, which are as they are in truth.
    """

    equations: Equations
    letters: OpenLetters

    @cached_property
    def _mechanics(self) -> Mechanics:
        return Mechanics(self.equations)

    def source(self, judged: JudgedLine, wrong: Iterable[Equation]) -> Equation | None:
        """The wrong equation that a line says of steady motion, but for factors such as sin θ.

        "sin θ = 0 or cos θ = g/(a Ω²)" gives the zeros of an equation of motion one by one: where
        a line holds, what it comes from vanishes in steady motion.
        """
        still = vanishing_in_steady_motion(self.equations)
        kept = with_steady_values(judged.line, self.equations)
        stated = [difference.numerator for difference in self._differences(kept, judged)]
        if not stated or any(difference.symbols() & still for difference in stated):
            return None
        given = [list(_solutions(difference)) for difference in stated]
        rest = dict.fromkeys(still, ZERO)
        for equation in wrong:
            relation = self._in_truth(equation.relation)
            if relation.symbols().isdisjoint(still):
                continue  # no equation of motion
            balance = relation.subs(rest).numerator
            if balance and all(_vanishes(balance, solutions) for solutions in given):
                return equation
        return None

    def source_of_departure(self, judged: JudgedLine, wrong: Sequence[Equation]) -> Equation | None:
        """The wrong equation of which a line about θ = θ₀ + ε is the linear part at its own θ₀.

        Cyclic momenta are those of the steady motion.
        """
        kept = kept_values(judged.line.in_force)
        stated = [d for d in self._differences(judged.line, judged) if d]
        if len(kept) != 1 or len(stated) != 1:
            return None
        ((q, value),) = kept.items()
        for departing, relations in steady_momenta(ByIdentity(self.equations)):
            if departing != {q}:
                continue
            turning = self._turning(
                (r.left - r.right)
                for r in relations
                if isinstance(r.left, Expr) and isinstance(r.right, Expr)
            )
            line = self._linear(stated[0].subs(turning), q, value)
            for equation in wrong:
                found = self._linear(self._in_truth(equation.relation).subs(turning), q, value)
                if line is not None and found is not None and line.agrees_with(found):
                    return equation
        return None

    def _turning(self, conserved: Iterable[Expr]) -> Mapping[Symbol, Expr]:
        """The rates of cyclic coordinates by the momenta that are kept."""
        still = vanishing_in_steady_motion(self.equations)
        known = [self._mechanics.in_rates(each) for each in conserved]
        moving = [each for each in known if each.varies]
        rates = {s for each in moving for s in each.symbols() if s.order == 1} - still
        unknown = sorted(rates, key=lambda s: s.key)
        if not unknown or len(unknown) != len(moving):
            return {}
        with suppress(PolhodeError, ZeroDivisionError):
            parts = [linear_parts(each, unknown) for each in moving]
            found = solve([row for row, _ in parts], [-remainder for _, remainder in parts])
            return dict(zip(unknown, found, strict=True))
        return {}

    def _linear(self, relation: Expr, q: Symbol, value: Expr) -> _LinearPart | None:
        """A relation to first order in what departs; None where it has further accelerations."""
        rate = q.derivative()
        acceleration = rate.derivative()
        if any(s.order and s not in (rate, acceleration) for s in relation.symbols()):
            return None
        place: dict[Symbol, Expr] = {q: value, rate: ZERO, acceleration: ZERO}
        slopes = (relation.diff(s).subs(place) for s in (acceleration, rate, q))
        inertia, damping, stiffness = slopes
        if not inertia or damping:
            return None
        return _LinearPart(relation.subs(place), stiffness / inertia)

    def _differences(self, line: TextLine, judged: JudgedLine) -> Sequence[Expr]:
        """The differences of both sides of a line, in rates; none where it claims more."""
        notation = line.in_force.notation(self.equations, {})
        try:
            claim = notation.claimed(notation.bound(judged.line.statement))
            is_plain = len(claim.branches) == 1 and all(m.sign in "=≈" for m in claim.members)
            return [self._in_truth(c.difference) for c in claim.components()] if is_plain else []
        except (PolhodeError, ZeroDivisionError):
            return []

    def _in_truth(self, relation: Expr) -> Expr:
        known = on_constraints(self.letters.in_truth(relation), self.equations)
        return self._mechanics.in_rates(known)


@dataclass(frozen=True)
class _LinearPart:
    """An equation of motion close to a steady motion: q'' + c (q - q₀) = 0.

    Attributes:
        balance: what vanishes in the steady motion.
        stiffness: the coefficient c.
    """

    balance: Expr
    stiffness: Expr

    def agrees_with(self, wrong: _LinearPart) -> bool:
        """Whether it is the linear part of a wrong equation, at a steady motion of that."""
        difference = (self.stiffness - wrong.stiffness).numerator
        if self.balance or not difference:
            return not self.balance
        return _vanishes(difference, _solutions(wrong.balance.numerator))


def _solutions(relation: Expr) -> Iterator[tuple[Symbol, Expr]]:
    """A polynomial relation solved for each parameter in which it is linear."""
    for symbol in sorted(relation.symbols(), key=lambda s: s.key):
        if symbol.kind is SymbolKind.PARAMETER:
            found = Equation(relation, (symbol,)).unknowns.get(symbol)
            if found is None or found.power != 1:
                continue
            rest = relation - found.slope * Expr.generator(symbol)
            if rest:
                yield symbol, -rest / found.slope


def _vanishes(relation: Expr, solutions: Iterable[tuple[Symbol, Expr]]) -> bool:
    """Whether a relation vanishes where another one does, solved for one of its parameters."""
    for symbol, value in solutions:
        if symbol in relation.symbols():
            return not relation.subs({symbol: value})
    return False
