"""Requested events: zeros of expressions, with the reactions of the mode the motion is in."""

import numpy as np
import pytest

import polhode as ph
from polhode.base import NumericError
from polhode.catalogue import CATALOGUE

DISK = {"m": 0.2, "a": 0.03, "g": 9.81}
START = {"theta": 1.4, "phi_dot": 1.0, "omega_3": 40.0}


def test_a_reaction_is_zero_at_its_event():
    m, g = ph.symbols("m g", positive=True)
    system = CATALOGUE["rolling-disk"].build()
    weight = {"F_z = m g": ph.reaction("F_z") - m * g}
    run = ph.simulate(system, DISK, START, 0.5, events=weight)
    times = np.array([e.time for e in run.events if e.kind == "F_z = m g"])
    assert len(times) >= 8
    np.testing.assert_allclose(run.evaluate("F_z", times), 0.2 * 9.81, rtol=1e-12)
    signs = np.sign(run["F_z"] - 0.2 * 9.81)
    assert np.count_nonzero(np.diff(signs)) == len(times)


def test_it_is_that_of_the_mode_the_motion_is_in():
    """A ball slides, then rolls: friction along x is μmg throughout, then zero."""
    m, r, g = ph.symbols("m r g", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=r, axes=lab)
    contact = ph.Coulomb(ball, on=ph.Plane(lab), mu=0.1, name="table")
    system = ph.System(contact, ph.Gravity(g), name="bowling")
    half = {"half": ph.reaction("F_x") + m * g / 20, "x": ph.reaction("F_x") + m * g}
    numbers = {"m": 1.0, "r": 0.1, "g": 10.0}
    run = ph.simulate(system, numbers, {"v_x": 2.0, "omega_y": 0.0}, 1.0, events=half)
    assert [e.kind for e in run.events] == ["start", "sticks", "end"]  # it jumps, never crossing


def test_an_undetermined_reaction_is_refused():
    system = CATALOGUE["gyroscope/held"].build()
    numbers = {"M": 0.5, "a": 0.06, "I_1": 6e-4, "I_2": 3e-4, "g": 9.81}
    start = {"theta": 1.0, "omega_1": 100.0}
    with pytest.raises(NumericError, match="F_rho, which Newton's laws do not determine"):
        ph.simulate(system, numbers, start, 0.1, events={"F": ph.reaction("F_rho")})
