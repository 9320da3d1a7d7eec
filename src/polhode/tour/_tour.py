"""Working through the whole catalogue, and the site of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path

from polhode.base import Progress, StoreError, write_whole
from polhode.catalogue import CATALOGUE
from polhode.tour._claims import judging
from polhode.tour._page import CARD, FIGURES, Problem, front_page, problem_page, problems
from polhode.tour._report import TourReport, row_of, text_of
from polhode.tour._sections import stem
from polhode.tour._work import Worked, work_through
from polhode.view import page, still
from polhode.view.figures import for_dark_pages

_POSED = 0.37  # of a run: when the picture of the front page is taken


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
    progress.begin("tour", len(CATALOGUE) + 1)
    try:
        with judging(only) as claims:
            _make(directory / FIGURES)
            for entry in CATALOGUE.values():
                all_worked.append(work_through(entry))
                _write_motion(directory, all_worked[-1])
                tell(text_of(all_worked[-1]))
                progress.advance()
            told = claims.result()
            found = problems(all_worked, told)
            progress.advance()
    finally:
        progress.finish()
    return TourReport(_written(directory, found), tuple(map(row_of, all_worked)), told)


def _write_motion(directory: Path, worked: Worked) -> None:
    """Figures of a system and its page in three dimensions."""
    entry = worked.entry
    for name, svg in _pictures(worked):
        write_whole(directory / FIGURES / f"{name}.svg", svg.encode())
        write_whole(directory / FIGURES / f"{name}-dark.svg", for_dark_pages(svg).encode())
    page(
        worked.run,
        directory / f"{stem(entry.name)}-3d.html",
        title=entry.title,
        plots=entry.plots,
        meanings={parameter.name: parameter.meaning for parameter in entry.parameters},
    )


def _written(directory: Path, found: Sequence[Problem]) -> Path:
    for problem in found:
        run = problem.systems[0].run
        card = directory / FIGURES / f"{problem.name}-card.png"
        still(run, card, time=_POSED * run.duration, size=CARD)
        text = problem_page(problem, found)
        write_whole(directory / f"{problem.name}.html", text.encode())
    target = directory / "index.html"
    write_whole(target, front_page(found).encode())
    return target


def _pictures(worked: Worked) -> Iterator[tuple[str, str]]:
    return ((d.name, d.svg) for d in worked.drawings)


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StoreError(
            f"the folder {folder} cannot be made ({error.strerror})",
            expected="a place where a folder can be made",
        ) from error
