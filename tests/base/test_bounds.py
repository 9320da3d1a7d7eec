"""Bounds that the operating system keeps: of time and of memory."""

from __future__ import annotations

import signal
import subprocess
import sys
import time

import pytest


def ended(program):
    words = [sys.executable, "-c", f"from polhode.base import *; {program}"]
    return subprocess.run(words, capture_output=True, text=True, check=False)


def test_a_process_ends_when_its_time_is_over_even_in_compiled_code():
    endless = "from collections import deque; from itertools import count; deque(count(), maxlen=0)"
    assert ended(f"bound_time(0.1); {endless}").returncode == -signal.SIGPROF


def test_a_bound_of_no_time_is_none():
    assert ended("bound_time(0.1); bound_time(0); sum(range(10**6))").returncode == 0


def test_memory_beyond_the_bound_is_refused():
    assert "MemoryError" in ended("bound_memory(1 << 30); bytes(2 << 30)").stderr


def test_a_bound_of_growth_leaves_what_there_is():
    holding = "held = bytearray(1 << 30); bound_growth(1 << 28)"
    assert ended(f"{holding}; bytes(1 << 27)").returncode == 0
    assert "MemoryError" in ended(f"{holding}; bytes(1 << 30)").stderr


def _ended_by(act: str) -> int:
    """How a process ends whose pipe's other end closes."""
    script = (
        "import os, sys, itertools, collections; from polhode.base import end_with\n"
        "ours, theirs = os.pipe()\n"
        "if os.fork() == 0:\n"
        "    os.close(ours); os.read(0, 1); os._exit(0)\n"
        f"os.close(theirs)\n{act}\n"
    )
    child = subprocess.Popen([sys.executable, "-c", script], stdin=subprocess.PIPE)
    time.sleep(1.0)
    child.communicate()
    return child.returncode


@pytest.mark.skipif(sys.platform != "linux", reason="pipes send no signal here")
def test_a_process_ends_with_the_other_end_of_its_pipe_even_in_compiled_code():
    endless = "collections.deque(itertools.count(), maxlen=0)"
    assert _ended_by(f"end_with(ours)\n{endless}") == -signal.SIGIO
    assert _ended_by("os.read(ours, 1)\nend_with(ours); sys.exit(3)") == -signal.SIGIO
    assert _ended_by("os.read(ours, 1); sys.exit(3)") == 3
