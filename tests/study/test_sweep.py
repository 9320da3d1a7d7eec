"""Sweeps survive whatever stops them, and end with the same bits."""

import errno
import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import scipy.stats as st
import zarr

from polhode.base import DeclarationError, StoreError
from polhode.catalogue import CATALOGUE
from polhode.simulate import simulate
from polhode.study import Final, Reason, _store, found_in, open_store, sweep
from polhode.view.figures import new_figure, outcome_map
from study.examples import NUMBERS, disk
from study.sweeps import AXES, fates, interrupted_after

TESTS = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    path = tmp_path_factory.mktemp("sweep") / "fates"
    return path, fates(path)


def same_bits(one: Path, other: Path) -> bool:
    """Every array of two stores, byte for byte."""
    a, b = (zarr.open_group(path, mode="r") for path in (one, other))
    names = sorted(a.array_keys())
    return names == sorted(b.array_keys()) and all(
        a[name][...].tobytes() == b[name][...].tobytes() for name in names
    )


def test_members_are_single_runs(whole):
    _, found = whole
    run = simulate(disk(), NUMBERS, {"theta": "70 deg", "omega_3": 40.0, "phi_dot": 1.0}, 0.2)
    there = found.sel(theta_start=70.0, omega_3=40.0)
    assert float(there["theta"]) == pytest.approx(run.final["theta"], rel=1e-10)
    assert found["theta"].dims == ("theta_start", "omega_3")
    assert found["theta_start"].attrs["units"] == "deg"


def test_members_that_fail_are_recorded(whole):
    path, found = whole
    store = open_store(path)
    assert store.failed() == 6
    assert set(np.unique(found["reason"][0])) <= {Reason.CONSTRAINT, Reason.NUMERIC}
    failures = [store.failures(place) for place in np.ndindex(*store.done.shape)]
    assert sum(map(len, failures)) == 6
    assert np.all(store.done)


def test_the_store_says_what_it_was_made_with(whole):
    path, _ = whole
    origin = open_store(path).origin
    assert origin["declaration"]["format"] == "polhode declaration"
    assert origin["versions"]["heyoka"]
    assert origin["parameters"] == NUMBERS
    assert origin["batch"]["shape"] == [5, 6]
    assert origin["schema"] == 2


def test_killed_and_gone_on_with_it_ends_with_the_same_bits(whole, tmp_path):
    path = tmp_path / "killed"
    program = [sys.executable, "-m", "study.sweeps", str(path), "14"]
    done = subprocess.run(program, cwd=TESTS, env={**os.environ, "PYTHONPATH": str(TESTS)})
    assert done.returncode == -signal.SIGKILL
    part = float(np.mean(open_store(path).done))
    assert 0.3 <= part <= 0.7
    fates(path, resume=True)
    assert same_bits(path, whole[0])


def test_an_interrupt_waits_until_a_chunk_is_written(tmp_path, monkeypatch):
    """Zarr has a thread that writes: it must not be left alone with a chunk."""
    write_whole, kept = _store.write_whole, []

    def interrupted(path, data):
        signal.raise_signal(signal.SIGINT)
        kept.append(path)
        write_whole(path, data)

    monkeypatch.setattr(_store, "write_whole", interrupted)
    path = tmp_path / "interrupted"
    with pytest.raises(KeyboardInterrupt):
        fates(path)
    assert len(kept) == 1
    assert np.sum(open_store(path).done) == 1


def test_an_interrupt_keeps_what_is_done(tmp_path, whole):
    path = tmp_path / "interrupted"
    with pytest.raises(KeyboardInterrupt) as caught:
        fates(path, progress=interrupted_after(10))
    kept = int(np.sum(open_store(path).done))
    assert caught.value.__notes__ == [f"kept {kept} of 9 chunks in {path}"]
    assert 0 < kept < 9
    fates(path, resume=True)
    assert same_bits(path, whole[0])


def test_resuming_nothing_begins_anew(tmp_path, whole):
    fates(tmp_path / "new", resume=True)
    assert same_bits(tmp_path / "new", whole[0])


