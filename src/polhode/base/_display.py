"""Notebook display: objects request HTML from a renderer that a higher layer installs."""

from __future__ import annotations

from collections.abc import Callable

_RENDERERS: list[Callable[[object], str]] = []


def show_with(renderer: Callable[[object], str]) -> None:
    """Install the function that renders objects as HTML for a notebook."""
    _RENDERERS[:] = [renderer]


class Shown:
    """Shown by a notebook as HTML if a renderer is installed, otherwise as text."""

    def _repr_html_(self) -> str | None:
        return _RENDERERS[0](self) if _RENDERERS else None
