"""Documents of exercises: a page, LaTeX and PDF, Markdown and a notebook."""

from __future__ import annotations

import base64
import json
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from html import escape
from importlib.resources import files
from pathlib import Path
from typing import Any
from urllib.parse import quote

from polhode.base import StoreError, provenance, write_whole
from polhode.catalogue import CATALOGUE
from polhode.exercise._quantities import unit_latex, unit_printed
from polhode.exercise._question import LETTERS
from polhode.exercise._sheet import SheetBlock
from polhode.solution import (
    TEX_PREAMBLE,
    compiled_tex,
    display_tex,
    item_tex,
    paragraph_tex,
    rendered,
    tikz_colours,
    words_tex,
)
from polhode.view import Markup, document, styled, tag, typeset

_PREAMBLE = TEX_PREAMBLE + r"\setlength{\parindent}{0pt}\setlength{\parskip}{6pt}"


def write_document(
    blocks: Sequence[SheetBlock], path: str | Path, title: str, systems: Iterable[str], seed: int
) -> tuple[Path, ...]:
    """Write a document by the ending of its name; returns all files that were written.

    Args:
        blocks: of the document.
        path: ends in one of `EXERCISE_FILES`.
        title: of the window.
        systems: that it is about, for the review of what is written into it.
        seed: of its numbers.

    Raises:
        StoreError: for another ending, without LaTeX for .pdf, and where it cannot be written.
    """
    target = Path(path)
    ending = target.suffix.lower()
    if ending not in EXERCISE_FILES:
        raise StoreError(
            f"an exercise as {target.name}",
            expected=f"a name that ends in {', '.join(EXERCISE_FILES)}",
            advice=f"for instance {target.with_suffix('.html')}",
        )
    pictures: list[Path] = []
    if ending == ".md":
        blocks = list(_with_picture_files(blocks, target, pictures))
    writer = tex_of if ending == ".pdf" else _WRITERS[ending]
    text = writer(blocks, title, tuple(dict.fromkeys(systems)), seed)
    write_whole(target, compiled_tex(text, {}) if ending == ".pdf" else text.encode("utf-8"))
    return (target, *pictures)


def _with_picture_files(
    blocks: Iterable[SheetBlock], target: Path, written: list[Path]
) -> Iterator[SheetBlock]:
    """Blocks whose figures stand in files beside a Markdown document."""
    for block in blocks:
        if block.figure is None:
            yield block
            continue
        name = re.sub(r"\W+", "-", Path(block.picture).name).strip("-")
        picture = target.with_name(f"{target.stem}-{name}.svg")
        write_whole(picture, block.figure.svg_file().encode("utf-8"))
        written.append(picture)
        yield SheetBlock(f"![{block.figure.title}]({quote(picture.name)})")
        yield SheetBlock(f"*{block.words}*")


# -- Markdown and notebooks ------------------------------------------------------------------------


def _named(systems: Sequence[str]) -> tuple[str, ...]:
    """The one system of a document, if it is of the catalogue: documents name no files."""
    return tuple(systems) if len(systems) == 1 and systems[0] in CATALOGUE else ()


def markdown_of(blocks: Iterable[SheetBlock], title: str, systems: Sequence[str], seed: int) -> str:
    """Markdown; figures, which need files of their own, are left out."""
    head = [f"<!-- polhode: {name} -->" for name in _named(systems)]
    return "\n\n".join([*head, *(filter(None, map(_markdown, blocks)))]) + "\n"


def _markdown(block: SheetBlock) -> str:
    if block.level:
        return f"{'#' * block.level} {block.words}"
    if block.figure is not None:
        return ""
    if block.blank:
        unit = f" {unit_printed(block.unit)}" if block.unit else ""
        return f"{block.blank}: {block.words} ______{unit}"
    if block.options:
        pairs = zip(LETTERS, block.options, strict=False)
        return "\n".join(f"- ({letter}) {option}" for letter, option in pairs)
    number = rf" \tag{{{block.number}}}" if block.number else ""
    formula = f"$$\n{block.latex}{number}\n$$" if block.latex else ""
    return "\n\n".join(filter(None, [block.words, formula]))


