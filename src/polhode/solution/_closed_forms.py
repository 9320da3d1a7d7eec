"""The motion in closed form, where the equations are recognised as those of a known family."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

from polhode.analyse import (
    Circling,
    FreeBody,
    Gyrocompass,
    HeavyTop,
    Pendulum,
    SpinningCoin,
    recognise,
)
from polhode.base import NumericError, PolhodeError
from polhode.solution._circling import circling
from polhode.solution._free_rotation import free_rotation
from polhode.solution._lines import SolutionLine
from polhode.solution._nutation import coin, nutation
from polhode.solution._setting import Setting
from polhode.solution._swinging import gyrocompass, pendulum

_FAMILIES: dict[type, Callable[[Setting, Any], Iterator[SolutionLine]]] = {
    FreeBody: free_rotation,
    Circling: circling,
    Pendulum: pendulum,
    Gyrocompass: gyrocompass,
    HeavyTop: nutation,
    SpinningCoin: coin,
}


def closed_forms(setting: Setting) -> Iterator[SolutionLine]:
    """The motion written out, with every letter defined; nothing where no form is known."""
    try:
        family = recognise(setting.equations)
    except (PolhodeError, ZeroDivisionError):
        return
    written = _FAMILIES.get(type(family))
    if written is None:
        return
    try:
        lines = list(written(setting, family))
    except NumericError:  # the system uses every letter that a formula could be written with
        return
    yield from lines
