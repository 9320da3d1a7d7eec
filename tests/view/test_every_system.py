"""Every figure of every catalogue system: made, finite, labelled with units."""

import re

import numpy as np
import pytest

from polhode.base import DeclarationError
from polhode.catalogue import PROBLEM_SET
from polhode.model import Contact, Rolling
from polhode.view import figures as view

SYSTEMS = list(PROBLEM_SET)
LABEL = re.compile(
    r"(?P<what>.+) \((?P<unit>deg|turns|[kMmµn]?(m|s|N|J|W|N m|m/s|rad/s|rad/s²|m/s²)|kg.*)\)"
)
PURE = {r"$|E - E_0 - W|\,/\,E_{\rm max}$", r"friction / normal force"}


def labels(figure):
    return [
        label
        for axes in figure.axes
        for label in (axes.get_xlabel(), axes.get_ylabel())
        if label and axes.axison
    ]


def assert_sound(figure):
    assert figure.axes
    for axes in figure.axes:
        assert axes.has_data()
        for line in axes.lines:
            assert np.all(np.isfinite(np.asarray(line.get_xydata(), dtype=float)))
    for label in labels(figure):
        assert label in PURE or LABEL.fullmatch(label), label
    assert view.svg_of(figure).startswith("<?xml")


@pytest.mark.parametrize("name", SYSTEMS)
def test_histories(run_of, name):
    figure = view.figure_of_run(run_of(name), PROBLEM_SET[name].plots)
    assert_sound(figure)
    assert figure.axes[-1].get_xlabel() == "$t$ (s)"
    assert all(axes.get_ylabel() for axes in figure.axes)


@pytest.mark.parametrize("draw", [view.energies, view.energy_drift, view.reaction_ranges])
@pytest.mark.parametrize("name", SYSTEMS)
def test_what_every_system_has(run_of, name, draw):
    figure = draw(run_of(name)).figure
    assert_sound(figure)
    assert labels(figure)


@pytest.mark.parametrize("draw", [view.floor_path, view.support_trace])
@pytest.mark.parametrize("name", SYSTEMS)
def test_paths_where_something_touches(run_of, name, draw):
    run = run_of(name)
    if not any(isinstance(element, Contact) for element in run.equations.system.elements):
        with pytest.raises(DeclarationError, match=name):
            draw(run)
        return
    figure = draw(run)[0].get_figure()
    assert_sound(figure)
    assert len(labels(figure)) == 2


@pytest.mark.parametrize("name", SYSTEMS)
def test_friction_where_something_rolls(run_of, name):
    run = run_of(name)
    if not any(isinstance(element, Rolling) for element in run.equations.system.elements):
        with pytest.raises(DeclarationError, match=name):
            view.friction_needed(run)
        return
    (line,) = view.friction_needed(run)
    assert_sound(line.get_figure())
    assert np.min(line.get_ydata()) >= 0
