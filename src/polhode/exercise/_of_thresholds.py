"""Questions about thresholds: of stability, or of the existence of a steady motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, Symbol
from polhode.algebra import sqrt as exact_sqrt
from polhode.analyse import Condition, Stability, SteadyMotion, Truth
from polhode.exercise._families import family_words, given_of, growth_rate, open_speeds
from polhode.exercise._numbers import draw_state
from polhode.exercise._of_motion import formula_and_number
from polhode.exercise._question import ExerciseQuestion, Occasion, Passage, stated
from polhode.exercise._subject import LONGEST, ExerciseSubject, value_of
from polhode.solution import inline, listed


@dataclass(frozen=True)
class StabilityBound:
    """A bound on one speed on one side of which a steady motion is stable.

    Attributes:
        stability: of the motion.
        speed: bounded.
        bound: its least value, or its largest.
        above: whether the motion is stable above the bound.
    """

    stability: Stability
    speed: Symbol
    bound: Expr
    above: bool

    @property
    def family(self) -> SteadyMotion:
        """The motion."""
        return self.stability.family

    @property
    def latex(self) -> str:
        """The condition of stability."""
        sign = ">" if self.above else "<"
        return f"{Expr.generator(self.speed).latex()} {sign} {self.bound.latex()}"


def thresholds(subject: ExerciseSubject) -> Iterator[StabilityBound]:
    """Thresholds of speeds that are judged to be equivalent to stability."""
    for found in subject.rests:
        if found.truth is not Truth.OPEN:
            continue
        for condition in found.conditions:
            yield from _of_condition(subject, found, condition)


def _of_condition(
    subject: ExerciseSubject, found: Stability, condition: Condition
) -> Iterator[StabilityBound]:
    expression = condition.expression
    for speed in open_speeds(subject, found.family):
        bound = _squared_root(expression, speed)
        if bound is None or bound.varies or not bound.symbols():
            continue
        for above in (True, False):
            one = StabilityBound(found, speed, exact_sqrt(bound), above)
            short = len(one.latex) <= LONGEST
            if short and subject.holds(one.latex, "threshold", given=given_of(found.family)):
                yield one
                return


def _squared_root(expression: Expr, speed: Symbol) -> Expr | None:
    """The square of a speed at which an expression a v² + b vanishes; None for other forms."""
    factor_of_square = expression.diff(speed).diff(speed) / 2
    rest = expression.subs({speed: ZERO})
    if not factor_of_square or expression - factor_of_square * Expr.generator(speed) ** 2 - rest:
        return None
    return -rest / factor_of_square


def threshold(occasion: Occasion) -> Iterator[ExerciseQuestion]:
    """A threshold of stability, as a formula and a number."""
    subject = occasion.subject
    found = list({one.latex: one for one in reversed(list(thresholds(subject)))}.values())
    if not found:
        yield from _least_speed(occasion)
        return
    one = occasion.layout.choice("threshold", found)
    bound = value_of(one.bound, occasion.drawn.values)
    if not bound > 0 or not _changes_there(occasion, one, bound):
        return
    letter = subject.free_letter("S", "W", "U")
    side = "above" if one.above else "below"
    others = [s for s in open_speeds(subject, one.family) if s != one.speed]
    kept = f" and any {listed(map(inline, others))}" if others else ""
    answers, shown = formula_and_number(
        occasion, letter, one.bound, one.speed, occasion.drawn.values
    )
    yield ExerciseQuestion(
        "threshold",
        (
            Passage(
                f"Steady motion is possible with {family_words(one.family)}{kept}, at any constant "
                f"{inline(one.speed)}. Small departures from it stay small if "
                f"{inline(one.speed)}, counted positive, is {side} a certain value ${letter}$. "
                f"Find ${letter}$, and its value for the numbers given."
            ),
        ),
        answers,
        (
            Passage(
                "The equations of motion are linearised about the steady motion. Departures stay "
                "small if",
                one.latex,
            ),
            Passage(f"With the numbers given {shown}."),
        ),
    )


def _least_speed(occasion: Occasion) -> Iterator[ExerciseQuestion]:
    """The speed below which no steady motion of a family is possible."""
    subject = occasion.subject
    for family in subject.families:
        for condition in family.branches[0].exists if family.branches else ():
            expression = condition.expression
            if condition.truth is not Truth.OPEN or len(expression.latex()) > LONGEST:
                continue
            if not subject.holds(f"{expression.latex()} > 0", "threshold", given=given_of(family)):
                continue
            for speed in open_speeds(subject, family):
                question = _of_existence(occasion, family, expression, speed)
                if question is not None:
                    yield question


def _of_existence(
    occasion: Occasion, family: SteadyMotion, expression: Expr, speed: Symbol
) -> ExerciseQuestion | None:
    subject = occasion.subject
    square = _squared_root(expression, speed)
    if square is None:
        return None
    bound, slope = exact_sqrt(square), expression.diff(speed)
    quantity = family.branches[0].quantity
    states = {s for s in bound.symbols() if s.kind.varies}
    if any(s.order or not subject.is_angle(s) for s in states):
        return None

    def accepts(numbers: Mapping[Symbol, float]) -> bool:
        return value_of(bound, numbers) > 0 and value_of(slope, {**numbers, speed: 1.0}) > 0

    own = occasion.own.about("existence")
    state = draw_state(subject, states, occasion.drawn, own, accepts)
    if state is None:
        return None
    letter = subject.free_letter("S", "W", "U")
    answers, shown = formula_and_number(occasion, letter, bound, speed, occasion.values(state))
    at = f" for {stated(state)}" if state else ""
    angles = f" at a constant {listed(map(inline, sorted(states, key=str)))}" if states else ""
    return ExerciseQuestion(
        "threshold",
        (
            Passage(
                f"Steady motion{angles} with a constant {inline(quantity)} is possible only if "
                f"{inline(speed)}, counted positive, is above a certain value ${letter}$. Find "
                f"${letter}$, and its value{at or ' for the numbers given'}."
            ),
        ),
        answers,
        (
            Passage(
                f"In steady motion {inline(quantity)} obeys the quadratic equation",
                f"{family.relations[0].latex()} = 0",
            ),
            Passage("Its roots are real and different if", f"{expression.latex()} > 0"),
            Passage(f"so that at equality{at and f', {at.strip()},'} {shown}."),
        ),
    )


def _changes_there(occasion: Occasion, one: StabilityBound, bound: float) -> bool:
    """Whether departures grow on one side of the bound and not on the other, numerically."""
    sides = {}
    for share in (0.95, 1.05):
        speeds = dict.fromkeys(open_speeds(occasion.subject, one.family), bound)
        speeds[one.speed] = share * bound
        grown = growth_rate(occasion.subject, one.family, occasion.drawn, speeds)
        if grown is None:
            return False
        sides[share] = grown > 0
    return sides[0.95] is one.above and sides[1.05] is not one.above
