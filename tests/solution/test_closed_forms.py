"""Closed forms as a solution prints them, evaluated by hand and compared with integrations.

The numbers here come from SciPy and mpmath alone: none of them from the closed forms of polhode.
"""

import math

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import polhode as ph
from polhode.catalogue import PROBLEM_SET

MOMENTS = (1.3, 2.1, 3.2)


@pytest.fixture
def sections(solved):
    """Closed forms by the name of a system."""
    return lambda name: solved(name).sections["The motion in closed form"]


def shown(steps):
    return [step.latex for step in steps if step.latex]


def words(steps):
    return " ".join(step.words for step in steps)


def euler(t, omega, moments=MOMENTS):
    a, b, c = moments
    u, v, w = omega
    return (b - c) * v * w / a, (c - a) * w * u / b, (a - b) * u * v / c


def integrated(rates, start, end):
    return solve_ivp(rates, (0, end), start, rtol=1e-12, atol=1e-13).y[:, -1]


# -- free body -------------------------------------------------------------------------------------


def test_the_separatrix_of_a_free_body_is_written_with_tanh_and_sech(sections):
    """Problem set, (12)-(14), against an integration of Euler's equations."""
    steps = sections("tennis-racquet")
    a, b, c = MOMENTS
    L, t = 4.4, 1.7
    k = math.sqrt((c - b) * (b - a) / (a * c))
    sizes = [
        L / b * math.sqrt(b * (c - b) / (a * (c - a))),
        L / b * math.sqrt(b * (b - a) / (c * (c - a))),
    ]
    assert r"\omega_2 = \frac{L}{I_2} \tanh\left(\frac{k L}{I_2} t\right)" in shown(steps)
    for i, other in ((1, r"\left(I_3 - I_2\right)"), (3, r"\left(I_2 - I_1\right)")):
        size = rf"\frac{{L}}{{I_2}} \sqrt{{\frac{{I_2 {other}}}{{I_{i} \left(I_3 - I_1\right)}}}}"
        sech = r"\operatorname{sech}\left(\frac{k L}{I_2} t\right)"
        assert rf"\omega_{i} = {size} {sech}" in shown(steps)
    reached = integrated(euler, (sizes[0], 0.0, sizes[1]), t)
    x = k * L / b * t
    sech = 1 / math.cosh(x)
    assert reached == pytest.approx((sizes[0] * sech, L / b * math.tanh(x), sizes[1] * sech))


def test_elsewhere_a_free_body_follows_jacobis_functions(sections):
    """The constants as printed, in mpmath's functions, against an integration."""
    steps = sections("tennis-racquet")
    assert r"\omega_2 = \beta\operatorname{sn}\left[\lambda(t - t_0), \kappa\right]" in words(steps)
    assert any(line.startswith(r"\alpha^2 = \frac{2 I_3 T - L^2}") for line in shown(steps))
    a, b, c = MOMENTS
    start, t = (0.4, 0.0, 1.5), 2.3
    T2 = sum(m * w**2 for m, w in zip(MOMENTS, start, strict=True))
    L2 = sum((m * w) ** 2 for m, w in zip(MOMENTS, start, strict=True))
    assert b * T2 < L2
    alpha = math.sqrt((c * T2 - L2) / (a * (c - a)))
    beta = math.sqrt((c * T2 - L2) / (b * (c - b)))
    gamma = math.sqrt((L2 - a * T2) / (c * (c - a)))
    rate = math.sqrt((c - b) * (L2 - a * T2) / (a * b * c))
    modulus = math.sqrt((b - a) * (c * T2 - L2) / ((c - b) * (L2 - a * T2)))
    sn, cn, dn = (float(mpmath.ellipfun(f, rate * t, k=modulus)) for f in ("sn", "cn", "dn"))
    reached = integrated(euler, start, t)
    assert reached == pytest.approx((alpha * cn, beta * sn, gamma * dn), rel=1e-8)
    whole = float(4 * mpmath.ellipk(modulus**2) / rate)
    assert integrated(euler, start, whole) == pytest.approx(start, abs=1e-8)


