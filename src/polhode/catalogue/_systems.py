"""All systems of the catalogue, by name."""

from __future__ import annotations

from polhode.catalogue._ball_on_paper import BALL_ON_PAPER
from polhode.catalogue._balls_on_a_table import CUE_BALL, SUPERBALL, TWO_BALLS
from polhode.catalogue._balls_on_surfaces import IN_BOWL, IN_CONE, IN_CYLINDER, ON_SPHERE
from polhode.catalogue._cylinders import IN_CYLINDER as CYLINDER_IN_CYLINDER
from polhode.catalogue._cylinders import ON_WEDGE
from polhode.catalogue._disks import EULERS_DISK, ROLLING_DISK, SPINNING_COIN
from polhode.catalogue._entry import CatalogueEntry
from polhode.catalogue._gyrocompass import GYROCOMPASS, MOTOR_DRIVEN
from polhode.catalogue._gyroscope import GYROSCOPE, HELD, IN_VERTICAL_PLANE, UPRIGHT
from polhode.catalogue._ladder import LADDER
from polhode.catalogue._marble_on_turntable import MARBLE_ON_TURNTABLE, TILTED
from polhode.catalogue._rocking_block import ROCKING_BLOCK
from polhode.catalogue._rolling_cone import ROLLING_CONE
from polhode.catalogue._tennis_racquet import TENNIS_RACQUET
from polhode.catalogue._tippe_top import TIPPE_TOP

#: The systems of the problem set, in its order.
PROBLEM_SET: dict[str, CatalogueEntry] = {
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

#: Further problems that a course asks.
CLASSICS: dict[str, CatalogueEntry] = {
    entry.name: entry
    for entry in (
        ON_SPHERE,
        IN_BOWL,
        IN_CYLINDER,
        IN_CONE,
        ON_WEDGE,
        CYLINDER_IN_CYLINDER,
        LADDER,
        ROCKING_BLOCK,
        ROLLING_CONE,
        TIPPE_TOP,
        EULERS_DISK,
        CUE_BALL,
        SUPERBALL,
        TWO_BALLS,
    )
}

#: All systems of the catalogue, those of the problem set first.
CATALOGUE: dict[str, CatalogueEntry] = {**PROBLEM_SET, **CLASSICS}
