"""Ours: a thin disk rolling on a plane and its contact force."""

from __future__ import annotations

from common import along, report

from polhode.algebra import Expr
from polhode.catalogue import CATALOGUE
from polhode.derive import Equations


def contact_force(equations: Equations) -> dict[str, Expr]:
    ground = equations.reactions["ground"].force
    axes = equations.system.bodies[0].axes
    line = axes["1"]
    vertical = equations.system.root["z"]
    return along(ground, {"F_1": line, "F_across": vertical.cross(line), "F_z": vertical})


if __name__ == "__main__":
    report(
        CATALOGUE["rolling-disk"].build(),
        contact_force,
        {
            "m": 0.2,
            "a": 0.03,
            "g": 9.81,
            "theta": 1.1,
            "theta_dot": 0.7,
            "phi_dot": -1.3,
            "omega_3": 12,
        },
    )
