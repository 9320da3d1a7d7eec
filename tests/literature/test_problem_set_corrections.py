"""Corrections of the problem set's claims, against derivations by SymPy that share no code with us.

Lagrange's equations for (24) and (126), Newton's and Euler's written out for (59) and (75), and the
derivative of a position for (138). What the corrections print is evaluated by a grammar of its own,
`claims.text_evaluator`.
"""

import re
from functools import cache

import numpy as np
import pytest
import sympy as sp

from catalogue.systems import equations
from judge.text_evaluator import Formula
from polhode.catalogue import problem_set
from polhode.judge import Answer, read_document
from polhode.judge._audit import ClaimChecker

t = sp.symbols("t")
m, a, g, I, I_1, I_2, I_3 = sp.symbols("m a g I I_1 I_2 I_3", positive=True)
Omega, alpha, lam = sp.symbols("Omega alpha lambda_")
theta, phi, psi = (sp.Function(name)(t) for name in ("theta", "phi", "psi"))
ANGLES = {"theta": theta, "phi": phi, "psi": psi}


@cache
def corrected(ident: str) -> str:
    document = read_document(problem_set())
    claim = document.claim(ident)
    verdict = ClaimChecker(equations).verdict(document.part_of(claim), claim, {})
    assert verdict.answer is Answer.FAILS
    assert verdict.correction is not None
    return re.sub(r"\\tag\{\d+\}|\(\d+\)\s*$|[,.]\s*$", "", verdict.correction.latex).rstrip(" ,.")


def drawn(seed: int) -> dict[str, float]:
    """Numbers for every letter, angles and their rates included."""
    random = np.random.default_rng(seed)
    names = [
        "m",
        "a",
        "g",
        "I",
        "I_1",
        "I_2",
        "I_3",
        "Omega",
        "alpha",
        "lambda_",
        "theta",
        "phi",
        "psi",
    ]
    names += [f"{angle}_{dots}" for angle in ANGLES for dots in ("dot", "ddot")]
    return dict(zip(names, random.uniform(0.3, 1.2, len(names)).tolist(), strict=True))


def number(expression: sp.Expr, values: dict[str, float]) -> float:
    """The value of a derived expression; rates are replaced from the highest order down."""
    found = sp.sympify(expression).doit()
    for order, suffix in ((2, "_ddot"), (1, "_dot"), (0, "")):
        for name, angle in ANGLES.items():
            rate = sp.diff(angle, t, order) if order else angle
            found = found.subs(rate, values[f"{name}{suffix}"])
    return float(found.subs({s: values[str(s)] for s in found.free_symbols}))


def printed(side: str, values: dict[str, float]) -> float:
    """The value of one printed side."""
    ((left, _, _),) = Formula(f"{side} = 0").sides(values)
    return float(left)


def chain(latex: str) -> list[str]:
    """The sides of a chain of equations."""
    return [side.strip() for side in re.split(r"\\approx|=", latex)]


def lagrange(lagrangian: sp.Expr, angle: sp.Expr) -> tuple[sp.Expr, sp.Expr]:
    """d/dt ∂L/∂q̇ and ∂L/∂q."""
    rate = sp.diff(angle, t)
    return sp.diff(sp.diff(lagrangian, rate), t), sp.diff(lagrangian, angle)


@pytest.mark.parametrize("seed", range(3))
def test_24_a_coin_on_ice_has_the_kinetic_energy_of_its_height(seed: int) -> None:
    thin = m * a**2 / 4
    height = a * sp.sin(theta)
    spin = sp.diff(psi, t) + sp.diff(phi, t) * sp.cos(theta)
    kinetic = (
        thin * (sp.diff(theta, t) ** 2 + sp.diff(phi, t) ** 2 * sp.sin(theta) ** 2) / 2
        + thin * spin**2
        + m * sp.diff(height, t) ** 2 / 2
    )
    momentum_rate, force = lagrange(kinetic - m * g * height, theta)
    n = drawn(seed)
    n |= {"I_1": number(thin, n), "I_3": 2 * number(thin, n), "z": number(height, n)}
    n["omega_3"] = number(spin, n)
    sides = chain(corrected("24"))
    assert len(sides) == 6
    assert printed(sides[1], n) == pytest.approx(number(momentum_rate, n), rel=1e-10)
    for side in sides[3:]:
        assert printed(side, n) == pytest.approx(number(force, n), rel=1e-10)


