"""What the page has to know of a system before anything is simulated."""

import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from polhode.algebra import Expr, Symbol
from polhode.catalogue import about_with
from polhode.lab._controls import parameters_of, start_of, unit_of
from polhode.lab._system_session import Played, Variant, declared_contact
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
)

_RATE = 30  # poses in a second of what follows a hand
_CONTACTS = ("rolling", "smooth", "friction")


def described(chosen: Variant, declared: Variant) -> dict[str, Any]:
    """Sliders, contacts and prescribed functions of a system, as plain data.

    Args:
        chosen: the system with the contacts that were asked for.
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
        "start": [asdict(c) for c in start_of(entry, equations)],
        "forcing": [
            {
                "name": symbol.published,
                "symbol": _letter(symbol.published),
                "text": entry.forcing.get(symbol.published, "0"),
                "unit": unit_of(symbol, equations),
            }
            for symbol in equations.functions
        ],
        "sheet": {"X", "Y"} <= {symbol.published for symbol in equations.functions},
    }


def seen(chosen: Variant, run: Trajectory) -> Scene:
    """What there is to look at."""
    return scenery(run, title=chosen.entry.title, about=about_with(chosen.entry, chosen.system))


def read(chosen: Variant, run: Trajectory) -> MotionSummary:
    """What there is to read, with the plots of the catalogue that it has."""
    return account(run, plots=plots_of(chosen, run), meanings=meanings_of(chosen))


def shown(chosen: Variant, run: Trajectory) -> Scene:
    """All there is to see, for a page of its own."""
    entry, plots = chosen.entry, plots_of(chosen, run)
    return scene(
        run,
        title=entry.title,
        about=about_with(entry, chosen.system),
        plots=plots,
        meanings=meanings_of(chosen),
    )


def meanings_of(chosen: Variant) -> dict[str, str]:
    """What parameters are, by name."""
    return {parameter.name: parameter.meaning for parameter in chosen.entry.parameters}


def followed(run: Trajectory) -> dict[str, Any]:
    """Where the bodies are, and no more, for a picture that follows a hand."""
    frames = 1 + max(1, round(_RATE * run.duration))
    return {"duration": run.duration, "frames": frames, "poses": poses(run, frames)}


def plots_of(chosen: Variant, run: Trajectory) -> Sequence[Sequence[str]]:
    """Groups of quantities worth plotting."""
    undetermined = chosen.equations.undetermined
    readable = [name for name in run.quantities if name not in undetermined]
    groups = [[n for n in group if n in readable] for group in chosen.entry.plots]
    coordinates = [symbol.published for symbol in run.equations.coordinates]
    speeds = [symbol.published for symbol in run.equations.speeds]
    usual = groups or [coordinates, speeds, list(run.reactions)]
    return [group for group in usual if group]


def outcome(run: Trajectory) -> list[dict[str, Any]]:
    """Every speed at the start and at the end."""
    names = [symbol.published for symbol in run.equations.speeds]
    begin, end = run.table(names, 0.0), run.table(names, run.duration)
    return [
        {"name": n, "symbol": _letter(n), "start": float(begin[n]), "end": float(end[n])}
        for n in names
    ]


def _letter(name: str) -> str:
    return Expr.generator(Symbol(name)).mathml()


# Files to take away: page, table, figure, movie.

_LONGEST = 6.0  # s of a movie
_SLOWEST = 0.1  # of the speed of the motion
_RATE_of_exports = 12.0  # frames in a second of it


def exported(kind: str, played: Played) -> bytes:
    """The bytes of a file of a motion.

    Raises:
        StoreError: where it cannot be made.
    """
    if kind == "page":
        return page_of(shown(played.variant, played.run)).encode("utf-8")
    return _through_a_file(kind, _WRITERS[kind], played)


def _through_a_file(kind: str, write: Callable[[Played, Path], None], played: Played) -> bytes:
    with tempfile.TemporaryDirectory(prefix="polhode-lab-") as folder:
        path = Path(folder) / f"motion.{kind}"
        write(played, path)
        return path.read_bytes()


def _table(played: Played, path: Path) -> None:
    played.run.to_csv(path)


def _figure(played: Played, path: Path) -> None:
    groups = plots_of(played.variant, played.run)
    save_figure(figure_of_run(played.run, groups), path, origin=origin_of(played.run))


def _movie(played: Played, path: Path) -> None:
    seen = shown(played.variant, played.run)
    movie(seen, path, speed=max(seen.duration / _LONGEST, _SLOWEST), rate=_RATE_of_exports)


_WRITERS: Mapping[str, Callable[[Played, Path], None]] = {
    "csv": _table,
    "svg": _figure,
    "png": _figure,
    "gif": _movie,
    "mp4": _movie,
}
