"""Motions in files: they come back as they were, others can read them, damage is reported."""

import json
import random
import sys
from dataclasses import replace

import h5py
import numpy as np
import pytest
import xarray

from polhode.base import StoreError
from polhode.simulate.files import _store
from polhode.simulate.files._archive import (
    Archive,
    ChebyshevPiece,
    Sampled,
    counted,
    packed,
    series_of,
    unpacked,
)
from polhode.simulate.files._store import read_archive, write_archive


def waves(times):
    return np.array([np.sin(7 * times), 1e6 + times**3, np.exp(-times), 0 * times])


def stretch(number: int, begin: float, end: float) -> ChebyshevPiece:
    steps = np.linspace(begin, end, 7)
    knots, series = series_of(waves, steps)
    states = ("theta", "x", "a name with blanks", "φ/ψ")
    return ChebyshevPiece(number, "rolling", states, {"g": 9.81, "Ω": 0.1}, steps, knots, series)


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
    details={"integrator": "heyoka", "assumed": {"x": 0.0}},
    origin={"schema": 2, "versions": {"polhode": "0"}, "seed": None},
)
SAMPLES = {
    "theta": Sampled("rad", np.sin(7 * TIMES)),
    "F_x/N": Sampled("kg m/s^2", np.full(50, np.nan)),
    "mu": Sampled("", TIMES),
}


@pytest.fixture
def path(tmp_path):
    return tmp_path / "motion.h5"


@pytest.fixture
def content(path):
    write_archive(path, ARCHIVE, SAMPLES)
    return path.read_bytes()


def assert_same(first: Archive, second: Archive) -> None:
    for name in ("declaration", "parameters", "events", "details", "origin"):
        assert getattr(first, name) == getattr(second, name)
    assert np.array_equal(first.times, second.times)
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
    one = ChebyshevPiece(0, "", ("x",), {}, knots, knots, series)
    assert one.at(np.array([0.0, 0.5, 1.0, 1.5, 2.0]))[0] == pytest.approx([1, 0.5, 0, 0.5, 1])


# -- files -----------------------------------------------------------------------------------------


def test_a_motion_comes_back_as_it_was(path, content):
    assert_same(read_archive(path), ARCHIVE)


def test_the_same_motion_is_the_same_file(path, content):
    write_archive(path, ARCHIVE, SAMPLES)
    assert path.read_bytes() == content


def test_an_empty_motion(path):
    nothing = Archive("", {}, (), (), np.zeros(0))
    write_archive(path, nothing, {})
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
        assert json.loads(motion["parameters"].asstr()[()]) == ARCHIVE.parameters


# -- what goes wrong -------------------------------------------------------------------------------


@pytest.mark.parametrize("part", [0.0, 0.1, 0.5, 0.9, 0.999])
def test_a_file_cut_short_is_refused(path, content, part):
    path.write_bytes(content[: int(len(content) * part)])
    with pytest.raises(StoreError, match="is not a motion that polhode wrote, or it was truncated"):
        read_archive(path)


def test_any_changed_byte_is_noticed(path, content):
    rng = random.Random(2)
    for _ in range(100):
        place = rng.randrange(len(content))
        changed = content[place] ^ rng.randrange(1, 256)
        path.write_bytes(content[:place] + bytes([changed]) + content[place + 1 :])
        with pytest.raises(StoreError, match=r"is damaged|is not a motion that polhode wrote"):
            read_archive(path)


@pytest.mark.parametrize(
    "junk", [b"", b"\x89HDF\r\n\x1a\n", b"t,x,y\n0,0,0\n", random.Random(1).randbytes(5000)]
)
def test_foreign_files_are_refused(path, junk):
    path.write_bytes(junk)
    with pytest.raises(StoreError, match="is not a motion that polhode wrote"):
        read_archive(path)


def test_a_file_that_is_not_there(tmp_path):
    with pytest.raises(StoreError, match=r"none\.h5 cannot be read"):
        read_archive(tmp_path / "none.h5")


def test_a_folder_that_is_not_there(tmp_path):
    with pytest.raises(StoreError, match="cannot be written"):
        write_archive(tmp_path / "none" / "motion.h5", ARCHIVE, SAMPLES)


def test_an_existing_file_is_kept_if_writing_fails(path, content):
    with pytest.raises(TypeError):
        write_archive(path, replace(ARCHIVE, events=({"time": object()},)), SAMPLES)
    assert path.read_bytes() == content


def test_without_h5py_it_says_what_to_install(path, monkeypatch):
    monkeypatch.setitem(sys.modules, "h5py", None)
    with pytest.raises(StoreError, match=r"h5py is not installed.*pip install 'polhode\[data\]'"):
        write_archive(path, ARCHIVE, SAMPLES)


def test_a_motion_is_read_without_h5py(path, content, monkeypatch):
    """Its library can be brought to hang, or to end the process, by a file made to."""
    monkeypatch.setitem(sys.modules, "h5py", None)
    assert_same(read_archive(path), ARCHIVE)


