"""Libraries that only sweeps need, imported when they are first needed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from polhode.base import StoreError


def zarr() -> Any:
    """The zarr module."""
    with _extra("zarr"):
        import zarr
    return zarr


def xarray() -> Any:
    """The xarray module."""
    with _extra("xarray"):
        import xarray
    return xarray


def distributed() -> Any:
    """Dask's module for clusters."""
    with _extra("dask.distributed"):
        import distributed
    return distributed


@contextmanager
def _extra(name: str) -> Iterator[None]:
    """Around an import.

    Raises:
        StoreError: where the library is not installed.
    """
    try:
        yield
    except ImportError as error:
        raise StoreError(
            f"{name} is not installed",
            expected="the extra of polhode that brings it",
            advice="pip install 'polhode[study]'",
        ) from error
