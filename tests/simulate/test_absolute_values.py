"""Absolute values in loads, against motions that are known in closed form."""

from math import atan2, cos, cosh, hypot, log, pi, sqrt, tanh

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import polhode as ph
from polhode import DeclarationError, NumericError, absolute
from polhode.simulate import Experiment

m, k, g, mu, c = ph.symbols("m k g mu c", positive=True)
x, y = ph.coordinates("x y")
v = x.dt()
lab = ph.Frame("N")
SLIP = v / absolute(v)


def along(force, direction=None) -> ph.System:
    """A point mass on a straight line under a force along it."""
    body = ph.point_mass("p", mass=m, axes=lab)
    load = ph.Force(body.point(), lab["x"] * force)
    return ph.System(load, ph.Pivot(body, only="y z"), name="point")


def times(run, kind="changes sign"):
    return [event.time for event in run.events if event.kind == kind]


# -- a force with a corner -------------------------------------------------------------------------


FLOOR = along(k * (absolute(-x) - x) / 2 - m * g)
"""Gravity, and a floor at x = 0 that pushes back like a spring."""


def bounces(gravity, stiffness, height):
    """Time of the fall, time in the floor, and depth in it: free fall, then an oscillation."""
    w, deep = sqrt(stiffness), gravity / stiffness
    fall = sqrt(2 * height / gravity)
    speed = gravity * fall
    return fall, 2 * (pi - atan2(speed / w, deep)) / w, deep + hypot(deep, speed / w)


@pytest.mark.parametrize("stiffness", [30.0, 1e4, 1e6])
def test_a_ball_bounces_on_a_floor_like_a_spring(integrator, stiffness):
    run = ph.simulate(FLOOR, {"m": 1, "g": 9.81, "k": stiffness}, {"x": 1}, 5, samples=20001)
    fall, inside, depth = bounces(9.81, stiffness, 1.0)
    found, period = times(run), 2 * fall + inside
    expected = [fall + n * period + share for n in range(9) for share in (0, inside)]
    assert found == pytest.approx(expected[: len(found)], abs=2e-12)
    assert len(found) == sum(t < 5 for t in expected)
    bottom = run.evaluate("x", fall + inside / 2)
    assert bottom == pytest.approx(-depth, rel=1e-12)
    assert run["x"].max() == pytest.approx(1, abs=1e-11)
    assert run.drift.energy < 2e-12
    assert run.doubt == ""


@pytest.mark.parametrize("precision", [None, 30])
def test_requested_events_where_sides_change_are_seen_once(precision):
    values = {"m": 1, "g": 9.81, "k": 1000}
    asked = {"ground": x, "within": x + 0.01, "turns": v}
    run = ph.simulate(FLOOR, values, {"x": 1}, 5, events=asked, precision=precision)
    changes = [float(t) for t in times(run)]
    assert [float(t) for t in times(run, "ground")] == pytest.approx(changes, abs=1e-15)
    assert len(times(run, "within")) == 10
    assert len(times(run, "turns")) == 9  # every half period; at rest at the start it does not turn


@pytest.mark.parametrize("held", ["x y", "y"])
def test_an_elastic_rope_is_slack_where_it_is_short(held):
    """It begins to pull at the length l: |r − l| of the distance r = √(x² + y² + z²)."""
    r, l = ph.symbols("r l", positive=True)
    body = ph.point_mass("p", mass=m, axes=lab)
    stretch = (r - l + absolute(r - l)) / 2
    rope = ph.CentralForce(body.point(), lab.zero, energy=k * stretch**2 / 2, distance=r)
    system = ph.System(ph.Pivot(body, only=held), rope, ph.Gravity(g))
    run = ph.simulate(system, {"m": 1, "g": 9.81, "k": 200, "l": 1}, {"z": -0.8}, 2)
    fall, inside, depth = bounces(9.81, 200, 0.2)
    expected = [fall, fall + inside, 3 * fall + inside, 3 * fall + 2 * inside]
    assert times(run)[:4] == pytest.approx(expected, abs=1e-11)
    assert run.evaluate("z", fall + inside / 2) == pytest.approx(-1 - depth, rel=1e-12)
    assert run.drift.energy < 1e-12


