"""What is known under a name, and the nearest names where nothing is."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches
from typing import TypeVar

from polhode.base._errors import DeclarationError

Known = TypeVar("Known")


def look_up(name: str, known: Mapping[str, Known], what: str) -> Known:
    """What is known under a name.

    Raises:
        DeclarationError: for a name that is not known, with the nearest ones that are.
    """
    if name in known:
        return known[name]
    near = get_close_matches(name, known, n=3, cutoff=0.5)
    raise DeclarationError(
        f"{name!r} is no {what}",
        expected=f"one of {', '.join(known)}" if known else "none: it has none",
        advice=f"did you mean {' or '.join(near)}?" if near else "",
    )
