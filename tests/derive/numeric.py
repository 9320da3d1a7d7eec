"""Equations evaluated at numbers, by nothing but floating-point linear algebra."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from polhode.algebra import Expr, Symbol, compile_program
from polhode.derive import Equations


def values(expressions: Sequence[Expr], numbers: Mapping[Symbol, float]) -> np.ndarray:
    """The expressions at given values of their symbols."""
    symbols = [s for s in numbers if any(s in e.symbols() for e in expressions)]
    program = compile_program(list(expressions), symbols).function()
    return np.array(program(*(numbers[s] for s in symbols)), dtype=float)


def state_of(equations: Equations, numbers: Mapping[str, float]) -> dict[Symbol, float]:
    """Symbols of the equations that have a number of their published name."""
    functions = [
        rate
        for f in equations.functions
        for rate in (f, f.derivative(), f.derivative().derivative())
    ]
    known = (*equations.coordinates, *equations.speeds, *equations.parameters, *functions)
    return {s: numbers[s.published] for s in known if s.published in numbers}


def motion_at(equations: Equations, numbers: Mapping[str, float]) -> dict[str, float]:
    """Accelerations and reaction components by published name."""
    state = state_of(equations, numbers)
    size = len(equations.speeds)
    entries = [e for row in equations.mass.rows for e in row]
    mass = values(entries, state).reshape(size, size)
    rates = np.linalg.solve(mass, values(equations.forcing, state))
    accelerations = dict(zip(equations.acceleration_symbols, rates, strict=True))
    components = equations.least
    forces = values(list(components.values()), {**state, **accelerations})
    named = {s.published: value for s, value in accelerations.items()}
    return named | dict(zip(components, forces, strict=True))


def agree(found: Mapping[str, float], expected: Mapping[str, float], names: str) -> None:
    """Assert that named values agree to rounding."""
    scale = max(1.0, *(abs(expected[name]) for name in names.split()))
    for name in names.split():
        assert abs(found[name] - expected[name]) <= 1e-12 * scale, name
