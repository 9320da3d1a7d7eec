"""Sheets of exercises as plain structure: what stands on them, and the answers apart."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from polhode.exercise._answers import ExpectedAnswer
from polhode.exercise._exercise import Exercise
from polhode.exercise._question import LETTERS, ExerciseQuestion, Passage
from polhode.exercise._subject import in_words
from polhode.solution import Figure, Solution


@dataclass(frozen=True)
class ExerciseSheet:
    """The exercises of one student.

    Attributes:
        seed: that all numbers were drawn with.
        student: number, from 1.
        exercises: in order.
    """

    seed: int
    student: int
    exercises: tuple[Exercise, ...]

    @property
    def answers(self) -> dict[str, tuple[Exercise, ExpectedAnswer]]:
        """The expected answers by id: 2a, or 1.2a where there are several exercises."""
        return {
            self._id(i, name): (one, answer)
            for i, one in enumerate(self.exercises, 1)
            for name, answer in one.answers.items()
        }

    def _id(self, number: int, name: str) -> str:
        return f"{number}.{name}" if len(self.exercises) > 1 else name

    def numbered(
        self,
    ) -> Iterator[tuple[Exercise, ExerciseQuestion, str, dict[str, ExpectedAnswer]]]:
        """Every question with its number and its answers by id."""
        for i, one in enumerate(self.exercises, 1):
            for k, question in enumerate(one.questions, 1):
                several = len(question.answers) > 1
                names = [f"{k}{letter if several else ''}" for letter in LETTERS]
                pairs = zip(names, question.answers, strict=False)
                yield one, question, self._id(i, str(k)), {self._id(i, n): a for n, a in pairs}


# -- blocks of a document --------------------------------------------------------------------------


@dataclass(frozen=True)
class SheetBlock:
    """A piece of a document.

    Attributes:
        words: with `$…$` around formulas; those of a heading, a paragraph, an option or a prompt.
        level: of a heading; 0 for anything else.
        latex: a formula displayed below the words.
        number: of that formula; empty for none.
        options: to choose from.
        blank: id of an answer, whose prompt the words are.
        unit: behind the blank.
        figure: above the words, which are its caption.
        picture: name for a file of the figure.
        begins_page: whether a new page begins here.
    """

    words: str = ""
    level: int = 0
    latex: str = ""
    number: str = ""
    options: tuple[str, ...] = ()
    blank: str = ""
    unit: str = ""
    figure: Figure | None = field(default=None, repr=False)
    picture: str = ""
    begins_page: bool = False


def sheet_blocks(sheet: ExerciseSheet) -> Iterator[SheetBlock]:
    """What a student is given."""
    yield SheetBlock(title_of(sheet), level=1)
    for i, one in enumerate(sheet.exercises, 1):
        several = len(sheet.exercises) > 1
        if several:
            yield SheetBlock(f"{i}. {one.title}", level=2, begins_page=i > 1)
        yield from _statement(one)
        for question, number, answers in _questions(sheet, one):
            yield SheetBlock(f"Question {number}", level=3 if several else 2)
            yield from _asked(question, answers)


def title_of(sheet: ExerciseSheet) -> str:
    """Heading of a sheet."""
    what = "Exercises" if len(sheet.exercises) > 1 else sheet.exercises[0].title
    return f"{what} (sheet {sheet.seed}.{sheet.student})"


def _questions(
    sheet: ExerciseSheet, of: Exercise
) -> Iterator[tuple[ExerciseQuestion, str, dict[str, ExpectedAnswer]]]:
    for one, question, number, answers in sheet.numbered():
        if one is of:
            yield question, number, answers


def _statement(one: Exercise) -> Iterator[SheetBlock]:
    first, *others = one.statement
    yield SheetBlock(first.words)
    yield SheetBlock(one.figure.caption, figure=one.figure, picture=in_words(one.system))
    yield from (SheetBlock(passage.words) for passage in others)
    yield SheetBlock(f"Numbers: {one.numbers}.")


def _asked(
    question: ExerciseQuestion, answers: Mapping[str, ExpectedAnswer]
) -> Iterator[SheetBlock]:
    yield from map(_passage, question.statement)
    if question.options:
        yield SheetBlock(options=question.options)
    for name, answer in answers.items():
        yield SheetBlock(answer.prompt, blank=name, unit=answer.unit)


def _passage(passage: Passage) -> SheetBlock:
    return SheetBlock(passage.words, latex=passage.latex)


# -- answers ---------------------------------------------------------------------------------------


def solution_blocks(sheets: Sequence[ExerciseSheet]) -> Iterator[SheetBlock]:
    """Answers of all sheets with how they are found, then the worked solution of every system."""
    yield SheetBlock(f"Answers and worked solutions (seed {sheets[0].seed})", level=1)
    for i, sheet in enumerate(sheets):
        if len(sheets) > 1:
            yield SheetBlock(f"Sheet {sheet.seed}.{sheet.student}", level=2, begins_page=i > 0)
        for one, question, number, answers in sheet.numbered():
            head = (
                f"Question {number}: {one.title}"
                if len(sheet.exercises) > 1
                else (f"Question {number}")
            )
            yield SheetBlock(head, level=3)
            yield from (_answer(name, answer) for name, answer in answers.items())
            yield from map(_passage, question.worked)
    for one in {one.system: one for sheet in sheets for one in sheet.exercises}.values():
        yield SheetBlock(f"{one.title}: worked solution", level=2, begins_page=True)
        worked = one.worked
        if isinstance(worked, Solution):
            yield from _worked(worked)
        else:
            yield SheetBlock(f"There is none: {worked}.")


def _answer(name: str, answer: ExpectedAnswer) -> SheetBlock:
    shown = answer.shown
    prompt = "" if answer.kind == "formula" else f"{answer.prompt} "
    return SheetBlock(f"{name}: {prompt}{shown}")


def _worked(solution: Solution) -> Iterator[SheetBlock]:
    for section, steps in solution.sections.items():
        yield SheetBlock(section, level=3)
        for step in steps:
            yield SheetBlock(step.words, latex=step.latex, number=str(step.number or ""))
