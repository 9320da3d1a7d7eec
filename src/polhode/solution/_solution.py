"""A worked solution: its sections in order, the shortest route, every formula judged."""

from __future__ import annotations

import re
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from polhode.base import (
    ConstraintError,
    DeclarationError,
    NumericError,
    Shown,
    look_up,
)
from polhode.derive import Equations, derive
from polhode.judge import Verdict
from polhode.model import System
from polhode.solution._appell import by_appell
from polhode.solution._bodies import velocities_of_bodies
from polhode.solution._closed_forms import closed_forms
from polhode.solution._example import Example
from polhode.solution._figure import Figure
from polhode.solution._figure_drawing import figure_of
from polhode.solution._free_rotation import about_each_axis
from polhode.solution._integrals import by_integrals, conserved_quantities
from polhode.solution._judge import judged
from polhode.solution._kinematics import kinematics
from polhode.solution._lagrange import by_lagrange
from polhode.solution._lines import SolutionLine, listed, size
from polhode.solution._motion import motion_figure, motion_words
from polhode.solution._named_parts import in_named_parts, refuse_too_large
from polhode.solution._newton import about_the_centre_of_mass, about_the_contact
from polhode.solution._openings import openings
from polhode.solution._questions import Derivation, TextQuestion, answered
from polhode.solution._reactions import equations_of_motion, reactions
from polhode.solution._remarks import Remark, further_remarks
from polhode.solution._setting import Setting, fits, setting_of
from polhode.solution._small_departures import close_to_rest, special_motions
from polhode.solution._statement import (
    assumptions,
    axes_of_bodies,
    choice_of_axes,
    lengths_in_words,
    places_in_words,
)
from polhode.solution._steady_motions import steady_motions
from polhode.solution._typical import typical_numbers

#: Heading of the section that a figure of a motion illustrates.
MOTION = "A motion"
AXES = "Axes and angles"
_REFERENCE = re.compile(r"\[\[(\w+)\]\]")


@dataclass(frozen=True)
class Route:
    """A way to the equations of motion.

    Attributes:
        title: of its section.
        lines: its lines; raises where the route does not exist.
    """

    title: str
    lines: Callable[[Setting], Iterator[SolutionLine]]


ROUTES: dict[str, Route] = {
    "newton": Route(
        "Newton's law and the torque about the centre of mass", about_the_centre_of_mass
    ),
    "contact": Route("The torque about the point where the force acts", about_the_contact),
    "lagrange": Route("Lagrange's equations", by_lagrange),
    "integrals": Route("First integrals", by_integrals),
    "appell": Route("Gibbs's and Appell's equations", by_appell),
}


@dataclass(frozen=True)
class Step:
    """A paragraph with the formula displayed below it.

    Attributes:
        section: its heading.
        words: the paragraph, with `$…$` around formulas.
        latex: the formula displayed; empty for none.
        number: of the formula; None for words alone.
        references: numbers of the formulas that the words refer to.
        context: of the claim; empty for words alone.
        verdict: on the formula; None for words alone.
        stated: claims that the words make, as LaTeX, with their verdicts.
    """

    section: str
    words: str
    latex: str = ""
    number: int | None = None
    references: tuple[int, ...] = ()
    context: str = ""
    verdict: Verdict | None = None
    stated: tuple[tuple[str, Verdict], ...] = ()

    def to_json(self) -> dict[str, Any]:
        """As it stands in a JSON document."""
        return {
            "section": self.section,
            "words": self.words,
            "latex": self.latex,
            "number": self.number,
            "references": list(self.references),
            "context": self.context,
            "verdict": self.verdict and self.verdict.answer.value,
            "stated": [
                {"latex": latex, "verdict": verdict.answer.value} for latex, verdict in self.stated
            ],
        }


@dataclass(frozen=True)
class Solution(Shown):
    """A worked solution.

    Attributes:
        system: name of the system.
        title: heading.
        route: that was taken.
        steps: in order.
        figure: the system with its axes, angles and forces.
        questions: that the text asks; each is the heading of a section.
        motion: a motion against time or periods, as SVG; empty without numbers.
        example: the values and the run that the figure of a motion shows.
        seconds: that it took to build and judge.
    """

    system: str
    title: str
    route: str
    steps: tuple[Step, ...]
    figure: Figure | None = field(default=None, repr=False)
    questions: tuple[TextQuestion, ...] = ()
    motion: str = field(default="", repr=False)
    seconds: float = field(default=0.0, compare=False)
    example: Example | None = field(default=None, repr=False, compare=False)

    @property
    def judged(self) -> int:
        """How many formulas are displayed; every one was judged."""
        return sum(step.verdict is not None for step in self.steps)

    @property
    def stated(self) -> int:
        """How many claims the words make besides; every one was judged."""
        return sum(len(step.stated) for step in self.steps)

    @property
    def sections(self) -> dict[str, tuple[Step, ...]]:
        """The steps by their headings."""
        found: dict[str, tuple[Step, ...]] = {}
        for step in self.steps:
            found[step.section] = (*found.get(step.section, ()), step)
        return found

    @property
    def counted(self) -> str:
        """How many formulas and claims were judged, in words."""
        claims = f"{self.stated} claim{'' if self.stated == 1 else 's'} in words"
        return f"{self.judged} formulas and {claims}"

    def __str__(self) -> str:
        return f"Solution of {self.system} by {self.route}: {self.counted} judged"


