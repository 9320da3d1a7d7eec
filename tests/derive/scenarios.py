"""Scenarios for the brute-force oracle beyond the ones it comes with: disks on moving sheets."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from oracles import disks
from oracles.balls import SHEET, paper
from oracles.constraints import Constraint, Ellipsoid, Held, Parts, Sliding
from oracles.parts import Array, vector
from oracles.scenario import LAB_AXES, Numbers, Scenario, components, numbers, rate_name

DISK = "m a g I_1 I_3 theta phi theta_dot phi_dot omega_3 x y"


def rolling_on_sheet(**given: float) -> dict[str, float]:
    """A disk that rolls on a sheet which is moved about and turned; gravity tilted by alpha.

    The plane's y-axis points up the slope. Accelerations, and the contact force along the plane.
    """
    state = numbers(given, needs=DISK, zero=f"alpha psi {SHEET}")

    def place(q: Numbers) -> Parts:
        sheet, omega, arm = paper(q), disks.omega(q), reach(q)
        centre = vector(q.x, q.y, q.a * np.sin(q.theta))
        matter = sheet.velocity + np.cross(sheet.omega, centre + arm - sheet.position)
        return {"sheet": sheet, "disk": disks.disk(q, matter - np.cross(omega, arm))}

    rolling = Held("disk", "sheet", rim(state))
    return answer(place, state, disks.SPEEDS, rolling)


def sliding_on_sheet(**given: float) -> dict[str, float]:
    """The same with sliding friction mu; v_x and v_y are then free."""
    state = numbers(given, needs=f"{DISK} mu v_x v_y", zero=f"alpha psi {SHEET}")

    def place(q: Numbers) -> Parts:
        velocity = vector(q.v_x, q.v_y, q.a * q.theta_dot * np.cos(q.theta))
        return {"sheet": paper(q), "disk": disks.disk(q, velocity)}

    sliding = Sliding("disk", "sheet", rim(state), state.mu)
    return answer(place, state, f"{disks.SPEEDS} v_x v_y", sliding)


def answer(place: Any, state: Numbers, speeds: str, contact: Constraint) -> dict[str, float]:
    found = Scenario(
        place=place,
        state=state,
        rates=rates,
        speeds=speeds,
        constraints={"contact": contact},
        gravity=-state.g * vector(0, np.sin(state.alpha), np.cos(state.alpha)),
    ).answer()
    force = found.reaction("contact", "disk").force
    return found.report(components("F", force, LAB_AXES, np.eye(3)))


def reach(q: Numbers) -> Array:
    """From the centre of the disk to the point of contact."""
    return -q.a * disks.triad(q)[:, 1]


def rim(q: Numbers) -> Ellipsoid:
    return Ellipsoid((q.a, q.a, 0))


def rates(q: Numbers, parts: Parts) -> Mapping[str, Any]:
    moved = {name: getattr(q, rate_name(name)) for name in SHEET.split() if "ddot" not in name}
    return moved | disks.rates(q, parts)
