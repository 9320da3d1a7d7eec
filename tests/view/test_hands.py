"""What a hand does on a live page: it takes a body at an instant, moves it, and pushes it."""

import numpy as np
import pytest

import polhode as ph
from polhode.view import scene
from polhode.view._live import live_document
from view.live_host import answers, usual_numbers

M, A, G, L = ph.symbols("m a g l", positive=True)
MU, E = ph.symbols("mu e")
VALUES = {"m": 0.3, "a": 0.05, "g": 9.81, "mu": 0.4, "l": 0.7, "e": 0.5} | {
    "I_1": 0.02,
    "I_2": 0.03,
    "I_3": 0.045,
}


def live_of(system, names, start, duration=1.0):
    """A motion with the values of these parameters, and its live page."""
    values = {name: VALUES[name] for name in names.split()}
    run = ph.simulate(system, values, start, duration=duration)
    return run, live_document(run, scene(run, frames=101), {})


def after(live, hand):
    """The start by name, and the answer."""
    (found,) = answers(live, {"numbers": usual_numbers(live), "frames": 0, "hand": hand})
    return dict(zip((s["name"] for s in live["start"]), found["start"], strict=True)), found


def in_flight(live, found):
    """Coordinates and speeds of flight, by name."""
    (mode,) = (m for m in live["modes"] if m["phase"] == "flight" and not m["beyond"])
    return dict(zip(mode["coordinates"] + mode["speeds"], found["begin"], strict=True))


def ball(contact):
    floor = ph.Plane(ph.Frame("lab"))
    body = ph.sphere("ball", mass=M, radius=A, axes=floor.axes)
    return ph.System(contact(body, floor), ph.Gravity(G))


def pendulum():
    """A rod that hangs, turned by θ about y."""
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "y")
    rod = ph.rod("rod", mass=M, length=L, axes=axes, axis="z")
    return ph.System(ph.Pivot(rod, at=axes["z"] * (L / 2)), ph.Gravity(G))


def rolling(body, floor):
    return ph.Rolling(body, on=floor)


def rough(body, floor):
    return ph.Coulomb(body, on=floor, mu=MU)


def test_a_ball_that_cannot_slip_takes_five_sevenths_of_a_push():
    """m v = p, without the ground; which holds the contact then: (m + I/a²) v = p."""
    _, live = live_of(ball(rolling), "m a g", {"x": 0.2, "omega_z": 3.0})
    start, found = after(
        live, {"kind": "push", "body": 0, "point": [0.2, 0, VALUES["a"]], "change": [0.6, 0.8, 0]}
    )
    assert found["impulse"] == pytest.approx(VALUES["m"])
    assert start["x"] == 0.2
    assert start["omega_z"] == pytest.approx(3.0)
    speeds = [start["v_x"], start["v_y"]]
    assert speeds == pytest.approx([0.6 * 5 / 7, 0.8 * 5 / 7], rel=1e-9)


@pytest.mark.parametrize("height", [0.0, 0.02, -0.05])
def test_a_cue_gives_a_ball_velocity_and_spin(height):
    """By momentum and angular momentum: m v = p, I ω = h p about the centre."""
    _, live = live_of(ball(rough), "m a g mu", {"omega_x": 2.0})
    m, a = VALUES["m"], VALUES["a"]
    point = [0, -np.sqrt(a**2 - height**2), a + height]
    _, found = after(live, {"kind": "push", "body": 0, "point": point, "change": [0, 1, 0]})
    start, impulse = in_flight(live, found), found["impulse"]
    assert impulse == pytest.approx(1 / (1 / m + height**2 / (2 / 5 * m * a**2)))
    assert start["v_y"] == pytest.approx(impulse / m - 2.0 * a)  # it rolled
    assert start["omega_x"] == pytest.approx(2.0 - height * impulse / (2 / 5 * m * a**2))
    assert start["v_x"] == start["omega_y"] == start["omega_z"] == 0


