"""Motions through attitudes at which their angles are singular, against rotations without any."""

import numpy as np
import pytest
from mpmath import mp
from scipy.integrate import solve_ivp

import polhode as ph
from polhode.catalogue import CATALOGUE
from polhode.derive import automaton
from polhode.study import Final, ensemble

LAB = ph.Frame("lab")
TOP = {"M": 0.5, "l": 0.06, "g": 9.81, "A": 6.25e-4, "C": 3.5e-4}
SPIN = 200.0


def heavy_top(kind):
    """A symmetric top on its tip, described by the nutation frame, by rates or by components."""
    M, l, g, A, C = ph.symbols("M l g A C", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    nutating = LAB.rotated(phi, "z").rotated(theta, "x", labels="1 2 3")
    spins = {"components": ph.Components(), "spin": ph.About("3")}
    axes = nutating if kind == "spin" else nutating.rotated(psi, "3")
    spin = spins.get(kind, ph.WithAxes())
    body = ph.Body("top", mass=M, inertia=(A, A, C), axes=axes, spin=spin)
    turning, nodding, spinning = (q.dt() for q in (phi, theta, psi))
    along = {"n": turning * ph.cos(theta) + spinning}
    chosen = {
        "chosen": along
        | {
            "p": turning * ph.sin(theta) * ph.sin(psi) + nodding * ph.cos(psi),
            "q": turning * ph.sin(theta) * ph.cos(psi) - nodding * ph.sin(psi),
        },
        "momenta": {
            "L_3": C * along["n"],
            "L_z": (A + M * l**2) * turning * ph.sin(theta) ** 2 + C * along["n"] * ph.cos(theta),
        },
        "sum": {"s": turning + spinning},
    }
    speeds = chosen.get(kind, {})
    pivot = ph.Pivot(body, at=axes["3"] * -l)
    return ph.System(pivot, ph.Gravity(g), name="heavy top", speeds=speeds)


def start_of_top(kind, theta, turning):
    """A start at φ = ψ = 0 without nutation, with a precession."""
    if kind == "spin":
        return {"theta": theta, "phi_dot": turning, "omega_3": SPIN}
    if kind not in ("spin", "components"):
        spinning = SPIN - turning * np.cos(theta)
        return {"theta": theta, "phi_dot": turning, "psi_dot": spinning}
    across = turning * np.sin(theta)
    return {"theta": theta, "omega_1": 0.0, "omega_2": across, "omega_3": SPIN}


def turning_towards_the_vertical(theta, excess):
    """A precession with which the axle comes close to the vertical: L·z is almost C ω₃."""
    moment = TOP["A"] + TOP["M"] * TOP["l"] ** 2
    return TOP["C"] * SPIN * (1 - np.cos(theta)) / (moment * np.sin(theta) ** 2) * (1 + excess)


def axis_of_top(theta, turning, times):
    """The direction n of the axle, from A' n × n̈ + C ω₃ ṅ = −M g l n × z in 30 digits.

    F. Klein, A. Sommerfeld, Über die Theorie des Kreisels (1897). There are no angles in it, and
    of the spin only its momentum.
    """
    with mp.workdps(30):
        value = {name: mp.mpf(float(number)) for name, number in TOP.items()}
        moment = value["A"] + value["M"] * value["l"] ** 2
        spin, weight = value["C"] * mp.mpf(SPIN), value["M"] * value["g"] * value["l"]

        def cross(p, q):
            return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]

        def rates(t, y):
            n, v = list(y[:3]), list(y[3:])
            couple = [weight * c for c in cross(n, [0, 0, -1])]
            across = [c - spin * w for c, w in zip(couple, v, strict=True)]  # A' n × n̈
            square = sum(w * w for w in v)
            turned = cross(across, n)  # (n × n̈) × n = n̈ + |ṅ|² n
            return v + [a / moment - square * w for a, w in zip(turned, n, strict=True)]

        theta, turning = mp.mpf(theta), mp.mpf(turning)
        start = [0, -mp.sin(theta), mp.cos(theta), mp.sin(theta) * turning, 0, 0]
        solution = mp.odefun(rates, 0, [mp.mpf(x) for x in start])
        return [list(solution(mp.mpf(float(time))))[:3] for time in times]


