"""The formulas of reStructuredText: the directive ``math`` and the role of that name."""

from __future__ import annotations

import re
from collections.abc import Iterator

from polhode.judge.source._macros import Macro
from polhode.judge.source._placed import PlacedText
from polhode.judge.source._scan import SourceFormula

_LINE = re.compile(r"[^\n]*\n?")
_DIRECTIVE = re.compile(r"([ \t]*)\.\.[ \t]+(?:[a-z]+:)?([A-Za-z-]+)::[ \t]*([^\n]*)")
_OPTION = re.compile(r"\s*:[a-zA-Z-]+:")
_ROLE = re.compile(r":math:`((?:[^`\\]|\\.)*)`", re.DOTALL)
_UNDERLINE = re.compile(r"([=\-~^\"'`#*+:._<>])\1{2,}[ \t]*\n?\Z")
#: Directives whose content is prose.
_PROSE = {
    "admonition", "note", "warning", "tip", "important", "hint", "topic", "container", "figure",
    "sidebar", "todo", "dropdown", "attention", "caution", "danger", "list-table", "table",
}  # fmt: skip


def restructured_formulas(text: PlacedText, macros: dict[str, Macro]) -> Iterator[SourceFormula]:
    """Displays and formulas in a line, in order; literal blocks and code are passed over."""
    return _Reader(text, macros).formulas()


class _Reader:
    """Goes through the lines of one text."""

    def __init__(self, text: PlacedText, macros: dict[str, Macro]) -> None:
        self._text = text
        self._macros = macros
        self._spans = [m.span() for m in _LINE.finditer(text.text) if m[0]]
        self._at = 0
        self._styles: list[str] = []
        self._headings: list[str] = []

    def formulas(self) -> Iterator[SourceFormula]:
        prose: list[int] = []  # lines whose roles wait to be read, as they may run over lines
        while self._at < len(self._spans):
            line = self._line(self._at)
            directive = _DIRECTIVE.match(line)
            if directive or line.rstrip().endswith("::"):
                yield from self._roles(prose)
                prose = []
            if directive:
                yield from self._directive(directive)
                continue
            prose.append(self._at)
            self._at += 1
            if line.rstrip().endswith("::"):
                yield from self._roles(prose)
                prose = []
                self._skip_block(_indent(line))
            elif self._take_heading(line):
                yield from self._roles(prose[:-2])
                prose = []
        yield from self._roles(prose)

    def _directive(self, match: re.Match[str]) -> Iterator[SourceFormula]:
        start, indent, name = self._at, len(match[1].expandtabs()), match[2]
        self._at += 1
        if name in _PROSE:
            return
        self._skip_block(indent)
        if name == "math":
            yield from self._displays(start, self._spans[start][0] + match.start(3))

    def _displays(self, first: int, argument: int) -> Iterator[SourceFormula]:
        """The content of the directive; blank lines separate several displays."""
        start = argument
        line = first
        while line < self._at:
            begin, end = self._spans[line]
            text = self._text.text[max(begin, argument) : end]
            if line > first and (_OPTION.match(text) or not text.strip()):
                yield from self._formula(start, begin)
                start = end
            line += 1
        yield from self._formula(start, self._spans[self._at - 1][1])

    def _formula(self, start: int, end: int) -> Iterator[SourceFormula]:
        if self._text.text[start:end].strip():
            yield SourceFormula(self._text[start:end], True, tuple(self._headings), self._macros)

    def _roles(self, lines: list[int]) -> Iterator[SourceFormula]:
        if not lines:
            return
        start, end = self._spans[lines[0]][0], self._spans[lines[-1]][1]
        for match in _ROLE.finditer(self._text.text, start, end):
            yield SourceFormula(
                self._text[match.start(1) : match.end(1)],
                False,
                tuple(self._headings),
                self._macros,
            )

    def _skip_block(self, indent: int) -> None:
        """Pass over blank lines and those that stand further in."""
        last = self._at
        while self._at < len(self._spans):
            line = self._line(self._at)
            if line.strip() and _indent(line) <= indent:
                break
            self._at += 1
            if line.strip():
                last = self._at
        self._at = last

    def _take_heading(self, line: str) -> bool:
        """Note a heading where its underline is the next line."""
        if not line.strip() or self._at >= len(self._spans) or line.startswith((" ", "\t")):
            return False
        underline = self._line(self._at)
        match = _UNDERLINE.match(underline)
        if not match or _UNDERLINE.match(line) or len(underline.strip()) < len(line.strip()) - 2:
            return False
        self._at += 1
        if match[1] not in self._styles:
            self._styles.append(match[1])
        del self._headings[self._styles.index(match[1]) :]
        self._headings.append(line.strip())
        return True

    def _line(self, number: int) -> str:
        return self._text.text[slice(*self._spans[number])]


def _indent(line: str) -> int:
    expanded = line.expandtabs()
    return len(expanded) - len(expanded.lstrip(" "))
