"""What programs give, as one array."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np


def rows(values: Sequence[Any], size: int, dtype: Any = float) -> Any:
    """Values, each an array of a size or one number for all of it, shape (values, size)."""
    found = np.empty((len(values), size), dtype)
    for row, value in zip(found, values, strict=True):
        row[:] = value
    return found
