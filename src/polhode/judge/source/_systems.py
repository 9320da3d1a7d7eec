"""Systems of equations: rows of relations within one brace or bracket."""

from __future__ import annotations

from dataclasses import dataclass

from polhode.base import ParseError
from polhode.judge.source._placed import PlacedText
from polhode.judge.source._signs import BRACKET, is_sign


@dataclass
class _Bracket:
    """A bracket that is open, and what has stood in it so far."""

    marks: list[tuple[int, int]]
    is_first: bool  # in its row: nothing relates it to something before
    is_environment: bool = False
    braces: int = 0  # that are open around it
    signs: int = 0
    rows: int = 0  # that follow a sign
    related_rows: int = 0  # signs behind such a row

    def end_row(self, is_outermost: bool) -> None:
        """Count a line break; in the outermost rows a relation begins anew."""
        self.rows += self.signs > 0
        if is_outermost:
            self.signs = 0


def without_systems(display: PlacedText) -> PlacedText:
    r"""Without the brace or brackets around a system of equations, and its ``array``.

    Raises:
        ParseError: for rows of equations in a bracket that is part of a formula.
    """
    open_ = [_Bracket([], True)]
    dropped: list[tuple[int, int]] = []
    braces = 0
    for match in BRACKET.finditer(display.text):
        kind, around = match.lastgroup or "", open_[-1]
        braces += (match[0] == "{") - (match[0] == "}")
        if kind in ("left", "begin"):
            is_first = around.is_first and not around.signs
            open_.append(_Bracket([match.span()], is_first, kind == "begin", braces))
        elif kind in ("right", "end") and len(open_) > 1:
            _close(open_, match.span(), dropped)
        elif kind == "row":
            around.end_row(is_outermost=len(open_) == 1)
        elif braces <= around.braces and is_sign(match[0], kind):
            around.signs += 1
            around.related_rows += around.rows > 0
    text = list(display.text)
    for start, end in dropped:
        text[start:end] = " " * (end - start)
    return display.with_text("".join(text))


def _close(open_: list[_Bracket], closer: tuple[int, int], dropped: list[tuple[int, int]]) -> None:
    """Close the innermost bracket; one around a system is dropped, with what is right around it."""
    inner = open_.pop()
    inner.marks.append(closer)
    around = open_[-1]
    if not inner.related_rows:
        return
    if inner.is_first:
        dropped += inner.marks
        around.signs += inner.signs
        around.rows += inner.rows
        around.related_rows += inner.related_rows
    elif not inner.is_environment:
        raise ParseError(
            "rows of equations in brackets", expected="a bracket around one quantity or relation"
        )
