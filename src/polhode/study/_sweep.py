"""Motions over a grid of parameters and start values, stored on disk as they are computed."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing, contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode.algebra import Expr
from polhode.base import (
    DeclarationError,
    Progress,
    SilentProgress,
    StoreError,
    installed_version,
    provenance,
)
from polhode.derive import Equations
from polhode.model import System, write_declaration
from polhode.simulate import Pieces
from polhode.study._columns import Name, published_names, random_seed, whole
from polhode.study._compute import Compute, in_processes, on_cluster, one_after_the_other, scheduler
from polhode.study._ensemble import USUAL
from polhode.study._ensemble_runner import EnsembleSpec, Subject, options_of
from polhode.study._grid import SAMPLE, Grid, grid_of, split_axes
from polhode.study._output import Output, Quantity
from polhode.study._outputs import outputs_of
from polhode.study._refused import parameter_names, refuse_mistakes
from polhode.study._store import Store, created, dataset, intact, open_store

if TYPE_CHECKING:
    import xarray


def sweep(
    subject: Subject,
    axes: Mapping[Name, Any],
    parameters: Mapping[Name, Any],
    start: Mapping[Name, Any],
    duration: Any,
    *,
    out: str | Path,
    outputs: Mapping[str, Output | Quantity] | Sequence[Output | Quantity] = USUAL,
    samples: int | None = None,
    seed: int | None = None,
    chunk: int | None = None,
    resume: bool = False,
    workers: int = 1,
    client: Any = None,
    address: str = "",
    forcing: Mapping[Name, Expr] | None = None,
    tolerance: float | None = None,
    near_flat: float | None = None,
    until: Sequence[str] | None = None,
    progress: Progress | None = None,
) -> xarray.Dataset:
    """Simulate every combination of some values, and keep chosen outputs on disk.

    Only a few chunks are in memory at a time, whatever the size of the sweep. Chunks are written
    completely or not at all; an interrupted sweep can be resumed, and its results agree bit for
    bit with those of an uninterrupted one.

    Args:
        subject: a declaration, its automaton, or equations derived from it.
        axes: values of every quantity that varies, as an array, `(array, "deg")`, or a
            distribution of scipy.stats. Arrays span a grid; random values share one further axis,
            `sample`. A name that is not a parameter is a start value.
        parameters: values of all other parameters.
        start: other start values.
        duration: s.
        out: folder to write the store to.
        outputs: as in `ensemble`.
        samples: number of values drawn from distributions.
        seed: of random values; by default a new one.
        chunk: approximate number of members of a chunk.
        resume: continue the store at `out`, if there is one.
        workers: number of worker processes on this machine.
        client: of a Dask cluster to compute on.
        address: of the scheduler of a Dask cluster to compute on.
        until: as in `ensemble`.
        forcing, tolerance, near_flat: as in `simulate`.
        progress: called for every member.

    Returns:
        The store, opened: arrays over the axes, read from disk when they are needed.

    Raises:
        DeclarationError: for ambiguous axes or outputs.
        StoreError: where the store cannot be written or is another sweep's, or no scheduler
            answers.
        UnitError: for a duration that cannot be read.
    """
    path = Path(out)
    existing = open_store(path, "r+") if resume and path.exists() and any(path.iterdir()) else None
    drawn = _seed(seed, existing)
    options = options_of(forcing=forcing, tolerance=tolerance, near_flat=near_flat, until=until)
    spec = EnsembleSpec(subject, duration, outputs_of(outputs), options)
    grid = grid_of(axes, samples, drawn, chunk, spec.outputs)
    spec.experiment()  # refuses options that no member can have
    fixed = (published_names(parameters), published_names(start))
    own, others = split_axes(list(grid.columns), parameter_names(spec))
    constants = {**fixed[0], **dict.fromkeys(own)}
    columns = grid.columns
    refuse_mistakes(
        spec,
        {**fixed[0], **{name: columns[name] for name in own}},
        {**fixed[1], **{name: columns[name] for name in others}},
    )
    origin = _origin(spec, grid, fixed, drawn)
    with _computing(whole(workers, "workers"), client, address) as compute:
        if existing is None:
            store = created(path, origin, grid, spec.outputs, spec.legend)
        else:
            _refuse_other(existing, origin)
            store = existing
        done = store.done
        if done.shape != grid.chunks:
            raise StoreError(
                f"{path} is damaged: {done.shape} chunks", expected=f"{grid.chunks} of them"
            )
        left = [place for place in grid.places() if not done[place]]
        chunks = ((place, grid.members(place, constants, fixed[1])) for place in left)
        with (
            _shown(progress, store, grid) as tick,
            closing(compute(spec, chunks, tick)) as computed,
        ):
            for place, results in computed:
                store.write(grid, place, results)
    return dataset(path)


def _seed(seed: int | None, existing: Store | None) -> int:
    """The given seed, that of the store to continue, or a new one."""
    if seed is None and existing is not None:
        with intact(existing.path):
            return int(existing.origin["seed"] or 0)
    return random_seed(seed)


@contextmanager
def _computing(workers: int, client: Any, address: str) -> Iterator[Compute]:
    """The way to compute chunks: a cluster, worker processes, or this process."""
    if client is not None:
        if not hasattr(client, "submit"):
            raise DeclarationError(f"the client {client!r}", expected="a dask.distributed.Client")
        yield partial(on_cluster, client)
    elif address:
        with scheduler(address) as connected:
            yield partial(on_cluster, connected)
    elif workers > 1:
        yield partial(in_processes, workers)
    else:
        yield one_after_the_other


@contextmanager
def _shown(progress: Progress | None, store: Store, grid: Grid) -> Iterator[Callable[[int], None]]:
    """Show progress by members; an interrupt gets a note that says how much is kept."""
    shown = progress or SilentProgress()
    total = int(np.prod(grid.chunks))
    shown.begin("members", grid.size)
    shown.advance(int(np.sum(store.done)) * (grid.size // total))
    try:
        yield shown.advance
    except KeyboardInterrupt as interrupt:
        kept = int(np.sum(store.done))
        interrupt.add_note(f"kept {kept} of {total} chunks in {store.path}")
        raise
    finally:
        shown.finish()


# -- origin of the results -------------------------------------------------------------------------


def _origin(
    spec: EnsembleSpec, grid: Grid, fixed: tuple[Mapping[str, Any], Mapping[str, Any]], seed: int
) -> dict[str, Any]:
    """Everything the results depend on, as JSON; a resumed sweep must have the same."""
    system = spec.subject if isinstance(spec.subject, System) else spec.subject.system
    found = provenance(seed if SAMPLE in grid.axes else None)
    for name in ("zarr", "xarray"):
        found["versions"][name] = installed_version(name)
    axes = {
        name: {
            "axis": grid.axis[name],
            "coordinate": grid.called[name],
            "units": column.unit,
            "values": _digest(column.values),
        }
        for name, column in grid.columns.items()
    }
    return {
        **found,
        "system": system.name,
        "declaration": json.loads(write_declaration(system)),
        "kept_to_one_mode": isinstance(spec.subject, Equations),
        "parameters": {name: _plain(value) for name, value in fixed[0].items()},
        "start": {name: _plain(value) for name, value in fixed[1].items()},
        "duration": _plain(spec.duration),
        "options": {name: _plain(value) for name, value in spec.options.items()},
        "axes": axes,
        "outputs": {name: _plain(output) for name, output in spec.outputs.items()},
        "batch": {"chunk": list(grid.chunk), "shape": list(grid.shape)},
    }


def _digest(values: Any) -> str:
    from hashlib import sha256

    return sha256(np.ascontiguousarray(values).tobytes()).hexdigest()


def _plain(value: Any) -> Any:
    match value:
        case bool() | int() | float() | str() | None:
            return value
        case Mapping():
            return {str(key): _plain(v) for key, v in value.items()}
        case list() | tuple():
            return [_plain(v) for v in value]
        case np.generic():
            return value.item()
        case Expr():
            return str(value)
        case Pieces():
            return [_digest(array) for array in (value.knots, value.coefficients)]
        case _ if callable(value):
            raise DeclarationError(
                "a Python function in a sweep",
                expected="an expression of time, or samples, which a store can record",
                advice="sample it, and turn the samples into a motion with polhode.sampled",
            )
        case _:
            return repr(value)


def _refuse_other(store: Store, origin: Mapping[str, Any]) -> None:
    """Refuse to resume a store whose sweep differs."""
    before = store.origin
    different = [key for key in origin if json.dumps(before.get(key)) != json.dumps(origin[key])]
    if not different:
        return
    expected = "the same sweep with the same versions, for consistent results"
    if different == ["versions"]:
        old, new = before["versions"], origin["versions"]
        changed = [f"{n} {old.get(n)} (now {new[n]})" for n in new if old.get(n) != new[n]]
        given = f"{store.path} was made with {', '.join(changed)}"
    else:
        given = f"{store.path} is of a sweep with different {', '.join(different)}"
    raise StoreError(given, expected=expected, advice="choose another name for this sweep")