@pytest.mark.parametrize("seed", range(3))
def test_138_the_acceleration_of_the_centre_of_mass(seed: int) -> None:
    across, along = sp.sin(theta), sp.cos(theta)  # of axis 1, along rho and z
    position = [a * across, a * along]
    third = [-along, across]
    n = drawn(seed)
    sides = chain(corrected("138"))
    assert len(sides) == 5
    for i in (0, 1):
        units = {
            r"\frac{d\hat{\mathbf{3}}}{dt}": ("D", sp.diff(third[i], t)),
            r"\hat{\mathbf{1}}": ("U", (across, along)[i]),
            r"\hat{\mathbf{3}}": ("W", third[i]),
            r"\hat{\boldsymbol{\rho}}": ("R", sp.Integer(1 - i)),
            r"\hat{\mathbf{z}}": ("Z", sp.Integer(i)),
        }
        values = n | {letter: number(value, n) for letter, value in units.values()}
        expected = number(sp.diff(position[i], t, 2), n)
        for side in sides[1:]:
            for unit, (letter, _) in units.items():
                side = side.replace(unit, f" {letter} ")
            assert printed(side, values) == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("seed", range(3))
def test_59_gravity_pulls_the_marble_down_the_slope(seed: int) -> None:
    """Rolling on a turntable that is tilted; axis 1 is its normal, 2 points up the slope."""
    r = sp.Matrix([0, *(sp.Function(f"r{i}")(t) for i in (2, 3))])
    v, table = r.diff(t), sp.Matrix([Omega, 0, 0])
    arm = sp.Matrix([-a, 0, 0])  # from the centre to the contact
    force = sp.Matrix(sp.symbols("F1:4"))
    rate = sp.Matrix([0, *sp.symbols("A2:4")])  # the acceleration
    # The contact is carried along: v + ω × arm = Ω × r, for the part of ω across the normal.
    rolling = (table.cross(v) - rate).cross(arm) / a**2
    spin_rate = -rolling  # arm × (ω̇ × arm) = a² ω̇
    newton = m * rate - force + m * g * sp.Matrix([sp.cos(alpha), sp.sin(alpha), 0])
    euler = I * spin_rate - arm.cross(force)
    solved = sp.solve([*newton, *euler[1:]], [*rate[1:], *force], dict=True)[0]
    n = drawn(seed)
    speed, drift = np.array([0.4, -0.7]), np.array([0.3, 0.9])
    total = dict(zip(v[1:], speed + drift, strict=True))
    turned = {"T": n["Omega"], "S": 0.0}
    right = chain(corrected("59"))[1]
    for i in (0, 1):
        expected = solved[rate[1 + i]].subs(total)
        expected = float(expected.subs({s: n[str(s)] for s in expected.free_symbols}))
        turned["T"] = (-n["Omega"] * speed[1], n["Omega"] * speed[0])[i]
        turned["S"] = (-n["Omega"] * drift[1], n["Omega"] * drift[0])[i]
        text = right.replace(r"\mathbf{\Omega} \times \mathbf{v}(t)", " T ")
        text = text.replace(r"\mathbf{\Omega} \times \mathbf{v}_{\text{drift}}", " S ")
        text = text.replace(r"\hat{\mathbf{2}}", " U ")
        value = printed(text, n | turned | {"U": float(1 - i)})
        assert value == pytest.approx(expected, rel=1e-10)


