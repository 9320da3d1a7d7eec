"""Supports that are bodies: action and reaction, closed forms, and impacts."""

from __future__ import annotations

import numpy as np
import pytest

import polhode as ph
from simulate.supports.laws import derivative, second_derivative

M, MB, A, R, G, ALPHA, I, H, MU = ph.symbols("m M a R g alpha I h mu")
LAB = ph.Frame("N")
STEP = 2e-4


def first(run: ph.Trajectory, kind: str) -> float:
    return next(event.time for event in run.events if event.kind == kind)


def wedge_and(contact, restitution=0, **law):
    wedge = ph.Body("wedge", mass=MB, inertia=(I, I, I), axes=LAB, surface=ph.Face(H), tag="w")
    wheel = ph.disk("wheel", mass=M, radius=A, axes=LAB, axis="x", spin=ph.About("x", "phi"))
    slope = ph.Plane(wedge, tilt=ALPHA)
    return ph.System(
        wedge,
        wheel,
        ph.Smooth(wedge, on=ph.Plane(LAB)),
        contact(wheel, on=slope, restitution=restitution, **law),
        ph.Gravity(G),
    )


WEDGE = {M: 1, MB: 2, A: 0.1, G: 9.81, ALPHA: 0.5, H: 0.1, I: 1}


def test_a_cylinder_rolls_down_a_free_wedge():
    """ẍ = 2mg sin α cos α/(3(M + m) − 2m cos²α) of the wedge, by energy and momentum."""
    run = ph.simulate(wedge_and(ph.Rolling), WEDGE, {}, "1 s")
    s, c = np.sin(0.5), np.cos(0.5)
    wanted = 2 * 9.81 * s * c / (3 * 3 - 2 * c**2)
    assert run.evaluate("v_y_w", 1.0) == pytest.approx(wanted, rel=1e-13)
    assert run.doubt == ""


def test_a_block_slides_down_a_free_wedge():
    """Without friction, ẍ = mg sin α cos α/(M + m sin²α) of the wedge."""
    run = ph.simulate(wedge_and(ph.Smooth), WEDGE, {}, "1 s")
    s, c = np.sin(0.5), np.cos(0.5)
    assert run.evaluate("v_y_w", 1.0) == pytest.approx(9.81 * s * c / (2 + s * s), rel=1e-13)


@pytest.mark.parametrize("restitution", [0.0, 0.6, 1.0])
def test_two_balls_collide_not_in_line(restitution):
    """Momenta stay; e reverses the normal velocity; friction's impulse is μ times the normal one.

    With sliding throughout, as here, Stronge's coefficient is Newton's (Stronge, Impact Mechanics,
    2000, § 3: the normal impulse of balls does not depend on friction).
    """
    one = ph.sphere("one", mass=MB, radius=R, axes=LAB, tag="1")
    other = ph.sphere("other", mass=M, radius=A, axes=LAB)
    contact = ph.Coulomb(other, on=ph.Sphere(one, radius=R), mu=0.1, restitution=restitution)
    system = ph.System(one, other, contact)
    numbers = {M: 0.1, MB: 0.3, A: 0.03, R: 0.1}
    start = {"gap": 0.05, "u": 0.4, "gap_dot": -1.0, "u_dot": 2.0, "v_dot": 1.0}
    start |= {"omega_z": 7.0, "omega_x_1": 3.0, "v_x_1": 0.2}
    run = ph.simulate(system, numbers, start, "0.2 s")
    time = next(e.time for e in run.events if e.kind in ("bounces", "touches down"))
    states = []
    for segment in (run.segments[0], run.segments[1]):
        motion = segment.dynamics.equations.kinetics
        wanted = []
        for body in (one, other):
            velocity, angular = motion.velocities[body]
            for vector in (motion.places[body], velocity, angular):
                wanted += vector.express(LAB).components
        states.append(np.array(segment.values(wanted, np.array([time])))[:, 0].reshape(2, 3, 3))
    (before, after) = states
    masses, radii = np.array([0.3, 0.1]), np.array([0.1, 0.03])
    normal = (before[1, 0] - before[0, 0]) / 0.13
    impulse = 0.1 * (after[1, 1] - before[1, 1])
    assert -impulse == pytest.approx(0.3 * (after[0, 1] - before[0, 1]), abs=1e-14)
    for k, sense in ((0, 1), (1, -1)):
        inertia = 0.4 * masses[k] * radii[k] ** 2
        change = inertia * (after[k, 2] - before[k, 2])
        push = impulse if k else -impulse
        assert change == pytest.approx(np.cross(sense * radii[k] * normal, push), abs=1e-15)

    def slip(state):
        across = np.cross(state[1, 2], -0.03 * normal) - np.cross(state[0, 2], 0.1 * normal)
        return state[1, 1] - state[0, 1] + across

    approach = slip(before) @ normal
    assert slip(after) @ normal == pytest.approx(-restitution * approach, abs=1e-13)
    pressed = impulse @ normal
    along = slip(before) - approach * normal
    rubbed = impulse - pressed * normal
    assert rubbed == pytest.approx(-0.1 * pressed * along / np.linalg.norm(along), abs=1e-13)
    assert run.drift.energy < 1e-13


