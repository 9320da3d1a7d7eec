"""Changing units, or the sense of time, changes nothing that should not change."""

from collections.abc import Iterator

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from catalogue.systems import numeric
from derive.states import draw
from polhode.algebra import Expr, Symbol, SymbolKind, variables
from polhode.base import LENGTH, MASS, TIME, Dimension
from polhode.catalogue import PROBLEM_SET
from polhode.derive import Equations

ENERGY = MASS * LENGTH**2 / TIME**2
FORCE = ENERGY / LENGTH

factors = st.floats(0.1, 10)


@pytest.mark.parametrize("name", PROBLEM_SET)
@settings(max_examples=8)
@given(mass=factors, length=factors, time=factors, seed=st.integers(0, 1000))
def test_units_may_be_any(name: str, mass: float, length: float, time: float, seed: int) -> None:
    """Numbers in other units make the same motion in those units."""
    system = numeric(name)

    def scale(dimension: Dimension) -> float:
        powers = zip((mass, length, time), dimension_powers(dimension), strict=True)
        product = 1.0
        for factor, power in powers:
            product *= factor**power
        return product

    inputs = dict(input_dimensions(system.equations))
    state = draw(" ".join(inputs), seed)
    scaled = {n: value * scale(inputs[n]) for n, value in state.items()}
    before, after = system.at(**state), system.at(**scaled)
    for output, dimension in output_dimensions(system.equations).items():
        unit = scale(dimension)
        assert after[output] == pytest.approx(before[output] * unit, rel=1e-11, abs=1e-10 * unit)


def dimension_powers(dimension: Dimension) -> tuple[float, float, float]:
    return float(dimension.mass), float(dimension.length), float(dimension.time)


def input_dimensions(equations: Equations) -> Iterator[tuple[str, Dimension]]:
    """Values of everything that the equations leave open, by name."""
    used = variables((*equations.rows, *equations.kinematics.values(), equations.energy))
    used |= variables((*equations.least.values(), equations.power))
    states = {*equations.coordinates, *equations.speeds}
    parameters = {s for s in used if s.kind in (SymbolKind.PARAMETER, SymbolKind.FUNCTION)}
    for symbol in sorted(states | parameters - {Symbol("pi")}, key=lambda s: s.published):
        yield symbol.published, equations.dimensions[symbol.base()] / TIME**symbol.order


def output_dimensions(equations: Equations) -> dict[str, Dimension]:
    """Accelerations, reactions and energies, by name."""
    rates = {
        s.published: equations.dimensions[s.base()] / TIME**s.order
        for s in equations.acceleration_symbols
    }
    forces = {line.name: ENERGY if line.restraint.is_couple else FORCE for line in equations.lines}
    power = ENERGY / TIME
    return rates | forces | {"T": ENERGY, "V": ENERGY, "T_dot": power, "power": power}


@pytest.mark.parametrize("name", PROBLEM_SET)
def test_time_may_run_backwards(name: str) -> None:
    """With all velocities turned round, those of the supports too, accelerations are the same."""
    equations = numeric(name).equations
    for expression in (*equations.rows, *equations.least.values(), equations.energy):
        assert expression.subs(reversal(expression)) == expression
    assert equations.power.subs(reversal(equations.power)) == -equations.power


def reversal(expression: Expr) -> dict[Symbol, Expr]:
    """Every velocity turned round; an acceleration is a velocity's rate, and stays."""
    return {s: -Expr.generator(s) for s in expression.symbols() if is_velocity(s)}


def is_velocity(symbol: Symbol) -> bool:
    if symbol.kind is SymbolKind.PARAMETER:
        return symbol.name in ("Omega", "omega_0")
    return symbol.order + (symbol.kind is SymbolKind.SPEED) == 1
