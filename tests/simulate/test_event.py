"""Requested events: reactions that pass through zero."""

from math import acos, sqrt

import pytest

import polhode as ph

LAB = ph.Frame("lab")
NUMBERS = {"m": 0.3, "l": 0.8, "g": 9.81}


def bob_on_a_thread():
    m, l, g = ph.symbols("m l g", positive=True)
    axes = LAB.rotated(ph.coordinate("theta"), "y")
    thread = ph.Body("thread", mass=0, axes=axes, tag="t")
    bob = ph.point_mass("bob", mass=m, axes=axes, tag="b")
    parts = [
        ph.Pivot(thread, name="nail", force="P"),
        ph.Hinge(thread, axis="y"),
        ph.Pivot(bob, to=thread.point(axes["z"] * -l), along=axes, name="knot", force="S"),
    ]
    return ph.System(*parts, ph.Gravity(g))


@pytest.mark.parametrize("precision", [None, 25])
def test_a_thread_goes_slack(precision):
    """Started below with speed 2 √(g l), its tension m g (2 + 3 cos θ) vanishes at cos θ = −2/3."""
    start = {"theta_dot": 2 * sqrt(NUMBERS["g"] / NUMBERS["l"])}
    events = {"slack": ph.reaction("S_z_b")}
    run = ph.simulate(
        bob_on_a_thread(), NUMBERS, start, "1 s", events=events, precision=precision, samples=2
    )
    (slack,) = (event.time for event in run.events if event.kind == "slack")
    assert float(run.evaluate("theta", slack)) == pytest.approx(acos(-2 / 3), abs=1e-13)


def test_a_reaction_in_an_expression_and_an_unknown_one():
    """The thread bears its bob's weight alone where cos θ = −1/3."""
    start = {"theta_dot": 2 * sqrt(NUMBERS["g"] / NUMBERS["l"])}
    m, g = ph.symbols("m g", positive=True)
    events = {"weight": ph.reaction("S_z_b") - m * g}
    run = ph.simulate(bob_on_a_thread(), NUMBERS, start, "0.6 s", events=events)
    (time,) = (event.time for event in run.events if event.kind == "weight")
    assert run.evaluate("theta", time) == pytest.approx(acos(-1 / 3), abs=1e-13)
    with pytest.raises(ph.DeclarationError, match=r"'S_z' is no reaction .* did you mean S_z_b"):
        ph.simulate(bob_on_a_thread(), NUMBERS, start, "1 s", events={"slack": ph.reaction("S_z")})


def test_the_reaction_of_an_open_contact_is_known():
    m, r, g = ph.symbols("m r g", positive=True)
    ball = ph.sphere("ball", mass=m, radius=r, axes=LAB)
    contact = ph.Coulomb(ball, on=ph.Plane(LAB), mu=0.3, restitution=0.5)
    numbers = {"m": 1, "r": 0.1, "g": 9.81}
    run = ph.simulate(
        ph.System(contact, ph.Gravity(g)),
        numbers,
        {"z": 0.3, "v_x": 1},
        "0.3 s",
        events={"half": ph.reaction("F_z") - m * g / 2},
    )
    assert [event.kind for event in run.events][-1] == "end"
