"""Runs the examples of every page of the documents, and shows the figures that they make.

MkDocs calls `on_files`; the tests call `run_page`.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import tempfile
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from typing import Any

_BLOCK = re.compile(r"^```(python|text)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


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
    return files


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
