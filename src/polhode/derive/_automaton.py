"""Contact modes of a system: the equations of each, and the guards whose zeros end it.

A hybrid automaton in the usual sense: each mode has its own equations, the guards say when it ends,
and the expressions of the contacts (gap, slip, distance to the edge) say which mode follows.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from itertools import product
from math import prod

from polhode.algebra import ZERO, Expr, Symbol, SymbolKind, length, named, variables
from polhode.base import ConstraintError, DeclarationError, Shown, look_up
from polhode.derive._attitudes import AngleTriple, with_turned_angles
from polhode.derive._balance_table import BalanceTable, balance_table
from polhode.derive._derive import derive, derive_in_parts
from polhode.derive._equations import Equations
from polhode.derive._motion import Kinematics
from polhode.derive._speed_choice import may_become_singular, on_independent
from polhode.model import (
    AT_APEX,
    AT_POLE,
    FLIGHT,
    FRICTIONLESS,
    MISFIT,
    NO_FOOT,
    STEEP,
    Apart,
    Contact,
    ContactLaw,
    DryFriction,
    Element,
    Phase,
    Restraint,
    Rolling,
    System,
    with_elements,
    with_independent,
)

_LONG = 50  # terms of a force above which its square is not multiplied out
_MOST_NAMES = 10_000  # of contact modes: each contact multiplies them by up to four


@dataclass(frozen=True)
class Touch:
    """Geometry and slip of a contact, closed or open, along the axes of the support.

    Attributes:
        contact: as declared, or a couple beside its force, which closes and opens with it.
        reserve: distance to the support's edge, m, positive on the support; zero without an edge.
        edge_distance: the same, positive on the side of the edge whose surface is touched.
        gap: height of the lowest point of the body above the support, m.
        closing: its rate, m/s.
        slip: velocity of that point along the support, m/s, or what the couple opposes.
    """

    contact: ContactLaw
    reserve: Expr
    edge_distance: Expr
    gap: Expr
    closing: Expr
    slip: tuple[Expr, Expr]

    @property
    def expressions(self) -> tuple[Expr, ...]:
        """All of these but `edge_distance`."""
        return (self.reserve, self.gap, self.closing, *self.slip)


def touch_of(equations: Equations, declared: ContactLaw, phase: Phase) -> Touch:
    """Gap, slip and distance to the edge of a contact that rolls, slides or is open."""
    motion = equations.kinetics
    # beyond the edge the body may touch another surface: a table beside a sheet of paper
    contact, reserve, beyond = declared, ZERO, declared.on.beyond
    if isinstance(declared, Contact):
        contact = touched = declared.on_support(beyond) if beyond and phase.is_beyond else declared
        reserve = declared.on.reserve(motion.places[touched.body] + touched.arm)
    pressing, sliding = contact.pressing(motion.places), contact.sliding(motion.places)
    along, across = (*slips_along(motion, sliding), ZERO)[:2]
    (closing,) = slips_along(motion, (pressing,))
    return Touch(
        contact,
        reserve,
        -reserve if phase.is_beyond else reserve,
        contact.gap(motion.places),
        closing,
        (along, across),
    )


def slips_along(motion: Kinematics, restraints: Iterable[Restraint]) -> list[Expr]:
    """Velocities of a body against its support along these restraints, m/s."""
    return [motion.slip(restraint).dot(restraint.direction) for restraint in restraints]


def velocities_of_support(motion: Kinematics, contact: ContactLaw) -> tuple[Expr, Expr, Expr]:
    """Velocity of the support at a contact, along the slip and the normal, in inertial space, m/s.

    Zero for a support that another body carries: the contact does work on both.
    """

    def along(restraint: Restraint) -> Expr:
        direction = restraint.direction
        return motion.resolve(restraint.velocity.express(direction.triad)).dot(direction)

    first, second = (*map(along, contact.sliding(motion.places)), ZERO)[:2]
    return first, second, along(contact.pressing(motion.places))


def height_of(equations: Equations, contact: Contact) -> Expr:
    """Height of a body's centre of mass above a support, m."""
    return contact.height_of_centre(equations.kinetics.places)


