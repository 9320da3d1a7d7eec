"""Questions about what is conserved, and about forces of supports."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import islice

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.base import PolhodeError
from polhode.exercise._answers import ChoiceAnswer, FormulaAnswer, NumberAnswer
from polhode.exercise._legal import LegalStates
from polhode.exercise._numbers import draw_state
from polhode.exercise._of_motion import LEAST_PART, equation_shown, relative_size
from polhode.exercise._question import LETTERS, Occasion, Passage, Question, stated
from polhode.exercise._slips import slips
from polhode.exercise._subject import LONGEST, Subject, letters_of, value_of
from polhode.model import Element
from polhode.solution import letter_of, unit

_OPTIONS = 4
_MOST_KEPT = 2
_SHORT = 170


# -- conserved quantities --------------------------------------------------------------------------


def conserved(occasion: Occasion) -> Iterator[Question]:
    """Which of four quantities are conserved."""
    subject = occasion.subject
    kept = [text for text in _conserved(subject) if subject.holds(_rate_vanishes(text))]
    layout = occasion.layout.about("conserved")
    changed = layout.shuffled("slips", (t for k in kept for t in slips(k)))
    slipped = _of_failing(subject, changed)
    lost = _of_failing(subject, _not_conserved(subject))
    if not kept or not lost:
        return
    right = layout.shuffled("kept", kept)[:_MOST_KEPT]
    wrong = layout.shuffled("slipped", slipped)[:1]
    others = [text for text in lost if text not in wrong]
    wrong += layout.shuffled("lost", others)[: _OPTIONS - len(right) - len(wrong)]
    mixed = occasion.own.about("conserved").shuffled("order", (*right, *wrong))
    letters = tuple(LETTERS[: len(mixed)])
    found = frozenset(k for k, v in zip(letters, mixed, strict=True) if v in right)
    which = [f"({k})" for k in sorted(found)]
    yield Question(
        "conserved",
        (Passage("Which of these quantities are constant along every motion of the system?"),),
        (ChoiceAnswer("constant:", found, letters),),
        (
            Passage(
                f"{' and '.join(which)} {'is' if len(which) == 1 else 'are'} constant: the time "
                "derivative vanishes by the equations of motion. That of the others does not."
            ),
        ),
        tuple(f"${text}$" for text in mixed),
    )


def _of_failing(subject: Subject, texts: Iterable[str]) -> list[str]:
    """The first few quantities that are judged not to be constant."""
    found = (t for t in dict.fromkeys(texts) if subject.fails(_rate_vanishes(t)))
    return list(islice(found, _OPTIONS))


def _rate_vanishes(text: str) -> str:
    return rf"\frac{{d}}{{dt}}\left({text}\right) = 0"


def _conserved(subject: Subject) -> Iterator[str]:
    for one in subject.invariants:
        if len(text := one.expression.latex()) <= _SHORT:
            yield text


def _not_conserved(subject: Subject) -> Iterator[str]:
    """Momenta, the difference of the energies, and speeds."""
    equations = subject.equations
    values = [equations.kinetic_energy - equations.potential_energy, equations.kinetic_energy]
    if subject.setting.is_single:
        values += subject.setting.spin.components
    values += [Expr.generator(s) for s in equations.speeds]
    for value in values:
        moves = any(s.kind.varies for s in value.symbols())
        if moves and len(text := value.latex()) <= _SHORT:
            yield text


# -- forces of supports ----------------------------------------------------------------------------


def reaction(occasion: Occasion) -> Iterator[Question]:
    """One component of the force of a support, as a formula and at an instant."""
    subject = occasion.subject
    if not subject.setting.is_single or subject.equations.undetermined:
        return
    found = list(_components(subject))
    if not found:
        return
    long = [one for one in found if len(list(one[2].numerator.terms())) > 1]
    element, label, value = occasion.layout.choice("component", long or found)
    excluded: tuple[str, ...] = ()
    if not long and (solved := _without_accelerations(subject, value)) is not None:
        value = solved
        excluded = tuple(Expr.generator(s).latex() for s in subject.equations.acceleration_symbols)
    letter = subject.setting.force_letter(element)
    asked = rf"{letter}\cdot{unit(label)}"
    one = len(subject.setting.forced) == 1
    about = "the force of the support" if one else f"the force of “{element.name}”"
    words = (
        f"Let ${letter}$ be {about} on the {subject.setting.body.name}. Find its component along "
        f"${letter_of(label)}${', without accelerations' if excluded else ''}."
        f"{'' if excluded else ' The answer may contain accelerations.'}"
    )
    how = " and the equations of motion" if excluded else ", along the direction asked for"
    worked = Passage(
        f"From Newton's law for the centre of mass{how},", f"{asked} = {value.latex()}"
    )
    formula = FormulaAnswer(asked, value.latex(), letters_of([value]), excluded=excluded)
    question = Question("reaction", (Passage(words),), (formula,), (worked,))
    yield _with_number(question, value, asked, occasion) or question


def _without_accelerations(subject: Subject, value: Expr) -> Expr | None:
    """A force by coordinates and speeds alone, if that is short."""
    try:
        solved = subject.equations.on_shell(value)
    except PolhodeError:
        return None
    return solved if len(solved.latex()) <= LONGEST and solved else None


def _components(subject: Subject) -> Iterator[tuple[Element, str, Expr]]:
    setting = subject.setting
    for element in setting.forced:
        force = subject.equations.reactions[element.name].force
        frame, _ = setting.shortest(force)
        for label, value in zip(frame.labels, force.express(frame).components, strict=True):
            letter = setting.force_letter(element)
            short = value and len(value.latex()) <= LONGEST
            if not short or not any(s.kind.varies for s in value.symbols()):
                continue
            if subject.holds(rf"{letter}\cdot{unit(label)} = {value.latex()}"):
                yield element, label, value


def _with_number(
    question: Question, value: Expr, asked: str, occasion: Occasion
) -> Question | None:
    subject = occasion.subject
    try:
        on_motion = subject.equations.on_shell(value)
    except PolhodeError:
        return None
    symbols = {s for s in on_motion.symbols() if s.kind.varies}
    if not symbols or any(s.kind is SymbolKind.FUNCTION for s in symbols):
        return None
    legal = LegalStates.of(subject)
    symbols |= legal.symbols

    def accepts(numbers: Mapping[Symbol, float]) -> bool:
        return legal.accepts(numbers) and relative_size(on_motion, numbers) > LEAST_PART

    own = occasion.own.about("reaction")
    state = draw_state(subject, symbols, occasion.drawn, own, accepts)
    if not state:
        return None
    values = {s: a.si for s, a in state.items()} | dict(occasion.drawn.values)
    result = value_of(on_motion, values)
    where = stated(state)
    accelerated = any(s in value.symbols() for s in subject.equations.acceleration_symbols)
    how = " and the accelerations from the equations of motion" if accelerated else ""
    return Question(
        question.kind,
        (*question.statement, Passage(f"How large is it while {where}?")),
        (*question.answers, NumberAnswer(f"${asked} =$", (result,), "N")),
        (
            *question.worked,
            Passage(f"With {where}{how} it is {equation_shown(asked, result, 'N')}."),
        ),
    )
