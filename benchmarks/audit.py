"""Measure the audit of the problem set, and one check from process start; print both.

Each is a fresh process, run in turn after one round that is not counted. Wall time
is what the process took from start to exit, imports included; processor time is that of the process
and of its workers, and tells more on a machine that has other work.
"""

from __future__ import annotations

import argparse
import os
import resource
import subprocess
import sys
from statistics import median
from time import perf_counter

CHECK = ("check", "gyroscope", r"F_\phi = Ma(\ddot\phi\sin\theta + 2\dot\phi\dot\theta\cos\theta)")
COMMANDS = {"audit": ("audit", "--json"), "one check": CHECK}
AIMS = {"audit": 10.0, "one check": 0.5}

# As a user has it: compiled modules are kept.
ENVIRONMENT = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--repetitions", type=int, default=5)
    repetitions = parser.parse_args().repetitions
    for words in COMMANDS.values():
        took(words)
    samples = {name: [took(words) for _ in range(repetitions)] for name, words in COMMANDS.items()}
    print(f"{'':<12}{'wall s':>9}{'processor s':>13}{'aim s':>8}")
    for name, found in samples.items():
        wall, processor = (median(column) for column in zip(*found, strict=True))
        print(f"{name:<12}{wall:>9.2f}{processor:>13.2f}{AIMS[name]:>8g}")


def took(words: tuple[str, ...]) -> tuple[float, float]:
    """Wall and processor seconds of a command."""
    began, before = perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        [sys.executable, "-m", "polhode", *words],
        capture_output=True,
        check=False,
        env=ENVIRONMENT,
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode not in (0, 1):
        sys.exit(f"polhode {' '.join(words)} failed: {done.stderr.decode().strip()}")
    processor = (after.ru_utime + after.ru_stime) - (before.ru_utime + before.ru_stime)
    return perf_counter() - began, processor


if __name__ == "__main__":
    main()
