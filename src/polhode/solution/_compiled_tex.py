"""LaTeX source compiled to PDF where LaTeX is installed."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

from polhode.base import StoreError

_SECONDS = 120  # for LaTeX, which takes a few


def compiled_tex(source: str, beside: Mapping[str, bytes]) -> bytes:
    """The PDF that pdflatex makes of a document.

    Args:
        source: LaTeX.
        beside: files that it includes, by name.

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
        document = Path(folder) / "document.tex"
        document.write_text(source, "utf-8")
        for name, content in beside.items():
            document.with_name(name).write_bytes(content)
        options = ["-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape"]
        try:
            done = subprocess.run(
                [program, *options, document.name],
                cwd=folder,
                capture_output=True,
                timeout=_SECONDS,
                check=False,
            )
        except subprocess.TimeoutExpired as error:
            raise StoreError(
                "a PDF that pdflatex does not finish", expected="a document that it compiles"
            ) from error
        compiled = document.with_suffix(".pdf")
        if done.returncode or not compiled.is_file():
            last = done.stdout.decode("utf-8", "replace").strip().splitlines()[-3:]
            raise StoreError(
                f"a PDF that pdflatex does not compile: {' '.join(last)}",
                expected="a document that it compiles",
                advice="write .tex and look at its log",
            )
        return compiled.read_bytes()
