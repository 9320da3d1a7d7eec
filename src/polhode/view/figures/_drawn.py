"""What was drawn in a figure, which a notebook shows as the figure."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Self, cast

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


class InFigure(ABC):
    """Something drawn that a notebook shows as the figure it is in.

    One in axes of the user's own is shown as text: whoever made the axes shows their figure.
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
    """What a function drew: the artists that stand for its data, in some axes."""

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
