"""Mechanical quantities of a model, formed from its declaration.

All declared speeds, rates and reaction components stay symbols, so that a quantity does not depend
on the equations of motion that claims are judged by.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from polhode.algebra import (
    ZERO,
    Expr,
    Symbol,
    SymbolKind,
    Vector,
    lengths_written_out,
    linear_parts,
    solve,
    symbols,
)
from polhode.base import DeclarationError
from polhode.derive import Equations
from polhode.judge.balance._declared import Placement, declared, reaction_symbol
from polhode.judge.latex._names import name_of, spelled
from polhode.judge.latex._tree import Node
from polhode.judge.meaning._meaning import Meaning, Tensor
from polhode.model import (
    Body,
    Contact,
    Frame,
    Gravity,
    Load,
    Pivot,
    Restraint,
    Share,
    Slider,
    parallel_axis,
)

#: In place of the name of a load, where the power of all forces is meant.
ALL_FORCES = "all forces"

#: How the axes of one body are called whose frame shares its name with another.
_AXES_OF = "axes of "


@dataclass(frozen=True, eq=False)
class Mechanics:
    """The quantities of one system; those of its first body unless another is named.

    A point is "cm" (of all bodies), "origin", the name of a body (its centre of mass) or of a
    contact or joint (the point of the body where it acts). Vectors are in inertial space, SI.

    Args:
        equations: of the system.
    """

    equations: Equations

    @cached_property
    def scalars(self) -> dict[str, Expr]:
        """Parameters, coordinates, speeds, rates, prescribed functions and reactions by name."""
        known = self.declared
        rates = [symbol.derivative() for symbol in (*known.coordinates, *known.speeds)]
        second = [coordinate.derivative().derivative() for coordinate in known.coordinates]
        driven = [symbol for f in known.functions for symbol in (f, f.derivative())]
        every = (*known.parameters, *known.coordinates, *known.speeds, *rates, *second, *driven)
        found = {symbol.published: Expr.generator(symbol) for symbol in every}
        return found | {line.name: _reaction(line.name) for line in self.equations.lines}

    @cached_property
    def letters(self) -> dict[Node, Expr]:
        """The scalars by the letters that they are printed as, with their dots."""
        return {name_of(name): value for name, value in self.scalars.items()}

    def published(self, letter: Node) -> str:
        """The name of the quantity that a letter of the declaration prints, such as x1 for x₁."""
        return self._published.get(letter) or spelled(letter)

    @cached_property
    def _published(self) -> dict[Node, str]:
        return {name_of(name): name for name in self.scalars}

    @cached_property
    def forces_by_letter(self) -> dict[Node, tuple[str, str]]:
        """Components of reactions, and the contact or joint of each, by the letters they go by.

        N_z stands for the N_z_b of a body with the tag b if no other component can be meant.
        """
        found: dict[Node, list[tuple[str, str]]] = {}
        for element, restraints in self.equations.kinetics.restraints.items():
            for one in (r for r in restraints if not r.is_couple):
                short = name_of(one.name.removesuffix(one.body.tag))
                for letter in {name_of(one.name), *({short} - self.letters.keys())}:
                    found.setdefault(letter, []).append((one.name, element))
        return {letter: forces[0] for letter, forces in found.items() if len(forces) == 1}

    @cached_property
    def declared(self) -> Placement:
        """The declaration with every body placed."""
        return declared(self.equations.system)

    # -- bodies, points and frames --------------------------------------------------------------

    @property
    def body(self) -> Body:
        """The first body with a mass, which phrases mean unless they name another."""
        return self.bodies[0]

    @cached_property
    def bodies(self) -> tuple[Body, ...]:
        """The bodies that letters may speak of: massless links only where nothing else moves."""
        every = self.equations.system.bodies
        return tuple(body for body in every if not body.is_massless) or every

    def _body(self, name: str) -> Body:
        return self.equations.system.body(name) if name else self.body

    @cached_property
    def frames(self) -> dict[str, Frame]:
        """All frames by name, those of the first body before those of others."""
        bodies = self.equations.system.bodies
        fixed = [b.fixed_axes for b in bodies if b.fixed_axes is not None]
        chains = [frame for axes in (*(b.axes for b in bodies), *fixed) for frame in axes.lineage]
        named = {frame.name: frame for frame in reversed(chains)}
        return {"lab": self.body.axes.root, "body": self.body.fixed_axes or self.body.axes, **named}

    def frame(self, name: str = "") -> Frame:
        """The frame with a name; without a name, the axes of the first body.

        The name of a contact or joint stands for the axes along which it has its force. "axes of
        bob" are those of a body, whose frame may have the name of another.
        """
        if not name:
            return self.body.axes
        if name.startswith(_AXES_OF):
            return self.equations.system.body(name.removeprefix(_AXES_OF)).axes
        known = {**self._frames_of_forces, **self.frames}
        if name not in known:
            raise DeclarationError(f"frame {name!r}", expected=f"one of {', '.join(known)}")
        return known[name]

    @cached_property
    def _frames_of_forces(self) -> dict[str, Frame]:
        """The axes along which contacts and joints have their forces, by their and its names."""
        found: dict[str, Frame] = {}
        for element in self.equations.system.elements:
            if isinstance(element, Contact | Pivot | Slider):
                axes = element.on.axes if isinstance(element, Contact) else element.along
                found.setdefault(axes.name, axes)
                found.setdefault(element.name, axes)
        return found

    @cached_property
    def frames_at_rest(self) -> dict[str, Frame]:
        """Frames with fixed directions: those of the laboratory, of slopes and of guides.

        Those below the axes of the first body come before others. One with the name of another is
        known by the contact or joint that it belongs to.
        """
        chains = (self.body.axes, *(body.axes for body in self.equations.system.bodies))
        below = [(f.name, f) for axes in chains for f in reversed(axes.lineage)]
        found: dict[str, Frame] = {}
        for name, frame in (*below, *self._frames_of_forces.items()):
            angles = (s for f in frame.lineage for s in f.angle.symbols())
            is_known = self.frame(name) != frame or frame in found.values()
            if not is_known and not any(s.kind.varies for s in angles):
                found[name] = frame
        return found

    def axis(self, label: str, of: str = "") -> Vector:
        """The unit vector with a label: of the laboratory, of the body's axes, or between."""
        axes = self.body.axes
        order = (self.frame(of),) if of else (axes.root, axes, *axes.lineage)
        for frame in order:
            if label in frame.labels:
                return frame[label]
        labels = dict.fromkeys(label for frame in order for label in frame.labels)
        raise DeclarationError(f"axis {label!r}", expected=f"one of {', '.join(labels)}")

    def fixed(self, of: str) -> Vector:
        """An arbitrary vector fixed in a frame, with three constants as components."""
        return Vector.along(self.frame(of), symbols("c_1 c_2 c_3"))

    def _place(self, point: str) -> tuple[Body, Vector]:
        """A body and the vector from its centre of mass to one of its points."""
        system = self.equations.system
        if point in ("", "cm"):
            return self.body, self.body.axes.zero
        if any(body.name == point for body in system.bodies):
            return system.body(point), system.body(point).axes.zero
        restraint = self._restraints(point)[0]
        return restraint.body, restraint.arm or restraint.body.axes.zero

    def _restraints(self, element: str) -> tuple[Restraint, ...]:
        known = {name: found for name, found in self.equations.kinetics.restraints.items() if found}
        if element not in known:
            raise DeclarationError(f"point {element!r}", expected=f"one of cm, {', '.join(known)}")
        return known[element]

    # -- motion ---------------------------------------------------------------------------------

    def position(self, of: str = "") -> Vector:
        """From the origin of the laboratory, m."""
        if of == "origin":
            return self.equations.system.root.zero
        if of == "cm":
            return self._mass_centre
        body, arm = self._place(of)
        return self.declared.places[body] + arm

    @cached_property
    def _mass_centre(self) -> Vector:
        """Of all bodies, from the origin of the laboratory, m."""
        places = self.declared.places
        if len(places) == 1:
            return places[self.body]
        bodies = self.equations.system.bodies
        moments = (places[body] * body.mass for body in bodies)
        mass = sum((body.mass for body in bodies), ZERO)
        return sum(moments, self.equations.system.root.zero) / mass

    def arm(self, of: str) -> Vector:
        """From the centre of mass to where a contact or joint acts, m."""
        return self._place(of)[1]

    def velocity(self, of: str = "") -> Vector:
        """Of a material point, or of the centre of mass of all bodies, m/s."""
        if of == "cm":
            return self._mass_centre.dt()
        body, arm = self._place(of)
        return self.declared.places[body].dt() + body.angular_velocity.cross(arm)

    def acceleration(self, of: str = "") -> Vector:
        """Of a centre of mass, m/s²."""
        if of == "cm":
            return self.velocity(of).dt()
        body, _ = self._place(of)
        return self.declared.places[body].dt().dt()

    def angular_velocity(self, of: str = "") -> Vector:
        """Of a body or a frame, rad/s."""
        if of in self.frames:
            return self.frames[of].angular_velocity
        return self._body(of).angular_velocity

    # -- momenta and forces ---------------------------------------------------------------------

    def inertia(self, of: str = "", about: str = "cm") -> Tensor:
        """The inertia tensor about the centre of mass or another point, kg m²."""
        body = self._body(of)
        inertia = body.inertia
        if about not in ("", "cm"):
            arm = (self.position(about) - self.declared.places[body]).express(body.axes)
            inertia = inertia + parallel_axis(body.mass, arm.components)
        return Tensor(inertia, body.axes)

    def inertia_component(self, row: str, column: str) -> Expr:
        """An entry of the inertia tensor about the centre of mass along the body's axes, kg m²."""
        place = self.body.axes.position
        return self.body.inertia[place(row), place(column)]

    def moment_of_inertia(self, axis: str) -> Expr:
        """A principal moment about the centre of mass, kg m²."""
        position = self.body.axes.position(axis)
        return self.body.inertia[position, position]

    def momentum(self, of: str = "") -> Vector:
        """Linear momentum of one body or of all, kg m/s."""
        bodies = (self._body(of),) if of else self.equations.system.bodies
        parts = (self.declared.places[body].dt() * body.mass for body in bodies)
        return sum(parts, self.equations.system.root.zero)

    def angular_momentum(self, about: str = "cm", relative: str = "") -> Vector:
        """Of all bodies about a point, kg m²/s; rotations as a frame sees them if one is named."""
        centre, places = self.position(about or "cm"), self.declared.places
        turning = self.frame(relative).angular_velocity if relative else self.body.axes.zero
        total = self.body.axes.zero
        for body in self.equations.system.bodies:
            # L = Σ [I ω + (r - r_P) × m v], with inertial velocities also where P moves.
            orbital = (places[body] - centre).cross(places[body].dt()) * body.mass
            total = total + self.inertia(body.name).of(body.angular_velocity - turning) + orbital
        return total

    def force(self, of: str) -> Vector:
        """The force of one contact, joint or load on its first body, N; of gravity on all."""
        load = self._loads.get(of)
        if load is not None:
            first = load.bodies[0] if load.bodies else None
            actions = self.declared.actions_of(load)
            forces = (a.force for a in actions if first in (None, a.body))
            return sum(forces, self.body.axes.zero)
        names = {restraint.name for restraint in self._restraints(of) if not restraint.is_couple}
        return self._sum_of_reactions(names)

    def total_force(self) -> Vector:
        """Of all contacts, joints and loads, N."""
        forces = [a.force for a in self.declared.actions]
        forces += [s.direction * value for value, s in self._supports() if s.arm is not None]
        return sum(forces, self.body.axes.zero)

    def _sum_of_reactions(self, names: set[str]) -> Vector:
        shares = (
            line.direction * _reaction(line.name)
            for line in self.equations.lines
            if line.name in names
        )
        return sum(shares, self.body.axes.zero)

    def torque(self, about: str = "cm") -> Vector:
        """Of all external forces and couples about a point, N m."""
        centre, places = self.position(about or "cm"), self.declared.places
        total = self.body.axes.zero
        for value, share in self._supports():
            moment = share.direction
            if share.arm is not None:
                moment = (places[share.body] + share.arm - centre).cross(share.direction)
            total = total + moment * value
        for action in self.declared.actions:
            lever = places[action.body] + action.arm - centre
            total = total + lever.cross(action.force) + action.couple
        return total

    def _supports(self) -> Iterator[tuple[Expr, Share]]:
        """Reactions with the bodies that they act on; those of two bodies on each other cancel."""
        for line in self.equations.lines:
            if line.restraint.other is None or line.restraint.more:
                yield from ((_reaction(line.name), share) for share in line.shares)

    def gravity(self) -> Vector:
        """Acceleration of gravity, m/s²."""
        for load in self.equations.system.loads:
            if isinstance(load, Gravity):
                heavy = (a for a in self.declared.actions_of(load) if not a.body.is_massless)
                first = next(heavy)
                return first.force / first.body.mass
        raise DeclarationError("gravity", expected="a system with the load Gravity")

    # -- energies -------------------------------------------------------------------------------

    def translational_energy(self) -> Expr:
        """Kinetic energy of the motion of the centres of mass, J."""
        velocities = ((b.mass, self.declared.places[b].dt()) for b in self.equations.system.bodies)
        return sum((mass * v.dot(v) / 2 for mass, v in velocities), ZERO)

    def rotational_energy(self) -> Expr:
        """Kinetic energy of the rotation about the centres of mass, J."""
        bodies = self.equations.system.bodies
        pairs = ((body.angular_velocity, self.inertia(body.name)) for body in bodies)
        return sum((w.dot(tensor.of(w)) / 2 for w, tensor in pairs), ZERO)

    def kinetic_energy(self) -> Expr:
        """Both together, J."""
        return self.translational_energy() + self.rotational_energy()

    def potential_energy(self, of: str = "") -> Expr:
        """Of all loads that have one, or of one of them, J."""
        if not of:
            return self.equations.potential_energy
        if of not in self.potentials:
            known = ", ".join(self.potentials) or "no load, as none has a potential"
            raise DeclarationError(f"the potential energy of {of!r}", expected=f"one of {known}")
        return self.potentials[of]

    @cached_property
    def potentials(self) -> dict[str, Expr]:
        """The potential energies of single loads by their names, J."""
        system, places = self.equations.system, self.declared.places
        found = {load.name: load.potential(system.bodies, places) for load in system.loads}
        stored = {name: energy for name, energy in found.items() if energy is not None}
        return {name: lengths_written_out(energy) for name, energy in stored.items()}

    @property
    def has_other_loads(self) -> bool:
        """Whether there are loads without a potential, such as dampers and given forces."""
        return len(self.potentials) < len(self.equations.system.loads)

    def energy(self) -> Expr:
        """Kinetic and potential energy, J."""
        return self.kinetic_energy() + self.potential_energy()

    def power(self, of: str) -> Expr:
        """Rate of work of one load, or of all forces: the rate of the kinetic energy, W."""
        if of == ALL_FORCES:
            return self.kinetic_energy().dt()
        if of not in self._loads:
            known = ", ".join((ALL_FORCES, *self._loads))
            raise DeclarationError(f"the power of {of!r}", expected=f"one of {known}")
        places = self.declared.places.items()
        velocities = {body: (place.dt(), body.angular_velocity) for body, place in places}
        actions = self.declared.actions_of(self._loads[of])
        return sum((action.power(velocities) for action in actions), ZERO)

    @cached_property
    def _loads(self) -> dict[str, Load]:
        return {load.name: load for load in self.equations.system.loads}

    def lagrangian(self) -> Expr:
        """Kinetic less potential energy, J."""
        return self.kinetic_energy() - self.potential_energy()

    def energy_of_acceleration(self) -> Expr:
        """Gibbs's function Σ m a²/2 + ω̇·I ω̇/2 + ω̇·(ω × L) of the independent rates, J/s².

        P. Appell, Journal für die reine und angewandte Mathematik 121 (1900) 310.
        """
        total = ZERO
        for body, place in self.declared.places.items():
            acceleration, turning = place.dt().dt(), body.angular_velocity
            bend, tensor = turning.dt(), self.inertia(body.name)
            gyroscopic = bend.dot(turning.cross(tensor.of(turning)))
            total = total + acceleration.dot(acceleration) * body.mass / 2
            total = total + bend.dot(tensor.of(bend)) / 2 + gyroscopic
        return on_constraints(total, self.equations)

    def conjugate(self, coordinate: str) -> Expr:
        """The momentum conjugate to a coordinate: ∂L/∂q̇."""
        known = {symbol.published: symbol for symbol in self.declared.coordinates}
        if coordinate not in known:
            raise DeclarationError(
                f"coordinate {coordinate!r}", expected=f"one of {', '.join(known)}"
            )
        return self.in_rates(self.lagrangian()).diff(known[coordinate].derivative())

    def in_speeds(self, quantity: Meaning) -> Meaning:
        """With rates of coordinates such as ẏ expressed by the declared speeds."""
        rates = {q.derivative(): rate for q, rate in self.declared.rates.items()}
        match quantity:
            case Expr() | Vector():
                return quantity.subs(rates)
        return quantity

    def in_rates(self, expression: Expr) -> Expr:
        """With speeds such as ω₃ expressed by the rates of the coordinates."""
        return expression.subs(self._speeds_by_rates)

    @cached_property
    def _speeds_by_rates(self) -> dict[Symbol, Expr]:
        rates = self.declared.rates
        found = {s for rate in rates.values() for s in rate.symbols() if s.kind is SymbolKind.SPEED}
        speeds = sorted(found, key=lambda symbol: symbol.published)
        if not speeds or len(speeds) != len(rates):
            return {}  # the rates q̇ = A u + b can be solved for u only if A is square
        parts = [(q, *linear_parts(rate, speeds)) for q, rate in rates.items()]
        right = [Expr.generator(q.derivative()) - rest for q, _, rest in parts]
        return dict(zip(speeds, solve([row for _, row, _ in parts], right), strict=True))


