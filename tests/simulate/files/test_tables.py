"""Samples as tables of other libraries."""

import sys

import numpy as np
import pytest

from polhode.base import StoreError
from polhode.simulate.files._archive import Sampled
from polhode.simulate.files._tables import to_pandas, to_xarray

TIMES = np.linspace(0, 2, 5)
SAMPLES = {"theta": Sampled("rad", TIMES**2), "mu": Sampled("", -TIMES), "t": Sampled("s", TIMES)}
ORIGIN = {"system": "coin"}


def test_a_data_set():
    data = to_xarray(TIMES, SAMPLES, ORIGIN)
    assert list(data.data_vars) == ["theta", "mu"]
    assert data["theta"].attrs == {"units": "rad"}
    assert data["mu"].attrs == {"units": "1"}
    assert data["t"].attrs == {"units": "s"}
    assert float(data["theta"].sel(t=1.5)) == 2.25
    assert data.attrs == ORIGIN


def test_a_table():
    table = to_pandas(TIMES, SAMPLES, ORIGIN)
    assert list(table.columns) == ["theta", "mu"]
    assert table.index.name == "t"
    assert table.loc[1.5, "theta"] == 2.25
    assert table.attrs == {"system": "coin", "units": {"theta": "rad", "mu": "", "t": "s"}}


@pytest.mark.parametrize(("make", "name"), [(to_xarray, "xarray"), (to_pandas, "pandas")])
def test_without_the_library_it_says_what_to_install(monkeypatch, make, name):
    monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(StoreError, match=rf"{name} is not installed.*polhode\[data\]"):
        make(TIMES, SAMPLES, ORIGIN)
