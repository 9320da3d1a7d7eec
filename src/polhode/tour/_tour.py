"""The whole catalogue worked through, and written as a site."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from polhode.base import Progress, StoreError, write_whole
from polhode.catalogue import PROBLEM_SET
from polhode.solution import answered_solution, questions_of
from polhode.tour._claims import JudgedClaim, judging
from polhode.tour._page import CARD, FIGURES, Problem, front_page, problem_page, problems
from polhode.tour._report import TourReport, row_of, text_of
from polhode.tour._sections import stem
from polhode.tour._work import Worked, meanings_of, work_through
from polhode.view import clearest_time, page, still
from polhode.view.figures import for_dark_pages


def write_tour(
    directory: Path,
    progress: Progress,
    tell: Callable[[str], object] = lambda text: None,
    *,
    only: Iterable[str] = (),
) -> TourReport:
    """Derive, check, run and draw every system of the problem set, and write it up as a site.

    The problem set's claims are judged in a worker process at the same time.

    Args:
        directory: for `index.html` and all other files; created if necessary.
        progress: called for every system.
        tell: called with the text of every finished system.
        only: ids of the claims to judge; all of them if empty.

    Raises:
        StoreError: where a page cannot be written.
    """
    all_worked = []
    try:
        (directory / FIGURES).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StoreError(
            f"the folder {directory / FIGURES} cannot be created ({error.strerror})",
            expected="a place that can be written to",
            advice="choose another folder",
        ) from error
    progress.begin("tour", len(PROBLEM_SET) + 2)
    try:
        with judging(only) as judged:
            for entry in PROBLEM_SET.values():
                worked = work_through(entry)
                all_worked.append(worked)
                for drawing in worked.drawings:
                    file = directory / FIGURES / f"{drawing.name}.svg"
                    write_whole(file, drawing.svg.encode())
                    dark = file.with_name(f"{drawing.name}-dark.svg")
                    write_whole(dark, for_dark_pages(drawing.svg).encode())
                _write_motions(directory, worked)
                tell(text_of(worked))
                progress.advance()
            verdicts = judged()
            progress.advance()
        all_worked = [_solved(worked, verdicts) for worked in all_worked]
        progress.advance()
    finally:
        progress.finish()
    front = _write_pages(directory, problems(all_worked, verdicts))
    return TourReport(front, tuple(map(row_of, all_worked)), verdicts)


def _write_motions(directory: Path, worked: Worked) -> None:
    """The pictures and the live pages of the motions that show answers."""
    for motion in worked.motions:
        name = f"{stem(worked.entry.name)}-{motion.motion.name}"
        write_whole(directory / FIGURES / f"{name}.svg", motion.svg.encode())
        dark = directory / FIGURES / f"{name}-dark.svg"
        write_whole(dark, for_dark_pages(motion.svg).encode())
        entry, asked = worked.entry, motion.motion
        page(
            motion.run,
            directory / f"{name}-3d.html",
            title=f"{entry.title}: {asked.title}",
            plots=asked.plots,
            meanings=meanings_of(entry),
            live=True,
            written={**entry.defaults, **asked.settings, **asked.start},
        )


def _solved(worked: Worked, verdicts: Iterable[JudgedClaim]) -> Worked:
    """With its solution, if the text asks about it."""
    name = worked.entry.name
    if not questions_of(name):
        return worked
    remarks = {c.id: c.remark for c in verdicts if c.system == name and c.remark is not None}
    return replace(worked, solution=answered_solution(name, remarks=remarks))


def _write_pages(directory: Path, all_problems: Sequence[Problem]) -> Path:
    for problem in all_problems:
        shown = problem.systems[0].scene
        card = directory / FIGURES / f"{problem.name}-card.png"
        still(shown, card, time=clearest_time(shown), size=CARD)
        for worked in problem.systems:
            # the live page, with verdicts on the claims about the system
            name = worked.entry.name
            own = tuple(claim.judgement for claim in problem.claims if claim.system == name)
            entry = worked.entry
            page(
                worked.run,
                directory / f"{stem(name)}-3d.html",
                title=entry.title,
                plots=entry.plots,
                meanings=meanings_of(entry),
                judgements=own,
                live=True,
                written={**entry.defaults, **entry.start},
            )
        whole = problem_page(problem, all_problems)
        write_whole(directory / f"{problem.name}.html", whole.encode())
    front = directory / "index.html"
    write_whole(front, front_page(all_problems).encode())
    return front