KINDS = ["spin", "rates", "components", "chosen", "momenta", "sum"]


@pytest.mark.parametrize("kind", KINDS)
def test_a_heavy_top_whose_axle_passes_through_the_vertical(kind):
    """With L·z = C ω₃ it passes at a distance of rounding, where φ jumps by π."""
    theta = 0.6
    turning = turning_towards_the_vertical(theta, 0.0)
    run = ph.simulate(heavy_top(kind), TOP, start_of_top(kind, theta, turning), "0.32 s")
    (axis,) = axis_of_top(theta, turning, [0.32])
    tilt, heading = run.final["theta"], run.final["phi"]
    found = [np.sin(tilt) * np.sin(heading), -np.sin(tilt) * np.cos(heading), np.cos(tilt)]
    assert found == pytest.approx([float(x) for x in axis], abs=1e-12)
    assert tilt > 0
    assert run.drift.energy < 1e-13
    assert not run.doubt
    assert all(np.isfinite(run[name]).all() for name in ("phi", "theta", "psi", "energy"))


@pytest.mark.parametrize("kind", KINDS)
def test_a_heavy_top_whose_axle_passes_close_to_the_vertical(kind):
    """It passes 2e-5 rad from the vertical, where its angles turn by half a turn within 4 µs."""
    theta = 0.6
    turning = turning_towards_the_vertical(theta, 2.424e-5)
    run = ph.simulate(heavy_top(kind), TOP, start_of_top(kind, theta, turning), "0.32 s")
    fine = np.linspace(0.147, 0.150, 300_001)
    closest = run.evaluate("theta", fine).min()
    assert closest == pytest.approx(2e-5, rel=1e-3)
    times = np.array([0.14, 0.16, 0.32])
    for time, axis in zip(times, axis_of_top(theta, turning, times), strict=True):
        tilt, heading = (run.evaluate(name, time) for name in ("theta", "phi"))
        with mp.workdps(30):
            exact = mp.atan2(mp.hypot(axis[0], axis[1]), axis[2])
            around = mp.atan2(axis[0], -axis[1])
            assert abs(mp.mpf(float(tilt)) - exact) < 1e-12
            assert abs(mp.sin(mp.mpf(float(heading)) - around)) < 1e-12
    assert run.drift.energy < 1e-13
    assert not run.doubt


# -- an asymmetric body, against its rotation matrix -----------------------------------------------

BRICK = {"m": 1.2, "I_1": 0.4, "I_2": 0.7, "I_3": 1.0}
SEQUENCES = {"313": "z x z", "321": "z y x", "123": "x y z", "212": "y x y"}


def brick(sequence, *, rates=False, **load):
    """A free body with three different moments, turned by successive rotations."""
    m, I_1, I_2, I_3 = ph.symbols("m I_1 I_2 I_3", positive=True)
    axes = LAB
    for angle, axis in zip(("phi", "theta", "psi"), SEQUENCES[sequence].split(), strict=True):
        axes = axes.rotated(ph.coordinate(angle), axis)
    spin = ph.WithAxes() if rates else ph.Components()
    body = ph.Body("brick", mass=m, inertia=(I_1, I_2, I_3), axes=axes, spin=spin)
    parts = [ph.Torque(body, axes["z"] * -load["brake"], name="brake")] if load else []
    return ph.System(ph.Pivot(body), *parts, name="brick")


def turn(axis, angle):
    """The matrix of a rotation about a coordinate axis."""
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = np.eye(3)
    matrix[i, i] = matrix[j, j] = np.cos(angle)
    matrix[j, i] = np.sin(angle)
    matrix[i, j] = -matrix[j, i]
    return matrix


def matrix_of(sequence, angles):
    matrix = np.eye(3)
    for axis, angle in zip(SEQUENCES[sequence].split(), angles, strict=True):
        matrix = matrix @ turn(axis, angle)
    return matrix


