"""A figure that a notebook shows by itself, without pyplot and its list of open figures."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from polhode.view.figures._style import house_style

if TYPE_CHECKING:
    from matplotlib.backend_bases import RendererBase

_DOTS = 144  # of an inch


class ShownFigure(Figure):
    """A figure that a notebook shows where a cell ends with it."""

    @house_style()
    def draw(self, renderer: RendererBase) -> None:
        """Draw in the style of all figures, which ticks take on only as they are drawn."""
        super().draw(renderer)

    def _repr_png_(self) -> bytes:
        buffer = io.BytesIO()
        self.savefig(buffer, format="png", dpi=_DOTS)
        return buffer.getvalue()
