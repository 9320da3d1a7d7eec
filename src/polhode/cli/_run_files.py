"""The files of a run: a table of samples, a figure, a page, each whole or not there."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from pathlib import Path

from polhode.base import DeclarationError, StoreError
from polhode.catalogue import CatalogueEntry, audit, document_of
from polhode.simulate import Trajectory
from polhode.view import Judgement, figure_of_run, origin_of, page, save_figure

# The files of a run: a table of samples, a figure, a page, each whole or not there.


def write_run(folder: Path, entry: CatalogueEntry, trajectory: Trajectory) -> list[Path]:
    """Write the samples and a figure of a run into a folder, made if it is not there.

    Raises:
        StoreError: where a file cannot be written.
    """
    _make(folder)
    stem = entry.name.rpartition(":")[2].replace("/", "-")
    table, picture = folder / f"{stem}.csv", folder / f"{stem}.png"
    trajectory.to_csv(table)
    try:
        figure = figure_of_run(trajectory.rounded(), entry.plots or _everything(trajectory))
        save_figure(figure, picture, origin=origin_of(trajectory))
    except KeyboardInterrupt as interrupt:
        interrupt.add_note(f"kept {table}")
        raise
    return [table, picture]


def write_page(
    path: Path, entry: CatalogueEntry, about: str, trajectory: Trajectory, claims: Collection[str]
) -> Path:
    """Write a page that plays a run, with claims of the problem set judged, told by their ids.

    Args:
        about: what it is a run of, in a few sentences.

    Raises:
        StoreError: where the file cannot be written.
    """
    page(
        trajectory,
        path,
        title=entry.title,
        about=about,
        plots=entry.plots,
        meanings={parameter.name: parameter.meaning for parameter in entry.parameters},
        judgements=judgements_on(claims),
    )
    return path


def _everything(trajectory: Trajectory) -> Sequence[Sequence[str]]:
    equations = trajectory.equations
    groups = (
        [symbol.published for symbol in equations.coordinates],
        [symbol.published for symbol in equations.speeds],
        trajectory.reactions,
    )
    return [group for group in groups if group]


def _make(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StoreError(
            f"the folder {folder} cannot be made ({error.strerror})",
            expected="a place where a folder can be made",
            advice="give --out another one",
        ) from error


# What the problem set claims about a system, judged, for its page.


def claims_about(entry: CatalogueEntry) -> tuple[str, ...]:
    """Ids of the problem set's claims about a system.

    Raises:
        DeclarationError: where there are none.
    """
    found = tuple(claim.id for claim in document_of(None).about(entry.name))
    if not found:
        raise DeclarationError(
            f"--verdicts for {entry.name}, about which the problem set says nothing",
            expected="a system that its claims are about, such as rolling-disk",
            advice="judge your own with ph.check and give them to ph.page as judgements",
        )
    return found


def judgements_on(claims: Collection[str]) -> tuple[Judgement, ...]:
    """The verdicts on claims of the problem set with these ids, part by part."""
    parted = audit(only=claims).by_part() if claims else ()
    return tuple(Judgement.on(judged) for _, found in parted for judged in found)
