"""Mechanisms of the literature against Lagrange's equations by SymPy, and closed forms."""

from math import cosh, pi, sqrt

import numpy as np
import pytest
import sympy as sp
from scipy.integrate import solve_ivp

import polhode as ph
from literature.lagrange_oracle import Lagrangian

LAB = ph.Frame("lab")
X, Y, Z = LAB["x"], LAB["y"], LAB["z"]


def _rates_of_speeds(equations, numbers, names, state):
    """Accelerations of coordinates by polhode, at numbers."""
    coordinates = [ph.coordinate(name) for name in names]
    table = {**numbers, **state}
    found = []
    for q in coordinates:
        rate = equations.kinetics.on_speeds(q.dt())
        acceleration = equations.on_shell(equations.rate(rate))
        values = {s: sp.Float(table[s.published], 30) for s in acceleration.symbols()}
        found.append(
            float(ph.to_sympy(acceleration).subs({s.published: v for s, v in values.items()}))
        )
    return found


@pytest.mark.parametrize("seed", [1, 2])
def test_furuta_pendulum(seed):
    """K. Furuta, M. Yamakita, S. Kobayashi, Swing-up control of inverted pendulum (1992).

    A pendulum at the end of an arm that turns about the vertical, with a torque on the arm.
    """
    J, m, L, l, A, C, g, tau = ph.symbols("J m L l A C g tau", positive=True)
    phi, theta = ph.coordinates("phi theta")
    arm_axes = LAB.rotated(phi, "z")
    rod_axes = arm_axes.rotated(theta, "x")
    arm = ph.Body("arm", mass=m, inertia=(J, J, J), axes=arm_axes, tag="a")
    rod = ph.Body("rod", mass=m, inertia=(A, A, C), axes=rod_axes, tag="r")
    system = ph.System(
        ph.Pivot(arm, name="axle"),
        ph.Hinge(arm, axis="z"),
        ph.Pivot(rod, at=rod_axes["z"] * -l, to=arm.point(arm_axes["x"] * L), name="joint"),
        ph.Hinge(rod, axis="x", to=arm),
        ph.Torque(arm, Z * tau),
        ph.Gravity(g),
    )
    q = sp.symbols("phi theta")
    v = sp.symbols("phi_dot theta_dot")
    s = dict(
        zip(
            ["J", "m", "L", "l", "A", "C", "g", "tau"], sp.symbols("J m L l A C g tau"), strict=True
        )
    )
    f, t = q
    # centre of the rod: L e_r + l (−sin θ e_φ' … ), with e_y' = (−sin φ, cos φ, 0)
    place = sp.Matrix(
        [
            s["L"] * sp.cos(f) + s["l"] * sp.sin(t) * sp.sin(f),
            s["L"] * sp.sin(f) - s["l"] * sp.sin(t) * sp.cos(f),
            s["l"] * sp.cos(t),
        ]
    )
    velocity = place.jacobian(sp.Matrix(q)) * sp.Matrix(v)
    spin = (v[1], v[0] * sp.sin(t), v[0] * sp.cos(t))
    kinetic = s["m"] * velocity.dot(velocity) / 2 + s["J"] * v[0] ** 2 / 2
    kinetic += (s["A"] * (spin[0] ** 2 + spin[1] ** 2) + s["C"] * spin[2] ** 2) / 2
    lagrangian = kinetic - s["m"] * s["g"] * place[2]
    random = np.random.default_rng(seed)
    numbers = {name: float(random.uniform(0.5, 2)) for name in s}
    numbers["C"] = numbers["A"] / 3
    state = dict(
        zip(("phi", "theta", "phi_dot", "theta_dot"), random.uniform(-1, 1, 4), strict=True)
    )
    oracle = Lagrangian(lagrangian, q, v, forces=(s["tau"], 0))
    expected = oracle.accelerations({s[n]: x for n, x in numbers.items()}, state.values())
    found = _rates_of_speeds(ph.derive(system), numbers, ("phi", "theta"), state)
    assert np.allclose(found, expected, rtol=1e-12)


