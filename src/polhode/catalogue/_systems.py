"""All systems of the catalogue, by name."""

from __future__ import annotations

from polhode.catalogue._ball_on_paper import BALL_ON_PAPER
from polhode.catalogue._disks import ROLLING_DISK, SPINNING_COIN
from polhode.catalogue._entry import CatalogueEntry
from polhode.catalogue._gyrocompass import GYROCOMPASS, MOTOR_DRIVEN
from polhode.catalogue._gyroscope import GYROSCOPE, HELD, IN_VERTICAL_PLANE, UPRIGHT
from polhode.catalogue._marble_on_turntable import MARBLE_ON_TURNTABLE, TILTED
from polhode.catalogue._tennis_racquet import TENNIS_RACQUET

#: Every catalogue system, in the order of the problem set.
CATALOGUE: dict[str, CatalogueEntry] = {
    entry.name: entry
    for entry in (
        SPINNING_COIN,
        ROLLING_DISK,
        MARBLE_ON_TURNTABLE,
        TILTED,
        GYROCOMPASS,
        MOTOR_DRIVEN,
        TENNIS_RACQUET,
        BALL_ON_PAPER,
        GYROSCOPE,
        UPRIGHT,
        HELD,
        IN_VERTICAL_PLANE,
    )
}
