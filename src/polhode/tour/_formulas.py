"""Formulas of the page: MathML in pieces, between which a line may break."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from xml.etree import ElementTree

from polhode.algebra import Expr, Symbol
from polhode.tour._html import Markup, tag

_NAMESPACE = ' xmlns="http://www.w3.org/1998/Math/MathML"'
_SIGNS = ("+", "−", "-")
_FENCES = {"(": 1, "[": 1, ")": -1, "]": -1}


def equation(left: Expr, right: Expr, *, name: str = "") -> Markup:
    """A displayed equation; it wraps at plus and minus signs where it is too long for the page."""
    pieces = [*_pieces(left), *_pieces(right, after="=")]
    spoken = name or f"{left.pretty()} = {right.pretty()}"
    return tag("div", *pieces, class_="equation", role="math", aria_label=spoken)


def inline(expression: Expr) -> Markup:
    """A formula within text."""
    return _math(list(_row(expression)))


def listed(symbols: Iterable[Symbol]) -> Markup:
    """Symbols separated by commas."""
    from polhode.tour._html import joined

    return joined((inline(Expr.generator(symbol)) for symbol in symbols), ", ")


def _row(expression: Expr) -> ElementTree.Element:
    text = expression.mathml().replace(_NAMESPACE, "")
    root = ElementTree.fromstring(text)
    return root[0] if len(root) == 1 and root[0].tag == "mrow" else root


def _pieces(expression: Expr, after: str = "") -> Iterator[Markup]:
    """The formula cut before every sign that stands outside brackets."""
    lead = [_operator(after)] if after else []
    piece: list[ElementTree.Element] = lead
    depth = 0
    for element in _row(expression):
        text = (element.text or "").strip()
        depth += _FENCES.get(text, 0) if element.tag == "mo" else 0
        if element.tag == "mo" and text in _SIGNS and not depth and len(piece) > len(lead):
            yield _math(piece)
            piece, lead = [], []
            element = _operator(text)
        piece.append(element)
    yield _math(piece)


def _operator(sign: str) -> ElementTree.Element:
    """A sign that stands between two terms even where a line begins with it."""
    element = ElementTree.Element("mo", form="infix")
    element.text = sign
    return element


def _math(elements: list[ElementTree.Element]) -> Markup:
    inner = "".join(
        ElementTree.tostring(element, encoding="unicode", short_empty_elements=False)
        for element in elements
    )
    return Markup(f"<math><mrow>{inner}</mrow></math>")
