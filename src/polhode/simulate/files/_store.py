"""Motions in files: HDF5, laid out as NetCDF-4, so that others' tools read the samples.

The samples are variables over `t` at the root. Below the group `polhode.motion` lies what it takes
to have the same motion again: the declaration, the parameters, the events, and the series of every
stretch. At its end the file carries a checksum of all before it, which HDF5's own tools pass over.
"""

from __future__ import annotations

import hashlib
import io
import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import numpy as np

from polhode.base import SCHEMA, StoreError, extra, write_whole
from polhode.simulate.files._archive import Archive, Sampled, Stretch
from polhode.simulate.integrate._stepping import Array

_FORMAT = "polhode motion"
_MOTION = "polhode.motion"
_MAGIC = b"\x89HDF\r\n\x1a\n"
_SEAL = b"polhode sha-256:"
_TEXTS = ("declaration", "events", "details", "origin")


def write_archive(path: str | Path, archive: Archive) -> None:
    """Write a motion to a file, whole or not at all; the same file for the same motion.

    Raises:
        StoreError: where the file cannot be written, or h5py is not installed.
    """
    with extra("h5py", "data"):
        import h5py
    memory = io.BytesIO()
    with h5py.File(memory, "w", track_order=True) as root:
        root.attrs.update({"format": _FORMAT, "schema": SCHEMA})
        _write_samples(root, archive)
        _write_motion(root.create_group(_MOTION), archive, h5py)
    content = memory.getvalue()
    write_whole(Path(path), content + _seal(content))


def read_archive(path: str | Path) -> Archive:
    """Read a motion from a file that `write_archive` wrote.

    Raises:
        StoreError: for a file that cannot be read, is damaged, was not written by polhode or by
            another version of it.
    """
    with extra("h5py", "data"):
        import h5py
    content = _unsealed(Path(path))
    try:
        with h5py.File(io.BytesIO(content), "r") as root:
            return _archive(_Reader(h5py, len(content)), root)
    except (ArithmeticError, AttributeError, LookupError, OSError, RecursionError) as error:
        raise _damaged(path, error) from error
    except (RuntimeError, TypeError, ValueError) as error:
        raise _damaged(path, error) from error


# -- writing ---------------------------------------------------------------------------------------


def _write_samples(root: Any, archive: Archive) -> None:
    times = root.create_dataset("t", data=archive.times)
    times.attrs.update({"units": "s", "long_name": "time"})
    times.make_scale("t")
    for name, sampled in archive.samples.items():
        column = root.create_dataset(_key(name), data=sampled.values)
        column.attrs.update({"units": sampled.unit or "1", "long_name": name})
        column.dims[0].attach_scale(times)


def _key(name: str) -> str:
    return name.replace("/", "|")


def _write_motion(group: Any, archive: Archive, h5py: Any) -> None:
    text = h5py.string_dtype()
    group.create_dataset("declaration", data=archive.declaration, dtype=text)
    for name in _TEXTS[1:]:
        value = getattr(archive, name)
        plain = list(value) if isinstance(value, tuple) else dict(value)
        group.create_dataset(name, data=json.dumps(plain), dtype=text)
    _write_numbers(group, "parameters", archive.parameters.items(), text)
    for number, stretch in enumerate(archive.stretches):
        part = group.create_group(f"stretch {number:06d}")
        part.attrs.update({"mode": stretch.mode, "segment": stretch.segment})
        part.create_dataset("states", data=list(stretch.states), dtype=text)
        _write_numbers(part, "constants", stretch.constants.items(), text)
        for name in ("steps", "knots", "series"):
            part.create_dataset(name, data=getattr(stretch, name))


def _write_numbers(group: Any, name: str, pairs: Iterable[tuple[str, float]], text: Any) -> None:
    table = list(pairs)
    part = group.create_group(name)
    part.create_dataset("names", data=[name for name, _ in table], dtype=text)
    part.create_dataset("values", data=np.array([value for _, value in table], dtype=float))


def _seal(content: bytes) -> bytes:
    return _SEAL + hashlib.sha256(content).digest()


# -- reading ---------------------------------------------------------------------------------------


