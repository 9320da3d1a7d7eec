"""Questions about what is conserved, and about forces of supports."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import islice

from polhode.algebra import Expr, Symbol, Vector
from polhode.base import PolhodeError
from polhode.exercise._answers import ChoiceAnswer, NumberAnswer
from polhode.exercise._legal import legal_state
from polhode.exercise._of_motion import equation_shown
from polhode.exercise._question import LETTERS, ExerciseQuestion, Occasion, Passage, stated
from polhode.exercise._slips import slips
from polhode.exercise._subject import LONGEST, ExerciseSubject, value_of
from polhode.model import Body, Element
from polhode.solution import letter_of, unit

_OPTIONS = 4
_NEWTON = "Newton's law for the centre of mass"
_MOST_KEPT = 2
_LONGEST_FORCE = 240
_SHORT = 170
_FEW = 3  # letters of a force such as mg, which is not asked for


# -- conserved quantities --------------------------------------------------------------------------


def conserved(occasion: Occasion) -> Iterator[ExerciseQuestion]:
    """Which of four quantities are conserved."""
    subject = occasion.subject
    kept = [text for text in _conserved(subject) if subject.holds(_rate_vanishes(text))]
    layout = occasion.layout.about("conserved")
    changed = layout.shuffled("slips", (s.text for k in kept for s in slips(k)))
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
    yield ExerciseQuestion(
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


def _of_failing(subject: ExerciseSubject, texts: Iterable[str]) -> list[str]:
    """The first few quantities that are judged not to be constant."""
    found = (t for t in dict.fromkeys(texts) if subject.fails(_rate_vanishes(t)))
    return list(islice(found, _OPTIONS))


def _rate_vanishes(text: str) -> str:
    return rf"\frac{{d}}{{dt}}\left({text}\right) = 0"


def _conserved(subject: ExerciseSubject) -> Iterator[str]:
    for one in subject.invariants:
        if len(text := one.expression.latex()) <= _SHORT:
            yield text


def _not_conserved(subject: ExerciseSubject) -> Iterator[str]:
    """Momenta, the difference of the energies, and speeds."""
    equations = subject.equations
    values = [equations.kinetic_energy - equations.potential_energy, equations.kinetic_energy]
    if subject.setting.is_single:
        values += subject.setting.spin.components
    values += [Expr.generator(s) for s in equations.speeds]
    for value in values:
        moves = value.varies
        if moves and len(text := value.latex()) <= _SHORT:
            yield text


# -- forces of supports ----------------------------------------------------------------------------


@dataclass(frozen=True)
class _Sought:
    """A component of the force or the couple of a support.

    Attributes:
        asked: LaTeX of the quantity.
        words: that ask for it.
        law: from which it follows.
        value: along every motion.
        unit: of the value.
        body: that it acts on.
        excluded: letters that it is to be given without.
    """

    asked: str
    words: str
    law: str
    value: Expr
    unit: str
    body: Body
    excluded: tuple[str, ...] = ()

    @property
    def is_long(self) -> bool:
        """Whether it has several terms."""
        return len(list(self.value.numerator.terms())) > 1


def reaction(occasion: Occasion) -> Iterator[ExerciseQuestion]:
    """One component of the force or couple of a support, as a formula and at an instant."""
    subject = occasion.subject
    open_ones = {*subject.equations.undetermined}
    found = [
        one
        for one in (*_forces(subject), *_tensions(subject), *_couples(subject))
        if open_ones.isdisjoint(s.published for s in one.value.symbols())
    ]
    if not found:
        return
    moving = [one for one in found if one.value.varies] or found
    long = [one for one in moving if one.is_long]
    sought = occasion.layout.choice("component", long or moving)
    if not long:
        sought = _without_accelerations(subject, sought)
    asked, value = sought.asked, sought.value
    free = "The answer may contain accelerations" if value.varies else ""
    if sought.excluded:
        free = f"without accelerations of the {sought.body.name}"
    words = f"{sought.words}{', ' if sought.excluded else '. '}{free}".strip(". ") + "."
    how = f"{sought.law} and the equations of motion" if sought.excluded else sought.law
    worked = Passage(f"From {how},", f"{asked} = {value.latex()}")
    formula = occasion.sheet.formula(asked, value.latex(), [value], excluded=sought.excluded)
    question = ExerciseQuestion("reaction", (Passage(words),), (formula,), (worked,))
    yield _with_number(question, sought, occasion) or question


def _without_accelerations(subject: ExerciseSubject, sought: _Sought) -> _Sought:
    """The same by coordinates and speeds alone, if that is short."""
    try:
        solved = subject.equations.on_shell(sought.value)
    except PolhodeError:
        return sought
    if not solved or len(solved.latex()) > LONGEST:
        return sought
    accelerations = subject.equations.acceleration_symbols
    excluded = tuple(Expr.generator(s).latex() for s in accelerations)
    return replace(sought, value=solved, excluded=excluded)


def _is_asked(subject: ExerciseSubject, asked: str, value: Expr) -> bool:
    """Whether a component is worth finding, short, judged to be right, and not always zero."""
    text = value.latex()
    is_plain = not value.varies and len(value.symbols()) < _FEW and "+" not in text
    if not value or is_plain or len(text) > _LONGEST_FORCE:
        return False
    return not _vanishes(subject, value) and subject.holds(f"{asked} = {text}")


def _vanishes(subject: ExerciseSubject, value: Expr) -> bool:
    """Whether a force such as m dv/dt is zero by the equations of motion."""
    if value.symbols().isdisjoint(subject.equations.acceleration_symbols):
        return False
    try:
        return not subject.equations.on_shell(value)
    except PolhodeError:
        return False


def _forces(subject: ExerciseSubject) -> Iterator[_Sought]:
    whole = subject.setting
    many = len(whole.forced) != 1
    for element in whole.forced:
        letter = whole.force_letter(element)
        setting = next(one for one in whole.each if one.body == element.bodies[0])
        about = f"the force of “{element.name}”" if many else "the force of the support"
        start = f"Let ${letter}$ be {about} on the {setting.body.name}. Find its component along"
        force = subject.equations.reactions[element.name].force.subs(whole.constant)
        frame, _ = setting.shortest(force)
        is_found = False
        for label, value in zip(frame.labels, force.express(frame).components, strict=True):
            asked = rf"{letter}\cdot{unit(label)}"
            if _is_asked(subject, asked, value):
                is_found = True
                words = f"{start} ${letter_of(label)}$"
                yield _Sought(asked, words, _NEWTON, value, "N", setting.body)
        if not is_found:
            yield from _declared(subject, element, about, setting.body)


def _declared(
    subject: ExerciseSubject, element: Element, about: str, body: Body
) -> Iterator[_Sought]:
    """Components as they are declared, where several frames have axes of the same letters."""
    for restraint in subject.equations.kinetics.restraints[element.name]:
        value = subject.equations.components.get(restraint.name)
        along = _axis_in_words(restraint.direction, body)
        if restraint.is_couple or value is None or not along:
            continue
        asked = Expr.generator(Symbol(restraint.name)).latex()
        if _is_asked(subject, asked, value):
            words = f"Let ${asked}$ be the component of {about} on the {body.name} along {along}"
            yield _Sought(asked, f"{words}. Find it", _NEWTON, value, "N", body)


def _axis_in_words(direction: Vector, body: Body) -> str:
    """The axis that a direction is along, of the body's frames; empty for another direction."""
    for frame in (body.axes.root, *body.axes.lineage):
        for label in frame.labels:
            if (frame[label] - direction).is_zero:
                return f"axis ${letter_of(label)}$ of the {frame.name}"
    return ""


