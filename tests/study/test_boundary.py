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


def test_tilted_starts_that_precess_have_no_threshold_of_the_upright_disk(fates):
    """The steady motion has theta = pi/2 and phi_dot = 0; these starts have phi_dot = 1 rad/s."""
    assert fates.found.thresholds == ()
    assert outcome_map(fates.found, ax=new_figure(3.0).add_subplot()).thresholds == ()


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
