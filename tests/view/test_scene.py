"""The scene: what it says of a motion is the motion."""

import base64
import json
import re

import numpy as np
import pytest

import polhode as ph
from polhode.base import DeclarationError
from polhode.catalogue import PROBLEM_SET, numbers_of
from polhode.derive import automaton
from polhode.judge import judgement_on
from polhode.model import with_edge, with_friction
from polhode.view import _scene_bodies as bodies
from polhode.view._drawn import DrawnArrow
from polhode.view._magnitudes import Magnitudes

KINDS = {"force", "load", "torque", "omega", "momentum"}
SHAPES = {
    "spinning-coin": "disk",
    "rolling-disk": "disk",
    "marble-on-turntable": "ball",
    "gyrocompass": "wheel",
    "tennis-racquet": "racquet",
    "ball-on-paper": "ball",
    "gyroscope": "disk",
}


@pytest.fixture(scope="module")
def scene_of(run_of):
    known = {}

    def scene(name):
        if name not in known:
            known[name] = ph.scene(run_of(name), plots=PROBLEM_SET[name].plots)
        return known[name]

    return scene


def turned(vector, quaternions):
    u, w = quaternions[:, :3], quaternions[:, 3:]
    cross = np.cross(u, vector)
    return vector + 2 * (w * cross + np.cross(u, cross))


def rows(packed):
    """An array as the page unpacks it."""
    data = np.frombuffer(base64.b64decode(packed["float32"]), dtype="<f4")
    return data.reshape(packed["shape"])


def instants(run, scene):
    return np.linspace(0.0, run.duration, scene.frames)


@pytest.mark.parametrize("name", list(PROBLEM_SET))
def test_every_system_has_a_sound_scene(scene_of, name):
    scene = scene_of(name)
    assert scene.bodies
    assert scene.panels
    assert scene.motion
    assert scene.parameters
    for body in scene.bodies:
        assert len(body.pose.place) in (1, scene.frames)
        assert len(body.pose.turn) in (1, scene.frames)
        assert len(body.pose.spin) in (0, scene.frames)
        assert np.allclose(np.linalg.norm(body.pose.turn, axis=1), 1)
        assert all(size > 0 for size in body.shape.size)
        assert np.isfinite(body.pose.place).all()
    for arrow in scene.arrows:
        assert arrow.kind in KINDS
        assert np.isfinite(arrow.along).all()
        assert arrow.usual <= arrow.largest
    text = json.dumps(scene.as_json(), allow_nan=False)
    assert len(text) < 750_000


@pytest.mark.parametrize(("name", "kind"), SHAPES.items())
def test_bodies_look_like_themselves(scene_of, name, kind):
    assert scene_of(name).bodies[0].shape.kind == kind


def test_no_frame_is_far_from_the_next(scene_of):
    """But where that would take too many: that marble gets up to 300 turns a second."""
    for name in PROBLEM_SET.keys() - {"marble-on-turntable/tilted"}:
        turn = scene_of(name).bodies[0].pose.turn
        close = np.abs(np.sum(turn[1:] * turn[:-1], axis=1))
        assert np.all(close > np.cos(0.07)), name


def test_the_disk_stands_on_its_contact(run_of, scene_of):
    """The lowest point of the rim is where the force acts, on the plane."""
    run, scene = run_of("rolling-disk"), scene_of("rolling-disk")
    body = scene.bodies[0]
    axis = turned(np.array(body.shape.axis), body.pose.turn)
    down = np.array([0.0, 0.0, -1.0]) + axis * axis[:, 2:]
    lowest = body.pose.place + 0.03 * down / np.linalg.norm(down, axis=1, keepdims=True)
    force = next(arrow for arrow in scene.arrows if arrow.kind == "force")
    assert np.allclose(lowest, force.foot, atol=1e-9)
    assert np.allclose(force.foot[:, 2], 0, atol=1e-12)
    assert np.allclose(force.along[:, 2], run.evaluate("F_z", instants(run, scene)))


