"""Systems from exercises and papers, each declared in the way of the documentation.

Oracles: Lagrange's equations with multipliers by SymPy, integrated by SciPy; closed forms.
"""

from math import cos, cosh, exp, pi, sin, sqrt

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

import polhode as ph
from literature.lagrange_oracle import Lagrangian

LAB = ph.Frame("lab")
X, Y, Z = LAB["x"], LAB["y"], LAB["z"]
m, M, R, r, g, k, I, J, a, b = ph.symbols("m M R r g k I J a b", positive=True)
theta, phi, alpha, beta = ph.coordinates("theta phi alpha beta")
G = 9.81


def integrated(laws, start, end, **more):
    return solve_ivp(laws, (0, end), start, method="DOP853", rtol=1e-11, atol=1e-12, **more)


def followed(oracle, start, end):
    """Coordinates and rates of the oracle at the end of a motion."""
    size = len(start) // 2

    def laws(_, state):
        return [*state[size:], *oracle.accelerations({}, state)]

    return integrated(laws, start, end).y[:, -1]


def speed_squared(place, coordinates, rates):
    velocity = sp.Matrix(place).jacobian(coordinates) * sp.Matrix(rates)
    return velocity.dot(velocity)


def held(body, **more):
    return ph.Pivot(body, name=f"pin of {body.name}", **more), ph.Hinge(body, axis="y")


def euler_axes():
    axes = LAB.rotated(phi, "z").rotated(theta, "x")
    return axes.rotated(ph.coordinate("psi"), "z", labels="1 2 3")


def test_a_roller_follows_an_eccentric_cam():
    """Its height e sin θ + √(R² − e² cos²θ) as a Constraint between two bodies; its force."""
    e, z = ph.symbol("e", positive=True), ph.coordinate("z_f")
    cam = ph.Body("cam", mass=M, inertia=(I, I, I), axes=LAB.rotated(theta, "y"), tag="c")
    follower = ph.point_mass("follower", mass=m, axes=LAB, tag="f")
    rises = z - e * ph.sin(theta) - ph.sqrt(R**2 - e**2 * ph.cos(theta) ** 2)
    system = ph.System(
        *held(cam),
        ph.Pivot(follower, only="x y", name="bore", force="N"),
        ph.Constraint(rises, on=(cam, follower)),
        ph.Spring(follower.point(), Z * 0, stiffness=k),
        ph.Gravity(g),
    )
    numbers = {M: 0.5, I: 0.001, m: 0.3, e: 0.02, R: 0.05, k: 200, g: G}
    run = ph.simulate(system, numbers, {theta: 0.4, "theta_dot": 30}, 1)
    q, v = sp.symbols("q v")
    height = 0.02 * sp.sin(q) + sp.sqrt(0.05**2 - (0.02 * sp.cos(q)) ** 2)
    rate = height.diff(q)
    energy = 0.0005 * v**2 + 0.15 * (rate * v) ** 2 - 0.3 * G * height - 100 * height**2
    oracle = Lagrangian(energy, [q], [v])
    angle, turning = followed(oracle, [0.4, 30], 1)
    assert run.final["theta"] == pytest.approx(angle, abs=1e-9)
    (turns,) = oracle.accelerations({}, [angle, turning])
    at = {q: angle, v: turning}
    lifted = float((rate * turns + rate.diff(q) * v**2).subs(at))
    pushed = 0.3 * (lifted + G) + 200 * float(height.subs(at))
    assert run.final["Q"] == pytest.approx(pushed, rel=1e-8)