def test_a_full_disk_is_reported_and_what_is_done_is_kept(tmp_path, whole, monkeypatch):
    path = tmp_path / "full"
    write, left = zarr.Array.__setitem__, [12]

    def fills_up(array, place, values):
        left[0] -= 1
        if left[0] < 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        write(array, place, values)

    monkeypatch.setattr(zarr.Array, "__setitem__", fills_up)
    with pytest.raises(StoreError, match="No space left"):
        fates(path)
    monkeypatch.undo()
    assert 0 < np.sum(open_store(path).done) < 9
    fates(path, resume=True)
    assert same_bits(path, whole[0])


def test_another_sweep_is_not_gone_on_with(whole, tmp_path):
    path, _ = whole
    with pytest.raises(StoreError, match="exists already"):
        fates(path)
    with pytest.raises(StoreError, match="different options"):
        fates(path, resume=True, near_flat=0.2)
    with pytest.raises(StoreError, match="different batch"):
        fates(path, resume=True, chunk=2)
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "file").touch()
    with pytest.raises(StoreError, match="not a store"):
        fates(tmp_path / "other", resume=True)
    with pytest.raises(StoreError, match="cannot be written"):
        fates(tmp_path / "other" / "file" / "below")


def test_samples_have_an_axis_of_their_own(tmp_path):
    axes = {"theta": st.uniform(1.0, 0.4), "phi_dot": st.norm(0, 1), "omega_3": [20.0, 30.0]}
    found = sweep(
        disk(), axes, NUMBERS, {}, 0.05, out=tmp_path / "s", outputs={"end": Final("theta")},
        samples=3, seed=4,
    )  # fmt: skip
    assert found["end"].dims == ("sample", "omega_3")
    assert found["phi_dot"].dims == ("sample",)
    again = sweep(
        disk(), axes, NUMBERS, {}, 0.05, out=tmp_path / "s", outputs={"end": Final("theta")},
        samples=3, resume=True,
    )  # fmt: skip
    assert np.array_equal(found["end"], again["end"])


@pytest.mark.parametrize(
    ("axes", "options", "words"),
    [
        ({}, {}, "no axes"),
        ({"theta": 1.0}, {}, "the axis theta"),
        ({"theta": []}, {}, "the axis theta"),
        ({"theta": st.norm()}, {}, "without their number"),
        ({"theta": [1.0]}, {"chunk": 0}, "0 members"),
        ({"theta": [1.0]}, {"workers": 0}, "0 workers"),
    ],
)
def test_what_cannot_be_swept_is_refused(tmp_path, axes, options, words):
    with pytest.raises(DeclarationError, match=words):
        sweep(disk(), axes, NUMBERS, {}, 0.1, out=tmp_path / "s", outputs=["mode"], **options)


def test_an_unreachable_scheduler_is_reported(tmp_path, monkeypatch):
    monkeypatch.setattr("polhode.study._compute._REACHED_WITHIN", 0.5)
    with pytest.raises(StoreError, match="no scheduler answers"):
        fates(tmp_path / "far", address="tcp://127.0.0.1:9")


def test_a_map_is_that_of_the_store(whole):
    path, _ = whole
    found = found_in(path)
    assert found.output == "fate"
    assert list(found.axes) == list(AXES)
    assert found.axes["theta"][4] == pytest.approx(np.deg2rad(85))
    outcome_map(found, ax=new_figure(3.0).add_subplot())


def test_a_python_function_cannot_be_kept_in_a_store(tmp_path):
    ball = CATALOGUE["ball-on-paper"].build()
    numbers = {"m": 0.05, "r": 0.02, "k": 0.4, "g": 9.81}
    forcing = {"X": lambda t: 0.0 * t, "Y": lambda t: 0.0 * t, "chi": lambda t: 0.0 * t}
    with pytest.raises(DeclarationError, match="Python function"):
        sweep(
            ball, {"x": [0.0]}, numbers, {}, 0.1, out=tmp_path / "s", outputs=["mode"],
            forcing=forcing,
        )  # fmt: skip