@pytest.mark.parametrize("seed", range(3))
def test_75_no_moment_acts_about_the_axle_of_the_gyrocompass(seed: int) -> None:
    """L₃ changes by the rate of its own component alone, with equal moments across the axle."""
    spin = sp.Function("omega")(t)
    earth = sp.Matrix([-sp.diff(theta, t) + Omega * sp.cos(lam), 0, 0])
    earth += Omega * sp.sin(lam) * sp.Matrix([0, -sp.sin(theta), sp.cos(theta)])
    momentum = sp.diag(I_1, I_1, I_3) * (earth + sp.Matrix([0, 0, spin]))
    moment = momentum.diff(t) + earth.cross(momentum)
    n = drawn(seed) | {"omega_dot": 0.37, "omega": 0.6}
    exact = moment[2].subs(sp.diff(spin, t), n["omega_dot"]).subs(spin, n["omega"])
    left, exactly, nearly = chain(corrected("75").partition(r"\qquad")[0].rstrip(" ,"))
    assert left == "0"
    values = n | {"lambda": n["lambda_"]}
    assert printed(exactly, values) == pytest.approx(number(exact, n), rel=1e-10)
    still = number(exact.subs(sp.diff(theta, t), 0), n)
    assert printed(nearly, values) == pytest.approx(still, rel=1e-10)


def test_126_a_top_precesses_steadily_if_it_spins_fast_enough() -> None:
    spin, rate = sp.symbols("omega_1 rate", positive=True)
    across = sp.symbols("I_2p", positive=True)
    lagrangian = (
        across * (sp.diff(theta, t) ** 2 + sp.diff(phi, t) ** 2 * sp.sin(theta) ** 2) / 2
        + I_1 * (sp.diff(psi, t) + sp.diff(phi, t) * sp.cos(theta)) ** 2 / 2
        - m * g * a * sp.cos(theta)
    )
    momentum_rate, force = lagrange(lagrangian, theta)
    steady = (momentum_rate - force).subs(sp.diff(theta, t, 2), 0).subs(sp.diff(theta, t), 0)
    steady = steady.subs(sp.diff(psi, t), spin - rate * sp.cos(theta)).subs(sp.diff(phi, t), rate)
    quadratic = sp.Poly(sp.cancel(steady / sp.sin(theta)), rate)
    assert quadratic.degree() == 2
    discriminant = sp.lambdify(
        (spin, I_1, across, m, g, a, theta), quadratic.discriminant(), "numpy"
    )
    random = np.random.default_rng(1)
    letters = ["omega_1", "I_1", "I_2p", "m", "g", "r"]
    values = {letter: 10 ** random.uniform(-1, 1, 4000) for letter in letters}
    values["theta_0"] = random.uniform(0, np.pi / 2, 4000)
    exists = discriminant(*(values[letter] for letter in [*letters, "theta_0"])) > 0
    assert 0.1 < exists.mean() < 0.9
    text = corrected("126").partition(r"\qquad")[0]
    ((left, sign, right),) = Formula(text).sides(values)
    assert sign == ">"
    np.testing.assert_array_equal(left > right, exists)


# -- sentences without a number --------------------------------------------------------------------


def ring_element() -> tuple[sp.Matrix, sp.Matrix, sp.Matrix, sp.Symbol]:
    """Place, angular velocity of the carried frame, and axis 1, along fixed axes ρ, φ, z.

    At an instant at which the azimuth is zero; the element is at the angle `at` on a ring of the
    flywheel of radius a.
    """
    at = sp.symbols("at")
    axle = sp.Matrix([sp.sin(theta), 0, sp.cos(theta)])
    across = sp.Matrix([0, 1, 0])
    third = axle.cross(across)
    place = a * (sp.cos(at) * across + sp.sin(at) * third)
    return place, sp.Matrix([0, 0, sp.diff(phi, t)]), axle, at


