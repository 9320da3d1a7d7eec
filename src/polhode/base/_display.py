"""Things that show themselves in a notebook: they only ask; a room above says how."""

from __future__ import annotations

from collections.abc import Callable

_RENDERERS: list[Callable[[object], str]] = []


def show_with(renderer: Callable[[object], str]) -> None:
    """Choose what turns things into HTML where a notebook shows them."""
    _RENDERERS[:] = [renderer]


class Shown:
    """Something that a notebook shows as HTML, where a renderer was chosen, and else as text."""

    def _repr_html_(self) -> str | None:
        return _RENDERERS[0](self) if _RENDERERS else None
