"""Files are read whole, and what has no end is refused."""

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Event, Thread

import pytest

from polhode.base import StoreError, _files, read_whole


def test_a_file_and_a_pipe(tmp_path):
    path, pipe = tmp_path / "file", tmp_path / "pipe"
    path.write_bytes(b"\x00\xff\n")
    assert read_whole(path, "bytes") == b"\x00\xff\n"
    os.mkfifo(pipe)
    writer = Thread(target=pipe.write_bytes, args=(b"t,x,y\n",))
    writer.start()
    assert read_whole(pipe, "a table") == b"t,x,y\n"
    writer.join()


@pytest.fixture
def pipe(tmp_path, monkeypatch):
    monkeypatch.setattr(_files, "_WRITER_WITHIN", 0.1)
    os.mkfifo(tmp_path / "pipe.tex")
    return tmp_path / "pipe.tex"


def test_a_pipe_that_nobody_writes_to(pipe):
    with pytest.raises(StoreError, match="a pipe that nobody writes to"):
        read_whole(pipe, "a table")


def test_a_writer_that_comes_later_and_takes_its_time(pipe, monkeypatch):
    monkeypatch.setattr(_files, "_WRITER_WITHIN", 120.0)
    is_open, may_write = Event(), Event()

    def write():
        with pipe.open("wb") as stream:  # waits for the reader
            is_open.set()
            may_write.wait(120.0)
            stream.write(b"a")
            stream.flush()
            stream.write(b"b" * 1_000_000)

    with ThreadPoolExecutor(2) as threads:
        reading = threads.submit(read_whole, pipe, "a table")
        threads.submit(write)
        assert is_open.wait(120.0)
        may_write.set()
        assert reading.result(120.0) == b"a" + b"b" * 1_000_000


@pytest.mark.parametrize(
    "words",
    [
        ["review", "PIPE", "--system", "gyroscope"],
        ["read", "PIPE"],
        ["audit", "PIPE"],
        ["exercise", "--key", "PIPE", "--mark", "PIPE"],
        ["run", "ball-on-paper", "--sheet", "PIPE"],
        ["derive", "PIPE:s"],
    ],
)
def test_commands_that_read_it_end(pipe, words, capsys):
    from polhode.cli import main

    assert main([word.replace("PIPE", str(pipe)) for word in words]) == 2
    assert "unexpected" not in capsys.readouterr().err


@pytest.mark.parametrize(
    ("name", "reason"),
    [
        ("/dev/zero", "it does not end"),
        ("/", "Is a directory"),
        ("none", "No such file"),
        ("a\0b", "null"),
    ],
)
def test_what_cannot_be_read(name, reason):
    with pytest.raises(StoreError, match=rf"cannot be read \(.*{reason}.*expected a table"):
        read_whole(Path(name), "a table")
