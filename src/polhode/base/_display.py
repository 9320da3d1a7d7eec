"""Notebook display: objects ask for HTML, and a higher layer installs what renders it."""

from __future__ import annotations

from collections.abc import Callable

_RENDERERS: list[Callable[[object], str]] = []


def show_with(renderer: Callable[[object], str]) -> None:
    """Install what renders objects as HTML for a notebook."""
    _RENDERERS[:] = [renderer]


class Shown:
    """Something that a notebook shows as HTML where a renderer is installed, otherwise as text."""

    def _repr_html_(self) -> str | None:
        return _RENDERERS[0](self) if _RENDERERS else None
