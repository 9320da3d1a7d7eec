"""What commands print: JSON documents, and text laid out for the terminal."""

from __future__ import annotations

import json
import math
import re
import shutil
import sys
import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any

from polhode.algebra import Expr
from polhode.base import PURE, NumericError, extra, provenance
from polhode.derive import Equations

SCHEMA = 3
"""Number of the layout of what the command line prints; that of saved files is their own."""


def print_document(content: Mapping[str, Any]) -> None:
    """Print one JSON document with the versions it was made with.

    Raises:
        NumericError: for a number that is not finite.
    """
    print(document(content))


def document(content: Mapping[str, Any]) -> str:
    """The text of a JSON document with the versions it was made with.

    Raises:
        NumericError: for a number that is not finite.
    """
    try:
        return json.dumps({**provenance(), **content, "schema": SCHEMA}, indent=2, allow_nan=False)
    except ValueError as error:
        raise NumericError("a result that is not finite", expected="finite numbers") from error


def printed_all(expressions: Sequence[Expr]) -> str:
    """Expressions as `sympy.srepr` text: of a single one, or a Tuple of several."""
    texts = [printed(expression)["sympy"] for expression in expressions]
    return texts[0] if len(texts) == 1 else f"Tuple({', '.join(texts)})"


def printed_by_name(values: Mapping[str, Any]) -> dict[str, Any]:
    """The same dictionary with `printed` applied to every expression, at any depth."""
    return {
        name: printed(value) if isinstance(value, Expr) else printed_by_name(value)
        for name, value in values.items()
    }


def printed(expression: Expr) -> dict[str, str]:
    """An expression as LaTeX and as `sympy.srepr` text in plain symbols.

    Raises:
        StoreError: where SymPy is not installed.
    """
    from polhode.algebra import to_sympy

    with extra("SymPy", "sympy"):
        from sympy import srepr
    return {"latex": expression.latex(), "sympy": srepr(to_sympy(expression))}


def warn_of_radians(given: Mapping[str, str], equations: Equations) -> None:
    """Warn of an angle without a unit that is more than a turn: were degrees meant?"""
    for symbol in equations.coordinates:
        text = given.get(symbol.published, "")
        with suppress(ValueError):  # a value with a unit, or a formula
            if abs(float(text)) > 2 * math.pi and equations.dimensions.get(symbol) == PURE:
                what = f"{symbol.published} = {text} is in radians; for degrees write {text}deg"
                print(f"polhode: warning: {what}", file=sys.stderr)


# -- text ------------------------------------------------------------------------------------------

_LABEL = 14  # width of the column of labels
_NARROWEST, WIDEST = 60, 100
_CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f]")


def wrapped(label: str, words: Iterable[str]) -> Iterator[str]:
    """A label and words beside it, wrapped to the terminal; no line breaks within a word."""
    width = min(max(shutil.get_terminal_size().columns, _NARROWEST), WIDEST)
    text = " ".join(word.replace(" ", "\N{NO-BREAK SPACE}") for word in words).rstrip(",")
    lines = textwrap.wrap(text, width - 2 - _LABEL, break_on_hyphens=False) or ["none"]
    for line, start in zip(lines, [label, *[""] * len(lines)], strict=False):
        yield f"  {start:<{_LABEL}}{line.replace(chr(0xA0), ' ')}"


def printable(text: str) -> str:
    """A text without control characters, which a document may have to make a terminal do things."""
    return _CONTROL.sub("\ufffd", text)


def in_one_line(text: str) -> str:
    """A text without line breaks, cut where it is wider than a terminal."""
    line = printable(" ".join(text.split()))
    return line if len(line) <= WIDEST else f"{line[: WIDEST - 3]}..."


def values(numbers: Mapping[str, float | str]) -> list[str]:
    """Items "name = value," of a list; texts are left as they are."""
    shown = {n: v if isinstance(v, str) else f"{v:.9g}" for n, v in numbers.items()}
    return [f"{name} = {value}," for name, value in shown.items()]


_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")
# A fraction with five digits or more above or below stands for a decimal number.
_LONG = r"(?<![\d.])(-?\d{5,}/\d+|-?\d+/\d{5,})"
_OF_LONG = re.compile(rf"(?P<times>(?<=\d) )?(sin|cos)([⁰¹²³⁴⁵⁶⁷⁸⁹]*)\({_LONG}\)")


def in_decimals(text: str) -> str:
    """Formulas with long fractions, and their sines and cosines, as decimal numbers.

    The sine of 80 degrees, for instance, cannot be written exactly in one line.
    """
    text = _OF_LONG.sub(_sine, text)
    return re.sub(_LONG, lambda found: f"{_ratio(found[1]):.10g}", text)


def _sine(found: re.Match[str]) -> str:
    times, name, power, ratio = found.groups()
    value = getattr(math, name)(_ratio(ratio)) ** int(power.translate(_SUPERSCRIPTS) or 1)
    return f"{'·' if times else ''}{value:.10g}"


def _ratio(text: str) -> float:
    above, below = text.split("/")
    return int(above) / int(below)
