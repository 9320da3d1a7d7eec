"""Peer: the contact tasks by MuJoCo, at several steps.

Elliptic cones, Newton's solver to 1e-12, impratio 10, and the contact's time constant 20 ms at a
step of 1 ms, falling with its root: of those tried these came nearest. With the stiffest contact
it takes, two steps, the sliding ball hops and errors are tens of times larger. The sheet is a box
on two slides and a hinge, a million times as heavy as the ball, whose places and rates are set
before every step and whose accelerations are applied as forces; of the other tasks all steps are
made in one call. Models are compiled once.
"""

from __future__ import annotations

import math
import sys
from functools import cache
from itertools import pairwise
from pathlib import Path

import mujoco
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))
import contact_tasks as tasks

STEPS = {
    "sheet": (1e-2, 1e-3, 1e-4, 1e-5),
    "slide": (1e-2, 1e-3, 1e-4, 1e-5),
    "disk": (1e-2, 1e-3, 1e-4, 1e-5),
}
HEAVY = 1e6
OPTIONS = 'gravity="0 0 -9.81" cone="elliptic" impratio="10" iterations="100" tolerance="1e-12"'
CONTACT = 'condim="3" solimp="0.999 0.9999 0.001" friction="{mu} 0 0" solref="{stiff} 1"'


def main() -> None:
    tasks.tell(__doc__, {"sheet": sheet, "slide": slide, "disk": disk}, STEPS, " s")


@cache
def model(step: float, mu: float, bodies: str) -> mujoco.MjModel:
    contact = CONTACT.format(mu=mu, stiff=0.02 * math.sqrt(step / 1e-3))
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><compiler angle="radian" inertiafromgeom="false"/>'
        f'<option timestep="{step}" integrator="implicitfast" {OPTIONS}/>'
        f"<default><geom {contact}/></default><worldbody>{bodies}</worldbody></mujoco>"
    )


def ball(start: float) -> str:
    m, r, k = (tasks.BALL[name] for name in "mrk")
    i = k * m * r * r
    return (
        f'<body pos="0 0 {start}"><freejoint/><inertial pos="0 0 0" mass="{m}" '
        f'diaginertia="{i} {i} {i}"/><geom type="sphere" size="{r}"/></body>'
    )


TABLE = '<geom type="plane" size="9 9 1"/>'
SHEET = (
    f'<body gravcomp="1"><joint type="slide" axis="1 0 0"/><joint type="slide" axis="0 1 0"/>'
    f'<joint type="hinge" axis="0 0 1"/><inertial pos="0 0 0" mass="{HEAVY}" '
    f'diaginertia="{HEAVY} {HEAVY} {HEAVY}"/><geom type="box" size="9 9 1" pos="0 0 -1"/></body>'
)


def ball_answer(name: str, data: mujoco.MjData, at: int, rate: int) -> dict[str, float]:
    values = (*data.qpos[at : at + 2], *data.qvel[rate : rate + 2])
    return dict(zip(tasks.ANSWERS[name], map(float, values), strict=True))


def slide(step: float) -> dict[str, float]:
    begin = tasks.SLIDE_START
    made = model(step, tasks.BALL["mu"], TABLE + ball(tasks.BALL["r"]))
    data = mujoco.MjData(made)
    data.qvel[:] = [begin["v_x"], begin["v_y"], 0, begin["omega_x"], begin["omega_y"], 0]
    mujoco.mj_step(made, data, round(tasks.SLIDE_DURATION / step))
    return ball_answer("slide", data, 0, 0)


def sheet(step: float) -> dict[str, float]:
    r, (v_x, v_y) = tasks.BALL["r"], tasks.SHEET_START
    made = model(step, tasks.BALL["mu"], SHEET + ball(r))
    data = mujoco.MjData(made)
    data.qvel[3:] = [v_x, v_y, 0, -v_y / r, v_x / r, 0]
    ends = [0.0, *tasks.KNOTS.tolist(), tasks.SHEET_DURATION]
    for piece, (begin, end) in enumerate(pairwise(ends), start=-1):
        for i in range(round((end - begin) / step)):
            places, rates, bends = tasks.sheet(piece, begin + i * step)
            data.qpos[:3], data.qvel[:3] = places, rates
            data.qfrc_applied[:3] = [HEAVY * bend for bend in bends]
            mujoco.mj_step(made, data)
    return ball_answer("sheet", data, 3, 3)


def disk(step: float) -> dict[str, float]:
    m, a, begin = tasks.DISK["m"], tasks.DISK["a"], tasks.DISK_START
    s, c = math.sin(begin["theta"]), math.cos(begin["theta"])
    across, about = m * a**2 / 4, m * a**2 / 2
    body = (
        f'<body pos="0 0 {a * s}" euler="{begin["theta"]} 0 0"><freejoint/>'
        f'<inertial pos="0 0 0" mass="{m}" diaginertia="{across} {across} {about}"/>'
        f'<geom type="cylinder" size="{a} 1e-5"/></body>'
    )
    made = model(step, tasks.DISK["mu"], TABLE + body)
    data = mujoco.MjData(made)
    own = begin["phi_dot"] * np.array([0.0, s, c])
    own[2] = begin["omega_3"]  # rates about the disk's own axes, the third its axle
    data.qvel[:] = [begin["v_x"], begin["v_y"], 0, *own]
    mujoco.mj_step(made, data, round(tasks.DISK_DURATION / step))
    mujoco.mj_forward(made, data)
    axle = data.xmat[1].reshape(3, 3)[2, 2]
    return {
        "x": float(data.qpos[0]),
        "y": float(data.qpos[1]),
        "theta": math.acos(axle),
        "omega_3": float(data.qvel[5]),
    }


if __name__ == "__main__":
    main()
