"""Motions in files: they come back as they were, others can read them, damage is told."""

import io
import random
import sys

import h5py
import numpy as np
import pytest
import xarray

from polhode.base import StoreError
from polhode.simulate.files import _store
from polhode.simulate.files._archive import Archive, Sampled, Stretch, series_of
from polhode.simulate.files._store import read_archive, write_archive


def waves(times):
    return np.array([np.sin(7 * times), 1e6 + times**3, np.exp(-times), 0 * times])


def stretch(number: int, begin: float, end: float) -> Stretch:
    steps = np.linspace(begin, end, 7)
    knots, series = series_of(waves, steps)
    states = ("theta", "x", "a name with blanks", "φ/ψ")
    return Stretch(number, "rolling", states, {"g": 9.81, "Ω": 0.1}, steps, knots, series)


TIMES = np.linspace(0, 3, 50)
ARCHIVE = Archive(
    declaration='{"parts": ["é", "\\n"]}\n' * 10_000,
    parameters={"g": 9.81, "k": 1 / 3, "tiny": 5e-324},
    stretches=(stretch(0, 0.0, 1.0), stretch(1, 1.0, 3.0)),
    events=(
        {"time": 0.0, "kind": "start", "from": None, "to": "rolling"},
        {"time": 0.1 + 0.2, "kind": "slips", "from": "rolling", "to": "sliding"},
    ),
    times=TIMES,
    samples={
        "theta": Sampled("rad", np.sin(7 * TIMES)),
        "F_x/N": Sampled("kg m/s^2", np.full(50, np.nan)),
        "mu": Sampled("", TIMES),
    },
    details={"integrator": "heyoka", "assumed": {"x": 0.0}},
    origin={"schema": 2, "versions": {"polhode": "0"}, "seed": None},
)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "motion.h5"


@pytest.fixture
def content(path):
    write_archive(path, ARCHIVE)
    return path.read_bytes()


def assert_same(first: Archive, second: Archive) -> None:
    for name in ("declaration", "parameters", "events", "details", "origin"):
        assert getattr(first, name) == getattr(second, name)
    assert np.array_equal(first.times, second.times)
    assert list(first.samples) == list(second.samples)
    for name, sampled in first.samples.items():
        assert sampled.unit == second.samples[name].unit
        assert np.array_equal(sampled.values, second.samples[name].values, equal_nan=True)
    for one, other in zip(first.stretches, second.stretches, strict=True):
        assert (one.segment, one.mode, one.states) == (other.segment, other.mode, other.states)
        assert list(one.constants.items()) == list(other.constants.items())
        for name in ("steps", "knots", "series"):
            assert np.array_equal(getattr(one, name), getattr(other, name))


# -- series ----------------------------------------------------------------------------------------


def test_series_are_the_states_to_rounding():
    one = stretch(0, 2.0, 5.0)
    times = np.linspace(2.0, 5.0, 400)
    error = np.abs(one.at(times) - waves(times))
    assert np.all(error <= 3e-14 * np.array([[1.0], [1e6], [1.0], [1.0]]))
    assert (one.begin, one.end) == (2.0, 5.0)


def test_series_of_a_kink_at_a_step():
    knots, series = series_of(lambda t: np.array([np.abs(t - 1)]), np.array([0.0, 1.0, 2.0]))
    one = Stretch(0, "", ("x",), {}, knots, knots, series)
    assert one.at(np.array([0.0, 0.5, 1.0, 1.5, 2.0]))[0] == pytest.approx([1, 0.5, 0, 0.5, 1])


# -- files -----------------------------------------------------------------------------------------


def test_a_motion_comes_back_as_it_was(path, content):
    assert_same(read_archive(path), ARCHIVE)


def test_the_same_motion_is_the_same_file(path, content):
    write_archive(path, ARCHIVE)
    assert path.read_bytes() == content


def test_an_empty_motion(path):
    nothing = Archive("", {}, (), (), np.zeros(0), {})
    write_archive(path, nothing)
    assert_same(read_archive(path), nothing)


def test_xarray_reads_the_samples(path, content):
    with xarray.open_dataset(path) as data:
        assert list(data.dims) == ["t"]
        assert data["theta"].attrs["units"] == "rad"
        assert data["mu"].attrs["units"] == "1"
        assert data["F_x|N"].attrs["long_name"] == "F_x/N"
        assert np.array_equal(data["theta"].values, np.sin(7 * TIMES))
        assert np.array_equal(data["t"].values, TIMES)


def test_hdf5_shows_what_it_was_made_of(path, content):
    with h5py.File(path) as root:
        motion = root["polhode.motion"]
        assert motion["declaration"].asstr()[()] == ARCHIVE.declaration
        assert motion["parameters/names"].asstr()[()].tolist() == ["g", "k", "tiny"]
        assert motion["stretch 000001"].attrs["mode"] == "rolling"


