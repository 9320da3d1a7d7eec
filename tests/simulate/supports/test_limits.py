"""Where a contact with a curved support ends is located, or refused in words."""

from __future__ import annotations

import numpy as np
import pytest

import polhode as ph

M, G, A, R, MU, OMEGA, E, W = ph.symbols("m g a R mu Omega e w")
NUMBERS = {M: 0.1, G: 9.81, A: 0.02, R: 0.2}
LAB = ph.Frame("N")
BOWL = ph.Sphere(LAB, radius=R, inside=True)
U, V = ph.coordinates("u v")


def ball(support, contact=ph.Smooth, **law):
    body = ph.sphere("ball", mass=M, radius=A, axes=support.axes)
    return ph.System(body, contact(body, on=support, **law), ph.Gravity(G))


def kinds(run: ph.Trajectory) -> list[str]:
    return [event.kind for event in run.events]


@pytest.mark.parametrize("radius", [0.2, 0.25, 1.0])
def test_a_ball_larger_than_its_bowl(radius):
    with pytest.raises(ph.ConstraintError, match="'ball' is too large for the hollow"):
        ph.simulate(ball(BOWL), {**NUMBERS, A: radius}, {U: 0.1}, "1 s")


def test_an_egg_that_turns_its_flat_side_to_the_bowl():
    """It fits while it touches near its tip: the hollow must be flatter than its side, b²/a."""
    phi, theta = ph.coordinates("phi theta")
    axes = LAB.rotated(phi, "z").rotated(theta, "x")
    b = ph.symbol("b")
    egg = ph.ellipsoid("egg", mass=M, half_axes=(A, A, b), axes=axes, spin=ph.About("3"))
    trough = ph.Cylinder(LAB, radius=R, inside=True, axis="x")
    system = ph.System(egg, ph.Smooth(egg, on=trough), ph.Gravity(G))
    numbers = {**NUMBERS, A: 0.01, b: 0.05}
    # on its side it is curved like b²/a = 0.25 > 0.2 along the trough's circle
    with pytest.raises(ph.ConstraintError, match="too large"):
        ph.simulate(system, numbers, {theta: np.pi / 2}, "1 s")
    assert ph.simulate(system, numbers, {theta: 0.3}, "0.01 s").doubt == ""


def test_a_loop_over_the_pole_of_longitude_ends_there():
    """At v = π/2 the coordinates u and v are singular: the motion is followed up to there."""
    run = ph.simulate(ball(BOWL), NUMBERS, {"v_dot": 40}, "1 s")
    assert kinds(run) == ["start", "reaches a pole", "end"]
    assert np.cos(run.evaluate(V, run.duration)) == pytest.approx(1e-3, rel=1e-9)
    assert run.drift.energy < 1e-13
    # the same loop along u passes no pole
    assert kinds(ph.simulate(ball(BOWL), NUMBERS, {"u_dot": 40}, "1 s")) == ["start", "end"]


def test_a_ball_at_the_centre_of_its_bowl_has_no_nearest_point():
    with pytest.raises(ph.ConstraintError, match="has no nearest point"):
        ph.simulate(ball(BOWL), NUMBERS, {"gap": 0.19}, "1 s")


def test_a_particle_slides_up_a_hill_to_its_point():
    alpha = ph.symbol("alpha")
    bead = ph.point_mass("bead", mass=M, axes=LAB)
    hill = ph.Cone(LAB, half_angle=alpha)
    system = ph.System(bead, ph.Smooth(bead, on=hill), ph.Gravity(G))
    numbers = {M: 0.1, G: 9.81, alpha: 1.0}
    run = ph.simulate(system, numbers, {V: 0.1, "v_dot": -2}, "1 s")
    assert kinds(run) == ["start", "reaches the apex", "end"]
    # 0.1 = 2 t − g cos α t²/2 on the way up the slope
    slope = 9.81 * np.cos(1.0)
    assert run.duration == pytest.approx((2 - np.sqrt(4 - 0.2 * slope)) / slope, rel=1e-13)
    with pytest.raises(ph.ConstraintError, match="reaches the apex"):
        ph.simulate(system, numbers, {}, "1 s")


def test_a_particle_slides_off_a_sphere():
    bead = ph.point_mass("bead", mass=M, axes=LAB)
    system = ph.System(bead, ph.Smooth(bead, on=ph.Sphere(LAB, radius=R)), ph.Gravity(G))
    run = ph.simulate(system, {M: 0.1, G: 9.81, R: 0.2}, {U: 0.01}, "2 s")
    leaves = next(event.time for event in run.events if event.kind == "lifts off")
    assert np.cos(run.evaluate(U, leaves)) == pytest.approx(2 / 3 * np.cos(0.01), rel=1e-13)


def test_a_turning_bowl_carries_its_ball():
    """A ball at rest on a slope of the bowl, in axes that turn with it, feels Ω² r.

    Rolling without spin about the normal, in steady motion at the angle u with the bowl: all
    points of contact are at rest on the bowl, and Newton's law gives Ω² (R − a) cos u = g.
    """
    turning = ph.Sphere(LAB.rotated(OMEGA * ph.time, "z"), radius=R, inside=True)
    system = ball(turning, ph.Rolling)
    angle, rate = 0.7, np.sqrt(9.81 / (0.18 * np.cos(0.7)))
    start = {U: angle, "u_dot": 0, "v_dot": 0, "omega_n": rate * np.cos(angle)}
    run = ph.simulate(system, {**NUMBERS, OMEGA: rate}, start, "0.5 s")
    assert run.drift.energy < 1e-13
    assert run.evaluate(U, run.t) == pytest.approx(angle, abs=1e-9)


