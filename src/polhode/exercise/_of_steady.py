"""Questions about steady motions: their rates, thresholds of stability, small oscillations."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import inf, pi

import numpy as np

from polhode.algebra import ONE, ZERO, Expr, Symbol
from polhode.algebra import sqrt as exact_sqrt
from polhode.analyse import Condition, Stability, SteadyMotion, Truth
from polhode.base import PolhodeError
from polhode.exercise._answers import FormulaAnswer, NumberAnswer
from polhode.exercise._legal import vanishes
from polhode.exercise._numbers import DrawnNumbers, draw_state
from polhode.exercise._of_motion import answer_for, equation_shown
from polhode.exercise._quantities import Amount, factor, number_latex, plain_amount, unit_printed
from polhode.exercise._question import ExerciseQuestion, Occasion, Passage, stated
from polhode.exercise._subject import LONGEST, ExerciseSubject, letters_of, value_of
from polhode.solution import inline, listed, root_latex

_MAGNITUDE = re.compile(r"\\left\|([^|]*)\\right\|")
_ROUNDING = 1e-3  # of the largest exponent: zeros that coincide are found to half the digits
_LEAST_PART = 0.05  # of the square under a root, so that the roots are well apart


# -- words and numbers of a family -----------------------------------------------------------------


def fixed_values(family: SteadyMotion) -> dict[Symbol, Expr]:
    """What a family fixes, angles first, without the rates of its coordinates, which vanish."""
    own = family.reduced.essential
    kept = {s: v for s, v in family.fixed.items() if not (s.order and s.base() in own)}
    return dict(sorted(kept.items(), key=lambda pair: (pair[0] not in own, pair[0].published)))


def given_of(family: SteadyMotion) -> tuple[str, ...]:
    """The same as restrictions of a claim."""
    return tuple(f"{s.published} = {value}" for s, value in fixed_values(family).items())


def family_words(family: SteadyMotion) -> str:
    """The same in words with formulas; empty where nothing is fixed."""
    values = fixed_values(family).items()
    return listed(f"${inline(s)[1:-1]} = {v.latex()}$" for s, v in values) if values else ""


def open_speeds(subject: ExerciseSubject, family: SteadyMotion) -> tuple[Symbol, ...]:
    """Speeds that a family leaves open and that matter."""
    idle = subject.setting.idle_speeds
    return tuple(s for s in family.reduced.speeds if s not in {*family.fixed, *idle})


def defined(letter: str, value: Expr) -> FormulaAnswer:
    """The answer that a letter, which the question introduces, has a value."""
    text = value.latex()
    return FormulaAnswer(letter, text, letters_of([value]), f"Let ${letter} = {text}$.")


# -- the rate of a steady motion -------------------------------------------------------------------


def steady_rate(occasion: Occasion) -> Iterator[ExerciseQuestion]:
    """The rates of a steady motion at given numbers, all roots; or the speed that it needs."""
    subject = occasion.subject
    for family in subject.families:
        if len(family.relations) != 1 or not family.branches:
            continue
        (relation,) = family.relations
        text = f"{relation.latex()} = 0"
        if len(text) > LONGEST or not subject.holds(text, "steady", given=given_of(family)):
            continue
        question = _rates(occasion, family, relation, text)
        if question is not None:
            yield question
    yield from _needed_speeds(occasion)


def _needed_speeds(occasion: Occasion) -> Iterator[ExerciseQuestion]:
    """The speed that a steady motion without any freedom needs, such as a drift."""
    subject = occasion.subject
    for family in subject.families:
        found = [(s, v) for s, v in fixed_values(family).items() if v.symbols()]
        if family.relations or len(found) != 1:
            continue
        ((speed, value),) = found
        text = f"{Expr.generator(speed).latex()} = {value.latex()}"
        varies = value.varies
        others = [g for g in given_of(family) if not g.startswith(f"{speed.published} ")]
        if varies or len(text) > LONGEST or not subject.holds(text, "steady", given=others):
            continue
        letter = subject.free_letter("S", "W", "U")
        answer, _ = answer_for(subject, speed, value_of(value, occasion.drawn.values))
        kept = [s for s in family.reduced.state if s not in subject.setting.idle_speeds]
        yield ExerciseQuestion(
            "steady",
            (
                Passage(
                    f"In a steady motion {listed(map(inline, kept))} are constant. Find the value "
                    f"${letter}$ that {inline(speed)} then has, as a formula and as a number."
                ),
            ),
            (defined(letter, value), replace(answer, prompt=f"${letter} =$")),
            (
                Passage("With all accelerations zero the equations of motion require", text),
                Passage(
                    "With the numbers given "
                    f"{equation_shown(letter, answer.values[0], answer.unit)}."
                ),
            ),
        )


def _rates(
    occasion: Occasion, family: SteadyMotion, relation: Expr, text: str
) -> ExerciseQuestion | None:
    subject = occasion.subject
    quantity = family.branches[0].quantity
    if quantity.symbol is None:
        return None
    others = {s for s in relation.symbols() if s.kind.varies} - {quantity.symbol}
    values = [b.value for b in family.branches]

    def accepts(numbers: Mapping[Symbol, float]) -> bool:
        roots = [value_of(v, numbers) for v in values]
        sizes = sorted(map(abs, roots))
        distinct = len(roots) < 2 or abs(roots[0] - roots[1]) > _LEAST_PART * sizes[-1]
        return all(r == r for r in roots) and sizes[0] > 1e-9 and distinct

    state = draw_state(subject, others, occasion.drawn, occasion.own.about("steady"), accepts)
    if state is None:
        return None
    numbers = occasion.values(state)
    roots = sorted({value_of(v, numbers) for v in values}, key=abs)
    for root in roots:
        found = {**numbers, quantity.symbol: root}
        if not vanishes(relation, found) or not _is_steady(occasion, family, found):
            return None
    return _steady_question(occasion, family, text, state, roots)


def _is_steady(occasion: Occasion, family: SteadyMotion, numbers: Mapping[Symbol, float]) -> bool:
    """Whether the compiled equations, which share nothing with the roots, find it steady."""
    state = {s: numbers[s] for s in family.reduced.state if s in numbers}
    return eigenvalues(occasion.subject, family, occasion.drawn, state) is not None


def _steady_question(
    occasion: Occasion,
    family: SteadyMotion,
    text: str,
    state: Mapping[Symbol, Amount],
    roots: list[float],
) -> ExerciseQuestion:
    subject = occasion.subject
    quantity = family.branches[0].quantity
    symbol = quantity.symbol
    assert symbol is not None  # no other family comes here
    kept = [
        s for s in family.reduced.state if s not in {*family.fixed, *subject.setting.idle_speeds}
    ]
    where = family_words(family)
    words = f"In a steady motion {listed(map(inline, kept))} are constant"
    words += f", with {where}. " if where else ". "
    several = len(roots) > 1
    asked = f"Find {'all possible values' if several else 'the value'} of {inline(quantity)}"
    number, _ = answer_for(subject, symbol, 1.0)
    size = factor(number.unit)
    answer = NumberAnswer(number.prompt, tuple(r / size for r in roots), number.unit)
    formulas = [Passage("In steady motion the equations of motion require", text)]
    found = " and ".join(f"${number_latex(r / size)}$ {unit_printed(number.unit)}" for r in roots)
    formulas.append(
        Passage(
            f"With {stated(state)} this is {'a quadratic equation' if several else 'an equation'} "
            f"for {inline(quantity)}, whose {'roots are' if several else 'root is'} {found}."
        )
    )
    questions = [Passage(f"{words}{asked} for {stated(state)}.")]
    answers: tuple[FormulaAnswer | NumberAnswer, ...] = (answer,)
    if (linear := _linear_speed(subject, family)) is not None:
        speed, value = linear
        name = subject.free_letter("S", "W")
        rest = sorted(value.symbols() & set(kept), key=lambda s: s.published)
        questions.insert(
            0,
            Passage(
                f"{words}Let ${name}$ be the value of {inline(speed)} that this requires for "
                f"given {listed(map(inline, rest))}. Express ${name}$ in terms of these."
            ),
        )
        questions[1] = Passage(f"{asked} for {stated(state)}.")
        answers = (defined(name, value), answer)
        definition = f"{name} = {value.latex()}"
        formulas.insert(1, Passage(f"so that {inline(speed)} has the value", definition))
    return ExerciseQuestion("steady", tuple(questions), answers, tuple(formulas))


def _linear_speed(subject: ExerciseSubject, family: SteadyMotion) -> tuple[Symbol, Expr] | None:
    """A speed other than the rate in which the relation is linear, and its value."""
    (relation,) = family.relations
    taken = family.branches[0].quantity.symbol
    for speed in family.reduced.speeds:
        slope = relation.diff(speed)
        if speed == taken or not slope or speed in slope.symbols():
            continue
        value = -relation.subs({speed: ZERO}) / slope
        text = f"{Expr.generator(speed).latex()} = {value.latex()}"
        if len(text) <= LONGEST and subject.holds(text, "steady", given=given_of(family)):
            return speed, value
    return None


# -- thresholds ------------------------------------------------------------------------------------


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
    answer, _ = answer_for(subject, one.speed, bound)
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
        (defined(letter, one.bound), replace(answer, prompt=f"${letter} =$")),
        (
            Passage(
                "The equations of motion are linearised about the steady motion. Departures stay "
                "small if",
                one.latex,
            ),
            Passage(
                f"With the numbers given {equation_shown(letter, answer.values[0], answer.unit)}."
            ),
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
    value = value_of(bound, occasion.values(state))
    letter = subject.free_letter("S", "W", "U")
    answer, _ = answer_for(subject, speed, value)
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
        (defined(letter, bound), replace(answer, prompt=f"${letter} =$")),
        (
            Passage(
                f"In steady motion {inline(quantity)} obeys the quadratic equation",
                f"{family.relations[0].latex()} = 0",
            ),
            Passage("Its roots are real and different if", f"{expression.latex()} > 0"),
            Passage(
                f"so that at equality{at and f', {at.strip()},'} "
                f"{equation_shown(letter, answer.values[0], answer.unit)}."
            ),
        ),
    )


def numeric_state(
    subject: ExerciseSubject,
    family: SteadyMotion,
    drawn: DrawnNumbers,
    speeds: Mapping[Symbol, float],
) -> dict[str, float]:
    """A state on a family, by name, SI."""
    known = {**drawn.values, **speeds}
    fixed = {s.published: value_of(v, known) for s, v in fixed_values(family).items()}
    others = {
        q.published: _elsewhere(subject, q)
        for q in subject.equations.coordinates
        if q not in family.reduced.essential
    }
    return others | fixed | {s.published: v for s, v in speeds.items()}


def _elsewhere(subject: ExerciseSubject, coordinate: Symbol) -> float:
    """A regular value of a coordinate that nothing depends on."""
    typical = plain_amount(subject.start.get(coordinate.published, ""))
    if typical is not None and typical.number:
        return typical.si
    return 1.0 if subject.is_angle(coordinate) else 0.0


def growth_rate(
    subject: ExerciseSubject,
    family: SteadyMotion,
    drawn: DrawnNumbers,
    speeds: Mapping[Symbol, float],
) -> float | None:
    """The largest real part of the exponents of small departures, by linearising at numbers."""
    found = eigenvalues(subject, family, drawn, speeds)
    if found is None:
        return None
    largest = max(map(abs, found), default=0.0)
    growth = max((v.real for v in found), default=0.0)
    return growth if growth > _ROUNDING * largest else 0.0


def eigenvalues(
    subject: ExerciseSubject,
    family: SteadyMotion,
    drawn: DrawnNumbers,
    speeds: Mapping[Symbol, float],
) -> tuple[complex, ...] | None:
    """Exponents of small departures at numbers; None where the motion is not steady.

    They are the eigenvalues of the slopes of the accelerations, and share neither the
    characteristic polynomial nor the conditions of the exact analysis.
    """
    idle = dict.fromkeys(subject.setting.idle_speeds, 0.0)
    known = {**idle, **drawn.values, **speeds}
    try:
        fixed = {s: value_of(v, known) for s, v in family.fixed.items()}
        values = {**known, **fixed}
        rates = np.array([value_of(rate, values) for rate in subject.rates])
        slopes = np.array([[value_of(e, values) for e in row] for row in subject.slopes])
    except (PolhodeError, ZeroDivisionError):
        return None
    moving = np.array([abs(values[s]) for s in family.reduced.state])
    scale = 1.0 + float(np.max(np.abs(slopes) @ moving, initial=0.0))
    if not (np.isfinite(slopes).all() and np.all(np.abs(rates) <= 1e-8 * scale)):
        return None
    return tuple(map(complex, np.linalg.eigvals(slopes)))


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


# -- small oscillations ----------------------------------------------------------------------------


def small_oscillations(occasion: Occasion) -> Iterator[ExerciseQuestion]:
    """The angular frequency of small oscillations and their period."""
    subject = occasion.subject
    single = [s for s in subject.rests if _has_frequencies(s)]
    most = max((len(open_speeds(subject, s.family)) for s in single), default=0)
    offered = [s for s in single if len(open_speeds(subject, s.family)) == most]
    for found in occasion.layout.shuffled("frequency", offered):
        question = _frequency(occasion, found)
        if question is not None:
            yield question


def _has_frequencies(found: Stability) -> bool:
    """Whether there are one or two, at definite values of the angles."""
    if found.truth is Truth.NEVER or len(found.frequencies) not in (1, 2):
        return False
    fixed = fixed_values(found.family).values()
    is_fixed = not any(v.varies for v in fixed)
    return is_fixed and all(v.symbol is None and v.symbols() for v in found.frequencies)


def _frequency(occasion: Occasion, found: Stability) -> ExerciseQuestion | None:
    subject, drawn, family = occasion.subject, occasion.drawn, found.family
    values = found.frequencies
    inside = {s for v in values for s in v.symbols() if s.kind.varies}

    def accepts(numbers: Mapping[Symbol, float]) -> bool:
        held = all(value_of(c.expression, numbers) > 0 for c in found.conditions)
        return held and all(value_of(v, numbers) > 0 for v in values)

    own = occasion.own.about("frequency")
    wanted = {*open_speeds(subject, family), *inside}
    state = draw_state(subject, wanted, drawn, own, accepts)
    if state is None or not family_words(family):
        return None
    numbers = occasion.values(state)
    rates = [value_of(v, numbers) for v in values]
    exact = eigenvalues(subject, family, drawn, {s: a.si for s, a in state.items()})
    if exact is None or not all(_occurs(rate, exact) for rate in rates):
        return None
    used = [s for s in state if s in inside]
    at = f" at a constant {listed(map(inline, used))}" if used else ""
    where = f" for {stated({s: state[s] for s in used})}" if used else " for the numbers given"
    motion = f"{kind_of(family)} with {family_words(family)}{at}"
    periods = tuple(2 * pi / rate for rate in rates)
    shown = " and ".join(f"${number_latex(p)}$ s" for p in periods)
    if len(values) > 1:
        return ExerciseQuestion(
            "frequency",
            (Passage(f"Find the periods of the two small oscillations about {motion},{where}."),),
            (NumberAnswer("periods:", periods, "s"),),
            (
                Passage(
                    "The linear equations of small departures have two angular frequencies,",
                    rf"\omega^2 = {listed_latex([v * v for v in values])}",
                )
                if all(len((v * v).latex()) <= LONGEST for v in values)
                else Passage("The linear equations of small departures have two frequencies."),
                Passage(f"The periods are {shown}{where}."),
            ),
        )
    (value,) = values
    text = root_latex(value * value)
    if len(text) > LONGEST:
        return None
    letter = subject.free_letter("S", "W", "U")
    plain, taken = without_magnitudes(text)
    definition = f"{letter} = {plain}"
    also = f"Let ${letter} = {text}$." if taken else ""
    signs = f" Take {listed(f'${x}$' for x in taken)} as positive." if taken else ""
    return ExerciseQuestion(
        "frequency",
        (
            Passage(
                f"Find exactly, as a formula, the angular frequency ${letter}$ of small "
                f"oscillations about {motion}, and their period{where}.{signs}"
            ),
        ),
        (
            FormulaAnswer(letter, plain, letters_of([value]), f"Let ${definition}$.", also=also),
            NumberAnswer("period:", periods, "s"),
        ),
        (
            Passage("The linear equations of small departures give", definition),
            Passage(f"so that the period $2\\pi/{letter}$ is {shown}{where}."),
        ),
    )


def without_magnitudes(text: str) -> tuple[str, tuple[str, ...]]:
    """A formula with |x| written as x, and what has to be positive for that."""
    taken = tuple(dict.fromkeys(_MAGNITUDE.findall(text)))
    return _MAGNITUDE.sub(lambda found: found[1], text), taken


def _occurs(rate: float, exponents: tuple[complex, ...]) -> bool:
    return min((abs(v - 1j * rate) for v in exponents), default=inf) <= 1e-5 * rate


def listed_latex(values: list[Expr]) -> str:
    """Two formulas with words between them."""
    return r" \quad\text{and}\quad ".join(v.latex() for v in values)


def kind_of(family: SteadyMotion) -> str:
    """Whether anything moves in a steady motion, in words."""
    speeds = family.reduced.speeds
    moves = any(family.fixed.get(s, ONE) for s in speeds)
    return "the steady motion" if moves else "the equilibrium"
