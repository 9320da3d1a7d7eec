"""Curved supports in scenes, stills and figures."""

from __future__ import annotations

import matplotlib.pyplot as plt
import numpy as np
import pytest

import polhode as ph

M, G, A, R, S, ALPHA = ph.symbols("m g a R r alpha")
LAB = ph.Frame("N")
NUMBERS = {"m": 0.1, "g": 9.81, "a": 0.02, "R": 0.2, "r": 0.06, "alpha": 0.6}
SUPPORTS = {
    "bowl": (ph.Sphere(LAB, radius=R, inside=True), {"u": 0.8, "v_dot": 2.0}),
    "sphere": (ph.Sphere(LAB, radius=R), {"u": 0.1}),
    "trough": (ph.Cylinder(LAB, radius=R, inside=True), {"u": 0.8}),
    "log": (ph.Cylinder(LAB, radius=R, at=LAB["z"] * R), {"u": 0.1}),
    "funnel": (ph.Cone(LAB, half_angle=ALPHA, inside=True), {"v": 0.3, "u_dot": 8.0}),
    "tube": (ph.Torus(LAB, radius=R, tube=S, inside=True), {"v": -1.0, "u_dot": 5.0}),
}


def run_on(name: str) -> ph.Trajectory:
    support, start = SUPPORTS[name]
    ball = ph.sphere("ball", mass=M, radius=A, axes=support.axes)
    system = ph.System(ball, ph.Rolling(ball, on=support), ph.Gravity(G))
    known = {p.published for p in ph.automaton(system).parameters}
    return ph.simulate(system, {n: x for n, x in NUMBERS.items() if n in known}, start, "0.4 s")


@pytest.mark.parametrize("name", SUPPORTS)
def test_the_ball_touches_the_drawn_surface_from_its_visible_side(name):
    scene = ph.scene(run_on(name))
    (support,) = scene.supports
    points = support.points.astype(float) + support.pose.place[0]
    assert np.isfinite(points).all()
    corners = (points[:-1, :-1], points[1:, :-1], points[1:, 1:], points[:-1, 1:])
    middles = np.mean(corners, axis=0).reshape(-1, 3)
    normals = np.cross(corners[2] - corners[0], corners[3] - corners[1]).reshape(-1, 3)
    place = scene.bodies[0].pose.place
    size = np.ptp(middles, axis=0).max()
    for centre in place[: len(place) // 2 : 50]:
        distances = np.linalg.norm(middles - centre, axis=1)
        nearest = np.argmin(distances)
        # on the surface up to the size of its faces, and in front of it
        assert 0.02 - 1e-3 < distances[nearest] < 0.02 + 0.1 * size
        assert np.dot(centre - middles[nearest], normals[nearest]) > 0


def test_a_still_of_a_bowl_shows_its_inside(tmp_path):
    run = run_on("bowl")
    ph.still(run, tmp_path / "bowl.png")
    pixels = plt.imread(tmp_path / "bowl.png")[..., :3]
    background = pixels[0, 0]
    drawn = np.abs(pixels - background).max(axis=-1) > 0.02
    assert 0.1 < drawn.mean() < 0.9


def test_the_path_in_a_bowl_is_seen_from_above():
    drawn = ph.figures.floor_path(run_on("bowl"))
    assert drawn.axes.get_xlabel().startswith("$x$")
    plt.close("all")
