"""A tippe top: a sphere whose centre of mass is not its middle, which turns over as it slides.

Jellett's integral holds whatever the friction at the contact, Routh's while it rolls; both in the
form that Gray and Nickel give (American Journal of Physics 68, 2000).
"""

import numpy as np
import pytest

import polhode as ph
from polhode.model import Contact

m, R, h, A, C, g, mu = ph.symbols("m R h A C g mu", positive=True)
theta, phi = ph.coordinates("theta phi")
LAB = ph.Frame("lab")
AXES = LAB.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
TOP = ph.Body(
    "top", mass=m, inertia=(A, A, C), axes=AXES, spin_about="3", surface=ph.Round(R, "3", h)
)
NUMBERS = {"m": 6e-3, "R": 15e-3, "h": 3e-3, "A": 8e-7, "C": 7e-7, "g": 9.81}


def on(contact: Contact) -> ph.System:
    return ph.System(contact, ph.Gravity(g), name="tippe top")


def jellett(q: dict[str, np.ndarray]) -> np.ndarray:
    n = NUMBERS
    axial = n["C"] * q["omega_3"] * (n["R"] * np.cos(q["theta"]) - n["h"])
    return axial + n["A"] * n["R"] * q["phi_dot"] * np.sin(q["theta"]) ** 2


def routh(q: dict[str, np.ndarray]) -> np.ndarray:
    n, cosine, sine = NUMBERS, np.cos(q["theta"]), np.sin(q["theta"])
    lean = (n["h"] - n["R"] * cosine) ** 2 / n["A"] + n["R"] ** 2 * sine**2 / n["C"]
    return q["omega_3"] * np.sqrt(1 + n["m"] * lean)


def along(run: ph.Trajectory) -> dict[str, np.ndarray]:
    return {name: run[name] for name in ("theta", "phi_dot", "omega_3")}


def test_rolling_keeps_both_integrals():
    start = {"theta": 0.4, "omega_3": 60.0, "phi_dot": 10.0}
    run = ph.simulate(on(ph.Rolling(TOP, on=ph.Plane(LAB))), NUMBERS, start, 2.0)
    q = along(run)
    assert np.ptp(q["omega_3"]) > 0.5
    for integral in (jellett(q), routh(q)):
        assert np.ptp(integral) < 1e-12 * np.abs(integral).max()


def test_both_are_found():
    found = ph.invariants(ph.derive(on(ph.Rolling(TOP, on=ph.Plane(LAB)))))
    assert {invariant.name for invariant in found} == {"E", "J", "C_1"}
    assert found.linear is None
    assert "Jellett" in found["J"].meaning


def test_it_turns_over_and_keeps_jelletts_integral_through_slip_and_grip():
    twirled = 200.0  # about the vertical
    start = {"theta": 0.1, "omega_3": twirled * np.cos(0.1), "phi_dot": twirled}
    start |= {"v_x": 0.0, "v_y": 0.0}
    system = on(ph.Coulomb(TOP, on=ph.Plane(LAB), mu=mu))
    run = ph.simulate(system, NUMBERS | {"mu": 0.3}, start, 4.0)
    q = along(run)
    assert q["theta"].max() > 2
    assert q["omega_3"].min() < 0 < q["omega_3"].max()
    assert np.ptp(jellett(q)) < 1e-12 * np.abs(jellett(q)).max()
    assert run.drift.energy < 1e-13


def test_its_middle_may_be_on_the_axis_that_it_spins_about_only():
    with pytest.raises(ph.DeclarationError, match="symmetric about that axis"):
        ph.Body(
            "top",
            mass=m,
            inertia=(A, A, C),
            axes=AXES,
            spin_about="3",
            surface=ph.Round(R, "1", h),
        )
