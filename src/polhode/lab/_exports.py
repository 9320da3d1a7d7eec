"""Files to take away: page, table, figure, movie."""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path

from polhode.lab._describe import plots_of, shown
from polhode.lab._system_session import Played
from polhode.view import figure_of_run, movie, origin_of, page_of, save_figure

_LONGEST = 6.0  # s of a movie
_SLOWEST = 0.1  # of the speed of the motion
_RATE = 12.0  # frames in a second of it


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
    movie(seen, path, speed=max(seen.duration / _LONGEST, _SLOWEST), rate=_RATE)


_WRITERS: Mapping[str, Callable[[Played, Path], None]] = {
    "csv": _table,
    "svg": _figure,
    "png": _figure,
    "gif": _movie,
    "mp4": _movie,
}
