"""Files of worked solutions, by the ending of the name."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from urllib.parse import quote

from polhode.base import StoreError, write_whole
from polhode.solution._html import page_of_solution
from polhode.solution._markdown import markdown_of_solution, notebook_of_solution
from polhode.solution._solution import Solution
from polhode.solution._tex import pdf_of_solution, tex_of_solution

_WRITERS: dict[str, Callable[[Solution], str]] = {
    ".html": page_of_solution,
    ".tex": tex_of_solution,
    ".ipynb": notebook_of_solution,
}
#: Endings of the files that can be written.
SOLUTION_FILES = (*_WRITERS, ".md", ".pdf")


def write_solution(solution: Solution, path: str | Path) -> None:
    """Write a worked solution as .html, .tex, .md, .ipynb or, with LaTeX installed, .pdf.

    Beside a .md file stands its figure, as .svg: Markdown has no figures within the text.

    Raises:
        StoreError: for another ending, without LaTeX for .pdf, and where it cannot be written.
    """
    target = Path(path)
    ending = target.suffix.lower()
    if ending == ".pdf":
        write_whole(target, pdf_of_solution(solution))
        return
    if ending == ".md":
        _write_markdown(solution, target)
        return
    if ending not in _WRITERS:
        raise StoreError(
            f"a worked solution as {target.name}",
            expected=f"a name that ends in {', '.join(SOLUTION_FILES)}",
            advice=f"for instance {target.with_suffix('.html')}",
        )
    write_whole(target, _WRITERS[ending](solution).encode("utf-8"))


def _write_markdown(solution: Solution, target: Path) -> None:
    picture = target.with_name(f"{target.stem}-figure.svg")
    if solution.figure:
        write_whole(picture, solution.figure.svg_file().encode("utf-8"))
    write_whole(target, markdown_of_solution(solution, quote(picture.name)).encode("utf-8"))
