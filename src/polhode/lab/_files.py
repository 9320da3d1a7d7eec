"""The files of the page, and the kinds of files that can be saved."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from polhode.base import StoreError, family_style

PAGE: Mapping[str, str] = {
    "lab.js": "text/javascript; charset=utf-8",
    "lab.css": "text/css; charset=utf-8",
    "LICENSES.txt": "text/plain; charset=utf-8",
}


@dataclass(frozen=True)
class FileKind:
    """A kind of file: its ending and media type."""

    ending: str
    media: str


KINDS: Mapping[str, FileKind] = {
    "page": FileKind("html", "text/html; charset=utf-8"),
    "csv": FileKind("csv", "text/csv; charset=utf-8"),
    "svg": FileKind("svg", "image/svg+xml"),
    "png": FileKind("png", "image/png"),
    "gif": FileKind("gif", "image/gif"),
    "mp4": FileKind("mp4", "video/mp4"),
}


@cache
def built(name: str) -> str:
    """A file of the front end, read without importing `polhode.view`.

    Raises:
        StoreError: if it has not been built.
    """
    view = files("polhode").joinpath("view")
    try:
        text = view.joinpath("built", name).read_text("utf-8")
        if not name.endswith(".css"):
            return text
        return view.joinpath("math.css").read_text("utf-8") + family_style() + text
    except OSError as error:
        raise StoreError(
            f"the front end of the lab is missing ({name})",
            expected="a package whose front end was built when it was installed",
            advice="install polhode again; from a checkout, run python build_frontend.py",
        ) from error
