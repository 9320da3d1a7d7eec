"""Working through one system: derive, check, simulate, draw."""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import dataclass

import polhode as ph
from polhode.analyse import Invariant, Invariants, invariants
from polhode.catalogue import CatalogueEntry, numbers_of
from polhode.derive import Equations
from polhode.simulate import Trajectory, simulate
from polhode.solution import Solution
from polhode.tour._checks import Check, displacement_balance, exact_checks, numeric_checks
from polhode.tour._motions import MOTIONS, ShownMotion, shown_motion
from polhode.tour._pictures import pictures_of
from polhode.view import Scene, scene
from polhode.view.figures import origin_of, svg_of


@dataclass(frozen=True)
class Drawing:
    """A picture as text of an SVG file.

    Attributes:
        name: of the file, without ending.
        caption: in a sentence or two.
        svg: the picture, for a light page.
    """

    name: str
    caption: str
    svg: str


@dataclass(frozen=True)
class Worked:
    """A system of the catalogue, worked through.

    Attributes:
        entry: the system.
        equations: derived anew.
        conserved: its integrals, each verified exactly.
        run: the default run.
        checks: all of them, passed or not.
        constraint_drift: largest distance of a centre of mass from the integral of its
            constrained velocity, or gap of a closed loop, m.
        drawings: of the run.
        scene: of the run, for the card of its problem.
        motions: that show the answers to its questions.
        solution: with the text's questions answered; None for a system it does not treat.
        seconds: computing time of all this.
    """

    entry: CatalogueEntry
    equations: Equations
    conserved: Invariants
    run: Trajectory
    checks: tuple[Check, ...]
    constraint_drift: float
    drawings: tuple[Drawing, ...]
    scene: Scene
    motions: tuple[ShownMotion, ...]
    seconds: float
    solution: Solution | None = None

    @property
    def passed(self) -> int:
        """Number of checks that hold."""
        return sum(check.passed for check in self.checks)

    @property
    def judged(self) -> int:
        """Formulas displayed in its solution, every one judged."""
        return 0 if self.solution is None else self.solution.judged


def work_through(entry: CatalogueEntry) -> Worked:
    """Derive, check, simulate and draw a system of the catalogue."""
    began = time.perf_counter()
    equations = ph.derive(entry.build())
    conserved = invariants(equations)
    run = default_run(entry, equations, conserved)
    travel = displacement_balance(run, equations)
    checks = (*exact_checks(equations), *numeric_checks(run, equations, travel))
    stem, origin = entry.name.replace("/", "-"), origin_of(run)
    drawings = tuple(
        Drawing(f"{stem}-{picture.name}", picture.caption, svg_of(picture.draw(run), origin=origin))
        for picture in pictures_of(entry)
    )
    shown = scene(run, title=entry.title)
    motions = tuple(shown_motion(entry, motion) for motion in MOTIONS.get(entry.name, ()))
    drift = max(travel.defect, run.drift.constraint)
    seconds = time.perf_counter() - began
    return Worked(
        entry, equations, conserved, run, checks, drift, drawings, shown, motions, seconds
    )


def meanings_of(entry: CatalogueEntry) -> dict[str, str]:
    """Of the parameters, in words."""
    return {parameter.name: parameter.meaning for parameter in entry.parameters}


def default_run(
    entry: CatalogueEntry, equations: Equations, conserved: Iterable[Invariant] = ()
) -> Trajectory:
    """The run of the catalogue's default numbers, with the drift of its integrals."""
    numbers = numbers_of(entry, equations)
    return simulate(
        equations,
        {**numbers.parameters},
        {**numbers.start},
        numbers.duration,
        forcing={**numbers.forcing},
        invariants={invariant.name: invariant.expression for invariant in conserved},
    )