def test_a_push_turns_a_free_body_by_its_moment():
    """Against Newton and Euler in the laboratory, with arrays."""
    I_1, I_2, I_3 = ph.symbols("I_1 I_2 I_3", positive=True)
    lab = ph.Frame("lab")
    psi, theta, phi = ph.coordinates("psi theta phi")
    axes = lab.rotated(psi, "z").rotated(theta, "x").rotated(phi, "z")
    body = ph.Body("body", mass=M, inertia=(I_1, I_2, I_3), axes=axes)
    system = ph.System(body, ph.Gravity(G))
    inertia = np.array([VALUES[name] for name in ("I_1", "I_2", "I_3")])
    begin = {"psi": 0.3, "theta": 1.1, "phi": -0.4, "x": 0.1, "z": 0.5, "theta_dot": 2.0}
    _, live = live_of(system, "m g I_1 I_2 I_3", begin)
    offset, change = np.array([0.1, -0.2, 0.05]), np.array([0.5, 0.3, -0.4])
    place = np.array([0.1, 0, 0.5])
    start, found = after(
        live,
        {"kind": "push", "body": 0, "point": list(place + offset), "change": list(change)},
    )
    c, s = np.cos, np.sin

    def about(angle, axis):
        i, j = [(1, 2), (2, 0), (0, 1)][axis]
        turn = np.eye(3)
        turn[[i, j, i, j], [i, j, j, i]] = c(angle), c(angle), -s(angle), s(angle)
        return turn

    first, second = about(0.3, 2), about(0.3, 2) @ about(1.1, 0)
    rotation = second @ about(-0.4, 2)
    rates = np.column_stack((np.array([0, 0, 1]), first[:, 0], second[:, 2]))
    jolt = found["impulse"] * change / np.linalg.norm(change)
    spin = rotation @ np.diag(1 / inertia) @ rotation.T @ np.cross(offset, jolt)
    turned = np.array([start[f"{name}_dot"] for name in ("psi", "theta", "phi")]) - [0, 2.0, 0]
    assert rates @ turned == pytest.approx(spin, rel=1e-9, abs=1e-12)
    moved = np.array([start[f"v_{name}"] for name in "xyz"])
    assert moved == pytest.approx(jolt / VALUES["m"], rel=1e-9)
    gained = (moved + np.cross(spin, offset)) @ change / np.linalg.norm(change)
    assert gained == pytest.approx(np.linalg.norm(change), rel=1e-9)


def test_a_point_that_is_held_does_not_follow_a_push():
    system = pendulum()
    _, live = live_of(system, "m g l", {"theta": 0.5})
    along = [-np.sin(0.5), 0, -np.cos(0.5)]
    point = [VALUES["l"] * part for part in along]
    start, found = after(live, {"kind": "push", "body": 0, "point": point, "change": along})
    assert found["impulse"] == 0
    assert start == {"theta": 0.5, "theta_dot": 0.0}
    across = [-np.cos(0.5), 0, np.sin(0.5)]
    start, found = after(live, {"kind": "push", "body": 0, "point": point, "change": across})
    assert start["theta_dot"] == pytest.approx(1 / VALUES["l"])
    assert found["impulse"] == pytest.approx(VALUES["m"] / 3)  # I/l²


def test_a_body_is_taken_where_it_is_at_an_instant():
    run, live = live_of(ball(rough), "m a g mu", {"v_x": 1.0, "v_y": 0.2, "omega_z": 4.0})
    start, _ = after(live, {"kind": "take", "time": 0.37})
    for name, value in start.items():
        assert value == pytest.approx(run.evaluate(name, 0.37), abs=1e-11)


