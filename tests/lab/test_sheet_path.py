"""The path of a sheet that was dragged by hand."""

import numpy as np
import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE
from polhode.lab._system_session import sheet_path

NUMBERS = {"m": 0.05, "r": 0.02, "k": 0.4, "g": 9.81}
INSTANTS = np.arange(0.0, 1.0001, 1 / 60)


def dragged(x, y):
    return sheet_path([(float(t), float(x(t)), float(y(t))) for t in INSTANTS])


@pytest.mark.parametrize("speed", [0.5, -1.5])
def test_a_sheet_let_go_while_it_moves_comes_to_rest_without_a_jump(speed: float) -> None:
    rng = np.random.default_rng(3)
    paths = dragged(lambda t: speed * t + rng.normal() * 1e-3, lambda t: 0.2 * np.sin(9 * t))
    for path in paths:
        assert not path.jumps
        assert np.abs(path.velocity(path.knots[[0, -1]])).max() < 1e-12
    x, y = paths
    forcing = {"X": x, "Y": y, "chi": 0}
    run = ph.simulate(
        CATALOGUE["ball-on-paper"].build(), NUMBERS, {"v_x": 0.2}, 3.0, forcing=forcing
    )
    # rolling, the ball has k/(1 + k) of the velocity of the sheet besides its own
    times = np.linspace(0.0, 3.0, 3001)
    own = run.table(["v_x"], times)["v_x"] - 2 / 7 * x.velocity(times)
    assert np.abs(own - 0.2).max() < 1e-12
    assert [event.kind for event in run.events] == ["start", "end"]


def test_it_follows_the_hand() -> None:
    x, _ = dragged(lambda t: 0.1 * (1 - np.cos(6 * t)), lambda t: 0.0)
    off = x.value(INSTANTS) - 0.1 * (1 - np.cos(6 * INSTANTS))
    assert np.sqrt(np.mean(off**2)) < 0.03 * 0.2
