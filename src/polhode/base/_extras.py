"""Libraries that polhode can do without, told of where they are missed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from polhode.base._errors import StoreError


@contextmanager
def extra(library: str, name: str) -> Iterator[None]:
    """Around the import of a library that an extra of polhode brings.

    Raises:
        StoreError: where it is not installed.
    """
    try:
        yield
    except ImportError as error:
        raise StoreError(
            f"{library} is not installed",
            expected="the extra of polhode that brings it",
            advice=f"pip install 'polhode[{name}]'",
        ) from error
