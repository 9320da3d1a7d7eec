"""Formulas as MathML in pieces, between which a line may break."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from polhode.algebra import Expr
from polhode.view._scene import Formula
from polhode.view._spacing import set_fractions_apart, set_functions_apart

_NAMESPACE = ' xmlns="http://www.w3.org/1998/Math/MathML"'
_SIGNS = ("+", "−", "-")
_RELATIONS = ("=", ">")
_REMEMBERED = 512  # formulas: a system is looked at again and again
_LONGEST = 2500  # letters of a formula that is still printed


@lru_cache(_REMEMBERED)
def symbol(expression: Expr) -> str:
    """One formula that does not break."""
    return expression.mathml().replace(_NAMESPACE, "")


@lru_cache(_REMEMBERED)
def equation(name: str, left: Expr, right: Expr) -> Formula:
    """left = right, which may break before every sign between two terms."""
    return _relation(name, left, "=", right)


def positive(expression: Expr) -> Formula:
    """expression > 0, which may break likewise."""
    return _relation("", expression, ">", Expr.of(0))


def alone(expression: Expr) -> Formula:
    """An expression by itself, which may break likewise."""
    spoken = expression.pretty()
    if len(spoken) > _LONGEST:
        return Formula("", (), f"… ({len(spoken):,} characters: too long to be read here)")
    return Formula("", tuple(_written(piece) for piece in _pieces(_row(expression))), spoken)


def _relation(name: str, left: Expr, sign: str, right: Expr) -> Formula:
    spoken = f"{left.pretty()} {sign} {right.pretty()}"
    if len(spoken) > _LONGEST:
        told = f"{left.pretty()} {sign} … ({len(spoken):,} characters: too long to be read here)"
        return Formula(name, (), told)
    row = [*_row(left), _leaf("mo", sign), *_row(right)]
    return Formula(name, tuple(_written(piece) for piece in _pieces(row)), spoken)


def _row(expression: Expr) -> list[Element]:
    root = ElementTree.fromstring(symbol(expression))
    set_functions_apart(root)
    set_fractions_apart(root)
    return list(root[0]) if len(root) == 1 and root[0].tag == "mrow" else list(root)


def _pieces(row: Sequence[Element]) -> Iterator[list[Element]]:
    """A row cut before what relates its sides and before every sign between two terms."""
    piece: list[Element] = []
    for element in row:
        is_sign = element.tag == "mo" and element.text in _SIGNS
        opens = not piece or (piece[-1].tag == "mo" and piece[-1].text in ("(", *_RELATIONS))
        if element.text in _RELATIONS or (is_sign and not opens):
            yield piece
            piece = [_leaf("mo", element.text or "", form="infix")]
        else:
            piece.append(element)
    yield piece


def _written(elements: Sequence[Element]) -> str:
    inner = "".join(
        ElementTree.tostring(element, encoding="unicode", short_empty_elements=False)
        for element in elements
    )
    return f'<math displaystyle="true"><mrow>{inner}</mrow></math>'


def _leaf(kind: str, text: str, **attributes: str) -> Element:
    element = Element(kind, attributes)
    element.text = text
    return element
