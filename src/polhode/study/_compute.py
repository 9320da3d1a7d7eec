"""Chunks of members computed in this process, by worker processes, or on a Dask cluster.

A Dask cluster is not a pool of our own worker processes: it may span many machines, belongs to
somebody else, gains and loses workers, and schedules the chunks itself.
"""

from __future__ import annotations

from collections.abc import Callable, Generator, Iterable, Iterator
from contextlib import closing, contextmanager
from dataclasses import dataclass
from functools import partial
from itertools import islice
from threading import local
from typing import Any, TypeAlias
from uuid import uuid4

import numpy as np

from polhode.base import NumericError, StoreError, Tell, Worker, WorkerEndedError, answers, extra
from polhode.study._columns import Members
from polhode.study._ensemble_runner import EnsembleRunner, EnsembleSpec, ResultChunk, Tick

Place: TypeAlias = tuple[int, ...]
Chunk: TypeAlias = tuple[Place, Members]
Computed: TypeAlias = Generator[tuple[Place, ResultChunk], None, None]

_SHARES = 4  # chunks of an ensemble per worker process: some members take longer than others
_SMALLEST = 8  # members of such a chunk
_RETRIES = 3  # worker processes that may end on one chunk before it is given up
_QUEUED = 4  # chunks per worker of a cluster that are submitted ahead
_REACHED_WITHIN = 10.0  # seconds for a scheduler to answer
_LOST = 8  # workers of a cluster that may end on one chunk before it is given up


#: A way of computing chunks: every one once, in order of completion, with a function called with
#: the number of members that have just been completed. The generator must be closed.
Compute: TypeAlias = Callable[[EnsembleSpec, Iterable[Chunk], Tick], Computed]


def one_after_the_other(spec: EnsembleSpec, chunks: Iterable[Chunk], tick: Tick) -> Computed:
    """Compute chunks in this process."""
    runner = EnsembleRunner(spec)
    for place, members in chunks:
        yield place, runner.follow(members, tick)


# -- worker processes ------------------------------------------------------------------------------


def in_processes(workers: int, spec: EnsembleSpec, chunks: Iterable[Chunk], tick: Tick) -> Computed:
    """Compute chunks in worker processes of this machine; one that ends is replaced."""
    left = iter(chunks)

    def following(last: Chunk | None) -> Chunk | None:
        return next(left, None)

    begin = partial(Worker[Chunk, ResultChunk], partial(_chunk_worker, spec))
    try:
        with closing(answers(begin, workers, following, retries=_RETRIES)) as outcomes:
            for outcome in outcomes:
                if outcome.reply is None:
                    raise _ended(f"at the chunk {outcome.task[0]}")
                tick(len(outcome.reply.reason))
                yield outcome.task[0], outcome.reply
    except WorkerEndedError:
        raise _ended("before they could start") from None


def _chunk_worker(spec: EnsembleSpec) -> Callable[[Chunk, Tell[ResultChunk]], ResultChunk]:
    runner = EnsembleRunner(spec)
    return lambda chunk, tell: runner.follow(chunk[1], _no_tick)


def _no_tick(count: int) -> None:
    """For workers: members are counted when their chunk arrives in the main process."""


def _ended(when: str) -> NumericError:
    return NumericError(
        f"worker processes that ended {when}",
        expected="enough memory for all of them, and functions and classes that they can import",
        advice="use fewer workers, or a single one to see the error",
        option="workers",
    )


def in_shares(spec: EnsembleSpec, members: Members, workers: int, tick: Tick) -> ResultChunk:
    """Results of all members in order, independent of the number of worker processes."""
    if workers == 1 or members.count == 1:
        return EnsembleRunner(spec).follow(members, tick)
    size = max(_SMALLEST, -(-members.count // (workers * _SHARES)))
    shares = [
        np.arange(first, min(first + size, members.count))
        for first in range(0, members.count, size)
    ]
    chunks = (((number,), members.rows(rows)) for number, rows in enumerate(shares))
    results = ResultChunk.empty(spec, members.count)
    with closing(in_processes(workers, spec, chunks, tick)) as computed:
        for (number,), chunk in computed:
            results = results.put(shares[number], chunk)
    return results


# -- a Dask cluster --------------------------------------------------------------------------------


def on_cluster(client: Any, spec: EnsembleSpec, chunks: Iterable[Chunk], tick: Tick) -> Computed:
    """Compute chunks on a Dask cluster, which repeats those of workers that it loses.

    Results are collected and kept here, so that a chunk computed twice counts once.
    """
    library = _distributed()
    task = _ClusterTask(uuid4().hex, spec)
    waiting, places = library.as_completed(), dict[str, Place]()
    left = iter(chunks)

    def submit(count: int) -> None:
        for place, members in islice(left, count):
            # pure=False: Dask must not compare members by their hash to reuse results
            future = client.submit(_on_worker, task, members, pure=False, retries=_LOST)
            places[future.key] = place
            waiting.add(future)

    try:
        # A few chunks ahead keep workers busy; all of them would fill the scheduler's memory.
        submit(max(1, len(client.scheduler_info()["workers"])) * _QUEUED)
        for done in waiting:
            place = places.pop(done.key)
            chunk = _received(done, place)
            tick(len(chunk.reason))
            submit(1)
            yield place, chunk
    finally:
        client.cancel(list(waiting.futures), force=True)


def _received(done: Any, place: Place) -> ResultChunk:
    try:
        chunk: ResultChunk = done.result()
    except Exception as error:
        raise StoreError(
            f"the cluster lost the chunk {place} ({type(error).__name__}: {error})"[:300],
            expected="workers with polhode installed, in the same version, that stay alive",
            advice="finished chunks are kept: continue with resume=True",
            option="resume",
        ) from error
    return chunk


@dataclass(frozen=True)
class _ClusterTask:
    """The specification of an ensemble, with a name by which a worker recognises it.

    It is sent with every chunk: a single copy on the cluster would be lost with its worker.
    """

    name: str
    spec: EnsembleSpec


_per_thread = local()


def _on_worker(task: _ClusterTask, members: Members) -> ResultChunk:
    """Compute a chunk on a worker of a cluster.

    Each thread keeps one runner, compiled for its first chunk: a runner is not thread-safe.
    """
    if getattr(_per_thread, "name", None) != task.name:
        _per_thread.name, _per_thread.runner = task.name, EnsembleRunner(task.spec)
    runner: EnsembleRunner = _per_thread.runner
    return runner.follow(members, _no_tick)


@contextmanager
def scheduler(address: str) -> Iterator[Any]:
    """A client of a scheduler.

    Raises:
        StoreError: where it does not answer.
    """
    library = _distributed()
    try:
        client = library.Client(address, timeout=_REACHED_WITHIN)
    except (OSError, ValueError, TimeoutError) as error:
        raise StoreError(
            f"no scheduler answers at {address!r}",
            expected="the address of a Dask scheduler, such as tcp://host:8786",
            advice="start one with 'dask scheduler', and workers with 'dask worker ADDRESS'",
        ) from error
    with client:
        yield client


def _distributed() -> Any:
    with extra("dask.distributed", "study"):
        import distributed
    return distributed
