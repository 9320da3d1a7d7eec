"""Files of worked solutions, by the ending of the name."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from pathlib import Path
from urllib.parse import quote

from polhode.base import StoreError, write_whole
from polhode.solution._html import page_of_solution
from polhode.solution._markdown import markdown_of_solution, notebook_of_solution
from polhode.solution._motion import motion_file
from polhode.solution._solution import Solution
from polhode.solution._tex import pdf_of_solution, tex_of_solution

_UNSAFE = re.compile(r"[^A-Za-z0-9._-]+")
_WRITERS: dict[str, Callable[[Solution, Path], str]] = {
    ".html": lambda solution, target: page_of_solution(solution),
    ".tex": lambda solution, target: tex_of_solution(solution, _beside(target, "motion", "pdf")),
    ".md": lambda solution, target: markdown_of_solution(
        solution,
        quote(_beside(target, "figure", "svg")),
        quote(_beside(target, "motion", "svg")) if solution.motion else "",
    ),
    ".ipynb": lambda solution, target: notebook_of_solution(solution),
}
#: Endings of the files that can be written.
SOLUTION_FILES = (*_WRITERS, ".pdf")


def write_solution(solution: Solution, path: str | Path) -> None:
    """Write a worked solution as .html, .tex, .md, .ipynb or, with LaTeX installed, .pdf.

    Figures that cannot stand within the text are written beside it: those of a .md file as .svg,
    that of a motion for a .tex file as .pdf.

    Raises:
        StoreError: for another ending, without LaTeX for .pdf, and where it cannot be written.
    """
    target = Path(path)
    ending = target.suffix.lower()
    if ending == ".pdf":
        write_whole(target, pdf_of_solution(solution))
        return
    if ending not in _WRITERS:
        raise StoreError(
            f"a worked solution as {target.name}",
            expected=f"a name that ends in {', '.join(SOLUTION_FILES)}",
            advice=f"for instance {target.with_suffix('.html')}",
        )
    write_whole(target, _WRITERS[ending](solution, target).encode("utf-8"))
    for name, content in _pictures(solution, target, ending):
        write_whole(target.with_name(name), content)


def _beside(target: Path, what: str, kind: str) -> str:
    # LaTeX reads % and other signs in a file's name as its own.
    stem = _UNSAFE.sub("-", target.stem) if kind == "pdf" else target.stem
    return f"{stem}-{what}.{kind}"


def _pictures(solution: Solution, target: Path, ending: str) -> Iterator[tuple[str, bytes]]:
    if ending == ".md" and solution.figure:
        yield _beside(target, "figure", "svg"), solution.figure.svg_file().encode("utf-8")
    if ending == ".md" and solution.motion:
        yield _beside(target, "motion", "svg"), solution.motion.encode("utf-8")
    if ending == ".tex" and solution.example:
        yield _beside(target, "motion", "pdf"), motion_file(solution.example, "pdf")