def test_gyrostat():
    """Euler's equations with the momentum of a rotor about a skew axis, which no couple changes."""
    A, B, C, delta = *ph.symbols("A B C", positive=True), ph.symbol("delta")
    axes = euler_axes()
    hull = ph.Body("hull", mass=M, inertia=(A, B, C), axes=axes, spin=ph.Components())
    skew = axes.rotated(delta, "1", labels="4 5 6")
    spin = ph.About("6", "chi")
    rotor = ph.Body("rotor", mass=m, inertia=(I, I, J), axes=skew, spin=spin, tag="r")
    bearing = ph.Pivot(rotor, to=hull.point(axes["1"] * a)), ph.Hinge(rotor, axis="6", to=hull)
    numbers = {M: 10, m: 2, A: 1, B: 1.6, C: 2.1, I: 0.05, J: 0.09, a: 0.3, delta: 0.6}
    start = {"theta": 1, "omega_1": 0.3, "omega_2": 2, "omega_3": -0.4, "omega_6_r": 8}
    run = ph.simulate(ph.System(*bearing), numbers, start, 5)
    along, arm = np.array([0, -sin(0.6), cos(0.6)]), np.array([0.3, 0, 0])
    inertia = np.diag([1, 1.6, 2.1]) + 10 * 2 / 12 * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    inertia += 0.05 * (np.eye(3) - np.outer(along, along))
    carried = 0.09 * 8 * along

    def euler(_, w):
        return np.linalg.solve(inertia, -np.cross(w, inertia @ w + carried))

    found = integrated(euler, [0.3, 2, -0.4], 5).y[:, -1]
    assert [run.final[f"omega_{i}"] for i in "123"] == pytest.approx(found, abs=1e-9)


def test_capstan():
    """A rope over a rough drum: the tensions are as e^μπ (Euler, Eytelwein)."""
    mu, S = ph.symbol("mu"), ph.reaction("S_1")
    one = ph.point_mass("one", mass=m, axes=LAB, tag="1")
    two = ph.point_mass("two", mass=M, axes=LAB, tag="2")
    system = ph.System(
        ph.Pivot(one, to=X * -R, only="x y", name="left"),
        ph.Pivot(two, to=X * R, only="x y", name="right"),
        ph.Rope([one.point(), X * -R, X * R, two.point()], directions=[Z, X, -Z]),
        ph.Force(two.point(), Z * (S * (ph.exp(mu * ph.pi) - 1)), name="drum"),
        ph.Gravity(g),
    )
    numbers = {m: 1, M: 4, mu: 0.2, R: 0.1, g: G}
    run = ph.simulate(system, numbers, {"z_1": -1, "z_2": -1}, 0.5)
    ratio = exp(0.2 * pi)
    rise = (4 - ratio) * G / (4 + ratio)
    assert run.final["v_z_1"] == pytest.approx(rise / 2, rel=1e-13)
    assert run.final["S_1"] == pytest.approx(G + rise, rel=1e-13)


@pytest.mark.parametrize("way", ["Cartesian", "polar"])
def test_swinging_atwood_machine(way):
    """N. Tufillaro, T. Abbott, D. Griffiths, Am. J. Phys. 52 (1984) 895."""
    bob = ph.point_mass("bob", mass=m, axes=LAB, tag="1")
    weight = ph.point_mass("weight", mass=M, axes=LAB, tag="2")
    distance = ph.coordinate("r")
    placed = ph.Pivot(bob, only="y", name="plane")
    start = {"x_1": sin(1.2), "z_1": -cos(1.2), "z_2": -1}
    if way == "polar":
        placed = ph.Pivot(bob, to=LAB.rotated(theta, "y")["z"] * -distance, name="plane")
        start = {distance: 1, theta: -1.2, "z_2": -1}
    guide = ph.Pivot(weight, to=X * R, only="x y", name="guide", force="G")
    rope = ph.Rope([bob.point(), X * 0, X * R, weight.point()])
    system = ph.System(placed, guide, rope, ph.Gravity(g))
    run = ph.simulate(system, {m: 1, M: 3, R: 0.5, g: G}, start, 3)
    q, v = sp.symbols("r t"), sp.symbols("u w")
    energy = (4 * v[0] ** 2 + q[0] ** 2 * v[1] ** 2) / 2 + G * q[0] * (sp.cos(q[1]) - 3)
    found = followed(Lagrangian(energy, q, v), [1, 1.2, 0, 0], 3)
    assert run.final["z_2"] == pytest.approx(found[0] - 2, abs=1e-9)


