"""The same sweep on a cluster of several processes, one of which is killed in the middle."""

import os
import signal

import numpy as np
import zarr

from polhode.study import open_store
from study.sweeps import fates


class _Killer:
    """Kills a worker once some members are done."""

    def __init__(self, client) -> None:
        self._client, self.killed, self.done = client, 0, 0

    def begin(self, task, total=None): ...

    def advance(self, steps=1):
        self.done += steps
        if self.done >= 8 and not self.killed:
            self.killed = min(self._client.run(os.getpid).values())
            os.kill(self.killed, signal.SIGKILL)

    def finish(self): ...


def test_a_killed_worker_loses_nothing_and_counts_nothing_twice(tmp_path):
    from distributed import Client, LocalCluster

    alone = fates(tmp_path / "alone")
    with (
        LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        Client(cluster) as client,
    ):
        killer = _Killer(client)
        fates(tmp_path / "cluster", address=cluster.scheduler_address, progress=killer)
    assert killer.killed
    assert killer.done == 30
    assert np.all(open_store(tmp_path / "cluster").done)
    a, b = (zarr.open_group(tmp_path / name, mode="r") for name in ("alone", "cluster"))
    for name in alone.data_vars:
        assert a[name][...].tobytes() == b[name][...].tobytes()
