"""File names whose endings say what is written to them."""

from __future__ import annotations

from pathlib import Path

from polhode.base import StoreError

PAGES = (".html", ".htm")
MOTIONS = (".h5", ".hdf5")


def refuse_other_endings(option: str, path: Path | None, endings: tuple[str, ...]) -> None:
    """Refuse a name that promises another kind of file; one without an ending promises nothing.

    Raises:
        StoreError: with the endings that there are.
    """
    if path is None or not path.suffix or path.suffix.lower() in endings:
        return
    first = endings[0]
    raise StoreError(
        f"{option} {path}: no {path.suffix} is written there",
        expected=f"a name that ends in {' or '.join(endings)}",
        advice=f"say {option} {path.with_suffix(first)}",
    )
