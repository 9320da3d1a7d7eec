"""Steps as long as a series allows: coefficients that vanish, and motions over micrometres."""

import numpy as np
import pytest
import scipy.stats
from scipy.integrate import solve_ivp

import polhode as ph
from polhode.study import Final, ensemble

LAB = ph.Frame("lab")


@pytest.mark.parametrize("precision", [None, "extended", 25])
@pytest.mark.parametrize("duration", [1.0, 4.0])
def test_a_series_with_every_fourth_power_is_not_trusted_too_far(precision, duration):
    """m ẍ = F − k x² from rest at x = 0: x has the powers 2, 6, 10, … of the time only."""
    m, F, k = ph.symbols("m F k", positive=True)
    x = ph.coordinate("x")
    bead = ph.point_mass("bead", mass=m, axes=LAB)
    force = ph.Force(bead.point(), LAB["x"] * (F - k * x**2), name="force")
    system = ph.System(ph.Pivot(bead, only="y z"), force)
    run = ph.simulate(system, {m: 1, F: 1, k: 0.5}, {}, duration, precision=precision, samples=3)

    def rates(t, y):
        return [y[1], 1 - 0.5 * y[0] ** 2]

    exact = solve_ivp(rates, (0, duration), [0, 0], method="DOP853", rtol=3e-14, atol=1e-15)
    assert float(run.final["x"]) == pytest.approx(exact.y[0, -1], abs=1e-12)
    assert run.drift.energy < 1e-14
    assert not run.doubt


@pytest.mark.parametrize("start", [0.0, 0.1, 0.3])
def test_a_universal_joint_between_shafts_at_30_degrees(start):
    """From rest under a torque, with T = (I + J (dβ/dα)²) α̇²/2 and tan β = tan α/cos 30°.

    The rate of one angle by the other has a denominator that never vanishes; multiplied out, it has
    zeros on the way.
    """
    m, I, J, tau = ph.symbols("m I J tau", positive=True)
    alpha, beta = ph.coordinates("alpha beta")
    tilted = LAB.rotated(ph.pi / 6, "z")
    shafts = [
        ph.Body("in", mass=m, inertia=(I, I, I), axes=LAB.rotated(alpha, "x"), tag="1"),
        ph.Body("out", mass=m, inertia=(J, J, J), axes=tilted.rotated(beta, "x"), tag="2"),
    ]
    bearings = [part for s in shafts for part in (ph.Pivot(s), ph.Hinge(s, axis="x"))]
    joint = ph.Universal(
        shafts[0], arm=shafts[0].axes["y"], other_arm=shafts[1].axes["z"], to=shafts[1]
    )
    system = ph.System(*bearings, joint, ph.Torque(shafts[0], LAB["x"] * tau))
    numbers = {"I": 0.02, "J": 0.03, "tau": 0.1}
    run = ph.simulate(system, numbers, {"alpha": start}, "2 s")
    cosine = np.cos(np.pi / 6)

    def rates(t, y):
        across = np.cos(y[0]) ** 2 + np.sin(y[0]) ** 2 / cosine**2
        ratio = 1 / (cosine * across)
        slope = -np.sin(2 * y[0]) * (1 / cosine**2 - 1) / (cosine * across**2)
        moment = numbers["I"] + numbers["J"] * ratio**2
        return [y[1], (numbers["tau"] - numbers["J"] * ratio * slope * y[1] ** 2) / moment]

    exact = solve_ivp(rates, (0, 2), [start, 0], method="DOP853", rtol=3e-14, atol=1e-15)
    assert run.final["alpha"] == pytest.approx(exact.y[0, -1], abs=1e-11)
    assert run.drift.energy < 1e-13
    assert run.drift.constraint < 1e-13


@pytest.mark.parametrize("power", [2, 6])
@pytest.mark.parametrize("size", [1.0, 1e-6])
def test_members_of_a_sweep_take_the_same_safe_first_step(power, size):
    """J θ̈ = F − k θⁿ from rest at θ = 0: they were off by thousands of radians.

    With angles that are a million times smaller, each is integrated by itself. The mass moves
    nothing, and may be left out.
    """
    m, J, F, k = ph.symbols("m J F k", positive=True)
    theta = ph.coordinate("theta")
    wheel = ph.Body("wheel", mass=m, inertia=(J, J, J), axes=LAB.rotated(theta, "z"))
    torque = ph.Torque(wheel, LAB["z"] * (F - k * theta**power))
    system = ph.System(ph.Pivot(wheel), ph.Hinge(wheel, axis="z"), torque)
    unit = size ** (1 - power)
    values = {"J": 1, "F": size, "k": scipy.stats.uniform(0.3 * unit, 0.3 * unit)}
    found = ensemble(system, values, {}, 4.0, outputs={"theta": Final("theta")}, count=12, seed=1)
    for member in range(0, 12, 5):
        stiffness = found.numbers["k"].value(member) / unit

        def rates(t, y, stiffness=stiffness):
            return [y[1], 1 - stiffness * y[0] ** power]

        exact = solve_ivp(rates, (0, 4), [0, 0], method="DOP853", rtol=3e-14, atol=1e-15)
        assert found["theta"][member] / size == pytest.approx(exact.y[0, -1], abs=1e-12)


@pytest.mark.parametrize("amplitude", [1e-6, 1e-12])
def test_a_small_motion_is_as_accurate_as_a_large_one(amplitude):
    """m ẍ = −k (x + x³/A²): the motion in units of A does not depend on A."""
    m, k, A = ph.symbols("m k A", positive=True)
    x = ph.coordinate("x")
    bead = ph.point_mass("bead", mass=m, axes=LAB)
    force = ph.Force(bead.point(), LAB["x"] * (-k * (x + x**3 / A**2)))
    system = ph.System(ph.Pivot(bead, only="y z"), force)
    one, small = (
        ph.simulate(system, {m: 1, k: 4, A: size}, {x: size}, "20 s") for size in (1.0, amplitude)
    )
    assert small.final["x"] / amplitude == pytest.approx(one.final["x"], abs=1e-13)
    assert small.drift.energy < 1e-13
    assert len(small.segments[0].steps) == pytest.approx(len(one.segments[0].steps), rel=0.1)