@pytest.mark.parametrize("seed", [1, 2])
def test_snakeboard(seed):
    """J. Ostrowski, A. Lewis, R. Murray, J. Burdick, Nonholonomic mechanics and locomotion (1994).

    A board with a rotor above its centre, and wheels at its ends steered by ±φ; the wheels cannot
    slip sideways.
    """
    m, J, Jr, Jw, l = ph.symbols("m J J_r J_w l", positive=True)
    theta, psi, phi = ph.coordinates("theta psi phi")
    board_axes = LAB.rotated(theta, "z")
    board = ph.Body("board", mass=m, inertia=(J, J, J), axes=board_axes)
    rotor = ph.Body(
        "rotor", mass=m, inertia=(Jr, Jr, Jr), axes=board_axes.rotated(psi, "z"), tag="r"
    )
    parts = [
        ph.Pivot(board, only="z", name="ground"),
        ph.Hinge(board, axis="z"),
        ph.Pivot(rotor, to=board.point(), name="axle"),
        ph.Hinge(rotor, axis="z", to=board),
    ]
    for sign, name in ((1, "front"), (-1, "back")):
        axes = board_axes.rotated(sign * phi, "z")
        wheel = ph.Body(name, mass=m, inertia=(Jw, Jw, Jw), axes=axes, tag=name[0])
        parts += [
            ph.Pivot(wheel, to=board.point(board_axes["x"] * (sign * l)), name=f"{name} pin"),
            ph.Hinge(wheel, axis="z", to=board, name=f"{name} hinge"),
            ph.KnifeEdge(wheel, across="y", name=f"{name} edge", force="N"),
        ]
    equations = ph.derive(ph.System(*parts))
    q = sp.symbols("x y theta psi phi")
    v = sp.symbols("x_dot y_dot theta_dot psi_dot phi_dot")
    M, B, R, W, a = sp.symbols("m J J_r J_w l")
    along = sp.Matrix([sp.cos(q[2]), sp.sin(q[2])])
    kinetic = 2 * M * (v[0] ** 2 + v[1] ** 2) / 2 + (B * v[2] ** 2 + R * (v[2] + v[3]) ** 2) / 2
    constraints = []
    for sign in (1, -1):
        centre = sp.Matrix(q[:2]) + sign * a * along
        velocity = centre.jacobian(sp.Matrix(q)) * sp.Matrix(v)
        kinetic += M * velocity.dot(velocity) / 2 + W * (v[2] + sign * v[4]) ** 2 / 2
        turned = q[2] + sign * q[4]
        constraints.append(-sp.sin(turned) * velocity[0] + sp.cos(turned) * velocity[1])
    random = np.random.default_rng(seed)
    numbers = dict(zip(("m", "J", "J_r", "J_w", "l"), random.uniform(0.5, 2, 5), strict=True))
    state = {"x": 0.3, "y": -0.2, "theta": 0.4, "psi": 0.1, "phi": 0.6}
    state |= {"psi_dot": 0.7, "phi_dot": -0.5, "theta_dot": 0.8}
    # both edges hold: v = l θ̇ cot φ along the board, none across
    speed = numbers["l"] * state["theta_dot"] / np.tan(state["phi"])
    state |= {"x_dot": speed * np.cos(0.4), "y_dot": speed * np.sin(0.4)}
    names = ("x", "y", "theta", "psi", "phi")
    oracle = Lagrangian(sp.expand(kinetic), q, v, constraints)
    ordered = [state[n] for n in names] + [state[f"{n}_dot"] for n in names]
    symbols = dict(zip((M, B, R, W, a), numbers.values(), strict=True))
    expected = oracle.accelerations(symbols, ordered)
    found = _rates_of_speeds(equations, numbers, names, state)
    assert np.allclose(found, expected, rtol=1e-10)


def test_bead_on_a_rod_turned_at_a_constant_rate():
    """Goldstein, Classical Mechanics, ch. 1: r = r₀ cosh ωt, pushed by N = 2 m ω ṙ."""
    m, J, Omega = ph.symbols("m J Omega", positive=True)
    phi = ph.coordinate("phi")
    axes = LAB.rotated(phi, "z")
    rod = ph.Body("rod", mass=m, inertia=(J, J, J), axes=axes, tag="r")
    bead = ph.Body("bead", mass=m, inertia=(0, 0, 0), axes=axes)
    parts = (
        ph.Pivot(rod, name="axle"),
        ph.Hinge(rod, axis="z"),
        ph.Motor(rod, axis="z", rate=Omega, relative_to=LAB),
        ph.Slider(bead, axis="x", along=axes, to=rod.point()),
    )
    numbers, start = {"m": 1.3, "J": 0.2, "Omega": 2.0}, {"s": 0.25}
    run = ph.simulate(ph.System(*parts), numbers, start, "1.5 s")
    assert abs(run["s"] - 0.25 * np.cosh(2 * run.t)).max() < 1e-11 * cosh(3)
    push = 2 * 1.3 * 2 * 2 * 0.25 * np.sinh(2 * run.t)
    assert abs(run["F_y"] - push).max() < 1e-10 * abs(push).max()


