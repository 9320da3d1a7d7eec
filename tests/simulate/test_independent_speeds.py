"""Motions on which the independent speeds have to change, against descriptions that are regular."""

import numpy as np
import pytest
from mpmath import mp
from scipy.integrate import solve_ivp

import polhode as ph
from derive.sleighs import sleigh
from simulate.examples import declared_four_bar

LAB = ph.Frame("lab")
NUMBERS = {"m": 1.5, "J": 0.5, "a": 0.3}


def by_velocity_along_the_blade(heading, v, turning, duration):
    """The same motion from Chaplygin's equations v̇ = a ω², ω̇ = −m a v ω/(J + m a²).

    J. Neimark, N. Fufaev, Dynamics of Nonholonomic Systems (1972), § III.4. The centre of mass
    moves with v along the blade and a ω across it.
    """
    m, J, a = (NUMBERS[name] for name in "mJa")

    def rates(t, y):
        phi, _x, _y, v, w = y
        return [
            w,
            v * np.cos(phi) - a * w * np.sin(phi),
            v * np.sin(phi) + a * w * np.cos(phi),
            a * w * w,
            -m * a * v * w / (J + m * a * a),
        ]

    start = [heading, 0.0, 0.0, v, turning]
    found = solve_ivp(rates, (0, duration), start, method="DOP853", rtol=3e-14, atol=1e-14)
    return found.y[:, -1]


def start_of(heading, v, turning):
    a = NUMBERS["a"]
    return {
        "phi": heading,
        "phi_dot": turning,
        "x_dot": v * np.cos(heading) - a * turning * np.sin(heading),
        "y_dot": v * np.sin(heading) + a * turning * np.cos(heading),
    }


@pytest.mark.parametrize("heading", [0.0, 1.3, np.pi / 2, np.pi])
def test_a_sleigh_turns_through_every_heading(heading):
    """Neither v_x nor v_y describes it everywhere: its heading passes 0°, 90°, 180°."""
    run = ph.simulate(sleigh(), NUMBERS, start_of(heading, -2.0, 3.0), "6 s")
    phi, x, y, v, turning = by_velocity_along_the_blade(heading, -2.0, 3.0, 6.0)
    assert run["phi"].max() - run["phi"].min() > 1.5 * np.pi
    assert len({segment.dynamics.equations.speeds for segment in run.segments}) == 2
    found = [run.final[name] for name in ("phi", "x", "y", "phi_dot", "x_dot")]
    along = v * np.cos(phi) - NUMBERS["a"] * turning * np.sin(phi)
    assert found == pytest.approx([phi, x, y, turning, along], abs=3e-12)
    # digits are lost where speeds are about to become singular: up to 2e-13 from other headings
    assert run.drift.energy < 5e-13


def test_speeds_are_continuous_where_others_become_independent():
    run = ph.simulate(sleigh(), NUMBERS, start_of(0.4, 0.1, -2.0), "4 s")
    seams = [segment.begin for segment in run.segments[1:]]
    assert seams
    for name in ("x_dot", "y_dot", "v_x", "phi_dot", "x_ddot", "F_y"):
        before, after = run.evaluate(name, np.array([[t - 1e-9, t + 1e-9] for t in seams])).T
        assert after == pytest.approx(before, abs=1e-6)
    # changes of speeds are no events of the motion
    assert [event.kind for event in run.events] == ["start", "end"]


def test_events_are_found_across_a_change_of_speeds():
    """x_dot vanishes where the sleigh crosses a heading at which it is no independent speed."""
    events = {"turns": ph.coordinate("x").dt()}
    start = start_of(1.0, 2.0, 1.0)
    run = ph.simulate(sleigh(), NUMBERS, start, "4 s", events=events)
    times = [event.time for event in run.events if event.kind == "turns"]
    assert times
    assert run.evaluate("x_dot", np.array(times)) == pytest.approx(np.zeros(len(times)), abs=1e-12)
    crossings = np.flatnonzero(np.diff(np.sign(run["x_dot"])))
    assert len(times) == len(crossings)


def test_a_motion_with_changed_speeds_is_saved_and_read(tmp_path):
    run = ph.simulate(sleigh(), NUMBERS, start_of(0.4, 0.1, -2.0), "4 s")
    run.save(tmp_path / "sleigh.h5")
    again = ph.load(tmp_path / "sleigh.h5")
    for name in ("phi", "x", "x_dot", "y_dot", "energy", "F_y"):
        assert again[name] == pytest.approx(run[name], abs=1e-11)
    assert len(again.segments) == len(run.segments)


