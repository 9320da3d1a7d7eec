"""Slips that people make in formulas, as changes of the text."""

from __future__ import annotations

import re
from collections.abc import Iterator

from polhode.solution import breaks

_NUMBER = re.compile(r"(?<![\d^_{.])(?<!_\{)\d+(?![\d}.])")


def slips(text: str) -> Iterator[str]:
    """Slips that people make: a sign, a factor, sine for cosine, a square left out."""
    for place in breaks(text):
        sign = text[place + 1]
        if sign in "+-":
            yield f"{text[: place + 1]}{'-' if sign == '+' else '+'}{text[place + 2 :]}"
    for found in _NUMBER.finditer(text):
        for near in (int(found[0]) + 1, int(found[0]) - 1):
            if near > 1:
                yield f"{text[: found.start()]}{near}{text[found.end() :]}"
    for one, other in (("sin", "cos"), ("cos", "sin")):
        for found in re.finditer(rf"\\{one}(?![a-z])", text):
            yield f"{text[: found.start()]}\\{other}{text[found.end() :]}"
    for found in re.finditer(r"(?<=sin|cos)\^2", text):
        yield f"{text[: found.start()]}{text[found.end() :]}"
