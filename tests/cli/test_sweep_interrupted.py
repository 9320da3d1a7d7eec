"""A sweep over several processes that is ended in the middle: one line, its code, nothing left."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from polhode.study import open_store

SWEEP = (
    *(sys.executable, "-m", "polhode", "sweep", "rolling-disk", "--duration", "1s"),
    *("--axis", "theta=10deg:85deg:40", "--axis", "omega_3=0rad/s:60rad/s:40"),
    *("--workers", "2"),
)
LONG = 120.0  # s within which something is seen to happen, on a machine that has other work

pytestmark = pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="no /proc to look in")


def processes(session):
    """Those of a session that have not ended, with what they were started as."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = stat.read_text().rpartition(")")[2].split()
            words = (stat.parent / "cmdline").read_text()
        except OSError:
            continue
        if int(fields[3]) == session and fields[0] != "Z":
            found.append(words)
    return found


def until(condition):
    end = time.monotonic() + LONG
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def workers(sweep):
    return sum("begin_fresh" in words for words in processes(sweep.pid))


def starting(sweep, store):
    """Its first worker is there, and not ready yet."""
    until(lambda: workers(sweep) > 0)


def computing(sweep, store):
    until(lambda: (store / "done" / "c").exists())


@pytest.mark.parametrize(
    ("moment", "number", "code", "told"),
    [
        (computing, signal.SIGINT, 130, "interrupted"),
        (starting, signal.SIGTERM, 143, "terminated"),
    ],
)
def test_an_interrupted_sweep_says_so_in_one_line(tmp_path, moment, number, code, told):
    store = tmp_path / "fates"
    words = (*SWEEP, "--out", str(store))
    sweep = subprocess.Popen(words, stderr=subprocess.PIPE, text=True, start_new_session=True)
    moment(sweep, store)
    os.killpg(sweep.pid, number)  # as a terminal does
    _, err = sweep.communicate(timeout=LONG)
    assert sweep.returncode == code
    assert err.startswith(f"polhode: {told}")
    assert err.count("\n") == 1
    until(lambda: not processes(sweep.pid))
    if moment is computing:
        assert "continue with --resume" in err
    if moment is computing and number == signal.SIGINT:
        resumed = subprocess.run([*words, "--resume"], capture_output=True, text=True, check=False)
        assert (resumed.returncode, resumed.stderr) == (0, "")
        assert open_store(store).done.all()
