"""Figures: made in one style, shown by a notebook, written to files."""

from __future__ import annotations

import io
import json
from abc import ABC, abstractmethod
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, cast

from polhode.base import StoreError, write_whole
from polhode.simulate import Trajectory
from polhode.view._quantities import made_with
from polhode.view.figures._style import FAINT, INK, MUTED, RULES, WIDTH, house_style

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


@house_style()
def new_figure(height: float, width: float = WIDTH) -> Figure:
    """An empty figure of a size in inches."""
    # Imported here, since matplotlib is slow to import.
    from polhode.view.figures._shown import ShownFigure

    return ShownFigure(figsize=(width, height))


@house_style()
def axes_or_new(ax: Axes | None, height: float = 2.6) -> Axes:
    """The axes given, in the style of all figures, or those of a new figure."""
    if ax is not None:
        _dress(ax)
        return ax
    axes: Axes = new_figure(height).subplots()
    return axes


def _dress(axes: Axes) -> None:
    """Give axes that were made in another style the frame, ticks and fonts of all figures."""
    if axes.name != "rectilinear":
        return
    for side, spine in axes.spines.items():
        spine.set(color=MUTED, linewidth=RULES["axes.linewidth"])
        spine.set_visible(side in ("left", "bottom"))
    axes.tick_params(
        which="both",
        direction="out",
        width=RULES["xtick.major.width"],
        color=MUTED,
        labelcolor=INK,
        labelsize=RULES["font.size"],
        labelfontfamily=RULES["font.family"],
    )
    axes.tick_params(which="major", length=RULES["xtick.major.size"])
    axes.grid(visible=True, color=FAINT, linewidth=RULES["grid.linewidth"])
    axes.set_axisbelow(True)
    axes.margins(RULES["axes.xmargin"], RULES["axes.ymargin"])
    for text in (axes.xaxis.label, axes.yaxis.label):
        text.set(color=INK, fontsize=RULES["axes.labelsize"])
    numbers = (*axes.get_xticklabels(), *axes.get_yticklabels())  # those made by now
    for text in (axes.xaxis.label, axes.yaxis.label, axes.title, *numbers):
        text.set(fontfamily=RULES["font.family"], math_fontfamily=RULES["mathtext.fontset"])


# --- results of drawing, which a notebook shows as their figure ---


class InFigure(ABC):
    """Something drawn, which a notebook shows as its figure.

    In axes that the user made it is shown as text, since the notebook shows their figure anyway.
    """

    @property
    @abstractmethod
    def axes(self) -> Axes:
        """The axes it is drawn in."""

    @property
    def figure(self) -> Figure:
        """The figure it is in."""
        return cast("Figure", self.axes.get_figure(root=True))

    def _repr_png_(self) -> bytes | None:
        from polhode.view.figures._shown import ShownFigure

        figure = self.figure
        return figure._repr_png_() if isinstance(figure, ShownFigure) else None


class Drawn(InFigure, tuple[Any, ...]):
    """The artists that a function drew for its data, in some axes."""

    _axes: Axes

    def __new__(cls, axes: Axes, artists: Iterable[Artist]) -> Self:
        """Artists of some axes."""
        made = super().__new__(cls, tuple(artists))
        made._axes = axes
        return made

    @property
    def axes(self) -> Axes:
        """The axes they are drawn in."""
        return self._axes

    def __repr__(self) -> str:
        kinds = ", ".join(type(artist).__name__ for artist in self)
        return f"drawn: {kinds or 'nothing'}"


# --- files: written whole or not at all, the same bytes from the same picture ---

# Dates are left out, so that equal pictures are equal files.
_METADATA: dict[str, dict[str, Any]] = {
    ".svg": {"Date": None, "Creator": "polhode"},
    ".pdf": {"CreationDate": None, "Creator": "polhode", "Producer": "polhode"},
    ".png": {"Software": "polhode"},
}
_ABOUT = {".svg": "Description", ".pdf": "Subject", ".png": "Description"}


def origin_of(run: Trajectory) -> str:
    """Provenance of a picture of a run, as a JSON document."""
    return json.dumps(made_with(run), sort_keys=True)


def save_figure(figure: Figure, path: str | Path, *, origin: str = "") -> None:
    """Write a figure as SVG, PDF or PNG, by the ending of the file's name.

    A file already there is replaced only once the new one is complete.

    Args:
        figure: the figure.
        path: of the file.
        origin: its provenance, kept in the file; see `origin_of`.

    Raises:
        StoreError: for another ending, or where the file cannot be written.
    """
    target = Path(path)
    kind = target.suffix.lower()
    if kind not in _METADATA:
        raise StoreError(
            f"cannot write a figure as {target.name}",
            expected="a name that ends in .svg, .pdf or .png",
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
