"""Files written in one step, and read whole up to a limit."""

from __future__ import annotations

import errno
import os
import tempfile
from contextlib import suppress
from pathlib import Path
from time import monotonic, sleep

from polhode.base._errors import StoreError

_MOST = 64 * 2**20  # bytes that are read from a pipe or a device
_WRITER_WITHIN = 5.0  # s in which a pipe has to have a writer
_AGAIN = 0.01  # s until a pipe without one is looked at again


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
        content = read_at_most(path, _MOST + 1)
    except (OSError, ValueError) as error:  # ValueError for a name with a null character
        why = getattr(error, "strerror", None) or error
        raise StoreError(f"{path} cannot be read ({why})", expected=expected) from error
    if len(content) > _MOST:
        raise StoreError(f"{path} cannot be read (it does not end)", expected=expected)
    return content


def read_at_most(path: Path, size: int) -> bytes:
    """The first bytes of a file, a pipe or a device.

    Raises:
        OSError: where it cannot be opened or read, and for a pipe that nobody writes to.
        ValueError: for a name with a null character.
    """
    if not path.is_fifo():
        with path.open("rb") as stream:
            return stream.read(size)
    # Opened in the usual way, a pipe without a writer would let the program wait for ever.
    descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)
    with os.fdopen(descriptor, "rb") as stream:
        first = _first_byte(descriptor)
        os.set_blocking(descriptor, True)
        return first + stream.read(size - len(first))


def _first_byte(descriptor: int) -> bytes:
    """The first byte of a pipe, whose writer may take its time, but has to come soon."""
    end = monotonic() + _WRITER_WITHIN
    while True:
        try:
            first = os.read(descriptor, 1)
        except BlockingIOError:  # a writer is there, and has not written yet
            os.set_blocking(descriptor, True)
            return os.read(descriptor, 1)
        if first:
            return first
        if monotonic() > end:
            raise OSError(errno.EPIPE, "it is a pipe that nobody writes to")
        sleep(_AGAIN)