def two_balls(contact, **law):
    lower = ph.sphere("lower", mass=MB, radius=R, axes=LAB, tag="1")
    upper = ph.sphere("upper", mass=M, radius=A, axes=LAB)
    system = ph.System(
        lower,
        upper,
        ph.Rolling(lower, on=ph.Plane(LAB)),
        contact(upper, on=ph.Sphere(lower, radius=R), **law),
        ph.Gravity(G),
    )
    return system, lower, upper


BALLS = {M: 0.1, MB: 0.3, A: 0.03, R: 0.1, G: 9.81}
LAWS = {"rolls": (ph.Rolling, {}), "slides": (ph.Coulomb, {"mu": 0.1}), "free": (ph.Smooth, {})}


@pytest.mark.parametrize("law", LAWS)
def test_two_balls_obey_newton_and_euler_with_equal_and_opposite_forces(law):
    contact, more = LAWS[law]
    system, lower, upper = two_balls(contact, **more)
    start = {"u": 0.3, "v": 0.2, "v_dot": 1.0, "omega_z": 5.0, "v_x_1": 0.2}
    run = ph.simulate(system, BALLS, start, "0.05 s")
    assert run.drift.energy < 1e-13
    times = 0.01 + STEP * np.arange(30)
    segment = run.segments[0]
    equations = segment.dynamics.equations
    places = equations.kinetics.places
    on_upper = equations.system.element("contact")
    pushed = on_upper.on.axes.vector(
        *(equations.components.get(on_upper.component(x), 0) for x in on_upper.on.axes.labels)
    )
    held = LAB.vector(*(equations.components[f"F_{x}_1"] for x in "xyz"))
    vectors = [
        places[upper],
        places[lower],
        equations.kinetics.resolve(upper.angular_velocity),
        equations.kinetics.resolve(lower.angular_velocity),
        pushed,
        held,
    ]
    wanted = [component for v in vectors for component in v.express(LAB).components]
    found = np.array(segment.values(wanted, times)).T.reshape(len(times), 6, 3)
    high, low, spun, turned, push, hold = found.transpose(1, 0, 2)
    inner = slice(3, -3)
    fall = np.array([0, 0, -9.81])
    # the contact lies on the line of centres
    line = (low - high) / np.linalg.norm(low - high, axis=1)[:, None]
    assert np.linalg.norm(low - high, axis=1) == pytest.approx(0.13, rel=1e-14)
    assert 0.1 * second_derivative(high, STEP) == pytest.approx(
        (push + 0.1 * fall)[inner], abs=1e-6
    )
    assert 0.3 * second_derivative(low, STEP) == pytest.approx(
        (hold - push + 0.3 * fall)[inner], abs=1e-6
    )
    upper_spin = 0.4 * 0.1 * 0.03**2 * derivative(spun, STEP)
    assert upper_spin == pytest.approx(np.cross(0.03 * line, push)[inner], abs=1e-8)
    lower_spin = 0.4 * 0.3 * 0.1**2 * derivative(turned, STEP)
    torque = np.cross(-0.1 * line, -push) + np.cross(np.array([0, 0, -0.1]), hold)
    assert lower_spin == pytest.approx(torque[inner], abs=1e-7)
    slip = derivative(high - low, STEP) + np.cross(spun, 0.03 * line)[inner]
    slip += np.cross(turned, 0.1 * line)[inner]
    normal = -np.sum(push * line, axis=1)[inner, None]
    rubbed = push[inner] + normal * line[inner]
    if law == "rolls":
        assert slip == pytest.approx(np.zeros_like(slip), abs=1e-9)
    elif law == "free":
        assert np.max(np.abs(rubbed)) < 1e-15
    elif segment.mode.endswith("sliding"):
        speed = np.linalg.norm(slip, axis=1)[:, None]
        assert rubbed == pytest.approx(-0.1 * normal * slip / speed, abs=1e-8)


def test_a_ball_that_rolls_off_another_leaves_and_meets_the_floor():
    system, _, _ = two_balls(ph.Rolling)
    with pytest.warns(ph.DriftWarning, match="upper meets the support of lower"):
        run = ph.simulate(system, BALLS, {"u": 0.1}, "1 s")
    kinds = [event.kind for event in run.events]
    assert kinds == ["start", "lifts off", "upper meets the support of lower", "end"]


