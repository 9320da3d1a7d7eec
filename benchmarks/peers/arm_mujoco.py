"""Peer: accelerations of an arm by MuJoCo's forward dynamics, called from Python."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import mujoco
from arm_parameters import CENTRE, GRAVITY, LENGTH, MASS, MOMENTS, report, state


def prepare(links: int) -> Callable[[], Sequence[float]]:
    opened, moments = "", " ".join(map(str, MOMENTS))
    for k in range(1, links + 1):
        axis = "0 0 1" if k % 2 else "0 1 0"
        opened += (
            f'<body pos="0 0 {LENGTH if k > 1 else 0}"><joint type="hinge" axis="{axis}"/>'
            f'<inertial pos="0 0 {CENTRE}" mass="{MASS}" diaginertia="{moments}"/>'
        )
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><compiler angle="radian"/><option gravity="0 0 -{GRAVITY}">'
        '<flag contact="disable" constraint="disable"/></option>'
        f"<worldbody>{opened}{'</body>' * links}</worldbody></mujoco>"
    )
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:] = state(links)

    def evaluate() -> Sequence[float]:
        mujoco.mj_forward(model, data)
        return data.qacc

    return evaluate


if __name__ == "__main__":
    report(__doc__ or "", prepare)
