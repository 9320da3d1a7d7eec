"""A worked solution as LaTeX source and as PDF."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.solution._compiled_tex import compiled_tex
from polhode.solution._figure import Figure, tikz_colours
from polhode.solution._motion import motion_file
from polhode.solution._solution import MOTION, Solution, Step
from polhode.solution._tex_rows import WIDE, rows_of, width
from polhode.solution._tex_words import text_tex
from polhode.solution._words import paragraphs, rendered, with_displays

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
    """The document compiled by pdflatex; raises as `compiled_tex` does."""
    motion = {"motion.pdf": motion_file(solution.example, "pdf")} if solution.example else {}
    return compiled_tex(tex_of_solution(solution, "motion.pdf"), motion)
