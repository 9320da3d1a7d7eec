"""The kernels of a live page: one that integrates a contact mode, one that computes what is shown.

A page follows a motion in the contact mode that it starts in, up to the first guard that falls. The
two have the same states and parameters. What is shown is kept out of the first, whose steps would
otherwise compute the Taylor series of all of it.
"""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from polhode.algebra import Expr, Symbol, SymbolKind
from polhode.base import DeclarationError
from polhode.derive import Equations, Guard, Mode, automaton
from polhode.model import System
from polhode.simulate._dynamics import CLOCK, WORK, Dynamics
from polhode.simulate._export_kernel import normal_forces
from polhode.simulate._simulate import NEAR_FLAT
from polhode.simulate._task import AS_DECLARED
from polhode.simulate._trajectory import Trajectory
from polhode.simulate.contact._auxiliary_states import (
    edge_distance_symbol,
    gap_symbol,
    slip_symbols,
)
from polhode.simulate.integrate._flow import degree_in
from polhode.simulate.integrate._stepping import fewest_for
from polhode.simulate.kernel._layout import (
    DOUBLE_PLACES,
    INTEGER_PLACES,
    RECORD_HEAD,
    Layout,
    order_of,
)
from polhode.simulate.kernel._steps import kernel_file
from polhode.simulate.kernel._tape import tape_of

_STEPS = 256  # that one call takes
_LEAST = Symbol("least slip squared", SymbolKind.PARAMETER)


@dataclass(frozen=True)
class Watched:
    """An expression that is positive for as long as a motion stays in its contact mode.

    Attributes:
        kind: lifts off, slips, and so on, as events are called.
        contact: name of the contact; empty for a limit of the equations.
        positive: the expression.
    """

    kind: str
    contact: str
    positive: Expr


@dataclass(frozen=True)
class PageKernels:
    """The first contact mode of a motion as a page computes it.

    Attributes:
        dynamics: its equations.
        watched: what ends it.
        begin: values at the start of the auxiliary states, from coordinates and speeds.
        sliding: velocities of slip against friction.
        formulas: parameters that follow from others.
    """

    dynamics: Dynamics
    watched: tuple[Watched, ...]
    begin: tuple[Expr, ...]
    sliding: frozenset[Symbol]
    formulas: Mapping[Symbol, Expr]

    @property
    def states(self) -> tuple[Symbol, ...]:
        """Coordinates, speeds, and what is integrated besides."""
        return self.dynamics.states

    @cached_property
    def parameters(self) -> tuple[Symbol, ...]:
        """Those that have values of their own; the last bounds slips from below, (m/s)²."""
        own = [s for s in self.dynamics.parameters if s not in self.formulas]
        needed = [s for value in self.formulas.values() for s in value.symbols()]
        free = (s for s in (*own, *needed) if s not in self.formulas and s.name != "pi")
        return (*dict.fromkeys(free), _LEAST)

    @cached_property
    def integrator(self) -> Layout:
        """Of the kernel that integrates."""
        guards = [watched.positive for watched in self.watched]
        order = order_of(float(np.finfo(float).eps))
        return self._layout(guards, order, _STEPS, len(guards))

    @cached_property
    def fewest(self) -> int:
        """The least number of steps for a motion, without which one may be infinite."""
        program = self._computing.program(self.dynamics.rates, self._arguments)
        return fewest_for(degree_in(program, CLOCK))

    def viewer(self, wanted: Sequence[Expr]) -> Layout:
        """Of the kernel that computes expressions at a state."""
        return self._layout(wanted, 2, 1, 0)

    def _layout(self, wanted: Iterable[Expr], order: int, steps: int, guards: int) -> Layout:
        expressions = (*self.dynamics.rates, *wanted)
        program = self._computing.program(expressions, self._arguments)
        return Layout(tape_of(program, len(self.states)), order, steps, guards)

    @property
    def work(self) -> int:
        """Which state is the work done."""
        return self.states.index(WORK)

    @cached_property
    def slips(self) -> list[int]:
        """Which states are velocities of slip against friction."""
        return [i for i, symbol in enumerate(self.states) if symbol in self.sliding]

    @staticmethod
    def hosted(layout: Layout) -> dict[str, Any]:
        """A kernel in base64, and where a host finds what in its memory, in bytes."""
        tape, places = layout.tape, layout.places
        return {
            "wasm": b64encode(kernel_file(layout, b"")).decode("ascii"),
            "order": layout.order,
            "row": layout.row,
            "states": [layout.states.start, len(layout.states)],
            "parameters": [layout.parameters.start, len(layout.parameters)],
            "outputs": [layout.address(row) for row in tape.outputs[tape.states :]],
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
            "weights": places["weights"],
        }

    @property
    def _arguments(self) -> tuple[Symbol, ...]:
        return (*self.states, *self.parameters, CLOCK)

    @cached_property
    def _computing(self) -> Dynamics:
        return replace(self.dynamics, meanings={**self.dynamics.meanings, **self.formulas})