def test_the_same_ball_upside_down():
    body = ph.point_mass("p", mass=m, axes=lab)
    down = -x
    force = -(k * (absolute(-down) - down) / 2 - m * g)
    mirrored = ph.System(ph.Force(body.point(), lab["z"] * force), ph.Pivot(body, to=lab["z"] * x))
    values = {"m": 1, "g": 9.81, "k": 500}
    run, other = (
        ph.simulate(FLOOR, values, {"x": 1}, 3),
        ph.simulate(mirrored, values, {"x": -1}, 3),
    )
    assert other["x"] == pytest.approx(-run["x"], abs=1e-12)


def test_a_bounce_runs_backwards():
    values = {"m": 1, "g": 9.81, "k": 500}
    there = ph.simulate(FLOOR, values, {"x": 1}, 2.2)
    start = {"x": there.final["x"], "x_dot": -there.final["x_dot"]}
    back = ph.simulate(FLOOR, values, start, 2.2)
    assert back.final["x"] == pytest.approx(1, abs=1e-12)
    assert back.final["x_dot"] == pytest.approx(0, abs=1e-11)


def test_drag_turns_with_the_velocity(integrator):
    run = ph.simulate(
        along(-m * g - c * absolute(v) * v), {"m": 2, "g": 10, "c": 0.3}, {"x_dot": 30}, 6
    )
    limit = sqrt(20 / 0.3)
    rise = limit / 10 * np.arctan(30 / limit)
    assert times(run) == pytest.approx([rise], abs=1e-13)
    assert run.final["x_dot"] == pytest.approx(-limit * tanh((6 - rise) * 10 / limit), abs=1e-12)
    top = limit**2 / 20 * log(1 + (30 / limit) ** 2)
    fallen = limit**2 / 10 * log(cosh((6 - rise) * 10 / limit))
    assert run.final["x"] == pytest.approx(top - fallen, abs=1e-11)


def test_a_start_on_the_corner(integrator):
    run = ph.simulate(along(-m * g - c * absolute(v) * v), {"m": 2, "g": 10, "c": 0.3}, {}, 6)
    limit = sqrt(20 / 0.3)
    assert run.final["x_dot"] == pytest.approx(-limit * tanh(60 / limit), abs=1e-12)
    assert times(run) == []


def test_bars_within_bars():
    run = ph.simulate(along(-k * absolute(absolute(x) - 1) * x), {"m": 2, "k": 3}, {"x": 2}, 10)
    assert [run.evaluate("x", t) for t in times(run)][:5] == pytest.approx([1, 0, -1, -1, 0])
    assert run.drift.energy < 1e-13


def test_a_corner_of_time():
    system = along(c * absolute(ph.sin(ph.time)))
    run = ph.simulate(system, {"m": 2, "c": 6}, {}, 10)
    assert times(run) == pytest.approx([pi, 2 * pi, 3 * pi], rel=1e-15)
    assert run.final["x_dot"] == pytest.approx(3 * (6 + 1 - cos(10 - 3 * pi)), abs=1e-13)


# -- a force that jumps ----------------------------------------------------------------------------


def test_a_valley_with_straight_sides(integrator):
    run = ph.simulate(along(-m * g * x / absolute(x)), {"m": 2, "g": 10}, {"x": 1}, 20)
    quarter = sqrt(2 / 10)
    expected = [quarter * (2 * n + 1) for n in range(22)]
    assert times(run) == pytest.approx(expected, abs=2e-12)
    assert run.drift.energy < 1e-12


def test_a_ball_rests_at_the_bottom_of_the_valley():
    run = ph.simulate(along(-m * g * x / absolute(x)), {"m": 2, "g": 10}, {}, 20)
    assert run.final["x"] == 0
    assert run.drift.energy == 0


