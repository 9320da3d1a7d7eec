"""Results of a sweep on disk: Zarr chunks, each complete or absent.

The data of a chunk are written first and its mark last, so that after an interruption at any point
a chunk without a mark is computed again. The marks are read before anything is written.
"""

from __future__ import annotations

import json
import signal
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from shutil import rmtree
from signal import SIGINT, SIGTERM
from threading import current_thread, main_thread
from time import sleep
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from polhode.base import SCHEMA, PolhodeError, StoreError, extra, write_whole
from polhode.study._ensemble_runner import Reason, ResultChunk
from polhode.study._grid import Grid
from polhode.study._output import CodeTable
from polhode.study._outputs import Outputs

if TYPE_CHECKING:
    import xarray


ATTRIBUTE = "polhode"
DONE, REASON = "done", "reason"


@dataclass(frozen=True)
class Store:
    """A sweep on disk.

    Attributes:
        path: of the folder.
        group: of its arrays.
    """

    path: Path
    group: Any

    @property
    def origin(self) -> Mapping[str, Any]:
        """Everything that the results depend on."""
        with intact(self.path):
            return dict(self.group.attrs[ATTRIBUTE])

    @property
    def done(self) -> NDArray[np.bool_]:
        """Which chunks are complete, shape of the grid of chunks."""
        with intact(self.path):
            return np.asarray(self.group[DONE][...]).astype(bool)

    def failed(self) -> int:
        """Number of members that failed; read chunk by chunk."""
        with intact(self.path):
            reason = self.group[REASON]
            return sum(
                int(np.sum(reason.blocks[tuple(place)] > Reason.DONE))
                for place in np.argwhere(self.done)
            )

    def write(self, grid: Grid, place: tuple[int, ...], results: ResultChunk) -> None:
        """Write a chunk, and then its mark.

        Raises:
            StoreError: where it cannot be written.
        """
        region = grid.region(place)
        shape = tuple(r.stop - r.start for r in region)
        with intact(self.path), written(self.path), _uninterrupted():
            for name, values in results.values.items():
                self.group[name][region] = values.reshape(*shape, *values.shape[1:])
            self.group[REASON][region] = results.reason.reshape(shape)
            if results.failures:
                write_whole(self._words(place), json.dumps(_words(results)).encode())
            self.group[DONE][place] = 1

    def failures(self, place: tuple[int, ...]) -> dict[int, str]:
        """Why members of a chunk failed, in words, by their index in it."""
        path = self._words(place)
        if not path.exists():
            return {}
        with intact(self.path):
            return {int(i): text for i, text in json.loads(path.read_text()).items()}

    def failure(self) -> str:
        """Why one of the members failed, in words; empty where none did."""
        places = (tuple(map(int, place)) for place in np.argwhere(self.done))
        return next((text for p in places for text in self.failures(p).values()), "")

    def _words(self, place: tuple[int, ...]) -> Path:
        # In the folder of an array: in that of the group, Zarr would take it for a member.
        return self.path / REASON / f"words.{'.'.join(map(str, place))}.json"


def _words(results: ResultChunk) -> dict[str, str]:
    return {str(i): text for i, text in results.failures.items()}


def created(
    path: Path, origin: Mapping[str, Any], grid: Grid, outputs: Outputs, legend: CodeTable
) -> Store:
    """A new, empty store.

    Raises:
        StoreError: where it cannot be written, or exists already.
    """
    if path.exists() and (not path.is_dir() or any(path.iterdir())):
        raise StoreError(
            f"{path} exists already",
            expected="a new folder, or the store of the same sweep to continue",
            advice="choose another name, or continue with resume=True",
            option="resume",
        )
    with written(path), _whole_or_gone(path), _uninterrupted():
        group = _zarr().create_group(path, zarr_format=3)
        for name, column in grid.columns.items():
            group.create_array(
                grid.called[name],
                data=column.values,
                dimension_names=[grid.axis[name]],
                attributes={"units": column.unit} if column.unit else {},
            )
        for name, output in outputs.items():
            labels = output.labels(legend)
            own = tuple(f"{name}_{k}" for k in range(len(output.shape)))
            group.create_array(
                name,
                shape=(*grid.shape, *output.shape),
                chunks=(*grid.chunk, *output.shape),
                dtype="int16" if labels else "float64",
                fill_value=-1 if labels else np.nan,
                dimension_names=[*grid.axes, *own],
                attributes={"labels": list(labels)} if labels else {},
            )
        group.create_array(
            REASON,
            shape=grid.shape,
            chunks=grid.chunk,
            dtype="int8",
            fill_value=int(Reason.NOT_YET),
            dimension_names=list(grid.axes),
            attributes={"labels": {r.name.lower(): int(r) for r in Reason}},
        )
        group.create_array(
            DONE,
            shape=grid.chunks,
            chunks=(1,) * len(grid.chunks),
            dtype="uint8",
            fill_value=0,
            dimension_names=[f"{axis}_chunk" for axis in grid.axes],
        )
        group.attrs[ATTRIBUTE] = dict(origin)  # last: without it this is no store
    return Store(path, group)


