"""Samples as the tables that others' libraries work with."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from polhode.base import extra
from polhode.simulate.files._archive import Sampled
from polhode.simulate.integrate._stepping import Array

if TYPE_CHECKING:
    import pandas
    import xarray


def to_xarray(
    times: Array, samples: Mapping[str, Sampled], origin: Mapping[str, Any]
) -> xarray.Dataset:
    """Samples as a data set over the coordinate `t` (s), each with its SI unit as an attribute.

    Args:
        times: s.
        samples: by name.
        origin: attributes of the whole.

    Raises:
        StoreError: where xarray is not installed.
    """
    with extra("xarray", "data"):
        import xarray
    columns = {name: ("t", s.values, _attributes(s)) for name, s in samples.items() if name != "t"}
    clock = ("t", times, {"units": "s"})
    return xarray.Dataset(columns, coords={"t": clock}, attrs=dict(origin))


def to_pandas(
    times: Array, samples: Mapping[str, Sampled], origin: Mapping[str, Any]
) -> pandas.DataFrame:
    """Samples as a table with the times `t` (s) as its index, in SI units.

    Its `attrs` say what it was made with, and under "units" the unit of every column.

    Args:
        times: s.
        samples: by name.
        origin: attributes of the whole.

    Raises:
        StoreError: where pandas is not installed.
    """
    with extra("pandas", "data"):
        import pandas
    index = pandas.Index(times, name="t")
    columns = {name: s.values for name, s in samples.items() if name != "t"}
    table: pandas.DataFrame = pandas.DataFrame(columns, index=index)
    table.attrs |= {**origin, "units": {name: s.unit for name, s in samples.items()}}
    return table


def _attributes(sampled: Sampled) -> dict[str, str]:
    return {"units": sampled.unit or "1"}
