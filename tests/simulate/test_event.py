"""Requested events: zeros of expressions, with the reactions of the mode the motion is in."""

from math import acos, sqrt

import numpy as np
import pytest

import polhode as ph
from polhode.base import NumericError
from polhode.catalogue import CATALOGUE

LAB = ph.Frame("lab")
NUMBERS = {"m": 0.3, "l": 0.8, "g": 9.81}
DISK = {"m": 0.2, "a": 0.03, "g": 9.81}
START = {"theta": 1.4, "phi_dot": 1.0, "omega_3": 40.0}


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


def test_a_reaction_is_zero_at_its_event():
    m, g = ph.symbols("m g", positive=True)
    system = CATALOGUE["rolling-disk"].build()
    weight = {"F_z = m g": ph.reaction("F_z") - m * g}
    run = ph.simulate(system, DISK, START, 0.5, events=weight)
    times = np.array([e.time for e in run.events if e.kind == "F_z = m g"])
    assert len(times) >= 8
    np.testing.assert_allclose(run.evaluate("F_z", times), 0.2 * 9.81, rtol=1e-12)
    signs = np.sign(run["F_z"] - 0.2 * 9.81)
    assert np.count_nonzero(np.diff(signs)) == len(times)


def test_it_is_that_of_the_mode_the_motion_is_in():
    """A ball slides, then rolls: friction along x is μmg throughout, then zero."""
    m, r, g = ph.symbols("m r g", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=r, axes=lab)
    contact = ph.Coulomb(ball, on=ph.Plane(lab), mu=0.1, name="table")
    system = ph.System(contact, ph.Gravity(g), name="bowling")
    half = {"half": ph.reaction("F_x") + m * g / 20, "x": ph.reaction("F_x") + m * g}
    numbers = {"m": 1.0, "r": 0.1, "g": 10.0}
    run = ph.simulate(system, numbers, {"v_x": 2.0, "omega_y": 0.0}, 1.0, events=half)
    assert [e.kind for e in run.events] == ["start", "sticks", "end"]  # it jumps, never crossing


def test_an_undetermined_reaction_is_refused():
    system = CATALOGUE["gyroscope/held"].build()
    numbers = {"M": 0.5, "a": 0.06, "I_1": 6e-4, "I_2": 3e-4, "g": 9.81}
    start = {"theta": 1.0, "omega_1": 100.0}
    with pytest.raises(NumericError, match="F_rho, which Newton's laws do not determine"):
        ph.simulate(system, numbers, start, 0.1, events={"F": ph.reaction("F_rho")})


# -- zero at the start, and at changes of contact --------------------------------------------------

Z, V_Z = ph.coordinate("z"), ph.speed("v_z")


def thrown():
    m, g = ph.symbols("m g", positive=True)
    stone = ph.point_mass("stone", mass=m, axes=LAB)
    return ph.System(ph.Pivot(stone, only="x y"), ph.Gravity(g))


def times_of(run, kind):
    return [float(event.time) for event in run.events if event.kind == kind]


@pytest.mark.parametrize("precision", [None, "quadruple"])
@pytest.mark.parametrize("place", [0.0, 0.1, -1.7, 1e6])
def test_what_is_zero_at_the_start_has_its_event_when_it_passes_through_zero(place, precision):
    """Thrown upwards with v it is back after 2 v/g; 0.3 m higher it is twice, at v/g ± √…"""
    v, g = 5.0, 9.81
    events = {"back": Z - place, "higher": Z - (place + 0.3), "turns": V_Z}
    run = ph.simulate(
        thrown(),
        {"m": 1, "g": g},
        {"z": place, "v_z": v},
        1.5,
        events=events,
        precision=precision,
    )
    error = 1e-13 + 1e-15 * abs(place)
    root = sqrt(v * v - 2 * g * 0.3)
    assert times_of(run, "back") == pytest.approx([2 * v / g], abs=error)
    assert times_of(run, "higher") == pytest.approx([(v - root) / g, (v + root) / g], abs=error)
    assert times_of(run, "turns") == pytest.approx([v / g], abs=1e-13)