def test_a_wheel_rolls_in_a_hoop_that_rolls():
    """A massless arm keeps the centres apart; a Gear with internal teeth, a Rack on the floor."""
    hoop, wheel = (
        ph.Body(n, mass=mass, inertia=(i, i, i), axes=LAB.rotated(q, "y"), tag=n[0])
        for n, mass, i, q in (("hoop", M, J, alpha), ("wheel", m, I, beta))
    )
    arm = ph.Body("arm", mass=0, axes=LAB.rotated(theta, "y"), tag="a")
    system = ph.System(
        ph.Pivot(hoop, only="y z", name="floor"),
        ph.Hinge(hoop, axis="y"),
        ph.Rack(hoop, at=Z * -R, along=X, force="Q"),
        *held(arm, to=hoop.point()),
        *held(wheel, to=arm.point(arm.axes["z"] * (r - R)), force="P"),
        ph.Gear(wheel, radius=r, to=hoop, other_radius=R, axis=Y, teeth="internal", force="G"),
        ph.Gravity(g),
    )
    numbers = {M: 2, m: 0.5, J: 1.8, I: 0.004, R: 1, r: 0.12, g: G}
    start = {"alpha": 0, "alpha_dot": 0.5, theta: 0.9, "theta_dot": 1}
    run = ph.simulate(system, numbers, start, 3)
    q, v = sp.symbols("a t"), sp.symbols("u w")
    place = q[0] - 0.88 * sp.sin(q[1]), -0.88 * sp.cos(q[1])
    turning = (v[0] - 0.88 * v[1]) / 0.12
    energy = 1.9 * v[0] ** 2 + speed_squared(place, q, v) / 4 + 0.002 * turning**2
    found = followed(Lagrangian(energy - G / 2 * place[1], q, v), [0, 0.9, 0.5, 1], 3)
    assert [run.final[n] for n in ("alpha", "theta")] == pytest.approx(found[:2], abs=1e-9)


def test_a_tricycle_with_a_free_castor():
    """Three knife edges; the two rear ones leave open how they share their force."""
    c, d = ph.symbols("c d", positive=True)
    heading = LAB.rotated(phi, "z")
    steering = heading.rotated(beta, "z")
    frame = ph.Body("frame", mass=m, inertia=(I, I, I), axes=heading)
    fork = ph.Body("fork", mass=M, inertia=(J, J, J), axes=steering, tag="f")
    rear = heading["x"] * -b
    system = ph.System(
        ph.Pivot(frame, only="z", name="floor"),
        ph.Hinge(frame, axis="z"),
        ph.KnifeEdge(frame, across="y", at=rear + heading["y"] * d, name="left", force="L"),
        ph.KnifeEdge(frame, across="y", at=rear - heading["y"] * d, name="right", force="R"),
        ph.Pivot(fork, to=frame.point(heading["x"] * a), name="head", force="H"),
        ph.Hinge(fork, axis="z", to=frame, torque="sigma"),
        ph.KnifeEdge(fork, across="y", at=steering["x"] * -c, name="front", force="N"),
        ph.TorsionDamper(beta, damping=k, on=(frame, fork)),
    )
    equations = ph.derive(system)
    assert set(equations.undetermined) == {"L_y", "R_y"}
    numbers = {m: 20, M: 2, I: 1.5, J: 0.05, a: 0.5, b: 0.3, c: 0.05, d: 0.2, k: 0.1}
    run = ph.simulate(equations, numbers, {beta: 0.6, "v_x": 2}, 3)
    q, v = sp.symbols("x y p s"), sp.symbols("u w o n")
    head = sp.Matrix([q[0] + sp.cos(q[2]) / 2, q[1] + sp.sin(q[2]) / 2])
    contact = head - 0.05 * sp.Matrix([sp.cos(q[2] + q[3]), sp.sin(q[2] + q[3])])
    velocity = contact.jacobian(q) * sp.Matrix(v)
    edges = (
        v[1] * sp.cos(q[2]) - v[0] * sp.sin(q[2]) - 0.3 * v[2],
        velocity[1] * sp.cos(q[2] + q[3]) - velocity[0] * sp.sin(q[2] + q[3]),
    )
    energy = 10 * (v[0] ** 2 + v[1] ** 2) + 0.75 * v[2] ** 2
    energy += speed_squared(head, q, v) + 0.025 * (v[2] + v[3]) ** 2
    names = ("x", "y", "phi", "beta", "v_x", "v_y", "phi_dot", "beta_dot")
    oracle = Lagrangian(energy, q, v, edges, forces=[0, 0, 0, -0.1 * v[3]])
    found = followed(oracle, [float(run.evaluate(n, 0.0)) for n in names], 3)
    assert [run.final[n] for n in names] == pytest.approx(found, abs=1e-8)


