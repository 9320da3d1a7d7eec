"""Bodies placed by coordinates of their own: polar, spherical, and those of a moving origin."""

from math import cos, pi, sin, sqrt

import pytest

import polhode as ph

LAB = ph.Frame("lab")
m, k, c, g = ph.symbols("m k c g", positive=True)
r, theta, phi = ph.coordinates("r theta phi")
POLAR = LAB.rotated(theta, "z")


def planet(written="polar axes", energy=-k / r):
    """A particle at a distance r in the direction theta, as different texts would declare it."""
    place = POLAR["x"] * r
    if written == "components":
        place = LAB["x"] * (r * ph.cos(theta)) + LAB["y"] * (r * ph.sin(theta))
    body = ph.point_mass("planet", mass=m, axes=POLAR if written == "axes of the body" else LAB)
    placed = ph.Pivot(body, to=place, along=POLAR, name="plane")
    return ph.System(placed, ph.Potential(energy, on=body, name="sun"), name="Kepler")


ways = pytest.mark.parametrize("written", ["polar axes", "axes of the body", "components"])


@ways
def test_kepler_in_polar_coordinates(written):
    """L. D. Landau and E. M. Lifshitz, Mechanics, § 15: r = p/(1 + e cos θ), p = L²/(m k)."""
    equations = ph.derive(planet(written))
    momentum = m * r**2 * theta.dt()
    radial = momentum**2 / (m**2 * r**3) - k / (m * r**2)  # of the effective potential
    assert (equations.on_shell(r.dt().dt()) - radial).is_zero
    assert equations.on_shell(momentum.dt()).is_zero
    assert all(equations.on_shell(f).is_zero for f in equations.components.values())
    e = 0.3
    start = {r: 1 - e, "theta_dot": sqrt((1 + e) / (1 - e) ** 3)}  # at perihelion, with a = 1
    run = ph.simulate(equations, {m: 2, k: 2}, start, 7 * pi)
    for time in (1.0, 4.0, 7 * pi):
        distance, angle = run.evaluate(r, time), run.evaluate(theta, time)
        assert distance == pytest.approx((1 - e**2) / (1 + e * cos(angle)), rel=1e-12)
    assert run.final["theta"] == pytest.approx(7 * pi, rel=1e-12)


@ways
def test_what_is_claimed_of_kepler(written):
    """The same lines hold, and the same fail, however the place is written."""
    equations = ph.derive(planet(written))
    right = (
        r"m\ddot r - m r\dot\theta^2 = -\frac{k}{r^2}",
        r"\frac{d}{dt}(m r^2\dot\theta) = 0",
        r"E = \frac12 m(\dot r^2 + r^2\dot\theta^2) - k/r",
        r"V_{\rm eff} = \frac{L^2}{2mr^2} - \frac kr",
        r"\mathbf v = \dot r\hat{\mathbf r} + r\dot\theta\hat{\boldsymbol\theta}",
    )
    assert all(ph.check(line, equations).holds for line in right)
    wrong = r"m\ddot r + m r\dot\theta^2 = -\frac{k}{r^2}", r"V_{\rm eff} = -\frac kr"
    assert [str(ph.check(line, equations)).partition(";")[0] for line in wrong] == ["fails"] * 2


def test_revolving_orbit():
    """Newton's theorem of revolving orbits by Binet's equation: r = p/(1 + e cos κθ).

    With V = −k/r + c/2r², u″ + κ² u = m k/L², where κ² = 1 + m c/L² and p = κ² L²/(m k). E. T.
    Whittaker, Analytical Dynamics (1937), § 47.
    """
    run = ph.simulate(
        planet(energy=-k / r + c / (2 * r**2)), {m: 1, k: 1, c: 0.21}, {r: 1, "theta_dot": 1.1}, 20
    )
    squared = 1.1**2
    turned, p = sqrt(1 + 0.21 / squared), squared + 0.21
    for time in (3.0, 11.0, 20.0):
        angle = turned * run.evaluate(theta, time)
        expected = p / (1 + (p - 1) * cos(angle))
        assert run.evaluate(r, time) == pytest.approx(expected, rel=1e-12)


def test_spherical_coordinates():
    """A particle thrown in spherical coordinates moves along a parabola."""
    axes = LAB.rotated(phi, "z").rotated(theta, "y")
    ball = ph.point_mass("ball", mass=m, axes=LAB)
    system = ph.System(ph.Pivot(ball, to=axes["z"] * r), ph.Gravity(g))
    run = ph.simulate(
        system, {m: 1, g: 9.81}, {r: 2, theta: 0.7, "r_dot": 3, "phi_dot": 1.5, "theta_dot": -1}, 1
    )
    at = {
        "x": r * ph.sin(theta) * ph.cos(phi),
        "y": r * ph.sin(theta) * ph.sin(phi),
        "z": r * ph.cos(theta),
    }
    s, u = sin(0.7), cos(0.7)
    expected = {
        "x": 2 * s + 3 * s - 2 * u,
        "y": 2 * s * 1.5,
        "z": 2 * u + 3 * u + 2 * s - 9.81 / 2,
    }
    assert {q: run.evaluate(e, 1.0) for q, e in at.items()} == pytest.approx(expected, rel=1e-12)


def test_a_rod_in_polar_coordinates_of_a_turning_frame():
    """Free of forces its centre moves uniformly in space, and it turns uniformly."""
    alpha, Omega, length = ph.coordinate("alpha"), *ph.symbols("Omega l", positive=True)
    turned = LAB.rotated(Omega * ph.time, "z").rotated(theta, "z")
    rod = ph.rod("rod", mass=m, length=length, axes=LAB.rotated(alpha, "z"), axis="x")
    equations = ph.derive(ph.System(ph.Pivot(rod, to=turned["x"] * r)))
    start = {r: 1, "r_dot": 0.4, "theta_dot": 0.1, "alpha_dot": 2}
    run = ph.simulate(equations, {m: 1, length: 1, Omega: 0.5}, start, 3)
    x, y = 1 + 0.4 * 3, 0.6 * 3
    assert run.final["r"] == pytest.approx((x**2 + y**2) ** 0.5, rel=1e-12)
    angle = run.final["theta"] + 0.5 * 3
    assert (sin(angle) * x, run.final["alpha"]) == pytest.approx((cos(angle) * y, 6), rel=1e-12)


def test_coordinates_of_no_body():
    body = ph.point_mass("planet", mass=m, axes=LAB)
    free = ph.Pivot(body, only="z")
    wrong = (
        ph.Potential(-k / r, on=body),
        ph.Constraint("x - r*cos(theta) = 0", on=body, where={"r": r, "theta": theta}),
        ph.Force(body.point(), POLAR["x"] * (-k / r**2)),
    )
    for part in wrong:
        with pytest.raises(ph.DeclarationError, match=r"Pivot\(body, to=axes\['x'\]\*r\)"):
            ph.derive(ph.System(free, part))