def _reaction(name: str) -> Expr:
    return Expr.generator(reaction_symbol(name))


# -- rates of any order, in terms of the independent ones -----------------------------------------


def on_constraints(expression: Expr, equations: Equations) -> Expr:
    """An expression in terms of the independent speeds and their rates, by the constraints.

    Accelerations of the independent speeds are kept: no dynamics is used.
    """
    given = {s: e for s in expression.symbols() if (e := by_constraints(s, equations)) is not None}
    return expression.subs(given) if given else expression


def by_constraints(symbol: Symbol, equations: Equations) -> Expr | None:
    """The value that the constraints give to a symbol; None if it is independent."""
    base, motion = symbol.base(), equations.kinetics
    rate = base.derivative()
    if base in equations.dependent:
        value, times = equations.dependent[base], symbol.order
    elif symbol.order and rate in motion.kinematics and rate not in equations.speeds:
        value, times = motion.kinematics[rate], symbol.order - 1
    else:
        return None
    for _ in range(times):
        value = on_constraints(value.chain(motion.rate), equations)
    return value


def is_acceleration(symbol: Symbol) -> bool:
    """Whether it is a rate that the motion determines, and no part of the state: θ̈, ω̇₃."""
    highest = {SymbolKind.COORDINATE: 1, SymbolKind.SPEED: 0}
    return symbol.order > highest.get(symbol.kind, symbol.order)
