"""The kernel as Python uses it: motions in steps of Taylor series."""

from __future__ import annotations

import os
import struct
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from polhode.base import NumericError
from polhode.simulate.kernel._instance import Instance, instance
from polhode.simulate.kernel._layout import DOUBLE_PLACES, INTEGER_PLACES, RECORD_HEAD, Layout
from polhode.simulate.kernel._steps import Status

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


class Kernel:
    """A kernel with the tape of one system: it holds the state of a motion.

    Motions begin with `start`; a copy in another process, by fork or pickle, begins with none.

    Args:
        layout: of its memory.
    """

    def __init__(self, layout: Layout) -> None:
        self._layout = layout
        self._process = 0
        self._instance: Instance

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
        if self._process != os.getpid():
            self._process, self._instance = os.getpid(), _begun(layout)
        for address, value in zip(layout.parameters, parameters.tolist(), strict=True):
            self._put(address, value)
        self._put(layout.places["weights"], np.broadcast_to(weights, len(state)))
        for address, value in zip(layout.states, state.tolist(), strict=True):
            self._put(address, value)
        self._put(DOUBLE_PLACES["time"], time)
        self._instance.call("start")

    def advance(self, goal: float, longest: float, most: int) -> Steps:
        """Take steps, until the goal is reached or as far as it goes.

        Args:
            goal: s.
            longest: step, s.
            most: steps; the layout limits them as well.
        """
        layout, places = self._layout, self._layout.places
        self._put(DOUBLE_PLACES["goal"], goal)
        self._put(DOUBLE_PLACES["longest"], longest)
        status = Status(self._instance.call("advance", min(most, layout.steps)))
        (done,) = struct.unpack("<i", self._instance.read(INTEGER_PLACES["done"], 4))
        records = self._get(places["records"], done * layout.record)
        records = records.reshape(done, layout.record // 8)
        series = records[:, RECORD_HEAD:].reshape(done, layout.tape.states, layout.order + 1)
        time, rest = (float(self._get(DOUBLE_PLACES[name], 8)[0]) for name in ("time", "rest"))
        rows = self._get(layout.states.start, layout.row * len(layout.states))
        state = rows[:: layout.row // 8]
        falls = self._get(places["falls"], 8 * layout.guards if status is Status.FALL else 0)
        falls = falls - np.min(falls, initial=np.inf)
        return Steps(records[:, :2], records[:, 2], series, (time, rest), state, status, falls)

    def _put(self, address: int, values: Array | float) -> None:
        self._instance.write(address, np.asarray(values, dtype="<f8").tobytes())

    def _get(self, address: int, size: int) -> Array:
        return np.frombuffer(self._instance.read(address, size), dtype="<f8").astype(float)


def _begun(layout: Layout) -> Instance:
    """A kernel in memory, with the tape of one system."""
    try:
        begun = instance(layout.size)
    except MemoryError as error:
        raise _too_large(layout) from error
    for address, content in layout.image().items():
        begun.write(address, content)
    return begun


def _too_large(layout: Layout) -> NumericError:
    return NumericError(
        f"equations of {len(layout.tape.varying)} operations, which need {layout.size / 2**20:.0f} "
        "MiB of memory to integrate",
        expected="as much memory to be free, and less than 4 GiB",
        advice="allow the process more memory, or choose fewer bodies",
    )
