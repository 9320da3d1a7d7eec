"""The rolling disk's integrals that no elementary function expresses."""

import numpy as np
import pytest

import polhode as ph
from analyse.systems import equations
from polhode.analyse import linear_integrals


def test_rolling_disk_has_two():
    found = linear_integrals(equations("rolling-disk"))
    assert found is not None
    assert {s.published for s in found.speeds} == {"phi_dot", "omega_3"}
    assert found.latex().startswith(r"\frac{d}{d \theta}")


def test_they_keep_their_values_along_the_motion():
    derived = equations("rolling-disk")
    numbers = {"m": 0.2, "a": 0.03, "g": 9.81}
    start = {"theta": 1.2, "phi_dot": 3.0, "omega_3": 20.0}
    run = ph.simulate(derived, numbers, start, 3.0)
    found = linear_integrals(derived)
    names = ("theta", "phi_dot", "omega_3")
    constants = [
        found.values(numbers, {n: run[n][i] for n in names}, at=1.3) for i in range(0, 1001, 100)
    ]
    assert np.ptp(constants, axis=0) == pytest.approx(0, abs=1e-11)


def test_the_gyroscope_agrees_with_its_elementary_integral():
    """There L_z is linear in the speeds too; both must say the same."""
    found = linear_integrals(equations("gyroscope"))
    numbers = {"M": 0.5, "a": 0.06, "I_1": 6.25e-4, "I_2": 3.5e-4, "g": 9.81}
    state = {"theta": 0.8, "phi_dot": 2.0, "omega_1": 100.0}
    later = dict(
        zip((s.published for s in found.speeds), found.values(numbers, state, at=1.4), strict=True)
    )

    def vertical(theta: float, phi_dot: float, omega_1: float) -> float:
        about_pivot = numbers["I_2"] + numbers["M"] * numbers["a"] ** 2
        return about_pivot * phi_dot * np.sin(theta) ** 2 + numbers["I_1"] * omega_1 * np.cos(theta)

    assert vertical(1.4, **later) == pytest.approx(vertical(**state), rel=1e-12)
    assert later["omega_1"] == 100.0


def test_a_marble_has_none():
    assert linear_integrals(equations("marble-on-turntable")) is None


def test_they_are_listed_with_the_other_integrals_where_no_ansatz_has_them():
    found = ph.invariants(equations("rolling-disk"))
    assert found.linear is not None
    assert "dω₃/dθ = 2 φ̇ sinθ/3" in str(found)


@pytest.mark.parametrize(
    "system", ["gyroscope", "spinning-coin", "tennis-racquet", "ball-on-paper"]
)
def test_they_are_not_listed_twice(system: str):
    assert ph.invariants(equations(system)).linear is None
