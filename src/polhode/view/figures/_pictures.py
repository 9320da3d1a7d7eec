"""Which pictures a motion has beside its history in time."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from polhode.base import PolhodeError
from polhode.model import CurvedSupport
from polhode.simulate import Trajectory
from polhode.view._quantities import equations_of, instants
from polhode.view.figures._figure import Drawn
from polhode.view.figures._floor import centre_on_support, floor_path, touching
from polhode.view.figures._potential import effective_potential, tilt_of
from polhode.view.figures._rotation import free_body, moments_of, nutation, polhodes, spin_axis

_STILL = 1e-6  # of a unit vector, or of the length of a path: less is no motion


@dataclass(frozen=True)
class Illustration:
    """A figure of a motion that shows more than its history.

    Attributes:
        draw: draws it, in the axes given as `ax`.
        what: it shows, in words that follow "shows".
    """

    draw: Callable[..., Drawn]
    what: str


def pictures_of(run: Trajectory) -> Iterator[Illustration]:
    """What shows a motion best, as far as it has that.

    The path of the axis of a single spinning body on the sphere, with its loops or cusps; the
    effective potential of the tilt with its turning points; the polhode of a free body; the path of
    the centre of mass along a flat support.
    """
    system = equations_of(run).system
    with suppress(PolhodeError):
        axis = spin_axis(run).express(system.root)
        moved = (np.ptp(run.evaluate(c, instants(run))) for c in axis.components)
        if len(system.bodies) == 1 and max(moved) > _STILL:
            yield Illustration(nutation, "the path of the axis on the unit sphere")
    with suppress(PolhodeError):
        tilt_of(run)
        yield Illustration(effective_potential, "the effective potential with its turning points")
    with suppress(PolhodeError):
        moments_of(run, free_body(run))
        yield Illustration(polhodes, "the polhode on the ellipsoid of inertia")
    with suppress(PolhodeError):
        if not isinstance(touching(run).on, CurvedSupport):
            spread = np.ptp(centre_on_support(run), axis=1)
            if np.min(spread) > _STILL * np.max(spread):
                yield Illustration(floor_path, "the path of the centre of mass, seen from above")
