"""Files written in one step, and read whole up to a limit."""

from __future__ import annotations

import os
import tempfile
from contextlib import suppress
from pathlib import Path

from polhode.base._errors import StoreError

_MOST = 64 * 2**20  # bytes that are read from a pipe or a device


def write_whole(path: Path, content: bytes) -> None:
    """Write a file in one step: a reader sees the old content or the new, never a part.

    Raises:
        StoreError: where it cannot be written; the old file is kept.
    """
    part = None
    try:
        if path.exists() and not (path.is_file() or path.is_dir()):
            raise StoreError(
                f"{path} cannot be written (it is a device or a pipe)",
                expected="the name of a regular file",
            )
        descriptor, part = tempfile.mkstemp(suffix=".part", dir=path.parent)
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(content)
        os.chmod(part, 0o644)
        os.replace(part, path)
    except OSError as error:
        raise StoreError(
            f"{path} cannot be written ({error.strerror})",
            expected="a file in a folder that exists and can be written",
        ) from error
    finally:
        if part is not None:
            with suppress(FileNotFoundError):
                os.unlink(part)


def read_whole(path: Path, expected: str) -> bytes:
    """The bytes of a file, or of a pipe or device that has an end.

    Args:
        path: of the file.
        expected: what it should be, for messages.

    Raises:
        StoreError: where it cannot be read.
    """
    try:
        if path.is_file():
            return path.read_bytes()
        with path.open("rb") as stream:
            content = stream.read(_MOST + 1)
    except (OSError, ValueError) as error:  # ValueError for a name with a null character
        why = getattr(error, "strerror", None) or error
        raise StoreError(f"{path} cannot be read ({why})", expected=expected) from error
    if len(content) > _MOST:
        raise StoreError(f"{path} cannot be read (it does not end)", expected=expected)
    return content
