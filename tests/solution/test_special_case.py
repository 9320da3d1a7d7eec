"""Values put in for parameters of the loads, compared with a system declared with them."""

import pytest

import polhode as ph
from polhode.base import DeclarationError
from polhode.catalogue import PROBLEM_SET
from polhode.solution import special_case


def swing(*loads):
    m, l, I = ph.symbols("m l I", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "x", labels="1 2 3", name="axes")
    bar = ph.Body("bar", mass=m, inertia=(I, I, I), axes=axes)
    return ph.System(ph.Pivot(bar, at=axes["3"] * l), *loads, name="bar")


def test_gravity_of_zero_is_no_gravity():
    g = ph.symbol("g", positive=True)
    special = special_case(ph.derive(swing(ph.Gravity(g))), {g.symbol: g * 0})
    assert special.motion == ph.derive(swing()).motion
    assert not special.system.loads


def test_other_values_stay():
    """g = 2 k/m beside a torsion spring k: both loads, against a declaration with the value."""
    g, k, m = ph.symbols("g k m", positive=True)
    theta = ph.coordinate("theta")

    def loaded(value):
        bar = swing().bodies[0]
        return swing(ph.Gravity(value), ph.TorsionSpring(theta, stiffness=k, on=bar))

    special = special_case(ph.derive(loaded(g)), {g.symbol: 2 * k / m})
    assert special.motion == ph.derive(loaded(2 * k / m)).motion


@pytest.mark.parametrize("name", ["theta", "M"])
def test_what_the_loads_do_not_own_is_refused(name):
    equations = ph.derive(PROBLEM_SET["gyroscope"].build())
    known = {s.published: s for s in (*equations.parameters, *equations.coordinates)}
    with pytest.raises(DeclarationError, match=f"at a value of {name}.*ask steady"):
        special_case(equations, {known[name]: ph.symbol("a")})
