"""Bodies placed by coordinates of their own: polar, spherical, and those of a moving origin."""

from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import polhode as ph

LAB = ph.Frame("lab")
m, M, k, c, g = ph.symbols("m M k c g", positive=True)
r, theta, phi, x, y = ph.coordinates("r theta phi x y")
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


def particles():
    return (
        ph.point_mass(f"body {t}", mass=mass, axes=LAB, tag=t) for t, mass in (("1", m), ("2", M))
    )


def pair_about_its_centre(distance):
    """Two particles placed by their common centre of mass and the line between them."""
    one, two = particles()
    centre = LAB["x"] * x + LAB["y"] * y
    return (
        ph.Pivot(one, to=centre - POLAR["x"] * (distance * M / (m + M)), name="first"),
        ph.Pivot(two, to=centre + POLAR["x"] * (distance * m / (m + M)), name="second"),
    )


def test_two_bodies_in_coordinates_of_their_centre_of_mass():
    """The two-body problem: Newton's laws of both particles by SciPy."""
    places = pair_about_its_centre(r)
    spring = ph.Spring(*(p.body.point() for p in places), stiffness=k, length=c)
    equations = ph.derive(ph.System(*places, spring))
    assert all(equations.on_shell(f).is_zero for f in equations.components.values())
    start = {r: 1, "theta_dot": 2, "x_dot": 0.3}
    run = ph.simulate(equations, {m: 1, M: 2.5, k: 7, c: 0.8}, start, 3)

    def laws(_, state):
        first, second, v_1, v_2 = np.split(state, 4)
        apart = second - first
        pull = 7 * (1 - 0.8 / np.linalg.norm(apart)) * apart
        return np.concatenate([v_1, v_2, pull, -pull / 2.5])

    begin = [-5 / 7, 0, 2 / 7, 0, 0.3, -10 / 7, 0.3, 4 / 7]
    found = solve_ivp(laws, (0, 3), begin, method="DOP853", rtol=1e-12, atol=1e-13).y[:4, -1]
    ends = [equations.kinetics.places[p.body].components[:2] for p in places]
    assert [run.evaluate(q, 3.0) for pair in ends for q in pair] == pytest.approx(found, abs=1e-10)


def test_a_dumbbell_in_coordinates_of_its_centre_of_mass():
    """Each end is pulled towards the centre with μ l θ̇², of the reduced mass μ; it falls freely."""
    falling = ph.derive(ph.System(*pair_about_its_centre(c), ph.Gravity(g, up=LAB["y"])))
    pull = m * M / (m + M) * c * theta.dt() ** 2
    on_1, on_2 = (falling.reactions[name].force for name in ("first", "second"))
    for force, sign in ((on_1, 1), (on_2, -1)):
        along, across = (falling.on_shell(force.dot(POLAR[label])) for label in "xy")
        assert (along - sign * pull).is_zero
        assert across.is_zero
    assert falling.on_shell(y.dt().dt()) == -g


def test_weights_whose_places_go_with_one_coordinate():
    """Each side of Atwood's machine pulls with 2 m M g/(m + M); its pulley is not declared."""
    one, two = particles()
    sides = (
        ph.Pivot(one, to=LAB["z"] * x, name="first"),
        ph.Pivot(two, to=LAB["z"] * -x, name="second"),
    )
    machine = ph.derive(ph.System(*sides, ph.Gravity(g)))
    for name in ("F_z_1", "F_z_2"):
        assert (machine.on_shell(machine.components[name]) - 2 * m * M * g / (m + M)).is_zero


@pytest.mark.parametrize("angle", ["absolute", "from the radius"])
def test_a_wheel_rolls_in_a_bowl(angle):
    """Its angle may be counted from the horizontal, or from the line to its centre.

    With I = κ m a² the centre moves as a pendulum with g/(1 + κ), and the friction f on the rim,
    up the bowl, is that of I φ̈ = −a f: f = κ m g sin θ/(1 + κ).
    """
    R, a, kappa = ph.symbols("R a kappa", positive=True)
    radius = LAB.rotated(theta, "y")
    turned = {"absolute": LAB, "from the radius": radius}[angle].rotated(phi, "y")
    inertia = kappa * m * a**2
    wheel = ph.Body("wheel", mass=m, inertia=(inertia,) * 3, axes=turned)
    relation = "a*phi + (R - a)*theta" if angle == "absolute" else "a*phi + R*theta"
    rolls = ph.Constraint(f"{relation} = 0", on=wheel, where={"a": a, "R": R, "theta": theta})
    track = ph.Pivot(wheel, to=radius["z"] * (a - R), along=radius, name="bowl")
    hinge = ph.Hinge(wheel, axis="y")
    system = ph.derive(ph.System(track, hinge, rolls, ph.Gravity(g)))
    falls = g * ph.sin(theta) / (1 + kappa)
    assert (system.on_shell(theta.dt().dt()) * (R - a) + falls).is_zero
    friction = kappa * m * g * ph.sin(theta) / (1 + kappa)
    assert (system.on_shell(system.components["Q"]) - a * friction).is_zero  # a couple
    pressed = system.on_shell(system.components["F_z"])
    assert (pressed - m * g * ph.cos(theta) - m * (R - a) * theta.dt() ** 2).is_zero
    twist = ph.TorsionSpring(phi, stiffness=k, on=wheel)
    wound = ph.derive(ph.System(track, hinge, rolls, twist))
    turn = -(R - a if angle == "absolute" else R) / a  # of the spring, for a unit of theta
    torque = k * turn * phi + (1 + kappa) * m * (R - a) ** 2 * wound.on_shell(theta.dt().dt())
    assert torque.is_zero


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
