"""The folder of the cache: named, tagged, emptied, and never anyone else's."""

import os
import sys
from pathlib import Path

import pytest

from polhode.base import StoreError, cache


@pytest.fixture(autouse=True)
def place(tmp_path, monkeypatch):
    monkeypatch.setenv("POLHODE_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def test_clear_empties_and_returns_how_much():
    (cache.folder("compiled") / "object").write_bytes(bytes(500))
    assert cache.clear() >= 500
    assert cache.clear() == 0
    assert list(cache.folder("compiled").iterdir()) == [cache.folder("compiled") / "CACHEDIR.TAG"]


def test_clear_leaves_what_is_not_polhodes(place):
    theirs = place / "thesis"
    theirs.mkdir(parents=True)
    (theirs / "chapter").write_text("one")
    tagged = place / "other"
    tagged.mkdir()
    (tagged / "CACHEDIR.TAG").write_text("Signature: 8a477f597d28d172789f06886806bc55")
    ours = cache.folder("compiled")
    cache.clear()
    assert (theirs / "chapter").read_text() == "one"
    assert tagged.exists()
    assert not ours.exists()


def test_clear_of_no_cache_frees_nothing():
    assert cache.clear() == 0


def test_a_folder_that_cannot_be_made_is_reported(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("POLHODE_CACHE", str(tmp_path / "file"))
    with pytest.raises(StoreError, match="set POLHODE_CACHE"):
        cache.folder("compiled")


def test_the_place_is_the_platforms_unless_chosen(monkeypatch):
    monkeypatch.setenv("POLHODE_CACHE", "~/elsewhere")
    assert cache.directory() == Path.home() / "elsewhere"
    monkeypatch.delenv("POLHODE_CACHE")
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setenv("XDG_CACHE_HOME", "/caches")
    assert cache.directory() == Path("/caches/polhode")
    monkeypatch.delenv("XDG_CACHE_HOME")
    assert cache.directory() == Path.home() / ".cache" / "polhode"
    monkeypatch.setattr(sys, "platform", "darwin")
    assert cache.directory() == Path.home() / "Library" / "Caches" / "polhode"
    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.setenv("LOCALAPPDATA", "/local")
    assert cache.directory() == Path("/local/polhode")


# -- entries ---------------------------------------------------------------------------------------


def test_what_was_written_is_read():
    cache.write("compiled", "one", b"first\nlines\n")
    cache.write("compiled", "one", b"second\nlines\n")
    assert cache.read("compiled", "one") == b"second\nlines\n"
    assert cache.read("compiled", "two") is None
    assert cache.read("elsewhere", "one") is None


@pytest.mark.parametrize(
    "damage", [lambda c: c[:-1], lambda c: c + b"x", lambda c: b"", bytes.swapcase]
)
def test_a_damaged_entry_is_none_and_is_replaced(damage):
    cache.write("compiled", "one", b"Content")
    (path,) = cache.folder("compiled").rglob("one")
    path.write_bytes(damage(path.read_bytes()))
    assert cache.read("compiled", "one") is None
    cache.write("compiled", "one", b"Content")
    assert cache.read("compiled", "one") == b"Content"


def test_nothing_is_kept_where_nothing_can_be_written(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("POLHODE_CACHE", str(tmp_path / "file"))
    cache.write("compiled", "one", b"content")
    assert cache.read("compiled", "one") is None


def test_entries_that_were_not_read_for_longest_are_dropped(monkeypatch):
    monkeypatch.setattr(cache, "MOST", 1000)
    monkeypatch.setattr(cache, "SHELVES", 1)
    folder = cache.folder("compiled") / "00"
    for i, key in enumerate(("old", "read since", "new")):
        cache.write("compiled", key, bytes(250))
        os.utime(folder / key, (i, i))
    cache.read("compiled", "old")
    cache.write("compiled", "last", bytes(150))
    names = {path.name for path in folder.iterdir()}
    assert names == {"old", "new", "last"}


def test_a_write_looks_at_a_small_part_of_a_large_folder(monkeypatch):
    """A full cache made every write as slow as a look at all its entries."""
    looked = []
    for i in range(200):
        cache.write("compiled", f"key {i}", b"entry")
    monkeypatch.setattr(cache, "_drop_oldest", lambda kept: looked.extend(kept.iterdir()))
    cache.write("compiled", "another", b"entry")
    assert 0 < len(looked) < 20


def test_entries_of_the_layout_before_shelves_are_removed():
    loose = cache.folder("compiled") / "left over"
    loose.write_bytes(b"entry")
    cache.write("compiled", "key", b"entry")
    assert not loose.exists()
    assert cache.read("compiled", "key") == b"entry"
