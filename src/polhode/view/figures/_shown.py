"""A figure that a notebook shows by itself, without pyplot and its list of open figures."""

from __future__ import annotations

import io

from matplotlib.figure import Figure


class ShownFigure(Figure):
    """A figure that a notebook shows where a cell ends with it."""

    def _repr_png_(self) -> bytes:
        buffer = io.BytesIO()
        self.savefig(buffer, format="png", dpi=_DOTS)
        return buffer.getvalue()


_DOTS = 144  # of an inch
