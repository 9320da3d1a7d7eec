"""Files are read whole, and what has no end is refused."""

import os
from pathlib import Path
from threading import Thread

import pytest

from polhode.base import StoreError, read_whole


def test_a_file_and_a_pipe(tmp_path):
    path, pipe = tmp_path / "file", tmp_path / "pipe"
    path.write_bytes(b"\x00\xff\n")
    assert read_whole(path, "bytes") == b"\x00\xff\n"
    os.mkfifo(pipe)
    writer = Thread(target=pipe.write_bytes, args=(b"t,x,y\n",))
    writer.start()
    assert read_whole(pipe, "a table") == b"t,x,y\n"
    writer.join()


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
