"""The equations of motion in short form, and the forces and couples of the supports."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress

from polhode.algebra import ZERO, Expr, Symbol, Vector, factors, is_positive
from polhode.base import NumericError
from polhode.derive import Equations
from polhode.model import Element, Frame
from polhode.solution._lines import (
    SolutionLine,
    fraction,
    inline,
    letter_of,
    listed,
    unit,
    vector_latex,
)
from polhode.solution._setting import LONGEST, WIDEST, Setting, bound, fits

#: How much shorter a force has to become by the equations of motion, or along other axes.
_SHORTER, _OTHER_AXES = 0.8, 1.25
#: Characters of a component of a force that is shown with the others.
_ONE_OF_SEVERAL = 250


def equations_of_motion(
    setting: Setting, before: Sequence[SolutionLine], is_derived: bool = True
) -> Iterator[SolutionLine]:
    """The equations of motion without idle factors, except those that stand in lines before.

    The lines before may have derived them, or else found what they leave constant.
    """
    equations = setting.equations.in_lengths
    rows = [row for row in equations.motion if fits(row)]
    shown_rows = [row for row in rows if not any(_stands(row, line, equations) for line in before)]
    divided = [_without_factors(row, equations) for row in shown_rows]
    nonzero = dict.fromkeys(rf"${one.latex()} \ne 0$" for _, left in divided for one in left)
    unless = f" and for {listed(nonzero)}" if nonzero else ""
    noun, leads, are = "equations", "lead", "are"
    if len(equations.motion) == 1:
        noun, leads, are = "equation", "leads", "is"
    which = "" if is_derived else f" that {leads} to these constants"
    those = "" if len(shown_rows) == len(rows) else ", besides those that stand above already,"
    for i, (row, _) in enumerate(divided):
        first = f"Without common factors{unless} the {noun} of motion{which} {are}{those}"
        words = first if i == 0 else ""
        yield SolutionLine(words, f"{row.latex()} = 0", f"motion_{i + 1}")
    yield from _constant_accelerations(setting)
    if left_out := len(equations.motion) - len(rows):
        which, them = ("the other", "it") if left_out == 1 else ("the others", "them")
        if not rows:
            which = "the equation of motion" if left_out == 1 else "the equations of motion"
        has = "has" if left_out == 1 else "have"
        yield SolutionLine(f"{which.capitalize()} {has} no short form; derive prints {them}.")


def _stands(row: Expr, line: SolutionLine, equations: Equations) -> bool:
    """Whether a line shows an equation of motion, with terms on the right that only were moved."""
    if line.sides is None:
        *members, last = line.latex.split(" = ")
        return last == "0" and row.latex() in members
    left, right = line.sides
    is_moved = not right.symbols() & {*equations.acceleration_symbols}
    return is_moved and left - right in (row, -row)


def _constant_accelerations(setting: Setting) -> Iterator[SolutionLine]:
    """The accelerations where all of them are constant."""
    words = "so that the acceleration is constant:"
    found = _uniform(setting.equations)
    for rate, value in found.items() if len(found) == len(setting.equations.speeds) else ():
        if value and (row := f"{Expr.generator(rate).latex()} = {fraction(value)}"):
            yield SolutionLine(words, row, f"constant_{rate.published}")
            words = ""


def _uniform(equations: Equations) -> dict[Symbol, Expr]:
    """Accelerations that the equations of motion make constant."""
    with suppress(NumericError):  # too many coupled speeds
        rates = equations.accelerations.items()
        return {rate: v for rate, v in rates if not any(s.kind.varies for s in v.symbols())}
    return {}


def _without_factors(row: Expr, equations: Equations) -> tuple[Expr, list[Expr]]:
    """A row without the factors that no acceleration enters, and those that may vanish."""
    accelerations = set(equations.acceleration_symbols)
    _, powers = factors(row)
    above = {f: p for f, p in powers.items() if p > 0}  # below the bar stand lengths
    idle = [(f, p) for f, p in above.items() if not f.symbols() & accelerations]
    if len(idle) == len(above):
        return row, []
    for factor, power in idle:
        row = row / factor**power
    signs = equations.assumed_positive
    open_ = [f for f, _ in idle if not is_positive(f) and f not in signs]
    return row, [-f if f.latex().startswith("-") else f for f in open_]


def reactions(setting: Setting) -> Iterator[SolutionLine]:
    """The forces of the supports, along the axes in which they are short."""
    open_ = setting.equations.undetermined
    if open_:
        free = [n for n in open_ if setting.equations.components[n] == Expr.generator(Symbol(n))]
        yield SolutionLine(
            f"The supports are redundant: {listed(inline(Symbol(name)) for name in free)} may have "
            "any value, which Newton's laws leave open, and the other forces depend on "
            f"{'it' if len(free) == 1 else 'them'}."
        )
    for line in (*_forces(setting), *_couples(setting)):
        yield bound(setting, line)


def _forces(setting: Setting) -> Iterator[SolutionLine]:
    for element in setting.forced:
        restraints = setting.equations.kinetics.restraints[element.name]
        if any(restraint.more for restraint in restraints):
            yield from _along_a_path(setting, element, [r.name for r in restraints])
            continue
        equations = setting.equations.in_lengths
        raw = equations.reactions[element.name].force.subs(setting.constant)
        frame, force, written = _shortened(setting, raw)
        reduced = not (force - raw).is_zero
        letter = setting.force_letter(element)
        parts = dict(zip(frame.labels, force.express(frame).components, strict=True))
        if len(written) > LONGEST and max(map(_length, parts.values())) > _ONE_OF_SEVERAL:
            yield SolutionLine(
                f"The force ${letter}$ of {setting.source(element)} has no short form along any of "
                "the axes; it follows from Newton's law."
            )
            continue
        present = {label: value for label, value in parts.items() if value}
        which = setting.source(element)
        start = "By the equations of motion the" if reduced else "The"
        if not present:
            words = f"{start} force of {which} vanishes:"
            yield SolutionLine(words, f"{letter} = 0", f"reaction_{element.name}")
            continue
        along = listed(f"${letter_of(label)}$" for label in present)
        short = ", where it is shortest," if len(setting.frames) > 1 else ""
        words = f"{start} force of {which} along {along}{short} is"
        if len(present) == 1:
            words = f"{start} force of {which} acts along {along} alone:"
        if len(written) <= WIDEST:
            yield SolutionLine(words, f"{letter} = {written}", f"reaction_{element.name}")
            continue
        for label, value in present.items():
            along_it = rf"{letter}\cdot {unit(label)}"
            yield SolutionLine(
                words, f"{along_it} = {value.latex()}", f"reaction_{element.name}_{label}"
            )
            words = ""


def _length(value: Expr) -> int:
    return len(value.latex())


def _couples(setting: Setting) -> Iterator[SolutionLine]:
    for element in setting.twisting:
        which = "the support" if len(setting.supports) == 1 else f"“{element.name}”"
        words = f"The couple of {which} is"
        for restraint in setting.equations.kinetics.restraints[element.name]:
            couple = _couple(setting, restraint.name) if restraint.is_couple else None
            if couple is not None:
                letter = Expr.generator(Symbol(restraint.name)).latex()
                yield SolutionLine(
                    words, f"{letter} = {couple.latex()}", f"couple_{restraint.name}"
                )
                words = ""


def _along_a_path(
    setting: Setting, element: Element, names: Iterable[str]
) -> Iterator[SolutionLine]:
    """Reactions that act on several bodies at once, such as tensions, by their letters."""
    for name in names:
        raw = setting.equations.in_lengths.components.get(name, ZERO)
        value = _on_motion(setting, raw)
        letter, which = Expr.generator(Symbol(name)).latex(), setting.source(element)
        start = "The" if value == raw else "By the equations of motion the"
        text = f"{letter} = {value.latex()}"
        if len(text) > LONGEST:
            yield SolutionLine(f"${letter}$ (“{element.name}”) has no short form.")
            continue
        yield SolutionLine(f"{start} force of {which} is", text, f"reaction_{name}")


def _shortened(setting: Setting, force: Vector) -> tuple[Frame, Vector, str]:
    """The frame along which a force is short, and the force there by the equations of motion."""
    plain, _ = setting.shortest(force)
    along = {frame: force.express(frame).components for frame in setting.frames}
    shorter = {
        frame: Vector(tuple(_on_motion(setting, value) for value in values), frame)
        for frame, values in along.items()
        if sum(len(value.latex()) for value in values) <= 4 * LONGEST
    }
    written = [(frame, force, vector_latex(force, frame)) for frame, force in shorter.items()]
    if not written:
        return plain, force, vector_latex(force, plain)
    return min(written, key=lambda one: len(one[2]) * (1 if one[0] == plain else _OTHER_AXES))


def _on_motion(setting: Setting, value: Expr) -> Expr:
    """A component with accelerations put in that the equations of motion give, where shorter."""
    equations = setting.equations.in_lengths
    value = value.subs({**setting.constant, **_uniform(equations)})
    for row in equations.motion:
        for rate in equations.acceleration_symbols:
            slope, inertia = value.diff(rate), row.diff(rate)
            if slope and inertia:
                other = value - row * slope / inertia
                if len(other.latex()) < _SHORTER * len(value.latex()):
                    value = other
    return value


def _couple(setting: Setting, name: str) -> Expr | None:
    """The component of a couple, if there is one that can be written out."""
    value = _on_motion(setting, setting.equations.in_lengths.components.get(name, ZERO))
    return value if value and len(value.latex()) <= LONGEST else None
