"""Machines of the textbooks against their closed forms, by motions and by exact equations."""

from math import pi

import pytest

import polhode as ph

LAB = ph.Frame("lab")
X, Y, Z = LAB["x"], LAB["y"], LAB["z"]
m, M, J, R, L, g, k, tau = ph.symbols("m M J R L g k tau", positive=True)


@pytest.mark.parametrize("speed", [1.0, 1.2, 0.7])
def test_kepler_period_and_eccentricity(speed):
    """J. Kepler, Harmonices mundi (1619), by Newton's law: T² = 4π² a³/GM, 1/a = 2/r - v²/GM."""
    r = ph.symbol("r", positive=True)
    planet = ph.point_mass("planet", mass=m, axes=LAB)
    pull = ph.CentralForce(planet.point(), Z * 0, energy=-k * m / r, distance=r)
    system = ph.System(ph.Pivot(planet, only="z", name="plane"), pull)
    half_axis = 1 / (2 - speed**2)
    period = 2 * pi * half_axis**1.5
    run = ph.simulate(system, {"m": 2, "k": 1}, {"x": 1, "v_y": speed}, period)
    assert abs(run.final["x"] - 1) < 1e-12
    assert abs(run.final["y"]) < 1e-11
    apsis = ph.simulate(system, {"m": 2, "k": 1}, {"x": 1, "v_y": speed}, period / 2)
    assert apsis.final["x"] == pytest.approx(1 - 2 * half_axis, rel=1e-11)
    assert run.drift.energy < 1e-13


def test_control_moment_gyroscope():
    """The torque on the base is -(gimbal rate) × (momentum of the rotor).

    Hughes, Spacecraft Attitude Dynamics (1986), ch. 11: g = -δ̇ × h for a gimbal at rest in space.
    """
    delta, spin, Omega, gamma, C, A = *ph.coordinates("delta psi"), *ph.symbols("Omega gamma C A")
    tilted = LAB.rotated(delta, "z")
    gimbal = ph.Body("gimbal", mass=0, axes=tilted, tag="g")
    axes = tilted.rotated(spin, "x")
    rotor = ph.Body("rotor", mass=m, inertia=(C, A, A), axes=axes, tag="r")
    equations = ph.derive(
        ph.System(
            ph.Pivot(gimbal, name="bearing"),
            ph.Hinge(gimbal, axis="z", name="gimbal axis"),
            ph.Motor(
                gimbal, axis="z", rate=gamma, relative_to=LAB, name="gimbal motor", torque="sigma"
            ),
            ph.Pivot(rotor, to=gimbal.point(), name="rotor bearing"),
            ph.Hinge(rotor, axis="x", to=gimbal, name="rotor axis"),
            ph.Motor(
                rotor,
                axis="x",
                rate=Omega,
                relative_to=tilted,
                to=gimbal,
                name="rotor motor",
                torque="rho",
            ),
        )
    )
    total = equations.reactions["gimbal axis"].couple
    momentum = tilted["x"] * (C * Omega)
    expected = (Z * gamma).cross(momentum)  # of the base on the gimbal: the opposite on the base
    for direction in (X, Y):
        assert equations.on_shell((total - expected).dot(direction)).is_zero
    (power,) = [equations.on_shell(equations.components["sigma_z_g"])]
    assert power.is_zero  # a small motor turns the gimbal: it does no work


def _wheel(name, angle, tag, moment=J):
    return ph.Body(name, mass=m, inertia=(moment,) * 3, axes=LAB.rotated(angle, "x"), tag=tag)


def test_differential_divides_the_torque_equally():
    """Two equal sun wheels and a carrier: 2 φ̇ = α̇ + β̇, and both wheels get half the torque.

    S. Timoshenko and D. H. Young, Advanced Dynamics (1948).
    """
    alpha, beta, phi = ph.coordinates("alpha beta phi")
    J_1, J_2 = ph.symbols("J_1 J_2", positive=True)
    left, right = _wheel("left", alpha, "1", J_1), _wheel("right", beta, "2", J_2)
    carrier = _wheel("carrier", phi, "c")
    held = [
        part
        for body, place in ((left, X * -L), (right, X * L), (carrier, X * 0))
        for part in (
            ph.Pivot(body, to=place, name=f"axle {body.name}"),
            ph.Hinge(body, axis="x", name=f"hinge {body.name}"),
        )
    ]
    gears = ph.Constraint(
        "2*phi - alpha - beta = 0", on=(left, right, carrier), name="differential"
    )
    equations = ph.derive(ph.System(*held, gears, ph.Torque(carrier, X * tau)))
    speeds = (equations.kinetics.on_speeds(q.dt()) for q in (alpha, beta))
    first, second = (equations.on_shell(equations.rate(speed)) for speed in speeds)
    # J₁ α̈ = J₂ β̈ = (τ - J φ̈)/2
    driven = (tau - J * (first + second) / 2) / 2
    assert (J_1 * first - driven).is_zero
    assert (J_2 * second - driven).is_zero


def test_inverted_pendulum_on_a_wheel():
    """The plane model of a Segway: F. Grasser et al., JOE: a mobile, inverted pendulum (2002).

    Linear about upright, with the torque τ of the motor between chassis and wheel:
    (I + M l²) θ̈ + M l ẍ = M g l θ - τ and (M + m + J/R²) ẍ + M l θ̈ = τ/R.
    """
    theta, phi = ph.coordinates("theta phi")
    A = ph.symbol("A", positive=True)
    wheel = ph.Body("wheel", mass=m, inertia=(J,) * 3, axes=LAB.rotated(phi, "y"))
    leaning = LAB.rotated(theta, "y")
    chassis = ph.Body("chassis", mass=M, inertia=(A,) * 3, axes=leaning, tag="c")
    equations = ph.derive(
        ph.System(
            ph.Pivot(wheel, to=Z * R, only="y z", name="ground"),
            ph.Hinge(wheel, axis="y", name="wheel axis"),
            ph.Constraint("x - R*phi = 0", on=wheel, where={"R": R}),
            ph.Pivot(chassis, at=leaning["z"] * -L, to=wheel.point(), name="axle"),
            ph.Hinge(chassis, axis="y", to=wheel, name="axle hinge"),
            ph.Torque(wheel, Y * tau, reaction_on=chassis, name="motor"),
            ph.Gravity(g),
        )
    )
    rates = (theta, phi)
    speeds = [equations.kinetics.on_speeds(q.dt()) for q in rates]
    turning, rolling = (equations.on_shell(equations.rate(speed)) for speed in speeds)
    upright = {theta.symbol: 0, theta.dt().symbol: 0}
    # solved: with D = (A + M l²)(M + m + J/R²) - M² l²
    inertia, mass, lever = A + M * L**2, M + m + J / R**2, M * L
    determinant = inertia * mass - lever**2
    tipping, driven = mass * lever * g / determinant, -(mass + lever / R) / determinant
    assert (turning.diff(theta.symbol).subs(upright) - tipping).is_zero
    assert (turning.diff(tau.symbol).subs(upright) - driven).is_zero
    pushed = (inertia / R + lever) / determinant
    assert (rolling.diff(tau.symbol).subs(upright) * R - pushed).is_zero
    assert (rolling.diff(theta.symbol).subs(upright) * R + lever**2 * g / determinant).is_zero