def test_a_ball_rolls_in_a_turning_tube():
    """On a massless carriage: with I = 2 m r²/5 it moves out as cosh(√(5/7) Ω t)."""
    Omega = ph.symbol("Omega", positive=True)
    tube = LAB.rotated(Omega * ph.time, "z")
    carriage = ph.Body("carriage", mass=0, axes=tube, tag="c")
    ball = ph.Body("ball", mass=m, inertia=(2 * m * r**2 / 5,) * 3, axes=tube.rotated(alpha, "y"))
    system = ph.System(
        ph.Slider(carriage, axis="x", along=tube, name="tube", force="S"),
        ph.Pivot(ball, to=carriage.point(), name="centre"),
        ph.Hinge(ball, axis="y", to=carriage, torque="sigma"),
        ph.Constraint("s_c - r*alpha = 0", on=(carriage, ball), where={"r": r}),
        ph.Gravity(g),
    )
    run = ph.simulate(system, {m: 1, r: 0.02, Omega: 3, g: G}, {"s_c": 0.1}, 1)
    assert run.final["s_c"] == pytest.approx(0.1 * cosh(3 * sqrt(5 / 7)), rel=1e-12)


def test_a_ball_rolls_on_a_fixed_sphere():
    """Kept at rest at the point of contact by a Hold; Newton and Euler by SciPy."""
    axes = LAB.rotated(phi, "z").rotated(theta, "y", labels="1 2 3")
    ball = ph.sphere("ball", mass=m, radius=r, axes=axes)
    system = ph.System(
        ph.Pivot(ball, to=axes["3"] * (R + r), along=axes, name="sphere", force="N"),
        ph.Hold(ball, at=axes["3"] * -r, along=axes, only="1 2"),
        ph.Gravity(g),
    )
    start = {theta: 0.3, "phi_dot": 1, "omega_3": 5}
    run = ph.simulate(system, {m: 1, R: 1, r: 0.2, g: G}, start, 0.8)
    weight = np.array([0, 0, -G])

    def laws(_, state):
        n, w = np.split(state, 2)
        moving = 0.2 * np.cross(w, n)
        turning = 0.2 * np.cross(w, moving / 1.2) - weight
        across = np.eye(3) - np.outer(n, n)
        spins = np.linalg.solve(np.eye(3) + 2.5 * across, -12.5 * np.cross(n, turning))
        return np.concatenate([moving / 1.2, spins])

    n = np.array([sin(0.3), 0, cos(0.3)])
    w = np.cross(n, [0, 1.2 * sin(0.3), 0]) / 0.2 + 5 * n
    found = integrated(laws, [*n, *w], 0.8).y[:3, -1]
    directions = axes["3"].express(LAB).components
    assert [run.evaluate(c, 0.8) for c in directions] == pytest.approx(found, abs=1e-9)


def test_suslovs_body():
    """ω · e = 0 with products of inertia (G. K. Suslov 1902): two equations by hand."""
    A, B, C, D, E = ph.symbols("A B C D E")
    inertia = [[A, 0, D], [0, B, E], [D, E, C]]
    body = ph.Body("body", mass=M, inertia=inertia, axes=euler_axes(), spin=ph.Components())
    system = ph.System(ph.Pivot(body), ph.Constraint("omega_3 = 0", on=body))
    numbers = {M: 1, A: 2, B: 1.5, C: 1.8, D: 0.3, E: -0.2}
    run = ph.simulate(system, numbers, {"theta": 1, "omega_1": 1, "omega_2": 0.4}, 15)

    def laws(_, w):
        momentum = 0.3 * w[0] - 0.2 * w[1]  # about the third axis
        return [-w[1] * momentum / 2, w[0] * momentum / 1.5]

    found = integrated(laws, [1, 0.4], 15).y[:, -1]
    assert [run.final["omega_1"], run.final["omega_2"]] == pytest.approx(found, abs=1e-9)