def open_store(path: Path, mode: str = "r") -> Store:
    """An existing store.

    Raises:
        StoreError: if there is none, or it has another schema.
    """
    if not path.exists():
        raise StoreError(f"{path} does not exist", expected="a store that a sweep wrote")
    library = _zarr()
    try:
        group = library.open_group(path, mode=mode, zarr_format=3)
        schema = group.attrs[ATTRIBUTE]["schema"]
    except Exception as error:  # zarr raises errors of many types
        raise StoreError(
            f"{path} is not a store of a sweep ({type(error).__name__})",
            expected="a folder that polhode sweep wrote",
        ) from error
    if schema != SCHEMA:
        raise StoreError(
            f"{path} has schema {schema!r}",
            expected=f"schema {SCHEMA}",
            advice="read it with the version of polhode that wrote it",
        )
    return Store(path, group)


def dataset(path: Path) -> xarray.Dataset:
    """A store as a data set that is read lazily.

    Raises:
        StoreError: if there is none, or xarray is not installed.
    """
    with extra("xarray", "study"):
        import xarray
    store = open_store(path)
    with intact(path):
        found: xarray.Dataset = xarray.open_zarr(
            path, consolidated=False, chunks=None, mask_and_scale=False
        )
        axes = store.origin["axes"]
        return found.set_coords([axis["coordinate"] for axis in axes.values()])


def _zarr() -> Any:
    with extra("zarr", "study"):
        import zarr
    return zarr


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Let Ctrl-C and SIGTERM wait for the end of this block, if they are handled in Python.

    Zarr writes in its own thread; an exception in this one would abandon a chunk half written.
    """
    if current_thread() is not main_thread():
        yield
        return
    caught: list[int] = []
    handlers = {n: h for n in (SIGINT, SIGTERM) if callable(h := signal.getsignal(n))}
    for number in handlers:
        signal.signal(number, lambda number, frame: caught.append(number))
    try:
        yield
    finally:
        for number, handler in handlers.items():
            signal.signal(number, handler)
        if caught:
            signal.raise_signal(caught[0])


_REMOVALS, _PAUSE = 20, 0.02  # attempts to remove a store, and s after each


@contextmanager
def _whole_or_gone(path: Path) -> Iterator[None]:
    """Remove a store that could not be created fully, or it would block the next attempt."""
    try:
        yield
    except BaseException:
        # Zarr's thread may still be writing other files, and makes their folders again
        for _ in range(_REMOVALS):
            rmtree(path, ignore_errors=True)
            sleep(_PAUSE)
            if not path.exists():
                break
        raise


@contextmanager
def intact(path: Path) -> Iterator[None]:
    """For code that fails only if the store is damaged.

    Raises:
        StoreError: if it fails.
    """
    try:
        yield
    except PolhodeError:
        raise
    except Exception as error:  # damaged files raise errors of any type
        raise StoreError(
            f"{path} is damaged ({type(error).__name__}: {error})"[:300],
            expected="an unchanged store that polhode sweep wrote",
            advice="restore a copy of it, or compute it again under another name",
        ) from error


@contextmanager
def written(path: Path) -> Iterator[None]:
    """For code that writes a store.

    Raises:
        StoreError: where it cannot be written.
    """
    try:
        yield
    except OSError as error:
        raise StoreError(
            f"{path} cannot be written ({error.strerror or error})",
            expected="a writable folder on a disk with free space",
            advice="finished chunks are kept: free some space and continue with resume=True",
            option="resume",
        ) from error
