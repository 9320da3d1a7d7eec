"""The kernel run by wasmtime within Python."""

from __future__ import annotations

import os
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import cache
from hashlib import blake2b
from pathlib import Path
from typing import Any

import numpy as np
import wasmtime
from numpy.typing import NDArray

from polhode.base import NumericError
from polhode.base import cache as cache_on_disk
from polhode.simulate.kernel._assembly import PAGE
from polhode.simulate.kernel._layout import DOUBLE_PLACES, INTEGER_PLACES, RECORD_HEAD, Layout
from polhode.simulate.kernel._steps import Status, kernel_binary

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Steps:
    """Consecutive steps of a motion.

    Attributes:
        begins: of the steps, as sums of two doubles, s, shape (steps, 2).
        lengths: s, shape (steps,).
        shares: coefficients of the powers of the share of a step that has passed, shape
            (steps, states, order + 1).
        end: of the last step, as the sum of two doubles, s.
        state: there.
        status: why there are no more.
        falls: where a guard has fallen, how much later each of them falls, as a share of the step
            that was cut short there; infinite for those that do not fall within it.
    """

    begins: Array
    lengths: Array
    shares: Array
    end: tuple[float, float]
    state: Array
    status: Status
    falls: Array

    def stopped(self, taken: int) -> Steps:
        """The first of them, after which the host has stopped."""
        if taken == len(self.lengths):
            return replace(self, status=Status.STOPPED)
        return Steps(
            self.begins[:taken],
            self.lengths[:taken],
            self.shares[:taken],
            tuple(self.begins[taken].tolist()),
            self.shares[taken, :, 0],
            Status.STOPPED,
            np.empty(0),
        )


_FOLDER = "kernel"


@cache
def _key() -> str:
    """Under which the kernel is kept: a digest of the code that makes it."""
    digest = blake2b(digest_size=20)
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()


@cache
def _compiled(process: int) -> tuple[wasmtime.Engine, wasmtime.Module]:
    """The kernel, compiled once for a process: the threads of an engine do not cross a fork."""
    config = wasmtime.Config()
    # By default every memory reserves gigabytes of the address space, which processes with a bound
    # on it do not have; the kernel's memory grows once, to a size that is known by then. The module
    # is small: threads would take longer to start than to compile it.
    config.parallel_compilation = False
    config.memory_reservation = 0
    config.memory_guard_size = 0
    config.memory_reservation_for_growth = 0
    engine = wasmtime.Engine(config)
    kept = cache_on_disk.read(_FOLDER, _key())
    if kept is not None:
        with suppress(wasmtime.WasmtimeError):  # not a module: made anew
            return engine, wasmtime.Module(engine, kept)
    binary = kernel_binary()
    cache_on_disk.write(_FOLDER, _key(), binary)
    return engine, wasmtime.Module(engine, binary)


class _Instance:
    """A kernel in memory, with the tape of one system."""

    def __init__(self, layout: Layout) -> None:
        engine, module = _compiled(os.getpid())
        self._store = wasmtime.Store(engine)
        exports = wasmtime.Instance(self._store, module, []).exports(self._store)
        memory: Any = exports["memory"]
        self._functions: Any = exports
        missing = -(-layout.size // PAGE) - memory.size(self._store)
        try:
            memory.grow(self._store, max(0, missing))
        except wasmtime.WasmtimeError as error:
            raise _too_large(layout) from error
        # A view of the memory is valid until it grows: it has its final size from here on.
        view = np.frombuffer(memory.get_buffer_ptr(self._store), dtype=np.uint8)
        for place, content in layout.image().items():
            view[place : place + len(content)] = np.frombuffer(content, dtype=np.uint8)
        self.integers = view.view(np.int32)
        self.doubles = view.view(np.float64)

    def call(self, name: str, *given: int) -> Any:
        """Call an exported function."""
        return self._functions[name](self._store, *given)


class Kernel:
    """A kernel with the tape of one system: it holds the state of a motion.

    Motions begin with `start`; a copy in another process, by fork or pickle, begins with none.

    Args:
        layout: of its memory.
    """

    def __init__(self, layout: Layout) -> None:
        self._layout = layout
        self._process = 0
        self._instance: _Instance

    def __reduce__(self) -> tuple[type[Kernel], tuple[Layout]]:
        return Kernel, (self._layout,)

    def start(
        self, parameters: Array, time: float, state: Array, weights: Array | float = 1.0
    ) -> None:
        """Begin a motion.

        Args:
            time: s.
            weights: by which the states are multiplied where their size determines the step.
        """
        layout = self._layout
        states = layout.tape.states
        if self._process != os.getpid():
            self._process, self._instance = os.getpid(), _Instance(layout)
        self._instance.doubles[_words(layout.parameters)] = parameters
        self._part("weights", states)[:] = weights
        self._states[:] = state
        self._set("time", time)
        self._instance.call("start")

    def advance(self, goal: float, longest: float, most: int) -> Steps:
        """Take steps, until the goal is reached or as far as it goes.

        Args:
            goal: s.
            longest: step, s.
            most: steps; the layout limits them as well.
        """
        layout = self._layout
        self._set("goal", goal)
        self._set("longest", longest)
        status = Status(self._instance.call("advance", min(most, layout.steps)))
        done = int(self._instance.integers[INTEGER_PLACES["done"] // 4])
        records = (
            self._part("records", done * layout.record // 8)
            .reshape(done, layout.record // 8)
            .copy()
        )
        series = records[:, RECORD_HEAD:].reshape(done, layout.tape.states, layout.order + 1)
        end = (self._get("time"), self._get("rest"))
        falls = self._part("falls", layout.guards if status is Status.FALL else 0).copy()
        falls -= np.min(falls, initial=np.inf)
        return Steps(records[:, :2], records[:, 2], series, end, self._states.copy(), status, falls)

    # -- the memory -----------------------------------------------------------------------------

    @property
    def _states(self) -> Array:
        return self._instance.doubles[_words(self._layout.states)]

    def _part(self, name: str, size: int) -> Array:
        first = self._layout.places[name] // 8
        return self._instance.doubles[first : first + size]

    def _set(self, name: str, value: float) -> None:
        self._instance.doubles[DOUBLE_PLACES[name] // 8] = value

    def _get(self, name: str) -> float:
        return float(self._instance.doubles[DOUBLE_PLACES[name] // 8])


def _words(addresses: range) -> slice:
    """The doubles at addresses that follow one another."""
    return slice(addresses.start // 8, addresses.stop // 8, addresses.step // 8)


def _too_large(layout: Layout) -> NumericError:
    return NumericError(
        f"equations of {len(layout.tape.varying)} operations, which need {layout.size / 2**20:.0f} "
        "MiB of memory to integrate",
        expected="as much memory to be free, and less than 4 GiB",
        advice="allow the process more memory, or choose fewer bodies",
    )
