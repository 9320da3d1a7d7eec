"""A ball that rolls on a floor into a wall: an impact beside a contact that does not feel it."""

import numpy as np
import pytest

import polhode as ph

MU, E, G, R = 0.3, 0.5, 9.81, 0.1
lab = ph.Frame("lab")
m, g, a, mu, nu, e = ph.symbols("m g a mu nu e", positive=True)
ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
floor, wall = ph.Plane(lab), ph.Plane(lab, normal="x")
ground = ph.Coulomb(ball, on=floor, mu=mu, name="floor")
VALUES = {m: 1, g: G, a: R}
START = {"x": 0.5, "v_x": -1, "v_y": 0.4, "omega_y": -10, "omega_x": -4}


def _run(*contacts: object, **more: float) -> ph.Trajectory:
    system = ph.System(*contacts, ph.Gravity(g))
    return ph.simulate(system, VALUES | more, START, "2 s")


def test_a_cushion_without_friction_turns_rolling_into_sliding():
    """Its impulse goes through the centre: the spin stays, and the ball slides until it rolls.

    The slip (1 + e) v₀ decays by 7/2 μ g per second (E. J. Routh, Advanced Rigid Dynamics, 1905,
    art. 239), and v in the meantime by μ g.
    """
    cushion = ph.Smooth(ball, on=wall, name="cushion", force="W", restitution=e)
    run = _run(ground, cushion, mu=MU, e=E)
    assert [x.kind for x in run.events] == ["start", "bounces", "sticks", "end"]
    hit, sticks = (event.time for event in run.events[1:3])
    assert hit == pytest.approx((0.5 - R) / 1, rel=1e-12)
    assert sticks - hit == pytest.approx((1 + E) / (3.5 * MU * G), rel=1e-12)
    assert run.at(hit)["v_x"] == pytest.approx(E, rel=1e-12)
    assert run.at(hit)["omega_y"] == pytest.approx(-10, rel=1e-12)
    last = run.final
    assert last["v_x"] == pytest.approx(E - (1 + E) * 2 / 7, rel=1e-12)
    assert last["v_y"] == pytest.approx(0.4, rel=1e-12)
    assert last["omega_y"] == pytest.approx(last["v_x"] / R, rel=1e-12)


def test_against_a_cushion_that_does_not_spring_the_ball_spins_down_in_place():
    cushion = ph.Smooth(ball, on=wall, name="cushion", force="W")
    run = _run(ground, cushion, mu=MU)
    times = np.linspace(0.41, 2.0, 50)
    assert run.evaluate("x", times) == pytest.approx(R, abs=1e-14)
    assert run.final["omega_y"] == pytest.approx(0, abs=1e-12)
    assert run.final["v_y"] == pytest.approx(0.4, rel=1e-12)
    assert np.all(np.diff(run.evaluate("energy", times)) <= 1e-15)


@pytest.mark.parametrize(
    "contacts",
    [
        (ph.Rolling(ball, on=floor, name="floor"), ph.Smooth),
        (ground, ph.Coulomb),
    ],
)
def test_impacts_that_another_contact_feels_are_refused(contacts):
    """One that never slips, or a wall whose friction lifts the ball or presses it down."""
    first, kind = contacts
    rough = {"mu": nu} if kind is ph.Coulomb else {}
    second = kind(ball, on=wall, name="wall", force="W", restitution=e, **rough)
    values = {"e": E} | ({"mu": MU, "nu": 0.2} if rough else {})
    with pytest.raises(ph.NumericError, match=r"wall lands at .* the contact floor feels"):
        _run(first, second, **values)
