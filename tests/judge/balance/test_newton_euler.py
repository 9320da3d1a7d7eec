"""The numeric balance of every body against the derived equations, on all catalogue systems."""

from __future__ import annotations

from random import Random

import pytest

import polhode as ph
from catalogue.systems import equations
from polhode.algebra import Symbol, as_symbol
from polhode.catalogue import PROBLEM_SET
from polhode.judge.balance._declared import declared, reaction_symbol
from polhode.judge.balance._newton_euler import constrained_motion, true_motion
from polhode.judge.states._numeric import number


def state_of(equations: ph.Equations, seed: int) -> dict[Symbol, float]:
    random = Random(seed)
    known = declared(equations.system)
    rates = [f.derivative() for f in known.functions]
    symbols = {*equations.coordinates, *equations.speeds, *known.parameters}
    symbols |= {*known.functions, *rates, *(r.derivative() for r in rates)}
    return {s: random.uniform(0.5, 1.5) for s in sorted(symbols, key=lambda s: s.published)}


@pytest.mark.parametrize("name", PROBLEM_SET)
def test_accelerations_and_least_reactions_agree_with_the_derived_ones(name):
    derived = equations(name)
    found = true_motion(derived.system, state_of(derived, 5))
    exact = {reaction_symbol(n): value for n, value in derived.least.items()}
    for symbol, value in {**derived.accelerations, **exact}.items():
        there = number(derived.on_shell(value), found)
        assert found[symbol] == pytest.approx(there, rel=1e-9, abs=1e-9)


def test_a_motion_may_have_any_acceleration_that_the_constraints_allow():
    derived = equations("rolling-disk")
    wanted = dict.fromkeys(derived.acceleration_symbols, 0.25)
    found = constrained_motion(derived.system, state_of(derived, 7), wanted)
    assert {s: found[s] for s in wanted} == pytest.approx(wanted)
    for speed, value in derived.dependent.items():
        rate = value.chain(derived.kinetics.rate)
        assert found[speed.derivative()] == pytest.approx(number(rate, found))


def test_a_redundant_support_may_be_known_to_supply_something():
    derived = equations("gyroscope/held")
    state = state_of(derived, 5)
    hand = reaction_symbol("Fprime_z")
    found = true_motion(derived.system, state | {hand: 0.25})
    assert found[hand] == pytest.approx(0.25)
    weight = state[Symbol("M")] * state[Symbol("g")]
    assert found[reaction_symbol("F_z")] == pytest.approx(weight - 0.25)
    assert found[reaction_symbol("F_rho")] == pytest.approx(-found[reaction_symbol("Fprime_rho")])


def test_a_bead_placed_by_a_coordinate_slides_freely_along_its_guide():
    """On the parabola z = c x²: (1 + 4c²x²) ẍ + 4c²xẋ² + 2gcx = 0, the force along its normal."""
    m, c, g = ph.symbols("m c g", positive=True)
    x, lab = ph.coordinate("x"), ph.Frame("lab")
    bead = ph.point_mass("bead", mass=m, axes=lab)
    guide = ph.Pivot(bead, to=lab.vector(x, 0, c * x**2))
    derived = ph.derive(ph.System(guide, ph.Gravity(g), name="guide"))
    state = state_of(derived, 3)
    found = true_motion(derived.system, state)
    here, bend, weight = (found[as_symbol(s)] for s in (x, c, g))
    speed, rate = (found[as_symbol(s)] for s in (x.dt(), x.dt().dt()))
    slope = 2 * bend * here
    assert rate == pytest.approx(-(2 * bend * speed**2 + weight) * slope / (1 + slope**2))
    across = slope * found[reaction_symbol("F_z")]
    assert found[reaction_symbol("F_x")] == pytest.approx(-across)
