"""Bodies that do not feel each other, in one system: each moves as it would alone."""

from collections.abc import Callable

import numpy as np
import pytest

import polhode as ph
from polhode.derive import Automaton, automaton
from simulate.contact.balls import on_table

M, A, K, G = ph.symbols("m a k g", positive=True)
MU, E = ph.symbols("mu e")
NUMBERS = {"m": 0.05, "a": 0.02, "k": 0.4, "g": 9.81, "mu": 0.1}


@pytest.fixture(scope="module")
def pair() -> Automaton:
    lab = ph.Frame("lab")
    touches = []
    for tag in ("1", "2"):
        ball = ph.sphere(tag, mass=M, radius=A, inertia=K * M * A**2, axes=lab, tag=tag)
        touches.append(ph.Coulomb(ball, on=ph.Plane(lab), mu=MU, restitution=E))
    return automaton(ph.System(*touches, ph.Gravity(G)))


def alone(restitution: float, **start: float) -> ph.Trajectory:
    numbers = NUMBERS | {"mu_s": 0.1, "e": restitution}
    return ph.simulate(on_table(), numbers, start, 0.6, samples=2)


def both(pair: Automaton, restitution: float, **start: float) -> ph.Trajectory:
    return ph.simulate(pair, NUMBERS | {"e": restitution}, start, 0.6, samples=2)


def landings(run: ph.Trajectory) -> np.ndarray:
    changes = [e for e in run.events if e.kind in ("bounces", "touches down")]
    return np.array(sorted(float(event.time) for event in changes))


@pytest.mark.parametrize("restitution", [0.0, 0.3])
@pytest.mark.parametrize("other", [0.1, 0.2])
def test_two_balls_that_are_dropped(pair: Automaton, restitution: float, other: float) -> None:
    """From one height they land at once; from two, one lands while the other rests or rises."""
    run = both(pair, restitution, z_1=0.1, z_2=other, v_x_1=0.3)
    single = [alone(restitution, z=0.1, v_x=0.3), alone(restitution, z=other)]
    expected = np.sort(np.concatenate([landings(one) for one in single]))
    found = landings(run)
    early = min(len(found), len(expected), 20)
    assert np.abs(found[:early] - expected[:early]).max() < 1e-13
    assert abs(found[-1] - expected[-1]) < 1e-12
    for name in ("x", "v_x", "omega_y"):
        for tag, one in zip(("_1", "_2"), single, strict=True):
            assert abs(run.final[name + tag] - one.final[name]) < 1e-12
    assert run.drift.energy < 1e-13


def test_two_balls_that_slide_alike_stick_at_once(pair: Automaton) -> None:
    slide = {f"{name}_{tag}": x for tag in "12" for name, x in (("v_x", 1.0), ("omega_y", 0.0))}
    run = both(pair, 0.0, **slide)
    assert run.mode == "rolling"
    assert abs(run.final["v_x_1"] - 5 / 7) < 1e-15
    assert run.final["v_x_1"] == run.final["v_x_2"]


def on_a_bar(support: Callable[[ph.Frame], ph.Plane]) -> Automaton:
    """Two balls, free to turn, at the ends of a bar that turns about y."""
    length = ph.symbol("L", positive=True)
    lab = ph.Frame("lab")
    floor = support(lab)
    axes = lab.rotated(ph.coordinate("theta"), "y", labels="1 2 3", name="bar")
    bar = ph.Body("bar", mass=M, inertia=(0, M * length**2, M * length**2), axes=axes, tag="b")
    one, two = (ph.sphere(tag, mass=M, radius=A, axes=lab, tag=tag) for tag in "12")
    half = axes["1"] * (length / 2)
    nowhere = lab["x"] * 0
    system = ph.System(
        ph.Coulomb(one, on=floor, mu=MU, name="first"),
        ph.Coulomb(two, on=floor, mu=MU, name="second"),
        ph.Pivot(bar, at=-half, to=one.point(nowhere)),
        ph.Pivot(two, at=nowhere, to=bar.point(half), name="other end", force="R"),
        ph.Hinge(bar, axis="2"),
        ph.Gravity(G),
    )
    return automaton(system)


