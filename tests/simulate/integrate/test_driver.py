"""Motions that begin in equilibrium, stable or not, stay in it."""

import numpy as np
import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE
from polhode.model import with_friction

NUMBERS = {"m": 0.2, "a": 0.03, "g": 9.81}


@pytest.mark.parametrize("mu", [None, 0.3])
@pytest.mark.parametrize("spin", [0.0, 5.0])
def test_a_disk_that_stands_upright_falls_to_neither_side(mu: float | None, spin: float) -> None:
    """The cosine of the double next to 90° is 6e-17, which falling would magnify without limit."""
    disk = CATALOGUE["rolling-disk"].build()
    disk = disk if mu is None else with_friction(disk, mu)
    run = ph.simulate(disk, NUMBERS, {"theta": "90 deg", "omega_3": spin}, 10.0)
    assert [event.kind for event in run.events] == ["start", "end"]
    assert float(run.final["theta"]) == np.pi / 2
    assert abs(run.final["x"] + spin * 0.03 * 10) < 1e-13
    assert float(run.final["F_z"]) == pytest.approx(0.2 * 9.81, rel=1e-15)


def test_hardly_off_it_falls() -> None:
    """θ − 90° grows as cosh(t √(4 g/(5 a))): that of a rod on a hinge with I = 5 m a²/4."""
    disk, off = CATALOGUE["rolling-disk"].build(), 1e-10
    run = ph.simulate(disk, NUMBERS, {"theta": np.pi / 2 - off}, 1.0)
    given = np.pi / 2 - (np.pi / 2 - off) + 6.123e-17
    grown = given * np.cosh(np.sqrt(4 * 9.81 / (5 * 0.03)))
    assert np.pi / 2 - run.final["theta"] == pytest.approx(grown, rel=1e-5)


def test_a_hop_shorter_than_the_rounding_of_the_time_is_no_traceback() -> None:
    disk = CATALOGUE["rolling-disk"].build()
    with pytest.raises(ph.NumericError, match="exclude each other"):
        ph.simulate(disk, NUMBERS, {"theta": np.pi / 2 - 1e-15}, 10.0)
