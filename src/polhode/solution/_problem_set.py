"""What the problem set asks about each system, in its order, and what answers it.

The questions are in our own words. An answer names a computation; its formulas are derived and
judged when a solution is built.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache, partial

from polhode.base import look_up
from polhode.catalogue import CATALOGUE, CatalogueEntry, numbers_of
from polhode.derive import Equations, derive
from polhode.judge import document_of, report_on
from polhode.solution._answers import (
    AtInstant,
    CoriolisTorque,
    ForceAlong,
    LeastForces,
    RateOf,
    SlidingOnRest,
    SmallOscillation,
    WhateverForce,
)
from polhode.solution._example import Example, example_of
from polhode.solution._questions import ByRoute, FromSection, RouteTaken, TextQuestion
from polhode.solution._remarks import Remark, remarks_on
from polhode.solution._solution import Solution, solution

_NOTHING: Mapping[str, str] = {}
_STEADY = FromSection("Steady motions")
_CLOSED = FromSection("The motion in closed form")
_SMALL = FromSection("Small departures and stability")

_COIN = (
    TextQuestion(
        part="(a)",
        title="How fast the coin precesses",
        asked=(
            "find the rate $\\dot\\phi$ at which the coin precesses steadily about the vertical "
            "while its axis keeps the angle $\\theta$ to it, in terms of $\\omega_3$."
        ),
        answers=(_STEADY,),
        claims=("1", "24", "25"),
    ),
    TextQuestion(
        part="(b)",
        title="The coin on edge",
        asked=(
            "which steady motions are possible on edge, at $\\theta = \\pi/2$? How fast must a "
            "coin spin on edge to be stable?"
        ),
        answers=(_SMALL,),
        claims=("w7", "w8", "w9", "26", "27", "w11"),
    ),
)

_DISK = (
    TextQuestion(
        title="The force eliminated",
        asked=(
            "from Newton’s law, the torque about the centre of mass and the constraint of rolling, "
            "eliminate $\\mathbf F$ and $\\mathbf v_{\\rm cm}$, and find the equations of motion."
        ),
        convention=(
            "in the statement $\\theta$ is at first the angle of axis $2$ to the vertical, so that "
            "the disk is on edge at $\\theta = 0$; from its equation 6 on, and in its solution, "
            "$\\theta$ is the angle of axis $3$, as it is here."
        ),
        answers=(
            RouteTaken(),
            FromSection("Equations of motion"),
        ),
        claims=("2", "3", "4", "5", "35", "37"),
    ),
    TextQuestion(
        title="Steady rolling",
        asked=("what relates $\\dot\\phi$, $\\omega_3$ and $\\theta$ when they are constant?"),
        answers=(_STEADY,),
        claims=("6", "40"),
    ),
    TextQuestion(
        title="Rolling on edge",
        asked=(
            "is rolling straight ahead on edge stable? Take $\\theta = \\pi/2 + \\epsilon$ with "
            "small $\\epsilon$ and $\\dot\\phi$ and any $\\omega_3$, to first order."
        ),
        answers=(_SMALL,),
        claims=("w22", "w83", "w23", "w24", "42", "w25", "w84", "w85", "w26", "w27", "w102"),
    ),
)

_MARBLE = (
    TextQuestion(
        part="(a)",
        title="The constraint of rolling",
        asked=(
            "what relates $\\mathbf a$, $\\mathbf r$, $\\mathbf v$, $\\boldsymbol\\Omega$ and "
            "$\\boldsymbol\\omega$ of a marble that rolls on a level turntable?"
        ),
        answers=(FromSection("Velocities and angular momentum"),),
        claims=("43",),
    ),
    TextQuestion(
        part="(b)",
        title="The circle",
        asked=(
            "eliminate $d\\boldsymbol\\omega/dt$ and show that the centre of the marble runs "
            "round a circle. Where is its centre, and how large is it? How does the marble turn?"
        ),
        answers=(
            RouteTaken(),
            FromSection("Equations of motion"),
            _CLOSED,
        ),
        claims=(
            "44",
            "7",
            "8",
            "47",
            "48",
            "50",
            "51",
            "52",
            "54",
            "w38",
            "55",
            "w86",
            "w28",
            "w30",
        ),
    ),
)

_TILTED = (
    TextQuestion(
        part="(c)",
        title="The tilted turntable",
        asked=(
            "the turntable is tilted by $\\alpha$. Show that a steady horizontal drift is added to "
            "the motion of part (b), and find it."
        ),
        convention=(
            "axis $1$ is the normal of the turntable, $2$ points up the slope, and $3$ is "
            "horizontal; $\\boldsymbol\\Omega$ is along $+\\hat{\\mathbf 1}$."
        ),
        answers=(FromSection("Equations of motion"), _CLOSED),
        claims=("56", "57", "58", "59", "60", "61", "62", "9", "w42", "w43"),
    ),
)

_COMPASS = (
    TextQuestion(
        part="(a)",
        title="In the frame of the Earth",
        asked=(
            "find the torque of the Coriolis force on a hoop that spins at $\\omega$ about its "
            "axle, and the frequency of small oscillations about the north that follows from it."
        ),
        convention=(
            "axis $1$ is vertical, $3$ the axle at $\\theta$ to the north, towards the east, and "
            "$\\lambda$ the colatitude. The axes turn at $-\\dot\\theta$ about $1$, as in the "
            "text’s solution; its statement has $+\\dot\\theta$."
        ),
        answers=(
            CoriolisTorque("Earth", {"theta_dot": "0"}, "with the axle held", "1", "Omega"),
            SmallOscillation("theta", "0", "Omega", {"I_3": "2*I_1"}, "for a hoop"),
        ),
        claims=("w87", "w88", "64", "65", "66", "67", "10", "68"),
    ),
    TextQuestion(
        part="(b)",
        title="In an inertial frame",
        asked=(
            "find the same from $\\boldsymbol\\tau = d\\mathbf L/dt$ with the constraint alone "
            "acting on the rotor, and show that $\\omega$ stays constant."
        ),
        answers=(
            RouteTaken(),
            FromSection("Equations of motion"),
            FromSection("Forces of the supports"),
        ),
        claims=(
            *("69", "70", "71", "72", "73", "74", "75", "w100"),
            *("w46", "w47", "w48", "w89", "w90"),
        ),
    ),
)

_RACQUET = (
    TextQuestion(
        title="The special case T = L²/2I₂",
        asked=(
            "express $\\omega_1$ and $\\omega_3$ by $\\omega_2$ where the kinetic energy is "
            "$L^2/2I_2$, and find all three as functions of time. What happens as "
            "$t \\to \\infty$?"
        ),
        answers=(_CLOSED,),
        claims=(
            *("76", "77", "78", "79", "80", "11", "81", "82", "83", "84", "85", "86"),
            *("12", "13", "14", "w51"),
        ),
    ),
    TextQuestion(
        title="Rotation about the three axes",
        asked=(
            "under what condition is each of the steady rotations stable, and which of them is not "
            "where $I_1 < I_2 < I_3$?"
        ),
        answers=(_STEADY, _SMALL),
    ),
)

_AT_REST = ("X_dot", "Y_dot", "chi_dot")
_BALL = (
    TextQuestion(
        title="The final velocity",
        asked=(
            "show that the ball, once it rolls on the table, has the velocity with which it first "
            "rolled on the paper, however the paper is moved meanwhile, jerks and slipping "
            "included."
        ),
        answers=(WhateverForce("sheet", _AT_REST),),
        claims=("87", "88", "89", "w52", "w53", "w54", "w55", "w99"),
    ),
    TextQuestion(
        title="While the paper moves",
        asked="does the velocity change while the ball rolls on the moving paper?",
        answers=(
            FromSection("Equations of motion"),
            AtInstant(
                {"chi_dot": "0", "chi_ddot": "0"},
                ("v_x_dot", "v_y_dot"),
                "While the paper does not turn, and whatever its other motion",
            ),
        ),
        claims=("w91",),
    ),
    TextQuestion(
        title="The paths",
        asked="what path does the ball take while it slides over the table, and after that?",
        answers=(SlidingOnRest("sheet", (*_AT_REST, "X_ddot", "Y_ddot", "chi_ddot")),),
        claims=("w56",),
    ),
)

_AXES = "rho,phi,z"
_PIVOT_CONVENTION = (
    "$\\hat{\\boldsymbol\\rho}$ is horizontal, away from the pivot, "
    "$\\hat{\\boldsymbol\\phi}$ horizontal in the sense of precession, $\\hat{\\mathbf z}$ "
    "vertical; axis $1$ runs along the axle at $\\theta$ to the vertical."
)
_GYROSCOPE = (
    TextQuestion(
        title="The force on the pivot",
        asked="what force does the pivot exert, along $\\rho$, $\\phi$ and $z$?",
        convention=_PIVOT_CONVENTION,
        answers=(ForceAlong("pivot", _AXES),),
        claims=("92", "143", "144", "145", "146", "147"),
    ),
    TextQuestion(
        title="Torques about the centre of mass",
        asked=(
            "derive the same motion with the centre of mass as the point of reference instead of "
            "the pivot."
        ),
        answers=(ByRoute("newton"),),
        claims=(
            *("93", "95", "109", "110", "w101"),
            *("112", "113", "114", "115", "116", "118", "119", "120", "121"),
        ),
    ),
    TextQuestion(
        title="Steady precession",
        asked=(
            "at which rates can it precess steadily, when is that possible, and what does the "
            "pivot exert then?"
        ),
        answers=(
            _STEADY,
            ForceAlong(
                "pivot",
                _AXES,
                {"theta_dot": "0", "theta_ddot": "0", "phi_ddot": "0"},
                "steady",
                "In steady precession",
            ),
        ),
        claims=("122", "123", "124", "125", "126", "127", "128", "129", "130", "w60", "w61"),
    ),
    TextQuestion(
        title="Launched from rest",
        asked=(
            "the axle is released from rest at $\\theta_1$ while the flywheel spins. What force "
            "acts at first, and through the cycle of the nutation?"
        ),
        answers=(
            AtInstant(
                {"theta_dot": "0", "phi_dot": "0"},
                ("theta_ddot", "phi_ddot", "F_rho", "F_phi", "F_z"),
                "At the release, $\\dot\\theta = \\dot\\phi = 0$",
            ),
            _CLOSED,
        ),
        claims=(
            *("w67", "w68", "w69", "w70", "w71", "w72", "w73"),
            *("w74", "w75", "w76", "w77", "w78", "w79"),
            *("w92", "w93", "w94", "w95", "w96"),
        ),
    ),
    TextQuestion(
        title="The spin about the axle",
        asked="how does the rate $\\dot\\psi$ of the flywheel relative to the axes change?",
        answers=(RateOf("psi", "Since $\\omega_1$ is constant,"),),
        claims=("111", "153", "156", "157", "161", "w97", "w98"),
    ),
)
_HELD = (
    TextQuestion(
        title="Held fixed by a second force",
        asked=(
            "a second force $\\mathbf F'$ at the far end of the axle keeps it at rest. How do "
            "the two supports share the load?"
        ),
        answers=(LeastForces(),),
        claims=("131", "132", "133", "134", "135", "136"),
    ),
)
_VERTICAL = (
    TextQuestion(
        title="Kept in a vertical plane",
        asked=(
            "a guide keeps the axle in a vertical plane by a force along $\\phi$ alone. What are "
            "the forces, and how does it fall?"
        ),
        answers=(
            FromSection("Equations of motion"),
            ForceAlong("pivot", _AXES),
            ForceAlong("hand", _AXES),
            _CLOSED,
        ),
        claims=("137", "138", "139", "140", "141", "w64", "w65"),
    ),
)

#: The questions about each system of the catalogue, in the order of the text.
QUESTIONS: Mapping[str, tuple[TextQuestion, ...]] = {
    "spinning-coin": _COIN,
    "rolling-disk": _DISK,
    "marble-on-turntable": _MARBLE,
    "marble-on-turntable/tilted": _TILTED,
    "gyrocompass": _COMPASS,
    "tennis-racquet": _RACQUET,
    "ball-on-paper": _BALL,
    "gyroscope": _GYROSCOPE,
    "gyroscope/held": _HELD,
    "gyroscope/vertical-plane": _VERTICAL,
}

#: The route that the text takes, where it is not the shortest.
ROUTE: Mapping[str, str] = {
    "spinning-coin": "lagrange",
    "rolling-disk": "newton",
    "gyrocompass": "newton",
}


def questions_of(name: str) -> tuple[TextQuestion, ...]:
    """The questions about a system of the catalogue; none for one that the text does not treat."""
    return QUESTIONS.get(name, ())


def remarks_of(*ids: str) -> dict[str, Remark]:
    """Remarks on claims of the problem set, or on all of them, by their ids."""

    @cache
    def equations_of(name: str) -> Equations:
        return derive(CATALOGUE[name].build())

    document = document_of(None)
    return remarks_on(document, report_on(document, equations_of, only=ids), equations_of)


def answered_solution(
    name: str,
    route: str = "",
    remarks: Mapping[str, Remark] | Callable[[], Mapping[str, Remark]] | None = None,
    settings: Mapping[str, str] = _NOTHING,
    start: Mapping[str, str] = _NOTHING,
    duration: str = "",
) -> Solution:
    """The worked solution of a system of the catalogue, with the text's questions answered.

    Args:
        name: in the catalogue.
        route: to the equations of motion; by default that of the text.
        remarks: on the text's claims about this system; by default on those that the questions
            are about, whose verdicts then take a few seconds.
        settings: parameters for typical numbers; by default those of the catalogue.
        start: of the motion that is drawn, likewise.
        duration: of that motion, likewise.

    Raises:
        DeclarationError: for a name that the catalogue does not have.
        ConstraintError, NumericError: as `solution` does.
    """
    entry = look_up(name, CATALOGUE, "system of the catalogue")
    equations = derive(entry.build())
    example = catalogue_example(entry, equations, settings, start, duration)
    questions = questions_of(name)
    asked = [id for question in questions for id in question.claims]
    if remarks is None and asked:
        remarks = partial(remarks_of, *asked)
    taken = route or ROUTE.get(name, "")
    found = solution(equations, taken, questions=questions, remarks=remarks, example=example)
    return replace(found, title=entry.title)


def catalogue_example(
    entry: CatalogueEntry,
    equations: Equations,
    settings: Mapping[str, str] = _NOTHING,
    start: Mapping[str, str] = _NOTHING,
    duration: str = "",
) -> Example | None:
    """The values of an entry, with those given in their place.

    None for a user's system for which none are given. Raises as `polhode.catalogue.numbers_of`.
    """
    if not entry.duration and not any((settings, start, duration)):
        return None
    numbers = numbers_of(entry, equations, settings, start, duration)
    defaults = {name: text for name, text in entry.defaults.items() if name not in settings}
    return example_of(equations, numbers, defaults, entry.plots)
