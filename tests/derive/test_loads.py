"""Springs, dampers, forces and torques on bodies: their motion, their power, what they conserve."""

import pytest

import polhode as ph
from derive.declarations import LAB, g, m, theta
from polhode.derive import Equations

M, k, c, length, N = ph.symbols("M k c l N", positive=True)
X, Y, Z = ph.functions("X Y Z")
x, y, z = ph.coordinates("x y z")
v_x, v_y, v_z = ph.speeds("v_x v_y v_z")


def mass(name: str = "mass", of: ph.Expr = m, tag: str = "") -> ph.Body:
    return ph.point_mass(name, mass=of, axes=LAB, tag=tag)


def centre(body: ph.Body) -> ph.BodyPoint:
    return body.point(LAB.zero)


def accelerations(equations: Equations) -> dict[str, ph.Expr]:
    return {s.published: e for s, e in equations.accelerations.items()}


def test_a_spring_with_a_length_of_its_own() -> None:
    bob = mass()
    spring = ph.Spring(centre(bob), LAB.zero, stiffness=k, length=length)
    equations = ph.derive(ph.System(spring, ph.Gravity(g)))
    distance = ph.sqrt(x**2 + y**2 + z**2)
    pull = k * (1 - length / distance) / m
    found = accelerations(equations)
    assert [found[f"v_{i}_dot"] for i in "xyz"] == [-pull * x, -pull * y, -pull * z - g]
    assert equations.potential_energy == m * g * z + k * (distance - length) ** 2 / 2
    assert equations.power.is_zero
    assert equations.rate(equations.energy).is_zero


@pytest.mark.parametrize("rest", [0, length])
def test_a_spring_whose_end_is_moved_does_the_work_of_moving_it(rest) -> None:
    bob, end = mass(), LAB.vector(X, Y, Z)
    spring = ph.Spring(centre(bob), end, stiffness=k, length=rest)
    equations = ph.derive(ph.System(spring, ph.Gravity(g)))
    own = {"x": 0, "y": 0, "z": -m * g}
    stretch = {i: m * accelerations(equations)[f"v_{i}_dot"] - own[i] for i in "xyz"}
    moved = {"x": X, "y": Y, "z": Z}
    assert equations.power == sum((stretch[i] * moved[i].dt() for i in "xyz"), ph.Expr.of(0))
    assert equations.rate(equations.energy) == equations.power


@pytest.mark.parametrize("rest", [0, length])
def test_a_spring_between_two_bodies_keeps_their_momenta(rest) -> None:
    one, two = mass("one", tag="1"), mass("two", M, tag="2")
    spring = ph.Spring(centre(one), centre(two), stiffness=k, length=rest)
    equations = ph.derive(ph.System(spring))
    for momentum in (equations.linear_momentum, equations.angular_momentum()):
        assert [equations.rate(part) for part in momentum.components] == [0, 0, 0]
    assert equations.rate(equations.energy).is_zero
    assert set(equations.system.bodies) == {one, two}


def test_a_damper_between_two_bodies_heats() -> None:
    one, two = mass("one", tag="1"), mass("two", M, tag="2")
    damper = ph.Damper(centre(one), centre(two), damping=c)
    equations = ph.derive(ph.System(damper))
    relative = [ph.speed(f"v_{i}_1") - ph.speed(f"v_{i}_2") for i in "xyz"]
    assert equations.power == -c * sum((u**2 for u in relative), ph.Expr.of(0))
    assert equations.load_power("damper") == equations.power
    assert equations.rate(equations.energy) == equations.power
    assert [equations.rate(p) for p in equations.linear_momentum.components] == [0, 0, 0]


def test_a_damper_to_a_moving_place_drags_along() -> None:
    equations = ph.derive(ph.System(ph.Damper(centre(mass()), LAB["x"] * X, damping=c)))
    assert accelerations(equations)["v_x_dot"] == -c * (v_x - X.dt()) / m
    assert equations.power == -c * ((v_x - X.dt()) * v_x + v_y**2 + v_z**2)


def pendulum(*loads: ph.Spring | ph.Force | ph.Torque | ph.Damper | ph.Gravity) -> Equations:
    pivot = ph.Pivot(rod(), at=rod_axes()["3"] * (length / 2))
    return ph.derive(ph.System(pivot, ph.Hinge(rod(), axis="2"), *loads))


def rod_axes() -> ph.Frame:
    return LAB.rotated(theta, "y", labels="1 2 3")


def rod() -> ph.Body:
    return ph.rod("rod", mass=m, length=length, axes=rod_axes(), axis="3")


def tip() -> ph.BodyPoint:
    return rod().point(rod_axes()["3"] * (-length / 2))


MOMENT = m * length**2 / 3


