"""Members with impossible values: each fails by itself, in silence, and names its reason."""

import warnings

import numpy as np

import polhode as ph
from polhode.catalogue import CATALOGUE
from simulate.contact import disks


def test_members_that_overflow_together_do_not_stop_the_others():
    numbers = {"M": 0.5, "a": 0.06, "I_1": 6e-4, "I_2": 3.5e-4}
    gravity = np.append(np.geomspace(1e100, 1e300, 8), 9.81)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = ph.ensemble(
            CATALOGUE["gyroscope"].build(),
            numbers | {"g": gravity},
            {"theta": 1, "omega_1": 100},
            0.2,
            outputs=["theta"],
        )
    alone = ph.simulate(
        CATALOGUE["gyroscope"].build(),
        numbers | {"g": 9.81},
        {"theta": 1, "omega_1": 100},
        0.2,
        samples=2,
    )
    assert found.done[-1]
    assert abs(found["theta"][-1] - alone.final["theta"]) < 1e-12
    assert not np.any(found.done[:-1] & ~np.isfinite(found["theta"][:-1]))


def test_no_warning_of_numpy_leaks_from_contacts():
    rates = [0.0, 1e20, 1e100, 4.0, 1e-300, 30.0, -5.0, 2.0]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = ph.ensemble(
            disks.with_friction(),
            disks.numbers(0.1),
            {"theta": np.linspace(0.01, 1.5, 8), "omega_3": 1.0, "phi_dot": rates},
            0.3,
        )
        # it sticks and slips again at ever shorter intervals, some of them of a few roundings
        ph.simulate(
            disks.with_friction(),
            disks.numbers(0.36),
            {"theta": 0.711, "omega_3": -15.27, "phi_dot": 3.22, "v_x": 1.157, "v_y": 0.481},
            0.5,
            samples=2,
        )
    assert np.any(found.done)
