"""Words of the text around its formulas, told from the formulas by their dollar signs."""

from __future__ import annotations

import re

_DOLLARS = re.compile(r"\$\$?")
_LINE_END = re.compile(r"\\n(?![a-z])")  # as a transcript spells it
_MATHEMATICS = re.compile(r"[\\^_=<>]")
_WORD = re.compile(r"[A-Za-z]{2}")
_NUMBER = re.compile(r"\(([0-9]{1,4})\)[\s.,]*\Z")


def prose_of(source: str) -> dict[int, int]:
    """Where each stretch of words begins and ends.

    Outside the dollar signs is prose, unless it holds signs of mathematics: transcripts lose
    dollar signs. Without any, all is mathematics.
    """
    edges = [0, *(place for match in _DOLLARS.finditer(source) for place in match.span())]
    outside = zip(edges[::4], [*edges[1::4], len(source)], strict=False)
    stretches = {start: end for start, end in outside if _is_prose(source[start:end])}
    return stretches if len(edges) > 1 else {}


def split_number(prose: str) -> tuple[str, str]:
    """The words of a stretch and the equation number in brackets at its end, "" for none."""
    words = " ".join(_LINE_END.sub(" ", prose).split())
    number = _NUMBER.search(words)
    before = words[: number.start()] if number else words
    return before.strip(" .,;:"), number[1] if number else ""


def _is_prose(stretch: str) -> bool:
    bare = _LINE_END.sub(" ", stretch)
    return bool(_WORD.search(bare)) and not _MATHEMATICS.search(bare)