def _tensions(subject: ExerciseSubject) -> Iterator[_Sought]:
    for name, rope in subject.tensions.items():
        asked, value = Expr.generator(Symbol(name)).latex(), subject.equations.components[name]
        if _is_asked(subject, asked, value):
            words = f"Let ${asked}$ be the tension of the rope “{rope.name}”. Find it"
            law = "Newton's law"
            yield _Sought(asked, words, law, value, "N", rope.bodies[0])


def _couples(subject: ExerciseSubject) -> Iterator[_Sought]:
    for element in subject.setting.twisting:
        body = element.bodies[0]
        for restraint in subject.equations.kinetics.restraints[element.name]:
            value = subject.equations.components.get(restraint.name)
            turned = (k for k in body.axes.labels if (body.axes[k] - restraint.direction).is_zero)
            axis = next(turned, "")
            if not restraint.is_couple or value is None or not axis:
                continue
            asked = Expr.generator(Symbol(restraint.name)).latex()
            if _is_asked(subject, asked, value):
                words = (
                    f"Find the couple ${asked}$ that “{element.name}” exerts on the "
                    f"{body.name} about ${letter_of(axis)}$"
                )
                law = "the rate of the angular momentum"
                yield _Sought(asked, words, law, value, "N m", body)


def _with_number(
    question: ExerciseQuestion, sought: _Sought, occasion: Occasion
) -> ExerciseQuestion | None:
    equations, asked = occasion.subject.equations, sought.asked
    try:
        value = equations.on_shell(sought.value)
    except PolhodeError:
        return None
    state = legal_state(occasion, "reaction", value) if value.varies else {}
    if not state and value.varies:
        return None
    result = value_of(value, occasion.values(state))
    where = f"when {stated(state)}" if state else "for the numbers given"
    with_which = f"With {stated(state)}" if state else "With the numbers given"
    accelerated = any(s in sought.value.symbols() for s in equations.acceleration_symbols)
    how = " and the accelerations from the equations of motion" if accelerated else ""
    return ExerciseQuestion(
        question.kind,
        (*question.statement, Passage(f"How large is it {where}?")),
        (*question.answers, NumberAnswer(f"${asked} =$", (result,), sought.unit)),
        (
            *question.worked,
            Passage(f"{with_which}{how} it is {equation_shown(asked, result, sought.unit)}."),
        ),
    )
