"""Paragraphs with formulas in them, cut into pieces for the writers."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from polhode.solution._solution import Step
from polhode.solution._tex_rows import is_long_in_a_sentence

_FORMULA = re.compile(r"\$([^$]*)\$([.,;:]?)")  # with the mark that follows it


def pieces(words: str) -> Iterator[tuple[bool, str]]:
    """Text and formulas in turn, each with whether it is a formula."""
    for i, piece in enumerate(words.split("$")):
        if piece:
            yield bool(i % 2), piece


def rendered(words: str, text: Callable[[str], str], formula: Callable[[str], str]) -> str:
    """Words with both kinds of pieces written by functions."""
    return "".join((formula if is_formula else text)(piece) for is_formula, piece in pieces(words))


def with_displays(
    words: str, inline: Callable[[str], str], display: Callable[[str, str], str]
) -> str:
    """Words whose long formulas are displayed, each with the mark that follows it.

    Args:
        words: of a paragraph.
        inline: writes words with short formulas in them.
        display: writes a long formula and the mark.
    """
    parts, start = list[str](), 0
    for found in _FORMULA.finditer(words):
        if is_long_in_a_sentence(found[1]):
            parts += [inline(words[start : found.start()]), display(found[1], found[2])]
            start = found.end() + (words[found.end() : found.end() + 1] == " ")
    return "".join([*parts, inline(words[start:])])


def paragraphs(steps: tuple[Step, ...]) -> Iterator[tuple[str, Step | None]]:
    """Paragraphs of words, each with the step whose formula follows."""
    for step in steps:
        yield step.words, step if step.latex else None