def test_a_masse_shot_on_a_tilted_table():
    """Slip and rolling of a ball that spins about all axes; by SciPy while it slips."""
    tilt, mu = ph.symbols("epsilon mu")
    cloth = ph.Plane(LAB, tilt=tilt)
    ball = ph.sphere("ball", mass=m, radius=r, axes=cloth.axes)
    system = ph.System(ph.Coulomb(ball, on=cloth, mu=mu), ph.Gravity(g))
    numbers = {m: 0.17, r: 0.0286, mu: 0.2, tilt: 0.05, g: G}
    start = {"v_x": 1.5, "v_y": 0.3, "omega_x": 60, "omega_y": -40, "omega_z": 80}
    run = ph.simulate(system, numbers, start, 2)
    weight, pressed = np.array([0, -G * sin(0.05)]), G * cos(0.05)

    def slip(state):
        return state[2:4] + 0.0286 * np.array([-state[5], state[4]])

    def laws(_, state):
        along = slip(state)
        friction = -0.2 * pressed * along / np.linalg.norm(along)
        spins = 2.5 / 0.0286 * np.array([friction[1], -friction[0]])
        return np.concatenate([state[2:4], weight + friction, spins])

    def vanishes(_, state):
        return np.linalg.norm(slip(state)) - 1e-8

    vanishes.terminal = True
    slid = integrated(laws, [0, 0, 1.5, 0.3, 60, -40], 2, events=vanishes)
    (sticks,) = (event.time for event in run.events if event.kind == "sticks")
    assert sticks == pytest.approx(slid.t[-1], abs=1e-7)
    left, last = 2 - slid.t[-1], slid.y[:, -1]
    place = last[:2] + last[2:4] * left + 5 / 7 * weight * left**2 / 2
    assert [run.final["x"], run.final["y"]] == pytest.approx(place, abs=1e-7)
    assert run.final["omega_z"] == 80


@pytest.mark.parametrize("spin", [None, ph.Components()])
def test_a_bar_slides_through_a_ring(spin):
    """In any attitude; from the declared angular velocities as from the rates of the angles.

    Seen from the ring, the bar has its distance s along itself as coordinate: Lagrange's equations.
    """
    h = ph.symbol("h")
    A, B, C = ph.symbols("A B C", positive=True)
    axes = euler_axes()
    bar = ph.Body("bar", mass=m, inertia=(A, B, C), axes=axes, spin=spin)
    ring = ph.Pivot(bar, to=Z * h, along=axes, only="1 2", name="ring")
    numbers = {m: 1, A: 0.4, B: 0.4, C: 0.2, g: G, h: 0.6}
    start = {phi: 0.3, theta: 0.9, "theta_dot": 0.5, "phi_dot": 0.7, "psi_dot": 1.0, "v_z": 0.2}
    run = ph.simulate(ph.System(ring, ph.Gravity(g)), numbers, start, 0.6)
    q, v = sp.symbols("p t x s"), sp.symbols("o n w u")
    energy = 0.2 * (v[1] ** 2 + (v[0] * sp.sin(q[1])) ** 2)
    energy += 0.1 * (v[2] + v[0] * sp.cos(q[1])) ** 2
    energy += (v[3] ** 2 + q[3] ** 2 * (v[1] ** 2 + (v[0] * sp.sin(q[1])) ** 2)) / 2
    energy -= G * q[3] * sp.cos(q[1])
    along = axes["3"].express(LAB).components
    x, y, z = ph.coordinates("x y z")
    distance = along[0] * x + along[1] * y + along[2] * (z - h)
    begin = [float(run.evaluate(e, 0.0)) for e in (phi, theta, "psi", distance)]
    begin += [float(run.evaluate(e, 0.0)) for e in ("phi_dot", "theta_dot", "psi_dot")]
    sliding = along[0] * x.dt() + along[1] * y.dt() + along[2] * z.dt()
    found = followed(Lagrangian(energy, q, v), [*begin, float(run.evaluate(sliding, 0.0))], 0.6)
    ends = [run.evaluate(e, 0.6) for e in (phi, theta, "psi", distance)]
    assert ends == pytest.approx(found[:4], abs=1e-9)
