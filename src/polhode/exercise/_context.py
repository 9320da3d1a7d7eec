"""What a sheet says before its questions: the context in which every answer is marked."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from polhode.algebra import Expr, Symbol
from polhode.exercise._answers import FormulaAnswer
from polhode.exercise._subject import ExerciseSubject, letters_of
from polhode.model import Body, Frame
from polhode.solution import unit


@dataclass(frozen=True)
class SheetContext:
    """What a sheet introduces, from which an answer may be built.

    Attributes:
        letters: LaTeX: parameters and moments of inertia, unit vectors, the angles that the axes
            turn by, and the speeds.
        relations: LaTeX of what it says of parameters, such as I = 2ma²/5.
        axes: labels of all axes that it speaks of, three for each frame.
    """

    letters: tuple[str, ...]
    relations: tuple[str, ...] = ()
    axes: tuple[tuple[str, ...], ...] = ()

    def formula(
        self,
        asked: str,
        latex: str,
        own: Sequence[Expr],
        *,
        definition: str = "",
        also: str = "",
        excluded: tuple[str, ...] = (),
        along: Frame | None = None,
        is_positive: bool = False,
    ) -> FormulaAnswer:
        """The answer to a question on the sheet.

        Args:
            asked: the quantity, as LaTeX.
            latex: its value.
            own: expressions whose letters the answer may have besides those of the sheet.
            definition: of the quantity, where the question introduces it: "S = ...".
            also: another definition by which an answer is right too, such as one with magnitudes.
            excluded: letters with dots, such as accelerations, that may not occur.
            along: the axes along which a vector is asked for.
            is_positive: whether the question says that the quantity is positive.
        """
        labels = () if along is None else tuple(along.labels)
        return FormulaAnswer(
            asked,
            latex,
            tuple(sorted({*self.letters, *letters_of(own)})),
            self._given(definition),
            excluded,
            self._given(also) if also else "",
            (labels, *(a for a in self.axes if a != labels)) if labels else (),
            is_positive,
        )

    def _given(self, definition: str) -> str:
        """What the problem states before an answer, in words."""
        return " ".join(f"Let ${text}$." for text in (definition, *self.relations) if text)


def context_of(subject: ExerciseSubject, formulas: Mapping[Symbol, Expr]) -> SheetContext:
    """What a sheet about a system introduces.

    Args:
        subject: the system.
        formulas: parameters that the sheet gives by others.
    """
    equations, frames = subject.equations, subject.setting.frames
    turned = (c for frame in frames for step in frame.lineage for c in _turns(step))
    own = [*equations.parameters, *equations.functions, *equations.speeds, *formulas]
    own += subject.places
    letters = letters_of([*map(Expr.generator, own), *formulas.values(), *turned])
    units = (unit(label) for frame in frames for label in frame.labels)
    moments = (m for body in subject.bodies for m in _moments(body))
    pairs = formulas.items()
    return SheetContext(
        tuple(sorted({*letters, *units, *moments})),
        tuple(f"{Expr.generator(s).latex()} = {value.latex()}" for s, value in pairs),
        tuple(frame.labels for frame in frames),
    )


def _turns(frame: Frame) -> Iterator[Expr]:
    """What one step of turned axes depends on: its angle, or the rotation of the Earth."""
    if frame.parent is not None:
        yield frame.angle
    yield from frame.turned


def _moments(body: Body) -> Iterator[str]:
    """Letters of the principal moments of a body, by which the statement calls them."""
    rows = body.inertia.rows
    is_principal = all(not e for i, row in enumerate(rows) for j, e in enumerate(row) if i != j)
    if is_principal and not body.is_isotropic and not body.inertia.is_zero:
        yield from (Expr.generator(Symbol(f"I_{label}")).latex() for label in body.axes.labels)