def test_w97_the_coriolis_torque_of_a_ring_is_in_the_rates_of_theta_and_phi() -> None:
    place, turning, axle, at = ring_element()
    spin, tilt = sp.diff(psi, t), sp.diff(theta, t)
    # relative to the carried frame the wheel turns at psi' about its axle and theta' about phi
    relative = (spin * axle + tilt * sp.Matrix([0, 1, 0])).cross(place)
    torque = place.cross(-2 * m * turning.cross(relative)).dot(axle)
    whole = sp.simplify(sp.integrate(sp.expand(torque), (at, 0, 2 * sp.pi)))
    expected = 2 * sp.pi * m * a**2 * sp.diff(phi, t) * tilt * sp.sin(theta)
    assert sp.simplify(whole - expected) == 0
    assert not whole.has(spin)  # as "proportional to psi' theta' sin(theta)" would have it
    assert corrected("w97").endswith(r"= 2 \pi m r^{2} \dot{\phi} \dot{\theta} \sin \theta")


def test_w98_the_azimuthal_torque_of_a_ring_is_in_the_acceleration_of_phi() -> None:
    place, turning, axle, at = ring_element()
    torque = place.cross(-m * turning.diff(t).cross(place)).dot(axle)
    whole = sp.simplify(sp.integrate(sp.expand(torque), (at, 0, 2 * sp.pi)))
    expected = -2 * sp.pi * m * a**2 * sp.diff(phi, t, 2) * sp.cos(theta)
    assert sp.simplify(whole - expected) == 0
    assert corrected("w98").endswith(r"= -2 \pi m r^{2} \ddot{\phi} \cos \theta")


def test_w99_friction_cannot_change_the_velocity_of_any_ball() -> None:
    """Also of one with k = 1: impulse P at the lowest point, and rolling before and after."""
    k, r, p_x, p_y = sp.symbols("k r p_x p_y", real=True)
    impulse, up = sp.Matrix([p_x, p_y, 0]), sp.Matrix([0, 0, 1])
    by_torque = (-r * up).cross(impulse)  # of the impulse about the centre
    # rolling on a surface at rest: v = r omega x z, so that omega = z x v / r
    by_rolling = k * m * r**2 * up.cross(impulse / m) / r
    for ball in (sp.Rational(2, 5), sp.Rational(2, 3), 1):
        equal = sp.solve(list((by_torque - by_rolling).subs(k, ball))[:2], [p_x, p_y], dict=True)
        assert equal == [{p_x: 0, p_y: 0}]
    assert sp.simplify((by_torque - by_rolling).norm() ** 2 - r**2 * (1 + k) ** 2 * (
        p_x**2 + p_y**2
    )) == 0  # fmt: skip
    assert corrected("w99").endswith(r"= -\mathbf{r}\times\Delta\mathbf{P}")


@pytest.mark.parametrize("seed", range(3))
def test_w100_what_75_leaves_out_is_in_the_rotation_of_the_earth(seed: int) -> None:
    """The rate of ω₃ in inertial space vanishes: the spin changes as the axle turns."""
    spin = sp.Function("omega")(t)
    earth = sp.Matrix([-sp.diff(theta, t) + Omega * sp.cos(lam), 0, 0])
    earth += Omega * sp.sin(lam) * sp.Matrix([0, -sp.sin(theta), sp.cos(theta)])
    momentum = sp.diag(I_1, I_1, I_3) * (earth + sp.Matrix([0, 0, spin]))
    moment = (momentum.diff(t) + earth.cross(momentum))[2]
    (rate,) = sp.solve(moment, sp.diff(spin, t))
    assert not rate.has(spin)  # no term in omega theta'
    n = drawn(seed) | {"omega_dot": 0.0}
    _, right = chain(corrected("w100"))
    values = n | {"lambda": n["lambda_"], "omega_dot": number(rate, n)}
    assert printed(right, values) == pytest.approx(0, abs=1e-12)


