"""Kernels of the contact modes for live pages, and the expressions that join the modes.

For every mode there are two kernels with the same states: one integrates, one computes whatever is
wanted at a state. What is shown is kept out of the first, whose steps would otherwise compute the
Taylor series of all of it. Parameters are the same in all.

A page goes from mode to mode by itself where a system has one contact: it applies the rules of
`contact` to the forces, slips and maps between modes that are compiled here. Of a system with
several contacts it has the mode that a motion starts in, and ends where that does.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.base import ConstraintError, DeclarationError
from polhode.derive import Automaton, Equations, Guard, Mode, automaton
from polhode.model import FRICTIONLESS, SLIDING, Contact, Coulomb, Rolling, Rope, System
from polhode.simulate._closed_loops import determined_by_loops
from polhode.simulate._dynamics import CLOCK, WORK, Dynamics
from polhode.simulate._export_kernel import normal_forces
from polhode.simulate._independent_speeds import SpeedChoices
from polhode.simulate._simulate import NEAR_FLAT
from polhode.simulate._task import AS_DECLARED
from polhode.simulate._trajectory import Trajectory
from polhode.simulate.contact._auxiliary_states import (
    dynamics_of,
    edge_distance_symbol,
    gap_symbol,
    slip_symbols,
)
from polhode.simulate.contact._contact_kinematics import kinematic_expressions
from polhode.simulate.contact._mode_expressions import (
    closing_rates_of,
    contact_forces_of,
    projection_of,
    shared_state_of,
    slip_rates_of,
    vanishing_expression,
)
from polhode.simulate.contact._slip_onset import POINTS, SLOPES, TO_SERIES
from polhode.simulate.integrate._flow import degree_in
from polhode.simulate.integrate._stepping import fewest_for
from polhode.simulate.kernel._layout import (
    DOUBLE_PLACES,
    INTEGER_PLACES,
    RECORD_HEAD,
    Layout,
    order_of,
)
from polhode.simulate.kernel._steps import kernel_binary
from polhode.simulate.kernel._tape import tape_of

_STEPS = 256  # that one call takes
_LEAST = Symbol("least slip squared", SymbolKind.PARAMETER)

#: Expressions of a mode by what they are for; see `_transition`.
Joined = Mapping[str, tuple[Expr, ...]]


@dataclass(frozen=True)
class Watched:
    """An expression that is positive for as long as a motion stays in its contact mode.

    Attributes:
        kind: lifts off, slips, and so on, as events are called.
        ends: whether the motion ends there.
        positive: the expression.
    """

    kind: str
    ends: bool
    positive: Expr


@dataclass(frozen=True)
class PageMode:
    """A contact mode as a page computes it.

    Attributes:
        name: as in trajectories.
        phase: of its only contact: rolling, sliding, frictionless or flight; empty for others.
        is_beyond: whether that is beyond the edge of its support.
        contact: its only contact, on the support that it touches; None for others.
        dynamics: its equations.
        watched: what ends it.
        joined: expressions for the changes of mode.
    """

    name: str
    phase: str
    is_beyond: bool
    contact: Contact | None
    dynamics: Dynamics
    watched: tuple[Watched, ...]
    joined: Joined

    @property
    def work(self) -> int:
        """Which state is the work done."""
        return self.dynamics.states.index(WORK)

    @property
    def equations(self) -> Equations:
        """Its equations of motion."""
        assert isinstance(self.dynamics.equations, Equations)
        return self.dynamics.equations


@dataclass(frozen=True)
class Schedule:
    """Coefficients of prescribed motions, which change at certain times.

    Attributes:
        symbols: the coefficients.
        times: from when on each of the rows holds, s.
        values: a row for each time.
        jerks: whether the velocity of a support jumps there.
    """

    symbols: tuple[Symbol, ...] = ()
    times: tuple[float, ...] = ()
    values: tuple[tuple[float, ...], ...] = ()
    jerks: tuple[bool, ...] = ()


@dataclass(frozen=True)
class PageKernels:
    """The contact modes of a motion as a page computes them.

    Attributes:
        modes: with that in which the motion starts in front.
        contact: the contact by whose rules the page goes from mode to mode; None if it has one
            mode only.
        formulas: parameters that follow from others.
        schedule: coefficients of prescribed motions that are given piece by piece.
    """

    modes: tuple[PageMode, ...]
    contact: Contact | None
    formulas: Mapping[Symbol, Expr]
    schedule: Schedule

    @cached_property
    def chosen(self) -> tuple[Symbol, ...]:
        """The parameters that have values of their own, which may be chosen."""
        own = [s for mode in self.modes for s in mode.dynamics.parameters]
        needed = [s for value in self.formulas.values() for s in value.symbols()]
        others = {*self.formulas, *self.schedule.symbols}
        free = (s for s in (*own, *needed) if s not in others and s.name != "pi")
        return tuple(dict.fromkeys(free))

    @property
    def parameters(self) -> tuple[Symbol, ...]:
        """All: the chosen ones, those of the schedule, and one that bounds slips from below."""
        return (*self.chosen, *self.schedule.symbols, _LEAST)

    def integrator(self, mode: PageMode) -> dict[str, Any]:
        """The kernel that integrates a mode, for hosts."""
        guards = [watched.positive for watched in mode.watched]
        order = order_of(float(np.finfo(float).eps))
        return self._hosted(mode, guards, order, _STEPS, len(guards))

    def viewer(self, mode: PageMode, wanted: Sequence[Expr | None]) -> dict[str, Any]:
        """The kernel that computes expressions at a state, for hosts; of None it has no value."""
        found = self._hosted(mode, [e for e in wanted if e is not None], 2, 1, 0)
        places = iter(found["outputs"])
        return found | {"outputs": [0 if e is None else next(places) for e in wanted]}

    def fewest(self, mode: PageMode) -> int:
        """The least number of steps for a motion, without which one may be infinite."""
        program = self._computing(mode).program(mode.dynamics.rates, self._arguments(mode))
        return fewest_for(degree_in(program, CLOCK))

    def _arguments(self, mode: PageMode) -> tuple[Symbol, ...]:
        return (*mode.dynamics.states, *self.parameters, CLOCK)

    def _computing(self, mode: PageMode) -> Dynamics:
        return replace(mode.dynamics, meanings={**mode.dynamics.meanings, **self.formulas})

    def _hosted(
        self, mode: PageMode, wanted: Iterable[Expr], order: int, steps: int, guards: int
    ) -> dict[str, Any]:
        """What the memory of a kernel holds at first, and where a host finds what, in bytes."""
        expressions = (*mode.dynamics.rates, *wanted)
        program = self._computing(mode).program(expressions, self._arguments(mode))
        tape = tape_of(program, len(mode.dynamics.states))
        layout = Layout(tape, order, steps, guards)
        places, outputs = layout.places, [layout.address(row) for row in tape.outputs]
        return {
            "image": [[at, _in_base64(content)] for at, content in layout.image().items()],
            "size": layout.size,
            "order": layout.order,
            "row": layout.row,
            "states": [layout.states.start, len(layout.states)],
            "parameters": [layout.parameters.start, len(layout.parameters)],
            "rates": outputs[: tape.states],
            "outputs": outputs[tape.states :],
            "fields": {
                **{name: DOUBLE_PLACES[name] for name in ("time", "rest", "goal", "longest")},
                "done": INTEGER_PLACES["done"],
            },
            "steps": layout.steps,
            "records": places["records"],
            "record": layout.record,
            "head": 8 * RECORD_HEAD,
            "guards": layout.guards,
            "falls": places["falls"],
        }


def kernel_code() -> str:
    """The module that all kernels run, in base64."""
    return _in_base64(kernel_binary())


def _in_base64(content: bytes) -> str:
    return b64encode(content).decode("ascii")


def page_kernels(run: Trajectory, formulas: Mapping[Symbol, Expr], loops: PageLoops) -> PageKernels:
    """The kernels for motions like one that has been followed.

    Args:
        run: the motion.
        formulas: parameters that follow from others.
        loops: its closed loops.

    Raises:
        DeclarationError: for a motion that a page cannot compute by itself, with the reason.
    """
    _refuse(run)
    system, first, schedule = run.system, run.segments[0], _schedule(run)
    if first.mode == AS_DECLARED or not isinstance(system, System) or not system.contacts:
        return PageKernels((_only(run, loops),), None, formulas, schedule)
    modes = automaton(system)
    begins = modes.mode(modes.named(first.mode))
    if len(modes.contacts) > 1:
        _refuse_slips(run, modes)
        return PageKernels((_page_mode(run, modes, begins),), None, formulas, schedule)
    (contact,) = system.contacts
    # a contact with friction never slides without
    is_rough = SLIDING in modes.options[0]
    options = [p for p in modes.options[0] if not is_rough or p.kind != FRICTIONLESS.kind]
    chosen = dict.fromkeys([begins.phases, *((phase,) for phase in options)])
    if contact.on.beyond is not None:
        chosen |= {(p.beyond(),): None for (p,) in chosen}
    found = []
    for phases in chosen:
        try:
            found.append(_page_mode(run, modes, modes.mode(phases)))
        except ConstraintError:  # what the contact holds, nothing else holds
            continue
    return PageKernels(tuple(found), contact, formulas, schedule)


@dataclass(frozen=True)
class PageLoops:
    """Closed loops, in the coordinates of the mode in which a motion starts.

    Attributes:
        gaps: expressions that are zero where the loops are closed.
        solved: coordinates that follow from the others.
        slopes: derivatives of the gaps by these, gap by gap.
    """

    gaps: tuple[Expr, ...]
    solved: tuple[Symbol, ...]
    slopes: tuple[Expr, ...]


def page_loops(run: Trajectory, given: Collection[str]) -> PageLoops:
    """The closed loops of a motion.

    Args:
        run: the motion.
        given: names of coordinates that are to be chosen, as far as the loops leave them free.
    """
    first, now = run.segments[0], np.zeros(1)
    dynamics, gaps, names = run.dynamics, run.equations.closures, run.equations.coordinates
    if not gaps:
        return PageLoops((), (), ())
    here = first.values([Expr.generator(q) for q in names], now)[:, 0]
    numbers = dict(zip(dynamics.parameters, first.parts[0].constants.tolist(), strict=True))
    places = dict(zip(names, here.tolist(), strict=True))
    solved = determined_by_loops(dynamics, places, numbers, given)
    return PageLoops(gaps, solved, tuple(gap.diff(q) for gap in gaps for q in solved))


def _refuse(run: Trajectory) -> None:
    """Refuse what the kernel has no program for."""
    dynamics = run.dynamics
    because = ""
    if dynamics.undecided or dynamics.sides:
        because = "an absolute value changes its side"
    if because:
        raise _impossible(run, because)


def _impossible(run: Trajectory, because: str) -> DeclarationError:
    return DeclarationError(
        f"a live page of {run.equations.system.name}, where {because}",
        expected="equations of motion that a page can follow by itself",
        advice="make a page that plays this motion: leave out live",
    )


def _refuse_slips(run: Trajectory, modes: Automaton) -> None:
    """Refuse several contacts of which one slides: how its slip ends is known for one alone."""
    auxiliary = run.dynamics.auxiliary
    if any(s in auxiliary for contact in modes.contacts for s in slip_symbols(contact)):
        raise _impossible(run, "one of several contacts slides against friction")


def _schedule(run: Trajectory) -> Schedule:
    """The coefficients of prescribed motions along a motion, which is followed piece by piece."""
    parameters = run.dynamics.parameters
    places = [i for i, s in enumerate(parameters) if s.published not in run.parameters]
    if not places:
        return Schedule()
    jerks = {event.time for event in run.events if event.kind == "jerk"}
    times, values, jumps = list[float](), list[tuple[float, ...]](), list[bool]()
    for segment in run.segments:
        # every mode has the same parameters, in an order of its own
        order = [segment.dynamics.parameters.index(parameters[i]) for i in places]
        for part in segment.parts:
            row = tuple(float(part.constants[i]) for i in order)
            if not values or row != values[-1]:
                times.append(float(part.begin))
                values.append(row)
                jumps.append(part.begin in jerks)
    symbols = tuple(parameters[i] for i in places)
    return Schedule(symbols, tuple(times), tuple(values), tuple(jumps))


def _only(run: Trajectory, loops: PageLoops) -> PageMode:
    """The mode of equations that have no other."""
    dynamics = _on_chosen_rates(run.dynamics, loops)
    equations = dynamics.equations
    assert isinstance(equations, Equations)
    if WORK not in dynamics.auxiliary:
        dynamics = replace(dynamics, auxiliary={**dynamics.auxiliary, WORK: equations.power})
    sides = (Watched("goes flat", True, s - NEAR_FLAT) for s in equations.assumed_positive)
    forces = (Watched(f"{c} lifts off", True, force) for c, force in normal_forces(equations))
    watched = (*sides, *forces, *_one_sided(equations))
    joined = {"begin": (Expr.of(0),) * len(dynamics.auxiliary), "masses": _masses(equations)}
    joined["watched"] = tuple(one.positive for one in watched)
    return PageMode(AS_DECLARED, "", False, None, dynamics, watched, joined)


def _on_chosen_rates(dynamics: Dynamics, loops: PageLoops) -> Dynamics:
    """The equations on the rates of the coordinates that are chosen, where loops are closed.

    A page does not go over to other independent speeds on the way. The crank of an engine turns on
    where the rate of its connecting rod is zero.
    """
    equations = dynamics.equations
    free = (q for q in equations.coordinates if q not in loops.solved)
    rates = tuple(q.derivative() for q in free)
    known = {*equations.speeds, *equations.dependent}
    differ = set(rates) != set(equations.speeds)
    if loops.solved and differ and len(rates) == len(equations.speeds) and known >= set(rates):
        return SpeedChoices(dynamics).on(rates)
    return dynamics


def _one_sided(equations: Equations) -> Iterator[Watched]:
    """Ropes and joints that only push or only pull, with forces that are determined."""
    for element in equations.system.elements:
        if isinstance(element, Rope):
            (tension,) = (r.name for r in equations.kinetics.restraints[element.name])
            if tension in equations.components:
                yield Watched(f"{element.name} goes slack", True, equations.components[tension])
        elif not isinstance(element, Contact) and element.push in equations.components:
            yield Watched(f"{element.name} pulls", True, equations.components[element.push])


def _page_mode(run: Trajectory, modes: Automaton, mode: Mode) -> PageMode:
    first = run.segments[0]
    constants = dict.fromkeys(first.dynamics.parameters, 0.0)
    dynamics = dynamics_of(modes, mode, first.dynamics.prescribed, constants)
    watched = []
    for guard in mode.guards:
        if guard.kind == "falls flat" and first.values([guard.positive], np.zeros(1))[0, 0] <= 0:
            continue  # the centre of mass of a body on a post, which the plane stands for
        several = len(modes.contacts) > 1
        name = f"{guard.contact.name} " if guard.contact is not None and several else ""
        kind = name + (guard.ends or guard.kind)
        watched.append(Watched(kind, bool(guard.ends), _vanishing(guard, dynamics)))
    watched += _one_sided(mode.equations)
    phase, touched = mode.phases[0], mode.touches[0].contact
    known = dict(_begins(mode))
    begin = tuple(known.get(s, Expr.of(0)) for s in dynamics.auxiliary)
    joined = {"begin": begin, "masses": _masses(mode.equations)}
    if len(modes.contacts) == 1:
        joined |= _transition(modes, mode)
    return PageMode(
        mode.name,
        phase.kind,
        phase.is_beyond,
        touched if len(modes.contacts) == 1 and isinstance(touched, Contact) else None,
        dynamics,
        tuple(watched),
        joined,
    )


def _vanishing(guard: Guard, dynamics: Dynamics) -> Expr:
    """The expression whose zero ends a mode; a slip, which has no sign, ends at a least size."""
    if guard.kind != "sticks" or guard.contact is None:
        return vanishing_expression(guard, NEAR_FLAT)
    slips = [Expr.generator(s) for s in slip_symbols(guard.contact) if s in dynamics.auxiliary]
    squares = sum((s * s for s in slips), start=Expr.of(0)) if slips else guard.positive
    return squares - Expr.generator(_LEAST)


def _begins(mode: Mode) -> Iterator[tuple[Symbol, Expr]]:
    """Slips, heights and distances to edges in terms of coordinates and speeds."""
    for touch in mode.touches:
        yield gap_symbol(touch.contact), touch.gap
        yield edge_distance_symbol(touch.contact), touch.edge_distance
        yield from zip(slip_symbols(touch.contact), touch.slip, strict=True)


def _transition(modes: Automaton, mode: Mode) -> Joined:
    """Expressions by which modes follow each other, of a system with one contact.

    Shared coordinates and speeds are those of the mode in which nothing touches.

    shared: coordinates and speeds, from the state of this mode.
    rest, columns: shared speeds = rest + columns · speeds, columns row by row.
    forces: along two tangents and the normal, of a closed contact.
    slip rates: of a contact that slides, m/s².
    kinematics: of that mode, as `Touching` uses them.
    closing: normal acceleration of that mode, m/s².
    """
    separated, (phase,) = modes.separated, mode.phases
    rest, columns = projection_of(mode, separated)
    found = {
        "shared": tuple(shared_state_of(mode, separated)),
        "rest": tuple(rest),
        "columns": tuple(columns),
    }
    if phase.flies:
        found["kinematics"] = tuple(kinematic_expressions(mode))
        found["closing"] = tuple(closing_rates_of(mode))
    else:
        found["forces"] = tuple(contact_forces_of(mode))
    if phase.slides:
        found["slip rates"] = slip_rates_of(mode)
    return found


def _masses(equations: Equations) -> tuple[Expr, ...]:
    """The mass matrix, row by row."""
    return tuple(equations.mass.entries)


def coefficients(contact: Contact) -> dict[str, Expr]:
    """Friction and restitution of a contact."""
    found = {"restitution": contact.restitution}
    if isinstance(contact, Coulomb):
        found |= {"mu": contact.mu, "mu_static": contact.mu_static}
    if isinstance(contact, Rolling) and contact.tangential is not None:
        found["tangential"] = contact.tangential
    return {name: Expr.of(value) for name, value in found.items()}


def auxiliary_places(mode: PageMode) -> dict[str, Any]:
    """Which states are velocities of slip against friction, the height, and the edge distance."""
    contact = mode.contact
    if contact is None:
        return {"slips": [], "gap": -1, "edge": -1}
    places = {symbol: i for i, symbol in enumerate(mode.dynamics.states)}
    return {
        "slips": [places[s] for s in slip_symbols(contact) if s in places],
        "gap": places.get(gap_symbol(contact), -1),
        "edge": places.get(edge_distance_symbol(contact), -1),
    }


def onset_collocation() -> dict[str, Any]:
    """Radau's points with 0 in front, and what collocation and interpolation on them need."""
    gaps = POINTS[:, None] - POINTS[None, :] + np.eye(len(POINTS))
    return {
        "points": POINTS.tolist(),
        "slopes": SLOPES.tolist(),
        "series": TO_SERIES.tolist(),
        "weights": (1 / np.prod(gaps, axis=1)).tolist(),
    }