def test_gravity_gradient_dumbbell():
    """V. V. Beletsky, Motion of an Artificial Satellite (1966): librations with ω = √3 n."""
    m, l, k = ph.symbols("m l k", positive=True)
    r = ph.symbol("r", positive=True)
    theta = ph.coordinate("theta")
    axes = LAB.rotated(theta, "z")
    inertia = (0, 2 * m * l**2, 2 * m * l**2)
    dumbbell = ph.Body("dumbbell", mass=2 * m, inertia=inertia, axes=axes)
    ends = [
        ph.CentralForce(
            dumbbell.point(axes["x"] * (sign * l)),
            Z * 0,
            energy=-k / r,
            distance=r,
            name=f"pull {sign}",
        )
        for sign in (1, -1)
    ]
    system = ph.System(
        ph.Pivot(dumbbell, only="z", name="plane"), ph.Hinge(dumbbell, axis="z"), *ends
    )
    # n² = k/(m R³) = 1 at R = 1. A turn of 1e-2 rad swings to the other side in half a period; the
    # orbit's radius follows the turn by terms of the order (l/R)², which are 1e-6 here.
    half = pi / sqrt(3)
    start = {"x": 1, "v_y": 1, "theta": 1e-2, "theta_dot": 1}
    run = ph.simulate(system, {"m": 1, "k": 1, "l": 1e-3}, start, half)
    turned = run.final["theta"] - np.arctan2(run.final["y"], run.final["x"])
    assert abs(turned + 1e-2) < 1e-2 * 1e-3
    assert run.drift.energy < 1e-13


def test_a_load_is_hoisted_along_a_beam_that_swings():
    """A massless trolley at a given distance s(t) along the beam; Lagrange's equations by hand.

    Beam J θ̈ about a fixed axis x, hook at s (-sin θ, cos θ), centre of the load r below it along
    its axis: with Δ = θ - ψ and the velocities along and across both,
    v² = ṡ² + s²θ̇² + r²ψ̇² - 2 r ψ̇ (s θ̇ cos Δ + ṡ sin Δ).
    """
    theta, psi = ph.coordinates("theta psi")
    (s,), (reach,) = ph.coordinates("s_t"), ph.functions("L")
    m, I, J, M, g, r, w, d = ph.symbols("m I J M g r w d", positive=True)
    lab = ph.Frame("lab")
    along, hanging = lab.rotated(theta, "x"), lab.rotated(psi, "x")
    beam = ph.Body("beam", mass=M, inertia=(J, J, J), axes=along)
    load = ph.Body("load", mass=m, inertia=(I, I, I), axes=hanging, tag="2")
    trolley = ph.Body("trolley", mass=0, axes=along, tag="t")
    system = ph.System(
        ph.Pivot(beam),
        ph.Hinge(beam, axis="x"),
        ph.Slider(trolley, axis="z", to=beam.point()),
        ph.Constraint(s - reach, on=trolley),
        ph.Pivot(load, at=hanging["z"] * r, to=trolley.point(), name="hook", force="H"),
        ph.Hinge(load, axis="x", name="pin"),
        ph.Gravity(g),
    )
    values = {m: 2, I: 0.1, J: 5, M: 3, g: 9.81, r: 0.7, w: 2, d: 0.25}
    start = {theta: 0.4, psi: -0.3, theta.dt(): 0.2}
    forcing = {reach: -4 * d - d * ph.sin(w * ph.time)}
    run = ph.simulate(system, values, start, "3 s", forcing=forcing)

    def rates(t, state):
        a, b, p, q = state
        x, v, f = -1 - np.sin(2 * t) / 4, -np.cos(2 * t) / 2, np.sin(2 * t)
        c, n = np.cos(a - b), np.sin(a - b)
        mass = [[5 + 2 * x * x, -1.4 * x * c], [-1.4 * x * c, 0.1 + 2 * 0.49]]
        first = -4 * x * v * p + 1.4 * x * n * q * q + 2 * 9.81 * x * np.sin(a)
        second = 1.4 * (2 * v * c * p + f * n - x * n * p * p) - 1.4 * 9.81 * np.sin(b)
        return [p, q, *np.linalg.solve(mass, [first, second])]

    end = solve_ivp(rates, (0, 3), [0.4, -0.3, 0.2, 0], rtol=1e-12, atol=1e-13).y[:2, -1]
    assert [run.final["theta"], run.final["psi"]] == pytest.approx(end, abs=1e-8)
