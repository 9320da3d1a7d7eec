import logging
import os
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from polhode.base import StoreError, _cache, cache

HEADER = 10 + 32


@pytest.fixture(autouse=True)
def place(tmp_path, monkeypatch):
    monkeypatch.setenv("POLHODE_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache"


def entries(place):
    return [path for path in (place / "entries").iterdir() if path.suffix == "" and path.is_file()]


def unmade():
    raise AssertionError("made although it was kept")


def test_made_once_and_kept():
    assert cache.get_or_make("disk", lambda: b"made") == b"made"
    assert cache.get_or_make("disk", unmade) == b"made"


def test_each_key_has_its_own_bytes():
    assert cache.get_or_make("disk", lambda: b"one") == b"one"
    assert cache.get_or_make("hoop", lambda: b"") == b""
    assert cache.get_or_make("disk", unmade) == b"one"
    assert cache.get_or_make("hoop", unmade) == b""


@pytest.mark.parametrize(
    "damage",
    [
        lambda stored: stored[:-1],
        lambda stored: stored[:HEADER] + b"\0" + stored[HEADER + 1 :],
        lambda stored: b"",
        lambda stored: b"not an entry",
    ],
)
def test_a_damaged_entry_is_made_again(place, damage, caplog):
    cache.get_or_make("disk", lambda: b"first")
    (entry,) = entries(place)
    entry.write_bytes(damage(entry.read_bytes()))
    with caplog.at_level(logging.WARNING, "polhode"):
        assert cache.get_or_make("disk", lambda: b"second") == b"second"
    assert "damaged" in caplog.text
    assert cache.get_or_make("disk", unmade) == b"second"


def test_nothing_is_kept_of_what_could_not_be_made(place):
    with pytest.raises(OSError, match="no compiler"):
        cache.get_or_make("disk", lambda: (_ for _ in ()).throw(OSError("no compiler")))
    assert entries(place) == []


def test_an_unfinished_write_leaves_no_trace(place, monkeypatch):
    def fail(source, target):
        raise OSError("disk full")

    monkeypatch.setattr(os, "replace", fail)
    assert cache.get_or_make("disk", lambda: b"made") == b"made"
    assert list((place / "entries").glob("*.part")) == []
    assert entries(place) == []


def test_the_least_recently_used_go_first(place, monkeypatch):
    monkeypatch.setattr(_cache, "LIMIT", 3 * (HEADER + 100))
    for age, key in enumerate(["a", "b", "c"]):
        known = set(entries(place)) if age else set()
        cache.get_or_make(key, lambda: bytes(100))
        (entry,) = set(entries(place)) - known
        os.utime(entry, (1e9 + age, 1e9 + age))
    cache.get_or_make("a", unmade)
    cache.get_or_make("d", lambda: bytes(100))
    for key in ["a", "c", "d"]:
        cache.get_or_make(key, unmade)
    with pytest.raises(AssertionError, match="made although"):
        cache.get_or_make("b", unmade)


def test_what_exceeds_the_bound_alone_is_returned_but_not_kept(place, monkeypatch):
    monkeypatch.setattr(_cache, "LIMIT", 50)
    assert cache.get_or_make("big", lambda: bytes(100)) == bytes(100)
    assert entries(place) == []


def test_abandoned_files_are_swept_up_and_fresh_ones_left(place):
    folder = cache.folder("entries")
    os.utime(folder / "CACHEDIR.TAG", (1e9, 1e9))
    old, fresh = folder / "old.part", folder / "fresh.part"
    for part in (old, fresh):
        part.write_bytes(b"half")
    os.utime(old, (1e9, 1e9))
    cache.get_or_make("disk", lambda: b"made")
    assert not old.exists()
    assert fresh.exists()
    assert (folder / "CACHEDIR.TAG").exists()


def test_clear_empties_and_tells_how_much(place):
    cache.get_or_make("disk", lambda: bytes(1000))
    (cache.folder("compiled") / "object").write_bytes(bytes(500))
    assert cache.clear() >= 1500
    assert cache.clear() == 0
    assert cache.get_or_make("disk", lambda: b"again") == b"again"


def test_clear_leaves_what_is_not_polhodes(place):
    theirs = place / "thesis"
    theirs.mkdir(parents=True)
    (theirs / "chapter").write_text("one")
    tagged = place / "other"
    tagged.mkdir()
    (tagged / "CACHEDIR.TAG").write_text("Signature: 8a477f597d28d172789f06886806bc55")
    cache.get_or_make("disk", lambda: b"made")
    cache.clear()
    assert (theirs / "chapter").read_text() == "one"
    assert tagged.exists()
    assert not (place / "entries").exists()


def test_clear_of_no_cache_frees_nothing():
    assert cache.clear() == 0


def test_without_a_place_to_write_the_work_still_gets_done(tmp_path, monkeypatch, caplog):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("POLHODE_CACHE", str(tmp_path / "file"))
    with caplog.at_level(logging.WARNING, "polhode"):
        assert cache.get_or_make("disk", lambda: b"made") == b"made"
    assert "not caching" in caplog.text
    with pytest.raises(StoreError, match="set POLHODE_CACHE"):
        cache.folder("compiled")


def test_without_locks_each_makes_its_own(monkeypatch):
    def refuse(path):
        raise OSError("no locks here")

    monkeypatch.setattr(_cache, "locked", refuse)
    assert cache.get_or_make("disk", lambda: b"made") == b"made"
    assert cache.get_or_make("disk", unmade) == b"made"


def test_threads_that_ask_at_once_make_once():
    made, start, got = [], threading.Barrier(8), []

    def make():
        made.append(1)
        return b"made"

    def ask():
        start.wait()
        got.append(cache.get_or_make("disk", make))

    threads = [threading.Thread(target=ask) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert got == [b"made"] * 8
    assert len(made) == 1


PROCESS = """
import sys, time
from pathlib import Path
from polhode.base import cache
log = Path(sys.argv[1])
def make():
    with log.open("a") as stream:
        stream.write("made\\n")
    time.sleep(0.3)
    return b"made"
assert cache.get_or_make("disk", make) == b"made"
"""


def test_processes_that_ask_at_once_make_once(tmp_path):
    log = tmp_path / "log"
    asking = [subprocess.Popen([sys.executable, "-c", PROCESS, str(log)]) for _ in range(3)]
    assert [process.wait() for process in asking] == [0, 0, 0]
    assert log.read_text() == "made\n"


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