def by_rotation_matrix(matrix, omega, duration, brake=0.0):
    """Euler's equations with Ṙ = R [ω]×: no angles."""
    moments = np.array([BRICK[f"I_{k}"] for k in (1, 2, 3)])

    def rates(t, y):
        turned, w = y[:9].reshape(3, 3), y[9:]
        cross = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
        couple = np.array([0.0, 0.0, -brake])
        return [*(turned @ cross).ravel(), *((couple - np.cross(w, moments * w)) / moments)]

    start = [*matrix.ravel(), *omega]
    found = solve_ivp(rates, (0, duration), start, method="DOP853", rtol=5e-14, atol=1e-15)
    return found.y[:9, -1].reshape(3, 3), found.y[9:, -1]


def near_pole(sequence, distance):
    """Angles at which a body is at a distance from gimbal lock, in rad."""
    pole = 0.0 if sequence in ("313", "212") else np.pi / 2
    return (0.7, pole - distance, -0.4)


@pytest.mark.parametrize("sequence", SEQUENCES)
@pytest.mark.parametrize("distance", [1e-3, 1e-9])
def test_a_tumbling_body_goes_through_gimbal_lock(sequence, distance):
    """It starts beside the pole, and tumbles through others later."""
    angles, omega = near_pole(sequence, distance), (1.3, 0.8, 2.1)
    start = dict(zip(("phi", "theta", "psi"), angles, strict=True))
    start |= {f"omega_{label}": w for label, w in zip("xyz", omega, strict=True)}
    run = ph.simulate(brick(sequence), BRICK, start, "12 s")
    matrix, speeds = by_rotation_matrix(matrix_of(sequence, angles), omega, 12.0)
    found = [run.final[f"omega_{label}"] for label in "xyz"]
    assert found == pytest.approx(speeds, abs=1e-12)
    final = [run.final[name] for name in ("phi", "theta", "psi")]
    # the start fixes the attitude to rounding, whatever the angles
    assert matrix_of(sequence, final) == pytest.approx(matrix, abs=2e-12)
    assert run.drift.energy < 1e-14


@pytest.mark.parametrize("distance", [1e-2, 1e-9])
def test_velocities_along_a_body_through_gimbal_lock(distance):
    """Six chosen speeds of a body with a thrust along it, as in the mechanics of flight."""
    m, I_1, I_2, I_3, k = ph.symbols("m I_1 I_2 I_3 k", positive=True)
    axes = LAB
    for angle, axis in (("phi", "z"), ("theta", "y"), ("psi", "x")):
        axes = axes.rotated(ph.coordinate(angle), axis)
    body = ph.Body("body", mass=m, inertia=(I_1, I_2, I_3), axes=axes, spin=ph.WithAxes())
    velocity = sum(
        (LAB[q] * ph.coordinate(q).dt() for q in "yz"), LAB["x"] * ph.coordinate("x").dt()
    )
    speeds = dict(zip("uvw", velocity.express(axes).components, strict=True))
    speeds |= dict(zip("pqr", axes.angular_velocity.express(axes).components, strict=True))
    thrust = ph.Force(body.point(), axes["x"] * k, name="thrust")
    angles, omega, moving = near_pole("321", distance), (1.3, 0.8, 2.1), np.array([0.3, 0.2, -0.5])
    first = matrix_of("321", angles)
    start = dict(zip(("phi", "theta", "psi"), angles, strict=True))
    start |= dict(zip("uvwpqr", [*(first.T @ moving), *omega], strict=True))
    run = ph.simulate(ph.System(body, thrust, speeds=speeds), {**BRICK, "k": 0.7}, start, "6 s")

    def rates(t, y):
        turned, w = y[:9].reshape(3, 3), y[9:12]
        cross = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
        moments = np.array([BRICK[f"I_{k}"] for k in (1, 2, 3)])
        turning = -np.cross(w, moments * w) / moments
        return [*(turned @ cross).ravel(), *turning, *y[15:], *(turned[:, 0] * 0.7 / BRICK["m"])]

    before = [*first.ravel(), *omega, 0, 0, 0, *moving]
    found = solve_ivp(rates, (0, 6), before, method="DOP853", rtol=5e-14, atol=1e-15).y[:, -1]
    final = [run.final[name] for name in ("phi", "theta", "psi")]
    matrix = matrix_of("321", final)
    assert matrix.ravel() == pytest.approx(found[:9], abs=5e-13)
    assert [run.final[q] for q in "pqr"] == pytest.approx(found[9:12], abs=5e-13)
    assert [run.final[q] for q in "xyz"] == pytest.approx(found[12:15], abs=1e-12)
    assert matrix @ [run.final[q] for q in "uvw"] == pytest.approx(found[15:], abs=1e-12)
    assert not run.doubt