def test_spin_and_axes_together_turn_as_omega_says(run_of, scene_of):
    scene = scene_of("gyroscope")
    body = scene.bodies[0]
    omega = next(arrow.along for arrow in scene.arrows if arrow.kind == "omega")
    axis = turned(np.array(body.pose.axis), body.pose.turn)
    step = scene.duration / (scene.frames - 1)
    spin = np.gradient(body.pose.spin, step)
    rate = np.gradient(axis, step, axis=0)
    expected = axis * np.sum(omega * axis, axis=1, keepdims=True) + np.cross(axis, rate)
    assert np.allclose(expected[5:-5], omega[5:-5], atol=0.05)
    assert np.max(np.abs(spin)) > 140


def test_torque_is_the_rate_of_the_momentum(scene_of):
    for name in ("rolling-disk", "gyroscope", "spinning-coin"):
        scene = scene_of(name)
        arrows = {arrow.kind: arrow.along for arrow in scene.arrows}
        step = scene.duration / (scene.frames - 1)
        rate = np.gradient(arrows["momentum"], step, axis=0)[2:-2]
        size = np.max(np.abs(arrows["torque"]))
        assert np.allclose(rate, arrows["torque"][2:-2], atol=0.01 * size)


def test_moments_are_about_the_pivot_that_is_at_rest(scene_of):
    """M g a sin θ at the start, of which no text has another; without a pivot, about the centre."""
    arrows = {arrow.kind: arrow for arrow in scene_of("gyroscope").arrows}
    torque = arrows["torque"]
    expected = 0.5 * 9.81 * 0.06 * np.sin(np.radians(60))
    assert np.linalg.norm(torque.along[0]) == pytest.approx(expected)
    assert torque.name == "torque about the pivot of gyroscope"
    assert np.allclose(torque.foot, 0)
    momentum = arrows["momentum"]
    assert np.linalg.norm(momentum.along[0]) == pytest.approx(6.25e-4 * 150)
    assert momentum.name == "angular momentum about the pivot of gyroscope"
    disk = {arrow.kind: arrow for arrow in scene_of("rolling-disk").arrows}
    assert disk["torque"].name == "torque about the centre of disk"
    assert not len(disk["torque"].foot)


@pytest.mark.parametrize(("name", "letter"), [("gyroscope", "M"), ("rolling-disk", "m")])
def test_a_weight_has_the_letters_of_the_model(scene_of, name, letter):
    (load,) = (arrow for arrow in scene_of(name).arrows if arrow.kind == "load")
    assert re.findall("<mi>(.*?)</mi>", load.symbol) == [letter, "g"]


def pulled_from_under(pull, v_x, edge, along="X"):
    """A ball on paper that is pulled with friction, until the ball comes off its edge."""
    entry = PROBLEM_SET["ball-on-paper"]
    system = with_friction(with_edge(entry.build(), edge), 0.2)
    settings = {"X": "0", "Y": "0", "chi": "0", along: f"-{pull}*t**2"}
    equations = automaton(system).together.equations
    numbers = numbers_of(entry, equations, settings, {"v_x": v_x}, "3 s")
    return ph.simulate(
        system, numbers.parameters, numbers.start, numbers.duration, forcing=numbers.forcing
    )


def test_what_vanishes_by_symmetry_is_zero():
    """A ball under which paper is pulled along y never moves along x nor turns about y or z."""
    run = pulled_from_under(10, "0 m/s", 0.1, along="Y")
    assert 0 < np.max(np.abs(run.evaluate("omega_y", run.t))) < 1e-15  # cos(π/2) is rounding
    shown = ph.scene(run, plots=[["y"], ["x"], ["v_x"], ["omega_y"], ["omega_z"], ["F_x"]])
    values = {series.name: series.values for panel in shown.panels for series in panel.series}
    for name in ("x", "v_x", "omega_y", "omega_z", "F_x"):
        assert not np.any(values[name]), name


def test_small_values_are_not_rounding():
    """What is small beside other quantities only as far as a start makes it so is drawn."""
    sizes = Magnitudes({"m": 1.0}, {"m": 0.02})
    values = np.array([0.0, 3e-22, -2e-16, 1e-12, 0.5])
    assert sizes.without_rounding(values, "m").tolist() == [0, 0, 0, 1e-12, 0.5]
    assert sizes.without_rounding(values, "N").tolist() == [0, 0, 0, 1e-12, 0.5]
    tiny = np.array([0.0, 3e-22])
    assert sizes.without_rounding(tiny, "N").tolist() == [0.0, 3e-22]


