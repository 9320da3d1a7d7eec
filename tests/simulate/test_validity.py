"""Motions that leave the side of their equations, or pull where a support can only push."""

import numpy as np
import pytest

from polhode.algebra import coordinates, symbols
from polhode.base import NumericError
from polhode.catalogue import CATALOGUE
from polhode.derive import derive
from polhode.model import Frame, Gravity, Plane, Rolling, System, disk
from polhode.simulate import simulate

COIN = {"m": 0.2, "a": 0.03, "g": 9.81}


def test_a_disk_that_falls_flat_is_not_carried_through_the_floor():
    """Without spin it falls from 60° like a rod about its rim, and is flat in finite time."""
    rolling = CATALOGUE["rolling-disk"].build()
    with pytest.raises(NumericError, match=r"sin\(theta\) reaches zero at t = 0\.\d+ s"):
        simulate(derive(rolling), COIN, {"theta": "60 deg"}, 2.0)
    fallen = simulate(derive(rolling), COIN, {"theta": "60 deg"}, 0.05)
    assert fallen.final["theta"] > 0


def test_a_contact_that_would_pull_is_named_with_its_time():
    """An eccentric thought: a disk whirled so fast that its centre would be flung up."""
    m, a, g = symbols("m a g", positive=True)
    theta, phi = coordinates("theta phi")
    lab = Frame("lab")
    axes = lab.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    body = disk("disk", mass=m, radius=a, axes=axes)
    system = System(Rolling(body, on=Plane(lab), name="ground"), Gravity(g))
    start = {"theta": "60 deg", "theta_dot": "40 rad/s"}
    run = simulate(derive(system), COIN, start, 0.01)
    kinds = [event.kind for event in run.events]
    assert kinds == ["start", "ground pulls", "end"]
    pulled = run.evaluate("F_z", np.array([run.events[1].time]))
    assert pulled[0] <= 0


def test_an_honest_run_has_only_its_ends():
    rolling = CATALOGUE["rolling-disk"].build()
    run = simulate(rolling, COIN, {"theta": "80 deg", "omega_3": 40}, 1.0)
    assert [event.kind for event in run.events] == ["start", "end"]
