"""Libraries that polhode can do without."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from polhode.base import StoreError


@contextmanager
def extra(name: str) -> Iterator[None]:
    """Around the import of a library for files and tables.

    Raises:
        StoreError: where it is not installed.
    """
    try:
        yield
    except ImportError as error:
        raise StoreError(
            f"{name} is not installed",
            expected="the extra of polhode that brings it",
            advice="pip install 'polhode[data]'",
        ) from error
