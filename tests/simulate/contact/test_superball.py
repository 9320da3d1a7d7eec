"""Superballs: impacts that reverse the slip (Garwin, Am. J. Phys. 37 (1), 88, 1969)."""

from __future__ import annotations

import numpy as np
import pytest

import polhode as ph

M, A, G = ph.symbols("m a g")
LAB = ph.Frame("N")
NUMBERS = {M: 0.05, A: 0.02, G: 9.81}


def ball(restitution, **more) -> ph.System:
    one = ph.sphere("ball", mass=M, radius=A, axes=LAB)
    floor = ph.Rolling(one, on=ph.Plane(LAB), restitution=restitution, **more)
    return ph.System(one, floor, ph.Gravity(G))


@pytest.mark.parametrize(("restitution", "after"), [((1, 1), 3 / 7), (1, 5 / 7), ((1, 0.5), 4 / 7)])
def test_the_first_bounce(restitution, after):
    """v' = v − (1 + e) (2/7) v of a ball that does not spin."""
    run = ph.simulate(ball(restitution), NUMBERS, {"z": 0.5, "v_x": 1.0}, "0.5 s")
    event = next(event for event in run.events if event.kind == "bounces")
    assert event.state_after["v_x"] == pytest.approx(after, rel=1e-14)
    assert event.state_after["v_z"] == pytest.approx(-event.state_before["v_z"], rel=1e-13)


def test_every_second_bounce_restores_the_motion():
    """The slip is reversed at each: after two, velocity and spin are what they were."""
    start = {"z": 0.5, "v_x": 1.0, "v_y": -0.3, "omega_x": 4.0, "omega_y": 11.0, "omega_z": 2.0}
    run = ph.simulate(ball((1, 1)), NUMBERS, start, "4 s")
    bounces = [event for event in run.events if event.kind == "bounces"]
    assert len(bounces) >= 6
    for name in ("v_x", "v_y", "omega_x", "omega_y", "omega_z"):
        assert bounces[5].state_after[name] == pytest.approx(start[name], rel=1e-12)
    energy = run.evaluate("energy", np.array([0.0, 4.0]))
    assert energy[1] == pytest.approx(energy[0], rel=1e-13)


def test_it_returns_from_under_a_table():
    """Thrown forwards below a table, it comes back after floor, table and floor.

    Each impact reverses the slip; by hand for three impacts with normals up, down and up.
    """
    floor = ph.Rolling(
        one := ph.sphere("ball", mass=M, radius=A, axes=LAB),
        on=ph.Plane(LAB),
        restitution=(1, 1),
        name="floor",
    )
    below = ph.Plane(LAB.rotated(ph.pi, "x"), at=LAB["z"] * 0.3)
    table = ph.Rolling(one, on=below, restitution=(1, 1), name="table", force="T")
    system = ph.System(one, floor, table, ph.Gravity(G))
    run = ph.simulate(system, NUMBERS, {"z": 0.2, "v_x": 3.0, "v_z": -6.0}, "0.12 s")
    bounces = [event for event in run.events if event.kind == "bounces"]
    v, spin = 3.0, 0.0  # along x, and ω a about y: the slip at the floor is v − s, below v + s
    for sense, event in zip((1, -1, 1), bounces, strict=False):
        slip = v - sense * spin
        v, spin = v - 4 / 7 * slip, spin + sense * 10 / 7 * slip
        assert event.state_after["v_x"] == pytest.approx(v, rel=1e-12)
        assert event.state_after["omega_y"] * 0.02 == pytest.approx(spin, rel=1e-12)
    assert v < 0


def test_impossible_restitutions():
    for pair in ((1, 2), (1, -0.1), (2, 1)):
        with pytest.raises(ph.DeclarationError, match="restitution of contact"):
            ball(pair)
    with pytest.raises(ph.DeclarationError, match="whose impacts reverse the slip"):
        ph.with_friction(ball((1, 1)), 0.3)
    share = ph.symbol("epsilon")
    with pytest.raises(ph.DeclarationError, match=r"restitution = 1\.5"):
        ph.simulate(ball((1, share)), {**NUMBERS, share: 1.5}, {"z": 0.5}, "1 s")
