"""A worked solution as Markdown, and as a notebook of Markdown cells."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Iterator
from typing import Any

from polhode.base import provenance
from polhode.solution._motion import motion_file
from polhode.solution._solution import MOTION, Solution, Step
from polhode.solution._words import paragraphs, with_displays

_FIGURE, _MOTION = "figure.png", "motion.png"


def markdown_of_solution(solution: Solution, picture: str = "", motion: str = "") -> str:
    """Markdown with formulas between dollar signs.

    Args:
        solution: to be written.
        picture: name of the file with its figure; without it there is none.
        motion: name of the file with the figure of a motion; without it that is left out.
    """
    parts = [f"# {solution.title}", *_pictured(solution, picture), *_cells(solution, motion)]
    return "\n\n".join(parts) + "\n"


def notebook_of_solution(solution: Solution) -> str:
    """A notebook (nbformat 4.5), a cell for each section.

    Figures are PNG attached to their cells: Jupyter and GitHub show no attached SVG.
    """
    opening = [f"# {solution.title}", *_pictured(solution, f"attachment:{_FIGURE}")]
    sources = ["\n\n".join(opening), *_cells(solution, f"attachment:{_MOTION}")]
    cells = [_cell(i, source, solution) for i, source in enumerate(sources)]
    notebook = {
        "cells": cells,
        "metadata": {"polhode": provenance()},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"


def _cell(number: int, source: str, solution: Solution) -> dict[str, Any]:
    cell: dict[str, Any] = {
        "cell_type": "markdown",
        "id": f"section-{number}",
        "metadata": {},
        "source": source.splitlines(keepends=True),
    }
    if f"](attachment:{_FIGURE})" in source and solution.figure:
        cell["attachments"] = _attached(_FIGURE, solution.figure.png())
    if f"](attachment:{_MOTION})" in source and solution.example:
        cell["attachments"] = _attached(_MOTION, motion_file(solution.example, "png"))
    return cell


def _attached(name: str, png: bytes) -> dict[str, dict[str, str]]:
    return {name: {"image/png": b64encode(png).decode("ascii")}}


def _pictured(solution: Solution, picture: str) -> Iterator[str]:
    if solution.figure and picture:
        yield f"![{solution.figure.title}]({picture})"
        yield f"*{solution.figure.caption}*"


def _cells(solution: Solution, motion: str) -> Iterator[str]:
    for section, steps in solution.sections.items():
        if section != MOTION:
            yield "\n\n".join([f"## {section}", *_section(steps)])
        elif motion:
            picture = f"![{section}]({motion})"
            yield "\n\n".join([f"## {section}", *_section(steps), picture])


def _displayed(latex: str, mark: str) -> str:
    return f"\n\n$$\n{latex}{mark}\n$$\n\n"


def _section(steps: tuple[Step, ...]) -> Iterator[str]:
    for words, step in paragraphs(steps):
        if words:
            yield with_displays(words, str, _displayed).strip()
        if step is not None:
            yield f"$$\n{step.latex} \\tag{{{step.number}}}\n$$"
