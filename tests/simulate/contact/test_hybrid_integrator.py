"""Unlimited friction that still pulls where the normal force vanishes: nothing can follow."""

import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE

NUMBERS = {"m": 1, "a": "0.1 m", "g": 9.81}


def test_a_disk_that_falls_flat_on_unlimited_friction_is_refused() -> None:
    disk = CATALOGUE["rolling-disk"].build()
    with pytest.raises(ph.NumericError, match="flight and rolling exclude each other"):
        ph.simulate(disk, NUMBERS, {"theta": "80 deg"}, "0.3 s")


def test_a_disk_that_neither_rolls_nor_leaves_is_refused() -> None:
    start = {"theta": 0.46459683733, "phi_dot": -7.0217058006, "omega_3": -39.007926335}
    disk = CATALOGUE["rolling-disk"].build()
    with pytest.raises(ph.NumericError, match="flight and contact exclude each other"):
        ph.simulate(disk, {"m": "0.2 kg", "a": "30 mm", "g": 9.81}, start, "10 s")


def test_with_friction_that_gives_way_it_slips_first_and_goes_on() -> None:
    disk = ph.with_friction(CATALOGUE["rolling-disk"].build(), mu=0.3)
    run = ph.simulate(disk, NUMBERS, {"theta": "80 deg"}, "0.3 s")
    assert [event.kind for event in run.events][1] == "slips"
    assert run.drift.energy < 1e-13
