"""Motions in files: the samples as HDF5, laid out as NetCDF-4, and after it the motion itself.

Others' tools read the samples, as variables over `t`, and pass over what follows: the motion as
polhode takes it up again, its length, and a checksum of all before. Reading the motion leaves the
HDF5 alone: the library that reads it can be brought to hang, or to end the process, by a file
that was made to.
"""

from __future__ import annotations

import hashlib
import io
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from polhode.base import SCHEMA, StoreError, extra, read_whole, write_whole
from polhode.simulate.files._archive import FORMAT, Archive, Sampled, counted, packed, unpacked

_MOTION = "polhode.motion"
_MAGIC = b"\x89HDF\r\n\x1a\n"
_SEAL = b"polhode motion, sha-256:"
_EARLIER = b"polhode sha-256:"
_DIGEST = hashlib.sha256().digest_size
_LENGTH = len(counted(0))


def write_archive(path: str | Path, archive: Archive, samples: Mapping[str, Sampled]) -> None:
    """Write a motion to a file, whole or not at all; the same file for the same motion.

    Args:
        path: of the file.
        archive: the motion.
        samples: what others' tools are to read, by name, at its times.

    Raises:
        StoreError: where the file cannot be written, or h5py is not installed.
    """
    payload = packed(archive)
    content = _samples_file(archive, samples) + payload + counted(len(payload))
    write_whole(Path(path), content + _seal(content))


def read_archive(path: str | Path) -> Archive:
    """Read a motion from a file that `write_archive` wrote; its samples are left alone.

    Raises:
        StoreError: for a file that cannot be read, is damaged, was not written by polhode or by
            another version of it.
    """
    content = _unsealed(Path(path))
    inside, length = content[:-_LENGTH], int.from_bytes(content[-_LENGTH:], "little")
    try:
        if length > len(inside):
            raise ValueError("it has another length than it says")
        return unpacked(inside[len(inside) - length :])
    except (LookupError, OverflowError, ValueError) as error:
        raise _damaged(path, error) from error


# -- samples for others ----------------------------------------------------------------------------


def _samples_file(archive: Archive, samples: Mapping[str, Sampled]) -> bytes:
    with extra("h5py", "data"):
        import h5py
    memory = io.BytesIO()
    with h5py.File(memory, "w", track_order=True) as root:
        root.attrs.update({"format": FORMAT, "schema": SCHEMA})
        _write_samples(root, archive, samples)
        _write_origin(root.create_group(_MOTION), archive, h5py)
    return memory.getvalue()


def _write_samples(root: Any, archive: Archive, samples: Mapping[str, Sampled]) -> None:
    times = root.create_dataset("t", data=archive.times)
    times.attrs.update({"units": "s", "long_name": "time"})
    times.make_scale("t")
    for name, sampled in samples.items():
        column = root.create_dataset(_key(name), data=sampled.values)
        column.attrs.update({"units": sampled.unit or "1", "long_name": name})
        column.dims[0].attach_scale(times)


def _key(name: str) -> str:
    return name.replace("/", "|")


def _write_origin(group: Any, archive: Archive, h5py: Any) -> None:
    """What the samples were made with, as texts."""
    texts = {
        "declaration": archive.declaration,
        "parameters": json.dumps(dict(archive.parameters)),
        "events": json.dumps([dict(event) for event in archive.events]),
        "details": json.dumps(dict(archive.details)),
        "origin": json.dumps(dict(archive.origin)),
    }
    for name, text in texts.items():
        group.create_dataset(name, data=text, dtype=h5py.string_dtype())


# -- the seal --------------------------------------------------------------------------------------


def _seal(content: bytes) -> bytes:
    return _SEAL + hashlib.sha256(content).digest()


def _unsealed(path: Path) -> bytes:
    content = read_whole(path, "a motion that polhode wrote")
    size = max(len(content) - len(_SEAL) - _DIGEST, 0)
    inside, seal = content[:size], content[size:]
    if content.startswith(_MAGIC) and seal[len(_SEAL) - len(_EARLIER) :].startswith(_EARLIER):
        raise StoreError(
            f"{path} was written by an earlier version of polhode",
            expected="a motion that this version wrote",
            advice="compute it again, or load it with the version that wrote it",
        )
    if not content.startswith(_MAGIC) or not seal.startswith(_SEAL):
        raise StoreError(
            f"{path} is no motion that polhode wrote, or it was cut short or changed",
            expected="a file from run.save(...)",
        )
    if seal != _seal(inside):
        raise _damaged(path, "its checksum is wrong")
    return inside


def _damaged(path: str | Path, what: object) -> StoreError:
    return StoreError(
        f"{path} is damaged: {str(what)[:200]}",
        expected="a motion as polhode wrote it",
        advice="take a copy of it, or compute it again",
    )
