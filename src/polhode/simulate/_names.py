"""Names as people give them, and the quantities they stand for."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from difflib import get_close_matches
from typing import TypeVar

from polhode.algebra import Expr, Symbol, as_symbol
from polhode.base import DeclarationError

Quantity = TypeVar("Quantity")
Name = str | Symbol | Expr


def published(name: Name) -> str:
    """The published name of a quantity given by name, symbol or expression."""
    return name if isinstance(name, str) else as_symbol(name).published


def look_up(name: str, known: Mapping[str, Quantity], what: str) -> Quantity:
    """The quantity of that name.

    Raises:
        DeclarationError: for a name that is not known, with the nearest ones that are.
    """
    if name in known:
        return known[name]
    near = get_close_matches(name, known, n=3, cutoff=0.5)
    raise DeclarationError(
        f"{name!r} is no {what} of this system",
        expected=f"one of {', '.join(sorted(known))}" if known else "none: it has none",
        advice=f"did you mean {' or '.join(near)}?" if near else "",
    )


def by_name(symbols: Iterable[Symbol]) -> dict[str, Symbol]:
    """Symbols under their published names."""
    return {symbol.published: symbol for symbol in symbols}