def test_which_rotation_of_a_free_body_is_unstable(solved):
    """Rates of growth as printed, against the eigenvalues of Euler's linearised equations."""
    steps = solved("tennis-racquet").sections["Small departures and stability"]
    lines = shown(steps)
    I = dict(enumerate(MOMENTS, 1))
    fraction = r"\frac{\left(%s\right) \left(%s\right) %s}{%s}"
    expected = {
        fraction % ("I_3 - I_1", "I_1 - I_2", r"\omega_1^2 \omega_2", "I_2 I_3"): 1,
        fraction % ("I_3 - I_2", "I_1 - I_3", r"\omega_1 \omega_3^2", "I_1 I_2"): 3,
        fraction % ("I_2 - I_3", "I_1 - I_2", r"\omega_1 \omega_2^2", "I_1 I_3"): 2,
    }
    printed = {
        1: -(I[2] - I[1]) * (I[3] - I[1]) / (I[2] * I[3]),
        3: -(I[3] - I[2]) * (I[3] - I[1]) / (I[1] * I[2]),
        2: (I[2] - I[1]) * (I[3] - I[2]) / (I[1] * I[3]),
    }
    for right, axis in expected.items():
        departing = 2 if axis == 1 else 1
        assert rf"\ddot{{\omega}}_{departing} \approx {right}" in lines
        about = np.eye(3)[axis - 1]
        step = 1e-6
        jacobian = [
            (np.array(euler(0, about + step * e)) - euler(0, about - step * e)) / (2 * step)
            for e in np.eye(3)
        ]
        squares = np.linalg.eigvals(np.array(jacobian).T) ** 2
        assert max(squares.real, key=abs) == pytest.approx(printed[axis])
    assert "for axis $2$ alone, that of the middle moment: rotation about it" in words(steps)


# -- marble ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["marble-on-turntable", "marble-on-turntable/tilted"])
def test_the_marbles_circle(sections, name):
    """R, ρ and the drift as printed, against a run and against the closed form's numbers."""
    steps, tilted = sections(name), name.endswith("tilted")
    m, a, g, Omega, alpha = 0.005, 0.008, 9.81, 3.4, 0.03 if tilted else 0.0
    inertia = 0.4 * m * a**2
    start = {"x_2": 0.1, "v_3": 0.05} if tilted else {"x": 0.1, "v_y": 0.05}
    rate = 2 * Omega / 7
    drift = -m * g * a**2 * math.sin(alpha) / (inertia * Omega)
    x, v = 0.1, 0.05
    centre = (x - (v - drift) / rate, 0.0)  # R as printed, with the other velocity zero
    radius = abs(v - drift) / rate
    text = " ".join(shown(steps))
    assert r"\Lambda = \frac{I \Omega}{I + m a^2}" in text
    assert (r"\mathbf w = -\frac{m g a^2 \sin\alpha}{I \Omega}\,\hat{\mathbf 3}" in text) == tilted
    values = {"m": m, "a": a, "I": inertia, "g": g, "Omega": Omega}
    values |= {"alpha": alpha} if tilted else {}
    run = ph.simulate(PROBLEM_SET[name].build(), values, start, "7 s")
    first, second = ("x_2", "x_3") if tilted else ("x", "y")
    for i, t in enumerate(run.t):
        place = (run[first][i], run[second][i])
        away = math.hypot(place[0] - centre[0], place[1] - centre[1] - drift * t)
        assert away == pytest.approx(radius, rel=1e-9)
    figures = ph.closed_form(ph.derive(PROBLEM_SET[name].build()), values, start).figures
    assert figures["radius"] == pytest.approx(radius)
    assert (figures["centre_1"], figures["drift_2"]) == pytest.approx((centre[0], drift))


def test_the_marble_moves_like_a_charge_in_crossed_fields(sections):
    """M dv/dt = qE + qv × B with the constants as printed has the acceleration of the marble."""
    steps = sections("marble-on-turntable/tilted")
    text = words(steps)
    for printed in (
        r"$M = m + \frac{I}{a^2}$",
        r"$q B = -\frac{I \Omega}{a^2}$",
        r"$q\mathbf E = -m g \sin\alpha\,\hat{\mathbf 2}$",
    ):
        assert printed in text
    assert "charge" in words(sections("marble-on-turntable"))
    assert "crossed" not in words(sections("marble-on-turntable"))
    m, a, inertia, g, Omega, alpha = 0.7, 0.3, 0.05, 9.8, 2.2, 0.4
    v = np.array([0.0, 0.8, -1.1])
    M, qB, qE = m + inertia / a**2, -inertia * Omega / a**2, -m * g * math.sin(alpha)
    charged = (np.array([0, qE, 0]) + np.cross(v, [qB, 0, 0])) / M
    equations = ph.derive(PROBLEM_SET["marble-on-turntable/tilted"].build())
    numbers = {"m": m, "a": a, "I": inertia, "g": g, "Omega": Omega, "alpha": alpha}
    run = ph.simulate(equations, numbers, {"v_2": v[1], "v_3": v[2]}, "0.1 s")
    assert (run["v_2_dot"][0], run["v_3_dot"][0]) == pytest.approx(tuple(charged[1:]))


