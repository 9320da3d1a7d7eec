"""Boundaries of a map, found with few motions, are those of the whole grid."""

import numpy as np
import pytest

from polhode.base import DeclarationError
from polhode.study import EndMode, Fate, Final, ensemble, refine_map
from polhode.view.figures import new_figure, outcome_map
from study.examples import FLAT, NUMBERS, disk

AXES = {"theta": (0.6, 1.5), "omega_3": (0.0, 16.0)}
OPTIONS = {"near_flat": FLAT, "until": ("lifts off",)}


@pytest.fixture(scope="module")
def fates():
    return refine_map(disk(), AXES, NUMBERS, {"phi_dot": 1.0}, 0.3, coarse=5, levels=2, **OPTIONS)


def test_the_refined_map_is_that_of_the_whole_grid(fates):
    theta, omega = (axis for axis in fates.found.axes.values())
    grid = np.meshgrid(theta, omega, indexing="ij")
    whole = ensemble(
        disk(),
        NUMBERS,
        {"theta": grid[0].ravel(), "omega_3": grid[1].ravel(), "phi_dot": 1.0},
        0.3,
        outputs={"fate": Fate()},
        **OPTIONS,
    )
    assert len(np.unique(whole["fate"])) > 1
    assert np.array_equal(fates.found.values.ravel(), whole["fate"])
    assert fates.members < 0.9 * fates.found.values.size


def test_it_is_drawn_with_the_exact_threshold(fates):
    drawn = outcome_map(fates.found, ax=new_figure(3.0).add_subplot())
    (line,) = drawn.thresholds
    assert line.get_paths()[0].vertices[:, 1] == pytest.approx(np.sqrt(9.81 / 0.09), rel=1e-3)


@pytest.mark.parametrize(
    ("axes", "options", "words"),
    [
        ({"theta": (1.0, 1.1)}, {}, "1 axes"),
        (AXES, {"outcome": Final("theta")}, "one code"),
        (AXES, {"outcome": EndMode(), "coarse": 1}, "a grid of 1 points"),
    ],
)
def test_what_is_no_map_is_refused(axes, options, words):
    with pytest.raises(DeclarationError, match=words):
        refine_map(disk(), axes, NUMBERS, {}, 0.1, **options)
