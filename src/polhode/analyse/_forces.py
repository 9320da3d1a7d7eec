"""Fictitious forces in a rotating frame, and the forces that a contact needs."""

from __future__ import annotations

from dataclasses import dataclass

from polhode.algebra import ZERO, Expr, Matrix, Vector, sqrt
from polhode.base import DeclarationError, Shown
from polhode.derive import Equations, equations_only
from polhode.model import Body, Contact, Frame, second_moments


@dataclass(frozen=True)
class Fictitious(Shown):
    """The terms that the motion of a frame adds to Newton's laws.

    For an element they are forces per unit mass (N/kg); for a body, torques about its centre of
    mass (N m). All vanish for a frame at rest.

    Attributes:
        centrifugal: -Ω × (Ω × r).
        coriolis: -2 Ω × v, with v relative to the frame.
        euler: -Ω̇ × r, also called azimuthal.
        coordinate: minus the acceleration of the frame's origin; no torque on a body whose
            centre of mass is that origin.
    """

    centrifugal: Vector
    coriolis: Vector
    euler: Vector
    coordinate: Vector

    @property
    def total(self) -> Vector:
        """Their sum."""
        return self.centrifugal + self.coriolis + self.euler + self.coordinate


def fictitious_force(
    equations: Equations, body: Body, frame: Frame, element: Vector, relative: Vector
) -> Fictitious:
    """Forces per unit mass on an element of a body, in a frame carried by its centre of mass.

    Args:
        equations: of the system.
        body: the body the element belongs to.
        frame: turning directions, with their origin at the centre of mass.
        element: from the centre of mass to the element, m.
        relative: velocity of the element relative to the frame, m/s.
    """
    equations_only(equations, "a fictitious force")
    turning, change = _turning(equations, frame)
    acceleration = equations.kinetics.derivative(equations.kinetics.velocities[body][0])
    place = element.express(frame)
    return Fictitious(
        -turning.cross(turning.cross(place)),
        turning.cross(relative.express(frame)) * -2,
        -change.cross(place),
        -acceleration.express(frame),
    )


def fictitious_torque(equations: Equations, body: Body, frame: Frame) -> Fictitious:
    """The same integrated over the body, about its centre of mass.

    With J = ∫ r r dm = ½ tr(I) - I: centrifugal -Ω × IΩ, Coriolis -2 JΩ × ω', Euler -I Ω̇, where
    ω' is the rotation of the body relative to the frame.
    """
    equations_only(equations, "a fictitious torque")
    turning, change = _turning(equations, frame)
    axes = body.axes
    spin = equations.kinetics.velocities[body][1] - turning
    about = turning.express(axes)
    centrifugal = -about.cross(_times(body.inertia, about, axes))
    coriolis = _times(second_moments(body.inertia), about, axes).cross(spin.express(axes)) * -2
    euler = -_times(body.inertia, change.express(axes), axes)
    return Fictitious(centrifugal, coriolis, euler, axes.zero)


def relative_momentum(equations: Equations, body: Body, frame: Frame) -> Vector:
    """Angular momentum about the centre of mass relative to a turning frame, kg m²/s."""
    turning, _ = _turning(equations, frame)
    spin = equations.kinetics.velocities[body][1] - turning
    return _times(body.inertia, spin.express(body.axes), body.axes)


def relative_rate(equations: Equations, vector: Vector, frame: Frame) -> Vector:
    """Rate of change of a vector as seen from a turning frame, along the motion."""
    turning, _ = _turning(equations, frame)
    return equations.kinetics.derivative(vector) - turning.cross(vector)


def _turning(equations: Equations, frame: Frame) -> tuple[Vector, Vector]:
    turning = equations.kinetics.resolve(frame.angular_velocity)
    return turning, equations.kinetics.derivative(turning)


def _times(matrix: Matrix, vector: Vector, axes: Frame) -> Vector:
    return Vector(matrix.times(vector.express(axes).components), axes)


# Contact forces: how much friction rolling needs, and where the contact opens.


@dataclass(frozen=True)
class ContactForces(Shown):
    """Forces at a contact along true motions.

    Attributes:
        normal: pressing the surfaces together, N; the contact opens where it vanishes.
        tangential: magnitude of the friction force, N.
    """

    normal: Expr
    tangential: Expr

    @property
    def friction_needed(self) -> Expr:
        """The smallest coefficient of friction with which it does not slip."""
        return self.tangential / self.normal


def contact_forces(equations: Equations, name: str) -> ContactForces:
    """Normal and friction force of a contact, in terms of coordinates and speeds.

    Raises `DeclarationError` for a joint, which holds on both sides.
    """
    equations_only(equations, "contact forces")
    element = equations.system.element(name)
    if not isinstance(element, Contact):
        raise DeclarationError(
            f"contact forces at {name!r}, which is not a contact",
            expected="a Rolling, Smooth or Coulomb contact",
        )
    force = equations.reactions[name].force
    support = element.on
    along = [equations.on_shell(force.dot(support.axes[label])) for label in support.tangents]
    squared = sum((component * component for component in along), ZERO)
    return ContactForces(equations.on_shell(force.dot(support.up)), sqrt(squared))