@pytest.fixture(scope="module")
def joined() -> Automaton:
    return on_a_bar(ph.Plane)


JOINED = {"m": 1, "a": 0.1, "g": 9.81, "L": 0.5, "mu": 0.1}


def test_a_shock_that_another_contact_feels_is_refused(joined: Automaton) -> None:
    """They are dropped askew: one rests on the table when the other lands."""
    start = {"theta": -0.3, "z_1": 0.2, "z_2": 0.2 + 0.5 * np.sin(0.3)}
    with pytest.raises(ph.NumericError, match=r"second lands .* the contact first feels"):
        ph.simulate(joined, JOINED, start, 1.0)


@pytest.mark.parametrize("along", ["x", "y"])
def test_slips_that_feel_each_other_begin_at_once(along: str) -> None:
    """A sheet is pulled from under both balls of the bar, with the acceleration A = 12 t.

    While they roll, v̇ = A/(1 + 15/4), up to v̇ = μ g, half of the bar's weight being on each ball.
    """
    on_sheet = on_a_bar(lambda lab: ph.Sheet(lab, motion=ph.functions("X Y")))
    pulled = {"X": 0, "Y": 0, along.upper(): 2 * ph.time**3}
    run = ph.simulate(on_sheet, JOINED, {}, 1.0, forcing=pulled)
    slipping = JOINED["mu"] * JOINED["g"]
    begins = 4.75 * slipping / 12
    assert {event.kind for event in run.events[1:-1]} == {"slips"}
    assert all(e.time == pytest.approx(begins, rel=1e-14) for e in run.events[1:-1])
    speed = 6 * begins**2 / 4.75 + slipping * (1 - begins)
    for tag in "12":
        assert run.final[f"v_{along}_{tag}"] == pytest.approx(speed, rel=1e-13)
    assert run.drift.energy < 1e-13


@pytest.mark.parametrize("along", ["x", "y"])
def test_balls_on_a_bar_slide_and_roll(joined: Automaton, along: str) -> None:
    """Half the bar leans on each ball, 3mg/2: v = v0 - mu g t, and a omega = 15/4 mu g t."""
    mu, g = JOINED["mu"], JOINED["g"]
    other = "y" if along == "x" else "x"
    still = {f"omega_{axis}_{tag}": 0.0 for axis in "xyz" for tag in "12"}
    start = still | {f"v_{along}_{tag}": 1.0 for tag in "12"} | {f"v_{other}_1": 0.0}
    run = ph.simulate(joined, JOINED, start, 0.4, samples=2)
    assert [event.kind for event in run.events] == ["start", "sticks", "end"]
    assert abs(run.events[1].time - 4 / (19 * mu * g)) < 1e-13
    for tag in "12":
        assert abs(run.final[f"v_{along}_{tag}"] - 15 / 19) < 1e-13
    assert run.drift.energy < 1e-13


def test_two_balls_on_one_sheet_begin_to_slip_at_once() -> None:
    lab = ph.Frame("lab")
    sheet = ph.Sheet(lab, motion=ph.functions("X Y"))
    touches = []
    for tag in ("1", "2"):
        ball = ph.sphere(tag, mass=M, radius=A, inertia=K * M * A**2, axes=lab, tag=tag)
        touches.append(ph.Coulomb(ball, on=sheet, mu=MU))
    forcing = {"X": ph.sin(6 * ph.time) / 4, "Y": ph.time**3}
    numbers = NUMBERS | {"mu": 0.2}
    one, two = (
        ph.simulate(ph.System(*balls, ph.Gravity(G)), numbers, {}, 1.2, forcing=forcing, samples=2)
        for balls in (touches[:1], touches)
    )
    alone = [(e.kind, float(e.time)) for e in one.events]
    assert [kind for kind, _ in alone[1:-1]] == ["slips", "sticks", "slips"]
    for kind, time in alone[1:-1]:
        assert any(e.kind == kind and abs(e.time - time) < 1e-14 for e in two.events)
    for name in ("x", "y", "v_x", "v_y", "omega_x", "omega_y"):
        for tag in ("_1", "_2"):
            assert abs(two.final[name + tag] - one.final[name + "_1"]) < 1e-13
    assert two.drift.energy < 1e-13
