"""Members shared out among processes of this machine."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import ProcessPoolExecutor, as_completed
from contextlib import contextmanager
from multiprocessing import get_context

import numpy as np
from numpy.typing import NDArray

from polhode.study._columns import Members
from polhode.study._ensemble_runner import EnsembleRunner, EnsembleSpec, ResultChunk, Tick

_SHARES = 4  # per process: members differ in what they take
_SMALLEST = 8

_here: list[EnsembleRunner] = []


def shared_out(order: EnsembleSpec, members: Members, workers: int, tick: Tick) -> ResultChunk:
    """The same block as of one process, made by several."""
    if workers == 1 or members.count == 1:
        return EnsembleRunner(order).follow(members, tick)
    block = ResultChunk.empty(order, members.count)
    with _pool(order, workers) as pool:
        waiting = {
            pool.submit(_share, members.rows(rows)): rows
            for rows in _shares(members.count, workers)
        }
        for done in as_completed(waiting):
            block = block.put(waiting[done], done.result())
            tick(len(waiting[done]))
    return block


def _shares(count: int, workers: int) -> list[NDArray[np.intp]]:
    size = max(_SMALLEST, -(-count // (workers * _SHARES)))
    return [np.arange(a, min(a + size, count)) for a in range(0, count, size)]


@contextmanager
def _pool(order: EnsembleSpec, workers: int) -> Iterator[ProcessPoolExecutor]:
    # Fresh processes: a copy of one with threads in it may hang.
    pool = ProcessPoolExecutor(workers, get_context("spawn"), _begin, (order,))
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


def _begin(order: EnsembleSpec) -> None:
    _here[:] = [EnsembleRunner(order)]


def _share(members: Members) -> ResultChunk:
    return _here[0].follow(members, _nobody)


def _nobody(count: int) -> None:
    """Is told nothing."""
