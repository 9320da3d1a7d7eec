"""A cache on disk for what is slow to make and cheap to keep, shared by all processes.

Entries are bytes under a text key. Each is checked when read and made again when damaged; the
least recently used are dropped beyond `LIMIT` bytes. A cache that cannot be written slows the
work down but never stops it.
"""

import hashlib
import logging
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, suppress
from pathlib import Path

from polhode.base._errors import StoreError
from polhode.base._lock import locked

LIMIT = 256 * 2**20
"""Bytes of entries kept."""

_TAG_NAME = "CACHEDIR.TAG"
_TAG = b"Signature: 8a477f597d28d172789f06886806bc55\n# Made by polhode; safe to delete.\n"
_MAGIC = b"polhode 1\n"
_HEADER_SIZE = len(_MAGIC) + hashlib.sha256().digest_size
_STALE_AFTER = 86400.0  # seconds after which an unfinished write was surely abandoned

_log = logging.getLogger("polhode.cache")


def directory() -> Path:
    """Where the cache lives: POLHODE_CACHE, or else the platform's place for caches."""
    chosen = os.environ.get("POLHODE_CACHE")
    return Path(chosen).expanduser() if chosen else _platform_caches() / "polhode"


def folder(name: str) -> Path:
    """A folder of the cache, made if need be, for a library that keeps its own files there.

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
            advice="set POLHODE_CACHE to one",
        ) from error
    return path


def get_or_make(key: str, make: Callable[[], bytes]) -> bytes:
    """The bytes kept under `key`, or else those that `make` returns, which are then kept.

    Of several processes that ask for the same key at once, one makes and the others wait for it.
    """
    try:
        entries = folder("entries")
    except StoreError as error:
        _log.warning("not caching: %s", error)
        return make()
    entry = entries / hashlib.sha256(key.encode()).hexdigest()
    found = _read(entry)
    return _make_once(entry, make) if found is None else found


def clear() -> int:
    """Empty the cache; returns the bytes freed.

    Only folders that polhode tagged as its own are removed, whatever else lies beside them.
    """
    root = directory()
    ours = [tag.parent for tag in root.glob(f"*/{_TAG_NAME}") if _is_ours(tag)]
    freed = sum(status.st_size for owned in ours for _, status in _files(owned))
    for owned in ours:
        shutil.rmtree(owned, ignore_errors=True)
    return freed


def _platform_caches() -> Path:
    if sys.platform == "win32":
        return Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
    if sys.platform == "darwin":
        return Path.home() / "Library" / "Caches"
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")


def _make_once(entry: Path, make: Callable[[], bytes]) -> bytes:
    with ExitStack() as held:
        with suppress(OSError):  # where files cannot be locked, each process makes its own
            held.enter_context(locked(entry.with_suffix(".lock")))
        found = _read(entry)
        if found is not None:
            return found
        made = make()
        try:
            _write(entry, made)
            _trim(entry.parent)
        except OSError as error:
            _log.warning("not caching: %s", error)
        return made


def _read(entry: Path) -> bytes | None:
    try:
        stored = entry.read_bytes()
    except OSError:
        return None
    head, payload = stored[:_HEADER_SIZE], stored[_HEADER_SIZE:]
    if head != _header(payload):
        _log.warning("the cache entry %s is damaged and will be made again", entry.name)
        return None
    with suppress(OSError):
        os.utime(entry)
    return payload


def _write(entry: Path, payload: bytes) -> None:
    descriptor, name = tempfile.mkstemp(suffix=".part", dir=entry.parent)
    part = Path(name)
    try:
        with os.fdopen(descriptor, "wb") as stream:
            stream.write(_header(payload) + payload)
        os.replace(part, entry)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def _header(payload: bytes) -> bytes:
    return _MAGIC + hashlib.sha256(payload).digest()


def _trim(entries: Path) -> None:
    """Drop abandoned locks and unfinished writes, then the oldest entries beyond `LIMIT`."""
    kept, abandoned = 0, time.time() - _STALE_AFTER
    newest_first = sorted(_files(entries), key=lambda file: -file[1].st_mtime_ns)
    for path, status in newest_first:
        if path.suffix in (".lock", ".part") and status.st_mtime < abandoned:
            path.unlink(missing_ok=True)
        elif path.suffix == "":
            kept += status.st_size
            if kept > LIMIT:
                path.unlink(missing_ok=True)


def _files(owned: Path) -> Iterator[tuple[Path, os.stat_result]]:
    for path in owned.rglob("*"):
        with suppress(OSError):  # another process may just have removed it
            yield path, path.stat()


def _is_ours(tag: Path) -> bool:
    try:
        return tag.read_bytes() == _TAG
    except OSError:
        return False