@pytest.mark.parametrize("rates", [True, False])
def test_angular_momentum_is_conserved_through_the_pole(rates):
    """A body that tumbles from far away past the pole, in rates of angles and in components."""
    angles, omega = (0.3, 1.0, 0.2), np.array([-1.0, 0.22, 0.02])
    start = dict(zip(("phi", "theta", "psi"), angles, strict=True))
    system = brick("313", rates=rates)
    if rates:
        sines = np.sin(angles[2]), np.cos(angles[2]), np.sin(angles[1]), np.cos(angles[1])
        phi_dot = (omega[0] * sines[0] + omega[1] * sines[1]) / sines[2]
        theta_dot = omega[0] * sines[1] - omega[1] * sines[0]
        start |= {"phi_dot": phi_dot, "theta_dot": theta_dot}
        start |= {"psi_dot": omega[2] - phi_dot * sines[3]}
    else:
        start |= {f"omega_{label}": w for label, w in zip("xyz", omega, strict=True)}
    equations = ph.derive(system)
    momentum = equations.angular_momentum().express(LAB).components
    watched = dict(zip(("L_x", "L_y", "L_z"), momentum, strict=True))
    run = ph.simulate(system, BRICK, start, "20 s", invariants=watched, samples=2001)
    assert np.min(np.abs(np.sin(run["theta"]))) < 0.02
    assert run.drift.energy < 1e-12
    assert max(run.drift.invariants.values()) < 1e-11
    matrix, _ = by_rotation_matrix(matrix_of("313", angles), omega, 20.0)
    final = [run.final[name] for name in ("phi", "theta", "psi")]
    assert matrix_of("313", final) == pytest.approx(matrix, abs=5e-12)


def test_the_work_of_a_brake_is_counted_through_the_pole():
    k = ph.symbol("k", positive=True)
    angles, omega = near_pole("321", 1e-4), (0.5, 2.0, 1.0)
    start = dict(zip(("phi", "theta", "psi"), angles, strict=True))
    start |= {f"omega_{label}": w for label, w in zip("xyz", omega, strict=True)}
    run = ph.simulate(brick("321", brake=k), {**BRICK, "k": 0.05}, start, "8 s")
    matrix, speeds = by_rotation_matrix(matrix_of("321", angles), omega, 8.0, 0.05)
    assert [run.final[f"omega_{label}"] for label in "xyz"] == pytest.approx(speeds, abs=1e-12)
    final = [run.final[name] for name in ("phi", "theta", "psi")]
    assert matrix_of("321", final) == pytest.approx(matrix, abs=2e-12)
    assert run.drift.energy < 1e-13
    assert abs(run.final["energy"] - run["energy"][0]) > 0.01


def test_angles_stay_continuous():
    """They turn fast beside the pole, but do not jump; the second one does not change its sign."""
    theta = 0.6
    turning = turning_towards_the_vertical(theta, 1e-3)
    run = ph.simulate(heavy_top("spin"), TOP, start_of_top("spin", theta, turning), "2 s")
    times = np.linspace(0, 2, 400_001)
    for name in ("phi", "theta", "psi"):
        steps = np.abs(np.diff(run.evaluate(name, times)))
        assert steps.max() < 0.3
    assert run.evaluate("theta", times).min() > 0
    # where the motion goes over to other angles, and back, the rates are the same on both sides
    seams = [part.begin for part in run.segments[0].parts[1:]]
    assert len(seams) > 10
    for name in ("theta_dot", "phi_dot", "theta_ddot"):
        before, after = run.evaluate(name, np.array([[t - 1e-12, t + 1e-12] for t in seams])).T
        assert after == pytest.approx(before, rel=1e-7, abs=1e-6)


