"""Working through the whole catalogue, and the site of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from polhode.base import Progress, StoreError, write_whole
from polhode.catalogue import CATALOGUE
from polhode.tour._claims import Told, judging
from polhode.tour._page import CARD, FIGURES, Problem, front_page, problem_page, problems
from polhode.tour._report import TourReport, row_of, text_of
from polhode.tour._sections import stem
from polhode.tour._work import Drawing, Worked, work_through
from polhode.view import page_of, still, telling_time
from polhode.view.figures import for_dark_pages


def write_tour(
    directory: Path,
    progress: Progress,
    tell: Callable[[str], object] = lambda text: None,
    *,
    only: Iterable[str] = (),
) -> TourReport:
    """Derive, check, run and draw every system of the catalogue, and write a site of it all.

    The problem set's claims are judged meanwhile, in a process of their own.

    Args:
        directory: where `index.html` and all else goes; made if it is not there.
        progress: told of every system.
        tell: given the text of every system as it is done.
        only: ids of the claims to judge; all of them if empty.

    Raises:
        StoreError: where a page cannot be written.
    """
    all_worked = []
    _make(directory / FIGURES)
    progress.begin("tour", len(CATALOGUE) + 1)
    try:
        with judging(only) as verdicts:
            for entry in CATALOGUE.values():
                all_worked.append(work_through(entry))
                _write_figures(directory, all_worked[-1])
                tell(text_of(all_worked[-1]))
                progress.advance()
            told = verdicts()
            found = problems(all_worked, told)
            progress.advance()
    finally:
        progress.finish()
    return TourReport(_written(directory, found), tuple(map(row_of, all_worked)), told)


def _write_figures(directory: Path, worked: Worked) -> None:
    for drawing in worked.drawings:
        for name, svg in ((drawing.name, drawing.svg), _dark(drawing)):
            write_whole(directory / FIGURES / f"{name}.svg", svg.encode())


def _dark(drawing: Drawing) -> tuple[str, str]:
    return f"{drawing.name}-dark", for_dark_pages(drawing.svg)


def _written(directory: Path, found: Sequence[Problem]) -> Path:
    for problem in found:
        shown = problem.systems[0].scene
        card = directory / FIGURES / f"{problem.name}-card.png"
        still(shown, card, time=telling_time(shown), size=CARD)
        for worked in problem.systems:
            _write_motion(directory, worked, problem.claims)
        text = problem_page(problem, found)
        write_whole(directory / f"{problem.name}.html", text.encode())
    target = directory / "index.html"
    write_whole(target, front_page(found).encode())
    return target


def _write_motion(directory: Path, worked: Worked, claims: Iterable[Told]) -> None:
    """The page of a system in three dimensions, with the verdicts on what is claimed of it."""
    name = worked.entry.name
    own = tuple(claim.judgement for claim in claims if claim.system == name)
    text = page_of(replace(worked.scene, judgements=own))
    write_whole(directory / f"{stem(name)}-3d.html", text.encode())


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StoreError(
            f"the folder {folder} cannot be made ({error.strerror})",
            expected="a place where a folder can be made",
        ) from error
