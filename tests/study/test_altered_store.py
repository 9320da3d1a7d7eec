"""Stores of sweeps that were damaged or altered: a StoreError or a store, never a traceback."""

import json
import random
from contextlib import suppress
from pathlib import Path
from shutil import copytree

import numpy as np
import pytest

from polhode.base import PolhodeError, StoreError
from polhode.study import Duration, Fate, found_in, open_store, sweep
from polhode.study._store import dataset
from simulate.files.alterations import tree
from study.examples import FLAT, NUMBERS, disk


def fates(out, resume=False):
    axes = {"theta": np.linspace(0.3, 1.55, 4), "omega_3": np.linspace(0, 25, 4)}
    options = {"near_flat": FLAT, "until": ("lifts off",), "resume": resume}
    kept = {"fate": Fate(), "duration": Duration()}
    return sweep(disk(), axes, NUMBERS, {"phi_dot": 1.0}, 1.0, out=out, outputs=kept, **options)


@pytest.fixture(scope="module")
def whole(tmp_path_factory) -> Path:
    path = tmp_path_factory.mktemp("sweep") / "store"
    fates(path)
    return path


@pytest.fixture
def store(whole, tmp_path) -> Path:
    return Path(copytree(whole, tmp_path / "store"))


def mapped(path):
    found_in(path)


def counted(path):
    store = open_store(path)
    store.failed()
    for place in np.argwhere(store.done):
        store.failures(tuple(place.tolist()))


def resumed(path):
    fates(path, resume=True)


def described(path):
    dataset(path)


USES = [mapped, counted, resumed, described]


@pytest.mark.parametrize("use", [mapped, counted, resumed])
def test_a_chunk_that_cannot_be_decompressed(store, use):
    for chunk in (path for path in store.rglob("c/*") if path.is_file()):
        chunk.write_bytes(chunk.read_bytes()[:-2] + b"xx")
    for chunk in (path for path in store.rglob("c/*/*") if path.is_file()):
        chunk.write_bytes(b"\xff" * 20)
    with pytest.raises(StoreError, match="is damaged"):
        use(store)


@pytest.mark.parametrize("use", [mapped, resumed, described])
def test_a_description_that_is_cut_short(store, use):
    for description in store.glob("*/zarr.json"):
        description.write_text(description.read_text()[:100])
    with pytest.raises(StoreError, match=r"damaged|no store"):
        use(store)


def test_codes_that_stand_for_nothing(store):
    path = store / "fate" / "zarr.json"
    description = json.loads(path.read_text())
    description["attributes"]["labels"] = []
    path.write_text(json.dumps(description))
    assert found_in(store).labels == ()
    description["attributes"]["labels"] = ["one"]
    path.write_text(json.dumps(description))
    with pytest.raises(StoreError, match="codes that stand for nothing"):
        mapped(store)


def test_more_values_than_there_can_be(store):
    path = store / "theta" / "zarr.json"
    description = json.loads(path.read_text())
    path.write_text(json.dumps({**description, "shape": [10**15]}))
    with pytest.raises(StoreError, match="more than a map can show"):
        mapped(store)


def test_any_alteration_is_refused_or_a_store(whole, tmp_path):
    rng = random.Random(5)
    files = sorted(path.relative_to(whole) for path in whole.rglob("*") if path.is_file())
    for number in range(30):
        store = Path(copytree(whole, tmp_path / str(number)))
        path = store / rng.choice(files)
        content = bytearray(path.read_bytes())
        if path.suffix == ".json" and rng.random() < 0.7:
            content[:] = json.dumps(tree(rng, json.loads(content))).encode()
        elif content:
            content[rng.randrange(len(content))] ^= rng.randrange(1, 256)
        path.write_bytes(content)
        with suppress(PolhodeError):
            rng.choice(USES)(store)