def test_a_sheet_ends_at_its_edge_and_its_trace_where_the_ball_leaves_it():
    run = pulled_from_under(1, "0.2 m/s", 0.3)
    left = next(event.time for event in run.events if event.kind == "crosses the edge")
    shown = ph.scene(run)
    (sheet,) = shown.supports
    assert sheet.middle[0] + sheet.reach[0] == pytest.approx(0.3)
    (on_it,) = (trace for trace in shown.traces if trace.support == 0)
    t = instants(run, shown)
    drawn = np.isfinite(on_it.points).all(axis=1)
    assert np.array_equal(drawn, t < left)
    assert np.max(on_it.points[drawn, 0]) == pytest.approx(0.3, abs=0.01)
    path = next(trace for trace in shown.traces if trace.kind == "contact" and trace.support < 0)
    assert np.isfinite(path.points).all()


def test_up_is_up_on_the_earth_and_north_is_marked(scene_of):
    shown = scene_of("gyrocompass")
    assert shown.up == (1, 0, 0)
    assert shown.directions == ("x up", "y E", "z N")


def test_a_ball_turns_as_its_angular_velocity_says(scene_of):
    """A point of a marble moves with ω × r between two frames."""
    scene = scene_of("marble-on-turntable")
    point = turned(np.array([0.0, 0.6, 0.8]), scene.bodies[0].pose.turn)
    omega = next(arrow.along for arrow in scene.arrows if arrow.kind == "omega")
    rate = np.gradient(point, scene.duration / (scene.frames - 1), axis=0)
    assert np.allclose(rate[1:-1], np.cross(omega, point)[1:-1], atol=0.2)


def test_the_trace_on_a_turntable_lies_under_the_marble(scene_of):
    scene = scene_of("marble-on-turntable")
    path, on_it = (t for t in scene.traces if t.kind == "contact")
    support = scene.supports[on_it.support]
    assert support.kind == "turntable"
    assert np.allclose(turned(on_it.points, support.pose.turn), path.points, atol=1e-9)


def test_the_sheet_moves_as_prescribed(run_of, scene_of):
    run, scene = run_of("ball-on-paper"), scene_of("ball-on-paper")
    t = instants(run, scene)
    assert np.allclose(scene.supports[0].pose.place[:, 0], (1 - np.cos(2 * t)) / 20)


def test_a_tilted_support_is_tilted(scene_of):
    (support,) = scene_of("marble-on-turntable/tilted").supports
    normal = turned(np.array([0.0, 0.0, 1.0]), support.pose.turn)
    assert np.allclose(normal[:, 2], np.cos(np.radians(2)))
    assert np.allclose(normal, normal[0])


def test_panels_hold_what_was_requested(run_of):
    scene = ph.scene(run_of("rolling-disk"), plots=[["theta"]])
    theta, energy = scene.panels
    assert [series.name for series in theta.series] == ["theta"]
    assert theta.unit == "deg"
    assert theta.series[0].values[0] == pytest.approx(80)
    assert energy.kind == "energies"
    names = ["energy", "kinetic energy", "potential energy"]
    assert [series.name for series in energy.series] == names
    with pytest.raises(DeclarationError, match="nonsense"):
        ph.scene(run_of("rolling-disk"), plots=[["nonsense"]])


def test_numbers_are_those_of_the_run(run_of):
    scene = ph.scene(run_of("rolling-disk"), meanings={"m": "mass of the disk"})
    (mass,) = (number for number in scene.parameters if number.name == "m")
    assert (mass.value, mass.unit, mass.meaning) == (0.2, "kg", "mass of the disk")
    assert scene.evidence[0].value == run_of("rolling-disk").drift.energy
    assert scene.origin["schema"] == 2


def test_arrays_survive_the_packing(scene_of):
    scene = scene_of("gyroscope")
    document = json.loads(json.dumps(scene.as_json()))
    place = rows(document["bodies"][0]["pose"]["place"])
    assert np.allclose(place, scene.bodies[0].pose.place, rtol=1e-6, atol=1e-9)
    assert document["judgements"] == []


