"""Libraries that only sweeps need, imported when they are first needed."""

from __future__ import annotations

from typing import Any

from polhode.base import extra


def zarr() -> Any:
    """The zarr module."""
    with extra("zarr", "study"):
        import zarr
    return zarr


def xarray() -> Any:
    """The xarray module."""
    with extra("xarray", "study"):
        import xarray
    return xarray


def distributed() -> Any:
    """Dask's module for clusters."""
    with extra("dask.distributed", "study"):
        import distributed
    return distributed
