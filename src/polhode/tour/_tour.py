"""Working through the whole catalogue, and the page of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from polhode.base import Progress, StoreError, write_whole
from polhode.catalogue import CATALOGUE
from polhode.tour._page import FIGURES, page
from polhode.tour._report import TourReport, row_of, text_of
from polhode.tour._work import Worked, work_through
from polhode.view.figures import for_dark_pages


def write_tour(
    directory: Path, progress: Progress, tell: Callable[[str], object] = lambda text: None
) -> TourReport:
    """Derive, check, run and draw every system of the catalogue, and write a page of it all.

    Args:
        directory: where `index.html` and its figures go; made if it is not there.
        progress: told of every system.
        tell: given the text of every system as it is done.

    Raises:
        StoreError: where the page cannot be written.
    """
    all_worked = []
    progress.begin("tour", len(CATALOGUE))
    try:
        for entry in CATALOGUE.values():
            all_worked.append(work_through(entry))
            tell(text_of(all_worked[-1]))
            progress.advance()
    finally:
        progress.finish()
    return TourReport(_written(directory, all_worked), tuple(map(row_of, all_worked)))


def _written(directory: Path, all_worked: list[Worked]) -> Path:
    figures = directory / FIGURES
    _make(figures)
    for name, svg in _pictures(all_worked):
        write_whole(figures / f"{name}.svg", svg.encode())
        write_whole(figures / f"{name}-dark.svg", for_dark_pages(svg).encode())
    target = directory / "index.html"
    write_whole(target, page(all_worked).encode())
    return target


def _pictures(all_worked: Iterable[Worked]) -> Iterable[tuple[str, str]]:
    return ((d.name, d.svg) for worked in all_worked for d in worked.drawings)


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StoreError(
            f"the folder {folder} cannot be made ({error.strerror})",
            expected="a place where a folder can be made",
        ) from error