def test_a_square_wave():
    wave = ph.sin(ph.time)
    run = ph.simulate(along(m * c * wave / absolute(wave)), {"m": 2, "c": 1}, {}, 10)
    assert run.final["x_dot"] == pytest.approx(4 * pi - 10, abs=1e-13)


def test_a_spring_with_dry_friction_stops_after_some_half_swings(integrator):
    run = ph.simulate(
        along(-k * x - mu * m * g * SLIP), {"m": 2, "g": 10, "k": 50, "mu": 0.1}, {"x": 1.03}, 20
    )
    loss, half = 2 * 0.1 * 20 / 50, pi / 5  # of the amplitude, and the time, of a half swing
    turns = [event for event in run.events if event.kind in ("changes sign", "stays zero")]
    amplitudes = [(-1) ** n * (1.03 - n * loss) for n in range(1, 14)]
    assert [event.time for event in turns] == pytest.approx([half * n for n in range(1, 14)])
    assert [event.state_after["x"] for event in turns] == pytest.approx(amplitudes, abs=1e-12)
    assert [event.kind for event in turns] == ["changes sign"] * 12 + ["stays zero"]
    assert run.final["x"] == pytest.approx(amplitudes[-1], abs=1e-12)
    assert run.final["x_dot"] == pytest.approx(0, abs=1e-14)
    assert run.drift.energy < 1e-12


def test_a_block_is_let_go_when_the_pull_exceeds_friction(integrator):
    system = along(c * ph.time - mu * m * g * SLIP)
    run = ph.simulate(system, {"m": 2, "g": 10, "mu": 0.1, "c": 0.5}, {}, 8)
    assert times(run, "leaves zero") == pytest.approx([4], abs=1e-14)
    assert run.final["x_dot"] == pytest.approx((8 - 4) ** 2 / 8, abs=1e-13)
    assert run.final["x"] == pytest.approx((8 - 4) ** 3 / 24, abs=1e-13)
    assert run.evaluate("x", 3.9) == pytest.approx(0, abs=1e-15)


def test_a_belt_carries_a_block_until_the_spring_pulls_it_off():
    speed = ph.symbol("V", positive=True)
    slip = v - speed
    system = along(-k * x - mu * m * g * slip / absolute(slip))
    run = ph.simulate(system, {"m": 1, "g": 10, "mu": 0.3, "k": 20, "V": 0.5}, {}, 0.8)
    # at rest on the moving belt: x = (μg/ω²)(1 − cos ωt), until the speed is that of the belt
    w = sqrt(20)
    caught = np.arcsin(0.5 / (3 / w)) / w
    place = 3 / 20 * (1 - cos(w * caught))
    assert times(run, "stays zero") == pytest.approx([caught], abs=1e-13)
    assert times(run, "leaves zero") == pytest.approx([caught + (3 / 20 - place) / 0.5], abs=1e-13)


def test_two_blocks_stop_together():
    one, two = ph.coordinates("x_1 x_2")
    p, q = (ph.point_mass(name, mass=m, axes=lab, tag=tag) for name, tag in (("p", ""), ("q", "q")))
    pull = k * (two - one)

    def rubbed(body, place, force):
        friction = mu * m * g * place.dt() / absolute(place.dt())
        return ph.Force(body.point(), lab["x"] * (force - friction), name=f"on {body.name}")

    held = (ph.Pivot(p, to=lab["x"] * one), ph.Pivot(q, to=lab["x"] * two, name="second"))
    system = ph.System(rubbed(p, one, pull), rubbed(q, two, -pull), *held)
    values = {"m": 1, "g": 10, "k": 50, "mu": 1.5}
    run = ph.simulate(system, values, {"x_1": -1, "x_2": 1}, 2)
    # each is on a spring of twice the stiffness that ends in the middle
    loss, half = 2 * 15 / 100, pi / 10
    stops = int(np.ceil((1 - loss / 2) / loss))
    assert run.final["x_2"] == pytest.approx((-1) ** stops * (1 - stops * loss), abs=1e-11)
    assert run.final["x_1"] == pytest.approx(-run.final["x_2"], abs=1e-11)
    assert all(t <= stops * half + 1e-9 for t in times(run))
    assert run.drift.energy < 1e-12


