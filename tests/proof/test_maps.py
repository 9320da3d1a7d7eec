"""Many motions at full size: a map of a million fates, ten thousand switching members, growth."""

import os
import resource
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import scipy.stats as st
import zarr

from polhode.base import PolhodeError
from polhode.derive import automaton
from polhode.simulate import Experiment
from polhode.study import Duration, EndMode, Fate, Final, ensemble, open_store, sweep
from proof.ledger import Ledger
from study.examples import FLAT, NUMBERS, disk, rough_disk

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


def start_name(name: str, outputs) -> str:
    return f"{name}_start" if name in outputs else name


STARTS = {
    "theta": st.uniform(0.5, 0.9),
    "phi_dot": st.norm(0, 3),
    "omega_3": st.uniform(5, 25),
}
MEMBERS = int(os.environ.get("POLHODE_MEMBERS", "10000"))


def test_switching_members_are_single_runs(ledger: Ledger) -> None:
    """Differences are told with the growth of a small change of the start in the same motion."""
    modes = automaton(rough_disk())
    outputs = {"theta": Final("theta"), "omega_3": Final("omega_3"), "mode": EndMode()}
    options = {"near_flat": FLAT}
    found = ensemble(
        modes, NUMBERS, STARTS, 0.3, outputs=outputs, count=MEMBERS, seed=1, workers=2, **options
    )
    alone = Experiment(modes, 0.3, samples=2, **options)
    for i in range(MEMBERS):
        start = {
            name: found[f"{name}_start"][i] if name in outputs else found[name][i]
            for name in STARTS
        }
        ledger.cases += 1
        try:
            run = alone.run(NUMBERS, start)
        except PolhodeError as error:
            if found.done[i]:
                ledger.failures.append(f"member {i} alone fails: {error}")
            ledger.aside += 1
            continue
        for name in ("theta", "omega_3"):
            apart = abs(found[name][i] - run.final[name]) / (1 + abs(run.final[name]))
            growth = 1.0 if apart < 1e-10 else _growth(alone, start, name)
            ledger.error(apart, 1e-10 * max(1.0, 1e-4 * growth), growth, f"{name} of member {i}")


def _growth(alone: Experiment, start: dict[str, float], name: str) -> float:
    """How much a change of the start by 1e-9 has grown by the end."""
    ends = [
        alone.run(NUMBERS, {**start, "theta": start["theta"] + d}).final[name] for d in (0, 1e-9)
    ]
    return float(abs(ends[1] - ends[0]) / 1e-9)


def test_cost_grows_in_proportion_and_memory_does_not(tmp_path, ledger: Ledger) -> None:
    """Figures for 1e3 to 1e6 members, told with the time and memory of each."""
    told = []
    for side in (32, 100, 316, SIDE):
        before = time.process_time()
        fates(tmp_path / str(side), side)
        each = (time.process_time() - before) / side**2
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        told.append(f"{side**2}: {1e6 * each:.0f} us each, {peak:.0f} MiB")
        ledger.cases += side**2
    ledger.error(peak * 2**20 / MEMORY, 1.0, 1.0, "; ".join(told))