def test_events_are_found_beside_the_pole():
    """The closest approach: θ̇ vanishes within microseconds of the steepest turn of φ."""
    theta = 0.6
    turning = turning_towards_the_vertical(theta, 1e-4)
    start, rate = start_of_top("spin", theta, turning), ph.coordinate("theta").dt()
    events = {"turns back": rate}
    run = ph.simulate(heavy_top("spin"), TOP, start, "0.5 s", events=events)
    times = np.array([event.time for event in run.events if event.kind == "turns back"])
    assert run.evaluate("theta_dot", times) == pytest.approx(np.zeros(len(times)), abs=1e-8)
    tilts = run.evaluate("theta", times)
    # one oscillation takes 0.297 s: the axle is beside the vertical twice
    assert tilts[tilts < 0.1] == pytest.approx([8.25e-5, 8.25e-5], rel=0.01)


def test_a_motion_through_gimbal_lock_is_saved_and_read(tmp_path):
    theta = 0.6
    turning = turning_towards_the_vertical(theta, 1e-3)
    run = ph.simulate(heavy_top("spin"), TOP, start_of_top("spin", theta, turning), "0.4 s")
    run.save(tmp_path / "top.h5")
    again = ph.load(tmp_path / "top.h5")
    for name in ("phi", "theta", "psi", "theta_dot", "energy"):
        assert again[name] == pytest.approx(run[name], rel=1e-9, abs=1e-9)


def test_a_pendulum_that_swings_through_the_pole_keeps_its_plane():
    """Without precession the angles are regular: the tilt changes its sign, as it always did."""
    m, l, g = ph.symbols("m l g", positive=True)
    phi, theta = ph.coordinates("phi theta")
    axes = LAB.rotated(phi, "z").rotated(theta, "x").rotated(ph.coordinate("psi"), "z")
    body = ph.Body("bob", mass=m, inertia=(m * l**2 / 10,) * 3, axes=axes)
    system = ph.System(ph.Pivot(body, at=axes["z"] * l), ph.Gravity(g))
    start = {"phi": 0.4, "theta": 1.0}
    run = ph.simulate(system, {"m": 1, "l": 0.5, "g": 9.81}, start, "3 s")
    assert run["theta"].min() == pytest.approx(-1.0, abs=1e-3)
    assert run["phi"] == pytest.approx(np.full(1001, 0.4), abs=1e-14)


def test_two_bodies_pass_the_pole_at_different_times():
    """Each as if it were alone."""
    m, J_1, J_3 = ph.symbols("m J_1 J_3", positive=True)
    systems, starts = [], []
    bodies = []
    for k, tag in enumerate("ab"):
        axes = LAB
        for angle, axis in (("phi", "z"), ("theta", "x"), ("psi", "z")):
            axes = axes.rotated(ph.coordinate(f"{angle}_{tag}"), axis)
        moments = (J_1, 2 * J_1, J_3)
        body = ph.Body(
            f"body {tag}", mass=m, inertia=moments, axes=axes, spin=ph.Components(), tag=tag
        )
        bodies.append(ph.Pivot(body, name=f"pivot {tag}"))
        systems.append(ph.System(bodies[-1]))
        starts.append(
            {
                f"theta_{tag}": 0.3 + 0.1 * k,
                f"omega_x_{tag}": -1.0,
                f"omega_y_{tag}": 1e-5,
                f"omega_z_{tag}": 0.7,
            }
        )
    numbers = {"m": 1.0, "J_1": 0.4, "J_3": 0.9}
    both = ph.simulate(ph.System(*bodies), numbers, starts[0] | starts[1], "10 s")
    for tag, system, start in zip("ab", systems, starts, strict=True):
        alone = ph.simulate(system, numbers, start, "10 s")
        for name in (f"phi_{tag}", f"theta_{tag}", f"psi_{tag}"):
            assert both.final[name] == pytest.approx(alone.final[name], abs=1e-10)


