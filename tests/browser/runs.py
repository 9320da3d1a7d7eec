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


def _equal(number: str) -> str:
    script = "<script>alert(3)</script>"
    return f"<math><mi>x</mi><mo>=</mo><mn>{number}</mn><mi>{script}</mi></math>"


def double_pendulum(duration: str = "5 s") -> Trajectory:
    """Two rods with a spring and a damper, with names that would like to be markup."""
    m, l, g, k, c = ph.symbols("m l g k c", positive=True)
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
        ph.Spring(lower.point(two["z"] * (-l / 2)), lab.vector(l, 0, 0), stiffness=k),
        ph.Damper(upper.point(end), lab.vector(-l, 0, -l), damping=c),
        ph.Gravity(g),
        name=HOSTILE,
    )
    start = {"alpha": "120 deg", "beta": "90 deg"}
    numbers = {m: 0.1, l: 0.3, g: 9.81, k: 1, c: 0.02}
    return ph.simulate(ph.derive(system), numbers, start, duration)


#: Of a claim in words, and of one that fails and is put right.
JUDGED = (
    ph.Judgement(f"energy is lost {HOSTILE}", "holds", "to the damper"),
    ph.Judgement("1 = x", "fails", HOSTILE, _equal("1"), _equal("2")),
)
