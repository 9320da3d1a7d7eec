"""The pictures of every system: what is drawn, and what to see in it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from polhode.catalogue import Entry
from polhode.simulate import Trajectory
from polhode.view import (
    energies,
    energy_drift,
    figure_of_run,
    floor_path,
    friction_needed,
    house_style,
    new_figure,
    nutation,
    phase_portrait,
    polhodes,
    reaction_ranges,
    support_trace,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_SAMPLES = 4001


@dataclass(frozen=True)
class Picture:
    """A picture of a run.

    Attributes:
        name: short, for the name of its file.
        caption: what it shows.
        draw: makes the figure.
    """

    name: str
    caption: str
    draw: Callable[[Trajectory], Figure]


def pictures_of(entry: Entry) -> tuple[Picture, ...]:
    """All pictures of a system of the catalogue."""
    return (_histories(entry), *_SPECIAL.get(entry.name, ()), _ENERGY)


def _histories(entry: Entry) -> Picture:
    seconds = _SHOWN.get(entry.name)
    if seconds is None:
        return Picture("run", "The run.", lambda run: figure_of_run(run, entry.plots))
    return Picture(
        "run",
        f"The first {seconds:g} s of the run.",
        lambda run: figure_of_run(_first(run, seconds), entry.plots),
    )


def _first(run: Trajectory, seconds: float) -> Trajectory:
    return replace(run, t=np.linspace(0.0, seconds, _SAMPLES))


@house_style()
def _energy_account(run: Trajectory) -> Figure:
    figure = new_figure(3.6)
    upper, lower = figure.subplots(2, 1)
    energies(run, ax=upper)
    energy_drift(run, ax=lower)
    figure.align_ylabels([upper, lower])
    return figure


def _path(run: Trajectory) -> Figure:
    return _whole(floor_path(run)[0].get_figure())


def _trace(run: Trajectory) -> Figure:
    return _whole(support_trace(run)[0].get_figure())


def _friction(run: Trajectory) -> Figure:
    return _whole(friction_needed(run).get_figure())


def _phase(run: Trajectory) -> Figure:
    return _whole(phase_portrait(run, "theta").get_figure())


def _sphere(run: Trajectory) -> Figure:
    return _whole(nutation(run)[0].get_figure())


def _ellipsoid(run: Trajectory) -> Figure:
    return _whole(polhodes(run)[0].get_figure())


def _ranges(run: Trajectory) -> Figure:
    return _whole(reaction_ranges(run).get_figure())


def _whole(figure: Figure | None) -> Figure:
    assert figure is not None
    return figure
