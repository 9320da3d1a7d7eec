"""Layout of what is printed for people."""

from __future__ import annotations

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