# -- pendulum and top ------------------------------------------------------------------------------


def test_the_pendulum_by_sn(sections):
    steps = sections("physical_pendulum")
    assert r"\sin\frac{\theta}{2} = \tanh\left(n t\right)" in shown(steps)
    assert r"$\sin(\theta/2) = k\operatorname{sn}[n(t - t_0), k]$" in words(steps)
    n, k, t = 1.7, 0.6, 0.9
    theta, _ = integrated(lambda t, y: (y[1], -(n**2) * math.sin(y[0])), (0.0, 2 * n * k), t)
    assert math.sin(theta / 2) == pytest.approx(k * float(mpmath.ellipfun("sn", n * t, k=k)))


def test_the_nutation_by_sn(sections):
    """The cubic as printed and its roots, for a top under gravity, against an integration."""
    steps = sections("gyroscope")
    cubic = r"\left(1 - u^2\right) \left(\eta - 2 \mu u\right) - \left(\alpha - \beta u\right)^2"
    assert rf"\dot{{u}}^2 = {cubic}" in shown(steps)
    mu, beta, theta, turning, t = 1.9, 2.6, 1.1, 0.35, 0.8

    def rates(t, y):
        s, c = math.sin(y[0]), math.cos(y[0])
        return y[1], s * (y[2] ** 2 * c - beta * y[2] + mu), y[1] * (beta - 2 * y[2] * c) / s

    alpha = turning * math.sin(theta) ** 2 + beta * math.cos(theta)
    eta = turning**2 * math.sin(theta) ** 2 + 2 * mu * math.cos(theta)
    roots = np.roots([2 * mu, -eta - beta**2, 2 * alpha * beta - 2 * mu, eta - alpha**2])
    low, high, far = sorted(roots.real)
    w, k = math.sqrt(mu * (far - low) / 2), math.sqrt((high - low) / (far - low))
    from_top = math.cos(theta) == pytest.approx(high)
    since = float(mpmath.ellipk(k**2)) / w if from_top else 0.0
    sn = float(mpmath.ellipfun("sn", w * (t + since), k=k))
    reached = integrated(rates, (theta, 0.0, turning), t)
    assert math.cos(reached[0]) == pytest.approx(low + (high - low) * sn**2)
    u = math.cos(reached[0])
    assert reached[2] == pytest.approx((alpha - beta * u) / (1 - u**2))


# -- gyrocompass and coin --------------------------------------------------------------------------


def test_the_swing_of_a_gyrocompass_by_cn(sections):
    """The constants as printed, in mpmath's functions, against the equations of motion (21, 22)."""
    steps = sections("gyrocompass")
    assert r"A = \frac{I_3 n \Omega \sin\lambda}{I_1}, \qquad B = \Omega^2 \sin^2\lambda" in shown(
        steps
    )
    assert r"$\tan(\theta/2) = X\operatorname{cn}[w(t - t_0), k]$" in words(steps)
    assert all(verdict.holds for step in steps for _, verdict in step.stated)
    I1, I3, Omega, colatitude = 1.3, 2.1, 0.9, 1.1
    s = Omega * math.sin(colatitude)

    def rates(t, y):
        theta, rate, omega = y
        bend = -I3 * s * omega * math.sin(theta)
        bend -= s**2 * (I3 - I1) * math.sin(theta) * math.cos(theta)
        return rate, bend / I1, s * rate * math.sin(theta)

    for start, omega, t in ((0.8, 2.4, 3.1), (1.2, -0.2, 5.0)):  # across zero, and beside it
        A, B = I3 * (omega + s * math.cos(start)) * s / I1, s**2
        eta = -A * math.cos(start) - B / 2 * math.sin(start) ** 2
        square = math.sqrt(A**2 + 2 * eta * B + B**2)
        X = math.sqrt((square + eta + B) / (A - eta))
        w, k = math.sqrt(square), math.sqrt((square + eta + B) / (2 * square))
        assert A > 0
        assert (k > 1) == (eta < -A) == (omega < 0)
        # beside zero this start is where the angle is least, half a period of dn later
        since = 0.0 if k < 1 else float(mpmath.ellipk(1 / k**2)) / (k * w)
        cn = (
            mpmath.ellipfun("cn", w * t, k=k)
            if k < 1
            else mpmath.ellipfun("dn", k * w * (t + since), k=1 / k)
        )
        reached = integrated(rates, (start, 0.0, omega), t)
        assert math.tan(reached[0] / 2) == pytest.approx(X * float(cn), rel=1e-7)


