"""The question which of four equations is wrong, one of them by a slip that was planted."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from polhode.algebra import Expr, Symbol, Vector
from polhode.exercise._answers import ChoiceAnswer
from polhode.exercise._draws import Draws
from polhode.exercise._of_motion import count
from polhode.exercise._question import LETTERS, ExerciseQuestion, Occasion, Passage
from polhode.exercise._slips import slips
from polhode.exercise._subject import ExerciseSubject
from polhode.model import Element
from polhode.solution import Setting, Solution, breaks, letter_of, listed

_OPTIONS, _FEWEST = 4, 3
_LONGEST = 190
_HAT = re.compile(r"\\hat\{[^}]*\}")
_EXPLAINED = re.compile(
    r"\\(?:boldsymbol\\omega|mathbf [A-Za-z])'?(?:_\{[^}]*\})?|\\mathcal|\\partial"
    r"|(?<![A-Za-z\\_])[A-Z]'?(?:_\{[^}]*\}|_\w)?|\\dot\{\\psi\}"
    r"|\\tau(?:_\{[^}]*\}|_\w)?"
)
_CONTEXTS = ("identity", "motion")
_RATE = re.compile(r"\\frac\{d[^{}]*(?:\{[^{}]*\})*\}\{dt\}")
_TRIED = 6  # slips of one kind


def wrong_equation(occasion: Occasion) -> Iterator[ExerciseQuestion]:
    """Four equations about the system, or three, all but one of which hold."""
    subject = occasion.subject
    lines = occasion.layout.shuffled("equations", _lines(subject))
    taken = _different(lines)
    if len(taken) < _FEWEST:
        return
    own = occasion.own.about("wrong")
    planted = _planted(subject, taken, own)
    if planted is None:
        return
    place, slipped = planted
    shown = [slipped if i == place else line for i, line in enumerate(taken)]
    order = own.shuffled("order", range(len(taken)))
    letters = tuple(LETTERS[: len(taken)])
    right = letters[order.index(place)]
    yield ExerciseQuestion(
        "wrong",
        (
            Passage(
                f"One of these {count(len(taken))} equations is wrong, the others hold on every "
                f"motion. Which?{_legend(subject, shown)}"
            ),
        ),
        (ChoiceAnswer("wrong:", frozenset({right}), letters),),
        (Passage(f"Equation ({right}) is wrong. It holds as", taken[place]),),
        tuple(f"${shown[i]}$" for i in order),
    )


def _different(lines: Sequence[_Stated]) -> list[str]:
    """Equations from as many sections as there are, none of which is another times a factor."""
    by_section = {line.section: line for line in reversed(lines)}
    first = [line for line in lines if by_section[line.section] is line]
    taken: list[str] = []
    for line in (*first, *(x for x in lines if x not in first)):
        left = _sides(line.latex)
        if not any(left & _sides(t) or _contains(line.latex, t) for t in taken):
            taken.append(line.latex)
    return taken[:_OPTIONS]


def _sides(text: str) -> set[str]:
    return {side for side in text.split(" = ") if side != "0"}


def _contains(one: str, other: str) -> bool:
    """Whether the long side of either equation occurs in the other."""
    pairs = ((one, other), (other, one))
    return any(max(_sides(a), key=len, default="") in b for a, b in pairs)


class _Stated(NamedTuple):
    """An equation and the section of the worked solution that it stands in."""

    section: str
    latex: str


def _lines(subject: ExerciseSubject) -> list[_Stated]:
    """Equations of the worked solution that hold by themselves; rows and forces without one."""
    if isinstance(subject.worked, Solution):
        steps = subject.worked.steps
        found = [_Stated(s.section, s.latex) for s in steps if s.latex and s.context in _CONTEXTS]
    else:
        found = []
    found += _derived(subject)
    known = {*_meanings(subject), *_known(subject)}
    return [
        line
        for line in dict.fromkeys(found)
        if _is_fit(line.latex) and _letters(line.latex) <= known and subject.holds(line.latex)
    ]


def _derived(subject: ExerciseSubject) -> Iterator[_Stated]:
    """Equations of motion, components of forces, kinetic energy and what is conserved."""
    equations = subject.equations
    yield from (_Stated("motion", f"{row.latex()} = 0") for row in equations.motion)
    for name, value in equations.components.items():
        yield _Stated("forces", f"{Expr.generator(Symbol(name)).latex()} = {value.latex()}")
    yield _Stated("energy", f"T = {equations.kinetic_energy.latex()}")
    for one in subject.invariants:
        yield _Stated("conserved", rf"\frac{{d}}{{dt}}\left({one.expression.latex()}\right) = 0")


def _meanings(subject: ExerciseSubject) -> dict[str, str]:
    """What letters mean that the statement does not introduce, by how they begin in LaTeX."""
    setting = subject.setting
    ropes = {
        Expr.generator(Symbol(name)).latex(): f"the tension of “{rope.name}”"
        for name, rope in subject.tensions.items()
    }
    couples = ropes | {
        Expr.generator(Symbol(r.name)).latex(): _couple(e, r.direction)
        for e in setting.twisting
        for r in subject.equations.kinetics.restraints[e.name]
        if r.is_couple
    }
    if not setting.is_single:
        energies = {"T": "the kinetic energy", "V": "the potential energy"}
        return {**_meanings_of_bodies(setting), **couples, **energies}
    body = setting.body.name
    labels = "".join(setting.axes.labels)
    forces = {setting.force_letter(e): f"the force of “{e.name}”" for e in setting.forced}
    if len(forces) == 1:
        forces = dict.fromkeys(forces, "the force of the support")
    return {
        rf"\boldsymbol\omega_{{{labels}}}": "the angular velocity of the axes",
        r"\boldsymbol\omega": f"the angular velocity of the {body}",
        r"\mathbf v_{\rm cm}": "the velocity of the centre of mass",
        r"\mathbf L_{\rm cm}": "the angular momentum about the centre of mass",
        **forces,
        **couples,
        "T": "the kinetic energy",
        "V": "the potential energy",
        r"\dot{\psi}": f"the rate at which the {body} spins relative to the axes",
    }


def _meanings_of_bodies(setting: Setting) -> dict[str, str]:
    """Of the velocities of several bodies, and of the forces on them."""
    found = dict[str, str]()
    for one in setting.each:
        body = one.body.name
        found[rf"\boldsymbol\omega{one.subscript}"] = f"the angular velocity of the {body}"
        found[rf"\mathbf v{one.subscript}"] = f"the velocity of the centre of mass of the {body}"
    for element in setting.forced:
        on = f"the force of “{element.name}” on the {element.bodies[0].name}"
        found[setting.force_letter(element)] = on
    return found


def _couple(element: Element, direction: Vector) -> str:
    """A component of the couple of a support, by the axis of its body along which it is."""
    body = element.bodies[0]
    pairs = zip(body.axes.labels, direction.express(body.axes).components, strict=True)
    along = [letter_of(label) for label, value in pairs if value]
    if len(along) != 1:
        return f"a component of the couple of “{element.name}”"
    return f"the couple of “{element.name}” about axis ${along[0]}$ of the {body.name}"


def _letters(text: str) -> set[str]:
    """Letters for vectors, capitals without an index, and others that need an explanation."""
    return set(_EXPLAINED.findall(_HAT.sub("", text)))


def _legend(subject: ExerciseSubject, texts: Iterable[str]) -> str:
    """The meanings of the letters that occur, as a sentence."""
    used = set[str]().union(*map(_letters, texts)) - set(_known(subject))
    meanings = _meanings(subject)
    parts = [f"${k}$ is {meanings[k]}" for k in meanings if k in used]
    return f" Here {listed(parts)}." if parts else ""


def _known(subject: ExerciseSubject) -> list[str]:
    """LaTeX of the parameters and coordinates, and of their rates."""
    e = subject.equations
    symbols = (*e.parameters, *e.functions, *e.coordinates, *e.speeds, *e.acceleration_symbols)
    return [Expr.generator(s).latex() for s in symbols]


def _is_fit(text: str) -> bool:
    """Whether an equation is short, and long enough for a slip to hide in it."""
    single = text.count(" = ") == 1 and len(text) <= _LONGEST
    bare = _RATE.sub("", text)
    is_defined = bare.startswith(" = ")  # such as dv/dt by the rates of the components of v
    is_long = len(breaks(bare)) > 1 and not is_defined
    is_long = is_long or any(p in bare for p in (r"\frac", r"\sin", r"\cos"))
    return single and is_long and next(slips(text), None) is not None


def _planted(subject: ExerciseSubject, lines: Sequence[str], own: Draws) -> tuple[int, str] | None:
    """Which equation gets a slip, and its text with it; None if there is none to plant.

    The kind of the slip is drawn first, so that all kinds are as frequent as a system allows. It
    fails on the model, and no other change of the same kinds makes it true.
    """
    letters = _known(subject)
    found = [(i, slip) for i, line in enumerate(lines) for slip in slips(line, letters)]
    kinds = own.shuffled("kind", dict.fromkeys(slip.kind for _, slip in found))
    for kind in kinds:
        tried = own.shuffled(kind, ((i, s.text) for i, s in found if s.kind == kind))
        for place, text in tried[:_TRIED]:
            if subject.fails(text) and _has_one_correction(subject, text, lines[place]):
                return place, text
    return None


def _has_one_correction(subject: ExerciseSubject, text: str, right: str) -> bool:
    """Whether no slip turns a wrong equation into a true one but the one back."""
    others = dict.fromkeys(slip.text for slip in slips(text, _known(subject)))
    return all(subject.fails(other) for other in others if other != right)
