"""Motions in files: the samples as HDF5 in NetCDF-4 layout, followed by the motion itself.

Other tools read the samples, as variables over `t`, and ignore what follows: the motion as polhode
loads it, its length, and a checksum of everything before. Loading does not touch the HDF5 part: a
malicious file can make the HDF5 library hang or crash.
"""

from __future__ import annotations

import hashlib
import io
import json
from collections.abc import Mapping
from pathlib import Path

from polhode.base import SCHEMA, StoreError, extra, read_whole, write_whole
from polhode.simulate.files._archive import FORMAT, Archive, Sampled, counted, packed, unpacked

_MOTION = "polhode.motion"
_MAGIC = b"\x89HDF\r\n\x1a\n"
_SEAL = b"polhode motion, sha-256:"
_EARLIER = b"polhode sha-256:"
_DIGEST = hashlib.sha256().digest_size
_LENGTH = len(counted(0))


def write_archive(path: str | Path, archive: Archive, samples: Mapping[str, Sampled]) -> None:
    """Write a motion to a file, completely or not at all; equal motions give equal files.

    Args:
        path: of the file.
        archive: the motion.
        samples: the quantities that other tools read, by name, at its times.

    Raises:
        StoreError: where the file cannot be written, or h5py is not installed.
    """
    payload = packed(archive)
    with extra("h5py", "data"):
        import h5py
    memory = io.BytesIO()
    with h5py.File(memory, "w", track_order=True) as root:
        root.attrs.update({"format": FORMAT, "schema": SCHEMA})
        times = root.create_dataset("t", data=archive.times)
        times.attrs.update({"units": "s", "long_name": "time"})
        times.make_scale("t")
        for name, sampled in samples.items():
            column = root.create_dataset(name.replace("/", "|"), data=sampled.values)
            column.attrs.update({"units": sampled.unit or "1", "long_name": name})
            column.dims[0].attach_scale(times)
        # what the samples were computed from, as text
        origin = {
            "declaration": archive.declaration,
            "parameters": json.dumps(dict(archive.parameters)),
            "events": json.dumps([dict(event) for event in archive.events]),
            "details": json.dumps(dict(archive.details)),
            "origin": json.dumps(dict(archive.origin)),
        }
        group = root.create_group(_MOTION)
        for name, text in origin.items():
            group.create_dataset(name, data=text, dtype=h5py.string_dtype())
    content = memory.getvalue() + payload + counted(len(payload))
    write_whole(Path(path), content + _seal(content))


def read_archive(path: str | Path) -> Archive:
    """Read a motion from a file that `write_archive` wrote; its samples are not read.

    Raises:
        StoreError: for a file that cannot be read, is damaged, or was not written by this
            version of polhode.
    """
    whole = read_whole(Path(path), "a motion that polhode wrote")
    size = max(len(whole) - len(_SEAL) - _DIGEST, 0)
    content, seal = whole[:size], whole[size:]
    if whole.startswith(_MAGIC) and seal[len(_SEAL) - len(_EARLIER) :].startswith(_EARLIER):
        raise StoreError(
            f"{path} was written by an earlier version of polhode",
            expected="a motion that this version wrote",
            advice="compute it again, or load it with the version that wrote it",
        )
    if not whole.startswith(_MAGIC) or not seal.startswith(_SEAL):
        raise StoreError(
            f"{path} is not a motion that polhode wrote, or it was truncated or changed",
            expected="a file from run.save(...)",
        )
    if seal != _seal(content):
        raise _damaged(path, "its checksum is wrong")
    inside, length = content[:-_LENGTH], int.from_bytes(content[-_LENGTH:], "little")
    try:
        if length > len(inside):
            raise ValueError("its length is not the one it states")
        return unpacked(inside[len(inside) - length :])
    except (LookupError, OverflowError, ValueError) as error:
        raise _damaged(path, error) from error


# -- the checksum ----------------------------------------------------------------------------------


def _seal(content: bytes) -> bytes:
    return _SEAL + hashlib.sha256(content).digest()


def _damaged(path: str | Path, what: object) -> StoreError:
    return StoreError(
        f"{path} is damaged: {str(what)[:200]}",
        expected="a motion as polhode wrote it",
        advice="use another copy of it, or compute it again",
    )
