"""Whether a motion stayed where its equations hold, and its contacts only pushed."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from polhode.algebra import Expr
from polhode.base import NumericError
from polhode.model import Contact

if TYPE_CHECKING:
    from polhode.simulate._trajectory import Trajectory

#: How finely a motion is looked at between its ends: no finer than parts remember their states for.
_LOOKS = 10_000


def refuse_lost_side(trajectory: Trajectory) -> None:
    """Refuse a motion that left the side its equations were derived for.

    Raises:
        NumericError: with the time; a disk that falls flat reaches sin θ = 0.
    """
    for sign in trajectory.equations.assumed_positive:
        time = _first_fall(trajectory, sign)
        if time is not None:
            raise NumericError(
                f"{sign} reaches zero at t = {time:.6g} s",
                expected="a positive value throughout: the equations hold on that side only",
                advice=f"end the run before that time, for instance at {0.99 * time:.3g} s",
            )


def pulling_contacts(trajectory: Trajectory) -> Iterator[tuple[float, str]]:
    """Times from which a contact would have to pull to keep its body, with its name."""
    determined = set(trajectory.reactions) - set(trajectory.equations.undetermined)
    elements = getattr(trajectory.equations.system, "elements", ())
    for contact in (e for e in elements if isinstance(e, Contact)):
        normal = f"{contact.force}_{contact.on.normal}{contact.body.tag}"
        time = _first_fall(trajectory, normal) if normal in determined else None
        if time is not None:
            yield time, contact.name


def _first_fall(trajectory: Trajectory, quantity: Expr | str) -> float | None:
    times = np.linspace(0.0, trajectory.duration, _LOOKS)
    values = np.broadcast_to(trajectory.evaluate(quantity, times), times.shape)
    fallen = np.flatnonzero(~(values > 0))
    return float(times[fallen[0]]) if fallen.size else None
