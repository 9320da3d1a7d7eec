"""Paragraphs with formulas in them, cut into pieces for the writers."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from polhode.solution._solution import Step


def pieces(words: str) -> Iterator[tuple[bool, str]]:
    """Text and formulas in turn, each with whether it is a formula."""
    for i, piece in enumerate(words.split("$")):
        if piece:
            yield bool(i % 2), piece


def rendered(words: str, text: Callable[[str], str], formula: Callable[[str], str]) -> str:
    """Words with both kinds of pieces written by functions."""
    return "".join((formula if is_formula else text)(piece) for is_formula, piece in pieces(words))


def paragraphs(steps: tuple[Step, ...]) -> Iterator[tuple[str, Step | None]]:
    """Paragraphs of words, each with the step whose formula follows."""
    for step in steps:
        yield step.words, step if step.latex else None