def notebook_of(blocks: Iterable[SheetBlock], title: str, systems: Sequence[str], seed: int) -> str:
    """A notebook (nbformat 4.5): a cell for each section; figures are attached to theirs."""
    cells: list[_Cell] = [_Cell()]
    for block in blocks:
        if block.level or block.blank:
            cells.append(_Cell())
        cells[-1].add(block)
    filled = [cell for cell in cells if cell.parts]
    notebook = {
        "cells": [cell.to_json(i) for i, cell in enumerate(filled)],
        "metadata": {"polhode": {**provenance(seed), "systems": list(systems)}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"


class _Cell:
    """A Markdown cell with the figures that it shows."""

    def __init__(self) -> None:
        self.parts: list[str] = []
        self.pictures: dict[str, dict[str, str]] = {}

    def add(self, block: SheetBlock) -> None:
        """Append a block."""
        if block.figure is None:
            self.parts += filter(None, [_markdown(block)])
            return
        name = f"figure-{len(self.pictures) + 1}.png"
        data = base64.b64encode(block.figure.png()).decode("ascii")
        self.pictures[name] = {"image/png": data}
        self.parts += [f"![{block.figure.title}](attachment:{name})", f"*{block.words}*"]

    def to_json(self, number: int) -> dict[str, Any]:
        """As it stands in a notebook."""
        attached = {"attachments": self.pictures} if self.pictures else {}
        return {
            "cell_type": "markdown",
            "id": f"part-{number}",
            "metadata": {},
            **attached,
            "source": "\n\n".join(self.parts).splitlines(keepends=True),
        }


# -- LaTeX -----------------------------------------------------------------------------------------


def tex_of(blocks: Iterable[SheetBlock], title: str, systems: Sequence[str], seed: int) -> str:
    """A LaTeX document; figures are drawn with TikZ."""
    named = [f"% polhode: {name}" for name in _named(systems)]
    lines = [*named, _PREAMBLE, tikz_colours(), r"\begin{document}"]
    for block in blocks:
        lines += [r"\clearpage"] if block.begins_page else []
        lines += _tex(block)
    return "\n".join([*lines, r"\end{document}"]) + "\n"


def _tex(block: SheetBlock) -> list[str]:
    words = words_tex(block.words)
    if block.level:
        command = ("section*", "subsection*", "subsubsection*")[min(block.level, 3) - 1]
        return [rf"\{command}{{{words}}}"]
    if block.figure is not None:
        caption = rf"{{\small {words}}}"
        return [r"\begin{center}", block.figure.tikz(), "", caption, r"\end{center}"]
    if block.blank:
        unit = f"${unit_latex(block.unit)}$" if block.unit else ""
        return [rf"\textbf{{{block.blank}}}: {words} \underline{{\hspace{{6cm}}}} {unit}", ""]
    if block.options:
        pairs = zip(LETTERS, block.options, strict=False)
        rows = [rf"\item[({letter})] {item_tex(option)}" for letter, option in pairs]
        return [r"\begin{description}", *rows, r"\end{description}"]
    number = rf" \tag{{{block.number}}}" if block.number else ""
    formula = display_tex(block.latex, number, star="*") if block.latex else ""
    return [paragraph_tex(block.words), formula]


# -- pages -----------------------------------------------------------------------------------------


def page_of_exercise(
    blocks: Iterable[SheetBlock], title: str, systems: Sequence[str], seed: int
) -> str:
    """One self-contained page without scripts, to be read or printed."""
    style = files("polhode.exercise").joinpath("exercise.css").read_text("utf-8")
    made = json.dumps({**provenance(seed), "systems": list(systems)})
    data = tag("meta", name="polhode", content=made)
    body = tag("main", *map(_html, blocks))
    return document(title, styled(style), body, head=(data,))


def _html(block: SheetBlock) -> Markup:
    words = _html_words(block.words)
    page = {"class_": "page"} if block.begins_page else {}
    if block.level:
        return tag(f"h{min(block.level, 3)}", words, **page)
    if block.figure is not None:
        return tag("figure", Markup(block.figure.svg()), tag("figcaption", words))
    if block.blank:
        unit = f" {unit_printed(block.unit)}" if block.unit else ""
        line = tag("span", class_="blank")
        return tag("p", tag("b", block.blank), " ", words, " ", line, unit, class_="answer")
    if block.options:
        rows = zip(LETTERS, block.options, strict=False)
        named = [(f"({k})", tag("span", _large(_html_words(o)))) for k, o in rows]
        items = [tag("li", tag("span", letter), option) for letter, option in named]
        return tag("ul", *items, class_="options")
    paragraph = tag("p", words) if block.words else Markup()
    return Markup(paragraph + _html_formula(block)) if block.latex else paragraph


def _large(words: Markup) -> Markup:
    """Formulas in words with fractions as large as in a display."""
    return Markup(words.replace("<math", '<math displaystyle="true"'))


def _html_formula(block: SheetBlock) -> Markup:
    formula = typeset(block.latex).replace("<math", '<math display="block"', 1)
    number = tag("span", f"({block.number})") if block.number else Markup()
    return tag("div", tag("div", Markup(formula)), number, class_="formula")


def _html_words(words: str) -> Markup:
    return Markup(rendered(words, lambda piece: escape(piece, quote=False), typeset))


_Writer = Callable[[Sequence[SheetBlock], str, Sequence[str], int], str]
_WRITERS: dict[str, _Writer] = {
    ".html": page_of_exercise,
    ".tex": tex_of,
    ".md": markdown_of,
    ".ipynb": notebook_of,
}
#: Endings of the files that can be written.
EXERCISE_FILES = (*_WRITERS, ".pdf")
