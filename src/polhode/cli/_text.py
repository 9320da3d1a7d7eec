"""Layout of what is printed for people."""

from __future__ import annotations

import math
import re
import shutil
import textwrap
from collections.abc import Iterable, Iterator, Mapping

_LABEL = 14  # width of the column of labels
_NARROWEST, _WIDEST = 60, 100


def wrapped(label: str, words: Iterable[str], indent: str = "  ") -> Iterator[str]:
    """A label and words beside it, wrapped to the terminal; words with blanks stay whole."""
    width = min(max(shutil.get_terminal_size().columns, _NARROWEST), _WIDEST)
    text = " ".join(word.replace(" ", "\N{NO-BREAK SPACE}") for word in words).rstrip(",")
    lines = textwrap.wrap(text, width - len(indent) - _LABEL, break_on_hyphens=False) or ["none"]
    for line, start in zip(lines, [label, *[""] * len(lines)], strict=False):
        yield f"{indent}{start:<{_LABEL}}{line.replace(chr(0xA0), ' ')}"


def values(numbers: Mapping[str, float | str]) -> list[str]:
    """Names with their values, each to be followed by another; texts as they are."""
    shown = {n: v if isinstance(v, str) else f"{v:.9g}" for n, v in numbers.items()}
    return [f"{name} = {value}," for name, value in shown.items()]


_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹", "0123456789")
_LONG = r"(-?\d{5,}/\d+|-?\d+/\d{5,})"  # a ratio that stands for a decimal number
_OF_LONG = re.compile(rf"(sin|cos)([⁰¹²³⁴⁵⁶⁷⁸⁹]*)\({_LONG}\)")


def in_decimals(text: str) -> str:
    """Formulas with long ratios, and sines and cosines of them, as decimal numbers.

    An angle of 80 degrees has no sine that could be written exactly in a line.
    """
    text = _OF_LONG.sub(_sine, text)
    return re.sub(_LONG, lambda found: f"{_ratio(found[1]):.10g}", text)


def _sine(found: re.Match[str]) -> str:
    name, power, ratio = found.groups()
    value = getattr(math, name)(_ratio(ratio)) ** int(power.translate(_SUPERSCRIPTS) or 1)
    return f"{value:.10g}"


def _ratio(text: str) -> float:
    above, below = text.split("/")
    return int(above) / int(below)