def test_a_coin_on_a_smooth_table_by_an_integral(sections):
    """The integral as printed, by mpmath, against an integration of the equations (21) and (22)."""
    steps = sections("spinning-coin")
    under = (
        r"\eta - 2 \mu \sin\theta - \frac{\left(\alpha - \beta \cos\theta\right)^2}{\sin^2\theta}"
    )
    assert rf"\left(1 + 4 \cos^2\theta\right) \dot{{\theta}}^2 = {under}" in shown(steps)
    assert rf"\sqrt{{\frac{{1 + 4 \cos^2\theta}}{{{under}}}}}\,d\theta" in words(steps)
    assert "hyperelliptic" in words(steps)
    mu, omega, start, turning = 4 * 9.81 / 0.012, 2.0, 1.2, 45.0

    def rates(t, y):
        theta, rate, phi = y
        s, c = math.sin(theta), math.cos(theta)
        pull = 4 * rate**2 * s * c + phi**2 * s * c - 2 * omega * phi * s - mu * c
        return rate, pull / (1 + 4 * c**2), 2 * rate * (omega - phi * c) / s

    alpha = turning * math.sin(start) ** 2 + 2 * omega * math.cos(start)
    eta = turning**2 * math.sin(start) ** 2 + 2 * mu * math.sin(start)

    def square(theta):
        height = alpha - 2 * omega * mpmath.cos(theta)
        return eta - 2 * mu * mpmath.sin(theta) - height**2 / mpmath.sin(theta) ** 2

    other = mpmath.findroot(square, (0.4, 1.0), solver="anderson")
    half = mpmath.quad(
        lambda q: mpmath.sqrt((1 + 4 * mpmath.cos(q) ** 2) / abs(square(q))), [other, 1.0, start]
    )
    reached = integrated(rates, (start, 0.0, turning), float(half))
    assert reached[0] == pytest.approx(float(other), abs=1e-8)


def test_letters_of_the_system_are_not_used_again():
    """A free body whose moments are called L, T and k keeps these letters."""
    moments = ph.symbols("k L T", positive=True)
    phi, theta, psi = ph.coordinates("phi theta psi")
    axes = ph.Frame("lab").rotated(phi, "z").rotated(theta, "x").rotated(psi, "z", labels="1 2 3")
    body = ph.Body("body", mass=ph.symbol("m"), inertia=moments, axes=axes, spin=ph.Components())
    found = ph.solution(ph.System(ph.Pivot(body), name="free"))
    steps = found.sections["The motion in closed form"]
    text = " ".join(shown(steps))
    assert "2 K = k " in text
    assert r"\Lambda^2 = k^2" in text
    assert all(step.verdict.holds for step in steps if step.latex)


def test_a_letter_that_drops_out_of_the_motion_is_not_used_again():
    """The moment about the axis of a bar, here q, occurs in no equation of a plane swing."""
    m, k, g, u, q = ph.symbols("m k g u q", positive=True)
    axes = ph.Frame("lab").rotated(ph.coordinate("theta"), "y", labels="1 2 3", name="axes")
    bar = ph.Body("bar", mass=m, inertia=(u, u, q), axes=axes)
    system = ph.System(ph.Pivot(bar, at=axes["3"] * k), ph.Gravity(g), name="bar")
    found = ph.solution(system, "lagrange").sections["The motion in closed form"]
    assert any(r"4 n^2 \left(\xi^2 -" in line for line in shown(found))


def test_systems_without_a_closed_form_have_no_such_section(solved):
    assert "The motion in closed form" not in solved("rolling_hoop").sections
