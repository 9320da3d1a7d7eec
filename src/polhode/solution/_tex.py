"""A worked solution as LaTeX source, and compiled to PDF where LaTeX is installed."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from polhode.base import StoreError
from polhode.solution._figure import Figure, tikz_colours
from polhode.solution._motion import motion_file
from polhode.solution._solution import MOTION, Solution, Step
from polhode.solution._tex_rows import WIDE, rows_of, width
from polhode.solution._tex_words import text_tex
from polhode.solution._words import paragraphs, rendered, with_displays

_SECONDS = 120  # for LaTeX, which takes a few
#: What a document needs for paragraphs, displays and figures.
TEX_PREAMBLE = r"""\documentclass[11pt]{article}
\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}
\usepackage{textcomp}
\usepackage{amsmath}
\usepackage[margin=25mm]{geometry}
\usepackage{lmodern}
\usepackage{graphicx}
\usepackage{tikz}
\usetikzlibrary{arrows.meta}
\allowdisplaybreaks
% Words move apart where the only way to break a line is before a formula.
\emergencystretch=0.2\textwidth
% What cannot be broken and is too wide is made smaller.
\newsavebox{\formula}
\newcommand{\fitted}[1]{\sbox{\formula}{$\displaystyle #1$}%
  \ifdim\wd\formula>0.92\linewidth\resizebox{0.92\linewidth}{!}{\usebox{\formula}}%
  \else\usebox{\formula}\fi}
"""


def tex_of_solution(solution: Solution, motion: str = "") -> str:
    """A LaTeX document; equations are numbered as in the other formats.

    Args:
        solution: to be written.
        motion: name of the file with the figure of a motion; without it that is left out.
    """
    colours = tikz_colours() if solution.figure else ""
    lines = [TEX_PREAMBLE + colours, rf"\title{{{text_tex(solution.title)}}}", r"\author{}\date{}"]
    lines += [r"\begin{document}", r"\maketitle"]
    if solution.figure:
        lines += _figure(solution.figure)
    for section, steps in solution.sections.items():
        if section != MOTION or (motion and solution.example):
            lines += [rf"\section*{{{words_tex(section)}}}", *_section(steps)]
        if section == MOTION and motion and solution.example:
            lines.append(
                rf"\begin{{center}}\includegraphics[width=0.85\linewidth]{{{motion}}}\end{{center}}"
            )
    lines.append(r"\end{document}")
    return "\n".join(lines) + "\n"


def words_tex(words: str) -> str:
    """Words with formulas in them, as in a heading."""
    return rendered(words, text_tex, lambda latex: f"${latex}$")


def paragraph_tex(words: str) -> str:
    """Words of a paragraph; formulas too long for a line of it are displayed."""

    def displayed(latex: str, mark: str) -> str:
        return f"\n{display_tex(latex, mark, star='*')}\n"

    return with_displays(words, words_tex, displayed)


def item_tex(words: str) -> str:
    """Words of an item of a list, with formulas as large as in a display and in rows where long."""
    return rendered(words, text_tex, _formula_of_item)


def _formula_of_item(latex: str) -> str:
    rows = [rf"\fitted{{{row}}}" if width(row) > WIDE else row for row in rows_of(latex)]
    if len(rows) == 1:
        return rf"$\displaystyle {rows[0]}$"
    body = r" \\ &\qquad ".join(rows)
    return rf"$\begin{{aligned}}[t] &{body} \end{{aligned}}$"


def _figure(figure: Figure) -> tuple[str, ...]:
    caption = rf"{{\small {text_tex(figure.caption)}}}"
    return (r"\begin{center}", figure.tikz(), r"\par\smallskip", caption, r"\end{center}")


def _section(steps: tuple[Step, ...]) -> Iterator[str]:
    for words, step in paragraphs(steps):
        if words:
            yield paragraph_tex(words)
            if step is None:  # a blank line ends the paragraph
                yield ""
        if step is not None:
            yield display_tex(step.latex)


def display_tex(latex: str, after: str = "", star: str = "") -> str:
    """A formula on lines of its own, and what follows there; a star leaves out its number."""
    rows = [rf"\fitted{{{row}}}" if width(row) > WIDE else row for row in rows_of(latex)]
    kind = f"equation{star}" if len(rows) == 1 else f"multline{star}"
    body = " \\\\\n".join(rows)
    return f"\\begin{{{kind}}}\n{body}{after}\n\\end{{{kind}}}"


def pdf_of_solution(solution: Solution) -> bytes:
    """The document compiled by pdflatex.

    Raises:
        StoreError: where LaTeX is not installed, or does not compile the document.
    """
    program = shutil.which("pdflatex")
    if program is None:
        raise StoreError(
            "a PDF without LaTeX",
            expected="pdflatex on this machine",
            advice="install a TeX distribution, or write .tex or .html",
        )
    with TemporaryDirectory(prefix="polhode-") as folder:
        source = Path(folder) / "solution.tex"
        source.write_text(tex_of_solution(solution, "motion.pdf"), "utf-8")
        if solution.example:
            (Path(folder) / "motion.pdf").write_bytes(motion_file(solution.example, "pdf"))
        options = ["-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape"]
        try:
            done = subprocess.run(
                [program, *options, source.name],
                cwd=folder,
                capture_output=True,
                timeout=_SECONDS,
                check=False,
            )
        except subprocess.TimeoutExpired as error:
            raise StoreError(
                "a PDF that pdflatex does not finish", expected="a document that it compiles"
            ) from error
        compiled = source.with_suffix(".pdf")
        if done.returncode or not compiled.is_file():
            last = done.stdout.decode("utf-8", "replace").strip().splitlines()[-3:]
            raise StoreError(
                f"a PDF that pdflatex does not compile: {' '.join(last)}",
                expected="a document that it compiles",
                advice="write .tex and look at its log",
            )
        return compiled.read_bytes()
