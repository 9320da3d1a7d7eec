"""Boxes on four corners, which share a load by a law that the system names."""

from __future__ import annotations

from functools import cache
from itertools import product
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import polhode as ph
from oracles.blocks import Shaken
from oracles.sliding_boxes import SlidingBox
from polhode.derive import Automaton, automaton
from simulate.contact.boxes import MU, MU_S, NUMBERS, on_corners, over_an_edge

SLOPE, R, W = ph.symbols("alpha R w")
(X,) = ph.functions("X")
GRAVITY = 9.81


@cache
def level() -> Automaton:
    return automaton(on_corners())


@cache
def tilted() -> Automaton:
    return automaton(on_corners(lambda lab: ph.Plane(lab, tilt=SLOPE)))


def of_box(mu: float, slope: float = 0.0) -> SlidingBox:
    m, a, b, c, g = NUMBERS.values()
    return SlidingBox(m, a, b, c, g, mu, slope)


def kinds(run: Any) -> list[str]:
    return [event.kind for event in run.events]


# -- sliding ---------------------------------------------------------------------------------------


def test_pushed_straight_it_stops_where_a_block_does() -> None:
    run = ph.simulate(level(), NUMBERS | {MU: 0.3}, {"v_x": 1.5}, 1.0)
    assert kinds(run) == ["start", "sticks", "end"]
    assert run.events[1].time == pytest.approx(1.5 / (0.3 * GRAVITY), rel=1e-13)
    assert run.final["x"] == pytest.approx(1.5**2 / (0.6 * GRAVITY), rel=1e-13)
    assert run.final["v_x"] == run.final["psi_dot"] == 0


def test_its_corners_share_the_weight_and_the_couple_of_friction() -> None:
    """Friction μ m g at the height c/2 of the centre presses the front more than the rear."""
    m, a, _, c, g = NUMBERS.values()
    run = ph.simulate(level(), NUMBERS | {MU: 0.3}, {"v_x": 1.5}, 0.1)
    weight, couple = m * g, 0.3 * m * g * c / 2
    front, rear = weight / 4 + couple / (2 * a), weight / 4 - couple / (2 * a)
    for name, expected in zip("PQRS", (front, front, rear, rear), strict=True):
        assert run[f"{name}_z"] == pytest.approx(expected, rel=1e-12)


def test_at_rest_its_corners_still_share_the_weight(tmp_path) -> None:
    """On a slope the lower ones carry more; how friction is shared stays open."""
    m, _, b, c, g = NUMBERS.values()  # b along the slope
    slope = 0.2
    run = ph.simulate(tilted(), NUMBERS | {MU: 0.5, SLOPE: slope}, {"v_x": 0.4}, 0.6)
    assert kinds(run) == ["start", "sticks", "end"]
    share, couple = m * g * np.cos(slope) / 4, m * g * np.sin(slope) * c / 2
    names = tuple(f"{corner}_z" for corner in "PQRS")
    least, most = share - couple / (2 * b), share + couple / (2 * b)
    assert sorted(run.final[name] for name in names) == pytest.approx(
        [least, least, most, most], rel=1e-12
    )
    assert set(names) <= set(run.reactions)
    assert np.isnan(run.evaluate("P_x", run.duration))
    assert "P_x" not in run.final
    run.save(tmp_path / "box.h5")
    again = ph.load(tmp_path / "box.h5")
    for name in names:
        assert again.final[name] == pytest.approx(run.final[name], rel=1e-12)


@pytest.mark.parametrize("slope", [0.0, 0.25])
def test_pushed_and_spun_it_follows_newton_and_euler(slope: float) -> None:
    push = (0.8, 0.3, 6.0)
    start = dict(zip(("v_x", "v_y", "psi_dot"), push, strict=True))
    given_ = NUMBERS | {MU: 0.35, SLOPE: slope} if slope else NUMBERS | {MU: 0.35}
    run = ph.simulate(tilted() if slope else level(), given_, start, 1.5)
    assert kinds(run) == ["start", "sticks", "end"]
    stops = run.events[1].time
    times = np.linspace(0.0, 0.98 * stops, 30)
    expected = of_box(0.35, slope).at(times, push)
    for name, values in zip(("x", "y", "psi", "v_x", "v_y", "psi_dot"), expected, strict=True):
        assert run.evaluate(name, times) == pytest.approx(values, abs=1e-10)
    assert run.drift.energy < 1e-12