# -- what is refused -------------------------------------------------------------------------------


def test_forces_that_drive_away_from_zero_leave_the_motion_open():
    with pytest.raises(NumericError, match=r"what happens where v_x is zero, .* is not determined"):
        ph.simulate(along(m * g * SLIP), {"m": 2, "g": 1}, {}, 1)


def test_changes_without_end_are_refused():
    system = along(-m * g * x / absolute(x) - mu * m * g * SLIP)
    with pytest.raises(NumericError, match="changes sign without end near t = 4"):
        ph.simulate(system, {"m": 2, "g": 10, "mu": 0.2}, {"x": 1}, 10)


def test_a_path_with_a_corner_is_refused():
    body = ph.point_mass("p", mass=m, axes=lab)
    bent = ph.Pivot(body, to=lab["x"] * x + lab["z"] * absolute(x))
    with pytest.raises(NumericError, match="velocity that jumps where x is zero"):
        ph.simulate(ph.System(bent, ph.Gravity(g)), {"m": 1, "g": 10}, {"x": 1}, 5)


def test_a_prescribed_motion_with_a_corner_is_refused():
    (end,) = ph.functions("X")
    theta = ph.coordinate("theta")
    I, length = ph.symbols("I l", positive=True)
    axes = lab.rotated(theta, "y")
    body = ph.Body("bob", mass=m, inertia=(I, I, I), axes=axes)
    system = ph.System(ph.Pivot(body, at=axes["z"] * length, to=lab["x"] * end), ph.Gravity(g))
    values, start = {"m": 1, "g": 10, "I": 1, "l": 1}, {"theta": 0.1}
    shake = absolute(ph.sin(2 * ph.time))
    with pytest.raises(NumericError, match=r"velocity that jumps where .* is zero"):
        ph.simulate(system, values, start, 5, forcing={"X": shake})
    run = ph.simulate(system, values, start, 5, forcing={"X": shake**3})
    assert run.drift.energy < 1e-13


PLANE = lab["x"] * v + lab["y"] * y.dt()


def in_plane(force) -> ph.System:
    body = ph.point_mass("p", mass=m, axes=lab)
    return ph.System(ph.Force(body.point(), force), ph.Pivot(body, only="z"))


@pytest.mark.parametrize(
    "force", [PLANE * (-mu * m * g / PLANE.norm()), PLANE * (-mu * PLANE.norm()) - lab["y"] * m * g]
)
def test_a_length_that_vanishes_is_refused(integrator, force):
    values = {"m": 2, "g": 10, "mu": 0.1}
    with pytest.raises(NumericError, match=r"vanishes at t|cannot be continued beyond t"):
        ph.simulate(in_plane(force), values, {"x_dot": 0, "y_dot": 4}, 10)
    with pytest.raises(NumericError, match=r"vanishes at t|cannot be continued beyond t"):
        ph.simulate(
            in_plane(PLANE * (-mu * m * g / PLANE.norm())), values, {"x_dot": 3, "y_dot": 4}, 10
        )


def test_a_length_that_nearly_vanishes_is_followed(integrator):
    system = in_plane(PLANE * (-mu * PLANE.norm()) - lab["y"] * m * g)
    run = ph.simulate(system, {"m": 2, "g": 10, "mu": 0.1}, {"x_dot": 1e-3, "y_dot": 4}, 2)
    assert run.drift.energy < 1e-12


def test_departures_from_a_corner_are_refused():
    with pytest.raises(NumericError, match="small departures from a state at which x is zero"):
        ph.linearise(along(-k * absolute(x)), {"m": 1, "k": 1}, {})
    found = ph.linearise(FLOOR, {"m": 1, "g": 10, "k": 1000}, {"x": -0.01})
    assert found.eigenvalues.imag == pytest.approx([sqrt(1000), -sqrt(1000)])


