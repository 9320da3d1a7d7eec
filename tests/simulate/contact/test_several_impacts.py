"""Impacts that several contacts feel, by the law of Moreau: rocking blocks, a ball in a groove."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

import polhode as ph
from polhode.derive import Automaton
from polhode.simulate.contact._joint_impact import ImpactLaw, joint_impact

G = 9.81
m, w, h, g, mu = ph.symbols("m w h g mu", positive=True)
e = ph.symbol("e")
LAB = ph.Frame("lab")


def block(law: str = "Moreau", **friction: ph.Expr) -> ph.System:
    """A uniform block 2w wide and 2h high that turns by q about y."""
    axes = LAB.rotated(ph.coordinate("q"), "y")
    inertia = m * (w**2 + h**2) / 3
    body = ph.Body("block", mass=m, inertia=(inertia, inertia, inertia), axes=axes)
    kind = ph.Coulomb if friction else ph.Rolling
    edges = [
        kind(
            body,
            on=ph.Plane(LAB),
            at=axes["x"] * (w * side) - axes["z"] * h,
            name=name,
            force=name[0],
            **friction,
        )
        for name, side in (("left", -1), ("right", 1))
    ]
    return ph.System(*edges, ph.Hinge(body, axis="y"), ph.Gravity(g), impacts=law)


SIZE = {"m": 2.0, "w": 0.1, "h": 0.4, "g": G}
SLENDER, RADIUS = np.arctan2(0.1, 0.4), np.hypot(0.1, 0.4)


def tilted(q: float) -> dict[str, float]:
    """On its right edge, with the height of the centre that this means."""
    return {"q": q, "z": 0.4 * np.cos(q) + 0.1 * np.sin(q)}


def rocking(system: ph.System | Automaton, q: float = 0.1, **more: float) -> ph.Trajectory:
    return ph.simulate(system, SIZE | more, tilted(q), 10.0, samples=2)


def swing(angle: float) -> float:
    """Time in which a block falls from an angle to upright, about its edge.

    (4/3 m R²) q̇²/2 = m g R (cos(α - q₀) - cos(α - q)); q = q₀ cos s removes the root at the start.
    """

    def slowness(s: float) -> float:
        q = angle * np.cos(s)
        # cos(α - q₀) - cos(α - q) as a product, which keeps its digits
        drop = 2 * np.sin((2 * SLENDER - angle - q) / 2) * np.sin((angle - q) / 2)
        return angle * np.sin(s) / np.sqrt(1.5 * G / RADIUS * drop)

    return quad(slowness, 0, np.pi / 2, epsabs=1e-14, epsrel=1e-12)[0]


@cache
def sticking() -> ph.Trajectory:
    return rocking(block())


def test_a_block_rocks_to_rest_as_housner_says() -> None:
    """Each impact leaves 1 - 3/2 sin² α of the angular velocity (Housner, Bull. Seism. Soc. Am.
    53, 403, 1963), and so its square of the energy over that of the block upright."""
    run = sticking()
    kept = 1 - 1.5 * np.sin(SLENDER) ** 2
    impacts = [event for event in run.events if event.kind == "touches down"]
    ratios = [i.state_after["q_dot"] / i.state_before["q_dot"] for i in impacts[:200]]
    assert ratios == pytest.approx([kept] * 200, rel=1e-9)
    assert ratios[:50] == pytest.approx([kept] * 50, rel=1e-13)
    assert run.drift.energy < 1e-13
    assert run.mode == "rolling"
    assert run.final["q_dot"] == 0
    # From one impact to the next twice the time to fall from the angle that the energy reaches.
    angle, expected = 0.1, swing(0.1)
    for _ in range(140):
        drop = kept**2 * (np.cos(SLENDER - angle) - np.cos(SLENDER))
        angle = SLENDER - np.arccos(np.cos(SLENDER) + drop)
        expected += 2 * swing(angle)
    expected += 2 * swing(angle) * kept / (1 - kept)  # small angles: times in proportion to speeds
    assert impacts[-1].time == pytest.approx(expected, rel=1e-6)


def test_with_friction_enough_not_to_slip_it_rocks_alike() -> None:
    rubbing = rocking(block(mu=mu), mu=0.8)
    assert rubbing.events[-2].time == pytest.approx(sticking().events[-2].time, rel=1e-12)


def test_with_little_friction_it_slips_and_loses_energy() -> None:
    run = rocking(block(mu=mu), q=0.15, mu=0.12)
    assert "slips" in {event.kind for event in run.events}
    assert run.mode == "rolling"
    levels = run.evaluate("energy", np.linspace(0, run.duration, 2001))
    assert np.all(np.diff(levels) <= 1e-12 * levels[0])
    assert run.drift.energy < 1e-12


def test_without_a_law_it_is_refused() -> None:
    with pytest.raises(ph.NumericError, match='impacts="Moreau"'):
        rocking(block("", mu=mu), mu=0.8)
    with pytest.raises(ph.DeclarationError, match="impacts='Newton'"):
        block("Newton")


@pytest.mark.parametrize("restitution", [0.0, 0.6, 1.0])
def test_a_ball_that_falls_into_a_groove_hits_both_sides(restitution: float) -> None:
    """Without friction, each normal velocity is reversed with e: so is the vertical one."""
    a = ph.symbol("a", positive=True)
    half = ph.pi / 6
    ball = ph.sphere("ball", mass=m, radius=a, axes=LAB)
    sides = [
        ph.Smooth(
            ball,
            on=ph.Plane(LAB.rotated(turn, "x", name=name)),
            name=name,
            force=name[0],
            restitution=e,
        )
        for name, turn in (("left", half), ("right", -half))
    ]
    system = ph.System(*sides, ph.Gravity(g, up=LAB["z"]), impacts="Moreau")
    numbers = {"m": 0.1, "a": 0.02, "g": G, "e": restitution}
    # The centre is a/cos(π/6) above the bottom where it touches both; coordinates are along the
    # left side.
    along, up = np.sin(np.pi / 6), np.cos(np.pi / 6)
    height = 0.02 / up + 0.05
    start = {"z": height * up, "y": height * along}
    run = ph.simulate(system, numbers, start, 0.15, samples=2)
    impact = run.events[1]
    assert impact.time == pytest.approx(np.sqrt(2 * 0.05 / G), rel=1e-12)
    before, after = impact.state_before, impact.state_after
    fell, rose = (s["v_y"] * along + s["v_z"] * up for s in (before, after))
    assert rose == pytest.approx(-restitution * fell, rel=1e-12, abs=1e-15)


@given(
    seed=st.integers(0, 10**6),
    count=st.integers(1, 3),
    restitution=st.floats(0, 0.9),
    friction=st.sampled_from([0.0, 0.1, 0.4, np.inf]),
)
def test_impulses_obey_both_laws(
    seed: int, count: int, restitution: float, friction: float
) -> None:
    rng = np.random.default_rng(seed)
    jacobian = rng.normal(size=(3 * count, 3 * count + 2))
    inverse_mass = jacobian @ jacobian.T + np.eye(3 * count)
    before = rng.normal(size=(count, 3))
    laws = [ImpactLaw((restitution, 0.0), friction)] * count
    try:
        impulses, after = joint_impact(inverse_mass, before, laws, "an impact")
    except ph.NumericError:  # which adds energy, or whose impulses do not settle
        return
    scale, largest = np.max(np.abs(before)), np.max(np.abs(impulses), initial=1e-300)
    normal, along = impulses[:, 2], np.hypot(*impulses[:, :2].T)
    rebound = after[:, 2] + restitution * before[:, 2]
    assert np.all(normal >= -1e-9 * largest)
    assert np.all(rebound >= -1e-8 * scale)
    assert np.max(np.abs(normal * rebound)) < 1e-8 * scale * largest
    if np.isfinite(friction):
        assert np.all(along <= friction * normal + 1e-9 * largest)
        slip = np.hypot(*after[:, :2].T)
        rubs = (slip > 1e-6 * scale) & (normal > 1e-6 * largest)
        power = np.sum(impulses[:, :2] * after[:, :2], axis=1)
        assert power[rubs] == pytest.approx(
            -(friction * normal * slip)[rubs], rel=1e-6, abs=1e-9 * scale * largest
        )
    else:
        assert np.max(np.abs(after[normal > 1e-9 * largest][:, :2]), initial=0) < 1e-8 * scale