@settings(max_examples=8, deadline=None)
@given(
    st.tuples(st.floats(-2, 2), st.floats(-2, 2), st.floats(-15, 15)).filter(
        lambda push: np.hypot(push[0], push[1]) + abs(push[2]) > 0.1
    ),
    st.floats(-3, 3),
    st.floats(0.1, 0.5),
)
def test_the_way_it_is_turned_makes_no_difference(push, heading, mu) -> None:
    """A push and the box, turned together, and in other units of length and time."""
    x, y, spin = push
    pushed = {"v_x": x, "v_y": y, "psi_dot": spin}
    plain = ph.simulate(level(), NUMBERS | {MU: mu}, pushed, 0.05)
    cosine, sine = np.cos(heading), np.sin(heading)
    m, a, b, c, g = NUMBERS.values()
    size, pace = 3.0, 7.0  # lengths and times are these multiples
    sizes = dict(zip(NUMBERS, (m, size * a, size * b, size * c, g * size / pace**2), strict=True))
    start = {
        "psi": heading,
        "v_x": (x * cosine - y * sine) * size / pace,
        "v_y": (x * sine + y * cosine) * size / pace,
        "psi_dot": spin / pace,
    }
    turned = ph.simulate(level(), sizes | {MU: mu}, start, 0.05 * pace)
    moved = np.array([turned.final["x"], turned.final["y"]]) / size
    expected = np.array([[cosine, -sine], [sine, cosine]]) @ [plain.final["x"], plain.final["y"]]
    assert moved == pytest.approx(expected, abs=1e-12)
    assert turned.final["psi"] - heading == pytest.approx(plain.final["psi"], abs=1e-11)
    assert kinds(turned) == kinds(plain)


# -- sticking --------------------------------------------------------------------------------------


@pytest.mark.parametrize("mu", [0.3, 0.4])
def test_shaken_it_slips_and_grips_as_a_block_does(mu: float) -> None:
    """The corners slip all at once where all friction is used up, not where one corner's is."""
    table = automaton(on_corners(lambda lab: ph.Sheet(lab, motion=(X, 0)), mu_static=MU_S))
    block = Shaken(1.2 * 0.4 * GRAVITY / 30.0**2, 30.0, mu, 0.4, GRAVITY)
    run = ph.simulate(
        table,
        NUMBERS | {MU: mu, MU_S: 0.4, R: block.reach, W: block.w},
        {"v_x": block.reach * block.w},
        block.sticks * 1.02,
        forcing={"X": R * ph.sin(W * ph.time)},
    )
    assert kinds(run)[:3] == ["start", "slips", "sticks"]
    assert run.events[1].time == pytest.approx(block.slips, rel=1e-10)
    assert run.events[2].time == pytest.approx(block.sticks, rel=1e-10)
    moved = run.final["x"] - block.reach * np.sin(30.0 * run.duration)
    assert moved == pytest.approx(block.shift, abs=1e-11)
    assert run.drift.energy < 1e-12


@pytest.mark.parametrize(("slope", "holds"), [(0.2913, True), (0.2916, False)])
def test_it_stands_on_a_slope_up_to_the_angle_of_friction(slope: float, holds: bool) -> None:
    run = ph.simulate(tilted(), NUMBERS | {MU: 0.3, SLOPE: slope}, {}, 1.0)  # arctan 0.3 = 0.29146
    assert (run.final["v_y"] == 0) is holds
    if not holds:
        falls = GRAVITY * (np.sin(slope) - 0.3 * np.cos(slope))
        assert run.final["v_y"] == pytest.approx(-falls, rel=1e-10)


@pytest.mark.parametrize(("mu", "tips"), [(0.49, False), (0.51, True)])
def test_a_tall_box_that_slides_tips_where_friction_passes_its_width(mu: float, tips: bool) -> None:
    """The rear carries nothing where μ c = a."""
    tall = dict(zip(NUMBERS, (1.3, 0.2, 0.3, 0.4, GRAVITY), strict=True))
    run = ph.simulate(level(), tall | {MU: mu}, {"v_x": 2.0}, 0.05)
    assert ("flight" in run.segments[0].mode) is tips


def test_over_two_corners_it_tips_as_over_an_edge_in_the_plane() -> None:
    """The friction along the edge is open, though whether the corners stick is not."""
    edge = automaton(on_corners(corners=((1, 1), (1, -1)), sharing=""))
    m, a, _, c, g = NUMBERS.values()
    run = ph.simulate(edge, NUMBERS | {MU: 0.9}, {"theta": 0.7, "theta_dot": 0.2}, 0.12)
    assert "rolling" in run.segments[0].mode
    # the energy of a turn about the edge, with the inertia m (a² + c²)/3
    height = a / 2 * np.sin(run["theta"]) + c / 2 * np.cos(run["theta"])
    gained = m * (a * a + c * c) / 6 * (run["theta_dot"] ** 2 - 0.2**2)
    assert gained == pytest.approx(m * g * (height[0] - height), abs=1e-13)
    with pytest.raises(ph.NumericError, match="P_y is not determined"):  # along the edge
        run["P_y"]