# -- wherever motions are followed -----------------------------------------------------------------


def test_members_of_an_ensemble_bounce_as_they_do_alone():
    stiffness = np.linspace(50, 5000, 9)
    asked = (
        {"x": "x", "turns": ph.EventCount("changes sign")} if hasattr(ph, "EventCount") else ["x"]
    )
    found = ph.ensemble(FLOOR, {"m": 1, "g": 9.81, "k": stiffness}, {"x": 1}, 2, outputs=asked)
    alone = [
        ph.simulate(FLOOR, {"m": 1, "g": 9.81, "k": float(s)}, {"x": 1}, 2).final["x"]
        for s in stiffness
    ]
    assert found["x"].tolist() == alone


def test_a_member_whose_spring_passes_through_its_end_is_reported():
    body = ph.point_mass("p", mass=m, axes=lab)
    spring = ph.Spring(body.point(), lab.zero, stiffness=k, length=c)
    system = ph.System(spring, ph.Pivot(body, only="z"))
    sideways = np.linspace(-1, 1, 17)
    start = {"x": 1, "y_dot": sideways}
    found = ph.ensemble(system, {"m": 2, "k": 10, "c": 0.1}, start, 5, outputs=["x"])
    assert list(found.failures) == [8]
    assert "vanishes at t" in found.failures[8]


def test_derivatives_of_a_bouncing_ball():
    values, start = {"m": 1, "g": 9.81, "k": 1000}, {"x": 1.0}
    found = ph.sensitivities(FLOOR, values, start, 2, of=["x"], by=["x"])

    def end(height):
        return ph.simulate(FLOOR, values, {"x": height}, 2).final["x"]

    difference = (end(1 + 1e-4) - end(1 - 1e-4)) / 2e-4
    assert found.derivatives["x"]["x"][0] == pytest.approx(difference, rel=1e-5)


@pytest.mark.parametrize(("precision", "digits"), [("quadruple", 31), (50, 47)])
def test_at_high_precision(integrator, precision, digits):
    many = mpmath.mp.clone() if hasattr(mpmath.mp, "clone") else mpmath.MPContext()
    many.dps = 60
    values = {"m": 1, "g": 10, "k": 100}
    run = ph.simulate(FLOOR, values, {"x": 1}, 3, precision=precision, samples=3)
    fall, deep, w = many.sqrt(many.mpf(1) / 5), many.mpf(1) / 10, many.mpf(10)
    inside = 2 * (many.pi - many.atan2(10 * fall / w, deep)) / w
    found = [many.mpf(str(t)) for t in times(run)]
    expected = [fall + n * (2 * fall + inside) + s for n in range(4) for s in (0, inside)]
    assert len(found) == sum(t < 3 for t in expected)
    assert max(abs(a - b) for a, b in zip(found, expected, strict=False)) < many.mpf(10) ** -digits
    assert run.drift.energy < 10.0**-digits


def test_friction_stops_at_high_precision():
    system = along(-k * x - mu * m * g * SLIP)
    values, start = {"m": 2, "g": 10, "k": 50, "mu": "0.1"}, {"x": "1.03"}
    run = ph.simulate(system, values, start, 20, precision="quadruple", samples=3)
    assert abs(run.final["x"] - mpmath.mpf(1) / 100) < 1e-15
    assert f"{run.final['x']}".startswith(
        ("0.0100000000000000000000000000000", "0.0099999999999999999999999999999")
    )