def test_more_digits_go_through_the_same_positions():
    start = {"phi": "0.4", "phi_dot": "-2", "v_x": "0.1"}
    numbers = {"m": "1.5", "J": "0.5", "a": "0.3"}
    run = ph.simulate(sleigh(), numbers, start, "3 s", precision=30, samples=3)
    assert len(run.segments) > 2
    assert run.drift.energy < 1e-27
    # E = ½ m v² + ½ (J + m a²) ω² is conserved; the start in the velocity along the blade
    with mp.workdps(40):
        a = mp.mpf("0.3")
        v = (mp.mpf("0.1") + a * -2 * mp.sin(mp.mpf("0.4"))) / mp.cos(mp.mpf("0.4"))
        m, J = mp.mpf("1.5"), mp.mpf("0.5")
        # with ω = ω₀ sech: v = c tanh(k (t − t₀)), a conservative system of one degree of freedom
        c2 = v**2 + (J / m + a**2) * 4
        c, k = mp.sqrt(c2), mp.sqrt(c2) * m * a / (J + m * a**2)
        t0 = -mp.atanh(v / c) / k
        turning = -mp.sqrt(m * c2 / (J + m * a**2)) * mp.sech(k * (3 - t0))
        assert abs(run.final["phi_dot"] - turning) < mp.mpf(10) ** -28


def test_a_contact_mode_changes_its_speeds():
    """The sleigh on a runner that touches the ice in a point, which could lift off."""
    m, J, a, h, g = ph.symbols("m J a h g", positive=True)
    axes = LAB.rotated(ph.coordinate("phi"), "z")
    body = ph.Body("sleigh", mass=m, inertia=(J, J, J), axes=axes, surface=ph.Round(h, "z"))
    parts = (
        ph.Smooth(body, on=ph.Plane(LAB)),
        ph.Hinge(body, axis="z"),
        ph.KnifeEdge(body, across="y", at=axes["x"] * -a, force="K"),
        ph.Gravity(g),
    )
    numbers = NUMBERS | {"h": 0.1, "g": 9.81}
    heading, x, y = ph.coordinates("phi x y")
    along = x.dt() * ph.cos(heading) + y.dt() * ph.sin(heading)
    chosen = ph.System(*parts, speeds={"v": along, "omega": heading.dt()})
    for system, begin in ((ph.System(*parts), 1.0), (ph.System(*parts), 0.0), (chosen, 1.0)):
        run = ph.simulate(system, numbers, start_of(begin, -2.0, 3.0), "2 s")
        phi, x_end, *_ = by_velocity_along_the_blade(begin, -2.0, 3.0, 2.0)
        assert [run.final["phi"], run.final["x"]] == pytest.approx([phi, x_end], abs=1e-11)
        assert run.final["F_z"] == pytest.approx(NUMBERS["m"] * 9.81, rel=1e-12)


def test_chosen_speeds_that_do_not_determine_the_motion_are_named():
    """J = x v_y − y v_x takes the place of v_x, which it does not determine where y = 0."""
    m, R, g, k = ph.symbols("m R g k", positive=True)
    x, y = ph.coordinates("x y")
    ball = ph.sphere("ball", mass=m, radius=R, axes=LAB)
    parts = (
        ph.Smooth(ball, on=ph.Plane(LAB)),
        ph.Force(ball.point(), LAB["x"] * (-k * x) - LAB["y"] * (2 * k * y), name="springs"),
        ph.Gravity(g),
    )
    system = ph.System(*parts, speeds={"J": x * y.dt() - y * x.dt()})
    numbers = {"m": 1, "R": 0.1, "g": 9.81, "k": 5}
    start = {"x": -1, "v_x": 1, "v_y": -0.4}
    with pytest.raises(ph.NumericError, match="J do not determine v_x"):
        ph.simulate(system, numbers, start | {"y": 0.5}, "3 s")
    with pytest.raises(ph.NumericError, match=r"J of speeds=.* took its place"):
        ph.simulate(system, numbers, start | {"y": 0}, "3 s")