@pytest.mark.parametrize("lean", [0.65, 0.75])
def test_the_corners_of_an_edge_give_way_as_its_middle_would(lean: float) -> None:
    """Against the same motion with one contact, where a guard says when it slips."""
    numbers = NUMBERS | {MU: 0.35}
    plane = ph.simulate(over_an_edge(), numbers, {"theta": lean}, 0.15)
    space = ph.simulate(
        on_corners(corners=((1, 1), (1, -1)), sharing=""), numbers, {"theta": lean}, 0.15
    )
    assert kinds(space) == kinds(plane)
    assert space.events[1].time == pytest.approx(plane.events[1].time, abs=5e-12)
    for name in ("x", "theta"):
        assert space.final[name] == pytest.approx(plane.final[name], abs=1e-11)


def test_edges_that_give_way_do_so_in_ensembles_too() -> None:
    """The corners slip together where friction cannot hold them: an event without a guard."""
    edge = automaton(on_corners(corners=((1, 1), (1, -1)), sharing=""))
    leans, numbers = np.array([0.65, 0.7, 0.75]), NUMBERS | {MU: 0.35}
    many = ph.ensemble(edge, numbers, {"theta": leans}, 0.15, outputs=["x", "theta"])
    for k, lean in enumerate(leans):
        single = ph.simulate(edge, numbers, {"theta": lean}, 0.15)
        assert "slips" in kinds(single)
        assert single.drift.energy < 1e-12
        for name in ("x", "theta"):
            assert many.values[name][k] == pytest.approx(single.final[name], abs=1e-12)


def test_dropped_it_clatters_and_comes_to_rest_on_all_corners() -> None:
    """Corner after corner, ever faster; energy never grows, and no corner goes below the table."""
    start = {"z": 0.3, "theta": 0.4, "phi": 0.3, "psi_dot": 3.0, "v_x": 0.3}
    run = ph.simulate(level(), NUMBERS | {MU: 0.3}, start, 1.0)
    assert len(run.events) > 10
    assert run.segments[-1].mode == "rolling"
    assert run.final["z"] == pytest.approx(0.05, abs=1e-13)
    assert all(run.final[name] == 0 for name in ("v_x", "v_y", "psi_dot", "theta_dot", "phi_dot"))
    assert np.max(np.diff(run["energy"])) < 1e-14
    # of a corner below the centre: the height of the centre less the corner's depth
    theta, phi = run["theta"], run["phi"]
    for i, j in product((0.1, -0.1), (0.15, -0.15)):
        up = -np.sin(theta) * i + np.cos(theta) * (np.sin(phi) * j - np.cos(phi) * 0.05)
        assert np.min(run["z"] + up) > -1e-13


# -- what is refused -------------------------------------------------------------------------------


def test_without_a_law_sliding_is_refused_with_advice() -> None:
    with pytest.raises(ph.ConstraintError, match="equal stiffness"):
        ph.simulate(on_corners(sharing=""), NUMBERS | {MU: 0.3}, {"v_x": 1.0}, 1.0)


def test_an_unknown_law_is_refused() -> None:
    with pytest.raises(ph.DeclarationError, match="sharing='springs'"):
        on_corners(sharing="springs")


# -- on one corner ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("theta", "phi", "spins"),
    [(0.33, -0.74, (-14.0, -13.0, 12.0)), (0.54, -0.31, (1.0, 19.0, 17.0))],
)
@pytest.mark.parametrize("mu", [0.4, 0.8])
def test_a_corner_that_turning_lifts_opens(theta: float, phi: float, spins, mu: float) -> None:
    """It would have to pull in every direction in which slip could begin: there is no choice."""
    corner = automaton(on_corners(corners=((1, 1),), sharing=""))
    start = {"theta": theta, "phi": phi}
    start |= zip(("psi_dot", "theta_dot", "phi_dot"), spins, strict=True)
    run = ph.simulate(corner, NUMBERS | {MU: mu}, start, 0.002)
    assert run.segments[0].mode == "flight"
    assert kinds(run) == ["start", "end"]
