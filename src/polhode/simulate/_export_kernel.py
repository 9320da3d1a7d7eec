"""Equations as a WebAssembly module that integrates them, with a description of its memory."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from polhode.algebra import Expr, Symbol
from polhode.base import DeclarationError, provenance
from polhode.derive import Equations
from polhode.model import Contact
from polhode.simulate._dynamics import CLOCK, Dynamics
from polhode.simulate._names import Name
from polhode.simulate._start import read_start
from polhode.simulate._units import unit_in
from polhode.simulate._values import given_values, idle_parameters, read_parameters
from polhode.simulate.forcing._prescribed_motion import prescribed_motion
from polhode.simulate.integrate._flow import degree_in
from polhode.simulate.integrate._stepping import fewest_for
from polhode.simulate.kernel._layout import DOUBLE_PLACES, INTEGER_PLACES, Layout, order_of
from polhode.simulate.kernel._steps import Status, kernel_file
from polhode.simulate.kernel._tape import tape_of

_STEPS = 64  # that one call may take
_NAMED = ("time", "rest", "goal", "longest")  # fields that a host reads and writes, s
_COUNTED = ("done", "guards")


@dataclass(frozen=True)
class ExportedKernel:
    """One system as the kernel reads it.

    Attributes:
        layout: of the memory.
        description: of the same for hosts, as JSON.
    """

    layout: Layout
    description: Mapping[str, Any]

    @property
    def binary(self) -> bytes:
        """The module, with the description in its section "polhode"."""
        return kernel_file(self.layout, json.dumps(self.description).encode())


def exported_kernel(
    equations: Equations,
    parameters: Mapping[Name, Any],
    start: Mapping[Name, Any],
    forcing: Mapping[Name, Any],
) -> ExportedKernel:
    """The kernel of one contact mode.

    Args:
        parameters: values, as for `simulate`; none, or all.
        start: start values, as for `simulate`; they need those of the parameters.
        forcing: an expression of time for every prescribed function.

    Raises:
        DeclarationError: for prescribed functions that are no expressions, and as `simulate`.
        ConstraintError, NumericError, UnitError: as `simulate`.
    """
    drive = prescribed_motion(equations.functions, forcing, 0.0)
    if drive.pieces:
        raise DeclarationError(
            f"samples or a Python function for {next(iter(drive.pieces)).published}",
            expected="an expression of time for every prescribed function, to export a kernel",
            advice="write it as a formula of polhode.time",
        )
    given, begun = given_values(parameters), given_values(start)
    dynamics = Dynamics(equations, drive.expressions, idle_parameters(equations, given))
    numbers = read_parameters(dynamics, given) if given else {}
    if begun and not given:
        raise DeclarationError(
            "start values without values of the parameters",
            expected="both, or neither",
            advice="give the parameters as well",
        )
    states = read_start(dynamics, begun, numbers).state.tolist() if given else []
    guards, quantities = dict(normal_forces(equations)), _quantities(equations)
    wanted = (*dynamics.rates, *guards.values(), *quantities.values())
    program = dynamics.program(wanted, dynamics.arguments)
    tape = tape_of(program, len(dynamics.states))
    layout = Layout(tape, order_of(float(np.finfo(float).eps)), _STEPS, len(guards))
    values = [numbers[symbol] for symbol in dynamics.parameters] if given else []
    outputs = [layout.address(row) for row in tape.outputs[tape.states + len(guards) :]]
    description = {
        "format": "polhode kernel",
        **provenance(),
        "system": equations.system.name,
        "mode": "as declared",
        "states": _described(equations, dynamics.states, layout.states, "start", states),
        "parameters": _described(
            equations, dynamics.parameters, layout.parameters, "value", values
        ),
        "guards": list(guards),
        "quantities": [
            {"name": name, "unit": _unit(equations, name, meaning), "address": address}
            for (name, meaning), address in zip(quantities.items(), outputs, strict=True)
        ],
        **_memory(layout),
        "steps": {"most": layout.steps, "fewest": fewest_for(degree_in(program, CLOCK))},
        "status": {s.name.lower(): s.value for s in Status if s is not Status.STOPPED},
    }
    return ExportedKernel(layout, description)


def _memory(layout: Layout) -> dict[str, Any]:
    """Addresses, in bytes, of what a host reads and writes besides states and parameters."""
    return {
        "fields": {
            **{name: DOUBLE_PLACES[name] for name in _NAMED},
            **{name: INTEGER_PLACES[name] for name in _COUNTED},
        },
        "order": layout.order,
        "records": {"address": layout.places["records"], "bytes": layout.record},
        "falls": layout.places["falls"],
    }


def _quantities(equations: Equations) -> dict[str, Expr]:
    """What a module computes on demand: energy, reactions and dependent speeds."""
    return {
        "energy": equations.energy,
        **equations.components,
        # those that Newton's laws leave open by the choice of smallest forces
        **equations.least,
        **{symbol.published: meaning for symbol, meaning in equations.dependent.items()},
    }


def normal_forces(equations: Equations) -> Iterator[tuple[str, Expr]]:
    """Forces of contacts that may only push."""
    for contact in getattr(equations.system, "elements", ()):
        if isinstance(contact, Contact):
            normal = f"{contact.force}_{contact.on.normal}{contact.body.tag}"
            if normal in equations.components:
                yield normal, equations.components[normal]


def _described(
    equations: Equations,
    symbols: tuple[Symbol, ...],
    addresses: range,
    what: str,
    values: list[float],
) -> list[dict[str, Any]]:
    return [
        {
            "name": symbol.published,
            "unit": unit_in(equations, Expr.generator(symbol)),
            "address": address,
            what: values[i] if values else None,
        }
        for i, (symbol, address) in enumerate(zip(symbols, addresses, strict=True))
    ]


def _unit(equations: Equations, name: str, meaning: Expr) -> str:
    if name in equations.couples:
        return "N m"
    if name in equations.components or name in equations.least:
        return "N"
    return unit_in(equations, meaning)