def test_the_samples_are_not_read_on_loading(path, content):
    path.write_bytes(sealed(packed(ARCHIVE), before=b"\x89HDF\r\n\x1a\n" + b"\xff" * 5000))
    assert_same(read_archive(path), ARCHIVE)


def test_a_file_of_an_earlier_version_says_so(path):
    path.write_bytes(b"\x89HDF\r\n\x1a\n" + b"0" * 5000 + b"polhode sha-256:" + b"1" * 32)
    with pytest.raises(StoreError, match="written by an earlier version"):
        read_archive(path)


@pytest.mark.parametrize("name", ["/dev/zero", "."])
def test_an_unreadable_path_is_refused(name):
    with pytest.raises(StoreError, match="cannot be read"):
        read_archive(name)


# -- a right checksum, and altered contents --------------------------------------------------------


def sealed(payload, before=b"\x89HDF\r\n\x1a\n"):
    inside = before + payload + counted(len(payload))
    return inside + _store._seal(inside)


def taken_apart(payload):
    length = int.from_bytes(payload[:8], "little")
    return json.loads(payload[8 : 8 + length]), payload[8 + length :]


def put_together(document, arrays):
    text = document if isinstance(document, bytes) else json.dumps(document).encode()
    return counted(len(text)) + text + arrays


def having(**changes):
    """A document with other values under some names."""
    return lambda document, arrays: put_together({**document, **changes}, arrays)


def first_stretch(**changes):
    def change(document, arrays):
        first, *others = document["stretches"]
        return put_together({**document, "stretches": [{**first, **changes}, *others]}, arrays)

    return change


def without(name):
    def change(document, arrays):
        return put_together({k: v for k, v in document.items() if k != name}, arrays)

    return change


def doubles(change):
    def changed(document, arrays):
        return put_together(document, change(np.frombuffer(arrays).copy()).tobytes())

    return changed


def put(place, value):
    def change(numbers):
        numbers[place] = value
        return numbers

    return doubles(change)


CHANGES = {
    "another format": having(format="picture"),
    "another schema": having(schema=99),
    "no declaration": without("declaration"),
    "no times": without("times"),
    "no stretches": without("stretches"),
    "a declaration of numbers": having(declaration=3.0),
    "half a character": having(declaration="\ud800"),
    "events that are no list": having(events={}),
    "events that are numbers": having(events=[1, 2]),
    "details that are a list": having(details=[]),
    "a parameter that is no number": having(parameters={"g": "9.81"}),
    "a parameter that is not finite": having(parameters={"g": float("nan")}),
    "a parameter beyond all numbers": having(parameters={"g": 10**400}),
    "more times than there are": having(times=10**9),
    "fewer times than there are": having(times=40),
    "less than no times": having(times=-1),
    "times that are true": having(times=True),
    "enormous counts": first_stretch(pieces=10**12, order=10**12),
    "counts beyond all counting": first_stretch(pieces=10**40),
    "no pieces": first_stretch(pieces=0),
    "no states": first_stretch(states=[]),
    "states that are numbers": first_stretch(states=[1, 2, 3, 4]),
    "a mode that is none": first_stretch(mode=None),
    "a segment that is a text": first_stretch(segment="1st"),
    "a segment before the first": first_stretch(segment=-1),
    "constants that are a list": first_stretch(constants=[1.0]),
    "no JSON": lambda document, arrays: put_together(b"[", arrays),
    "no text": lambda document, arrays: put_together(b"\xff\xfe{}", arrays),
    "a document that is deep": lambda document, arrays: put_together(b"[" * 10**6, arrays),
    "a document that is a list": lambda document, arrays: put_together(b"[]", arrays),
    "numbers of many digits": lambda document, arrays: put_together(b"9" * 10**6, arrays),
    "nothing": lambda document, arrays: b"",
    "a length that is too long": lambda document, arrays: counted(2**60) + b"{}",
    "part of a number": lambda document, arrays: put_together(document, arrays[:-3]),
    "a number less": doubles(lambda numbers: numbers[:-1]),
    "a number more": doubles(lambda numbers: np.append(numbers, 1.0)),
    "a time that is not finite": put(3, np.nan),
    "a state that is not finite": put(-1, np.inf),
    "steps that fall": put(len(TIMES) + 2, -5.0),
    "knots that begin elsewhere": put(len(TIMES) + 7, -5.0),
}


@pytest.mark.parametrize("name", CHANGES)
def test_tampered_files_are_refused(path, name):
    path.write_bytes(sealed(CHANGES[name](*taken_apart(packed(ARCHIVE)))))
    with pytest.raises(StoreError, match="is damaged"):
        read_archive(path)


def test_a_length_that_is_longer_than_the_file(path):
    inside = b"\x89HDF\r\n\x1a\n" + counted(2**63)
    path.write_bytes(inside + _store._seal(inside))
    with pytest.raises(StoreError, match="is damaged"):
        read_archive(path)


def test_an_unaltered_file_is_read(path):
    path.write_bytes(sealed(put_together(*taken_apart(packed(ARCHIVE)))))
    assert_same(read_archive(path), ARCHIVE)


def test_bytes_come_back_as_the_motion():
    assert_same(unpacked(packed(ARCHIVE)), ARCHIVE)
