"""Equations of motion as books print them, each row an expression that vanishes along the motion.

They measure how long polhode's own are. Letters are polhode's; ρ = |r₁ − r₂| and the like are given
once, as a book would, and count with the rows. A form is not changed for the sake of a comparison.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import polhode as ph
from polhode.catalogue import CATALOGUE

SOLVED = Path(__file__).parents[2] / "docs" / "examples" / "solutions"
LAB = ph.Frame("lab")
X, Y, Z = (LAB[k] for k in "xyz")
m, M, k, l, a, g, G, R, mu, c, I, Omega = ph.symbols("m M k l a g G R mu c I Omega", positive=True)
r, theta, x = ph.coordinates("r theta x")


@dataclass(frozen=True)
class PublishedForm:
    """A system with its equations in a book.

    Attributes:
        source: where they stand.
        build: declares the system.
        rows: the equations.
        lengths: what the letters of lengths stand for.
    """

    source: str
    build: Callable[[], ph.System]
    rows: tuple[str, ...]
    lengths: dict[str, str] = field(default_factory=dict)


def solved(file: str, name: str) -> Callable[[], ph.System]:
    """A system of docs/examples/solutions."""

    def built() -> ph.System:
        spec = importlib.util.spec_from_file_location(file, SOLVED / f"{file}.py")
        module = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(module)
        return getattr(module, name)

    return built


def of_catalogue(name: str) -> Callable[[], ph.System]:
    """A system of the catalogue."""
    return lambda: CATALOGUE[name].build()


def plane_pendulum() -> ph.System:
    bob = ph.point_mass("bob", mass=m, axes=LAB.rotated(theta, "y"))
    return ph.System(ph.Pivot(bob, at=bob.axes["z"] * l), ph.Gravity(g))


def pair(load: Callable[[ph.Body, ph.Body], object]) -> ph.System:
    one = ph.point_mass("one", mass=M, axes=LAB, tag="1")
    two = ph.point_mass("two", mass=m, axes=LAB, tag="2")
    return ph.System(one, two, load(one, two))


def attraction(one: ph.Body, two: ph.Body, strength: ph.Expr, name: str = "gravitation") -> object:
    between = ph.symbol("s", positive=True)
    energy = -strength / between
    return ph.CentralForce(one.point(), two.point(), energy=energy, distance=between, name=name)


def two_on_a_spring() -> ph.System:
    return pair(lambda p, q: ph.Spring(p.point(), q.point(), stiffness=k, length=l))


def two_that_attract() -> ph.System:
    return pair(lambda p, q: attraction(p, q, G * m * M))


def three_that_attract() -> ph.System:
    masses = ph.symbols("m_1 m_2 m_3", positive=True)
    bodies = [ph.point_mass(f"{i}", mass=n, axes=LAB, tag=f"{i}") for i, n in enumerate(masses, 1)]
    pulls = [
        attraction(bodies[i], bodies[j], G * masses[i] * masses[j], f"{i + 1}{j + 1}")
        for i, j in ((0, 1), (0, 2), (1, 2))
    ]
    return ph.System(*bodies, *pulls)


def coupled_pendulums() -> ph.System:
    bobs, pivots = [], []
    for i, place in ((1, LAB.zero), (2, X * a)):
        axes = LAB.rotated(ph.coordinate(f"theta_{i}"), "y")
        bob = ph.point_mass(f"bob {i}", mass=m, axes=axes, tag=f"{i}")
        bobs.append(bob)
        pivots.append(ph.Pivot(bob, at=axes["z"] * l, to=place, name=f"P{i}", force=f"P{i}"))
    spring = ph.Spring(bobs[0].point(), bobs[1].point(), stiffness=k, length=a)
    return ph.System(*bobs, *pivots, spring, ph.Gravity(g))


def sliding_ball() -> ph.System:
    ball = ph.sphere("ball", mass=m, radius=R, axes=LAB)
    return ph.System(ball, ph.Coulomb(ball, on=ph.Plane(LAB), mu=mu), ph.Gravity(g))


def planet() -> ph.System:
    body = ph.point_mass("planet", mass=m, axes=LAB)
    distance = ph.symbol("s", positive=True)
    pull = ph.CentralForce(body.point(), LAB.zero, energy=-k / distance, distance=distance)
    return ph.System(body, ph.Pivot(body, only="z", name="plane"), pull)


def thrown() -> ph.System:
    body = ph.point_mass("stone", mass=m, axes=LAB)
    v = [ph.speed(f"v_{k}") for k in "xyz"]
    size = ph.sqrt(v[0] ** 2 + v[1] ** 2 + v[2] ** 2)
    drag = (X * v[0] + Y * v[1] + Z * v[2]) * (-c * size)
    return ph.System(body, ph.Gravity(g), ph.Force(body.point(), drag))


def between_two_springs() -> ph.System:
    body = ph.point_mass("bead", mass=m, axes=LAB)
    springs = [
        ph.Spring(body.point(), X * side, stiffness=k, length=l, name=name)
        for side, name in ((-a, "left"), (a, "right"))
    ]
    return ph.System(body, ph.Pivot(body, only="z", name="plane"), *springs)


def elastic_pendulum() -> ph.System:
    bob = ph.point_mass("bob", mass=m, axes=LAB)
    arm = LAB.rotated(theta, "y")
    placed = ph.Pivot(bob, to=arm["z"] * -r, name="plane")
    return ph.System(placed, ph.Potential(k * (r - l) ** 2 / 2, on=[bob]), ph.Gravity(g))


def cart_and_pendulum() -> ph.System:
    cart = ph.point_mass("cart", mass=M, axes=LAB)
    bob = ph.point_mass("bob", mass=m, axes=LAB.rotated(theta, "y"), tag="b")
    return ph.System(
        ph.Pivot(cart, only="y z", name="rail"),
        ph.Pivot(bob, at=bob.axes["z"] * l, to=cart.point(), name="hinge", force="S"),
        ph.Gravity(g),
    )


def dumbbell() -> ph.System:
    """Two equal particles a distance 2l apart; their middle moves in the plane of the orbit."""
    rod = ph.Body("rod", mass=0, axes=LAB.rotated(theta, "z", labels="1 2 3"), tag="r")
    ends = []
    for side, tag in ((1, "a"), (-1, "b")):
        end = ph.point_mass(f"end {tag}", mass=m, axes=LAB, tag=tag)
        ends.append(ph.Pivot(end, to=rod.point(rod.axes["1"] * (side * l)), name=tag, force=tag))
    distance = ph.symbol("s", positive=True)
    pulls = [
        ph.CentralForce(
            end.body.point(), LAB.zero, energy=-k / distance, distance=distance, name=f"on {tag}"
        )
        for end, tag in zip(ends, "ab", strict=True)
    ]
    return ph.System(
        ph.Pivot(rod, only="z", name="plane"), ph.Hinge(rod, axis="3", name="level"), *ends, *pulls
    )


def on_a_shaken_pivot() -> ph.System:
    """A pendulum whose pivot moves up and down as Z(t)."""
    bob = ph.point_mass("bob", mass=m, axes=LAB.rotated(theta, "y"))
    (height,) = ph.functions("Z")
    pivot = ph.Pivot(bob, at=bob.axes["z"] * l, to=LAB["z"] * height)
    return ph.System(pivot, ph.Gravity(g))


def kepler_in_polar_coordinates() -> ph.System:
    body = ph.point_mass("planet", mass=m, axes=LAB)
    placed = ph.Pivot(body, to=LAB.rotated(theta, "z")["x"] * r, name="plane")
    return ph.System(placed, ph.Potential(-k / r, on=[body]))


def swinging_atwood() -> ph.System:
    bob = ph.point_mass("bob", mass=m, axes=LAB, tag="1")
    weight = ph.point_mass("weight", mass=M, axes=LAB, tag="2")
    placed = ph.Pivot(bob, to=LAB.rotated(theta, "y")["z"] * -r, name="plane")
    guide = ph.Pivot(weight, to=X * R, only="x y", name="guide", force="G")
    rope = ph.Constraint("z_2 - r = c", on=(bob, weight), where={"r": r, "c": c})
    return ph.System(placed, guide, rope, ph.Gravity(g))


def in_a_turning_tube() -> ph.System:
    """A bead in a straight tube that turns about the vertical at a given rate."""
    tube = LAB.rotated(Omega * ph.time, "z")
    bead = ph.point_mass("bead", mass=m, axes=tube)
    return ph.System(ph.Pivot(bead, to=tube["x"] * r, name="tube"))


def governor() -> ph.System:
    """Two balls on arms from the top of a shaft, two more down to a sleeve on it."""
    tau = LAB.rotated(Omega * ph.time, "z")
    balls = []
    for side, tag in ((1, "1"), (-1, "2")):
        arm = tau.rotated(theta * side, "y")
        ball = ph.point_mass(f"ball {tag}", mass=m, axes=arm, tag=tag)
        balls.append(ph.Pivot(ball, at=arm["z"] * a, name=f"arm {tag}", force=f"A{tag}"))
    sleeve = ph.point_mass("sleeve", mass=M, axes=tau, tag="s")
    shaft = ph.Pivot(sleeve, only="x y", name="shaft", force="S")
    lower = ph.Constraint("z_s + 2*a*cos(theta) = 0", on=(balls[0].body, sleeve), where={"a": a})
    return ph.System(*balls, shaft, lower, ph.Gravity(g))


def compound_atwood() -> ph.System:
    """Two weights on a rope over a pulley with a moment of inertia, which it does not slip on."""
    m_1, m_2 = ph.symbols("m_1 m_2", positive=True)
    alpha = ph.coordinate("alpha")
    wheel = ph.Body("wheel", mass=M, inertia=(I, I, I), axes=LAB.rotated(alpha, "y"), tag="w")
    parts = [ph.Pivot(wheel, name="axle"), ph.Hinge(wheel, axis="y")]
    for mass, side, tag in ((m_1, 1, "1"), (m_2, -1, "2")):
        weight = ph.point_mass(f"weight {tag}", mass=mass, axes=LAB, tag=tag)
        rope = f"z_{tag} + {side}*R*alpha = 0"
        parts += [
            ph.Pivot(weight, only="x y", name=f"guide {tag}", force=f"G{tag}"),
            ph.Constraint(
                rope, on=(weight, wheel), where={"R": R}, name=f"rope {tag}", force=f"Q_{tag}"
            ),
        ]
    return ph.System(*parts, ph.Gravity(g))


def furuta() -> ph.System:
    """A pendulum in the plane across the end of an arm that turns about the vertical."""
    phi, L = ph.coordinate("phi"), ph.symbol("L", positive=True)
    arm_axes = LAB.rotated(phi, "z")
    arm = ph.Body("arm", mass=M, inertia=(I, I, I), axes=arm_axes, tag="a")
    bob = ph.point_mass("bob", mass=m, axes=arm_axes.rotated(theta, "x"), tag="b")
    return ph.System(
        ph.Pivot(arm, name="axle"),
        ph.Hinge(arm, axis="z"),
        ph.Pivot(bob, at=bob.axes["z"] * l, to=arm.point(arm_axes["x"] * L), name="joint"),
        ph.Gravity(g),
    )


def _each(row: str, axes: str = "xyz") -> tuple[str, ...]:
    """A row for each axis, which stands in it as @."""
    return tuple(row.replace("@", axis) for axis in axes)


def _distance(one: str, two: str) -> str:
    return " + ".join(f"({k}_{one} - {k}_{two})**2" for k in "xyz").join(("sqrt(", ")"))


_LANDAU = "Landau and Lifshitz, Mechanics, 3rd ed."
_GOLDSTEIN = "Goldstein, Classical Mechanics, 3rd ed."
_PROBLEMS = "problem set"
_RODS = {
    "rho_1": "sqrt((x_r + l*cos(theta))**2 + (y_r + l*sin(theta))**2 + z_r**2)",
    "rho_2": "sqrt((x_r - l*cos(theta))**2 + (y_r - l*sin(theta))**2 + z_r**2)",
}

FORMS: dict[str, PublishedForm] = {
    "plane pendulum": PublishedForm(
        f"{_LANDAU}, § 5", plane_pendulum, ("l*theta_ddot + g*sin(theta)",)
    ),
    "physical pendulum": PublishedForm(
        f"{_LANDAU}, § 32, problem 3",
        solved("physical_pendulum", "physical_pendulum"),
        ("(I_2 + m*l**2)*theta_ddot + m*g*l*sin(theta)",),
    ),
    "double pendulum": PublishedForm(
        f"Lagrange's equations of {_LANDAU}, § 5, problem 1",
        solved("double_pendulum", "double_pendulum"),
        (
            "(m_1 + m_2)*l_1*alpha_ddot + m_2*l_2*beta_ddot*cos(alpha - beta)"
            " + m_2*l_2*beta_dot**2*sin(alpha - beta) + (m_1 + m_2)*g*sin(alpha)",
            "l_2*beta_ddot + l_1*alpha_ddot*cos(alpha - beta)"
            " - l_1*alpha_dot**2*sin(alpha - beta) + g*sin(beta)",
        ),
    ),
    "spherical pendulum": PublishedForm(
        f"{_LANDAU}, § 14, problem 1, with the angle from the upward vertical",
        solved("spherical_pendulum", "spherical_pendulum"),
        (
            "phi_ddot*sin(theta) + 2*theta_dot*phi_dot*cos(theta)",
            "l*theta_ddot - l*phi_dot**2*sin(theta)*cos(theta) - g*sin(theta)",
        ),
    ),
    "bead on a turning hoop": PublishedForm(
        f"{_GOLDSTEIN}, chapter 2, derivation 18",
        solved("bead_on_hoop", "bead_on_hoop"),
        ("a*theta_ddot - a*Omega**2*sin(theta)*cos(theta) + g*sin(theta)",),
    ),
    "sliding ladder": PublishedForm(
        "by the energy, with the middle of the ladder on a circle",
        solved("sliding_ladder", "sliding_ladder"),
        ("4*l*theta_ddot - 3*g*sin(theta)",),
    ),
    "Chaplygin's sleigh": PublishedForm(
        "A. M. Bloch, Nonholonomic Mechanics and Control, § 1.7, with the blade behind",
        solved("chaplygin_sleigh", "chaplygin_sleigh"),
        ("v_dot - a*omega**2", "(I + m*a**2)*omega_dot + m*a*v*omega"),
    ),
    "elastic pendulum": PublishedForm(
        "by Lagrange's equations in polar coordinates",
        elastic_pendulum,
        (
            "m*r_ddot - m*r*theta_dot**2 + k*(r - l) - m*g*cos(theta)",
            "r*(r*theta_ddot + 2*r_dot*theta_dot + g*sin(theta))",
        ),
    ),
    "cart and pendulum": PublishedForm(
        f"Lagrange's equations of {_LANDAU}, § 5, problem 2, the angle the other way round",
        cart_and_pendulum,
        (
            "l*theta_ddot - v_x_dot*cos(theta) + g*sin(theta)",
            "(M + m)*v_x_dot - m*l*theta_ddot*cos(theta) + m*l*theta_dot**2*sin(theta)",
        ),
    ),
    "two masses on a spring": PublishedForm(
        "Newton's second and third law, with Hooke's law along the line between",
        two_on_a_spring,
        (
            *_each("M*v_@_1_dot + k*(rho - l)*(@_1 - @_2)/rho"),
            *_each("m*v_@_2_dot - k*(rho - l)*(@_1 - @_2)/rho"),
        ),
        {"rho": _distance("1", "2")},
    ),
    "two bodies": PublishedForm(
        f"{_LANDAU}, § 13, without the reduced mass",
        two_that_attract,
        (
            *_each("v_@_1_dot + G*m*(@_1 - @_2)/rho**3"),
            *_each("v_@_2_dot - G*M*(@_1 - @_2)/rho**3"),
        ),
        {"rho": _distance("1", "2")},
    ),
    "three bodies": PublishedForm(
        "Danby, Fundamentals of Celestial Mechanics, 2nd ed., eq. (8.1.1)",
        three_that_attract,
        (
            *_each("v_@_1_dot + G*m_2*(@_1 - @_2)/rho_1**3 + G*m_3*(@_1 - @_3)/rho_2**3"),
            *_each("v_@_2_dot - G*m_1*(@_1 - @_2)/rho_1**3 + G*m_3*(@_2 - @_3)/rho_3**3"),
            *_each("v_@_3_dot - G*m_1*(@_1 - @_3)/rho_2**3 - G*m_2*(@_2 - @_3)/rho_3**3"),
        ),
        {"rho_1": _distance("1", "2"), "rho_2": _distance("1", "3"), "rho_3": _distance("2", "3")},
    ),
    "planet": PublishedForm(
        f"{_LANDAU}, § 15",
        planet,
        _each("m*v_@_dot + k*@/rho**3", "xy"),
        {"rho": "sqrt(x**2 + y**2 + z**2)"},
    ),
    "stone with quadratic drag": PublishedForm(
        "Taylor, Classical Mechanics, eq. (2.61), in three dimensions",
        thrown,
        (*_each("m*v_@_dot + c*v*v_@", "xy"), "m*v_z_dot + m*g + c*v*v_z"),
        {"v": "sqrt(v_x**2 + v_y**2 + v_z**2)"},
    ),
    "bead between two springs": PublishedForm(
        "Hooke's law along both springs",
        between_two_springs,
        (
            "m*v_x_dot + k*(rho_1 - l)*(x + a)/rho_1 + k*(rho_2 - l)*(x - a)/rho_2",
            "m*v_y_dot + k*(rho_1 - l)*y/rho_1 + k*(rho_2 - l)*y/rho_2",
        ),
        {
            "rho_1": "sqrt((x + a)**2 + y**2 + z**2)",
            "rho_2": "sqrt((x - a)**2 + y**2 + z**2)",
        },
    ),
    "coupled pendulums": PublishedForm(
        "by virtual work of the spring, of length a when the pendulums hang",
        coupled_pendulums,
        (
            "m*l*theta_1_ddot + m*g*sin(theta_1)"
            " + k*(rho - a)*(a*cos(theta_1) + l*sin(theta_1 - theta_2))/rho",
            "m*l*theta_2_ddot + m*g*sin(theta_2)"
            " - k*(rho - a)*(a*cos(theta_2) + l*sin(theta_1 - theta_2))/rho",
        ),
        {
            "rho": "sqrt((a + l*sin(theta_1) - l*sin(theta_2))**2"
            " + (l*cos(theta_1) - l*cos(theta_2))**2)"
        },
    ),
    "dumbbell in orbit": PublishedForm(
        "Newton's law for the middle, and the moments of both attractions about it",
        dumbbell,
        (
            "2*m*l*theta_ddot + k*(y_r*cos(theta) - x_r*sin(theta))/rho_1**3"
            " - k*(y_r*cos(theta) - x_r*sin(theta))/rho_2**3",
            "2*m*v_x_r_dot + k*(x_r + l*cos(theta))/rho_1**3 + k*(x_r - l*cos(theta))/rho_2**3",
            "2*m*v_y_r_dot + k*(y_r + l*sin(theta))/rho_1**3 + k*(y_r - l*sin(theta))/rho_2**3",
        ),
        _RODS,
    ),
    "sliding billiard ball": PublishedForm(
        "Coriolis, Théorie mathématique des effets du jeu de billard (1835), chapter 1",
        sliding_ball,
        (
            "2*R*omega_x_dot + 5*mu*g*(v_y + R*omega_x)/v_c",
            "2*R*omega_y_dot - 5*mu*g*(v_x - R*omega_y)/v_c",
            "omega_z_dot",
            "v_x_dot + mu*g*(v_x - R*omega_y)/v_c",
            "v_y_dot + mu*g*(v_y + R*omega_x)/v_c",
        ),
        {"v_c": "sqrt((v_x - R*omega_y)**2 + (v_y + R*omega_x)**2)"},
    ),
    "rolling disk": PublishedForm(
        f"{_PROBLEMS}, eqs. (25) to (27)",
        of_catalogue("rolling-disk"),
        (
            "phi_ddot*sin(theta) + 2*theta_dot*phi_dot*cos(theta) - 2*omega_3*theta_dot",
            "5*a*theta_ddot - a*phi_dot**2*sin(theta)*cos(theta)"
            " + 6*a*omega_3*phi_dot*sin(theta) + 4*g*cos(theta)",
            "3*omega_3_dot - 2*theta_dot*phi_dot*sin(theta)",
        ),
    ),
    "marble on a turntable": PublishedForm(
        f"{_PROBLEMS}, eq. (49)",
        of_catalogue("marble-on-turntable"),
        ("omega_z_dot", "(I + m*a**2)*v_x_dot + I*Omega*v_y", "(I + m*a**2)*v_y_dot - I*Omega*v_x"),
    ),
    "gyroscope": PublishedForm(
        f"{_GOLDSTEIN}, § 5.7, with ω along the axis as the third speed",
        of_catalogue("gyroscope"),
        (
            "(I_2 + M*a**2)*(phi_ddot*sin(theta) + 2*theta_dot*phi_dot*cos(theta))"
            " - I_1*omega_1*theta_dot",
            "(I_2 + M*a**2)*(theta_ddot - phi_dot**2*sin(theta)*cos(theta))"
            " + I_1*omega_1*phi_dot*sin(theta) - M*g*a*sin(theta)",
            "omega_1_dot",
        ),
    ),
    "cylinder in a cylinder": PublishedForm(
        f"{_LANDAU}, § 32, problem 6, with a ω for the speed of the axis",
        of_catalogue("cylinder-in-cylinder"),
        ("3*a*omega_v_dot - 2*g*sin(u)",),
    ),
    "cylinder on a free wedge": PublishedForm(
        "Lagrange's equations with the speed of the wedge and a ω, that of the axis down it",
        of_catalogue("cylinder-on-wedge"),
        (
            "3*a*omega_x_dot - 2*v_y_w_dot*cos(alpha) - 2*g*sin(alpha)",
            "v_x_w_dot",
            "(M + m)*v_y_w_dot - m*a*omega_x_dot*cos(alpha)",
        ),
    ),
    "pendulum on a shaken pivot": PublishedForm(
        f"{_LANDAU}, § 30, before averaging",
        on_a_shaken_pivot,
        ("l*theta_ddot + (g + Z_ddot)*sin(theta)",),
    ),
    "planet in polar coordinates": PublishedForm(
        f"{_GOLDSTEIN}, eqs. (3.8) and (3.11)",
        kepler_in_polar_coordinates,
        ("m*r_ddot - m*r*theta_dot**2 + k/r**2", "r*(r*theta_ddot + 2*r_dot*theta_dot)"),
    ),
    "swinging Atwood machine": PublishedForm(
        "N. Tufillaro, T. Abbott and D. Griffiths, Am. J. Phys. 52 (1984) 895",
        swinging_atwood,
        (
            "(M + m)*r_ddot - m*r*theta_dot**2 + M*g - m*g*cos(theta)",
            "r*(r*theta_ddot + 2*r_dot*theta_dot + g*sin(theta))",
        ),
    ),
    "bead in a turning tube": PublishedForm(
        f"{_GOLDSTEIN}, § 1.6", in_a_turning_tube, ("r_ddot - r*Omega**2",)
    ),
    "centrifugal governor": PublishedForm(
        f"Lagrange's equation of {_LANDAU}, § 5, problem 4",
        governor,
        (
            "a*(m + 2*M*sin(theta)**2)*theta_ddot + 2*M*a*theta_dot**2*sin(theta)*cos(theta)"
            " - m*a*Omega**2*sin(theta)*cos(theta) + (m + M)*g*sin(theta)",
        ),
    ),
    "Atwood's machine with a pulley": PublishedForm(
        "Kleppner and Kolenkow, An Introduction to Mechanics, example 6.10",
        compound_atwood,
        ("(I + (m_1 + m_2)*R**2)*alpha_ddot - (m_1 - m_2)*g*R",),
    ),
    "Furuta's pendulum": PublishedForm(
        "Lagrange's equations of an arm with a point mass on a rod",
        furuta,
        (
            "(I + m*L**2 + m*l**2*sin(theta)**2)*phi_ddot + m*L*l*theta_ddot*cos(theta)"
            " + 2*m*l**2*phi_dot*theta_dot*sin(theta)*cos(theta)"
            " - m*L*l*theta_dot**2*sin(theta)",
            "l*theta_ddot + L*phi_ddot*cos(theta) - l*phi_dot**2*sin(theta)*cos(theta)"
            " + g*sin(theta)",
        ),
    ),
    "free rigid body": PublishedForm(
        f"{_LANDAU}, eq. (36.5)",
        of_catalogue("tennis-racquet"),
        (
            "I_1*omega_1_dot + (I_3 - I_2)*omega_2*omega_3",
            "I_2*omega_2_dot + (I_1 - I_3)*omega_3*omega_1",
            "I_3*omega_3_dot + (I_2 - I_1)*omega_1*omega_2",
        ),
    ),
}
