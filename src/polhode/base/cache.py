"""The cache on disk, shared by all processes: compiled equations and other slow results."""

import os
import shutil
import sys
from contextlib import suppress
from hashlib import blake2b
from pathlib import Path

from polhode.base._errors import StoreError
from polhode.base._files import write_whole

LIMIT = 2**30
"""Largest size of one library's cache, in bytes."""

MOST = 2**27
"""Largest size of a folder with entries of polhode's own, in bytes."""

SHELVES = 64
"""Folders within such a folder: to keep it small, a write looks at one of them alone."""

_TAG_NAME = "CACHEDIR.TAG"
# bford.info/cachedir: backup programs skip a directory with this file
_TAG = b"Signature: 8a477f597d28d172789f06886806bc55\n# Made by polhode; safe to delete.\n"


def directory() -> Path:
    """The directory of the cache: POLHODE_CACHE, or else the platform's place for caches."""
    if chosen := os.environ.get("POLHODE_CACHE"):
        return Path(chosen).expanduser()
    if sys.platform == "win32":
        caches = Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
    elif sys.platform == "darwin":
        caches = Path.home() / "Library" / "Caches"
    else:
        caches = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return caches / "polhode"


def folder(name: str) -> Path:
    """A folder of the cache, created if needed, for a library that keeps its own files there.

    `clear` empties it with the rest.

    Raises:
        StoreError: if it cannot be made.
    """
    path = directory() / name
    try:
        path.mkdir(parents=True, exist_ok=True)
        tag = path / _TAG_NAME
        if not tag.exists():
            tag.write_bytes(_TAG)
    except OSError as error:
        raise StoreError(
            f"the cache folder {path} cannot be made ({error.strerror})",
            expected="a folder that can be written",
            advice="set POLHODE_CACHE to a writable folder",
        ) from error
    return path


def read(name: str, key: str) -> bytes | None:
    """What was kept under a key in a folder; None where nothing is, or where it is damaged."""
    path = directory() / name / _shelf(key) / key
    try:
        digest, content = path.read_bytes().split(b"\n", 1)
        os.utime(path)  # what has not been read for longest is dropped first
    except (OSError, ValueError):
        return None
    return content if digest == _digest(content) else None


def write(name: str, key: str, content: bytes) -> None:
    """Keep content under a key, in one step; without an error where the cache cannot be written.

    What has not been read for longest is dropped where the folder outgrows `MOST`.
    """
    with suppress(OSError, StoreError):
        kept = folder(name) / _shelf(key)
        if not kept.exists():
            kept.mkdir(exist_ok=True)
            _drop_loose(kept.parent)
        write_whole(kept / key, _digest(content) + b"\n" + content)
        _drop_oldest(kept)


def _digest(content: bytes) -> bytes:
    return blake2b(content, digest_size=16).hexdigest().encode()


def _shelf(key: str) -> str:
    return f"{int(_digest(key.encode())[:8], 16) % SHELVES:02x}"


def _drop_loose(kept: Path) -> None:
    """Remove entries from before there were shelves."""
    for path in kept.iterdir():
        if path.is_file() and path.name != _TAG_NAME:
            path.unlink(missing_ok=True)


def _drop_oldest(kept: Path) -> None:
    entries = list[tuple[float, int, Path]]()
    for path in kept.iterdir():
        with suppress(OSError):  # another process may just have removed it
            found = path.stat()
            entries.append((found.st_mtime, found.st_size, path))
    size = sum(bytes_ for _, bytes_, _ in entries)
    for _, bytes_, path in sorted(entries):
        if size <= MOST / SHELVES:
            return
        path.unlink(missing_ok=True)
        size -= bytes_


def clear() -> int:
    """Empty the cache; returns the bytes freed.

    Only folders that polhode has tagged are removed: POLHODE_CACHE may name a folder with other
    files in it.
    """
    root = directory()
    ours = [tag.parent for tag in root.glob(f"*/{_TAG_NAME}") if _is_ours(tag)]
    freed = 0
    for owned in ours:
        for path in owned.rglob("*"):
            with suppress(OSError):  # another process may just have removed it
                freed += path.stat().st_size
        shutil.rmtree(owned, ignore_errors=True)
    return freed


def _is_ours(tag: Path) -> bool:
    try:
        return tag.read_bytes() == _TAG
    except OSError:
        return False