@dataclass(frozen=True)
class Guard:
    """An expression whose reaching zero ends a mode.

    Attributes:
        contact: the contact it belongs to; None for an expression that the equations assume to be
            positive.
        kind: "slips", "sticks", "lifts off", "touches down", "crosses the edge", "near-flat",
            "falls flat" of a centre of mass that comes down to the support, or a limit of a
            support.
        positive: greater than zero while the mode lasts.
    """

    contact: ContactLaw | None
    kind: str
    positive: Expr

    @property
    def ends(self) -> str:
        """The event that ends a motion there; empty if another mode follows."""
        return _ENDS.get(self.kind, "")

    @property
    def ends_before(self) -> bool:
        """Whether a motion ends just before it, where the equations become singular."""
        return self.kind in _SINGULAR


_ENDS = {
    "near-flat": "goes flat",
    "falls flat": "goes flat",
    **{kind: kind for kind in (MISFIT, NO_FOOT, AT_POLE, AT_APEX, STEEP)},
}
_SINGULAR = ("near-flat", MISFIT, NO_FOOT, AT_POLE, STEEP)


def guards_of(
    equations: Equations, touches: tuple[Touch, ...], phases: tuple[Phase, ...]
) -> Iterator[Guard]:
    """The guards of a mode, exact; accelerations and reactions occur in them as derived."""
    for touch, phase in zip(touches, phases, strict=True):
        contact = touch.contact
        if isinstance(contact, Contact):
            yield from _guards_of_place(equations, contact)
        if phase.flies:
            if not contact.is_beside:
                yield Guard(contact, "touches down", touch.gap)
            continue
        # asked of modes in which something touches alone: others may hold nothing together
        if set(equations.undetermined).isdisjoint(contact.components):
            yield from _guards_of_forces(equations, contact, phase)
        if touch.reserve:
            yield Guard(contact, "crosses the edge", touch.edge_distance)
        if phase.slides:
            first, second = touch.slip
            yield Guard(contact, "sticks", first * first + second * second)
    for side in equations.assumed_positive:
        yield Guard(None, "near-flat", side)


def _guards_of_place(equations: Equations, contact: Contact) -> Iterator[Guard]:
    """Where the description of a contact ends, closed or open."""
    if contact.may_fall_flat:
        yield Guard(contact, "falls flat", height_of(equations, contact))
    for limit in equations.system.element(contact.name).limits:
        if any(s.kind.varies for s in limit.positive.symbols()):
            yield Guard(contact, limit.kind, limit.positive)


def _guards_of_forces(equations: Equations, contact: ContactLaw, phase: Phase) -> Iterator[Guard]:
    """Where a contact opens, or what keeps it from slipping is at its limit."""
    if not contact.is_beside:
        normal = equations.components[contact.component(contact.on.normal)]
        yield Guard(contact, "lifts off", normal)
    if phase.rolls and isinstance(contact, DryFriction):
        # (μₛ N)² - |F|², N²: squares keep the guard free of roots, and smooth where F = 0
        # of long forces not multiplied out, which would make thousands of terms of hundreds
        parts = (equations.components[name] for name in contact.components)
        pressed, *rubbed = (p if length(p) <= _LONG else named(p) for p in parts)
        most = (contact.mu_static * pressed) ** 2
        yield Guard(contact, "slips", most - sum((f * f for f in rubbed), ZERO))


#: The phase of every contact, in the order of the declaration.
Phases = tuple[Phase, ...]


@dataclass(frozen=True)
class Mode:
    """One contact mode.

    Attributes:
        name: rolling, sliding, frictionless, flight; with several contacts that of each.
        phases: of every contact.
        equations: exact, on the speeds that the mode leaves independent.
        touches: gaps and slips of all contacts, in terms of this mode's coordinates and speeds.
        guards: expressions that stay positive while the mode lasts.
        embedding: coordinates and speeds of the mode in which nothing touches, in terms of this
            one's.
    """

    name: str
    phases: Phases
    equations: Equations
    touches: tuple[Touch, ...]
    guards: tuple[Guard, ...]
    embedding: Mapping[Symbol, Expr]

    @cached_property
    def undetermined(self) -> tuple[ContactLaw, ...]:
        """The contacts that touch with forces that Newton's laws do not determine."""
        loose = set(self.equations.undetermined)
        return tuple(
            touch.contact
            for touch, phase in zip(self.touches, self.phases, strict=True)
            if not phase.flies and not loose.isdisjoint(touch.contact.components)
        )

    @cached_property
    def balances(self) -> BalanceTable:
        """The balances of its bodies, from which open reactions are found in numbers."""
        return balance_table(self.equations)

    def phase(self, contact: ContactLaw) -> Phase:
        """The phase of a contact."""
        place = [touch.contact.name for touch in self.touches].index(contact.name)
        return self.phases[place]

    def element(self, contact: ContactLaw) -> Element:
        """The element that replaces a contact in this mode."""
        return self.equations.system.element(contact.name)


