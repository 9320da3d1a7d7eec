"""A motion against something other than time, and its energies."""

import numpy as np
import pytest

import polhode as ph
from polhode.view import _rotations
from polhode.view._magnitudes import magnitudes_of
from polhode.view._scene_portraits import portraits_of
from polhode.view._scene_text import panels_of


def by_kind(run):
    found = {}
    for portrait in portraits_of(run, 401):
        found.setdefault(portrait.kind, []).append(portrait)
    return found


def test_a_phase_portrait_has_the_coordinate_and_its_rate(run_of):
    run = run_of("gyroscope")
    (phase,) = by_kind(run)["plane"]
    t = np.linspace(0, run.duration, 401)
    assert phase.names == ("theta", "theta_dot")
    assert phase.units == ("deg", "rad/s")
    assert phase.columns[0] == pytest.approx(np.degrees(run.evaluate("theta", t)))
    # against differences of the angle
    step = 1e-5
    rate = (run.evaluate("theta", t[1:-1] + step) - run.evaluate("theta", t[1:-1] - step)) / 2e-5
    assert phase.columns[1][1:-1] == pytest.approx(rate, abs=1e-6)


def test_a_top_stays_in_its_well_and_turns_where_it_meets_its_energy(run_of):
    run = run_of("gyroscope")
    (well,) = by_kind(run)["well"]
    places, heights = well.curve
    at = np.interp(well.columns[0], places, heights)
    bottom = float(np.min(heights))
    above = (well.level - at) / (well.level - bottom)
    assert np.min(above) > -1e-3  # the curve is drawn with straight pieces
    (phase,) = by_kind(run)["plane"]
    turning = np.argmin(np.abs(phase.columns[1]))
    assert abs(above[turning]) < 2e-3
    # energy of the tilt, (I₁ + M a²) θ̇²/2 for a uniform flywheel on a light axle
    kinetic = above * phase.columns[1].max() ** 2
    assert kinetic == pytest.approx(phase.columns[1] ** 2, abs=0.02)


def test_the_axis_on_the_sphere_has_the_inclination(run_of):
    run = run_of("gyroscope")
    (axis,) = by_kind(run)["axis"]
    scene = ph.scene(run, frames=401)
    turn = scene.bodies[axis.body].pose.turn
    directions = _rotations.applied(turn, np.tile(axis.axis, (401, 1)))
    t = np.linspace(0, run.duration, 401)
    assert directions[:, 2] == pytest.approx(np.cos(run.evaluate("theta", t)), abs=1e-12)


def test_the_momentum_seen_from_a_free_body_turned_back_is_at_rest(run_of):
    run = run_of("tennis-racquet")
    (sphere,) = by_kind(run)["sphere"]
    (pose,) = (body.pose for body in ph.scene(run, frames=401).bodies)
    momentum = _rotations.applied(pose.turn, np.array(sphere.columns).T)
    assert np.max(np.abs(momentum - momentum[0])) < 1e-12 * np.linalg.norm(momentum[0])


def test_what_stands_still_has_no_portrait(run_of):
    assert portraits_of(run_of("gyroscope/held"), 11) == ()


def test_energies_are_those_of_a_rod_on_a_nail():
    m, length, g = ph.symbols("m l g", positive=True)
    theta, lab = ph.coordinate("theta"), ph.Frame("lab")
    axes = lab.rotated(theta, "y")
    rod = ph.rod("rod", mass=m, length=length, axes=axes, axis="z")
    swing = ph.System(
        ph.Pivot(rod, at=axes["z"] * (length / 2)), ph.Hinge(rod, axis="y"), ph.Gravity(g)
    )
    run = ph.simulate(ph.derive(swing), {m: 0.2, length: 0.5, g: 9.81}, {theta: 1.2}, 2)
    panel = panels_of(run, [["theta"]], magnitudes_of(run), 301)[-1]
    assert panel.kind == "energies"
    assert [series.name for series in panel.series] == [
        "energy",
        "kinetic energy",
        "potential energy",
    ]
    total, kinetic, potential = (series.values for series in panel.series)
    t = np.linspace(0, 2, 301)
    angle, rate = run.evaluate("theta", t), run.evaluate("theta_dot", t)
    assert kinetic == pytest.approx(0.2 * 0.25 / 3 * rate**2 / 2, abs=1e-12)
    assert potential == pytest.approx(-0.2 * 9.81 * 0.25 * np.cos(angle), abs=1e-12)
    assert total == pytest.approx(kinetic + potential, abs=1e-14)


def test_energy_alone_is_shown_where_no_potential_varies(run_of):
    run = run_of("tennis-racquet")
    (panel,) = panels_of(run, [["energy"]], magnitudes_of(run), 11)
    assert panel.kind == "lines"
    assert [series.name for series in panel.series] == ["energy"]
