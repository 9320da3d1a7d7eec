"""The formats of documents, and the formulas of each."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from polhode.judge.source._macros import Macro
from polhode.judge.source._notebook import markdown_cells
from polhode.judge.source._placed import PlacedText
from polhode.judge.source._restructured import restructured_formulas
from polhode.judge.source._scan import Inclusion, Scanner, SourceFormula
from polhode.judge.source._typst import typst_formulas, without_comments

Found = Iterator[SourceFormula | Inclusion]

_HIDDEN = re.compile(  # comments and listings, whichever begins first
    r"(?:(?<!\\)|(?<=(?<!\\)\\\\))%[^\n]*"
    r"|\\begin\s*\{(verbatim\*?|Verbatim|lstlisting|minted|comment|tikzpicture|filecontents\*?"
    r"|algorithmic|algorithm)\}.*?\\end\s*\{\1\}"
    r"|\\(?:verb|lstinline)\*?(?:\{[^{}\n]*\}|([^A-Za-z\s*{])(?:(?!\2)[^\n])*\2)"
    r"|\\iffalse\b.*?\\fi\b",
    re.DOTALL,
)
_FENCED = re.compile(
    r"^(?P<indent>[ \t>]*)(?P<fence>```+|~~~+)(?![ \t]*\{?math\b)[^\n]*\n.*?"
    r"(?:^[ \t>]*(?P=fence)[`~]*[ \t]*$|\Z)",
    re.DOTALL | re.MULTILINE,
)
_CODE_SPAN = re.compile(r"(?<![`\\$])(`+)(?!`)(?:(?!\n[ \t]*\n).)+?(?<!`)\1(?!`)", re.DOTALL)
_INDENTED = re.compile(r"(?:(?<=\n\n)|\A)(?:(?: {4}|\t)[^\n]*\n?)+")
_MATH_BLOCK = re.compile(
    r"^[ \t>]*(?P<fence>```+)(?:math|\{math\})[^\n]*\n(?:[ \t>]*:[\w-]+:[^\n]*\n)*"
    r"(?P<body>.*?)^[ \t>]*(?P=fence)[ \t]*$",
    re.DOTALL | re.MULTILINE,
)
_MATH_SPAN = re.compile(r"\$`([^`\n]*)`\$")
_HTML = re.compile(r"<!--.*?-->|<(pre|code)\b.*?</\1>", re.DOTALL)
_ESCAPED = re.compile(r"^[ \t]*(\\)\\\[(?:[^\n]|\n(?![ \t]*\n))*?(\\)\\\]|(\\)\\[()]", re.MULTILINE)
_FRONT_MATTER = re.compile(
    r"\A---[ \t]*\n(?:[\w-]+:[^\n]*\n)(?:(?:[\w-]+:|[ \t#-])[^\n]*\n|\n)*?(?:---|\.\.\.)[ \t]*$",
    re.MULTILINE,
)
_QUOTATION = re.compile(r"(?:(?<=\n\n)|\A)(?:[ \t]*>[^\n]*(?:\n|\Z))+")
_QUOTE_MARKS = re.compile(r"^(?:[ \t]*>)+", re.MULTILINE)
_LEAN_COMMENT = re.compile(r"/-.*?-/|--[^\n]*", re.DOTALL)


def tex_formulas(text: PlacedText, macros: dict[str, Macro]) -> Found:
    """Those of LaTeX, without comments and listings."""
    plain = hidden(text, ".tex")
    end = re.search(r"\\end\s*\{document\}", plain.text)
    return Scanner(plain[: end.end()] if end else plain, macros).formulas()


def markdown_formulas(text: PlacedText, macros: dict[str, Macro]) -> Found:
    r"""Those of Markdown, without code; ``\\[`` is the same as ``\[``, and fences may hold one."""
    plain = text.with_text(_MATH_SPAN.sub(r"$ \1 $", _MATH_BLOCK.sub(_display, text.text)))
    plain = _without_indented_code(hidden(plain, ".md").masked(_CODE_SPAN))
    return Scanner(_unescaped(plain), macros).formulas()


def notebook_formulas(text: PlacedText, macros: dict[str, Macro]) -> Found:
    """Those of a notebook's cells of words; macros defined in one are known in the later ones."""
    for cell in markdown_cells(text.text):
        yield from markdown_formulas(cell, macros)


def lean_formulas(text: PlacedText, macros: dict[str, Macro]) -> Found:
    """Those of the comments of a Lean file."""
    blank = re.compile(r"[^\n]")
    parts: list[PlacedText] = []
    place = 0
    for match in _LEAN_COMMENT.finditer(text.text):
        parts += [text[place : match.start()].masked(blank), text[match.start() : match.end()]]
        place = match.end()
    parts.append(text[place:].masked(blank))
    return Scanner(PlacedText.joined(parts), macros).formulas()


def plain_formulas(text: PlacedText, macros: dict[str, Macro]) -> Found:
    """Those between dollar signs of any other text."""
    return Scanner(text, macros).formulas()


FORMATS: dict[str, Callable[[PlacedText, dict[str, Macro]], Found]] = {
    ".tex": tex_formulas,
    ".ltx": tex_formulas,
    ".latex": tex_formulas,
    ".md": markdown_formulas,
    ".markdown": markdown_formulas,
    ".ipynb": notebook_formulas,
    ".rst": restructured_formulas,
    ".lean": lean_formulas,
    ".typ": typst_formulas,
    ".txt": plain_formulas,
}


def hidden(text: PlacedText, format: str) -> PlacedText:
    """A text with blanks for what its readers do not see, or would see as a listing."""
    if format in (".tex", ".ltx", ".latex"):
        return text.masked(_HIDDEN)
    if format in (".md", ".markdown"):
        plain = text.masked(_FRONT_MATTER).masked(_FENCED).masked(_HTML)
        return plain.with_text(_QUOTATION.sub(_unquoted, plain.text))
    return without_comments(text) if format == ".typ" else text


def _unquoted(match: re.Match[str]) -> str:
    return _QUOTE_MARKS.sub(lambda marks: " " * len(marks[0]), match[0])


def _display(match: re.Match[str]) -> str:
    r"""A fenced block of mathematics as a display between ``\[`` and ``\]``, as long as before."""
    body = match["body"]
    head = re.sub(r"[^\n]", " ", match[0][: match.start("body") - match.start()])
    tail = match[0][match.end("body") - match.start() :]
    return rf"\[{head[2:]}{body}" + r"\]".ljust(len(tail))


def _unescaped(text: PlacedText) -> PlacedText:
    r"""With ``\[ \]`` for ``\\[ \\]`` where a line begins with it, and ``\( \)`` for ``\\( \\)``.

    Elsewhere ``\\[4pt]`` ends a row.
    """
    parts: list[PlacedText] = []
    place = 0
    for match in _ESCAPED.finditer(text.text):
        for group in (1, 2, 3):  # the backslashes that Markdown takes away
            if match[group]:
                parts.append(text[place : match.start(group)])
                place = match.end(group)
    return PlacedText.joined([*parts, text[place:]]) if parts else text


def _without_indented_code(text: PlacedText) -> PlacedText:
    """With blanks for indented code, which never contains a dollar sign that opens a formula."""

    def blanked(match: re.Match[str]) -> str:
        is_code = not re.search(r"\$|\\\[|\\begin", match[0])
        return re.sub(r"[^\n]", " ", match[0]) if is_code else match[0]

    return text.with_text(_INDENTED.sub(blanked, text.text))