@pytest.mark.parametrize("kind", ["spin", "rates", "components"])
def test_a_top_is_started_upright(kind):
    """With a push, at θ = 0: Klein and Sommerfeld's equation for its axis has no singularity."""
    start = {"spin": {"omega_3": SPIN}, "rates": {"psi_dot": SPIN}, "components": {"omega_3": SPIN}}
    push = {"omega_1": 1.5} if kind == "components" else {"theta_dot": 1.5}
    run = ph.simulate(heavy_top(kind), TOP, {"theta": 0} | start[kind] | push, "0.3 s")
    moment = TOP["A"] + TOP["M"] * TOP["l"] ** 2

    def rates(t, y):
        n, v = y[:3], y[3:]
        couple = TOP["M"] * TOP["g"] * TOP["l"] * np.cross(n, [0, 0, -1.0])
        across = couple - TOP["C"] * SPIN * v
        return [*v, *(np.cross(across, n) / moment - (v @ v) * n)]

    # φ = 0: the axis moves along −y, since θ turns it about x
    exact = solve_ivp(
        rates, (0, 0.3), [0, 0, 1, 0, -1.5, 0], method="DOP853", rtol=3e-14, atol=1e-15
    )
    tilt, heading = run.final["theta"], run.final["phi"]
    found = [np.sin(tilt) * np.sin(heading), -np.sin(tilt) * np.cos(heading), np.cos(tilt)]
    assert found == pytest.approx(exact.y[:3, -1], abs=1e-12)
    assert run.drift.energy < 1e-13


@pytest.mark.parametrize("theta", [0, ph.pi])
def test_a_sleeping_top_stays_asleep_with_its_angles_as_they_were_started(theta):
    """Only φ ± ψ is determined on the vertical; φ goes on at the rate it was given."""
    start = {"theta": theta, "omega_3": SPIN, "phi": 0.3, "phi_dot": 2, "psi": 0.1}
    run = ph.simulate(heavy_top("spin"), TOP, start, "2 s")
    assert np.abs(np.sin(run["theta"])).max() < 1e-13
    assert np.abs(run["phi"] - (0.3 + 2 * run.t)).max() < 1e-14
    rate = SPIN - 2 * np.cos(run["theta"][0])
    assert np.abs(run["psi"] - (0.1 + rate * run.t)).max() < 1e-12
    assert run["psi_dot"] == pytest.approx(rate, abs=1e-12)
    assert run.drift.energy < 1e-15


def test_a_motion_in_more_digits_says_what_it_lost():
    """It is integrated in the declared angles, with more digits than are lost in them."""
    theta = 0.6
    turning = turning_towards_the_vertical(theta, 1e-8)
    start = start_of_top("spin", theta, turning)
    with pytest.warns(ph.DriftWarning, match="within 8.[0-9]e-09 rad of gimbal lock"):
        run = ph.simulate(heavy_top("spin"), TOP, start, "0.2 s", precision=25, samples=3)
    rough = ph.simulate(heavy_top("spin"), TOP, start, "0.2 s", samples=3)
    assert not rough.doubt
    for name in ("theta", "phi", "psi"):
        assert float(run.final[name]) == pytest.approx(rough.final[name], abs=1e-12)


def test_a_load_on_the_second_angle_costs_digits_and_says_so():
    """A torsion spring needs the angle itself: the motion stays in the declared angles."""
    kappa = ph.symbol("kappa", positive=True)
    system = heavy_top("rates")
    theta, (top,) = 0.6, system.bodies
    spring = ph.TorsionSpring(ph.coordinate("theta"), stiffness=kappa, on=top)
    parts = (*system.elements, *system.loads, spring)
    start = start_of_top("rates", theta, turning_towards_the_vertical(theta, 1e-3))
    with pytest.warns(ph.DriftWarning, match="of gimbal lock .* digits of the angles are lost"):
        ph.simulate(ph.System(*parts), {**TOP, "kappa": 1e-6}, start, "0.2 s")


