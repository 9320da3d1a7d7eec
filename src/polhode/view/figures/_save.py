"""Figures as files: written whole or not at all, the same bytes from the same picture."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

from polhode.base import StoreError, provenance, write_whole
from polhode.simulate import Trajectory
from polhode.view.figures._style import house_style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

# Dates are left out, so that equal pictures are equal files.
_METADATA: dict[str, dict[str, Any]] = {
    ".svg": {"Date": None, "Creator": "polhode"},
    ".pdf": {"CreationDate": None, "Creator": "polhode", "Producer": "polhode"},
    ".png": {"Software": "polhode"},
}
_ABOUT = {".svg": "Description", ".pdf": "Subject", ".png": "Description"}


def origin_of(run: Trajectory) -> str:
    """What a picture of a run was made with, as a JSON document."""
    told = {
        "system": run.equations.system.name,
        "mode": run.mode,
        "parameters": dict(run.parameters),
        "assumed": dict(run.assumed),
        "integrator": run.integrator,
    }
    return json.dumps({**provenance(), **told}, sort_keys=True)


def save_figure(figure: Figure, path: str | Path, *, origin: str = "") -> None:
    """Write a figure as SVG, PDF or PNG, by the ending of the file's name.

    A file already there is replaced only once the new one is complete.

    Args:
        figure: the figure.
        path: of the file.
        origin: what it was made with, kept in the file; see `origin_of`.

    Raises:
        StoreError: for another ending, or where the file cannot be written.
    """
    target = Path(path)
    kind = target.suffix.lower()
    if kind not in _METADATA:
        raise StoreError(
            f"a figure as {target.name}", expected="a name that ends in .svg, .pdf or .png"
        )
    write_whole(target, _rendered(figure, kind, origin))


def svg_of(figure: Figure, *, origin: str = "") -> str:
    """A figure as the text of an SVG file."""
    return _rendered(figure, ".svg", origin).decode("utf-8")


def _rendered(figure: Figure, kind: str, origin: str) -> bytes:
    from matplotlib import rc_context

    metadata = _METADATA[kind] | ({_ABOUT[kind]: origin} if origin else {})
    buffer = io.BytesIO()
    with house_style(), rc_context({"svg.hashsalt": "polhode"}):
        figure.savefig(buffer, format=kind[1:], metadata=metadata)
    return buffer.getvalue()
