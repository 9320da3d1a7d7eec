"""Bodies that spin about an axis about which their axes are turned besides."""

from __future__ import annotations

from polhode.algebra import Symbol, SymbolKind, variables
from polhode.base import DeclarationError
from polhode.derive._unconstrained import Unconstrained
from polhode.model import Body


def refuse_second_spins(motion: Unconstrained) -> None:
    """Refuse bodies whose axes turn about the axis of spin by a coordinate that moves nothing else.

    Raises:
        DeclarationError: naming the body and the coordinate.
    """
    for body in motion.system.bodies:
        loose = body.spin.loose(body.axes)
        angles = variables(frame.angle for frame in body.axes.lineage) if loose else ()
        idle = [s for s in angles if s.kind is SymbolKind.COORDINATE and _is_idle(motion, body, s)]
        if idle:
            raise DeclarationError(
                f"body {body.name!r}, which spins about {', '.join(loose)} while its axes turn "
                f"likewise with {', '.join(sorted(s.published for s in idle))}",
                expected="axes that do not turn about the axis of spin, or turn with other bodies",
                advice="say spin=WithAxes() if the axes are fixed in the body, or leave out that "
                "rotation",
            )


def _is_idle(motion: Unconstrained, body: Body, angle: Symbol) -> bool:
    """Whether a coordinate does no more to the system than the spin of a body does."""
    rate = angle.derivative()
    if rate not in motion.speeds or set(motion.movers([rate])) - {body}:
        return False
    held = (r.velocity for group in motion.restraints.values() for r in group)
    if any(rate in variables(velocity.components) for velocity in held):
        return False
    velocity, angular = motion.velocities[body]
    axes = [body.axes[label] for label in body.spin.loose(body.axes)]
    turned = motion.slope(angular, rate)
    across = turned if len(axes) > 1 else turned.cross(axes[0])
    return across.is_zero and rate not in variables(velocity.components)
