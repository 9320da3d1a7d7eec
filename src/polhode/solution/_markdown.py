"""A worked solution as Markdown, and as a notebook of Markdown cells."""

from __future__ import annotations

import json
from collections.abc import Iterator

from polhode.base import provenance
from polhode.solution._solution import Solution, Step
from polhode.solution._words import paragraphs


def markdown_of_solution(solution: Solution) -> str:
    """Markdown with formulas between dollar signs."""
    parts = [f"# {solution.title}", *_cells(solution)]
    return "\n\n".join(parts) + "\n"


def notebook_of_solution(solution: Solution) -> str:
    """A notebook (nbformat 4.5), a cell for each section."""
    sources = [f"# {solution.title}", *_cells(solution)]
    cells = [
        {
            "cell_type": "markdown",
            "id": f"section-{i}",
            "metadata": {},
            "source": source.splitlines(keepends=True),
        }
        for i, source in enumerate(sources)
    ]
    notebook = {
        "cells": cells,
        "metadata": {"polhode": provenance()},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    return json.dumps(notebook, indent=1, ensure_ascii=False) + "\n"


def _cells(solution: Solution) -> Iterator[str]:
    for section, steps in solution.sections.items():
        yield "\n\n".join([f"## {section}", *_section(steps)])


def _section(steps: tuple[Step, ...]) -> Iterator[str]:
    for words, step in paragraphs(steps):
        if words:
            yield words
        if step is not None:
            yield f"$$\n{step.latex} \\tag{{{step.number}}}\n$$"
