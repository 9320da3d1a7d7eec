"""Forces of figures, measured on the arrows that are drawn: they obey Newton's law."""

import numpy as np
import pytest

import polhode as ph
from polhode.catalogue import PROBLEM_SET
from polhode.solution import (
    _figure_drawing,
    _figure_numbers,
    _figure_shapes,
    _figure_view,
    _setting,
)
from solution import own_systems

THETA = np.radians(58)  # of the figure


def figure_named(name):
    build = PROBLEM_SET[name].build if name in PROBLEM_SET else getattr(own_systems, name)
    return _figure_drawing.figure_of(_setting.Setting(ph.derive(build())))


def vectors(figure, style="force"):
    """Arrows from their feet, in pixels to the right and upwards, in the order they are drawn."""
    drawn = (s.points for s in figure.strokes if s.style == style)
    return [np.array([b[0] - a[0], a[1] - b[1]]) for a, *_, b in drawn]


def parallel(first, second):
    cross = first[0] * second[1] - first[1] * second[0]
    return abs(cross) < 0.02 * np.linalg.norm(first) * np.linalg.norm(second)


def test_forces_on_a_gyroscope_that_is_held_balance():
    """At both ends, equally far from the centre of mass, half of the weight."""
    figure = figure_named("gyroscope/held")
    weight, pivot, hand = vectors(figure)
    assert weight + pivot + hand == pytest.approx(np.zeros(2), abs=0.5)
    assert pivot == pytest.approx(hand, abs=0.5)
    assert pivot[0] == pytest.approx(0, abs=0.2)
    assert figure.caption == (
        "Axes, angles and forces where the motion starts from rest; lengths are not to scale."
    )


def test_light_rods_push_and_pull_along_themselves():
    figure = figure_named("double_pendulum")
    rods, (_, _, on_top, between) = vectors(figure, "rod"), vectors(figure)
    assert [parallel(on_top, rod) for rod in rods] != [parallel(between, rod) for rod in rods]
    assert all(any(parallel(force, rod) for rod in rods) for force in (on_top, between))
    figure = figure_named("spherical_pendulum")
    (rod,), (_, force) = vectors(figure, "rod"), vectors(figure)
    assert parallel(rod, force)


def test_a_pendulum_released_from_rest_is_held_as_in_textbooks():
    """α = M g l sin θ/(I + M l²), and the pivot's force is M (l α cos θ, g − l α sin θ)."""
    figure = figure_named("physical_pendulum")
    weight, force = vectors(figure)
    _, axis_3 = vectors(figure, "axis")
    tilt = np.arctan2(abs(axis_3[0]), axis_3[1])
    assert tilt == pytest.approx(np.radians(58), abs=0.01)
    turning = np.sin(tilt) / 2  # where M, g, l and I are all one
    per_weight = np.array([turning * np.cos(tilt), 1 - turning * np.sin(tilt)])
    assert np.abs(force) / -weight[1] == pytest.approx(np.abs(per_weight), abs=0.01)


def released_gyroscope():
    """Force of the pivot along ρ and z: equations of the text at rest, all parameters one."""
    rising = np.sin(THETA) / 2
    return rising * np.cos(THETA), 1 - rising * np.sin(THETA)


def released_disk():
    """Force at the contact, from the torque about it, of a disk that is released from rest.

    Axes: e to the centre up the slope of the disk, n along its axle, h horizontal; m = g = a = 1
    and 1/4 m a² about the diameter h.
    """
    e = np.array([np.cos(THETA), 0, np.sin(THETA)])
    h = np.array([0.0, 1.0, 0.0])
    torque = np.cross(e, [0, 0, -1.0])
    acceleration = np.cross(torque / 1.25, e)
    assert torque @ h == pytest.approx(np.linalg.norm(torque))
    return acceleration + np.array([0, 0, 1.0])


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("gyroscope", np.array(released_gyroscope())),
        ("rolling-disk", released_disk()[[0, 2]]),
    ],
)
def test_reactions_are_those_of_a_release_from_rest(name, expected):
    """Horizontal size and vertical component, in weights."""
    view = next(_figure_view.views_of(ph.derive(PROBLEM_SET[name].build())))
    assert view.forces.starts
    ((x, y, z),) = view.forces.reactions.values()
    assert (np.hypot(x, y), z) == pytest.approx((abs(expected[0]), expected[1]))


@pytest.mark.parametrize("name", [*PROBLEM_SET])
def test_what_falls_is_accelerated_by_what_is_drawn(name):
    """Σ F = m a of one body, its acceleration by differences of a simulated release."""
    system = PROBLEM_SET[name].build()
    equations = ph.derive(system)
    view = next(_figure_view.views_of(equations))
    if view.forces is None or not view.forces.starts or equations.functions:
        return
    state = view.state
    parameters = {s.published: state.number(ph.Expr.generator(s)) for s in equations.parameters}
    start = {q.published: state.number(ph.Expr.generator(q)) for q in equations.coordinates}
    run = ph.simulate(equations, parameters, start, 0.02)
    t = np.linspace(0, 0.02, 3)
    place = equations.kinetics.places[system.bodies[0]].express(system.root)
    path = np.array([run.evaluate(c, t) for c in place.components])
    acceleration = 2 * (path[:, 1] - path[:, 0]) / 0.01**2
    weight = [0, 0, -1.0] if system.loads else [0, 0, 0]
    force = np.sum(list(view.forces.reactions.values()), axis=0)
    assert force + weight == pytest.approx(acceleration, abs=0.01)


def test_up_is_up_and_north_is_marked_on_the_earth():
    figure = figure_named("gyrocompass")
    letters = {letter.name.plain for letter in figure.letters}
    assert {"x (up)", "y (east)", "z (north)", "λ", "Ω"} <= letters
    up = vectors(figure, "fixed")[0]
    assert up[0] == pytest.approx(0, abs=0.2)
    assert up[1] > 20
    for name in ("foucault_pendulum", "gyrocompass/motor"):
        assert any("(up)" in letter.name.plain for letter in figure_named(name).letters)


def test_the_north_is_where_the_angle_of_the_compass_begins():
    view = next(_figure_view.views_of(ph.derive(PROBLEM_SET["gyrocompass"].build())))
    (frame,) = {f for f, _ in _figure_numbers.frames_of(view.equations)}
    before, after = _figure_shapes.between(view, frame, ph.Expr.generator(*frame.angle.symbols()))
    assert before == (0, 0, 1)
    assert after == pytest.approx((0, np.sin(THETA), np.cos(THETA)))


def test_the_ball_lies_on_paper():
    figure = figure_named("ball-on-paper")
    styles = [stroke.style for stroke in figure.strokes]
    assert styles.count("paper") == styles.count("support") == 1
