"""Formulas of the page: MathML in pieces, between which a line may break."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from polhode.algebra import Expr, Symbol
from polhode.tour._html import Markup, joined, tag

_NAMESPACE = ' xmlns="http://www.w3.org/1998/Math/MathML"'
_SIGNS = ("+", "−", "-")
_FUNCTIONS = ("sin", "cos", "tan", "exp", "sinh", "cosh", "tanh")
_WIDE = 40  # signs of a formula that may have to be scrolled, on a telephone
_LONG = 36  # letters, figures and signs in a bracket or fraction that may be broken


def equation(left: Expr, right: Expr) -> Markup:
    """A displayed equation; it wraps at plus and minus signs where it is too long for the page."""
    row = [*_row(left), _sign("="), *_row(right)]
    spoken = f"{left.pretty()} = {right.pretty()}"
    pieces = (_math(piece, displaystyle="true") for piece in _pieces(list(_opened(row))))
    wide = {"tabindex": "0"} if len(spoken) > _WIDE else {}
    return tag("div", *pieces, class_="equation", role="math", aria_label=spoken, **wide)


def inline(expression: Expr) -> Markup:
    """A formula within text."""
    return _math(_row(expression))


def listed(symbols: Iterable[Symbol]) -> Markup:
    """Symbols separated by commas, none of which begins a line."""
    first, *others = (inline(Expr.generator(symbol)) for symbol in reversed(list(symbols)))
    kept = (tag("span", symbol, ",", class_="keep") for symbol in reversed(others))
    return joined([*kept, first], " ")


def with_formulas(text: str) -> Markup:
    """Prose in which dotted letters are set as formulas."""
    pieces = re.split("(-?.\N{COMBINING DOT ABOVE})", text)
    return joined(_dotted(piece) if i % 2 else piece for i, piece in enumerate(pieces))


def _dotted(text: str) -> Markup:
    letter = Element("mover")
    letter.extend([_leaf("mi", text[-2]), _leaf("mo", "˙")])
    return _math([_leaf("mo", "−", form="prefix"), letter] if text[0] == "-" else [letter])


def _row(expression: Expr) -> list[Element]:
    root = ElementTree.fromstring(expression.mathml().replace(_NAMESPACE, ""))
    for row in [*root.iter("math"), *root.iter("mrow")]:
        _set_functions_apart(row)
    return list(root[0]) if len(root) == 1 and root[0].tag == "mrow" else list(root)


def _set_functions_apart(row: Element) -> None:
    """A thin space around the name of a function, as in 2 sin θ."""
    for i in reversed([i for i, element in enumerate(row) if _is_function(element)]):
        if i + 1 < len(row) and row[i + 1].tag in ("mi", "mover", "msub", "mfrac", "mn"):
            row.insert(i + 1, Element("mspace", width="0.17em"))
        if i and row[i - 1].tag != "mo":
            row.insert(i, Element("mspace", width="0.17em"))


def _is_function(element: Element) -> bool:
    """Whether it is sin, or sin² and the like."""
    name = element[0] if element.tag == "msup" else element
    return name.tag == "mi" and name.text in _FUNCTIONS


def _opened(row: Iterable[Element]) -> Iterator[Element]:
    """Long brackets as their contents, and long fractions as a factor and a bracket."""
    for element in row:
        if element.tag == "mrow" and _length(element) > _LONG:
            yield from _opened(element)
        elif element.tag == "mfrac" and _length(element[0]) > _LONG:
            yield from _opened_fraction(*element)
        else:
            yield element


def _opened_fraction(above: Element, below: Element) -> Iterator[Element]:
    factor = Element("mfrac")
    factor.extend([_leaf("mn", "1"), below])
    yield factor
    yield _leaf("mo", "(", fence="true", form="prefix")
    yield from _opened(above if above.tag == "mrow" else [above])
    yield _leaf("mo", ")", fence="true", form="postfix")


def _length(element: Element) -> int:
    return sum(not len(part) for part in element.iter())


def _pieces(row: Sequence[Element]) -> Iterator[list[Element]]:
    """A row cut before every equals sign and every sign between two terms."""
    piece: list[Element] = []
    for element in row:
        if element.text == "=" or (_is_sign(element) and piece and not _opens(piece[-1])):
            yield piece
            piece = [_sign(element.text or "")]
        else:
            piece.append(element)
    yield piece


def _is_sign(element: Element) -> bool:
    return element.tag == "mo" and element.text in _SIGNS


def _opens(element: Element) -> bool:
    """Whether a sign after this one belongs to what follows."""
    return element.tag == "mo" and element.text in ("(", "[", "=")


def _sign(text: str) -> Element:
    """A sign that stands between two terms even where a line begins with it."""
    return _leaf("mo", text, form="infix")


def _leaf(kind: str, text: str, **attributes: str) -> Element:
    element = Element(kind, attributes)
    element.text = text
    return element


def _math(elements: Iterable[Element], **attributes: str) -> Markup:
    inner = "".join(
        ElementTree.tostring(element, encoding="unicode", short_empty_elements=False)
        for element in elements
    )
    return tag("math", tag("mrow", Markup(inner)), **attributes)
