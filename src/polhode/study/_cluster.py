"""Chunks computed one after the other here, by processes of this machine, or on a cluster."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import partial
from itertools import islice
from logging import CRITICAL
from threading import local
from typing import Any, Protocol, TypeAlias
from uuid import uuid4

from polhode.base import StoreError
from polhode.study._columns import Members
from polhode.study._ensemble_runner import EnsembleRunner, EnsembleSpec, ResultChunk
from polhode.study._interrupts import uninterrupted
from polhode.study._libraries import distributed

Place: TypeAlias = tuple[int, ...]
Chunks: TypeAlias = Iterable[tuple[Place, Members]]

_WAITING = 4  # chunks per worker that are handed out at a time
_REACHED_WITHIN = 10.0  # seconds for a scheduler to answer
_KILL = getattr(signal, "SIGKILL", signal.SIGTERM)
_LOST = 8  # workers that one chunk may lose before it is given up

_kept = local()


class Compute(Protocol):
    """A way of computing chunks."""

    def __call__(self, order: EnsembleSpec, chunks: Chunks) -> Iterator[tuple[Place, ResultChunk]]:
        """Every chunk once, in whatever order they become ready."""
        ...


def one_after_the_other(tick: Callable[[int], None]) -> Compute:
    """In this process.

    Args:
        tick: told the number of members that are done.
    """

    def compute(order: EnsembleSpec, chunks: Chunks) -> Iterator[tuple[Place, ResultChunk]]:
        crew = EnsembleRunner(order)
        for place, members in chunks:
            yield place, crew.follow(members, tick)

    return compute


def on_cluster(client: Any, tick: Callable[[int], None]) -> Compute:
    """On the workers of a Dask cluster; those that are lost are made up for by the others.

    Results come here and are kept here, so that a chunk computed twice counts once.
    """

    def compute(order: EnsembleSpec, chunks: Chunks) -> Iterator[tuple[Place, ResultChunk]]:
        library = distributed()
        task = _Task(uuid4().hex, order)
        waiting, places = library.as_completed(), dict[str, Place]()
        left = iter(chunks)
        hand_out = max(1, len(client.scheduler_info()["workers"])) * _WAITING
        try:
            _hand_out(client, task, islice(left, hand_out), waiting, places)
            for done in waiting:
                place = places.pop(done.key)
                block = _received(done, place)
                tick(len(block.reason))
                _hand_out(client, task, islice(left, 1), waiting, places)
                yield place, block
        finally:
            client.cancel(list(waiting.futures), force=True)

    return compute


def _hand_out(
    client: Any, task: _Task, chunks: Chunks, waiting: Any, places: dict[str, Place]
) -> None:
    for place, members in chunks:
        future = client.submit(_chunk, task, members, pure=False, retries=_LOST)
        places[future.key] = place
        waiting.add(future)


def _received(done: Any, place: Place) -> ResultChunk:
    try:
        block: ResultChunk = done.result()
    except Exception as error:
        raise StoreError(
            f"the cluster lost the chunk {place} ({type(error).__name__}: {error})"[:300],
            expected="workers with polhode installed, in the same version, that stay alive",
            advice="what is done is kept: go on with resume=True",
            option="resume",
        ) from error
    return block


@dataclass(frozen=True)
class _Task:
    """An order, and a name under which a worker knows it again.

    It goes with every chunk: one copy for all would be lost with the worker that holds it.
    """

    name: str
    order: EnsembleSpec


def _chunk(task: _Task, members: Members) -> ResultChunk:
    """On a worker; one crew per thread, compiled for its first chunk."""
    if getattr(_kept, "name", None) != task.name:
        _kept.name, _kept.crew = task.name, EnsembleRunner(task.order)
    crew: EnsembleRunner = _kept.crew
    return crew.follow(members, _nobody)


def _nobody(count: int) -> None:
    """Is told nothing."""


@contextmanager
def scheduler(address: str) -> Iterator[Any]:
    """A client of a scheduler.

    Raises:
        StoreError: where it does not answer.
    """
    library = distributed()
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


@contextmanager
def processes(count: int) -> Iterator[Any]:
    """A client of a cluster of processes on this machine.

    An interrupt while it starts or ends waits until it has: its library does not stand one then.
    """
    library = distributed()
    with ExitStack() as ending:
        with uninterrupted():
            cluster = library.LocalCluster(
                n_workers=count,
                threads_per_worker=1,
                processes=True,
                dashboard_address=None,
                silence_logs=CRITICAL,  # what is lost for good comes as an error
            )
            ending.push(partial(_ended, cluster))
            client = library.Client(cluster)
            ending.callback(client.close)
        yield client


def _ended(cluster: Any, *failure: Any) -> None:
    """End a cluster; after a failure its workers are not waited for."""
    with uninterrupted():
        if any(failure):
            for nanny in cluster.workers.values():
                nanny.auto_restart = False
                if nanny.pid:
                    os.kill(nanny.pid, _KILL)
        cluster.close()
