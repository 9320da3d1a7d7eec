"""Questions about the rates of steady motions, and the speeds that they need."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from polhode.algebra import ZERO, Expr, Symbol
from polhode.analyse import SteadyMotion
from polhode.exercise._answers import FormulaAnswer, NumberAnswer
from polhode.exercise._families import eigenvalues, family_words, fixed_values, given_of
from polhode.exercise._legal import vanishes
from polhode.exercise._numbers import draw_state
from polhode.exercise._of_motion import answer_for, defined, formula_and_number
from polhode.exercise._quantities import Amount, factor, number_latex, unit_printed
from polhode.exercise._question import ExerciseQuestion, Occasion, Passage, stated
from polhode.exercise._subject import LONGEST, ExerciseSubject, value_of
from polhode.solution import inline, listed

_LEAST_PART = 0.05  # of the square under a root, so that the roots are well apart


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
        others = [g for g in given_of(family) if not g.startswith(f"{speed.published} ")]
        if value.varies or len(text) > LONGEST or not subject.holds(text, "steady", given=others):
            continue
        letter = subject.free_letter("S", "W", "U")
        numbers = occasion.drawn.values
        answers, shown = formula_and_number(occasion, letter, value, speed, numbers)
        kept = [s for s in family.reduced.state if s not in subject.setting.idle_speeds]
        yield ExerciseQuestion(
            "steady",
            (
                Passage(
                    f"In a steady motion {listed(map(inline, kept))} are constant. Find the value "
                    f"${letter}$ that {inline(speed)} then has, as a formula and as a number."
                ),
            ),
            answers,
            (
                Passage("With all accelerations zero the equations of motion require", text),
                Passage(f"With the numbers given {shown}."),
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
        state_there = {s: found[s] for s in family.reduced.state if s in found}
        # the compiled equations share nothing with the roots
        is_steady = eigenvalues(subject, family, occasion.drawn, state_there) is not None
        if not (is_steady and vanishes(relation, found)):
            return None
    return _steady_question(occasion, family, text, state, roots)


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
        answers = (defined(occasion.sheet, name, value), answer)
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
