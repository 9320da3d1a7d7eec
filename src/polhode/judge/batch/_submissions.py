"""What was handed in: files, and folders whose files belong together."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from polhode.base import StoreError

ENDINGS = (".tex", ".ltx", ".latex", ".md", ".markdown", ".ipynb", ".typ", ".rst", ".txt")


@dataclass(frozen=True)
class Submission:
    """What one person handed in.

    Attributes:
        name: the path of its file or folder.
        paths: of its documents.
    """

    name: str
    paths: tuple[Path, ...]

    @property
    def digest(self) -> str:
        """Of all its documents; of those that cannot be read, their names alone."""
        found = hashlib.sha256()
        for path in self.paths:
            found.update(f"{path.name}\0".encode("utf-8", "surrogateescape"))
            with suppress(OSError):
                found.update(hashlib.sha256(path.read_bytes()).digest())
        return found.hexdigest()


def submissions(paths: Iterable[Path]) -> list[Submission]:
    """The submissions at some places, sorted by name within each folder.

    A file is one. In a folder every document is one, and every folder in it that has documents,
    however deep; hidden files are passed over.

    Raises:
        StoreError: for a path where nothing is, and where no submission is found at all.
    """
    given = list(paths)
    every = (submission for path in given for submission in _submissions_at(path))
    found = list({submission.name: submission for submission in every}.values())
    if not found:
        raise StoreError(
            f"no documents in {', '.join(map(str, given))}",
            expected=f"files that end in {', '.join(ENDINGS)}, or folders of them",
        )
    return found


def _submissions_at(path: Path) -> Iterator[Submission]:
    if path.is_file():
        yield Submission(str(path), (path,))
        return
    try:
        inside = sorted(entry for entry in path.iterdir() if not entry.name.startswith("."))
    except (OSError, ValueError) as error:  # ValueError for a name with a null character
        why = getattr(error, "strerror", None) or error
        raise StoreError(
            f"{path} cannot be read ({why})", expected="a document, or a folder of them"
        ) from error
    for entry in inside:
        if entry.is_dir():
            documents = tuple(sorted(filter(_is_document, entry.rglob("*"))))
            if documents:
                yield Submission(str(entry), documents)
        elif _is_document(entry):
            yield Submission(str(entry), (entry,))


def _is_document(path: Path) -> bool:
    is_hidden = path.name.startswith(".") or "__MACOSX" in path.parts  # left by archives of a Mac
    return path.suffix.lower() in ENDINGS and not is_hidden and path.is_file()
