"""The files of a run: a table of samples, a figure, a page. None is ever left half written."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path

from polhode.base import DeclarationError, StoreError
from polhode.catalogue import CatalogueEntry
from polhode.judge import audit, document_of, judgement_on
from polhode.simulate import Trajectory
from polhode.view import Judgement, figure_of_run, origin_of, page, save_figure

_LETTERS = {  # of options, where the declaration has them
    "mu": "coefficient of friction",
    "mu_static": "coefficient of static friction",
    "edge": "distance of the edge",
}


def write_run(
    folder: Path, entry: CatalogueEntry, trajectory: Trajectory, period: float | None = None
) -> list[Path]:
    """Write the samples and a figure of a run into a folder, made if it is not there.

    Args:
        period: T, s, where the figure shows quantities against t/T.

    Raises:
        StoreError: where a file cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise StoreError(
            f"the folder {folder} cannot be created ({error.strerror})",
            expected="a place that can be written to",
            advice="choose another folder with --out",
        ) from error
    stem = entry.name.rpartition(":")[2].replace("/", "-")
    table, picture = folder / f"{stem}.csv", folder / f"{stem}.png"
    trajectory.to_csv(table)
    try:
        figure = figure_of_run(trajectory.rounded(), entry.plots, period=period)
        save_figure(figure, picture, origin=origin_of(trajectory))
    except KeyboardInterrupt as interrupt:
        interrupt.add_note(f"kept {table}")
        raise
    return [table, picture]


def write_page(
    path: Path,
    entry: CatalogueEntry,
    about: str,
    trajectory: Trajectory,
    claims: Collection[str],
    written: Mapping[str, str] | None = None,
    duration: float | None = None,
    presets: Mapping[str, Mapping[str, float]] | None = None,
) -> Path:
    """Write a page that plays a run, with verdicts on claims of the problem set, given by id.

    Args:
        about: description of the system in a few sentences.
        written: of a live page, the parameters and start values as they were written.
        duration: of its motions, s.
        presets: further motions to choose from.

    Raises:
        DeclarationError: for a motion that no page can compute by itself.
        StoreError: where the file cannot be written.
    """
    page(
        trajectory,
        path,
        title=entry.title,
        about=about,
        plots=entry.plots,
        meanings=_LETTERS | {parameter.name: parameter.meaning for parameter in entry.parameters},
        judgements=judgements_on(claims),
        live=written is not None,
        written=written,
        duration=duration,
        presets=presets,
    )
    return path


# -- claims of the problem set, for the page -------------------------------------------------------


def claims_about(entry: CatalogueEntry) -> tuple[str, ...]:
    """Ids of the problem set's claims about a system.

    Raises:
        DeclarationError: if there are none.
    """
    found = tuple(claim.id for claim in document_of(None).about(entry.name))
    if not found:
        raise DeclarationError(
            f"--verdicts for {entry.name}: the problem set says nothing about it",
            expected="a system of the problem set, such as rolling-disk",
            advice="judge claims of your own with ph.check and pass them to ph.page as judgements",
        )
    return found


def judgements_on(claims: Collection[str]) -> tuple[Judgement, ...]:
    """The verdicts on claims of the problem set, given by id, part by part."""
    parted = audit(only=claims).by_part() if claims else ()
    return tuple(judgement_on(judged) for _, found in parted for judged in found)