# -- what goes wrong -------------------------------------------------------------------------------


@pytest.mark.parametrize("part", [0.0, 0.1, 0.5, 0.9, 0.999])
def test_a_file_cut_short_is_refused(path, content, part):
    path.write_bytes(content[: int(len(content) * part)])
    with pytest.raises(StoreError, match="no motion that polhode wrote, or it was cut short"):
        read_archive(path)


def test_any_changed_byte_is_noticed(path, content):
    rng = random.Random(2)
    for _ in range(100):
        place = rng.randrange(len(content))
        changed = content[place] ^ rng.randrange(1, 256)
        path.write_bytes(content[:place] + bytes([changed]) + content[place + 1 :])
        with pytest.raises(StoreError, match=r"is damaged|no motion that polhode wrote"):
            read_archive(path)


@pytest.mark.parametrize(
    "junk", [b"", b"\x89HDF\r\n\x1a\n", b"t,x,y\n0,0,0\n", random.Random(1).randbytes(5000)]
)
def test_foreign_files_are_refused(path, junk):
    path.write_bytes(junk)
    with pytest.raises(StoreError, match="no motion that polhode wrote"):
        read_archive(path)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(StoreError, match=r"none\.h5 cannot be read"):
        read_archive(tmp_path / "none.h5")


def test_a_folder_that_is_not_there(tmp_path):
    with pytest.raises(StoreError, match="cannot be written"):
        write_archive(tmp_path / "none" / "motion.h5", ARCHIVE)


def test_what_was_there_is_kept_if_writing_fails(path, content):
    with pytest.raises(TypeError):
        write_archive(path, Archive("", {}, (), ({"time": object()},), TIMES, {}))
    assert path.read_bytes() == content


def test_without_h5py_it_says_what_to_install(path, content, monkeypatch):
    monkeypatch.setitem(sys.modules, "h5py", None)
    for use in (lambda: read_archive(path), lambda: write_archive(path, ARCHIVE)):
        with pytest.raises(
            StoreError, match=r"h5py is not installed.*pip install 'polhode\[data\]'"
        ):
            use()


def altered(content, change):
    """A file with a right checksum whose inside was changed by other means."""
    seal = len(_store._seal(b""))
    memory = io.BytesIO(content[:-seal])
    with h5py.File(memory, "r+") as root:
        change(root)
    inside = memory.getvalue()
    return inside + _store._seal(inside)


def replaced(name, value):
    def change(root):
        del root[name]
        root[name] = value

    return change


def external(root):
    del root["polhode.motion/declaration"]
    root["polhode.motion/declaration"] = h5py.ExternalLink("/etc/passwd", "/")


def compressed(root):
    del root["t"]
    root.create_dataset("t", data=TIMES, chunks=(50,), compression="gzip")


def enormous(root):
    del root["polhode.motion/stretch 000000/knots"]
    root["polhode.motion/stretch 000000"].create_dataset("knots", shape=(10**9,), dtype="f8")


PART = "polhode.motion/stretch 000000"
CHANGES = {
    "another format": lambda root: root.attrs.modify("format", "picture"),
    "another schema": lambda root: root.attrs.modify("schema", 99),
    "no declaration": lambda root: root["polhode.motion"].pop("declaration"),
    "no group": lambda root: root.pop("polhode.motion"),
    "a group for a list": lambda root: root.move("t", "polhode.motion/t"),
    "events that are no JSON": replaced("polhode.motion/events", "["),
    "events that are no table": replaced("polhode.motion/events", "[1, 2]"),
    "events that are deep": replaced("polhode.motion/events", "[" * 100_000),
    "details that are a list": replaced("polhode.motion/details", "[]"),
    "a declaration of numbers": replaced("polhode.motion/declaration", 3.0),
    "values for other times": replaced("mu", np.zeros(3)),
    "whole numbers": replaced("t", np.arange(50)),
    "a plane of times": replaced("t", np.zeros((50, 2))),
    "knots that fall": replaced(f"{PART}/knots", np.linspace(1, 0, 7)),
    "knots that do not fit": replaced(f"{PART}/knots", np.linspace(0, 1, 4)),
    "no mode": lambda root: root[PART].attrs.pop("mode"),
    "a segment that is a text": lambda root: root[PART].attrs.update({"segment": "1st"}),
    "names without values": replaced("polhode.motion/parameters/names", ["g"]),
    "a link elsewhere": external,
    "a filter": compressed,
    "more than there is": enormous,
}


@pytest.mark.parametrize("name", CHANGES)
def test_files_that_were_tampered_with_are_refused(path, content, name):
    path.write_bytes(altered(content, CHANGES[name]))
    with pytest.raises(StoreError, match="is damaged"):
        read_archive(path)


def test_a_file_altered_in_nothing_is_read(path, content):
    path.write_bytes(altered(content, lambda root: None))
    assert_same(read_archive(path), ARCHIVE)
