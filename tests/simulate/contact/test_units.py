"""Motions do not depend on the units in which they are computed."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polhode as ph
from polhode.simulate import Experiment

M, A, B, C, G, MU, E = ph.symbols("m a b c g mu e", positive=True)
PSI, THETA, PHI = ph.coordinates("psi theta phi")
LAB = ph.Frame("lab")
AXES = LAB.rotated(PSI, "z").rotated(THETA, "x").rotated(PHI, "z")
EGG = ph.System(
    ph.Coulomb(
        ph.ellipsoid("egg", mass=M, half_axes=(A, B, C), axes=AXES),
        on=ph.Plane(LAB),
        mu=MU,
        restitution=E,
    ),
    ph.Gravity(G),
)
BOUNCING = Experiment(EGG, 0.5)

#: Powers of mass, length and time in the units of what is compared.
READ = {
    "psi": (0, 0, 0),
    "theta": (0, 0, 0),
    "x": (0, 1, 0),
    "z": (0, 1, 0),
    "v_x": (0, 1, -1),
    "theta_dot": (0, 0, -1),
    "energy": (1, 2, -2),
}


def bounces(mass: float, length: float, time: float) -> tuple[list[str], np.ndarray]:
    """An egg that bounces with friction that turns its slip, in given units.

    Returns:
        kinds of the events; their times and what it ends with, in the first units.
    """
    speed = length / time
    parameters = {
        M: 0.3 * mass,
        A: 0.05 * length,
        B: 0.06 * length,
        C: 0.08 * length,
        G: 9.81 * length / time**2,
        MU: 0.3,
        E: 0.5,
    }
    turning = {"psi_dot": 3 / time, "theta_dot": 2 / time, "phi_dot": -5 / time}
    moving = {"v_x": speed, "v_y": -0.5 * speed, "v_z": -0.2 * speed}
    start = {"psi": 0.3, "theta": 1.0, "phi": 0.4, "z": 0.3 * length, **turning, **moving}
    # One experiment for all unless the duration differs, so that it is compiled once.
    experiment = BOUNCING if time == 1 else Experiment(EGG, 0.5 * time)
    run = experiment.run(parameters, start)
    found = [
        float(run.evaluate(name, run.duration)) / (mass**i * length**j * time**k)
        for name, (i, j, k) in READ.items()
    ]
    times = [event.time / time for event in run.events]
    return [event.kind for event in run.events], np.array([*times, *found])


@pytest.fixture(scope="module")
def usual() -> tuple[list[str], np.ndarray]:
    found = bounces(1, 1, 1)
    assert found[0].count("bounces") == 5
    return found


@settings(max_examples=12)
@given(st.floats(-9, 9), st.floats(-6, 3))
def test_in_other_units_it_is_the_same_motion(
    usual: tuple[list[str], np.ndarray], mass: float, length: float
) -> None:
    kinds, found = bounces(10**mass, 10**length, 1)
    assert kinds == usual[0]
    assert np.max(np.abs(found - usual[1])) < 1e-12


@pytest.mark.parametrize("time", [1e-3, 1e3])
def test_in_other_units_of_time(usual: tuple[list[str], np.ndarray], time: float) -> None:
    kinds, found = bounces(1, 1, time)
    assert kinds == usual[0]
    assert np.max(np.abs(found - usual[1])) < 1e-12


@pytest.mark.parametrize("length", [1e-6, 1.0])
def test_a_small_ball_just_above_its_support_falls(length: float) -> None:
    """From a millionth of its radius: the size of an angle says nothing about heights."""
    psi = ph.coordinate("psi")
    ball = ph.sphere("ball", mass=M, radius=A, axes=LAB.rotated(psi, "x"), spin=ph.WithAxes())
    system = ph.System(ph.Smooth(ball, on=ph.Plane(LAB), restitution=E), ph.Gravity(G))
    height = length * (1 + 1e-6)
    start = {"psi": 1.5, "z": height}
    run = ph.simulate(system, {M: 1, A: length, G: 9.81 * length, E: 0.5}, start, 1e-3)
    landing = next(event.time for event in run.events if event.kind == "bounces")
    assert landing == pytest.approx(np.sqrt(2 * (height - length) / (9.81 * length)), rel=1e-9)