def page_kernels(run: Trajectory, formulas: Mapping[Symbol, Expr]) -> PageKernels:
    """The kernels for the contact mode that a motion starts in.

    Args:
        run: the motion, whose first mode is taken.
        formulas: parameters that follow from others.

    Raises:
        DeclarationError: for a motion that a page cannot compute by itself, with the reason.
    """
    dynamics, equations = run.dynamics, run.equations
    assert isinstance(equations, Equations)
    _refuse(run)
    if WORK not in dynamics.auxiliary:
        dynamics = replace(dynamics, auxiliary={**dynamics.auxiliary, WORK: equations.power})
    mode = _mode_of(run)
    if mode is None:
        sides = (Watched("goes flat", "", s - NEAR_FLAT) for s in equations.assumed_positive)
        forces = normal_forces(equations)
        ends = [*sides, *(Watched("lifts off", contact, n) for contact, n in forces)]
        begins, slips = dict[Symbol, Expr](), set[Symbol]()
    else:
        start = run.segments[0].values
        ends = []
        for guard in mode.guards:
            watched = _watched(guard, dynamics)
            at_start = start([watched.positive], np.zeros(1))[0, 0] if not _is_slip(guard) else 1.0
            # the centre of mass of a body on a post, which the plane stands for, may be below it
            if guard.kind != "falls flat" or at_start > 0:
                ends.append(watched)
        begins = dict(_begins(mode))
        slips = {s for touch in mode.touches for s in slip_symbols(touch.contact)}
    zero = Expr.of(0)
    begin = tuple(begins.get(symbol, zero) for symbol in dynamics.auxiliary)
    sliding = frozenset(slips.intersection(dynamics.auxiliary))
    return PageKernels(dynamics, tuple(ends), begin, sliding, formulas)


def _refuse(run: Trajectory) -> None:
    """Refuse what the kernel has no program for."""
    dynamics = run.dynamics
    because = ""
    if run.equations.closures:
        because = "coordinates at the start have to close a loop"
    elif dynamics.undecided or dynamics.sides:
        because = f"{dynamics.undecided or tuple(dynamics.sides)} changes its side"
    elif any(s.published not in run.parameters for s in dynamics.parameters):
        because = "a prescribed motion is given by samples"
    if because:
        raise DeclarationError(
            f"a live page of {run.equations.system.name}, where {because}",
            expected="equations of motion that hold for every start",
            advice="make a page that plays this motion: leave out live",
        )


def _mode_of(run: Trajectory) -> Mode | None:
    """The contact mode that a motion starts in; None for equations of a single mode."""
    name = run.segments[0].mode
    if name == AS_DECLARED or not isinstance(run.system, System) or not run.system.contacts:
        return None
    modes = automaton(run.system)
    return modes.mode(modes.named(name))


def _is_slip(guard: Guard) -> bool:
    return guard.kind == "sticks"


def _watched(guard: Guard, dynamics: Dynamics) -> Watched:
    contact, positive = guard.contact, guard.positive
    name = contact.name if contact is not None else ""
    if contact is not None and guard.kind == "touches down":
        positive = Expr.generator(gap_symbol(contact))
    elif contact is not None and guard.kind == "crosses the edge":
        positive = Expr.generator(edge_distance_symbol(contact))
    elif contact is not None and _is_slip(guard):
        slips = [Expr.generator(s) for s in slip_symbols(contact) if s in dynamics.auxiliary]
        squares = [s * s for s in slips] or [positive]
        positive = sum(squares, start=Expr.of(0)) - Expr.generator(_LEAST)
    elif guard.ends_before:
        positive = positive - NEAR_FLAT
    return Watched(guard.ends or guard.kind, name, positive)


def _begins(mode: Mode) -> Iterator[tuple[Symbol, Expr]]:
    """Slips, heights and distances to edges in terms of coordinates and speeds."""
    for touch in mode.touches:
        yield gap_symbol(touch.contact), touch.gap
        yield edge_distance_symbol(touch.contact), touch.edge_distance
        yield from zip(slip_symbols(touch.contact), touch.slip, strict=True)
