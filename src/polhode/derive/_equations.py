"""Equations of motion of one contact mode, and everything that follows from them exactly."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from polhode.algebra import (
    ZERO,
    Expr,
    Generator,
    Length,
    Matrix,
    OutgrownError,
    Row,
    Symbol,
    SymbolKind,
    Vector,
    dimension_of,
    dot,
    has_parts,
    keeps_lengths,
    lengths_in,
    roots_in,
    under_letters,
    variables,
)
from polhode.base import PURE, DeclarationError, Dimension, Shown
from polhode.derive import _dimensions as units
from polhode.derive import _energy as energies
from polhode.derive._accelerations import LARGEST_SYMBOLIC as LARGEST_SYMBOLIC
from polhode.derive._accelerations import accelerations_in_parts, solve_accelerations
from polhode.derive._applied_loads import actions_of
from polhode.derive._balance import ReactionColumn, Wrench
from polhode.derive._form import CLOSED, IN_LENGTHS, IN_PARTS, Form, in_lengths
from polhode.derive._idle_factors import without_idle_factors
from polhode.derive._length_letters import letters_of_lengths
from polhode.derive._motion import Kinematics
from polhode.derive._reactions import Reactions, SupportRank, solve_reactions, support_rank
from polhode.model import Action, Body, Contact, Load, System


@dataclass(frozen=True, repr=False)
class Reaction(Shown):
    """The force and couple of one contact or joint on its body.

    Attributes:
        name: of the contact or joint.
        body: the body acted on.
        force: N; resolve it along any frame with `.express(frame)`.
        couple: N m, besides the moment of the force.
        arm: from the body's centre of mass to where the force acts, m.
        undetermined: names of components that Newton's laws leave open.
    """

    name: str
    body: Body
    force: Vector
    couple: Vector
    arm: Vector
    undetermined: tuple[str, ...]

    def __repr__(self) -> str:
        pieces = [f"force {self.force}", f"arm {self.arm}"]
        if not self.couple.is_zero:
            pieces.append(f"couple {self.couple}")
        if self.undetermined:
            pieces.append(f"not determined: {', '.join(self.undetermined)}")
        return f"Reaction of {self.name!r} on {self.body.name!r}: {'; '.join(pieces)}"


#: Terms of an expression that is printed with the others: some three thousand characters.
LONGEST_PRINTED = 150


@dataclass(frozen=True, repr=False)
class Equations(Shown):
    """Exact equations on independent speeds.

    The motion obeys `mass · accelerations = forcing` together with `kinematics`.

    Attributes:
        system: the declaration they come from.
        kinetics: positions and velocities of all bodies.
        required: the wrench that the reactions must supply to every body.
        lines: the direction of every reaction component, with its body and arm.
        rows: the equations as derived, each an expression equal to zero, one per speed.
        mass: mass matrix over the accelerations.
        forcing: right-hand sides.
    """

    system: System
    kinetics: Kinematics
    required: dict[Body, Wrench]
    lines: tuple[ReactionColumn, ...]
    rows: tuple[Expr, ...]
    mass: Matrix
    forcing: Row

    #: Derives a system in another form; set where `polhode.derive` is imported.
    rederived: ClassVar[Callable[[System, Form], Equations]]

    @cached_property
    def in_lengths(self) -> Equations:
        """The same equations with every distance and slip speed as one quantity.

        As they are printed and computed: 1/ρ³ with ρ = |r₁ − r₂| is no quotient of sums, and
        x₁ − x₂ loses no digits. They are these equations themselves where no length occurs, and
        where even so they are too long to be written out.
        """
        form = self.kinetics.form
        if form == IN_LENGTHS:
            return self
        letters = letters_of_lengths(self.kinetics, symbols_of(self), lambda: self.dimensions)
        slips = form == CLOSED and any(root.plain is None for root in roots_in(self.rows))
        if letters or slips:
            with suppress(OutgrownError):
                found = type(self).rederived(self.system, in_lengths(letters))
                directions = (c for line in found.lines for c in line.direction.components)
                if keeps_lengths((*found.rows, found.potential_energy, *directions)):
                    return found
        return self

    @property
    def computed(self) -> Equations:
        """The form that motions are computed from: with lengths, unless long parts have names.

        Those are solved without pivots that may vanish on a motion, and keep lengths in any case.
        """
        return self.in_lengths if self.kinetics.form == CLOSED else self

    @cached_property
    def lengths(self) -> dict[str, Length]:
        """The lengths in the rates, reactions and energy of `in_lengths`, by their letters."""
        equations = self.in_lengths
        if equations.kinetics.form != IN_LENGTHS:
            return {}
        shown = (
            *(*equations.motion, *equations.kinematics.values(), *equations.dependent.values()),
            *(*equations.components.values(), equations.energy),
        )
        return {part.letter.name: part for part in lengths_in(shown)}

    def __str__(self) -> str:
        """Kinematics, equations of motion and reactions, one to a line.

        Of expressions with more than `LONGEST_PRINTED` terms only the number of terms is printed.
        Lengths are printed as letters, which the rates are followed by.
        """
        if self.in_lengths is not self:
            return str(self.in_lengths)
        lines = [f"Equations of motion of {self.system.name}"]
        if self.motion_in_parts:
            rows, legend = lettered(self, self._mass_form)
            lines += [f"  {row.pretty()} = 0" for row in rows]
            lines += legend
            lines.append(f"Reactions: {', '.join(line.name for line in self.lines)}")
        else:
            lines += [f"  {_printed(row, f'motion[{i}]')} = 0" for i, row in enumerate(self.motion)]
            rates = {s: e for s, e in self.kinematics.items() if s not in self.speeds}
            defined: dict[Generator, Expr] = dict(rates.items())
            defined |= {part: part.meaning for part in self.lengths.values()}
            if defined:
                lines.append("with")
                lines += [
                    f"  {Expr.generator(s).pretty()} = {e.pretty()}" for s, e in defined.items()
                ]
            if self.components:
                lines.append("Reactions")
                values, legend = lettered(self, self.components.values())
                named = zip(self.components, values, strict=True)
                lines += [f"  {name} = {_printed(v, f'components[{name!r}]')}" for name, v in named]
                lines += legend
        if self.undetermined:
            lines.append(f"Not determined: {', '.join(self.undetermined)}")
        return "\n".join(lines)

    __repr__ = __str__

    def latex(self) -> str:
        """LaTeX of the equations of motion, aligned, with the lengths that occur."""
        if self.in_lengths is not self:
            return self.in_lengths.latex()
        written = self.motion
        if self.motion_in_parts:
            written, _ = lettered(self, self._mass_form)
        lengths = ((Expr.generator(g), g.meaning) for g in lengths_in(written))
        equal = [*((row, ZERO) for row in written), *lengths]
        rows = r" \\ ".join(f"{left.latex()} &= {right.latex()}" for left, right in equal)
        return rf"\begin{{aligned}} {rows} \end{{aligned}}"

    @property
    def _mass_form(self) -> tuple[Expr, ...]:
        """Mass times accelerations less forcing, row by row."""
        accelerations = [Expr.generator(symbol) for symbol in self.acceleration_symbols]
        pairs = zip(self.mass.rows, self.forcing, strict=True)
        return tuple(dot(row, accelerations) - force for row, force in pairs)

    def _repr_latex_(self) -> str:
        return f"$\\displaystyle {self.latex()}$"

    @property
    def motion_in_parts(self) -> bool:
        """Whether long expressions of the equations of motion are kept under names."""
        return self.kinetics.form == IN_PARTS

    @property
    def in_parts(self) -> bool:
        """Whether any expression, reactions included, is too long for closed form."""
        return self.motion_in_parts or any(map(has_parts, self.components.values()))

    @property
    def coordinates(self) -> tuple[Symbol, ...]:
        """All coordinates."""
        return self.kinetics.coordinates

    @property
    def speeds(self) -> tuple[Symbol, ...]:
        """Independent speeds."""
        return self.kinetics.speeds

    @property
    def kinematics(self) -> dict[Symbol, Expr]:
        """Rate of every coordinate in terms of coordinates, speeds and time."""
        return self.kinetics.kinematics

    @property
    def dependent(self) -> dict[Symbol, Expr]:
        """The speeds that the constraints give, in terms of the independent ones."""
        return self.kinetics.dependent

    @property
    def acceleration_symbols(self) -> tuple[Symbol, ...]:
        """Time derivatives of the independent speeds."""
        return self.kinetics.accelerations

    @cached_property
    def motion(self) -> tuple[Expr, ...]:
        """The equations of motion, each an expression equal to zero, without idle factors."""
        return tuple(without_idle_factors(row) for row in self.rows)

    @cached_property
    def accelerations(self) -> dict[Symbol, Expr]:
        """Every acceleration, solved for, with long expressions under names where it outgrows use.

        Raises `NumericError` beyond five coupled speeds, for which only mass and forcing are
        available, and for speeds that no inertia resists.
        """
        solved: Row | None = None
        if not self.motion_in_parts:
            with suppress(OutgrownError):
                solved = solve_accelerations(self.speeds, self.mass, self.forcing)
        if solved is None:
            solved = accelerations_in_parts(self.mass, self.forcing)
        return dict(zip(self.acceleration_symbols, solved, strict=True))

    def on_shell(self, expression: Expr) -> Expr:
        """An expression along true motions: dependent rates and accelerations substituted."""
        once = self.kinetics.on_speeds(expression)
        if not once.symbols() & set(self.acceleration_symbols):
            return once
        return once.subs(self.accelerations)

    def rate(self, expression: Expr) -> Expr:
        """Time derivative along true motions."""
        return self.kinetics.on_speeds(expression).chain(self._true_rate)

    def _true_rate(self, symbol: Symbol) -> Expr:
        if symbol in self.speeds:
            return self.accelerations[symbol.derivative()]
        return self.kinetics.rate(symbol)

    # -- reactions ------------------------------------------------------------------------------

    @property
    def reaction_names(self) -> tuple[str, ...]:
        """Names of all scalar reaction components."""
        motion = self.kinetics
        rubbing = (f for e in motion.elements for f in e.friction(motion.places))
        friction = (name for f in rubbing for name in f.names)
        return (*(line.name for line in self.lines), *friction)

    @cached_property
    def couples(self) -> frozenset[str]:
        """Names of those reaction components that are couples, N m; the others are forces, N."""
        motion = self.kinetics
        restraints = [line.restraint for line in self.lines]
        for friction in (f for e in motion.elements for f in e.friction(motion.places)):
            restraints += friction.sliding
        return frozenset(r.name for r in restraints if r.is_couple)

    @cached_property
    def _solved(self) -> Reactions:
        return solve_reactions(self.kinetics, self.required, self.lines)

    @cached_property
    def components(self) -> dict[str, Expr]:
        """Every scalar reaction component by name, in terms of accelerations too.

        Undetermined ones appear as symbols with their names.
        """
        values = {**self._solved.values, **self._friction(self._solved.values)}
        return {name: self.kinetics.form.keep(value, ()) for name, value in values.items()}

    @cached_property
    def least(self) -> dict[str, Expr]:
        """The same, with undetermined components chosen for the smallest sum of squares."""
        return {**self._solved.least, **self._friction(self._solved.least)}

    def _values(self) -> Mapping[str, Expr]:
        return self.least

    def _friction(self, values: Mapping[str, Expr]) -> dict[str, Expr]:
        found = {}
        for element in self.kinetics.elements:
            for friction in element.friction(self.kinetics.places):
                line = next(c for c in self.lines if c.name == friction.normal.name)
                for name in friction.names:
                    found[name] = line.friction[name] * values[line.name]
        return found

    @property
    def undetermined(self) -> tuple[str, ...]:
        """Names of reaction components that Newton's laws leave open."""
        if self.motion_in_parts and self._support_rank.is_determined:
            return ()
        return self._solved.undetermined

    @cached_property
    def _support_rank(self) -> SupportRank:
        return support_rank(self.kinetics, self.lines)

    @property
    def unexplained(self) -> tuple[Expr, ...]:
        """Components of the balances that no reaction enters; they vanish along the motion."""
        return self._solved.unexplained

    @cached_property
    def reactions(self) -> dict[str, Reaction]:
        """Force and couple of every contact and joint on its body, by its name."""
        found = {}
        for element, restraints in self.kinetics.restraints.items():
            names = [restraint.name for restraint in restraints]
            own = [line for line in self.lines if line.name in names]
            if not own:
                continue
            first = own[0].restraint
            force = couple = first.direction * 0
            arms = (line.restraint.arm for line in own if line.restraint.arm)
            arm = next(arms, Vector.along(first.direction.triad, (0, 0, 0)))
            for line in own:
                value = self.components[line.name]
                for share in line.shares:
                    if share.body != first.body:
                        continue
                    if share.arm is None:
                        couple = couple + share.direction * value
                    else:
                        force = force + share.direction * value
                        if share.arm != arm:
                            lever = share.arm - arm
                            couple = couple + lever.cross(share.direction) * value
            loose = tuple(name for name in names if name in self.undetermined)
            found[element] = Reaction(element, first.body, force, couple, arm, loose)
        return found

    # -- energies and momenta -------------------------------------------------------------------

    @cached_property
    def kinetic_energy(self) -> Expr:
        """Kinetic energy in inertial space, J."""
        return energies.kinetic_energy(self.kinetics)

    @cached_property
    def potential_energy(self) -> Expr:
        """Potential energy, J."""
        return energies.potential_energy(self.kinetics)

    @property
    def energy(self) -> Expr:
        """Kinetic plus potential energy, J."""
        return self.kinetic_energy + self.potential_energy

    @property
    def lagrangian(self) -> Expr:
        """Kinetic less potential energy, J."""
        return self.kinetic_energy - self.potential_energy

    @cached_property
    def power(self) -> Expr:
        """Rate of change of the energy: work of friction, motors, moving supports, drives, W."""
        return energies.supplied_power(
            self.kinetics, self.lines, self._values, self.required, lambda: self.undetermined
        )

    @cached_property
    def powers(self) -> dict[str, Expr]:
        """Rate of work of every load, contact and joint on the whole system, W, by its name."""
        powers = {load.name: self.load_power(load.name) for load in self.system.loads}
        lines = {line.name: line for line in self.lines}
        for name, restraints in self.kinetics.restraints.items():
            powers[name] = ZERO
            for line in (lines[r.name] for r in restraints if r.name in lines):
                powers[name] += energies.reaction_power(self.kinetics, line, self._values)
        return powers

    def load_power(self, name: str) -> Expr:
        """Rate of work of one load, W."""
        return energies.load_power(self.kinetics, self.system.load(name), self._values)

    def actions(self, load: Load) -> tuple[Action, ...]:
        """The forces and couples of one load, with the values of reactions that it depends on."""
        return actions_of(self.kinetics, load, self._values)

    @property
    def linear_momentum(self) -> Vector:
        """Linear momentum in inertial space, kg m/s."""
        return energies.linear_momentum(self.kinetics)

    def angular_momentum(self, about: Vector | None = None) -> Vector:
        """Angular momentum about a place (from the origin, m), by default the origin, kg m²/s."""
        place = about if about is not None else self.system.root.zero
        return energies.angular_momentum(self.kinetics, place)

    # -- constraints and names ------------------------------------------------------------------

    @cached_property
    def closures(self) -> tuple[Expr, ...]:
        """Expressions of the configuration that must vanish (m): closed loops."""
        motion = self.kinetics
        return tuple(c for e in motion.elements for c in e.closures(motion.places))

    @cached_property
    def slips(self) -> dict[str, Expr]:
        """Velocity of every restrained point against its support, m/s; zero along the motion."""
        motion = self.kinetics
        return {line.name: motion.excluded(line.restraint) for line in self.lines}

    @cached_property
    def assumed_positive(self) -> tuple[Expr, ...]:
        """Expressions assumed to be positive to choose a root, such as sin θ for a disk."""
        found = (e for element in self.kinetics.elements for e in element.assumed_positive())
        return tuple(dict.fromkeys(e for e in found if e.rational is None))

    @cached_property
    def limits(self) -> tuple[Expr, ...]:
        """What is positive where bodies touch curved supports at one point, as u and v say."""
        return tuple(limit.positive for e in self.kinetics.elements for limit in e.limits)

    @cached_property
    def parameters(self) -> tuple[Symbol, ...]:
        """Constants that occur, those of moving supports included, in alphabetical order."""
        return self._of_kind(SymbolKind.PARAMETER)

    @cached_property
    def functions(self) -> tuple[Symbol, ...]:
        """Prescribed functions of time that occur, without their derivatives."""
        found = (s.base() for s in self._of_kind(SymbolKind.FUNCTION))
        return tuple(dict.fromkeys(found))

    @cached_property
    def dimensions(self) -> dict[Symbol, Dimension]:
        """Dimension of every symbol, inferred from its uses.

        Raises `UnitError` where two uses contradict one another.
        """
        energy = {"kinetic energy": self.kinetic_energy, "potential energy": self.potential_energy}
        return units.infer(units.uses_of(self.kinetics, energy, self._roles_of_reactions()))

    def _roles_of_reactions(self) -> dict[str, tuple[Expr, Dimension]]:
        """What has the dimension of a reaction, or determines it, by role.

        Solved in parts, reactions say nothing about symbols that are hidden in the parts, and those
        that are left open say nothing at all. Then the balances do as well, and need not be solved.
        """
        are_solved = not (self.motion_in_parts and self._support_rank.is_supported)
        if are_solved and not self.undetermined:
            return {
                f"reaction {line.name}": (
                    self._solved.values[line.name],
                    units.ENERGY if line.restraint.is_couple else units.FORCE,
                )
                for line in self.lines
            }
        roles = {
            f"direction {axis} of {line.name}": (component, PURE)
            for line in self.lines
            for axis, component in enumerate(line.direction.components, 1)
        }
        for body, wrench in self.required.items():
            for name, vector, dimension in (
                ("force", wrench.force, units.FORCE),
                ("couple", wrench.couple, units.ENERGY),
            ):
                roles |= {
                    f"{name} {axis} on {body.name}": (component, dimension)
                    for axis, component in enumerate(vector.components, 1)
                }
        return roles

    def _of_kind(self, kind: SymbolKind) -> tuple[Symbol, ...]:
        wrenches = (v for wrench in self.required.values() for v in (wrench.force, wrench.couple))
        balances = [component for vector in wrenches for component in vector.components]
        rates = self.kinematics.values()
        own = [*self.rows, *balances, self.energy, *rates, *self.closures]
        for element in self.kinetics.elements:
            if isinstance(
                element, Contact
            ):  # its support's motion, even where no force depends on it
                own += (element.on.turning, *element.on.drift.components)
        used = variables(own)
        found = (s for s in used if s.kind is kind and s.name != "pi")
        return tuple(sorted(found, key=lambda s: s.published))


