"""The pictures of every system, with their captions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from polhode.catalogue import CatalogueEntry
from polhode.simulate import Trajectory
from polhode.view.figures import (
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
_SHOWN = {"rolling-disk": 1.0}  # seconds drawn of a run with too many oscillations to resolve


@dataclass(frozen=True)
class Picture:
    """A picture of a run.

    Attributes:
        name: short, for the name of its file.
        caption: in a sentence or two.
        draw: returns the figure.
    """

    name: str
    caption: str
    draw: Callable[[Trajectory], Figure]


def pictures_of(entry: CatalogueEntry) -> tuple[Picture, ...]:
    """All pictures of a system of the catalogue."""
    seconds = _SHOWN.get(entry.name)
    opening = "The run." if seconds is None else f"The first {seconds:g} s of the run."
    return (
        Picture("run", opening, lambda run: figure_of_run(_beginning(run, seconds), entry.plots)),
        *_SPECIAL.get(entry.name, ()),
        Picture("energy", _ENERGY, lambda run: _energy_account(run, seconds)),
    )


def _beginning(run: Trajectory, seconds: float | None) -> Trajectory:
    """The beginning of a run, or all of it."""
    if seconds is None:
        return run
    return replace(run, t=np.linspace(0.0, seconds, _SAMPLES))


@house_style()
def _energy_account(run: Trajectory, seconds: float | None) -> Figure:
    figure = new_figure(4.1)
    upper, lower = figure.subplots(2, 1)
    energies(_beginning(run, seconds), ax=upper)
    energy_drift(run, ax=lower)
    figure.align_ylabels([upper, lower])
    return figure


def _one_panel(
    draw: Callable[..., object], height: float, *what: str
) -> Callable[[Trajectory], Figure]:
    """A figure of one panel, its height in inches."""

    @house_style()
    def figure_of(run: Trajectory) -> Figure:
        figure = new_figure(height)
        draw(run, *what, ax=figure.subplots())
        return figure

    return figure_of


_ENERGY = (
    "Above: the forms the energy takes. Below: how far the computed energy departs from its start "
    "plus the work done; the dashed line is the rounding error of a single number."
)
_FRICTION = Picture(
    "friction",
    "The coefficient of friction that rolling without slipping takes.",
    _one_panel(friction_needed, 1.9),
)
_PHASE: dict[str, Any] = {"name": "phase", "draw": _one_panel(phase_portrait, 3.0, "theta")}

_SPECIAL: dict[str, tuple[Picture, ...]] = {
    "spinning-coin": (
        Picture(
            "path",
            "From above: without friction the centre stays where it is, and the point of contact "
            "runs about under it.",
            _one_panel(floor_path, 3.5),
        ),
        Picture(**_PHASE, caption="The tilt swings for ever between the same two limits."),
    ),
    "rolling-disk": (
        Picture(
            "path",
            "From above: spinning fast and leaning a little, the disk rolls round a circle.",
            _one_panel(floor_path, 3.5),
        ),
        Picture(**_PHASE, caption="The lean nods about that of steady rolling."),
        Picture(
            "friction",
            "The coefficient of friction that rolling takes, over the first second.",
            lambda run: _one_panel(friction_needed, 1.9)(_beginning(run, 1.0)),
        ),
    ),
    "marble-on-turntable": (
        Picture("path", "Seen from the laboratory: a circle.", _one_panel(floor_path, 3.5)),
        Picture(
            "trace",
            "The same seen by one who turns with the table.",
            _one_panel(support_trace, 3.5),
        ),
        _FRICTION,
    ),
    "marble-on-turntable/tilted": (
        Picture(
            "path",
            "Seen from above, up the slope being up: the circle drifts sideways, not down.",
            _one_panel(floor_path, 1.9),
        ),
        Picture("trace", "The trace left on the turning table.", _one_panel(support_trace, 3.5)),
        _FRICTION,
    ),
    "gyrocompass": (Picture(**_PHASE, caption="The axle swings about the north like a pendulum."),),
    "gyrocompass/motor": (Picture(**_PHASE, caption="The swing about the north."),),
    "tennis-racquet": (
        Picture(
            "polhodes",
            "The angular velocity on the inertia ellipsoid. The run's own polhode (bold) hugs the "
            "separatrix (dashed), which passes through the middle axis: hence the flips.",
            _one_panel(polhodes, 3.0),
        ),
    ),
    "ball-on-paper": (
        Picture("path", "The ball's path over the table.", _one_panel(floor_path, 1.7)),
        Picture(
            "trace", "The trace it leaves on the moving paper.", _one_panel(support_trace, 1.7)
        ),
        _FRICTION,
    ),
    "gyroscope": (
        Picture(
            "sphere",
            "Where the axle points: released from rest, it falls, swerves and comes to rest again "
            "in cusps, between the two dashed circles.",
            _one_panel(nutation, 3.8),
        ),
        Picture(**_PHASE, caption="One nod of the axle."),
        Picture("reactions", "The range of the pivot's force.", _one_panel(reaction_ranges, 1.7)),
    ),
    "gyroscope/upright": (
        Picture("reactions", "The range of the pivot's force.", _one_panel(reaction_ranges, 1.7)),
    ),
    "gyroscope/held": (
        Picture(
            "reactions",
            "Forces of pivot and hand. Rings mark what Newton's laws leave open; shown is the "
            "choice with the smallest sum of squares.",
            _one_panel(reaction_ranges, 2.6),
        ),
    ),
    "gyroscope/vertical-plane": (
        Picture(**_PHASE, caption="The fall through the lowest point and up the other side."),
        Picture(
            "reactions",
            "The range of the forces of pivot and guide.",
            _one_panel(reaction_ranges, 2.0),
        ),
    ),
}
