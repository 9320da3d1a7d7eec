"""Peer: the same rolling disks by diffrax's Dopri8, vectorised over the disks and compiled."""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path
from time import perf_counter

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "ours"))
from ensemble_disk import DURATION, NUMBERS, STATES, starts, told


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--members", type=int, default=256)
    parser.add_argument("--tolerance", type=float, default=1e-13)
    choice = parser.parse_args()
    given = starts(2048)
    start = np.array([given.get(name, np.zeros(2048)) for name in STATES])[:, : choice.members]
    follow = compiled(choice.tolerance)
    follow(start.T).block_until_ready()
    began = perf_counter()
    ends = np.asarray(follow(start.T).block_until_ready())
    seconds = perf_counter() - began
    found = dict(zip(STATES, ends.T, strict=True))
    print(json.dumps(told(seconds, choice.members, found)))


def compiled(tolerance: float):
    """Ends of many disks from their starts, shape (members, states)."""
    import diffrax
    import jax
    import jax.numpy as jnp

    jax.config.update("jax_enable_x64", True)

    def rates(_, state, __):
        theta, theta_dot, phi_dot, omega = state
        s, c, a, g = jnp.sin(theta), jnp.cos(theta), NUMBERS["a"], NUMBERS["g"]
        pull = phi_dot * phi_dot * s * c - 6 * omega * phi_dot * s - 4 * g / a * c
        spin = 2 * theta_dot * phi_dot * s / 3
        return jnp.stack([theta_dot, pull / 5, 2 * theta_dot * (omega - phi_dot * c) / s, spin])

    def end(start):
        return diffrax.diffeqsolve(
            diffrax.ODETerm(rates),
            diffrax.Dopri8(),
            0.0,
            DURATION,
            1e-4,
            start,
            stepsize_controller=diffrax.PIDController(rtol=tolerance, atol=1e-14),
            max_steps=1_000_000,
        ).ys[-1]

    return jax.jit(jax.vmap(end))


if __name__ == "__main__":
    main()
