"""The arcs of angles lead from where their letters are zero to where the axes are."""

import numpy as np
import pytest

import polhode as ph
from polhode.view import _rotations

M, A, L, G = ph.symbols("m a l g", positive=True)


def about(axis, angle):
    return _rotations.about(np.outer(angle, axis))


def turned(angles, frames):
    """Attitudes after each of the rotations, from none on, as products of quaternions."""
    found = [np.tile([0.0, 0.0, 0.0, 1.0], (frames, 1))]
    for rotation in angles.rotations:
        angle = np.broadcast_to(rotation.angle, frames)
        found.append(_rotations.product(found[-1], about(rotation.axis, angle)))
    return found


def ends(angles, frames, letter):
    """Unit vectors where the arc of a letter begins and ends, and the angle between them."""
    attitudes = turned(angles, frames)
    (i,) = [i for i, r in enumerate(angles.rotations) if f"<mi>{letter}</mi>" in r.symbol]
    rotation = angles.rotations[i]
    sweep = np.broadcast_to(rotation.angle, frames) - rotation.offset
    begin = np.array(rotation.begin)
    end = _rotations.applied(about(rotation.axis, sweep), begin)
    before = attitudes[i]
    first, last = (
        _rotations.applied(before, np.broadcast_to(v, (frames, 3))) for v in (begin, end)
    )
    return first, last, sweep


def scene_of(equations, values, start, duration=0.4):
    return ph.scene(ph.simulate(equations, values, start, duration), frames=41)


@pytest.mark.parametrize("name", ["rolling-disk", "gyroscope", "tennis-racquet", "tippe-top"])
def test_the_rotations_lead_to_the_body(name, run_of):
    scene = ph.scene(run_of(name), frames=31)
    (angles,) = scene.angles
    pose = scene.bodies[0].pose
    turn = np.broadcast_to(pose.turn, (31, 4))
    whole = _rotations.product(turn, about(pose.axis, pose.spin)) if len(pose.spin) else turn
    found = turned(angles, 31)[-1]
    # a quaternion and its negative are the same attitude
    assert np.abs(np.sum(found * whole, axis=1)) == pytest.approx(1, abs=1e-12)


def test_the_inclination_of_a_gyroscope_is_drawn_from_the_vertical_to_its_axle(run_of):
    scene = ph.scene(run_of("gyroscope"), frames=31)
    (angles,) = scene.angles
    arm = scene.bodies[0].pose.place - angles.vertex
    axle = arm / np.linalg.norm(arm, axis=1)[:, None]
    first, last, _ = ends(angles, 31, "θ")
    assert np.max(np.abs(first - [0, 0, 1])) < 1e-12
    assert np.max(np.abs(last - axle)) < 1e-12
    first, last, _ = ends(angles, 31, "ϕ")
    level = axle * [1, 1, 0]
    assert np.max(np.abs(first - [1, 0, 0])) < 1e-12
    assert np.max(np.abs(last - level / np.linalg.norm(level, axis=1)[:, None])) < 1e-12


def test_the_arc_of_a_disk_ends_at_its_axis_and_at_the_line_of_nodes(run_of):
    scene = ph.scene(run_of("rolling-disk"), frames=31)
    (angles,) = scene.angles
    axis = _rotations.applied(scene.bodies[0].pose.turn, np.tile([0.0, 0.0, 1.0], (31, 1)))
    _, tip, theta = ends(angles, 31, "θ")
    assert np.max(np.abs(tip - axis)) < 1e-12
    assert np.cos(theta) == pytest.approx(axis[:, 2], abs=1e-12)
    _, node, _ = ends(angles, 31, "ϕ")
    nodes = np.cross([0, 0, 1], axis)
    assert np.max(np.abs(node - nodes / np.linalg.norm(nodes, axis=1)[:, None])) < 1e-12


def test_each_angle_of_two_pendulums_ends_at_its_own_bob():
    """Both bobs hang on rods; each arc is at the point that holds its rod."""
    lab = ph.Frame("lab")
    first, second = ph.coordinate("theta_1"), ph.coordinate("theta_2")
    upper, lower = (
        ph.Body(name, mass=M, inertia=[0, 0, 0], axes=lab.rotated(angle, "y"))
        for name, angle in (("upper", first), ("lower", second))
    )
    system = ph.System(
        ph.Pivot(upper, at=upper.axes["z"] * L, force="P"),
        ph.Pivot(lower, at=lower.axes["z"] * L, to=upper.point(), name="joint"),
        ph.Gravity(G),
    )
    start = {"theta_1": 0.5, "theta_2": -0.9}
    scene = scene_of(ph.derive(system), {M: 1, L: 0.5, G: 9.81}, start)
    for angles, body, letter in zip(scene.angles, scene.bodies, "12", strict=True):
        (rotation,) = [r for r in angles.rotations if r.symbol]
        assert f"<mn>{letter}</mn>" in rotation.symbol
        place = np.broadcast_to(body.pose.place, (41, 3))
        rod = (place - angles.vertex) / 0.5
        sweep = np.outer(rotation.angle - rotation.offset, rotation.axis)
        drawn = _rotations.applied(_rotations.about(sweep), np.tile(rotation.begin, (41, 1)))
        assert np.max(np.abs(drawn - rod)) < 1e-12


def test_the_angle_on_a_sphere_is_drawn_from_its_centre_to_the_ball(run_of):
    scene = ph.scene(run_of("ball-on-sphere"), frames=31)
    (angles,) = scene.angles
    assert np.array_equal(angles.vertex, [[0, 0, 0]])
    outwards = np.broadcast_to(scene.bodies[0].pose.place, (31, 3))
    outwards = outwards / np.linalg.norm(outwards, axis=1)[:, None]
    first, _, _ = ends(angles, 31, "u")
    _, last, _ = ends(angles, 31, "v")
    assert np.max(np.abs(first - [0, 0, 1])) < 1e-12
    assert np.max(np.abs(last - outwards)) < 1e-12


def test_a_ball_without_angles_has_none(run_of):
    scene = ph.scene(run_of("marble-on-turntable"), frames=5)
    assert scene.angles == ()
    assert scene.bodies[0].labels == ()


def test_contact_forces_know_their_normal_and_the_cone_of_friction(run_of):
    rolling = ph.scene(run_of("rolling-disk"), frames=5)
    smooth = ph.scene(run_of("spinning-coin"), frames=5)
    (force,) = [arrow for arrow in rolling.arrows if arrow.kind == "force"]
    assert np.array_equal(force.normal, [[0, 0, 1]])
    assert force.friction == 0
    (force,) = [arrow for arrow in smooth.arrows if arrow.kind == "force"]
    assert force.normal.size == 0