def test_w101_the_force_of_milnes_analogy_acts_on_the_length_a() -> None:
    k_1, spin, r = sp.symbols("k_1 omega_1 r", positive=True)
    axle = sp.Matrix([sp.sin(theta) * sp.cos(phi), sp.sin(theta) * sp.sin(phi), sp.cos(theta)])
    torque = -k_1 * m * a**2 * spin * axle.diff(t)
    by_text = (a * axle).cross(k_1 * m * r * spin * axle.cross(axle.diff(t)))
    left = sp.simplify(by_text - torque)
    assert left != sp.zeros(3, 1)
    assert sp.simplify(left.subs(r, a)) == sp.zeros(3, 1)
    assert r"k_1 m a \omega_1" in corrected("w101")


def test_w102_a_disk_on_a_lean_with_its_centre_at_rest_is_stable() -> None:
    """By the rows for φ, θ and ω₃ of a rolling disk, from Lagrange's equations in quasi-speeds.

    With I = m a²/4 across and twice that along the axle, and the centre at height a sin θ.
    """
    tilt, spin, about = (sp.Function(n)(t) for n in ("tilt", "spin", "about"))
    fast, slope = sp.diff(tilt, t), sp.symbols("theta_0")
    # Angular momentum about the point of contact, along axes 1, 2, 3 that turn at (θ', φ' sin θ,
    # φ' cos θ); the contact moves along the ground, parallel to nothing but the velocity.
    turn = sp.Matrix([fast, about * sp.sin(tilt), about * sp.cos(tilt)])
    omega = sp.Matrix([fast, about * sp.sin(tilt), spin])
    up = sp.Matrix([0, sp.sin(tilt), sp.cos(tilt)])
    arm = sp.Matrix([0, a, 0])
    velocity = omega.cross(arm)
    own = sp.diag(1, 1, 2) * (m * a**2 / 4) * omega
    acceleration = velocity.diff(t) + turn.cross(velocity)
    balance = own.diff(t) + turn.cross(own) + arm.cross(m * (acceleration + g * up))
    rates = [sp.diff(tilt, t, 2), sp.diff(about, t), sp.diff(spin, t)]
    solved = sp.solve(list(balance), rates, dict=True)[0]
    state = [tilt, fast, about, spin]
    flow = sp.Matrix([fast, *(solved[rate] for rate in rates)])
    plain = sp.symbols("q0:4")
    back = dict(zip(state[::-1], plain[::-1], strict=True))
    back = {fast: plain[1], tilt: plain[0], about: plain[2], spin: plain[3]}
    flow = flow.subs(fast, plain[1]).subs(back)
    matrix = flow.jacobian(plain)
    rest = {
        plain[0]: slope,
        plain[1]: 0,
        plain[3]: 0,
        plain[2]: sp.sqrt(4 * g / (a * sp.sin(slope))),
    }
    assert sp.simplify(flow.subs(rest)) == sp.zeros(4, 1)
    there = sp.lambdify((slope, a, g), matrix.subs(rest))
    for angle in np.linspace(0.05, np.pi - 0.05, 40):
        exponents = np.linalg.eigvals(np.array(there(angle, 0.3, 9.81), dtype=float))
        assert np.max(exponents.real) < 1e-6
        square = 4 * 9.81 * (3 + np.sin(angle) ** 2) / (5 * 0.3 * np.sin(angle))
        assert np.max(exponents.imag) == pytest.approx(np.sqrt(square), rel=1e-9)
    document = read_document(problem_set())
    claim = document.claim("w102")
    verdict = ClaimChecker(equations).verdict(document.part_of(claim), claim, {})
    assert verdict.answer is Answer.FAILS
    assert verdict.counterexample is not None
    assert str(verdict.counterexample.values["theta"]) != "pi/2"