def test_a_sliding_ball_in_three_angles_against_the_same_ball_without_any():
    m, r, I, g = ph.symbols("m r I g", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = LAB.rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    numbers = {"m": 1, "r": 0.1, "I": 4e-3, "g": 9.81}

    def run(axes, start, **spin):
        shape = ph.Round(r, axes.labels[2])
        ball = ph.Body("b", mass=m, inertia=(I, I, I), axes=axes, surface=shape, **spin)
        system = ph.System(ph.Coulomb(ball, on=ph.Plane(LAB), mu=0.1), ph.Gravity(g))
        return ph.simulate(system, numbers, {"v_x": 0.5, "v_y": 0, **start}, "1 s").final

    near = {"theta": 1e-4, "theta_dot": -3, "phi_dot": 0.001, "psi_dot": 0}
    turning = {"omega_x": -3, "omega_y": 0, "omega_z": 0.001}
    exact = run(LAB, turning, spin=ph.Free())
    for found in (run(axes, near), run(axes, near, spin=ph.Components())):
        for name in ("x", "y", "v_x", "v_y"):
            assert found[name] == pytest.approx(exact[name], abs=1e-13)


def test_a_contact_on_the_second_angle_cannot_go_on_and_names_gimbal_lock():
    """A torsion spring needs the angle itself: the contact modes keep the declared angles."""
    m, r, g, kappa, *moments = ph.symbols("m r g kappa I_1 I_2 I_3", positive=True)
    axes = LAB
    for angle, axis in (("phi", "z"), ("theta", "x"), ("psi", "z")):
        axes = axes.rotated(ph.coordinate(angle), axis)
    ball = ph.Body("b", mass=m, inertia=moments, axes=axes, surface=ph.Round(r, "z"))
    spring = ph.TorsionSpring(ph.coordinate("theta"), stiffness=kappa, on=ball)
    system = ph.System(ph.Coulomb(ball, on=ph.Plane(LAB), mu=0.1), spring, ph.Gravity(g))
    numbers = {"m": 1, "r": 0.1, "g": 9.81, "kappa": 1e-3, "I_1": 4e-3, "I_2": 4e-3, "I_3": 4e-3}
    start = {"theta": 1e-4, "theta_dot": -3, "phi_dot": 0.001, "psi_dot": 0, "v_x": 0.5}
    with pytest.raises(ph.NumericError, match=r"gimbal lock; .* spin=ph\.Components\(\)"):
        ph.simulate(system, numbers, start, "1 s")


def test_members_of_a_sweep_go_through_gimbal_lock():
    """Side by side they stay in the declared angles: those that come near are integrated alone."""
    theta, excesses = 0.6, np.array([0.5, 1e-3, 2.424e-5, 0.3])
    turnings = [turning_towards_the_vertical(theta, excess) for excess in excesses]
    start = {"theta": theta, "phi_dot": np.array(turnings), "omega_3": SPIN}
    outputs = {"theta": Final("theta"), "phi": Final("phi")}
    found = ensemble(automaton(heavy_top("spin")), TOP, start, 0.2, outputs=outputs)
    assert found.failed == 0
    for k, turning in enumerate(turnings):
        run = ph.simulate(heavy_top("spin"), TOP, start_of_top("spin", theta, turning), 0.2)
        for name in outputs:
            assert found[name][k] == pytest.approx(run.final[name], abs=1e-12)


def test_the_gyroscope_of_the_catalogue_against_its_two_tilts():
    """cos θ = cos α cos β, from the vertical on; the pivot's forces are along turning axes."""
    numbers = {"M": 0.5, "a": 0.06, "I_1": 6.25e-4, "I_2": 3.5e-4, "g": 9.81}
    steep = CATALOGUE["gyroscope"].build()
    upright = CATALOGUE["gyroscope/upright"].build()
    runs = [
        ph.simulate(steep, numbers, {"theta": 0, "theta_dot": 1.2, "omega_1": 150}, "1 s"),
        ph.simulate(upright, numbers, {"alpha_dot": 1.2, "omega_1": 150}, "1 s"),
    ]
    height = np.cos(runs[1]["alpha"]) * np.cos(runs[1]["beta"])
    assert np.cos(runs[0]["theta"]) == pytest.approx(height, abs=1e-12)
    assert runs[0]["F_z"][1:] == pytest.approx(runs[1]["F_z"][1:], rel=1e-8)
    assert runs[0].drift.energy < 1e-13
