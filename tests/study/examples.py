"""Disks and balls to be followed many at a time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import scipy.stats as st

from polhode.algebra import sin, symbol, time
from polhode.catalogue import CATALOGUE
from polhode.derive import Automaton, automaton
from polhode.model import System, with_friction
from polhode.study import Ensemble, Final

NUMBERS: dict[str, Any] = {"m": 0.2, "a": 0.03, "g": 9.81}
STARTS: dict[str, Any] = {
    "theta": st.uniform(0.3, 1.2),
    "phi_dot": st.norm(0, 3),
    "omega_3": st.uniform(-40, 80),
}
FLAT = 0.05  # near lying flat a disk whirls ever faster, and takes its time


def disk() -> System:
    return CATALOGUE["rolling-disk"].build()


def rough_disk() -> System:
    """It slips, and sticks again."""
    return with_friction(disk(), 0.25, 0.3)


@dataclass(frozen=True)
class Case:
    """An ensemble whose members slip and stick.

    Attributes:
        name: of the case.
        modes: of the system.
        parameters, start, duration, outputs, options: as of an ensemble.
        moved: a start value by which to tell how a member magnifies changes.
    """

    name: str
    modes: Automaton
    parameters: Mapping[str, Any]
    start: Mapping[str, Any]
    duration: float
    outputs: Mapping[str, Final]
    options: Mapping[str, Any]
    moved: str

    def member(self, found: Ensemble, i: int) -> tuple[dict[str, Any], dict[str, Any]]:
        """Parameters and start of one member, as a single run takes them."""
        values = {n.removesuffix("_start"): c.value(i) for n, c in found.numbers.items()}
        parameters = {n: values.get(n, v) for n, v in self.parameters.items()}
        return parameters, {n: values.get(n, v) for n, v in self.start.items()}


def rough_disks() -> Case:
    """Disks of which most slip from the start, and stick."""
    names = ("theta", "theta_dot", "phi_dot", "omega_3", "x", "y")
    return Case(
        name="disks",
        modes=automaton(rough_disk()),
        parameters=NUMBERS,
        start={
            "theta": st.uniform(0.5, 0.9),
            "phi_dot": st.norm(0, 3),
            "omega_3": st.uniform(5, 25),
        },
        duration=0.3,
        outputs={name: Final(name) for name in names},
        options={"near_flat": FLAT},
        moved="theta",
    )


def rough_balls() -> Case:
    """Balls of all frictions on a sheet that is shaken: each slips and sticks several times."""
    mu = symbol("mu")
    sheet = {"X": sin(10 * time) ** 3 / 30, "Y": sin(4 * time) ** 2 / 30, "chi": 0}
    ball = CATALOGUE["ball-on-paper"].build()
    return Case(
        name="balls",
        modes=automaton(with_friction(ball, mu, 1.2 * mu)),
        parameters={"m": 0.05, "r": 0.02, "k": 0.4, "g": 9.81, "mu": st.uniform(0.05, 0.3)},
        start={"v_x": st.norm(0, 0.3), "v_y": st.norm(0, 0.3), "x": 0.0},
        duration=1.0,
        outputs={name: Final(name) for name in ("x", "y", "v_x", "v_y", "omega_z")},
        options={"forcing": sheet},
        moved="v_x",
    )
