"""Motions that the browser tests look at."""

from __future__ import annotations

import polhode as ph
from polhode.catalogue import CATALOGUE, numbers_of
from polhode.simulate import Trajectory, simulate

HOSTILE = "</script><script>alert(1)</script><img src=x onerror=alert(2)> & 'two' \u2028 rods"


def run_of(name: str) -> Trajectory:
    """The default run of a system of the catalogue."""
    entry = CATALOGUE[name]
    equations = ph.derive(entry.build())
    numbers = numbers_of(entry, equations)
    return simulate(
        equations,
        numbers.parameters,
        numbers.start,
        numbers.duration,
        forcing=numbers.forcing,
    )


def double_pendulum(duration: str = "5 s") -> Trajectory:
    """Two rods, as a user would declare them, with names that would like to be markup."""
    m, l, g = ph.symbols("m l g", positive=True)
    alpha, beta = ph.coordinates("alpha beta")
    lab = ph.Frame("lab")
    one, two = lab.rotated(alpha, "y", name="one"), lab.rotated(beta, "y", name="two")
    upper = ph.rod(f"upper {HOSTILE}", mass=m, length=l, axes=one, axis="z")
    lower = ph.rod("lower", mass=m, length=l, axes=two, axis="z", tag="2")
    end = one["z"] * (-l / 2)
    system = ph.System(
        ph.Pivot(upper, at=-end, name=f"top {HOSTILE}"),
        ph.Pivot(lower, at=two["z"] * (l / 2), to=upper.point(end), name="elbow"),
        ph.Hinge(upper, axis="y"),
        ph.Hinge(lower, axis="y"),
        ph.Gravity(g),
        name=HOSTILE,
    )
    start = {"alpha": "120 deg", "beta": "90 deg"}
    return ph.simulate(ph.derive(system), {m: 0.1, l: 0.3, g: 9.81}, start, duration)
