"""A document in pieces, words and formulas in turn, for those who show it."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass

from polhode.base import ParseError
from polhode.judge.source._formats import FORMATS, hidden, plain_formulas
from polhode.judge.source._macros import Macro, Macros, expanded
from polhode.judge.source._notebook import markdown_cells
from polhode.judge.source._placed import Lines, PlacedText
from polhode.judge.source._scan import SourceFormula


@dataclass(frozen=True)
class SourceWords:
    """What stands between two formulas, comments and listings blanked out.

    Attributes:
        text: as in the source, with its markup; delimiters of formulas may stand at its ends.
    """

    text: str


@dataclass(frozen=True)
class ShownFormula:
    """A formula of a document.

    Attributes:
        latex: what stands between its delimiters.
        begin: line and column where that begins.
        end: line and column behind it.
        is_display: whether it stands on lines of its own.
        macros: those that the text has defined up to there.
    """

    latex: str
    begin: tuple[int, int]
    end: tuple[int, int]
    is_display: bool
    macros: Macros

    def expanded(self, latex: str) -> str:
        """A part of the formula with its macros expanded; as it is if they cannot be."""
        with suppress(ParseError):
            return expanded(PlacedText.of(latex), self.macros).text
        return latex


def read_pieces(
    text: str, format: str = ".tex", macros: dict[str, Macro] | None = None
) -> Iterator[SourceWords | ShownFormula]:
    """A document in pieces, in order; files that it includes are not read.

    Args:
        text: the whole text.
        format: the ending of its file name.
        macros: those known before it begins; it adds its own.

    Raises:
        ParseError: for a damaged notebook.
    """
    known = {} if macros is None else macros
    lines = Lines(text)
    if format != ".ipynb":
        yield from _pieces_of(PlacedText.of(text), format, lines, known)
        return
    for cell in markdown_cells(text):
        yield from _pieces_of(cell, ".md", lines, known)
        yield SourceWords("\n\n")


def _pieces_of(
    text: PlacedText, format: str, lines: Lines, macros: dict[str, Macro]
) -> Iterator[SourceWords | ShownFormula]:
    plain = hidden(text, format)
    behind = 0
    for formula in FORMATS.get(format, plain_formulas)(text, macros):
        if not isinstance(formula, SourceFormula) or not len(formula.text):
            continue
        start = bisect_left(text.places, formula.text.places[0])
        end = bisect_left(text.places, formula.text.end)
        yield SourceWords(plain.text[behind:start])
        yield ShownFormula(
            formula.text.text,
            lines.place(formula.text.places[0]),
            lines.place(formula.text.end),
            formula.is_display,
            formula.macros,
        )
        behind = end
    yield SourceWords(plain.text[behind:])