@dataclass(frozen=True)
class Automaton(Shown):
    """All contact modes of a system; each is derived when it is first needed.

    Coordinates, speeds and reactions have the same names in every mode.

    Attributes:
        system: the declaration.
        declared: the modes on the speeds of the declaration, where these are on others.
        in_declared_angles: the modes in the angles of the declaration, where these are in others.
    """

    system: System
    declared: Automaton | None = None
    in_declared_angles: Automaton | None = None
    _known: dict[Phases, Mode] = field(default_factory=dict, repr=False, compare=False)

    @cached_property
    def contacts(self) -> tuple[ContactLaw, ...]:
        """The contacts, as declared, and the couples beside their forces."""
        return self.system.contact_laws

    @cached_property
    def options(self) -> tuple[Mapping[Phase, Element], ...]:
        """For each contact, the phases it can be in."""
        return tuple(contact.phases() for contact in self.contacts)

    @cached_property
    def separated(self) -> Mode:
        """The mode in which nothing touches; joints still hold."""
        return self.mode((FLIGHT,) * len(self.contacts))

    @cached_property
    def beyond(self) -> Mode:
        """The same mode for bodies beyond the edges of their supports."""
        return self._derived(tuple(FLIGHT.beyond() for _ in self.contacts))

    @cached_property
    def together(self) -> Mode:
        """The mode in which everything touches, and sticks where it can.

        Of contacts that exclude each other, as of a ball between two walls, the first.
        """
        closed = tuple(next(iter(option)) for option in self.options)
        for kept in range(len(closed), 0, -1):
            try:
                return self.mode((*closed[:kept], *(FLIGHT,) * (len(closed) - kept)))
            except ConstraintError:
                if kept == 1:
                    raise
        return self.mode(closed)

    @cached_property
    def may_become_singular(self) -> bool:
        """Whether the independent speeds may have to change; those that a user chose stay."""
        if self.system.speeds:
            return False
        # Of three contacts of a body, as of the corners of a box, any two may close, on which other
        # speeds depend than on all or none.
        touching = [contact.body for contact in self.system.contacts]
        if any(touching.count(body) > 2 for body in touching):
            return True
        return any(may_become_singular(m.equations) for m in (self.together, self.separated))

    def on_speeds(self, speeds: Iterable[Symbol]) -> Automaton:
        """The same modes on other independent speeds, to be evaluated.

        Args:
            speeds: those to be kept; where a mode leaves fewer, the first of them.
        """
        changed = with_independent(self.system, map(Expr.generator, speeds))
        return Automaton(changed, self.declared or self, self.in_declared_angles)

    def in_turned_angles(self, attitudes: Iterable[AngleTriple]) -> Automaton:
        """The same modes with the angles of some attitudes counted from turned axes."""
        return Automaton(with_turned_angles(self.system, attitudes), None, self)

    @property
    def reaction_names(self) -> tuple[str, ...]:
        """Names of all reactions where everything touches; the same on all speeds and angles."""
        original = self.in_declared_angles or self
        return (original.declared or original).together.equations.reaction_names

    @cached_property
    def parameters(self) -> tuple[Symbol, ...]:
        """All constants of the declaration that any mode needs."""
        modes = (self.together, self.separated)
        own = [s for mode in modes for s in mode.equations.parameters]
        shapes = [e for mode in modes for touch in mode.touches for e in touch.expressions]
        coefficients: list[Expr] = []
        for contact in self.contacts:
            if isinstance(contact, Contact):
                coefficients.append(contact.restitution)
            if isinstance(contact, Rolling) and contact.tangential is not None:
                coefficients.append(contact.tangential)
            if isinstance(contact, DryFriction):
                coefficients += (contact.mu, contact.mu_static, contact.viscous)
                coefficients += () if contact.stribeck is None else (contact.stribeck,)
        used = variables([*shapes, *coefficients])
        found = [s for s in used if s.kind is SymbolKind.PARAMETER and s.name != "pi"]
        return tuple(sorted({*own, *found}, key=lambda s: s.published))

    @cached_property
    def functions(self) -> tuple[Symbol, ...]:
        """Prescribed functions of time that any mode needs."""
        modes = (self.together, self.separated)
        own = [s for mode in modes for s in mode.equations.functions]
        moving = [e for mode in modes for touch in mode.touches for e in touch.expressions]
        used = (s.base() for s in variables(moving) if s.kind is SymbolKind.FUNCTION)
        return tuple(sorted({*own, *used}, key=lambda s: s.published))

    def mode(self, chosen: Phases) -> Mode:
        """The mode with these phases of the contacts.

        Raises:
            DeclarationError: for a phase that a contact cannot be in.
        """
        if chosen not in self._known:
            self._known[chosen] = self._derived(chosen)
        return self._known[chosen]

    @property
    def known(self) -> tuple[Mode, ...]:
        """The modes derived so far."""
        return tuple(self._known.values())

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of all possible contact modes.

        Raises:
            DeclarationError: for more than can be listed.
        """
        count = prod(map(len, self.options))
        if count > _MOST_NAMES:
            raise DeclarationError(
                f"{count} contact modes of {len(self.contacts)} contacts",
                expected=f"at most {_MOST_NAMES} where all are listed, as for ensembles",
                advice="simulate each motion by itself, or declare bodies that do not interact "
                "as systems of their own",
            )
        return tuple(map(self._name, filter(self.is_possible, product(*self.options))))

    def is_possible(self, chosen: Phases) -> bool:
        """Whether the couples beside the forces of contacts act just where these touch."""
        known = {c.name: phase for c, phase in zip(self.contacts, chosen, strict=True)}
        beside = ((known[c.name], known[c.pressed_by]) for c in self.contacts if c.is_beside)
        return all(
            couple.flies == contact.flies and couple != FRICTIONLESS for couple, contact in beside
        )

    def named(self, name: str) -> Phases:
        """The phases of the mode with a name.

        Raises:
            DeclarationError: for a name that no mode has.
        """
        chosen, rest = list[Phase](), f"{name}, "
        for contact, option in zip(self.contacts, self.options, strict=True):
            said = {f"{contact.name} {phase.value}, ": phase for phase in option}
            for beginning in filter(rest.startswith, said):
                chosen.append(said[beginning])
                rest = rest.removeprefix(beginning)
                break
        if not rest:
            return tuple(chosen)
        shared = set.intersection(*map(set, self.options)) if self.options else set[Phase]()
        alike = [(phase,) * len(self.contacts) for phase in shared] or [()]
        known = {self._name(phases): phases for phases in alike}
        return look_up(name, known, "contact mode of this system")

    def _derived(self, chosen: Phases) -> Mode:
        elements = {}
        for contact, option, requested in zip(self.contacts, self.options, chosen, strict=True):
            phase = FLIGHT if requested.flies else requested
            if phase not in option:
                raise DeclarationError(
                    f"contact {contact.name!r} {phase.value}",
                    expected=f"one of {', '.join(p.value for p in option)}",
                )
            elements[contact.name] = option[phase]
        system = with_elements(self.system, elements)
        if self.declared is None:
            equations = derive_in_parts(system) if self.in_declared_angles else derive(system)
        else:
            known = self.declared.mode(chosen).equations.kinetics.all_speeds
            equations = on_independent(system, (s for s in system.independent if s in known))
        supported = zip(self.contacts, chosen, strict=True)
        touches = tuple(touch_of(equations, contact, phase) for contact, phase in supported)
        return Mode(
            self._name(chosen),
            chosen,
            equations,
            touches,
            tuple(guards_of(equations, touches, chosen)),
            self._lifted(equations),
        )

    def _name(self, chosen: Phases) -> str:
        if not chosen:
            return "as declared"
        if len(set(chosen)) == 1:
            return chosen[0].value
        pairs = zip(self.contacts, chosen, strict=True)
        return ", ".join(f"{contact.name} {phase.value}" for contact, phase in pairs)

    def _lifted(self, equations: Equations) -> dict[Symbol, Expr]:
        """Heights and their rates, which in contact follow from the other coordinates."""
        motion = equations.kinetics
        embedding = {}
        for option, contact in zip(self.options, self.contacts, strict=True):
            if not isinstance(contact, Contact):
                continue
            separated = option[FLIGHT]
            if not isinstance(separated, Apart) or separated.height in embedding:
                continue  # of two contacts of a body, the first places it
            if separated.height not in equations.coordinates:
                height = contact.height(motion.places)
                embedding[separated.height] = height
                embedding[separated.rise] = height.chain(motion.rate)
        return embedding


def automaton(system: System) -> Automaton:
    """The contact modes of a system, derived from the declaration as they are needed."""
    return Automaton(system)
