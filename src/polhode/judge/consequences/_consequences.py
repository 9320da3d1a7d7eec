"""What follows from the wrong lines of a text, each taken in place of what it contradicts.

A later line follows if it holds on the states at which a wrong line is imposed: one quantity in it
has the value that the wrong line gives it, and everything else is as on the model. Equations that
are true may be kept with it, which carry the change on to other quantities: E = T + V carries a
wrong T to E. This is decided as verdicts are, by exact evaluation at random states.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from itertools import chain, islice, permutations, product

from polhode.algebra import (
    ZERO,
    Expr,
    FieldPoint,
    Residue,
    Symbol,
    SymbolKind,
    has_parts,
    vanishing,
)
from polhode.base import PolhodeError
from polhode.derive import Equations
from polhode.judge.balance._declared import reaction_symbol
from polhode.judge.consequences._blocks import EquationBlock, blocks
from polhode.judge.consequences._elimination import Eliminating
from polhode.judge.consequences._equations_of_text import (
    ChangedPoint,
    Equation,
    Solving,
    UndeterminedError,
    carrying,
    imposed,
    is_rate_of_acceleration,
    stages,
    with_another_factor,
)
from polhode.judge.consequences._forces_of_text import equations_of_motion_with
from polhode.judge.consequences._lagrangian_of_text import (
    equations_of_lagrangian,
    stated_lagrangians,
)
from polhode.judge.consequences._linear_parts import LinearParts, frequency_or_period
from polhode.judge.consequences._open_letters import OpenLetters, OpenLine
from polhode.judge.consequences._other_inertia import (
    WrongInertia,
    equations_with,
    holds_with,
    wrong_inertia,
)
from polhode.judge.consequences._steady_parts import SteadyParts
from polhode.judge.contexts._contexts import holds
from polhode.judge.lines._judged_line import JudgedLine
from polhode.judge.lines._vacuous import vanishing_in_steady_motion
from polhode.judge.lines._weaker_meanings import small_variables
from polhode.judge.meaning._mechanics import Mechanics, on_constraints
from polhode.judge.states._bound_claim import SENSE

_MOST = 3000  # trials for one line
_MOST_CLOSED = 400  # likewise, of three equations that are solved together
_MOST_SUBSTITUTIONS = 400  # likewise, of whole vectors
_MOST_NUMERIC = 40  # likewise, of numbers, which agree by chance now and then
_LETTERS = 12  # of a text among which sums such as E = T + V are sought


@dataclass(frozen=True, eq=False)
class Hypothesis:
    """An equation of a wrong line.

    Attributes:
        equation: that it states, or the rate of it.
        of: index of the line that is wrong by itself from which it comes.
        line: index of the line itself.
    """

    equation: Equation
    of: int
    line: int


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
        self._wrong_lagrangians: list[tuple[Expr, int, int]] = []
        self._by_lagrangian: dict[tuple[Expr, int], tuple[Equation, ...]] = {}
        self._by_oscillation: dict[tuple[Hypothesis, int], tuple[Hypothesis, ...]] = {}
        self._inertias: list[WrongInertia] = []
        self._others: list[tuple[Equations, int]] = []
        self._points: dict[FieldPoint, ChangedPoint] = {}
        self._facts: list[Equation] = []
        self._wrong_blocks: list[tuple[Hypothesis, EquationBlock]] = []
        self._true_lines: list[tuple[Equation, ...]] = []
        self._laws = [
            Equation(law.numerator, letters.values)
            for law in _laws(equations)
            if not has_parts(law)
        ]

    # -- what the text says -----------------------------------------------------------------------

    def add_true(self, line: OpenLine) -> None:
        """Take in a line that holds."""
        for relation in line.relations:
            self._keep(relation)
        equations = tuple(self._equation(relation) for relation in line.relations)
        self._true_lines.insert(0, equations)

    def _equation(self, relation: Expr) -> Equation:
        return Equation(relation.numerator, self._letters.values)

    def _keep(self, relation: Expr) -> None:
        fact = Equation(relation.numerator, self._letters.values)
        if not any(fact.relation == known.relation for known in self._facts):
            self._facts.insert(0, fact)

    def add_wrong(self, line: OpenLine, index: int, of: int) -> None:
        """Take in a line that is wrong, by itself or since line `of` is."""
        equations = [self._equation(relation) for relation in line.drawn_on]
        for block in blocks(equations, self._letters.groups):
            self._wrong_blocks.insert(0, (Hypothesis(equations[0], of, index), block))
        for equation in equations:
            found = [equation]
            if any(symbol.kind.varies for symbol in equation.symbols):
                found.append(equation.rate)
            self._wrong = [*(Hypothesis(each, of, index) for each in found), *self._wrong]
            known = [lagrangian for lagrangian, _, _ in self._wrong_lagrangians]
            for lagrangian in stated_lagrangians(equation, self._letters, self._equations):
                if lagrangian not in known:
                    self._wrong_lagrangians.insert(0, (lagrangian, of, index))
            inertia = wrong_inertia(equation, self._letters, self._equations.system)
            if inertia is not None:
                self._with_other_inertia(inertia, of)

    def _with_other_inertia(self, inertia: WrongInertia, of: int) -> None:
        """Take in the systems for which a moment of inertia that is stated wrongly is right."""
        self._inertias = [*(i for i in self._inertias if i.right != inertia.right), inertia]
        for wrong in dict.fromkeys([(inertia,), tuple(self._inertias)]):
            found = equations_with(self._equations.system, wrong)
            if found is not None:
                self._others.insert(0, (found, of))

    @property
    def _hypotheses(self) -> list[Hypothesis]:
        """The wrong lines, the latest first, and what is made of Lagrangians and oscillations."""
        by_method = [
            Hypothesis(equation, of, index)
            for lagrangian, of, index in self._wrong_lagrangians
            for equation in self._of_lagrangian(lagrangian)
        ]
        oscillating = (each for wrong in self._wrong for each in self._of_oscillation(wrong))
        return [*self._wrong, *by_method, *oscillating]

    def _of_oscillation(self, wrong: Hypothesis) -> tuple[Hypothesis, ...]:
        """What it says of frequencies and periods, once for the letters that the text has now."""
        letters = self._letters.values
        key = wrong, len(letters)
        if key not in self._by_oscillation:
            self._by_oscillation[key] = tuple(
                replace(wrong, equation=Equation(relation, letters))
                for letter in letters
                if letter.kind is SymbolKind.PARAMETER
                for relation in frequency_or_period(wrong.equation, letter)
            )
        return self._by_oscillation[key]

    def _of_lagrangian(self, lagrangian: Expr) -> tuple[Equation, ...]:
        """What Lagrange's method makes of it, once for the letters that the text has now."""
        key = lagrangian, len(self._letters.values)
        if key not in self._by_lagrangian:
            found = equations_of_lagrangian(lagrangian, self._letters, self._equations)
            self._by_lagrangian[key] = tuple(found)
        return self._by_lagrangian[key]

    def _by_slope_of_lagrangian(self, judged: JudgedLine) -> int | None:
        """Index of the wrong line by which the Lagrangian has the slope that a line gives it."""
        mechanics = Mechanics(self._equations)
        claim = judged.claim
        if not self._wrong_lagrangians or claim is None or len(claim.branches) > 1:
            return None
        differences = [mechanics.in_rates(c.difference) for c in claim.components()]
        symbols = [s for q in mechanics.declared.coordinates for s in (q, q.derivative())]
        right = mechanics.in_rates(mechanics.lagrangian())
        for lagrangian, of, _ in self._wrong_lagrangians:
            for symbol in symbols:
                change = (lagrangian - right).diff(symbol)
                if change and all(d in (ZERO, change, -change) for d in differences):
                    return of
        return None

    def _of_letters(self) -> Iterator[Equation]:
        """What letters of the text stand for, and sums such as E = T + V between them."""
        letters = self._letters.values
        values = {s: e for s, e in letters.items() if s.kind is SymbolKind.FUNCTION}
        for symbol, value in values.items():
            yield Equation((Expr.generator(symbol) - value).numerator, letters)
        for whole, one, other in permutations(islice(values, _LETTERS), 3):
            left, first, second = map(Expr.generator, (whole, one, other))
            if one.key < other.key and values[whole] == values[one] + values[other]:
                yield Equation(left - first - second, letters)
            if values[whole] == values[one] - values[other]:
                yield Equation(left - first + second, letters)
        yield from self._of_energies(values)
        yield from self._by_velocity(values)
        yield from equations_of_motion_with(values, self._letters, self._equations)

    def _of_energies(self, values: Mapping[Symbol, Expr]) -> Iterator[Equation]:
        """E = T + V and T - V = L where a text has a letter for all but one of them."""
        mechanics = Mechanics(self._equations)
        kinetic, potential = mechanics.kinetic_energy(), mechanics.potential_energy()
        parts = (mechanics.translational_energy(), mechanics.rotational_energy())
        for one, other in permutations(islice(values, _LETTERS), 2):
            left, right = Expr.generator(one), Expr.generator(other)
            difference = values[one] - values[other]
            if difference and difference in (kinetic, potential, *parts):
                yield Equation((left - right - difference).numerator, self._letters.values)
            if one.key < other.key and values[one] + values[other] == kinetic:
                yield Equation((left + right - kinetic).numerator, self._letters.values)

    def _by_velocity(self, values: Mapping[Symbol, Expr]) -> Iterator[Equation]:
        """König's theorem, T = m v²/2 and the energy of rotation, where a text has T and v."""
        mechanics = Mechanics(self._equations)
        if len(self._equations.system.bodies) != 1:
            return
        velocity, kinetic = mechanics.velocity(), mechanics.kinetic_energy()
        square = velocity.dot(velocity)
        for v, energy in permutations(values, 2):
            if values[v] ** 2 == square and values[energy] == kinetic:
                translation = mechanics.body.mass / 2 * Expr.generator(v) ** 2
                rotation = mechanics.rotational_energy()
                relation = Expr.generator(energy) - translation - rotation
                yield Equation(relation.numerator, self._letters.values)

    def _energy_ways(
        self, line: OpenLine, used: frozenset[Symbol]
    ) -> Iterator[tuple[Hypothesis, Solving]]:
        """Wrong kinetic energies, put into the energy that a motion has kept since its start."""
        relations = line.claim.initial.relations if line.claim is not None else ()
        mechanics = Mechanics(self._equations)
        energy, kinetic = mechanics.energy(), self._by_speeds(mechanics.kinetic_energy())
        conserved = [r - kinetic for r in relations if not self._by_speeds((r - energy).dt())]
        for potential, wrong in product(conserved, self._wrong):
            for symbol in (s for s in wrong.equation.unknowns if s in self._letters.values):
                slope = wrong.equation.unknowns[symbol].slope
                stated = self._letters.solved(wrong.equation.relation, symbol, slope)
                if stated is None or self._by_speeds(self._letters.values[symbol]) != kinetic:
                    continue
                equation = Equation((stated + potential).numerator, self._letters.values)
                for unknown in (u for s, u in equation.unknowns.items() if s in used):
                    yield wrong, ((equation, unknown),)

    def _by_speeds(self, expression: Expr) -> Expr:
        return on_constraints(expression, self._equations)

    # -- what follows -----------------------------------------------------------------------------

    def implied(
        self, line: OpenLine, judged: JudgedLine, cited: frozenset[int] = frozenset()
    ) -> int | None:
        """Index of the wrong line that a line follows from; None if it follows from none.

        Of several, one that the text cites is taken.
        """
        self._cited_first(cited)
        source = self._source(line, judged.line.is_steady) or self._numeric_source(line)
        if source is not None:
            return source.of
        if (of := self._by_slope_of_lagrangian(judged)) is not None:
            return of
        small = small_variables(judged.line, self._equations)
        if small and (source := self._linear_source(line, small)):
            return source.of
        if small and (source := self._source_of_stability(judged, small)):
            return source.of
        if judged.line.is_steady and (source := self._source_of_steady_part(judged)):
            return source.of
        return next((of for other, of in self._others if holds_with(other, judged)), None)

    def _source(self, line: OpenLine, is_steady: bool) -> Hypothesis | None:
        differences = line.differences
        if not self._wrong or not differences:
            return None
        found = self._put_in(line, is_steady)
        if found is not None:
            return found
        known = [*self._facts, *self._laws, *self._of_letters()]
        for stated in filter(None, (differences, line.squared)):
            used = frozenset().union(*(difference.symbols() for difference in stated))
            ways = islice(self._ways(used, known), _MOST)
            closed = islice(self._closed_ways(used), _MOST_CLOSED)
            for wrong, solving in chain(ways, closed, self._energy_ways(line, used)):
                if self._vanish_for_all_factors(stated, solving, line):
                    return wrong
        if not line.is_energy:
            return None
        # An energy counts from any level: what has to agree is the rate of both sides.
        rates = [difference.dt() for difference in differences]
        used = frozenset().union(*(rate.symbols() for rate in rates))
        for wrong, solving in islice(self._ways(used, known), _MOST):
            # At rest every rate vanishes, whatever the energy.
            if any(unknown.symbol in self._equations.speeds for _, unknown in solving):
                continue
            if self._vanish_for_all_factors(rates, solving, line):
                return wrong
        return None

    def _numeric_source(self, line: OpenLine) -> Hypothesis | None:
        """The wrong line with which a number agrees in its digits, put in directly or by a fact."""
        claim = line.claim
        if claim is None or not claim.digits or len(claim.branches) > 1:
            return None
        used = frozenset().union(*(difference.symbols() for difference in line.differences))
        for wrong, solving in islice(self._ways(used, self._facts), _MOST_NUMERIC):
            values = self._letters.values_by(solving)
            with suppress(PolhodeError, ArithmeticError):  # quantities without a number
                if values is not None and holds(self._letters.with_values(claim, values), "number"):
                    return wrong
        return None

    def _put_in(self, line: OpenLine, is_steady: bool) -> Hypothesis | None:
        """The wrong line from which a line follows when letters of the text are put in."""
        found: Iterator[tuple[Hypothesis, Sequence[Solving]]] = chain(
            islice(self._substitutions(line.differences), _MOST_SUBSTITUTIONS),
            islice(
                self._eliminations(self._equations.acceleration_symbols, True),
                _MOST_SUBSTITUTIONS,
            ),
        )
        for wrong, order in found:
            if self._vanish_at(line.differences, order, line):
                return wrong
        return self._steady_source(line) if is_steady else None

    def _cited_first(self, cited: frozenset[int]) -> None:
        """Have wrong lines that the text cites tried before others, the latest first."""
        self._wrong.sort(key=lambda wrong: (wrong.line not in cited, -wrong.line))
        self._wrong_blocks.sort(key=lambda pair: (pair[0].line not in cited, -pair[0].line))

    def contradicted(
        self, line: OpenLine, cited: frozenset[int] = frozenset()
    ) -> Hypothesis | None:
        """The wrong line by which a true line would not hold that gives a value to a quantity.

        Only a value that the wrong line determines, by itself or with a true line before, counts:
        a law between quantities of which some are wrong stays true by itself. A line that cites
        others is drawn from them alone; one that cites none is drawn from the true lines if these
        give the value in fewer steps.
        """
        sources = {wrong.of for wrong in self._wrong if wrong.line in cited}
        is_steady = line.context == "steady"
        still = vanishing_in_steady_motion(self._equations) if is_steady else frozenset()
        for relation in line.relations:
            equation = Equation(relation.numerator, self._letters.values)
            for symbol in equation.unknowns:
                if symbol not in still and self._only_unknown(symbol, [equation]):
                    against, steps = self._against(symbol, equation, line)
                    if against is None or (cited and against.of not in sources):
                        continue
                    fewer = steps if is_steady else steps - 1  # as what vanishes is known there
                    if cited or not self._is_given_by_facts(symbol, fewer, still):
                        return against
        return None

    def _is_given_by_facts(self, symbol: Symbol, most: int, known: frozenset[Symbol]) -> bool:
        """Whether at most so many true lines, one or two, determine a quantity by themselves."""
        facts = [f for f in (*self._facts, *self._rates_of_facts) if symbol in f.unknowns]
        giving = [set(filter(self._is_unknown, f.symbols - known)) for f in facts]
        if most >= 1 and {symbol} in giving:
            return True
        others = {s for unknown in giving if len(unknown) == 2 for s in unknown - {symbol}}
        return most >= 2 and any(self._is_given_by_facts(other, 1, known) for other in others)

    @property
    def _rates_of_facts(self) -> Iterator[Equation]:
        return (f.rate for f in self._facts if any(s.kind.varies for s in f.symbols))

    def _against(
        self, symbol: Symbol, equation: Equation, line: OpenLine
    ) -> tuple[Hypothesis | None, int]:
        """The first wrong line that gives a quantity another value, with the number of equations.

        None if a wrong line gives this value.
        """
        found: Hypothesis | None = None
        steps = 0
        for wrong, solving in islice(self._ways(frozenset({symbol}), self._facts), _MOST):
            if any(used.relation == equation.relation for used, _ in solving):
                continue
            if not self._determines(solving) or self._contradict(solving):
                continue
            match self._vanish([equation.relation], solving, line):
                case True:
                    return None, 0
                case False if found is None:
                    found, steps = wrong, len(solving)
        return found, steps

    def _only_unknown(self, symbol: Symbol, equations: Iterable[Equation]) -> bool:
        symbols = chain.from_iterable(equation.symbols for equation in equations)
        return self._is_unknown(symbol) and not any(
            self._is_unknown(other) for other in symbols if other != symbol
        )

    def _determines(self, solving: Solving) -> bool:
        """Whether equations give what is solved for by known quantities alone."""
        solved = {unknown.symbol for _, unknown in solving}
        symbols = chain.from_iterable(equation.symbols for equation, _ in solving)
        return not any(self._is_unknown(s) for s in symbols if s not in solved)

    def _contradict(self, solving: Solving) -> bool:
        """Whether two equations relate the same quantities, so that one of them cannot stay.

        Rates of accelerations count as contradicting: no author works with them.
        """
        related = [frozenset(filter(self._is_unknown, e.symbols)) for e, _ in solving]
        return len(set(related)) < len(related) or any(
            map(is_rate_of_acceleration, chain(*related))
        )

    def _is_unknown(self, symbol: Symbol) -> bool:
        """Whether a quantity follows from parameters, coordinates and independent speeds."""
        if symbol.base() in self._letters.values:
            return True
        if symbol.kind is SymbolKind.FUNCTION:
            return symbol.published in self._equations.components
        if symbol.kind is SymbolKind.COORDINATE and not symbol.order:
            return False
        return symbol.kind.varies and symbol not in self._equations.speeds

    def _ways(
        self, used: frozenset[Symbol], facts: Sequence[Equation]
    ) -> Iterator[tuple[Hypothesis, Solving]]:
        """Wrong lines to impose, with the quantities that change, the simplest ways first.

        The last quantity of each is one of those used; facts may carry the change on to it.
        """
        hypotheses = self._hypotheses
        starts = [
            (wrong, (wrong.equation, unknown))
            for wrong in hypotheses
            for unknown in wrong.equation.unknowns.values()
        ]
        for wrong, start in starts:
            if start[1].symbol in used:
                yield wrong, (start,)
        others = [*(wrong.equation for wrong in hypotheses), *facts]
        others += [f.rate for f in facts if any(s.kind.varies for s in f.symbols)]
        pairs = [
            (wrong, (start, more)) for wrong, start in starts for more in carrying(start, others)
        ]
        yield from (way for way in pairs if way[1][-1][1].symbol in used)
        for wrong, (start, more) in pairs:
            for last in carrying(more, others):
                is_new = last[0] is not start[0] and last[1].symbol != start[1].symbol
                if is_new and last[1].symbol in used:
                    yield wrong, (start, more, last)

    def _closed_ways(self, used: frozenset[Symbol]) -> Iterator[tuple[Hypothesis, Solving]]:
        """Wrong lines solved with two true lines of the text for a quantity of the middle one.

        m dv/dt = mg - S, I dω/dt = r S and dv/dt = r dω/dt determine dω/dt only together.
        """
        facts = [*self._facts, *self._rates_of_facts]
        for wrong in self._wrong:
            for unknown in wrong.equation.unknowns.values():
                start = (wrong.equation, unknown)
                for more in carrying(start, facts):
                    if more[1].symbol not in used:
                        continue
                    for last in carrying(more, facts):
                        is_closed = last[1].symbol in wrong.equation.symbols
                        if is_closed and last[1].symbol != unknown.symbol:
                            yield wrong, (start, more, last)

    def _substitutions(
        self, differences: Sequence[Expr]
    ) -> Iterator[tuple[Hypothesis, tuple[Solving, ...]]]:
        """Letters that wrong lines give, put into a line, directly or by one true line."""
        used = frozenset().union(*(difference.symbols() for difference in differences))
        for wrong, block in self._wrong_blocks:
            if not block.unknowns.isdisjoint(used):
                yield wrong, block.stages
        carrying = [b for line in self._true_lines for b in blocks(line, self._letters.groups)]
        for wrong, block in self._wrong_blocks:
            for law in carrying:
                is_new = law.unknowns.isdisjoint(block.unknowns)
                if is_new and law.symbols & block.unknowns and law.unknowns & used:
                    yield wrong, (*block.stages, *law.stages)

    def _eliminations(
        self, unknown: Sequence[Symbol], together: bool
    ) -> Iterator[tuple[Hypothesis, Sequence[Solving]]]:
        """Laws of the text into which a wrong line is put."""
        eliminating = Eliminating(self._letters, self._true_lines)
        for wrong, block in self._wrong_blocks:
            for solving in eliminating.ways(block, unknown, together):
                yield wrong, (solving,)

    def _steady_source(self, line: OpenLine) -> Hypothesis | None:
        """The wrong line that a line says of steady motion follows from."""
        still = vanishing_in_steady_motion(self._equations)
        speeds = [s for s in self._equations.speeds if s not in still]
        direct = (
            (wrong, (((wrong.equation, wrong.equation.unknowns[speed]),),))
            for wrong in self._wrong
            for speed in speeds
            if speed in wrong.equation.unknowns
        )
        ways = chain(direct, self._eliminations(speeds, False))
        for wrong, order in islice(ways, _MOST_SUBSTITUTIONS):
            if self._vanish_at(line.differences, order, line, still):
                return wrong
        return None

    def _source_of_steady_part(self, judged: JudgedLine) -> Hypothesis | None:
        """The wrong equation from which a line about steady motion, or close to it, comes."""
        parts = SteadyParts(self._equations, self._letters)
        wrong = {h.equation: h for h in self._hypotheses}
        found = parts.source(judged, wrong) or parts.source_of_departure(judged, [*wrong])
        return None if found is None else wrong[found]

    def _linear_source(self, line: OpenLine, small: Mapping[Symbol, Expr]) -> Hypothesis | None:
        """The wrong equation of which a line about small motions is the linear part."""
        linear = LinearParts(self._equations, self._letters, small)
        with suppress(PolhodeError, ArithmeticError):
            wrong = {h.equation: h for h in self._hypotheses}
            found = linear.source(
                line.differences, wrong, [*self._facts, *self._rates_of_facts, *self._laws]
            )
            return None if found is None else wrong[found]
        return None

    def _source_of_stability(
        self, judged: JudgedLine, small: Mapping[Symbol, Expr]
    ) -> Hypothesis | None:
        """The wrong equation of small motions of which a line gives the condition of stability."""
        claim = judged.claim
        if claim is None or judged.verdict.context != "threshold" or len(claim.members) != 1:
            return None
        (member,) = claim.members
        if member.sign not in SENSE:
            return None
        linear = LinearParts(self._equations, self._letters, small)
        with suppress(PolhodeError, ArithmeticError):
            (component,) = claim.components()
            difference = component.difference * SENSE[member.sign]
            wrong = {h.equation: h for h in self._hypotheses}
            found = linear.source_of_stability(difference, wrong)
            return None if found is None else wrong[found]
        return None

    def _vanish(self, differences: Iterable[Expr], solving: Solving, line: OpenLine) -> bool | None:
        """Whether expressions vanish where equations are imposed; None if that is not decided."""
        return self._vanish_at(differences, stages(solving), line)

    def _vanish_at(
        self,
        differences: Iterable[Expr],
        order: Sequence[Solving],
        line: OpenLine,
        still: frozenset[Symbol] = frozenset(),
    ) -> bool | None:
        """The same, the equations being imposed in stages.

        Args:
            differences: the expressions.
            order: the stages.
            line: that is judged.
            still: speeds and accelerations that vanish besides, in steady motion.
        """
        field = line.states(self._equations).field
        if not order or field is None or not field.are_drawn:
            return None

        def value_of(difference: Expr) -> Callable[[FieldPoint], Residue]:
            return lambda point: difference.residue(imposed(self._at_rest(point, still), order))

        try:
            return all(vanishing(value_of(d), field.point).is_zero for d in differences)
        except (UndeterminedError, PolhodeError, ArithmeticError):
            return None

    def _vanish_for_all_factors(
        self, differences: Sequence[Expr], solving: Solving, line: OpenLine
    ) -> bool:
        """Whether expressions vanish where equations are imposed, whichever factor is zero there.

        That a product vanishes, as dtheta/dt dphi/dt does where domega_3/dt is said to be zero on a
        rolling disk, implies only what holds if any one of its factors is zero.
        """
        if self._is_degenerate(solving) or not self._vanish(differences, solving, line):
            return False
        return all(
            self._vanish(differences, other, line)
            for place, (_, unknown) in enumerate(solving)
            if self._vanish([Expr.generator(unknown.symbol)], solving, line)
            for other in with_another_factor(solving, place)
        )

    def _is_degenerate(self, solving: Solving) -> bool:
        """Whether several wrong lines, which may contradict each other, restrict the motion."""
        wrong = {id(hypothesis.equation) for hypothesis in self._hypotheses}
        imposed_lines = sum(id(equation) in wrong for equation, _ in solving)
        restricts = any(unknown.symbol in self._equations.speeds for _, unknown in solving)
        return restricts and imposed_lines > 1

    def _at_rest(self, point: FieldPoint, still: frozenset[Symbol]) -> ChangedPoint:
        """A state at which some quantities vanish."""
        truth = self._in_truth(point)
        return truth.changing({s: ZERO.residue(point) for s in still}) if still else truth

    def _in_truth(self, point: FieldPoint) -> ChangedPoint:
        """A state with letters as they are, kept so that equations are evaluated there once."""
        if point not in self._points:
            self._points[point] = ChangedPoint(point, self._letters.value, {})
        return self._points[point]


def _laws(equations: Equations) -> Iterator[Expr]:
    """What the model itself says of speeds, reactions and accelerations."""
    for symbol, value in (*equations.dependent.items(), *equations.kinematics.items()):
        yield Expr.generator(symbol) - value
    for name, force in equations.components.items():
        reaction = reaction_symbol(name)
        if force.symbol is None or force.symbol.name != name:
            yield Expr.generator(reaction) - force
    yield from equations.motion
