"""Ours: derive the disk, integrate 10 s of it, evaluate the contact force at 1000 times.

`--cold` empties the compile caches first, in a folder of its own; `--warm` finds them filled.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import tempfile
from pathlib import Path

CACHE = Path(tempfile.gettempdir()) / "polhode-benchmark-cache"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    group = parser.add_mutually_exclusive_group(required=True)
    group.add_argument("--cold", action="store_true")
    group.add_argument("--warm", action="store_true")
    choice = parser.parse_args()
    if choice.cold:
        shutil.rmtree(CACHE, ignore_errors=True)
    os.environ["POLHODE_CACHE"] = str(CACHE)
    print(json.dumps(run()))


def run() -> dict[str, object]:
    import numpy as np
    from derive_disk import contact_force

    from polhode.catalogue import CATALOGUE
    from polhode.derive import derive
    from polhode.simulate import simulate

    equations = derive(CATALOGUE["rolling-disk"].build())
    numbers = {"m": 0.2, "a": 0.03, "g": 9.81}
    start = {"theta": np.deg2rad(80), "phi_dot": 1, "omega_3": 40}
    times = np.linspace(0, 10, 1000)
    motion = simulate(equations, numbers, start, 10, samples=times)
    force = {name: motion[value] for name, value in contact_force(equations).items()}
    names = ("theta", "theta_dot", "phi_dot", "omega_3")
    answer = {name: motion[name] for name in names} | force
    return {
        "energy_error": motion.drift.energy,
        "answer": {name: float(values[-1]) for name, values in answer.items()},
        "parts": motion.seconds,
        "integrator": motion.integrator,
    }


if __name__ == "__main__":
    main()
