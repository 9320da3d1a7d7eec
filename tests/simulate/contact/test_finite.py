"""Everything that can be read of a motion is a number at both ends of every segment."""

import numpy as np
import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE, numbers_of
from polhode.derive import automaton
from polhode.model import with_edge, with_friction
from polhode.simulate import Pieces

PULLED = {
    "X": Pieces(np.array([0.2, 0.5, 1.0]), np.array([[0.0, 0.6], [0.18, -0.4]]), (1,)),
    "Y": ph.sin(ph.time) ** 3 / 10,
    "chi": 0,
}
CASES = [
    (name, mu, start)
    for name in (
        "spinning-coin",
        "rolling-disk",
        "marble-on-turntable",
        "marble-on-turntable/tilted",
        "ball-on-paper",
    )
    for mu in (None, 0.1, 0.5)
    for start in ({}, {"theta": "90 deg"})
    if not start or "theta" in CATALOGUE[name].start
]


@pytest.mark.parametrize(("name", "mu", "start"), CASES)
def test_at_both_ends_of_every_segment(name: str, mu: float | None, start: dict[str, str]) -> None:
    entry = CATALOGUE[name]
    system = entry.build()
    if mu is not None:
        system = with_friction(system, mu)
    if name == "ball-on-paper" and mu:
        system = with_edge(system, 0.1)
    modes = automaton(system)
    flight = modes.separated.equations
    numbers = numbers_of(entry, modes.together.equations, {}, start, "0.4 s", flight=flight)
    forcing = PULLED if numbers.forcing else {}
    run = ph.simulate(modes, numbers.parameters, numbers.start, 0.4, forcing=forcing)
    for segment in run.segments:
        equations = segment.dynamics.equations
        determined = [e for n, e in equations.components.items() if n not in equations.undetermined]
        ends = np.array([segment.begin, segment.end])
        assert np.all(np.isfinite(segment.values([*determined, equations.energy], ends)))
    assert all(np.all(np.isfinite(values)) for values in run.table(run.quantities).values())


def test_at_first_the_force_is_that_of_the_slip_to_come() -> None:
    """Friction μ N against it, at once: the limit of later instants."""
    disk = with_friction(CATALOGUE["rolling-disk"].build(), 0.1)
    values = {"m": 0.2, "a": 0.03, "g": 9.81}
    start = {"theta": "80 deg", "phi_dot": 1, "omega_3": 40}
    run = ph.simulate(disk, values, start, 0.1)
    assert run.events[0].after == "sliding"
    at, soon = (run.table(["F_x", "F_y", "F_z"], t) for t in (0.0, 1e-7))
    assert abs(np.hypot(at["F_x"], at["F_y"]) - 0.1 * at["F_z"]) < 1e-15
    assert all(abs(at[name] - soon[name]) < 1e-6 for name in at)


@pytest.mark.parametrize("precision", ["extended", "quadruple"])
def test_to_more_digits(precision: str) -> None:
    disk = with_friction(CATALOGUE["rolling-disk"].build(), 0.1)
    values = {"m": 0.2, "a": 0.03, "g": 9.81}
    start = {"theta": "80 deg", "phi_dot": 1, "omega_3": 40}
    run = ph.simulate(disk, values, start, 0.01, precision=precision, samples=3)
    at = {name: float(value) for name, value in run.table(["F_x", "F_y", "F_z"], 0.0).items()}
    assert abs(np.hypot(at["F_x"], at["F_y"]) - 0.1 * at["F_z"]) < 1e-15
