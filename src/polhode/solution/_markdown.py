"""A worked solution as Markdown, and as a notebook of Markdown cells."""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Iterator

from polhode.base import provenance
from polhode.solution._solution import Solution, Step
from polhode.solution._words import paragraphs

_ATTACHED = "figure.png"


def markdown_of_solution(solution: Solution, picture: str = "") -> str:
    """Markdown with formulas between dollar signs; `picture` is the name of the figure's file."""
    parts = [f"# {solution.title}", *_pictured(solution, picture), *_cells(solution)]
    return "\n\n".join(parts) + "\n"


def notebook_of_solution(solution: Solution) -> str:
    """A notebook (nbformat 4.5), a cell for each section.

    The figure is a PNG attached to the first cell: Jupyter and GitHub show no attached SVG.
    """
    opening = [f"# {solution.title}", *_pictured(solution, f"attachment:{_ATTACHED}")]
    sources = ["\n\n".join(opening), *_cells(solution)]
    cells: list[dict[str, object]] = [
        {
            "cell_type": "markdown",
            "id": f"section-{i}",
            "metadata": {},
            "source": source.splitlines(keepends=True),
        }
        for i, source in enumerate(sources)
    ]
    if solution.figure:
        png = b64encode(solution.figure.png()).decode("ascii")
        cells[0]["attachments"] = {_ATTACHED: {"image/png": png}}
    notebook = {
        "cells": cells,
        "metadata": {"polhode": provenance()},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"


def _pictured(solution: Solution, picture: str) -> Iterator[str]:
    if solution.figure and picture:
        yield f"![{solution.figure.title}]({picture})"
        yield f"*{solution.figure.caption}*"


def _cells(solution: Solution) -> Iterator[str]:
    for section, steps in solution.sections.items():
        yield "\n\n".join([f"## {section}", *_section(steps)])


def _section(steps: tuple[Step, ...]) -> Iterator[str]:
    for words, step in paragraphs(steps):
        if words:
            yield words
        if step is not None:
            yield f"$$\n{step.latex} \\tag{{{step.number}}}\n$$"
