"""Writing HTML: text is escaped unless it is already markup."""

from __future__ import annotations

import re
from collections.abc import Iterable
from html import escape

_LEVEL = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "−0123456789")
_VOID = frozenset({"br", "hr", "img", "link", "meta", "source"})


class Markup(str):
    """Text that is HTML already."""

    __slots__ = ()


def tag(name: str, /, *children: str, **attributes: str) -> Markup:
    """An element; a trailing underscore of an attribute is dropped, others become hyphens."""
    given = "".join(f' {_attribute(key)}="{escape(value)}"' for key, value in attributes.items())
    if name in _VOID:
        return Markup(f"<{name}{given}>")
    return Markup(f"<{name}{given}>{joined(children)}</{name}>")


def joined(parts: Iterable[str], between: str = "") -> Markup:
    """Several pieces one after the other."""
    return Markup(markup(between).join(markup(part) for part in parts))


def markup(text: str) -> Markup:
    """Text as HTML."""
    return text if isinstance(text, Markup) else Markup(escape(text, quote=False))


def raised(text: str) -> Markup:
    """Text whose raised figures are set by the page's own font, all of one height."""
    pieces = re.split("([⁻⁰¹²³⁴-⁹]+)", text)
    return joined(
        tag("sup", piece.translate(_LEVEL)) if i % 2 else piece for i, piece in enumerate(pieces)
    )


def table(header: Iterable[str], rows: Iterable[Iterable[str]], **attributes: str) -> Markup:
    """A table that scrolls sideways by itself where it is too wide."""
    head = tag("tr", *(tag("th", cell, scope="col") for cell in header))
    body = (tag("tr", *(tag("td", cell) for cell in row)) for row in rows)
    inner = tag("table", tag("thead", head), tag("tbody", *body), **attributes)
    return tag("div", inner, class_="wide")


def _attribute(key: str) -> str:
    return key.rstrip("_").replace("_", "-")
