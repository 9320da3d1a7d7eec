"""Results as labelled arrays of xarray."""

from __future__ import annotations

from typing import TYPE_CHECKING

from polhode.base import extra

if TYPE_CHECKING:
    import xarray

    from polhode.study._ensemble import Ensemble


def dataset_of(ensemble: Ensemble) -> xarray.Dataset:
    """An ensemble over the dimension `member`.

    Raises:
        StoreError: where xarray is not installed.
    """
    with extra("xarray", "study"):
        import xarray
    columns = {
        name: (
            ("member", *(f"{name}_{axis}" for axis in range(values.ndim - 1))),
            values,
            {"labels": list(ensemble.labels[name])} if name in ensemble.labels else {},
        )
        for name, values in ensemble.values.items()
    }
    numbers = {
        name: ("member", column.values, {"units": column.unit} if column.unit else {})
        for name, column in ensemble.numbers.items()
    }
    reason = {"reason": ("member", ensemble.reason)}
    return xarray.Dataset({**columns, **reason}, coords=numbers, attrs={"seed": ensemble.seed})
