"""Newton and Euler for every body: what the reactions have to supply."""

from __future__ import annotations

from dataclasses import dataclass

from polhode.algebra import Vector
from polhode.derive._motion import Kinematics
from polhode.model import Action, Body


@dataclass(frozen=True)
class Wrench:
    """A force (N) through the centre of mass and a couple (N m), along the body's axes."""

    force: Vector
    couple: Vector


def demands(motion: Kinematics) -> dict[Body, Wrench]:
    """Rate of change of momentum less the loads, and of angular momentum less their moments.

    m dv/dt - F and dL/dt - τ about the centre of mass; the reactions must equal them.
    """
    actions = applied(motion)
    return {body: _demand(motion, body, actions) for body in motion.system.bodies}


def applied(motion: Kinematics) -> tuple[Action, ...]:
    """Everything the loads do."""
    system = motion.system
    return tuple(
        action
        for load in system.loads
        for action in load.actions(system.bodies, motion.places, motion.velocities)
    )


def _demand(motion: Kinematics, body: Body, actions: tuple[Action, ...]) -> Wrench:
    velocity, _ = motion.velocities[body]
    force = motion.derivative(velocity) * body.mass
    couple = motion.derivative(motion.spin(body))
    for action in actions:
        if action.body == body:
            force = force - action.force
            couple = couple - action.couple - action.arm.cross(action.force).express(body.axes)
    form, accelerations = motion.form, motion.accelerations
    wrench = Wrench(form.kept(force, accelerations), form.kept(couple, accelerations))
    form.settle((*wrench.force.components, *wrench.couple.components))
    return wrench
