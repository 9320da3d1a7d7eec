"""Peer: accelerations of an arm by Pinocchio's articulated-body algorithm, called from Python."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pinocchio as pin
from arm_parameters import CENTRE, GRAVITY, LENGTH, MASS, MOMENTS, report, state


def prepare(links: int) -> Callable[[], Sequence[float]]:
    model = pin.Model()
    model.gravity.linear = np.array([0, 0, -GRAVITY])
    inertia = pin.Inertia(MASS, np.array([0, 0, CENTRE]), np.diag(MOMENTS))
    joint = 0
    for k in range(1, links + 1):
        hinge = pin.JointModelRZ() if k % 2 else pin.JointModelRY()
        place = pin.SE3(np.eye(3), np.array([0, 0, LENGTH if k > 1 else 0.0]))
        joint = model.addJoint(joint, hinge, place, f"q_{k}")
        model.appendBodyToJoint(joint, inertia, pin.SE3.Identity())
    data = model.createData()
    angles, rates = map(np.array, state(links))
    torques = np.zeros(links)
    return lambda: pin.aba(model, data, angles, rates, torques)


if __name__ == "__main__":
    report(__doc__ or "", prepare)
