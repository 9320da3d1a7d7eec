"""Fictitious forces and torques: element by element, integrated, and balanced."""

import polhode as ph
from analyse.systems import equations, symbols
from polhode.algebra import Expr, Vector, cos, integrate, sin
from polhode.analyse import (
    fictitious_force,
    fictitious_torque,
    relative_momentum,
    relative_rate,
)


def test_balance_in_the_turning_frame_of_the_gyroscope_closes():
    """dL'/dt = τ + fictitious torques, with L' and the rate as seen from the frame (ρ, φ, z)."""
    derived = equations("gyroscope")
    (body,) = derived.system.bodies
    frame = body.axes.parent
    pivot = derived.reactions["pivot"]
    torque = pivot.arm.cross(pivot.force)
    momentum = relative_momentum(derived, body, frame)
    changed = relative_rate(derived, momentum, frame)
    rest = changed - torque - fictitious_torque(derived, body, frame).total
    assert all(derived.on_shell(c) == 0 for c in rest.express(frame).components)


def test_they_explain_why_the_spin_of_the_gyroscope_varies():
    """Along the axle no real torque acts: I₁ψ̈ is the sum of the fictitious ones."""
    derived = equations("gyroscope")
    s = symbols(derived)
    (body,) = derived.system.bodies
    frame = body.axes.parent
    torques = fictitious_torque(derived, body, frame)
    along = body.axes["1"]
    theta, phi = s["theta"], s["phi"]
    spin_up = phi.dt() * theta.dt() * sin(theta) - phi.dt().dt() * cos(theta)
    coriolis_and_euler = torques.coriolis.dot(along) + torques.euler.dot(along)
    assert coriolis_and_euler == s["I_1"] * spin_up
    assert torques.centrifugal.dot(along) == 0


def hoop_torque(derived: ph.Equations, kind: str, radius: Expr, mass: Expr) -> Vector:
    """The torque of a kind of fictitious force on a hoop, added up element by element."""
    (body,) = derived.system.bodies
    axes = body.axes
    chi = ph.symbol("chi_0")
    element = axes.vector(radius * cos(chi), radius * sin(chi), 0)
    frame = axes.root if kind == "coriolis" else axes
    relative = derived.kinetics.velocities[body][1] - frame.angular_velocity
    forces = fictitious_force(derived, body, frame, element, relative.cross(element))
    torque = element.cross(getattr(forces, kind).express(axes))
    per_angle = mass / (2 * ph.pi)
    return Vector(
        tuple(integrate(c * per_angle, chi, 0, 2 * ph.pi) for c in torque.components), axes
    )


def test_coriolis_torque_on_the_hoop_of_a_gyrocompass():
    """Added up over the hoop it is m a² ω Ω (sin λ sin θ 1 + cos λ 2), and a part with θ̇.

    The problem set prints -sin λ cos θ for the second component (equations 10, 66, 67): its own
    element force (65) gives cos λ, and so does the integral by the inertia tensor below.
    """
    derived = equations("gyrocompass")
    s = symbols(derived)
    mass, radius = ph.symbols("m a", positive=True)
    torque = hoop_torque(derived, "coriolis", radius, mass)
    rate = mass * radius**2 * s["omega"] * s["Omega"]
    still = torque.subs({s["theta"].dt(): 0})
    assert still.components[0] == rate * sin(s["lambda_"]) * sin(s["theta"])
    assert still.components[1] == rate * cos(s["lambda_"])
    assert still.components[2] == 0


def test_elements_add_up_to_the_integrated_torques():
    derived = equations("gyrocompass")
    s = symbols(derived)
    mass, radius = ph.symbols("m a", positive=True)
    moments = {s["I_1"]: mass * radius**2 / 2, s["I_3"]: mass * radius**2}
    (body,) = derived.system.bodies
    whole = fictitious_torque(derived, body, body.axes.root)
    added = hoop_torque(derived, "coriolis", radius, mass)
    assert whole.coriolis.subs(moments).components == added.components
