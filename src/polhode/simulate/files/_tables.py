"""Samples as tables: CSV files, xarray data sets and pandas data frames."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode.base import extra, provenance, write_whole
from polhode.simulate.files._archive import Sampled
from polhode.simulate.integrate._stepping import Array

if TYPE_CHECKING:
    import pandas
    import xarray


def write_csv(path: Path, columns: Mapping[str, Array], origin: Mapping[str, Any]) -> None:
    """Write columns of equal length under their names, with all digits.

    The first line is a comment: # and a JSON document of what the table was computed from.

    Raises:
        StoreError: where the file cannot be written; a file already there is then kept.
    """
    header = json.dumps({**provenance(), **origin}, sort_keys=True)
    stream = io.StringIO(newline="")
    stream.write(f"# polhode {header}\n")
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(np.array(list(columns.values())).T.tolist())
    write_whole(path, stream.getvalue().encode())


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
    columns = {
        name: ("t", s.values, {"units": s.unit or "1"})
        for name, s in samples.items()
        if name != "t"
    }
    clock = ("t", times, {"units": "s"})
    return xarray.Dataset(columns, coords={"t": clock}, attrs=dict(origin))


def to_pandas(
    times: Array, samples: Mapping[str, Sampled], origin: Mapping[str, Any]
) -> pandas.DataFrame:
    """Samples as a table with the times `t` (s) as its index, in SI units.

    Its `attrs` hold what it was computed from and, under "units", the unit of every column.

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