def equations_only(given: object, what: str) -> None:
    """Refuse anything but equations of motion.

    Raises:
        DeclarationError: for anything else.
    """
    if not isinstance(given, Equations):
        raise DeclarationError(
            f"{what} of a {type(given).__name__}",
            expected="equations of motion",
            advice="derive them first: ph.derive(system)",
        )


def is_angle(equations: Equations, symbol: Symbol) -> bool:
    """Whether a quantity is an angle, to be shown in degrees.

    Dimensionless coordinates are, and so is a dimensionless parameter that occurs linearly with a
    numeric coefficient in the argument of a sine or cosine.
    """
    if dimension_of(Expr.generator(symbol), equations.dimensions) not in (PURE, None):
        return False
    if symbol in equations.coordinates:
        return True
    for row in (*equations.motion, equations.potential_energy):
        for generator in row.generators:
            if getattr(generator, "name", "") in ("sin", "cos") and symbol in generator.symbols():
                slopes = (argument.diff(symbol) for argument in generator.arguments)
                if any(slope and not slope.symbols() for slope in slopes):
                    return True
    return False


def _printed(expression: Expr, place: str) -> str:
    """An expression on one line, or where it is found if nobody would read it."""
    terms = len(expression.num)
    if terms > LONGEST_PRINTED:
        return f"({terms} terms, in equations.{place})"
    return expression.pretty()


def symbols_of(equations: Equations) -> tuple[Symbol, ...]:
    """Coordinates, speeds and parameters, from which letters for parts have to differ."""
    return (*equations.coordinates, *equations.kinetics.dependent, *equations.parameters)


def lettered(
    equations: Equations, expressions: Iterable[Expr]
) -> tuple[tuple[Expr, ...], tuple[str, ...]]:
    """Expressions with a letter for every long part, and a line that explains the letters, if any.

    The letters differ from all symbols of the equations.
    """
    given = tuple(expressions)
    if not any(map(has_parts, given)):
        return given, ()
    written, parts = under_letters(given, symbols_of(equations))
    names = [Expr.generator(symbol).pretty() for symbol in parts]
    one = f"{names[0]} is a long expression"
    several = f"{names[0]}, ..., {names[-1]} are long expressions"
    explained = one if len(names) == 1 else several
    return written, (f"where {explained} of coordinates and speeds, kept under names",)
