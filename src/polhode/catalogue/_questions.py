"""What the problem set asks about each system, in its order, and what answers it.

The questions are in our own words. An answer names a computation; its formulas are derived and
judged when a solution is built.
"""

from __future__ import annotations

from collections.abc import Mapping

from polhode.catalogue._audit import document_of
from polhode.catalogue._systems import CATALOGUE
from polhode.derive import Equations, derive
from polhode.solution import FromSection, Remark, TextQuestion, remarks_on

_STEADY = FromSection("Steady motions")
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
            "the disk is on edge at $\\theta = 0$; from its equation (6) on, and in its solution, "
            "$\\theta$ is the angle of axis $3$, as it is here."
        ),
        answers=(
            FromSection("Newton's law and the torque about the centre of mass"),
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
        claims=("w22", "w23", "w24", "42", "w25", "w26", "w27"),
    ),
)

QUESTIONS: Mapping[str, tuple[TextQuestion, ...]] = {
    "spinning-coin": _COIN,
    "rolling-disk": _DISK,
}

#: The route that the text asks for.
ROUTE: Mapping[str, str] = {"spinning-coin": "lagrange", "rolling-disk": "newton"}


def remarks_of(*systems: str) -> dict[str, Remark]:
    """Remarks on the problem set's claims about some systems of the catalogue, by their ids."""
    from polhode.claims import audit

    document = document_of(None)
    ids = [c.id for c in document.claims if document.part_of(c).system in systems]

    def equations_of(name: str) -> Equations:
        return derive(CATALOGUE[name].build())

    return remarks_on(document, audit(document, equations_of, only=ids), equations_of)
