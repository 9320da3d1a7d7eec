"""Formulas and numbers, as the tour's pages and its tables print them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from xml.etree.ElementTree import Element

from polhode.algebra import Expr, Symbol
from polhode.view import Markup, inline, joined, leaf, math, opened_equation, tag

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_LEVEL = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "−0123456789")
_WIDE = 40  # signs of a formula that may have to be scrolled, on a telephone


def equation(left: Expr, right: Expr) -> Markup:
    """A displayed equation; it wraps at plus and minus signs where it is too long for the page."""
    spoken = f"{left.pretty()} = {right.pretty()}"
    wide = {"tabindex": "0"} if len(spoken) > _WIDE else {}
    pieces = opened_equation(left, right)
    return tag("div", *pieces, class_="equation", role="math", aria_label=spoken, **wide)


def listed(symbols: Iterable[Symbol]) -> Markup:
    """Symbols separated by commas, none of which begins a line."""
    *others, last = (inline(Expr.generator(symbol)) for symbol in symbols)
    kept = (tag("span", symbol, ",", class_="keep") for symbol in others)
    return joined([*kept, last], " ")


def with_formulas(text: str) -> Markup:
    """Prose in which dotted letters are set as formulas."""
    pieces = re.split("(-?.\N{COMBINING DOT ABOVE})", text)
    return joined(_dotted(piece) if i % 2 else piece for i, piece in enumerate(pieces))


def _dotted(text: str) -> Markup:
    letter = Element("mover")
    letter.extend([leaf("mi", text[-2]), leaf("mo", "˙")])
    return math([leaf("mo", "−", form="prefix"), letter] if text[0] == "-" else [letter])


def power_of_ten(value: float, unit: str = "") -> str:
    """Two digits and a power of ten, such as 1.4 × 10⁻¹⁷ m; plain 0 for zero."""
    shown = scientific(f"{value:.1e}") if value else "0"
    return f"{shown} {unit}".strip()


def scientific(text: str) -> str:
    """Text in which numbers such as 1.4e-17 are set as 1.4 × 10⁻¹⁷."""
    return re.sub(
        r"(?<=\d)e([-+]?\d+)\b",
        lambda found: f" × 10{str(int(found[1])).translate(_RAISED)}",
        text,
    )


def raised(text: str) -> Markup:
    """Text whose raised figures are set by the page's own font, all of one height."""
    pieces = re.split("([⁻⁰¹²³⁴-⁹]+)", text)
    return joined(
        tag("sup", piece.translate(_LEVEL)) if i % 2 else piece for i, piece in enumerate(pieces)
    )
