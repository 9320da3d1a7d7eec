"""Questions about degrees of freedom, velocities and momentum, and the equations of motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

import numpy as np

from polhode.algebra import Expr, Symbol, Vector
from polhode.base import PolhodeError
from polhode.exercise._answers import FormulaAnswer, NumberAnswer
from polhode.exercise._context import SheetContext
from polhode.exercise._legal import legal_state, vanishes
from polhode.exercise._numbers import draw_state
from polhode.exercise._quantities import factor, number_latex, unit_of, unit_printed
from polhode.exercise._question import ExerciseQuestion, Occasion, Passage, stated
from polhode.exercise._subject import LONGEST, ExerciseSubject, value_of
from polhode.model import Body, Frame
from polhode.solution import Setting, breaks, inline, letter_of, listed, vector_latex

_MANY_TERMS = 3
_LONGEST_VECTOR = 260
_NUMBERS = ("no", "one", "two", "three", "four", "five", "six")


def count(number: int) -> str:
    """A number in words up to six."""
    return _NUMBERS[number] if number < len(_NUMBERS) else str(number)


# -- degrees of freedom ----------------------------------------------------------------------------


def degrees_of_freedom(occasion: Occasion) -> Iterator[ExerciseQuestion]:
    """How many speeds are independent, and how many conditions the supports impose."""
    subject = occasion.subject
    speeds = subject.equations.speeds
    free = sum(map(_free_velocities, subject.bodies))
    imposed = free - len(speeds)
    if _rank(occasion) != len(speeds) or imposed <= 0:
        return
    names = listed(f"the {body.name}" for body in subject.bodies)
    yield ExerciseQuestion(
        "freedom",
        (
            Passage(
                "How many degrees of freedom does the system have, that is, how many velocities "
                "can be chosen independently at an instant? How many independent conditions on the "
                f"velocities of {names} do the supports impose?"
            ),
        ),
        (
            NumberAnswer("degrees of freedom:", (float(len(speeds)),), tolerance=0.0),
            NumberAnswer("conditions:", (float(imposed),), tolerance=0.0),
        ),
        (
            Passage(
                f"For independent velocities one can take {listed(map(inline, speeds))}: there "
                f"{'is' if len(speeds) == 1 else 'are'} {count(len(speeds))}. Without supports "
                f"{names} would have {count(free)}{_why_fewer(subject)}, so that "
                f"{count(imposed)} condition{' is' if imposed == 1 else 's are'} imposed."
            ),
        ),
    )


def _free_velocities(body: Body) -> int:
    """Of a free body: those of the centre of mass, and turns that some inertia resists."""
    rows = body.inertia.rows
    turns = sum(any(row) for row in rows)
    return 3 + turns


def is_particle(body: Body) -> bool:
    """Whether a body has no inertia against turning."""
    return _free_velocities(body) == 3


def _why_fewer(subject: ExerciseSubject) -> str:
    if all(map(is_particle, subject.bodies)):
        each = "" if len(subject.bodies) == 1 else " three for each"
        return f" ({each.strip()})" if each else ", being a particle"
    if any(_free_velocities(body) == 5 for body in subject.bodies):
        return " (turning a thin rod about itself does not count)"
    return ""


def _rank(occasion: Occasion) -> int:
    """Rank of the mass matrix at numbers: the number of speeds that are independent."""
    mass = occasion.subject.equations.mass
    symbols = {s for row in mass.rows for e in row for s in e.symbols() if s.kind.varies}
    state = draw_state(occasion.subject, symbols, occasion.drawn, occasion.own.about("rank"))
    values = occasion.values(state or {})
    try:
        rows = np.array([[value_of(e, values) for e in row] for row in mass.rows])
    except PolhodeError:
        return 0
    scale = np.sqrt(np.abs(np.diag(rows)))
    if not np.all(scale > 0):
        return 0
    return int(np.linalg.matrix_rank(rows / np.outer(scale, scale), tol=1e-9))


# -- angular velocity, velocity, angular momentum --------------------------------------------------


def velocities(occasion: Occasion) -> Iterator[ExerciseQuestion]:
    """ω, the velocity of the centre of mass and L of one body along axes."""
    subject = occasion.subject
    for one in occasion.layout.shuffled("body", subject.setting.each):
        found = list(_vectors_asked(occasion, one))
        if not found:
            continue
        inside = {s for vector, _, _ in found for c in vector.components for s in c.symbols()}
        speeds = [s for s in subject.equations.speeds if s in inside]
        named = f" in terms of {listed(map(inline, speeds))}" if speeds else ""
        meanings = [meaning for _, meaning, _ in found]
        yield ExerciseQuestion(
            "velocities",
            (Passage(f"Find for the {one.body.name}{named}: {_along(meanings)}."),),
            tuple(answer for _, _, answer in found),
            (),
        )


def _vectors_asked(
    occasion: Occasion, one: Setting
) -> Iterator[tuple[Vector, tuple[str, str], FormulaAnswer]]:
    """Vectors of a body, what they are and along which axes, and the answers."""
    subject = occasion.subject
    low = "" if one.is_single else one.subscript
    vectors = {
        rf"\boldsymbol\omega{low}": (one.angular_velocity, "the angular velocity"),
        rf"\mathbf v{one.subscript}": (one.velocity, "the velocity of the centre of mass"),
    }
    if one.is_single:  # the letter of another body's would have to be introduced
        meaning = "the angular momentum about the centre of mass"
        vectors[one.momentum_letter] = (one.spin, meaning)
    for letter, (vector, meaning) in vectors.items():
        if (r"\omega" in letter and is_particle(one.body)) or _is_plain(vector):
            continue
        found = _judged_along(subject, one, letter, vector)
        if found is None:
            continue
        frame, written = found
        along = f"along ${', '.join(map(letter_of, frame.labels))}$"
        components = vector.express(frame).components
        answer = occasion.sheet.formula(letter, written, components, along=frame)
        yield Vector(components, frame), (meaning, along), answer


def _judged_along(
    subject: ExerciseSubject, one: Setting, letter: str, vector: Vector
) -> tuple[Frame, str] | None:
    """Axes along which a vector is short and judged to be right, and the vector along them.

    Those of the laboratory can be read where several bodies have axes of the same names.
    """
    frame, written = one.shortest(vector)
    root = one.axes.root
    known = vector.subs(subject.setting.constant)
    for axes, text in {frame: written, root: vector_latex(known, root)}.items():
        is_short = text != "0" and len(text) <= _LONGEST_VECTOR
        if is_short and subject.holds(f"{letter} = {text}"):
            return axes, text
    return None


def _along(meanings: list[tuple[str, str]]) -> str:
    """Quantities with the axes, which are named once where they are the same for all."""
    axes = {along for _, along in meanings}
    if len(axes) == 1:
        return f"{listed(meaning for meaning, _ in meanings)}, {axes.pop()}"
    return listed(f"{meaning} {along}" for meaning, along in meanings)


def _is_plain(vector: Vector) -> bool:
    """Whether all components are letters, so that there is nothing to find."""
    return all(not c or c.symbol is not None for c in vector.components)


# -- equations of motion ---------------------------------------------------------------------------


def equation_of_motion(occasion: Occasion) -> Iterator[ExerciseQuestion]:
    """An equation of motion with one term left out, and an acceleration at an instant."""
    subject = occasion.subject
    rows = [row for row in subject.equations.motion if _blanks(row, subject)]
    long = [row for row in rows if len(breaks(row.latex())) + 1 >= _MANY_TERMS]
    rows = long or rows
    if not rows:
        return
    row = occasion.layout.choice("row", rows)
    place, blank = occasion.layout.choice("term", _blanks(row, subject))
    text = row.latex()
    letter = "X" if "X" not in subject.names else subject.free_letter("Z")
    shown = f"{text[:place]}{letter}{text[place + len(blank) :]}"
    if not subject.holds(f"{shown} = 0", let=(rf"{letter} = \left({blank}\right)",)):
        return
    accelerations = tuple(Expr.generator(s).latex() for s in _accelerations(row, subject))
    expected = occasion.sheet.formula(
        letter, blank, [row], definition=f"{letter} = {blank}", excluded=accelerations
    )
    angles = _of_which(row, subject)
    words = f"One of the equations of motion is, with one term left out{angles},"
    question = ExerciseQuestion(
        "motion",
        (Passage(words, f"{shown} = 0"), Passage(f"What is ${letter}$?")),
        (expected,),
        (Passage("The whole equation is", f"{text} = 0"),),
    )
    yield _with_acceleration(question, row, occasion) or question


def _of_which(row: Expr, subject: ExerciseSubject) -> str:
    found = _accelerations(row, subject)
    return f" and common factors cancelled, that for {inline(found[0])}" if len(found) == 1 else ""


def _accelerations(row: Expr, subject: ExerciseSubject) -> list[Symbol]:
    own = set(subject.equations.acceleration_symbols)
    return sorted(row.symbols() & own, key=lambda s: s.published)


def _blanks(row: Expr, subject: ExerciseSubject) -> list[tuple[int, str]]:
    """Terms without accelerations that can be left out, each with its place in the LaTeX."""
    text = row.latex()
    starts = breaks(text)
    if len(text) > LONGEST:
        return []
    ends = [*starts[1:], len(text)] if starts else []
    pieces = [(a + 3, text[a + 3 : b]) for a, b in zip(starts, ends, strict=True)]
    accelerations = [Expr.generator(s).latex() for s in _accelerations(row, subject)]
    return [(a, p) for a, p in pieces if not any(x in p for x in accelerations)]


def _with_acceleration(
    question: ExerciseQuestion, row: Expr, occasion: Occasion
) -> ExerciseQuestion | None:
    (acceleration, *others) = _accelerations(row, occasion.subject)
    if others:
        return None
    slope = row.diff(acceleration)
    value = -(row - slope * Expr.generator(acceleration)) / slope
    state = legal_state(occasion, "motion", value)
    if not state:
        return None
    values = occasion.values(state)
    result = value_of(value, values)
    if not vanishes(row, {**values, acceleration: result}):
        return None
    answer, shown = answer_for(occasion.subject, acceleration, result)
    where = stated(state)
    return ExerciseQuestion(
        question.kind,
        (*question.statement, Passage(f"How large is {inline(acceleration)} when {where}?")),
        (*question.answers, answer),
        (
            *question.worked,
            Passage(f"Solved for {inline(acceleration)} and with {where} it gives {shown}."),
        ),
    )


def answer_for(subject: ExerciseSubject, symbol: Symbol, value: float) -> tuple[NumberAnswer, str]:
    """The answer that a quantity has a value, given in SI units, and the equation that says so."""
    dimension = subject.dimension(symbol)
    unit_text = "" if dimension is None else unit_of(dimension, subject.is_angle(symbol))
    number = value / factor(unit_text)
    letter = inline(symbol)[1:-1]
    return NumberAnswer(f"${letter} =$", (number,), unit_text), equation_shown(
        letter, number, unit_text
    )


def defined(sheet: SheetContext, letter: str, value: Expr) -> FormulaAnswer:
    """The answer that a letter, which the question introduces, has a value."""
    text = value.latex()
    return sheet.formula(letter, text, [value], definition=f"{letter} = {text}")


def formula_and_number(
    occasion: Occasion,
    letter: str,
    value: Expr,
    like: Symbol,
    numbers: Mapping[Symbol, float],
) -> tuple[tuple[FormulaAnswer, NumberAnswer], str]:
    """Both answers for such a letter, in the unit of a symbol, and the equation with the number."""
    answer, _ = answer_for(occasion.subject, like, value_of(value, numbers))
    shown = equation_shown(letter, answer.values[0], answer.unit)
    return (defined(occasion.sheet, letter, value), replace(answer, prompt=f"${letter} =$")), shown


def equation_shown(letter: str, number: float, unit_text: str) -> str:
    """$F = 3.21$ N, to be put between words."""
    printed = unit_printed(unit_text)
    close = "" if printed == "°" else " "
    return f"${letter} = {number_latex(number)}${close}{printed}".strip()
