"""Ten thousand switching members against single runs; cost and memory as members grow."""

import os
import resource
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from polhode.base import PolhodeError
from polhode.simulate import Experiment
from polhode.study import EventKinds, Final, ensemble
from proof.ledger import Ledger
from study.examples import Case, rough_balls, rough_disks

TESTS = Path(__file__).parents[1]
MEMBERS = int(os.environ.get("POLHODE_MEMBERS", "10000"))
BATCH = 500  # members that are followed together and then, one by one, against themselves
MOST = int(os.environ.get("POLHODE_MOST_MEMBERS", "1000000"))
SAME = 1e-10  # relative to the size that the quantity has
ROUNDING = 1e-14  # of the start, which a member may magnify
EVENTS = 64
GROWN = 1.1  # memory of the largest ensemble over that of one with a tenth of its members


@pytest.mark.parametrize("case", [rough_disks(), rough_balls()], ids=lambda case: case.name)
def test_switching_members_are_single_runs(case: Case, ledger: Ledger) -> None:
    """Also what happens to them, in order. None is set aside but those that fail in both ways."""
    ledger.part = f"{case.name}, {MEMBERS} members"
    alone = Experiment(case.modes, case.duration, samples=2, **case.options)
    for begin in range(0, MEMBERS, BATCH):
        found = ensemble(
            case.modes, case.parameters, case.start, case.duration, seed=begin,
            outputs={**case.outputs, "kinds": EventKinds(EVENTS)},
            count=min(BATCH, MEMBERS - begin), **case.options,
        )  # fmt: skip
        kinds = np.reshape(found.named("kinds"), (len(found), EVENTS))
        for i in range(len(found)):
            _against_itself(case, alone, found, list(kinds[i]), i, ledger)


def _against_itself(case, alone, found, kinds, i, ledger) -> None:
    ledger.cases += 1
    parameters, start = case.member(found, i)
    where = f"member {i} of seed {found.seed}"
    try:
        run = alone.run(parameters, start)
    except PolhodeError as error:
        ledger.aside += 1
        if found.done[i]:
            ledger.failures.append(f"{where} alone fails: {error}")
        return
    happened = [event.kind for event in run.events[1:-1]]
    if happened != [kind for kind in kinds if kind]:
        ledger.failures.append(f"{where}: {happened} alone, {kinds} among others")
    for name in case.outputs:
        value = float(run.final[name])
        apart = abs(found[name][i] - value) / (1 + abs(value))
        growth = 1.0 if apart < SAME else _growth(case, alone, (parameters, start), name)
        ledger.error(apart, max(SAME, ROUNDING * growth), growth, f"{name} of {where}")


def _growth(case, alone, numbers, name) -> float:
    """By how much the member itself magnifies a change of its start.

    Variational equations end where a contact slips or sticks: the change is made, 1e-9 of it.
    """
    parameters, start = numbers
    ends = []
    for d in (-1e-9, 1e-9):
        moved = {**start, case.moved: start[case.moved] + d}
        ends.append(alone.run(parameters, moved).final[name])
    return float(abs(ends[1] - ends[0]) / 2e-9)


def test_cost_grows_in_proportion_and_memory_does_not(ledger: Ledger) -> None:
    """Figures for a thousand members and ever ten times as many, each in a process of its own."""
    told, peaks = [], []
    count = 1000
    while count <= MOST:
        program = f"from proof.test_ensembles import *; swept({count})"
        env = {**os.environ, "PYTHONPATH": str(TESTS)}
        done = subprocess.run(
            [sys.executable, "-c", program], cwd=TESTS, env=env, capture_output=True, check=True
        )
        each, peak = (float(figure) for figure in done.stdout.split())
        told.append(f"{count}: {each:.0f} us each, {peak:.0f} MiB")
        peaks.append(peak)
        ledger.cases += count
        count *= 10
    ledger.error(peaks[-1] / peaks[-2], GROWN, 1.0, "; ".join(told))


def swept(count: int) -> None:
    """Print microseconds of processor time per member, and the most memory taken, MiB."""
    import tempfile
    import time

    import scipy.stats as st

    from polhode.study import Fate, sweep
    from study.examples import FLAT, NUMBERS, disk

    with tempfile.TemporaryDirectory() as folder:
        options = {"near_flat": FLAT, "until": ("lifts off",), "seed": 1}
        outputs = {"fate": Fate(), "theta": Final("theta")}
        starts = {"theta": st.uniform(0.3, 1.25), "omega_3": st.uniform(0, 25)}
        before = time.process_time()
        sweep(
            disk(), starts, NUMBERS, {"phi_dot": 1.0}, 1.0, out=Path(folder) / "s", outputs=outputs,
            samples=count, **options,
        )  # fmt: skip
        each = (time.process_time() - before) / count
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(1e6 * each, peak)
