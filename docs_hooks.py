"""Runs the examples of every page of the documents, shows the figures that they make, builds worked
solutions and a live page, and lists all public names.

MkDocs calls `on_files`, `on_page_markdown` and `on_page_content`; the tests call `run_page` and
`all_names`.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import runpy
import tempfile
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from typing import Any

import polhode

_BLOCK = re.compile(r"^```(python|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
_ALL_NAMES = "{{ all names }}"
_DOTTED = re.compile("<[^>]*>|(.)([\u0307\u0308])")
_FORMULA = re.compile(r"^\{\{ disk: (.+?) ?\}\}$", re.MULTILINE)
_SOLVED = Path(__file__).parent / "docs" / "examples" / "solutions"
_SHOWN = "gyroscope"
_DOTS = {"\u0307": "\u02d9", "\u0308": "\u00a8"}


class ExampleError(Exception):
    """A page says that something else is printed than its examples print."""


def run_page(text: str, name: str) -> None:
    """Run the Python of a page in the current folder; what it prints must stand below it.

    Raises:
        ExampleError: where it does not.
    """
    names: dict[str, object] = {}
    printed = ""
    for kind, block in _BLOCK.findall(text):
        if kind == "text":
            if printed != block:
                raise ExampleError(f"{name} says:\n{block}\nand its example prints:\n{printed}")
            printed = ""
            continue
        if printed:
            raise ExampleError(f"{name} hides what is printed before:\n{block}")
        with contextlib.redirect_stdout(io.StringIO()) as out:
            exec(compile(block, name, "exec"), names)
        printed = out.getvalue()
    if printed:
        raise ExampleError(f"{name} hides what is printed at its end:\n{printed}")


def on_files(files: Any, config: Any) -> Any:
    """Add the figures that examples make, beside the page that makes them."""
    from mkdocs.structure.files import File

    for file in list(files.documentation_pages()):
        text = Path(file.abs_src_path).read_text("utf-8")
        if "```python" in text:
            folder = PurePosixPath(file.src_uri).parent
            for name, content in _made_by(text, file.src_uri):
                files.append(File.generated(config, str(folder / name), content=content))
    if files.get_file_from_path("index.md"):  # which shows it
        address, content = f"live/{_SHOWN}.html", live_page(_SHOWN)
        files.append(File.generated(config, address, content=content))
    if files.get_file_from_path("solved-systems.md"):  # which links to them
        for declared in sorted(_SOLVED.glob("*.py")):
            address = f"solutions/{declared.stem}.html"
            files.append(File.generated(config, address, content=solved(declared)))
    return files


def live_page(name: str) -> str:
    """The live page of a system of the catalogue."""
    from polhode.cli import main

    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder) / f"{name}.html"
        with contextlib.redirect_stdout(io.StringIO()):
            main(["page", name, "--live", "-o", str(page)])
        return page.read_text("utf-8")


def solved(declared: Path) -> str:
    """The page with the solution of the system that a file declares under its own name.

    Values that the file gives as `numbers`, `start` and `duration` are put in.
    """
    from polhode.solution import Example, page_of_solution

    names = runpy.run_path(str(declared))
    equations = polhode.derive(names[declared.stem])
    example = None
    if "numbers" in names:
        example = Example(equations, names["numbers"], names["start"], names["duration"])
    return page_of_solution(polhode.solution(equations, example=example))


def with_formulas(markdown: str) -> str:
    """Put formulas of the rolling disk's solution where a page names how they begin.

    Raises:
        ExampleError: where the solution has no formula that begins in this way.
    """
    if not _FORMULA.search(markdown):
        return markdown
    from polhode.catalogue import CATALOGUE
    from polhode.view import typeset

    steps = polhode.solution(CATALOGUE["rolling-disk"].build(), "newton").steps

    def formula(found: re.Match[str]) -> str:
        step = next((step for step in steps if step.latex.startswith(found[1])), None)
        if step is None:
            raise ExampleError(f"no formula of the rolling disk begins with {found[1]}")
        shown = typeset(step.latex).replace("<math", '<math display="block"', 1)
        return f'<div class="formula">{shown}</div>'

    return _FORMULA.sub(formula, markdown)


def on_page_markdown(markdown: str, **_: Any) -> str:
    """Put formulas and the table of all names where a page asks for them."""
    markdown = with_formulas(markdown)
    if _ALL_NAMES not in markdown:
        return markdown
    table = [f"| [`{name}`][{path}] | {summary} |" for name, path, summary in all_names()]
    return markdown.replace(
        _ALL_NAMES, "\n".join(["| name | what it is |", "| --- | --- |", *table])
    )


def on_page_content(html: str, **_: Any) -> str:
    """Set the dots of time derivatives over their letters, which fonts for code seldom do."""
    return _DOTTED.sub(_dotted, html)


def all_names() -> Iterator[tuple[str, str, str]]:
    """Every public name, where it lives, and the first sentence or two that are said of it."""
    import griffe

    package = griffe.load("polhode", search_paths=[Path(__file__).parent / "src"])
    for name in sorted(polhode.__all__, key=str.casefold):
        home = polhode._HOME.get(name)
        if home:
            said = package[f"{home}.{name}".removeprefix("polhode.")].docstring
            summary = said.value.partition("\n\n")[0] if said else ""
            yield name, f"{home}.{name}", " ".join(summary.split()).replace("|", r"\|")


def _dotted(found: re.Match[str]) -> str:
    letter, dots = found.groups()
    if not dots:  # a tag, within which nothing is set
        return found[0]
    return f'<span class="dotted" data-dots="{_DOTS[dots]}">{letter}<span>{dots}</span></span>'


def _made_by(text: str, name: str) -> Iterator[tuple[str, bytes]]:
    before = Path.cwd()
    with tempfile.TemporaryDirectory(prefix="polhode-docs-") as folder:
        os.chdir(folder)
        try:
            run_page(text, name)
        finally:
            os.chdir(before)
        for path in sorted(Path(folder).iterdir()):
            if path.is_file():
                yield path.name, path.read_bytes()
