"""Times in order, each once."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from polhode.simulate.integrate._stepping import Array


def ascending(times: Sequence[Array]) -> Array:
    """All of them, in order and each once; `np.unique` would load all of `numpy.ma` for it."""
    every: Array = np.sort(np.concatenate(times))
    first: Array = every[np.append([True], every[1:] != every[:-1])]
    return first


def occurring(which: NDArray[np.signedinteger[Any]]) -> NDArray[np.intp]:
    """Which of the whole numbers from 0 on occur, in order."""
    return np.flatnonzero(np.bincount(which))
