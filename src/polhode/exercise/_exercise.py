"""An exercise: statement, figure, numbers, questions with their answers, worked solution."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from types import MappingProxyType

from polhode.algebra import Expr, Symbol, Vector
from polhode.base import DeclarationError, NumericError, PolhodeError, Shown, look_up
from polhode.catalogue import CATALOGUE, CatalogueEntry
from polhode.derive import Equations, derive
from polhode.exercise._answers import (
    ExpectedAnswer,
    FormulaAnswer,
    MarkedPart,
    marked_part,
)
from polhode.exercise._draws import Draws
from polhode.exercise._numbers import DrawnNumbers, draw
from polhode.exercise._of_errors import wrong_equation
from polhode.exercise._of_forces import conserved, reaction
from polhode.exercise._of_motion import degrees_of_freedom, equation_of_motion, velocities
from polhode.exercise._of_oscillations import small_oscillations
from polhode.exercise._of_runs import outcome
from polhode.exercise._of_steady import steady_rate
from polhode.exercise._of_thresholds import threshold
from polhode.exercise._question import LETTERS, ExerciseQuestion, Maker, Occasion, Passage, equality
from polhode.exercise._subject import ExerciseSubject, in_words
from polhode.model import BodyPoint, Element, Frame, Pivot, System
from polhode.solution import (
    Figure,
    Setting,
    Solution,
    assumptions,
    axes_of_bodies,
    choice_of_axes,
    figure_of,
    inline,
    letter_of,
    listed,
)

_NONE: Mapping[str, str] = MappingProxyType({})
#: How many questions an exercise has unless it is said.
USUAL = 5


@dataclass(frozen=True)
class Kind:
    """A kind of question.

    Attributes:
        meaning: in words.
        questions: those that a system offers.
    """

    meaning: str
    questions: Maker


KINDS: dict[str, Kind] = {
    "freedom": Kind("degrees of freedom and conditions of the supports", degrees_of_freedom),
    "velocities": Kind("angular velocity, velocity and angular momentum along axes", velocities),
    "motion": Kind(
        "the missing term of an equation of motion, an acceleration", equation_of_motion
    ),
    "conserved": Kind("which of four quantities are conserved", conserved),
    "reaction": Kind("the force of a support along an axis", reaction),
    "steady": Kind("the rates of a steady motion, all roots", steady_rate),
    "threshold": Kind("a threshold of stability", threshold),
    "frequency": Kind("frequency and period of small oscillations", small_oscillations),
    "wrong": Kind("which of several equations is wrong", wrong_equation),
    "outcome": Kind("what becomes of a motion that begins close to a steady one", outcome),
}


@dataclass(frozen=True)
class Exercise(Shown):
    """An exercise with its answers.

    Attributes:
        system: by which the command line finds it.
        title: heading.
        seed: that the numbers were drawn with.
        student: number of the student, from 1.
        statement: what is given.
        numbers: the numbers, in words with `$…$`.
        questions: in order.
        figure: the system with its axes, angles and forces.
        texts: the numbers as text, by published name.
        subject: the system with what was found about it.
    """

    system: str
    title: str
    seed: int
    student: int
    statement: tuple[Passage, ...]
    numbers: str
    questions: tuple[ExerciseQuestion, ...]
    figure: Figure = field(repr=False)
    texts: Mapping[str, str]
    subject: ExerciseSubject = field(kw_only=True, repr=False, compare=False)

    @property
    def worked(self) -> Solution | PolhodeError:
        """The worked solution of the system, or why it has none."""
        return self.subject.worked

    @property
    def answers(self) -> dict[str, ExpectedAnswer]:
        """The answers by their ids: 1a, 1b, 2, ..."""
        found = {}
        for i, question in enumerate(self.questions, 1):
            several = len(question.answers) > 1
            for letter, answer in zip(LETTERS, question.answers, strict=False):
                found[f"{i}{letter if several else ''}"] = answer
        return found

    def __str__(self) -> str:
        kinds = listed(question.kind for question in self.questions)
        return f"Exercise on {self.system}, seed {self.seed}: {kinds}"


def exercise(
    system: System | CatalogueEntry,
    seed: int,
    *,
    kinds: Iterable[str] = (),
    questions: int = USUAL,
    student: int = 1,
    values: Mapping[str, str] = _NONE,
) -> Exercise:
    """Draw an exercise on a system.

    Numbers are drawn near the typical values of the catalogue, or of what has their dimension.
    Every answer is judged on the model while the exercise is built. The same seed gives the same
    exercise on every machine.

    Args:
        system: a declaration, or an entry of the catalogue.
        seed: a whole number.
        kinds: of questions; all that the system offers by default.
        questions: how many, unless kinds are given.
        student: other numbers for the same questions.
        values: parameters that are not drawn, as text with a unit, by name.

    Raises:
        DeclarationError: for a kind that is unknown, or that the system does not offer.
        NumericError: for a system too large for a document, or without a question.
    """
    return Builder.of(system).exercise(seed, student, tuple(kinds), questions, values)


@dataclass(frozen=True, eq=False)
class Builder:
    """Makes exercises on one system, which is analysed once.

    Attributes:
        subject: the system.
    """

    subject: ExerciseSubject

    @classmethod
    def of(cls, system: System | CatalogueEntry) -> Builder:
        """From a declaration or an entry of the catalogue.

        Raises:
            NumericError: for equations too long to be written out, or a system that cannot move.
        """
        entry = system if isinstance(system, CatalogueEntry) else _entry(system)
        equations = derive(entry.build())
        _refuse_unfit(equations)
        title = entry.title[:1].upper() + in_words(entry.title)[1:]
        defaults = {name: text for name, text in entry.defaults.items() if text}
        return cls(ExerciseSubject(equations, title, defaults, entry.start, entry.name))

    def offered(self, seed: int = 1) -> dict[str, ExerciseQuestion]:
        """A question of every kind that the system offers."""
        occasion = self._occasion(seed, 1, _NONE)
        return {name: q for name in KINDS if (q := self._question(name, occasion)) is not None}

    def exercise(
        self,
        seed: int,
        student: int = 1,
        kinds: Sequence[str] = (),
        most: int = USUAL,
        values: Mapping[str, str] = _NONE,
    ) -> Exercise:
        """One exercise; see `exercise`."""
        occasion = self._occasion(seed, student, values)
        asked = self._asked(occasion, kinds, most)
        if not asked:
            raise NumericError(
                f"an exercise on {self.subject.name!r}",
                expected="a system about which a question can be asked and judged",
                advice="derive prints its equations",
            )
        return Exercise(
            self.subject.name,
            self.subject.title,
            seed,
            student,
            tuple(_statement(self.subject)),
            _numbers_in_words(occasion.drawn),
            asked,
            figure_of(self.subject.setting),
            occasion.drawn.texts,
            subject=self.subject,
        )

    def _occasion(self, seed: int, student: int, values: Mapping[str, str]) -> Occasion:
        names = {s.published: s for s in self.subject.equations.parameters}
        known = {**names, **self.subject.typical}
        for name in values:
            look_up(name, known, f"parameter of {self.subject.name}")
        layout = Draws(f"exercise {seed} {self.subject.equations.system.name}")
        own = layout.about(f"student {student}")
        return Occasion(self.subject, layout, own, draw(self.subject, own.about("values"), values))

    def _question(self, kind: str, occasion: Occasion) -> ExerciseQuestion | None:
        """The first question of a kind whose own answers are marked as right."""
        return next(filter(self._is_sound, KINDS[kind].questions(occasion)), None)

    def _is_sound(self, question: ExerciseQuestion) -> bool:
        """Whether every formula that a question expects is marked as right when it is given."""
        return all(
            self.subject.accepts(answer)
            for answer in question.answers
            if isinstance(answer, FormulaAnswer)
        )

    def _asked(
        self, occasion: Occasion, kinds: Sequence[str], most: int
    ) -> tuple[ExerciseQuestion, ...]:
        for name in kinds:
            look_up(name, KINDS, "kind of question")
        chosen = tuple(kinds) or occasion.layout.shuffled("kinds", KINDS)
        found = dict[str, ExerciseQuestion]()
        for name in chosen:
            question = self._question(name, occasion)
            if question is not None:
                found[name] = question
            elif kinds:
                raise DeclarationError(
                    f"a question of the kind {name!r} on {self.subject.name!r}",
                    expected="a kind that the system offers",
                    advice="list the kinds that it offers",
                )
            if not kinds and len(found) == most:
                break
        order = kinds or list(KINDS)
        return tuple(found[name] for name in order if name in found)


def _entry(system: System) -> CatalogueEntry:
    """The entry of the catalogue with the same declaration, or one without typical values."""
    entry = CATALOGUE.get(system.name)
    if entry is not None and entry.build() == system:
        return entry
    return CatalogueEntry.bare(system.name, system.name, system)


def _refuse_unfit(equations: Equations) -> None:
    name = equations.system.name
    if equations.in_parts:
        raise NumericError(
            f"an exercise on {name!r}, whose equations have to be kept in named parts",
            expected="equations short enough to be written out",
            advice="declare a part of the system",
        )
    if not equations.speeds:
        raise NumericError(
            f"an exercise on {name!r}, which cannot move", expected="an independent speed"
        )


# -- the statement ---------------------------------------------------------------------------------


def _statement(subject: ExerciseSubject) -> Iterable[Passage]:
    setting = subject.setting
    found: list[str] = []
    for line in assumptions(setting):
        if not line.latex:
            found.append(line.words)
        elif not line.words and found and found[-1].endswith("$."):  # a list of moments
            found[-1] = f"{found[-1][:-1]} and ${line.latex}$."
        else:
            found.append(f"{line.words} ${line.latex}$.".strip())
    yield Passage(" ".join(filter(None, found)))
    if setting.is_single:
        yield Passage(" ".join(line.words for line in choice_of_axes(setting) if line.words))
    else:
        places = filter(None, map(_place_in_words, setting.equations.system.elements))
        bodies = (line.words for line in axes_of_bodies(setting))
        yield from map(Passage, filter(None, (" ".join(bodies), " ".join(places))))
    if meaning := _speeds_in_words(subject):
        yield Passage(meaning)


def _place_in_words(element: Element) -> str:
    if not isinstance(element, Pivot) or element.at.is_zero:
        return ""
    body = element.bodies[0]
    place = ", ".join(c.latex() for c in element.at.express(body.axes).components)
    words = f"“{element.name}” holds the point $({place})$ of the {body.name}, counted along its "
    words += "axes from its centre of mass"
    if isinstance(element.to, BodyPoint):
        other = element.to.body
        there = ", ".join(c.latex() for c in element.to.offset.express(other.axes).components)
        words += f", at the point $({there})$ of the {other.name}"
    return f"{words}."


def _speeds_in_words(subject: ExerciseSubject) -> str:
    """What the speeds are that are no rates of coordinates."""
    vectors = list[tuple[str, Setting, Vector]]()
    for one in subject.setting.each:
        of = f"of the {one.body.name}"
        turned = one.angular_velocity
        centre = "velocity of the centre of mass" + ("" if one.is_single else f" {of}")
        vectors += [(f"angular velocity {of}", one, turned), (centre, one, one.velocity)]
        if one.is_single:
            relative = f"angular velocity {of} relative to these axes"
            vectors.insert(1, (relative, one, turned - one.turning))
    sentences, known = [], set[Symbol]()
    for meaning, setting, vector in vectors:
        frame, _ = setting.shortest(vector)
        found = _speeds_along(subject, vector, frame)
        of = ""
        if not found and frame != setting.body.axes:
            found = _speeds_along(subject, vector, setting.body.axes)
            of = f" of the {setting.body.name}"
        new = [s for s in found if s not in known]
        known |= set(new)
        if new:
            what = "is the component" if len(new) == 1 else "are the components"
            along = listed(f"${found[s]}$" for s in new)
            along = f"the axis {along}{of}" if of else along
            sentences.append(f"{listed(map(inline, new))} {what} of the {meaning} along {along}.")
    if placed := subject.places:
        rates = listed(
            f"${inline(q.derivative())[1:-1]} = {inline(s)[1:-1]}$" for q, s in placed.items()
        )
        what = "is a coordinate" if len(placed) == 1 else "are coordinates"
        sentences.append(f"{listed(map(inline, placed))} {what}, with {rates}.")
    return " ".join(sentences)


def _speeds_along(subject: ExerciseSubject, vector: Vector, frame: Frame) -> dict[Symbol, str]:
    """The components of a vector that are speeds, each with the letter of its axis."""
    pairs = zip(frame.labels, vector.express(frame).components, strict=True)
    return {c.symbol: letter_of(k) for k, c in pairs if _is_speed(subject, c) and c.symbol}


def _is_speed(subject: ExerciseSubject, value: Expr) -> bool:
    symbol = value.symbol
    return symbol in subject.equations.speeds and symbol is not None and not symbol.order


def _numbers_in_words(drawn: DrawnNumbers) -> str:
    parts = [equality(symbol, amount) for symbol, amount in drawn.amounts.items()]
    parts += [f"{inline(s)[:-1]} = {e.latex()}$" for s, e in drawn.formulas.items()]
    return ", ".join(parts)


def mark(
    found: Exercise, answers: Mapping[str, str], system: System | None = None
) -> dict[str, MarkedPart]:
    """Mark the answers of a student.

    Args:
        found: the exercise.
        answers: what was answered, by id.
        system: the declaration, for a system outside the catalogue.

    Raises:
        DeclarationError: for an id that the exercise does not have.
    """
    for name in answers:
        look_up(name, found.answers, "question")
    declared = system if system is not None else CATALOGUE[found.system].build()
    equations = derive(declared)
    return {k: marked_part(a, answers.get(k, ""), equations) for k, a in found.answers.items()}