def test_a_body_is_moved_under_a_line_of_sight_and_stays_on_its_support():
    _, live = live_of(ball(rolling), "m a g", {"v_x": 0.5})
    sight = {"origin": [0.3, -2.0, 1.0], "direction": [0.0, 0.8, -0.6]}
    hand = {"kind": "move", "body": 0, "sight": sight, "size": VALUES["a"]}
    start, _ = after(live, hand)
    # the line comes to the height of the centre at y = −2 + 0.8 s, 1 − 0.6 s = a
    reached = (1 - VALUES["a"]) / 0.6
    assert [start["x"], start["y"]] == pytest.approx([0.3, -2 + 0.8 * reached], abs=1e-8)
    assert start["v_x"] == 0.5


def test_a_bob_comes_as_near_to_a_line_of_sight_as_its_rod_allows():
    system = pendulum()
    _, live = live_of(system, "m g l", {"theta": 0.2})
    sight = {"origin": [-1.5, -3.0, -1.5], "direction": [0.0, 1.0, 0.0]}
    start, _ = after(live, {"kind": "move", "body": 0, "sight": sight, "size": 0.1})
    # towards the line, which is below and in front of the pivot at 45°
    assert start["theta"] == pytest.approx(np.pi / 4, abs=1e-5)


def test_a_ball_that_is_pushed_into_the_ground_bounces_at_once():
    """With e = ½ from 2 m/s: up with 1 m/s, for 2/g; nothing is lost but at the impact."""
    floor = ph.Plane(ph.Frame("lab"))
    body = ph.sphere("ball", mass=M, radius=A, axes=floor.axes)
    system = ph.System(ph.Coulomb(body, on=floor, mu=MU, restitution=E), ph.Gravity(G))
    _, live = live_of(system, "m a g mu e", {"v_x": 1.0})
    hand = {"kind": "push", "body": 0, "point": [0, 0, VALUES["a"]], "change": [0, 0, -2.0]}
    numbers = usual_numbers(live)
    (pushed,) = answers(live, {"numbers": numbers, "frames": 0, "hand": hand})
    (moved,) = answers(live, {"numbers": numbers | {"begin": pushed["begin"]}, "frames": 201})
    first, second = moved["computed"]["happenings"][:2]
    assert (first["time"], first["what"]) == (0, "bounces: flight")
    assert second["time"] == pytest.approx(2 / 9.81, rel=1e-9)
    assert moved["computed"]["evidence"][0]["value"] < 1e-12
    assert moved["computed"]["doubt"] == ""


def test_a_ball_in_the_air_is_taken_pushed_and_lands():
    """A push in mid-flight, against the parabola and the law of impact."""
    floor = ph.Plane(ph.Frame("lab"))
    body = ph.sphere("ball", mass=M, radius=A, axes=floor.axes)
    system = ph.System(ph.Smooth(body, on=floor, restitution=E), ph.Gravity(G))
    _, live = live_of(system, "m a g e", {"z": 0.5, "v_x": 1.0})
    numbers = usual_numbers(live)
    (taken,) = answers(
        live, {"numbers": numbers, "frames": 0, "hand": {"kind": "take", "time": 0.1}}
    )
    numbers["begin"] = taken["begin"]
    middle, fall = 0.5 - 9.81 * 0.1**2 / 2, -0.981
    hand = {"kind": "push", "body": 0, "point": [0.1, 0, middle], "change": [0, 0, 2]}
    (pushed,) = answers(live, {"numbers": numbers, "frames": 0, "hand": hand})
    assert pushed["impulse"] == pytest.approx(2 * VALUES["m"])
    numbers["begin"] = pushed["begin"]
    (moved,) = answers(live, {"numbers": numbers, "frames": 201})
    up = fall + 2
    landing = (up + np.sqrt(up**2 + 2 * 9.81 * (middle - VALUES["a"]))) / 9.81
    assert moved["computed"]["happenings"][0]["what"].startswith("bounces")
    assert moved["computed"]["happenings"][0]["time"] == pytest.approx(landing, abs=1e-9)
