"""Disks to be followed many at a time."""

from __future__ import annotations

from typing import Any

import scipy.stats as st

from polhode.catalogue import CATALOGUE
from polhode.model import System, with_friction

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
