"""Small departures at numbers beside the exact analysis: which exponents are zero by structure."""

import numpy as np
import pytest

import polhode as ph
from analyse.systems import equations
from derive.trailers import train
from polhode.algebra import FLOATS, compile_program
from polhode.analyse import stability, steady
from polhode.model import with_independent

DISK = {"m": 1.0, "a": 0.5, "g": 9.81}
TOP = {"M": 0.5, "a": 0.06, "I_1": 6.25e-4, "I_2": 3.5e-4, "g": 9.81}

#: Steady motions by numbers, with the family that each belongs to.
STEADY = {
    "straight": ("rolling-disk", DISK, {"theta": np.pi / 2, "omega_3": 7.0}),
    "on edge": ("rolling-disk", DISK, {"theta": np.pi / 2, "phi_dot": 9.0}),
    "upright": ("gyroscope/upright", TOP, {"omega_1": 150.0}),
    "level": (
        "gyroscope",
        TOP,
        {"theta": np.pi / 2, "omega_1": 150.0, "phi_dot": 0.5 * 9.81 * 0.06 / (6.25e-4 * 150)},
    ),
}


@pytest.mark.parametrize("name", STEADY)
def test_as_many_zeros_as_the_exact_polynomial_has(name):
    system, numbers, at = STEADY[name]
    found = ph.linearise(equations(system), numbers, at)
    given = {q: ph.pi / 2 for q in map(ph.coordinate, ["theta"]) if "theta" in at}
    families = (f for f in steady(equations(system), given))
    zeros = {stability(f).neutral for f in families if _holds(f, {**numbers, **at})}
    assert zeros == {found.neutral}
    assert len(found.exponents) == len(found.states) - found.neutral


def _holds(family, values) -> bool:
    """Whether what vanishes on a family does so at these values."""
    for condition in family.conditions:
        names = tuple(condition.symbols())
        function = compile_program([condition], names).function(FLOATS)
        known = {**values, "pi": np.pi}
        if abs(function(*(known.get(s.published, 0.0) for s in names))[0]) > 1e-9:
            return False
    return True


def test_on_the_threshold_the_exponents_that_meet_at_zero_stay():
    """ω₃² = m g a I₁/(I₃ (I₃ + m a²)) = g/(3a) for a uniform disk: below it the disk falls."""
    threshold = (DISK["g"] / (3 * DISK["a"])) ** 0.5
    for share, growing in ((0.99, True), (1.0, False), (1.01, False)):
        at = {"theta": np.pi / 2, "omega_3": share * threshold}
        found = ph.linearise(equations("rolling-disk"), DISK, at)
        assert found.neutral == 2
        assert (max(found.exponents.real) > 1e-3) == growing
    here = {"theta": np.pi / 2, "omega_3": threshold}
    found = ph.linearise(equations("rolling-disk"), DISK, here)
    assert len(found.exponents) == 2
    assert np.abs(found.exponents) == pytest.approx([0, 0], abs=1e-6)


def test_a_coordinate_matters_although_its_derivative_vanishes():
    """A stiffness that just balances gravity leaves nothing of first order in the angle."""
    theta = ph.coordinate("theta")
    m, length, g, k = ph.symbols("m l g k", positive=True)
    axes = ph.Frame("lab").rotated(theta, "x")
    bob = ph.Body("bob", mass=m, axes=axes)
    spring = ph.Torque(bob, axes["x"] * (-k * ph.sin(theta)))
    pivot = ph.Pivot(bob, at=axes["z"] * -length)
    system = ph.System(bob, pivot, spring, ph.Gravity(g), name="balanced")
    found = ph.linearise(system, {"m": 1, "l": 1, "g": 10, "k": 10}, {"theta": 0})
    assert found.states == ("theta", "theta_dot")
    assert found.neutral == 0
    assert found.exponents == pytest.approx([0, 0], abs=1e-7)


def test_trailers_that_run_in_line_whichever_way_they_head():
    """Their hitch closes a loop, but where it is does not matter; the exponent by hand."""
    independent = (ph.coordinate("phi_0").dt(), ph.speed("v_x_0"))
    b, c, u, heading = 1.0, 0.3, 2.0, 0.4
    found = ph.linearise(
        with_independent(train(2), independent),
        {"m": 1.0, "J": 0.2, "b": b, "c": c, "g": 9.81},
        {"phi_0": heading, "phi_1": heading, "v_x_0": u * np.cos(heading)},
    )
    # -(b - c) u/(b² + c²): see the exponents by hand in tests/analyse/test_steady.py
    assert found.exponents == pytest.approx([-(b - c) * u / (b**2 + c**2)])
