"""The content of the lab: controls of a system; picture, plots and files of a motion."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from polhode.algebra import Expr, Symbol
from polhode.catalogue import about_with
from polhode.lab._controls import parameters_of, start_of
from polhode.lab._system_session import Variant, VariantRun, declared_contact
from polhode.simulate import Trajectory
from polhode.view import (
    MotionSummary,
    Scene,
    account,
    figure_of_run,
    movie,
    origin_of,
    page_of,
    poses,
    save_figure,
    scene,
    scenery,
    state_unit,
)

_POSE_RATE = 30  # poses per second while a slider or the sheet is dragged
_LONGEST = 6.0  # s of a movie
_SLOWEST = 0.1  # of the speed of the motion
_MOVIE_RATE = 12.0  # frames per second of a movie
_CONTACTS = ("rolling", "smooth", "friction")


def description_of(chosen: Variant, declared: Variant) -> dict[str, Any]:
    """Sliders, contacts and prescribed functions of a system, as plain data.

    Args:
        chosen: the system with the requested contacts.
        declared: as it is declared.
    """
    entry, equations = chosen.entry, chosen.equations
    contact = declared_contact(declared.system)
    return {
        "name": entry.name,
        "title": entry.title,
        "about": about_with(entry, chosen.system),
        "contact": declared_contact(chosen.system),
        "declared": contact,
        "contacts": list(_CONTACTS) if contact else [],
        "duration": entry.duration,
        "parameters": [asdict(c) for c in parameters_of(entry, equations)],
        "start": [asdict(c) for c in start_of(entry, chosen.at_start)],
        "forcing": [
            {
                "name": symbol.published,
                "symbol": _letter(symbol.published),
                "text": entry.forcing.get(symbol.published, "0"),
                "unit": state_unit(symbol, equations),
            }
            for symbol in equations.functions
        ],
        "sheet": {"X", "Y"} <= {symbol.published for symbol in equations.functions},
    }


def picture_of(chosen: Variant, run: Trajectory) -> Scene:
    """The picture of a motion."""
    return scenery(run, title=chosen.entry.title, about=about_with(chosen.entry, chosen.system))


def summary_of(chosen: Variant, run: Trajectory) -> MotionSummary:
    """The text and plots of a motion, with the catalogue's plots that apply to it."""
    return account(run, plots=plots_of(chosen, run), meanings=meanings_of(chosen))


def scene_of(chosen: Variant, run: Trajectory) -> Scene:
    """Picture, text and plots of a motion, for a page of its own."""
    entry, plots = chosen.entry, plots_of(chosen, run)
    return scene(
        run,
        title=entry.title,
        about=about_with(entry, chosen.system),
        plots=plots,
        meanings=meanings_of(chosen),
    )


def meanings_of(chosen: Variant) -> dict[str, str]:
    """Meanings of the parameters, by name."""
    return {parameter.name: parameter.meaning for parameter in chosen.entry.parameters}


def poses_of(run: Trajectory) -> dict[str, Any]:
    """Only the poses of the bodies, for a picture that is updated while the user drags."""
    frames = 1 + max(1, round(_POSE_RATE * run.duration))
    return {"duration": run.duration, "frames": frames, "poses": poses(run, frames)}


def plots_of(chosen: Variant, run: Trajectory) -> Sequence[Sequence[str]]:
    """Groups of quantities worth plotting; none where the usual ones are to be shown."""
    undetermined = chosen.equations.undetermined
    readable = [name for name in run.quantities if name not in undetermined]
    groups = [[n for n in group if n in readable] for group in chosen.entry.plots]
    return [group for group in groups if group]


def speeds_at_ends(run: Trajectory) -> list[dict[str, Any]]:
    """Every speed at the start and at the end."""
    names = [symbol.published for symbol in run.equations.speeds]
    begin, end = run.table(names, 0.0), run.table(names, run.duration)
    return [
        {"name": n, "symbol": _letter(n), "start": float(begin[n]), "end": float(end[n])}
        for n in names
    ]


def _letter(name: str) -> str:
    return Expr.generator(Symbol(name)).mathml()


# -- files -----------------------------------------------------------------------------------------


def exported(kind: str, motion: VariantRun) -> bytes:
    """The content of a file of a motion.

    Raises:
        StoreError: where the file cannot be made.
    """
    if kind == "page":
        return page_of(scene_of(motion.variant, motion.run)).encode("utf-8")
    with tempfile.TemporaryDirectory(prefix="polhode-lab-") as folder:
        path = Path(folder) / f"motion.{kind}"
        _WRITERS[kind](motion, path)
        return path.read_bytes()


def _figure(motion: VariantRun, path: Path) -> None:
    groups = plots_of(motion.variant, motion.run)
    save_figure(figure_of_run(motion.run, groups), path, origin=origin_of(motion.run))


def _movie(motion: VariantRun, path: Path) -> None:
    whole = scene_of(motion.variant, motion.run)
    movie(whole, path, speed=max(whole.duration / _LONGEST, _SLOWEST), rate=_MOVIE_RATE)


_WRITERS: Mapping[str, Callable[[VariantRun, Path], None]] = {
    "csv": lambda motion, path: motion.run.to_csv(path),
    "svg": _figure,
    "png": _figure,
    "gif": _movie,
    "mp4": _movie,
}