def solution(
    subject: System | Equations,
    route: str = "",
    *,
    questions: Sequence[TextQuestion] = (),
    remarks: Mapping[str, Remark] | Callable[[], Mapping[str, Remark]] | None = None,
    example: Example | None = None,
) -> Solution:
    """Work out a system, with every displayed formula judged against it.

    Args:
        subject: a declaration, or equations derived from it.
        route: newton, contact, lagrange, integrals or appell; by default the one of the first
            three that displays least.
        questions: about the system, to be answered in their order; a system without a route is
            then worked out as far as they need.
        remarks: on the claims of the text that asks, by their ids; a function is called once the
            route is known to exist.
        example: values for typical numbers and for a figure of the motion.

    Raises:
        ConstraintError: for sliding friction, and for a route that the system does not have.
        DeclarationError: for an unknown route, and for Lagrange's equations with rolling.
        NumericError: for a system too large for a document, and for a formula that does not hold,
            which would be a defect of polhode.
    """
    began = time.perf_counter()
    if route:
        look_up(route, ROUTES, "route")
    equations = subject if isinstance(subject, Equations) else derive(subject)
    refuse_too_large(equations)
    if equations.undetermined:
        example = None  # what the laws leave open has no values
    if example is not None and equations.in_parts and not example.groups:
        moving = {s.base() for s in equations.speeds if s.order}
        example = replace(
            example, groups=(tuple(s.published for s in equations.coordinates if s in moving),)
        )
    setting, name, general = _general(equations, route, bool(questions), example)
    taken = ROUTES[name].title if name else ""
    routes = {key: way.lines for key, way in ROUTES.items()}
    known = Derivation(setting, general, routes, taken)
    judged_remarks = remarks() if callable(remarks) else remarks or {}
    sections = _with_answers(known, questions, judged_remarks)
    if example is not None and not equations.in_parts:
        lines = [line for part in sections.values() for line in part]
        sections["Typical numbers"] = tuple(typical_numbers(setting, lines, example))
    if example is not None:
        sections[MOTION] = tuple(motion_words(example))
    _define_places(setting, sections)
    steps = tuple(_steps(setting, sections))
    name_in_words = equations.system.name.replace("-", " ")
    title = name_in_words[:1].upper() + name_in_words[1:]
    has_arm = setting.is_single and any(r"\mathbf a" in s.latex + s.words for s in steps)
    figure = figure_of(setting, has_arm=has_arm)
    motion = "" if example is None else motion_figure(example)
    seconds = time.perf_counter() - began
    asked = tuple(questions)
    system = equations.system.name
    return Solution(system, title, name, steps, figure, asked, motion, seconds, example)


_Sections = dict[str, tuple[SolutionLine, ...]]


def _general(
    equations: Equations, route: str, has_questions: bool, example: Example | None
) -> tuple[Setting, str, _Sections]:
    """The setting, the route taken, and the sections that every solution has."""
    try:
        setting = setting_of(equations)
        if equations.in_parts:
            return setting, "newton", _in_parts(setting, route, example)
        name, lines = _taken(setting, route)
    except ConstraintError:
        if route or not has_questions:
            raise
        setting = Setting(equations)
        start = {
            "Assumptions": tuple(assumptions(setting)),
            **_opening(setting),
            "Equations of motion": tuple(equations_of_motion(setting, ())),
        }
        return setting, "", start
    return (
        setting,
        name,
        {
            "Assumptions": tuple(assumptions(setting)),
            **_opening(setting),
            ROUTES[name].title: lines,
            "Equations of motion": tuple(
                equations_of_motion(setting, lines, is_derived=name != "integrals")
            ),
            "Conserved quantities": ()
            if name == "integrals"
            else tuple(conserved_quantities(setting)),
            "Forces of the supports": tuple(reactions(setting)),
            "Where contacts open": tuple(openings(setting)),
            **_analysed(setting),
        },
    )


