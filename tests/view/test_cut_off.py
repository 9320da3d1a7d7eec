"""Nothing of a figure is cut off by its edge."""

import pytest

import polhode as ph
from polhode.catalogue import CATALOGUE


@pytest.fixture(scope="module")
def coin():
    equations = ph.derive(CATALOGUE["spinning-coin"].build())
    numbers = {"m": "7.5 g", "a": "12 mm", "g": 9.81}
    start = {"theta": "60 deg", "phi_dot": "45 rad/s", "omega_3": "2 rad/s"}
    return ph.simulate(equations, numbers, start, "1 s")


@pytest.fixture(scope="module")
def sliding():
    """A disk that slides and rolls: both modes and both coefficients stand in the legend."""
    disk = ph.with_friction(CATALOGUE["rolling-disk"].build(), ph.symbol("mu"))
    numbers = {"m": 0.2, "a": 0.03, "g": 9.81, "mu": 0.1}
    return ph.simulate(disk, numbers, {"theta": "80 deg", "omega_3": 40, "v_x": 0.1}, "1 s")


def inside(figure, *things):
    """Whether they stand within the figure as it is drawn the first time."""
    figure.draw_without_rendering()
    edge = figure.bbox
    return [
        box.x0 >= edge.x0 and box.y0 >= edge.y0 and box.x1 <= edge.x1 and box.y1 <= edge.y1
        for box in (thing.get_window_extent() for thing in things)
    ]


def test_labels_of_a_path_stand_within_its_figure(coin):
    axes = ph.figures.floor_path(coin)[0].axes
    assert inside(axes.figure, axes.yaxis.label, axes.xaxis.label) == [True, True]


def test_a_long_legend_stands_within_its_figure(sliding):
    axes = ph.figures.friction_needed(sliding)[0].axes
    legend = axes.get_legend()
    assert len(legend.get_texts()) == 4
    assert inside(axes.figure, legend) == [True]