@pytest.mark.parametrize("rise", [0.0, -1.0])
def test_what_leaves_zero_for_good_has_no_event(rise):
    run = ph.simulate(thrown(), {"m": 1, "g": 9.81}, {"v_z": rise}, 2.0, events={"z": Z, "v": V_Z})
    assert [event.kind for event in run.events] == ["start", "end"]


def test_a_quantity_that_stays_zero_has_none():
    """A ball rolls straight ahead: its sideways speed and its slip are rounding."""
    m, r, g = ph.symbols("m r g", positive=True)
    ball = ph.sphere("ball", mass=m, radius=r, axes=LAB)
    system = ph.System(ph.Coulomb(ball, on=ph.Plane(LAB), mu=0.3), ph.Gravity(g))
    slip = ph.speed("v_x") - r * ph.speed("omega_y")
    events = {"sideways": ph.speed("v_y"), "slip": slip}
    start = {"v_x": 2.0, "omega_y": 0.0}
    run = ph.simulate(system, {"m": 1, "r": 0.1, "g": 9.81}, start, 2.0, events=events)
    assert times_of(run, "sideways") == []
    assert times_of(run, "slip") == pytest.approx(times_of(run, "sticks"), abs=1e-15)


@pytest.mark.parametrize("restitution", [0.0, 0.5])
def test_a_height_is_zero_once_at_every_landing(restitution):
    m, r, g = ph.symbols("m r g", positive=True)
    ball = ph.sphere("ball", mass=m, radius=r, axes=LAB)
    contact = ph.Coulomb(ball, on=ph.Plane(LAB), mu=0.3, restitution=restitution)
    run = ph.simulate(
        ph.System(contact, ph.Gravity(g)),
        {"m": 1, "r": 0.1, "g": 9.81},
        {"z": 0.5, "v_x": 1},
        "0.8 s",
        events={"lands": Z - r},
    )
    landed = [e.time for e in run.events if e.kind in ("bounces", "touches down")]
    assert times_of(run, "lands") == pytest.approx(landed, abs=1e-15)
    assert len(landed) == (1 if restitution == 0 else 4)
    assert run.evaluate(Z - r, landed[0]) == pytest.approx(0, abs=1e-15)


def test_members_of_an_ensemble_end_at_events_of_their_own():
    found = ph.ensemble(
        thrown(),
        {"m": 1, "g": 9.81},
        {"z": 0.0, "v_z": [5.0, 6.0, -1.0]},
        2.0,
        outputs={"end": ph.Duration(), "t": ph.EventTime("lands"), "v": ph.Final("v_z")},
        events={"lands": Z},
        until=("lands",),
    )
    flights = [10 / 9.81, 12 / 9.81]
    assert list(found["end"]) == pytest.approx([*flights, 2.0], abs=1e-13)
    assert list(found["t"][:2]) == pytest.approx(flights, abs=1e-13)
    assert np.isnan(found["t"][2])
    assert list(found["v"]) == pytest.approx([-5.0, -6.0, -1 - 2 * 9.81], abs=1e-12)


def test_members_end_where_a_reaction_vanishes():
    """A bead on a dome leaves it at an angle that energy gives."""
    m, a, g = ph.symbols("m a g", positive=True)
    axes = LAB.rotated(ph.coordinate("theta"), "y")
    bead = ph.point_mass("bead", mass=m, axes=axes)
    system = ph.System(ph.Pivot(bead, to=axes["z"] * a, along=axes, force="N"), ph.Gravity(g))
    run = ph.ensemble(
        system,
        {"m": 1, "a": 1, "g": 9.81},
        {"theta": 0.1, "theta_dot": [0.0, 0.1, 0.2]},
        3.0,
        outputs={"theta": ph.Final("theta")},
        events={"off": ph.reaction("N_z")},
        until="off",
    )
    for rate, angle in zip([0.0, 0.1, 0.2], run["theta"], strict=True):
        # 3 cos θ = 2 cos θ₀ + a θ̇₀²/g, where the normal force vanishes
        assert 3 * np.cos(angle) == pytest.approx(2 * np.cos(0.1) + rate**2 / 9.81, abs=1e-12)
