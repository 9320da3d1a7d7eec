"""Whole numbers that count something."""

from __future__ import annotations

from numbers import Integral
from typing import Any

from polhode.base import DeclarationError

MOST = 1_000_000_000
"""Members that one study may have."""


def whole(value: Any, what: str, least: int = 1) -> int:
    """A whole number that counts something.

    Raises:
        DeclarationError: for anything else.
    """
    counts = isinstance(value, Integral) and not isinstance(value, bool)
    if not counts or not least <= value <= MOST:
        raise DeclarationError(
            f"{value!r} {what}", expected=f"a whole number from {least} to {MOST}"
        )
    return int(value)
