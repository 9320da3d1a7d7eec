"""A map of a million fates, killed half way and gone on with, in bounded memory."""

import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import zarr

from polhode.base import PolhodeError
from polhode.study import Duration, Fate, open_store, sweep
from proof.ledger import Ledger
from study.examples import FLAT, NUMBERS, disk

TESTS = Path(__file__).parents[1]
SIDE = int(os.environ.get("POLHODE_MAP_SIDE", "1000"))
OPTIONS = {"near_flat": FLAT, "until": ("lifts off",)}
MEMORY = 1.5 * 2**30  # bytes that a sweep of any size may take, libraries and all


def fates(out, side=SIDE, **options):
    """The fate of disks within a second, over tilt and spin."""
    axes = {"theta": np.linspace(0.3, 1.55, side), "omega_3": np.linspace(0, 25, side)}
    kept = {"fate": Fate(), "duration": Duration()}
    start = {"phi_dot": 1.0}
    return sweep(disk(), axes, NUMBERS, start, 1.0, out=out, outputs=kept, **OPTIONS, **options)


def same_bits(one: Path, other: Path) -> bool:
    a, b = (zarr.open_group(path, mode="r") for path in (one, other))
    return all(a[n][...].tobytes() == b[n][...].tobytes() for n in a.array_keys())


def test_a_map_of_fates_killed_half_way(tmp_path, ledger: Ledger) -> None:
    whole, killed = tmp_path / "whole", tmp_path / "killed"
    fates(whole)
    program = f"from proof.test_maps import *; fates({str(killed)!r}, resume=True)"
    child = subprocess.Popen(
        [sys.executable, "-c", program], cwd=TESTS, env={**os.environ, "PYTHONPATH": str(TESTS)}
    )
    while child.poll() is None and _part(killed) < 0.5:
        time.sleep(0.5)
    child.send_signal(signal.SIGKILL)
    child.wait()
    part = _part(killed)
    ledger.part, ledger.cases = f"{SIDE} x {SIDE}, killed at {part:.0%}", SIDE * SIDE
    if not 0.3 <= part <= 0.7:
        ledger.failures.append(f"killed at {part:.0%}, which shows nothing")
    fates(killed, resume=True)
    if not same_bits(whole, killed):
        ledger.failures.append("the bits differ")
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
    ledger.error(peak / MEMORY, 1.0, 1.0, f"memory, {peak / 2**20:.0f} MiB at most")


def _part(path: Path) -> float:
    try:
        return float(np.mean(open_store(path).done))
    except PolhodeError:
        return 0.0
