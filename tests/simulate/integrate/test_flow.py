from math import pi

import pytest

from polhode.algebra import as_symbol, compile_program, coordinates, cos, sin
from polhode.simulate import Dynamics
from polhode.simulate._dynamics import WORK
from polhode.simulate.integrate._flow import flow_of, period_in
from simulate.examples import four_bar, oscillator, pendulum, wheel

(U,) = coordinates("u")


def names(symbols):
    return {symbol.published for symbol in symbols}


def test_only_what_drives_itself_is_in_the_core():
    flow = flow_of(Dynamics(wheel(), {}), reduced=True)
    assert names(flow.core.symbols) == {"Omega"}
    assert [names(stage.symbols) for stage in flow.stages] == [{"phi", "u"}, {"x", "y", "psi"}]
    assert set(flow.states) == set(Dynamics(wheel(), {}).states)


def test_without_reduction_everything_is_in_the_core():
    flow = flow_of(Dynamics(wheel(), {}), reduced=False)
    assert len(flow.core.symbols) == 6
    assert flow.stages == ()


def test_work_is_integrated_where_there_is_any():
    (end,) = oscillator().functions
    driven = Dynamics(oscillator(), {end: U * 0 + 1})
    assert WORK in flow_of(driven, reduced=True).states
    assert WORK not in flow_of(Dynamics(pendulum(), {}), reduced=True).states


def test_angles_are_distinguished_from_positions():
    flow = flow_of(Dynamics(pendulum(), {}), reduced=True)
    periods = {s.published: p for s, p in zip(flow.core.symbols, flow.periods, strict=True)}
    assert periods == {"theta": 2 * pi, "theta_dot": None}
    crank = flow_of(Dynamics(four_bar(), {}), reduced=False)
    assert all(
        p == 2 * pi for s, p in zip(crank.core.symbols, crank.periods, strict=True) if not s.order
    )


@pytest.mark.parametrize(
    ("expression", "period"),
    [
        (sin(U) + cos(2 * U), 2 * pi),
        (sin(U / 2) * sin(U / 3), 12 * pi),
        (sin(U) + U, None),
        (U, None),
        (sin(U * U), None),
    ],
)
def test_the_period_of_an_angle(expression, period):
    program = compile_program([expression], [as_symbol(U)])
    assert period_in(program, 0) == (pytest.approx(period) if period else None)