def test_a_particle_slides_off_a_free_hemisphere():
    """cos θ at which it leaves: (m/M) c³ − 3 (1 + m/M) c + 2 (1 + m/M) = 0 from rest at the top.

    A standard problem: by momentum along the floor and energy, with N = 0.
    """
    dome = ph.Body("dome", mass=MB, inertia=(I, I, I), axes=LAB, surface=ph.Face(H), tag="1")
    bead = ph.point_mass("bead", mass=M, axes=LAB)
    system = ph.System(
        dome,
        bead,
        ph.Smooth(dome, on=ph.Plane(LAB)),
        ph.Smooth(bead, on=ph.Sphere(dome, radius=R)),
        ph.Gravity(G),
    )
    numbers = {M: 1.0, MB: 2.0, R: 1.0, G: 9.81, H: 0.1, I: 1.0}
    theta = 0.01
    with pytest.warns(ph.DriftWarning, match="bead meets the support of dome"):
        run = ph.simulate(system, numbers, {"u": theta}, "3 s")
    found = float(np.cos(run.evaluate("u", first(run, "lifts off"))))
    share, top = 0.5, np.cos(theta)
    roots = np.roots([share, 0, -3 * (1 + share), 2 * (1 + share) * top])
    (wanted,) = (root.real for root in roots if abs(root.imag) < 1e-12 and 0 < root.real < 1)
    assert found == pytest.approx(wanted, rel=1e-12)


def test_a_saved_declaration_of_a_plane_keeps_its_form():
    """Planes at rest are written as before there were sides of bodies."""
    from polhode.model import read_declaration, write_declaration

    plain = ph.System(
        wheel := ph.sphere("ball", mass=M, radius=A, axes=LAB),
        ph.Rolling(wheel, on=ph.Plane(LAB)),
        ph.Gravity(G),
    )
    assert '"of"' not in write_declaration(plain)
    carried = wedge_and(ph.Rolling)
    text = write_declaration(carried)
    assert write_declaration(read_declaration(text)) == text


def test_a_side_must_be_at_rest_in_its_body():
    coin = ph.disk("coin", mass=M, radius=A, axes=LAB)
    with pytest.raises(ph.DeclarationError, match="symmetric about the axis of spin"):
        ph.Plane(coin, normal="x")
    ph.Plane(coin, normal="z")
    with pytest.raises(ph.DeclarationError, match="symmetric about the axis of spin"):
        ph.Cylinder(ph.sphere("ball", mass=M, radius=A, axes=LAB), radius=A)


def test_a_ball_on_a_seesaw_moves_as_with_a_rack():
    """The same machine from a massless carriage, a pivot and a rack, without a contact."""
    alpha, beta = ph.coordinates("alpha beta")
    board = ph.Body("board", mass=MB, inertia=(I, I, I), axes=LAB.rotated(alpha, "y"), tag="b")
    moments = (2 * M * R**2 / 5,) * 3
    axes = LAB.rotated(beta, "y")
    held = (ph.Pivot(board), ph.Hinge(board, axis="y"), ph.Gravity(G))
    ball = ph.Body("ball", mass=M, inertia=moments, axes=axes, surface=ph.Round(R))
    touching = ph.System(*held[:2], ph.Rolling(ball, on=ph.Plane(board)), held[2])
    carriage = ph.Body("carriage", mass=0, axes=board.axes, tag="c")
    other = ph.Body("ball", mass=M, inertia=moments, axes=axes, tag="ball")
    along, up = board.axes["x"], board.axes["z"]
    geared = ph.System(
        *held[:2],
        ph.Slider(carriage, axis="x", to=board.point(up * R), force="S", torque="T"),
        ph.Pivot(other, to=carriage.point(), name="centre", force="N"),
        ph.Hinge(other, axis="y"),
        ph.Rack(other, at=up * -R, along=along, to=board),
        held[2],
    )
    numbers = {M: 0.2, MB: 1.0, I: 0.05, R: 0.03, G: 9.81}
    one = ph.simulate(touching, numbers, {"alpha": 0.1, "x": 0.2}, "0.4 s")
    two = ph.simulate(geared, numbers, {"alpha": 0.1, "s_c": 0.2}, "0.4 s")
    assert one.evaluate("alpha", one.t) == pytest.approx(two.evaluate("alpha", two.t), abs=1e-12)
    assert one.evaluate("x", one.t) == pytest.approx(two.evaluate("s_c", two.t), abs=1e-12)