def test_claims_find_a_place(run_of):
    judged = ph.Judgement("energy is constant", "holds", "no friction")
    scene = ph.scene(run_of("gyroscope/held"), judgements=[judged])
    assert scene.as_json()["judgements"] == [
        {
            "claim": "energy is constant",
            "verdict": "holds",
            "reason": "no friction",
            "formula": "",
            "correction": "",
            "notes": [],
            "convention": "",
        }
    ]


def test_a_judged_claim_of_a_text_comes_with_its_reading_and_convention():
    (judged,) = ph.audit(only=["w22"]).judged
    shown = judgement_on(judged)
    assert [note.label for note in shown.notes[:3]] == ["read as", "because", "given"]
    assert "<math" in shown.notes[0].formula
    assert "on edge at θ = π/2" in shown.convention


def test_a_checked_equation_becomes_a_judgement():
    equations = ph.derive(PROBLEM_SET["rolling-disk"].build())
    latex = r"3\dot\omega_3 = 3\dot\theta\dot\phi\sin\theta"
    judged = ph.Judgement.of(latex, ph.check(latex, equations))
    assert (judged.claim, judged.verdict) == (latex, "fails")
    assert "<math" in judged.formula
    assert "<math" in judged.correction


def test_particles_springs_and_dampers_are_seen():
    """Links run from body to body, or to a place; nothing lies under the floor."""
    m, k, c, g, h = ph.symbols("m k c g h", positive=True)
    lab = ph.Frame("lab")
    bob, low = (ph.point_mass(n, mass=m, axes=lab, tag=n) for n in ("bob", "low"))
    hung = ph.Spring(bob.point(lab.zero), lab.vector(0, 0, h), stiffness=k)
    below = ph.Damper(low.point(lab.zero), bob.point(lab.zero), damping=c)
    system = ph.System(bob, low, hung, below, ph.Gravity(g), name="bobs")
    numbers = {m: 1, k: 40, g: 9.81, h: 1, c: 2}
    run = ph.simulate(ph.derive(system), numbers, {"x_bob": 0.1, "z_low": -0.4}, "2 s")
    scene = ph.scene(run)
    assert scene.bodies[0].shape.size[0] > 0
    assert {arrow.name for arrow in scene.arrows} >= {"spring on bob", "gravity on bob"}
    spring, damper = scene.links
    assert (spring.kind, damper.kind) == ("spring", "damper")
    assert np.array_equal(spring.start, scene.bodies[0].pose.place)
    assert np.allclose(spring.end, [[0, 0, 1]])
    assert np.array_equal(damper.end, spring.start)
    assert np.allclose(damper.start[:, 2], run.evaluate("z_low", instants(run, scene)))
    assert scene.floor <= min(damper.start[:, 2])
    assert scene.as_json()["links"][0]["thick"] == spring.thick > 0


def test_what_bodies_turn_on_is_shown():
    """A shaft on a cross at the ceiling, a bar welded to it, and a flap on a hinge."""
    m, l, g = ph.symbols("m l g", positive=True)
    alpha, beta, gamma = ph.coordinates("alpha beta gamma")
    lab = ph.Frame("lab")
    axes = lab.rotated(alpha, "x").rotated(beta, "y")
    turned = axes.rotated(gamma, "x")
    shaft = ph.rod("shaft", mass=m, length=l, axes=axes, axis="z")
    bar = ph.rod("bar", mass=m, length=l, axes=axes, axis="x", tag="bar")
    flap = ph.rod("flap", mass=m, length=l, axes=turned, axis="z", tag="flap")
    foot = shaft.point(axes["z"] * (-l / 2))
    system = ph.System(
        ph.Pivot(shaft, at=axes["z"] * (l / 2), to=lab.vector(0, 0, l)),
        ph.Universal(shaft, arm=axes["y"], other_arm=lab["x"]),
        ph.Weld(bar, to=foot),
        ph.Pivot(flap, at=turned["z"] * (l / 2), to=foot),
        ph.Hinge(flap, axis="x", to=shaft),
        ph.Gravity(g),
    )
    start = {"alpha": 0.5, "beta": 0.2, "gamma": 0.3}
    scene = ph.scene(ph.simulate(ph.derive(system), {m: 0.1, l: 0.3, g: 9.81}, start, 1))
    names = [body.name for body in scene.bodies]
    found = {(joint.kind, names[joint.body]): joint for joint in scene.joints}
    assert set(found) == {("universal", "shaft"), ("weld", "bar"), ("hinge", "flap")}
    assert found["universal", "shaft"].axis == (0, 1, 0)
    assert found["universal", "shaft"].place == (0, 0, 0.15)
    assert found["hinge", "flap"].axis == (1, 0, 0)