@pytest.mark.parametrize(
    ("load", "torque"),
    [
        (ph.Gravity(g), -m * g * length / 2 * ph.sin(theta)),
        (ph.Gravity(g, up=-LAB["x"]), -m * g * length / 2 * ph.cos(theta)),
        (ph.Force(tip(), rod_axes()["1"] * N), -N * length),
        (ph.Force(tip(), LAB["x"] * N), -N * length * ph.cos(theta)),
        (ph.Torque(rod(), LAB["y"] * N), N),
        (ph.Torque(rod(), LAB["x"] * N), 0),
        (ph.Damper(tip(), LAB.zero, damping=c), -c * length**2 * theta.dt()),
        (ph.Spring(tip(), LAB["z"] * -length, stiffness=k), -k * length**2 * ph.sin(theta)),
    ],
    ids=["weight", "sideways weight", "follower", "force", "torque", "idle torque", "damper",
         "spring"],
)  # fmt: skip
def test_torque_of_a_load_on_a_pendulum(load, torque) -> None:
    equations = pendulum(load)
    (acceleration,) = equations.accelerations.values()
    assert acceleration == torque / MOMENT
    assert equations.load_power(load.name) == torque * theta.dt()
    assert equations.rate(equations.energy) == equations.on_shell(equations.power)


def test_a_torque_between_two_bodies_keeps_their_angular_momentum() -> None:
    J, K = ph.symbols("J K", positive=True)
    turns = ph.coordinates("alpha beta")
    one, two = (
        ph.Body(name, mass=m, inertia=(I, I, I), axes=LAB.rotated(turn, "z"), tag=name)
        for name, I, turn in (("p", J, turns[0]), ("q", K, turns[1]))
    )
    drive = ph.Torque(one, LAB["z"] * N, reaction_on=two)
    equations = ph.derive(ph.System(ph.Pivot(one), ph.Pivot(two), drive))
    assert list(equations.accelerations.values()) == [N / J, -N / K]
    assert equations.rate(equations.angular_momentum().components[2]).is_zero
    assert equations.power == N * (turns[0].dt() - turns[1].dt())


# -- the turning Earth -----------------------------------------------------------------------------


OMEGA, COLATITUDE = ph.symbols("Omega lambda_")
EARTH = ph.earth(OMEGA, colatitude=COLATITUDE)


def test_a_particle_on_the_turning_earth_is_deflected() -> None:
    """r̈ = -g ẑ - 2 Ω × v - Ω × (Ω × r), seen from the ground."""
    stone = ph.point_mass("stone", mass=m, axes=EARTH)
    equations = ph.derive(ph.System(stone, ph.Gravity(g)))
    place, velocity = EARTH.vector(x, y, z), EARTH.vector(v_x, v_y, v_z)
    spin = EARTH.angular_velocity
    expected = EARTH["z"] * -g - spin.cross(velocity) * 2 - spin.cross(spin.cross(place))
    found = accelerations(equations)
    assert tuple(found[f"v_{i}_dot"] for i in "xyz") == expected.components
    assert equations.rate(equations.energy) == equations.power


def test_a_foucault_pendulum_turns_its_plane_against_the_ground() -> None:
    """Small and slow: the azimuth of the plane turns at -Ω cos λ, which cancels the coupling."""
    alpha, beta = ph.coordinates("alpha beta")
    axes = EARTH.rotated(alpha, "x").rotated(beta, "y")
    bob = ph.point_mass("bob", mass=m, axes=axes)
    equations = ph.derive(ph.System(ph.Pivot(bob, at=axes["z"] * length), ph.Gravity(g)))
    small = ph.symbol("s")
    state = {q: small * q for q in (alpha, beta)} | {q.dt(): small * q.dt() for q in (alpha, beta)}
    up = OMEGA * ph.cos(COLATITUDE)
    found = [
        acceleration.subs(state).diff(small).subs({small: 0})
        for acceleration in equations.accelerations.values()
    ]
    first_order = [f.subs({OMEGA: small * OMEGA}).diff(small).subs({small: 0}) * OMEGA / OMEGA
                   + f.subs({OMEGA: 0}) for f in found]  # fmt: skip
    assert first_order == [
        -g / length * alpha + 2 * up * beta.dt(),
        -g / length * beta - 2 * up * alpha.dt(),
    ]


def test_a_force_in_rates_of_coordinates_acts_by_the_speeds():
    """A charge on a hill in a magnetic field: z̈ = k z/m - i b ż/m, stable where b² > 4 k m."""
    m, k, b = ph.symbols("m k b", positive=True)
    x, y = ph.coordinates("x y")
    lab = ph.Frame("lab")
    charge = ph.point_mass("charge", mass=m, axes=lab)
    hill = ph.System(
        ph.Pivot(charge, only="z"),
        ph.Potential(-k * (x**2 + y**2) / 2, on=charge),
        ph.Force(charge.point(), lab["x"] * (b * y.dt()) - lab["y"] * (b * x.dt())),
    )
    equations = ph.derive(hill)
    v_x, v_y = ph.speed("v_x"), ph.speed("v_y")
    assert equations.motion == (
        m * v_x.dt() - b * v_y - k * x,
        m * v_y.dt() + b * v_x - k * y,
    )
    (found,) = ph.steady(equations)
    assert b**2 - 4 * m * k in [c.expression for c in ph.stability(found).conditions]
    assert "E" in str(ph.invariants(equations))
