"""Space between the pieces of a formula in MathML, which browsers leave to whoever writes it."""

from __future__ import annotations

from xml.etree.ElementTree import Element

_FUNCTIONS = ("sin", "cos", "tan", "exp", "sinh", "cosh", "tanh")
_ROWS = ("math", "mrow", "msqrt", "mstyle", "mtd")  # whose pieces stand side by side
_THIN = "0.17em"


def set_functions_apart(formula: Element) -> None:
    """A thin space around the names of functions, as in 2 sin θ."""
    for row in [*formula.iter("math"), *formula.iter("mrow")]:
        _set_apart(row)


def set_fractions_apart(formula: Element) -> None:
    """A thin space between two fractions, whose bars would else be drawn as one."""
    for row in formula.iter():
        for i in reversed(range(1, len(row))):
            if row.tag in _ROWS and row[i].tag == row[i - 1].tag == "mfrac":
                row.insert(i, Element("mspace", width=_THIN))


def _set_apart(row: Element) -> None:
    for i in reversed([i for i, element in enumerate(row) if _is_function(element)]):
        if i + 1 < len(row) and row[i + 1].tag != "mo":
            row.insert(i + 1, Element("mspace", width=_THIN))
        if i and row[i - 1].tag != "mo":
            row.insert(i, Element("mspace", width=_THIN))


def _is_function(element: Element) -> bool:
    """Whether it is sin, or sin² and the like."""
    name = element[0] if element.tag == "msup" else element
    return name.tag == "mi" and name.text in _FUNCTIONS