def _analysed(setting: Setting) -> _Sections:
    """Steady motions and more; of equations all too long to be written out, small departures."""
    if not any(map(fits, setting.equations.motion)):
        return {"Small departures and stability": tuple(close_to_rest(setting))}
    return {
        "Steady motions": tuple(steady_motions(setting)),
        "Small departures and stability": (*special_motions(setting), *about_each_axis(setting)),
        "The motion in closed form": tuple(closed_forms(setting)),
    }


def _in_parts(setting: Setting, route: str, example: Example | None) -> _Sections:
    """The sections of a system whose equations are kept in named parts."""
    if route not in ("", "newton"):
        raise ConstraintError(
            f"the route {route} for {setting.equations.system.name!r}",
            expected="the route newton, the only one for equations kept in named parts",
            advice="name no route: this one is then taken",
        )
    return {
        "Assumptions": tuple(assumptions(setting)),
        AXES: tuple(axes_of_bodies(setting)),
        **in_named_parts(setting, example),
    }


def _with_answers(
    known: Derivation,
    questions: Sequence[TextQuestion],
    remarks: Mapping[str, Remark],
) -> _Sections:
    """The general sections that no answer contains, the answers, and what remains to be said."""
    general = known.sections
    answers = dict(answered(questions, known, remarks))
    within = frozenset[str]().union(*(question.sections(known.route) for question in questions))
    headings = list(general)
    first = next((i for i, heading in enumerate(headings) if heading in within), len(headings))
    before = {heading: general[heading] for heading in headings[:first]}
    after = {heading: general[heading] for heading in headings[first:] if heading not in within}
    said = [id for question in questions for id in question.claims]
    left = {"Further remarks on the text": tuple(further_remarks(remarks, said))}
    return {**before, **answers, **after, **left}


def _opening(setting: Setting) -> _Sections:
    if not setting.is_single:
        return {
            AXES: tuple(axes_of_bodies(setting)),
            "Velocities and angular momenta": tuple(velocities_of_bodies(setting)),
        }
    return {
        AXES: tuple(choice_of_axes(setting)),
        "Velocities and angular momentum": tuple(kinematics(setting)),
    }


def _taken(setting: Setting, route: str) -> tuple[str, tuple[SolutionLine, ...]]:
    if route:
        return route, tuple(ROUTES[route].lines(setting))
    found: dict[str, tuple[SolutionLine, ...]] = {}
    needs: dict[str, list[str]] = {}
    for name in ("newton", "contact", "lagrange"):
        try:
            found[name] = tuple(ROUTES[name].lines(setting))
        except (ConstraintError, DeclarationError, NumericError) as missing:
            needs.setdefault(missing.expected, []).append(name)
    if not found:
        reasons = [
            f"{listed(names)} {'needs' if len(names) == 1 else 'need'} {needed}"
            for needed, names in needs.items()
        ]
        raise ConstraintError(
            f"a worked solution of {setting.equations.system.name!r}",
            expected=f"a system that one of the routes covers: {'; '.join(reasons)}",
            advice="derive prints the equations of motion and every reaction",
        )
    best = min(found, key=lambda name: size(found[name]))
    return best, found[best]


def _define_places(setting: Setting, sections: _Sections) -> None:
    """Say what the coordinates of places and the lengths are that occur in the formulas."""
    lines = [line for part in sections.values() for line in part]
    texts = [line.latex for line in lines] + [line.words for line in lines]
    heading = AXES if AXES in sections else next(iter(sections))
    defined = (*places_in_words(setting, texts), *lengths_in_words(setting, texts))
    sections[heading] = (*sections[heading], *defined)


# -- numbering and judging -------------------------------------------------------------------------


def _steps(setting: Setting, sections: dict[str, tuple[SolutionLine, ...]]) -> Iterator[Step]:
    equations = setting.equations
    numbers = _numbers(line for lines in sections.values() for line in lines)
    current = 0
    for section, lines in sections.items():
        for line in lines:
            keys = _REFERENCE.findall(line.words)
            words = _REFERENCE.sub(lambda found: f"({numbers[found[1]]})", line.words)
            references = tuple(numbers[key] for key in keys)
            stated = tuple((one.latex, judged(one, equations)) for one in line.stated)
            if not line.latex:
                yield Step(section, words, references=references, stated=stated)
                continue
            current += 1
            verdict = line.verdict or judged(line, line.of or equations)
            yield Step(
                section, words, line.latex, current, references, line.context, verdict, stated
            )


def _numbers(lines: Iterable[SolutionLine]) -> dict[str, int]:
    displayed = [line for line in lines if line.latex]
    return {line.key: i + 1 for i, line in enumerate(displayed) if line.key}