def _unsealed(path: Path) -> bytes:
    try:
        content = path.read_bytes()
    except OSError as error:
        raise StoreError(
            f"{path} cannot be read ({error.strerror})", expected="a motion that polhode wrote"
        ) from error
    size = len(content) - len(_seal(b""))
    inside, seal = content[: max(size, 0)], content[max(size, 0) :]
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


class _Reader:
    """Takes plain data out of a file that may have been made to do harm: no links, no filters."""

    def __init__(self, h5py: Any, size: int) -> None:
        self._h5py = h5py
        self._size = size

    def group(self, parent: Any, name: str) -> Any:
        """A group within another."""
        return self._item(parent, name, self._h5py.Group)

    def numbers(self, parent: Any, name: str, rank: int) -> Array:
        """An array of floats with this many axes."""
        data = self._dataset(parent, name)
        if data.dtype != np.dtype("<f8") or len(data.shape) != rank:
            raise ValueError(f"{name} of type {data.dtype} and shape {data.shape}")
        return np.asarray(data[()], dtype=float)

    def text(self, parent: Any, name: str) -> str:
        """One text."""
        data = self._dataset(parent, name)
        return str(data.asstr()[()])

    def texts(self, parent: Any, name: str) -> tuple[str, ...]:
        """A list of texts."""
        data = self._dataset(parent, name)
        return tuple(str(item) for item in data.asstr()[()].tolist())

    def table(self, parent: Any, name: str) -> dict[str, float]:
        """Numbers by name."""
        part = self.group(parent, name)
        values = self.numbers(part, "values", 1).tolist()
        return dict(zip(self.texts(part, "names"), values, strict=True))

    def _dataset(self, parent: Any, name: str) -> Any:
        data = self._item(parent, name, self._h5py.Dataset)
        filtered = data.chunks or data.is_virtual or data.external
        if filtered or data.size * data.dtype.itemsize > self._size:
            raise ValueError(f"{name} is not laid out as polhode does")
        return data

    def _item(self, parent: Any, name: str, kind: type) -> Any:
        if not isinstance(parent.get(name, getlink=True), self._h5py.HardLink):
            raise ValueError(f"no {name} in it")
        item = parent[name]
        if not isinstance(item, kind):
            raise ValueError(f"{name} is no {kind.__name__.lower()}")
        return item


def _archive(reader: _Reader, root: Any) -> Archive:
    if root.attrs.get("format") != _FORMAT:
        raise ValueError("it is of another kind")
    if root.attrs.get("schema") != SCHEMA:
        raise ValueError(f"it is of schema {root.attrs.get('schema')}, not {SCHEMA}")
    group = reader.group(root, _MOTION)
    declaration, events, details, origin = (reader.text(group, name) for name in _TEXTS)
    times = reader.numbers(root, "t", 1)
    return Archive(
        declaration=declaration,
        parameters=reader.table(group, "parameters"),
        stretches=tuple(
            _stretch(reader, reader.group(group, name))
            for name in sorted(group)
            if name.startswith("stretch ")
        ),
        events=tuple(_mapping(event) for event in json.loads(events)),
        times=times,
        samples=dict(_samples(reader, root, len(times))),
        details=_mapping(json.loads(details)),
        origin=_mapping(json.loads(origin)),
    )


def _samples(reader: _Reader, root: Any, count: int) -> Iterable[tuple[str, Sampled]]:
    for key in root:
        if key not in ("t", _MOTION):
            values = reader.numbers(root, key, 1)
            unit, name = (str(root[key].attrs[word]) for word in ("units", "long_name"))
            if len(values) != count:
                raise ValueError(f"{len(values)} values of {name} at {count} times")
            yield name, Sampled("" if unit == "1" else unit, values)


def _stretch(reader: _Reader, part: Any) -> Stretch:
    states = reader.texts(part, "states")
    knots, series = reader.numbers(part, "knots", 1), reader.numbers(part, "series", 3)
    if series.shape[::2] != (len(knots) - 1, len(states)) or not np.all(np.diff(knots) > 0):
        raise ValueError("series that do not fit their knots")
    return Stretch(
        segment=int(part.attrs["segment"]),
        mode=str(part.attrs["mode"]),
        states=states,
        constants=reader.table(part, "constants"),
        steps=reader.numbers(part, "steps", 1),
        knots=knots,
        series=series,
    )


def _mapping(value: Any) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise ValueError("a list where names are expected")
    return value