def test_a_ball_on_a_table_is_pushed_back_by_a_wall(integrator):
    radius = ph.symbol("s", positive=True)
    ball = ph.sphere("ball", mass=m, radius=radius, inertia=2 * m * radius**2 / 5, axes=lab)
    wall = ph.Force(ball.point(), lab["x"] * (-k * (absolute(x) + x) / 2), name="wall")
    table = ph.Coulomb(ball, on=ph.Plane(lab), mu=mu)
    system = ph.System(table, ph.Gravity(g), wall)
    values = {"m": 2, "s": 0.1, "g": 10, "k": 500, "mu": 0.2}
    run = ph.simulate(system, values, {"x": -0.5, "v_x": 2}, 4)
    # rolling into the wall: x = (v/w) sin wt with 7m/5, until 2kx/7 exceeds μmg
    w = sqrt(500 / 2.8)
    slips = 0.25 + np.arcsin(0.2 * 20 * 3.5 / 500 * w / 2) / w
    assert [(e.kind, e.before) for e in run.events[1:-1]] == [
        ("changes sign", "rolling"),
        ("slips", "rolling"),
        ("changes sign", "sliding"),
        ("sticks", "sliding"),
    ]
    assert [e.time for e in run.events[1:3]] == pytest.approx([0.25, slips], abs=1e-12)
    assert run.drift.energy < 1e-12
    fine = ph.simulate(system, values, {"x": -0.5, "v_x": 2}, 4, precision="quadruple", samples=3)
    assert [float(e.time) for e in fine.events] == pytest.approx([e.time for e in run.events])


def test_a_motion_with_a_corner_is_kept_in_a_file(tmp_path):
    pytest.importorskip("h5py")
    system = along(-k * x - mu * m * g * SLIP)
    values = {"m": 2, "g": 10, "k": 50, "mu": 0.1}
    run = ph.simulate(system, values, {"x": 0.3}, 5)
    run.save(tmp_path / "run.h5")
    again = ph.load(tmp_path / "run.h5")
    for name in ("x", "x_dot", "power", "work"):
        assert again[name] == pytest.approx(run[name], abs=1e-12)


def test_an_unknown_name_is_still_refused():
    with pytest.raises(DeclarationError):
        ph.simulate(FLOOR, {"m": 1, "g": 9.81}, {"x": 1}, 1)


# -- penalty forces that begin at a distance -------------------------------------------------------


def _two_pucks() -> ph.System:
    """Two particles in a plane that push each other apart below a distance of 2R."""
    m, radius, k, s = ph.symbols("m R k s", positive=True)
    overlap = (2 * radius - s + ph.absolute(2 * radius - s)) / 2
    lab = ph.Frame("lab")
    cue, struck = (ph.point_mass(n, mass=m, axes=lab, tag=n[0]) for n in ("cue", "object"))
    return ph.System(
        ph.Pivot(cue, only="z", name="a"),
        ph.Pivot(struck, only="z", name="b", force="G"),
        ph.CentralForce(
            cue.point(), struck.point(), energy=k * overlap**2 / 2, distance=s, name="hit"
        ),
    )


PUCKS = Experiment(_two_pucks(), 0.5)


def _pushed(t: float, q: np.ndarray) -> list[float]:
    between = q[2:4] - q[:2]
    size = np.hypot(*between)
    push = 1e5 * max(0.0, 0.0572 - size) / 0.17 * between / size
    return [*q[4:], *-push, *push]


@pytest.mark.parametrize("beside", [0.003, 0.03, 0.056])
@pytest.mark.parametrize("origin", [0.0, 100.0])
def test_pucks_that_meet_off_centre(beside: float, origin: float) -> None:
    """However much cancels in the distance, it is on the side on which the forces drive it.

    SciPy integrates the same two particles, written by hand, in short steps.
    """
    numbers = {"m": 0.17, "R": 0.0286, "k": 1e5}
    start = {"x_c": origin, "v_x_c": 2.0, "x_o": origin + 0.3, "y_o": beside, "v_x_o": 0}
    run = PUCKS.run(numbers, start)
    by_hand = solve_ivp(
        _pushed,
        [0, 0.5],
        [0, 0, 0.3, beside, 2, 0, 0, 0],
        rtol=1e-11,
        atol=1e-13,
        max_step=2e-4,
    ).y[4:, -1]
    found = [float(run.final[n]) for n in ("v_x_c", "v_y_c", "v_x_o", "v_y_o")]
    assert np.max(np.abs(np.array(found) - by_hand)) < 1e-7
    assert [event.kind for event in run.events].count("changes sign") == 2