def test_a_shaken_trough_is_a_pendulum_with_a_shaken_pivot():
    trough = ph.Cylinder(LAB, radius=R, inside=True, at=LAB["x"] * (E * ph.sin(W * ph.time)))
    row = ph.derive(ball(trough, ph.Rolling)).rows[0]
    accelerations = -E * W**2 * ph.sin(W * ph.time)
    # (7/5)(R − a) ü + g sin u + Ẍ cos u = 0: the trough's velocity carries the ball's spin too
    pendulum = 7 * (R - A) * U.dt().dt() + 5 * G * ph.sin(U) + 5 * accelerations * ph.cos(U)
    found = row / row.diff(U.dt().dt()) - pendulum / pendulum.diff(U.dt().dt())
    assert found.is_zero


def test_bad_supports_are_refused():
    refused = {
        "positive": lambda: ph.Sphere(LAB, radius=-1),
        "did you mean ph.Sphere": lambda: ph.Rolling(body(), on=body()),
        "across the axis": lambda: ph.Cylinder(LAB, radius=R, axis="z", zero="z"),
        "thinner than the ring": lambda: ph.Torus(LAB, radius=1, tube=2),
        "direction 'q'": lambda: ph.Cone(LAB, half_angle=A, axis="q"),
        "depends on x": lambda: ph.Sphere(LAB, radius=R, at=LAB["x"] * ph.coordinate("x")),
        "frame of a Sphere": lambda: ph.Sphere("N", radius=R),
        "another contact or joint places": second,
    }
    for words, declare in refused.items():
        with pytest.raises(ph.DeclarationError, match=words):
            declare()


def body():
    return ph.sphere("ball", mass=M, radius=A, axes=LAB)


def second():
    one = body()
    floor = ph.Smooth(one, on=ph.Plane(LAB), name="floor")
    return ph.derive(ph.System(one, floor, ph.Smooth(one, on=BOWL), ph.Gravity(G)))


def test_two_balls_in_one_bowl():
    """Each has its own coordinates; that they pass through each other is an event and a doubt."""
    balls = [ph.sphere(f"ball {k}", mass=M, radius=A, axes=LAB, tag=k) for k in "12"]
    contacts = [ph.Smooth(one, on=BOWL) for one in balls]
    system = ph.System(*balls, *contacts, ph.Gravity(G))
    with pytest.warns(ph.DriftWarning):
        run = ph.simulate(system, NUMBERS, {"u_1": 0.5, "u_2": -0.5}, "0.5 s")
    assert "ball 1 meets ball 2" in kinds(run)
    assert len(ph.scene(run).supports) == 1


def test_a_saved_motion_and_its_declaration_are_read_back(tmp_path):
    run = ph.simulate(ball(BOWL, ph.Coulomb, mu=MU), {**NUMBERS, MU: 0.1}, {U: 1.0}, "1 s")
    run.save(tmp_path / "bowl.h5")
    read = ph.load(tmp_path / "bowl.h5")
    assert read.system == run.system
    assert read.evaluate(U, 0.7) == pytest.approx(run.evaluate(U, 0.7), abs=1e-14)


def test_a_ball_that_falls_through_a_raised_table_is_noticed():
    """The table belongs to another ball, and stands at a height: there the two meet."""
    one = ph.sphere("one", mass=M, radius=A, axes=LAB, tag="1")
    other = ph.sphere("other", mass=M, radius=A, axes=LAB)
    table = ph.Plane(LAB, at=LAB["z"] * W)
    system = ph.System(one, other, ph.Smooth(one, on=table), ph.Gravity(G))
    start = {"x_1": 1.0, "z": 1.0}
    with pytest.warns(ph.DriftWarning, match="other meets the support of one"):
        run = ph.simulate(system, {M: 0.1, G: 9.81, A: 0.02, W: 0.5}, start, "1 s")
    met = next(event.time for event in run.events if "meets" in event.kind)
    assert met == pytest.approx(np.sqrt(2 * (1 - 0.52) / 9.81), rel=1e-9)
    place = run.segments[0].dynamics.equations.kinetics.places[one]
    assert run.evaluate(place.express(LAB).components[2], 0.0) == pytest.approx(0.52)


def test_a_torus_has_the_coordinates_of_each_body():
    """Whatever was read of it before: a body with a tag moves as one without."""
    tube = ph.symbol("r")
    ring = ph.Torus(LAB, radius=R, tube=tube, inside=True)
    runs = []
    for tag in ("", "2"):
        assert ring.axes["n"].dot(ring.up) == 1
        body = ph.sphere("ball", mass=M, radius=A, axes=LAB, tag=tag)
        system = ph.System(body, ph.Rolling(body, on=ring), ph.Gravity(G))
        end = f"_{tag}" if tag else ""
        start = {f"u{end}": 0.3, f"u{end}_dot": 5.0, f"v{end}": -1.0}
        run = ph.simulate(system, {**NUMBERS, tube: 0.06}, start, "1 s")
        runs.append(np.array([run.evaluate(f"{q}{end}", run.t) for q in ("u", "v")]))
    assert runs[0] == pytest.approx(runs[1], abs=1e-12)
