"""Ours: rolling disks from random starts for 10 s, their state at the end.

`--bare` integrates the same equations with heyoka's batches and nothing else: what the machine
can do. Seconds are those of the second of two ensembles: nothing is compiled in it.
"""

from __future__ import annotations

import argparse
import json
from time import perf_counter

import numpy as np

NUMBERS = {"m": 0.2, "a": 0.03, "g": 9.81}
DURATION = 10.0
STATES = ("theta", "theta_dot", "phi_dot", "omega_3")


def starts(members: int) -> dict[str, np.ndarray]:
    """Disks that roll fast enough to stay up."""
    random = np.random.default_rng(1)
    return {
        "theta": random.uniform(0.9, 1.5, members),
        "phi_dot": random.normal(0, 2, members),
        "omega_3": random.uniform(20, 60, members),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--members", type=int, default=2048)
    parser.add_argument("--bare", action="store_true")
    choice = parser.parse_args()
    follow = bare if choice.bare else ours
    print(json.dumps(follow(choice.members)))


def told(seconds: float, members: int, ends: dict[str, np.ndarray]) -> dict[str, object]:
    answer = {f"{name} {k}": float(ends[name][k]) for name in STATES for k in range(4)}
    return {"seconds": seconds / members, "answer": answer}


def ours(members: int) -> dict[str, object]:
    from polhode.catalogue import CATALOGUE
    from polhode.derive import derive
    from polhode.study import EnsembleRunner, EnsembleSpec, Final, members_of

    equations = derive(CATALOGUE["rolling-disk"].build())
    order = EnsembleSpec(equations, DURATION, {name: Final(name) for name in STATES})
    crew = EnsembleRunner(order)
    everybody = members_of(NUMBERS, starts(members), None, 0)
    crew.follow(everybody.rows(slice(0, 64)), lambda count: None)
    began = perf_counter()
    block = crew.follow(everybody, lambda count: None)
    return told(perf_counter() - began, members, dict(block.values))


def bare(members: int) -> dict[str, object]:
    import os
    from concurrent.futures import ThreadPoolExecutor
    from copy import copy

    import heyoka as hk

    theta, theta_dot, phi_dot, omega = hk.make_vars("theta", "theta_dot", "phi_dot", "omega_3")
    a, g = hk.par[0], hk.par[1]
    s, c = hk.sin(theta), hk.cos(theta)
    system = [
        (theta, theta_dot),
        (theta_dot, (phi_dot * phi_dot * s * c - 6 * omega * phi_dot * s - 4 * g / a * c) / 5),
        (phi_dot, 2 * theta_dot * (omega - phi_dot * c) / s),
        (omega, 2 * theta_dot * phi_dot * s / 3),
    ]
    width = 2 * hk.recommended_simd_size()
    blank = hk.taylor_adaptive_batch(system, np.zeros((4, width)))
    given = starts(members)
    start = np.array([given.get(name, np.zeros(members)) for name in STATES])
    ends = np.empty_like(start)
    threads = os.cpu_count() or 1

    def work(first: int) -> None:
        taylor = copy(blank)
        for begin in range(first * width, members, threads * width):
            rows = np.arange(begin, begin + width)
            taylor.set_time(0.0)
            taylor.state[:] = start[:, rows]
            taylor.pars[:] = [[NUMBERS["a"]], [NUMBERS["g"]]] * np.ones((1, width))
            taylor.propagate_until(DURATION)
            ends[:, rows] = taylor.state

    began = perf_counter()
    with ThreadPoolExecutor(threads) as pool:
        list(pool.map(work, range(threads)))
    seconds = perf_counter() - began
    return told(seconds, members, dict(zip(STATES, ends, strict=True)))


if __name__ == "__main__":
    main()