def test_a_force_without_bound_is_no_arrow():
    """Where a formula divides by zero nothing is drawn, and the rest is to scale."""
    endless = np.full((5, 3), np.inf)
    drawn = DrawnArrow("force", "force", "", None, "N", lambda equations: None)
    values, nowhere = np.vstack([endless, np.ones((95, 3))]), np.zeros((0, 3))
    shown = bodies._arrow(drawn, 0, Magnitudes({}, {}), values, nowhere, nowhere, 0.0)
    assert np.all(shown.along[:5] == 0)
    assert shown.largest == pytest.approx(np.sqrt(3))


def test_a_body_held_at_a_point_has_a_pivot(scene_of):
    (pivot,) = scene_of("gyroscope").joints
    assert (pivot.kind, pivot.body) == ("pivot", 0)
    assert np.linalg.norm(pivot.place) == pytest.approx(0.06)


def test_every_contact_mode_is_followed():
    """A ball is dropped: no contact force while it flies, and equations of both modes."""
    m, a, g, mu = ph.symbols("m a g mu", positive=True)
    lab = ph.Frame("lab")
    ball = ph.sphere("ball", mass=m, radius=a, axes=lab)
    floor = ph.Coulomb(ball, on=ph.Plane(lab), mu=mu, name="floor")
    system = ph.System(floor, ph.Gravity(g), name="dropped")
    numbers = {m: 0.1, a: 0.05, g: 9.81, mu: 0.3}
    run = ph.simulate(system, numbers, {"z": 0.25, "v_x": 0.5}, "1 s")
    scene = ph.scene(run)
    force = next(arrow for arrow in scene.arrows if arrow.kind == "force")
    contact = next(trace for trace in scene.traces if trace.kind == "contact")
    landed = instants(run, scene) > np.sqrt(2 * 0.2 / 9.81) + 1e-3
    flying = instants(run, scene) < np.sqrt(2 * 0.2 / 9.81) - 1e-3
    assert np.all(force.along[flying] == 0)
    assert np.allclose(force.along[landed, 2], 0.981)
    assert np.isnan(contact.points[flying]).all()
    assert np.allclose(contact.points[landed, 2], 0, atol=1e-9)
    assert np.allclose(scene.bodies[0].pose.place[landed, 2], 0.05)
    assert {formula.name for formula in scene.motion} >= {"flight", "rolling"}
    assert scene.happenings


def test_angles_are_in_degrees_as_in_plots():
    """Of the start and among the parameters; rates stay in rad/s."""
    marble = PROBLEM_SET["marble-on-turntable/tilted"]
    equations = ph.derive(marble.build())
    given = numbers_of(marble, equations)
    run = ph.simulate(equations, given.parameters, given.start, "0.1 s")
    shown = {n.name: (n.value, n.unit) for n in ph.scene(run).parameters}
    assert shown["alpha"] == (pytest.approx(2), "deg")
    top = ph.simulate(
        PROBLEM_SET["gyroscope"].build(),
        {"M": 0.5, "a": 0.06, "I_1": 6.25e-4, "I_2": 3.5e-4, "g": 9.81},
        {"theta": "60 deg", "omega_1": 150},
        "0.1 s",
    )
    start = {n.name: (n.value, n.unit) for n in ph.scene(top).start}
    assert start["theta"] == (pytest.approx(60), "deg")
    assert start["omega_1"] == (150, "rad/s")
