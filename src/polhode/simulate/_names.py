"""Published names, and the symbols they stand for."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TypeVar

from polhode.algebra import Expr, Symbol, as_symbol

Quantity = TypeVar("Quantity")
Name = str | Symbol | Expr


def published(name: Name) -> str:
    """The published name of a quantity given by name, symbol or expression."""
    return name if isinstance(name, str) else as_symbol(name).published


def by_name(symbols: Iterable[Symbol]) -> dict[str, Symbol]:
    """Symbols under their published names."""
    return {symbol.published: symbol for symbol in symbols}
