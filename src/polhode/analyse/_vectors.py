"""The vectors of a motion by name, and the frames along which they can be resolved."""

from __future__ import annotations

from collections.abc import Iterator

from polhode.algebra import Vector
from polhode.base import DeclarationError
from polhode.derive import Equations
from polhode.model import Body, Frame, System


def named_vectors(equations: Equations) -> dict[str, Vector]:
    """Angular velocities, places, velocities, momenta and forces, in the independent speeds.

    With several bodies each name ends in that of the body.

    Returns:
        By name: omega (rad/s, of the body), omega_axes (of its axes), r_cm (m), v_cm (m/s),
        a_cm (m/s²), L_cm (kg m²/s, about its centre of mass); F_NAME and tau_NAME, the force (N)
        and the couple (N m) of each contact or joint on its body.
    """
    found: dict[str, Vector] = {}
    for body in equations.system.bodies:
        ending = "" if len(equations.system.bodies) == 1 else f"_{body.name}"
        found |= {f"{name}{ending}": vector for name, vector in _of_body(equations, body)}
    for name, reaction in equations.reactions.items():
        if not reaction.force.is_zero:
            found[f"F_{name}"] = reaction.force
        if not reaction.couple.is_zero:
            found[f"tau_{name}"] = reaction.couple
    return found


def _of_body(equations: Equations, body: Body) -> Iterator[tuple[str, Vector]]:
    kinetics = equations.kinetics
    velocity, angular = kinetics.velocities[body]
    yield "omega", angular
    if body.fixed_axes != body.axes:
        yield "omega_axes", kinetics.resolve(body.axes.angular_velocity)
    yield "r_cm", kinetics.places[body]
    yield "v_cm", velocity
    yield "a_cm", kinetics.derivative(velocity)
    yield "L_cm", kinetics.spin(body)


def frames_of(system: System) -> dict[str, Frame]:
    """The frames of a system by name: of bodies from the root on, then fixed in bodies.

    Of two frames with one name, the one nearer to the root has it.
    """
    found: dict[str, Frame] = {}
    for body in system.bodies:
        for frame in reversed(body.axes.lineage):
            found.setdefault(frame.name, frame)
        if body.fixed_axes is not None:
            found.setdefault(body.fixed_axes.name, body.fixed_axes)
    return found


def frame_along(system: System, axes: str) -> tuple[Frame, tuple[str, ...]]:
    """The frame named by its name, or by labels such as "1,2,3", with the labels in that order.

    Of several frames with these labels it is the one nearest to the root.

    Raises:
        DeclarationError: where no frame of the system has that name or these labels.
    """
    frames = frames_of(system)
    if axes in frames:
        return frames[axes], frames[axes].labels
    labels = tuple(label.strip() for label in axes.split(","))
    for frame in frames.values():
        if len(labels) == 3 and set(labels) == set(frame.labels):
            return frame, labels
    known = dict.fromkeys(",".join(frame.labels) for frame in frames.values())
    raise DeclarationError(
        f"axes {axes!r} in {system.name!r}",
        expected=f"one of {' or '.join(known)}, or the name of a frame: {', '.join(frames)}",
    )
