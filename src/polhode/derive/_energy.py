"""Energies, momenta, and the power of forces that have no potential."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping

from polhode.algebra import ZERO, Expr, SymbolKind, Vector, variables
from polhode.derive._applied_loads import ReactionValues, actions_of
from polhode.derive._balance import ReactionColumn, Wrench
from polhode.derive._motion import Kinematics
from polhode.model import Body, Frame, Load


def kinetic_energy(motion: Kinematics) -> Expr:
    """Kinetic energy in inertial space, J: ½ m v² + ½ ω·L of every body (König)."""
    energies = []
    for body in motion.system.bodies:
        velocity, angular = motion.velocities[body]
        spin = angular.dot(motion.spin(body))
        energy = (body.mass * velocity.dot(velocity) + spin) / 2
        energies.append(motion.form.keep(energy, motion.speeds))
    return sum(energies, ZERO)


def potential_energy(motion: Kinematics) -> Expr:
    """Potential energy of all loads that have one, J."""
    potentials = map(motion.potential, motion.system.loads)
    return sum((v for v in potentials if v is not None), ZERO)


def load_power(motion: Kinematics, load: Load, reactions: ReactionValues) -> Expr:
    """Rate of work of a load, W, with the values of the reactions on which it depends."""
    actions = actions_of(motion, load, reactions)
    return sum((action.power(motion.velocities) for action in actions), ZERO)


def reaction_power(motion: Kinematics, column: ReactionColumn, values: ReactionValues) -> Expr:
    """Rate of work of one reaction component on the whole system, W.

    Zero for a support at rest; a moving support, a motor and sliding friction do work.
    """
    total = _power_of(motion, column.wrenches)
    return total * values()[column.name] if total else ZERO


def _power_of(motion: Kinematics, wrenches: Iterable[tuple[Body, Wrench]]) -> Expr:
    total = ZERO
    for body, wrench in wrenches:
        velocity, angular = motion.velocities[body]
        total = total + velocity.dot(wrench.force) + angular.dot(wrench.couple)
    return total


def supplied_power(
    motion: Kinematics,
    columns: tuple[ReactionColumn, ...],
    values: ReactionValues,
    required: Mapping[Body, Wrench],
    undetermined: Callable[[], Collection[str]],
) -> Expr:
    """Rate of change of kinetic plus potential energy, W.

    Where open reactions do work, as those of a shaken table on four legs, that of all together is
    what the bodies require of them.

    Args:
        required: the sum that the reactions on every body must have.
        undetermined: names of the reactions that are open.
    """
    loads = sum((_supplied_by(motion, load, values) for load in motion.system.loads), ZERO)
    per_unit = {column.name: _power_of(motion, column.wrenches) for column in columns}
    working = {name: power for name, power in per_unit.items() if power}
    if working and not working.keys().isdisjoint(undetermined()):
        return loads + _power_of(motion, required.items())
    return sum((power * values()[name] for name, power in working.items()), loads)


def _supplied_by(motion: Kinematics, load: Load, reactions: ReactionValues) -> Expr:
    """The rate at which a load changes T + V: its power plus the rate of change of its potential.

    For a load with a potential that is only the work of moving its sources, such as the far end of
    a spring, or the prescribed motion of a frame in which the source is at rest.
    """
    potential = motion.potential(load)
    if potential is None:
        return load_power(motion, load, reactions)
    if not _is_driven(motion, potential):
        return ZERO
    return motion.on_speeds(potential).chain(motion.rate) + load_power(motion, load, reactions)


def _is_driven(motion: Kinematics, potential: Expr) -> bool:
    """Whether something in the system or in a potential moves with time alone."""
    system = motion.system
    angles = (frame.angle for body in system.bodies for frame in body.axes.lineage)
    places = (c for place in motion.places.values() for c in place.components)
    found = variables((potential, *angles, *places))
    prescribed = any(s.kind in (SymbolKind.FUNCTION, SymbolKind.TIME) for s in found)
    return prescribed or any(system.root.turned)


def linear_momentum(motion: Kinematics) -> Vector:
    """Linear momentum in inertial space, kg m/s, along the root frame."""
    root = motion.system.root
    parts = (motion.velocities[b][0] * b.mass for b in motion.system.bodies)
    return sum((_along(motion, p, root) for p in parts), root.zero)


def angular_momentum(motion: Kinematics, about: Vector) -> Vector:
    """Angular momentum in inertial space about a place (from the origin, m), kg m²/s."""
    root = motion.system.root
    total = root.zero
    for body in motion.system.bodies:
        velocity, _ = motion.velocities[body]
        orbital = (motion.places[body] - about).cross(_along(motion, velocity, root)) * body.mass
        total = total + _along(motion, motion.spin(body), root) + _along(motion, orbital, root)
    return total


def _along(motion: Kinematics, vector: Vector, frame: Frame) -> Vector:
    return motion.form.kept(motion.form.express(vector, frame), motion.speeds)