def steered_car(angle, **more):
    """A car on two axles, of which the front one is turned by an angle given in time."""
    m, J, a, b = ph.symbols("m J a b", positive=True)
    heading = LAB.rotated(ph.coordinate("phi"), "z")
    car = ph.Body("car", mass=m, inertia=(J, J, J), axes=heading)
    front = ph.Body("front axle", mass=0, axes=heading.rotated(angle, "z"), tag="f")
    return ph.System(
        ph.Pivot(car, only="z", name="road"),
        ph.Hinge(car, axis="z"),
        ph.KnifeEdge(car, across="y", at=heading["x"] * -b, name="rear wheels", force="R"),
        ph.Pivot(front, to=car.point(heading["x"] * a), name="king pin", force="K"),
        ph.KnifeEdge(front, across="y", name="front wheels", force="N"),
        **more,
    )


CAR = {"m": 1200, "J": 1800, "a": 1.3, "b": 1.4}
STEERED = ph.symbol("d") * ph.sin(ph.symbol("w") * ph.time)


def test_a_car_is_steered_through_straight_ahead():
    """The rate of heading determines nothing while the wheels point ahead: at the start, and later.

    With u the speed of the rear axle, φ̇ = u tan δ/(a + b), and the energy ½ (m + (J + m b²)
    tan²δ/(a + b)²) u² changes by the work of the steering alone, which has no power on a massless
    axle: u is as the root of the inverse of that inertia.
    """

    def speed(time):
        turn = np.tan(0.3 * np.sin(0.8 * time)) / 2.7
        return 5 / np.sqrt(1 + (1800 / 1200 + 1.4**2) * turn**2), turn

    def laws(time, state):
        u, turn = speed(time)
        return [u * np.cos(state[2]), u * np.sin(state[2]), u * turn]

    found = solve_ivp(laws, (0, 8), [-1.4, 0, 0], method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    x, y, phi = found + 1.4 * np.array([np.cos(found[2]), np.sin(found[2]), 0])
    run = ph.simulate(steered_car(STEERED), CAR | {"d": 0.3, "w": 0.8}, {"v_x": 5}, 8)
    assert [run.final[q] for q in ("x", "y", "phi")] == pytest.approx([x, y, phi], abs=1e-10)
    assert run.final["v_x"] == pytest.approx(
        speed(8)[0] * (np.cos(phi) - 1.4 * speed(8)[1] * np.sin(phi)), rel=1e-11
    )


@pytest.mark.parametrize("angle", [STEERED, ph.symbol("d")])
def test_a_car_goes_straight_with_a_steering_angle_of_zero(angle):
    numbers = CAR | {"d": 0} | ({"w": 1} if angle is STEERED else {})
    run = ph.simulate(steered_car(angle), numbers, {"v_x": 5}, 8)
    assert [run.final["x"], run.final["y"]] == pytest.approx([40, 0], abs=1e-12)


def test_the_rate_of_a_coordinate_names_its_speed():
    """`independent=` takes x.dt() where the speed is called v_x."""
    x, phi = ph.coordinates("x phi")
    by_rate, by_name = (
        ph.derive(steered_car(0, independent=kept)) for kept in ([x.dt()], [ph.speed("v_x")])
    )
    assert by_rate.speeds == by_name.speeds
    assert by_rate.motion == by_name.motion
    assert phi.dt().symbols().isdisjoint(by_rate.speeds)


def test_a_four_bar_linkage_turns_through_its_dead_points():
    """A crank that turns full circle: the rocker comes to rest twice in every turn.

    At every instant the linkage closes, and the energy is that of the start.
    """
    a, b, c, d = 0.6, 1.5, 1.2, 1.4
    numbers = {"m": 1.0, "a": a, "b": b, "c": c, "d": d, "g": 9.81}
    run = ph.simulate(declared_four_bar(), numbers, {"alpha": -2.0, "alpha_dot": -9.0}, "3 s")
    turned = run["alpha"]
    assert abs(turned[-1] - turned[0]) > 2 * np.pi
    rocker = run["gamma_dot"]
    assert np.count_nonzero(np.diff(np.sign(rocker))) >= 4
    assert run.drift.energy < 1e-12
    assert run.drift.constraint < 1e-12

    def place(angle, length):
        return length * np.array([np.cos(angle), -np.sin(angle)])  # turned about y from x

    for alpha, beta, gamma in zip(*(run[q][::50] for q in ("alpha", "beta", "gamma")), strict=True):
        closes = place(alpha, a) + place(beta, b) - place(gamma, c)
        assert closes == pytest.approx([d, 0.0], abs=1e-11)
