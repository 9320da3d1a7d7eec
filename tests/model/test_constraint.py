"""Constraints written as equations, against joints that mean the same and closed forms."""

import numpy as np
import pytest

import polhode as ph
from polhode.algebra import as_symbol
from polhode.base import LENGTH, DeclarationError, ParseError

LAB = ph.Frame("lab")
X, Y, Z = LAB["x"], LAB["y"], LAB["z"]
m, J, R, g = ph.symbols("m J R g", positive=True)
THETA = ph.coordinate("theta")
WHEEL = ph.Body("wheel", mass=m, inertia=(J, J, J), axes=LAB.rotated(THETA, "y"))
GUIDED = (ph.Pivot(WHEEL, only="y z"), ph.Hinge(WHEEL, axis="y"))


def _slope(constraint):
    beta = ph.symbol("beta")
    pull = ph.Force(WHEEL.point(), X * (m * g * ph.sin(beta)), name="weight along the slope")
    return ph.derive(ph.System(*GUIDED, constraint, pull))


ROLLING = ["x - R*theta = 0", "x = R*theta", "x_dot - R*theta_dot = 0", "v_x = R*theta_dot"]


@pytest.mark.parametrize("text", ROLLING)
def test_wheel_rolling_down_a_slope(text):
    equations = _slope(ph.Constraint(text, on=WHEEL, where={"R": R}))
    friction = equations.on_shell(equations.components["Q"])
    beta = ph.symbol("beta")
    acceleration = m * g * ph.sin(beta) / (m + J / R**2)
    assert (friction + J * acceleration / R**2).is_zero
    assert equations.rate(equations.energy) == equations.on_shell(equations.power)


def test_relative_angles_act_between_bodies():
    """Two links, the second turning half as fast relative to the first: a sheave at the elbow."""
    l = ph.symbol("l", positive=True)
    alpha, beta = ph.coordinates("alpha beta")
    upper_axes = LAB.rotated(alpha, "y")
    lower_axes = upper_axes.rotated(beta, "y")
    upper = ph.rod("upper", mass=m, length=l, axes=upper_axes, axis="z", tag="1")
    lower = ph.rod("lower", mass=m, length=l, axes=lower_axes, axis="z", tag="2")
    shoulder = ph.Pivot(upper, at=upper_axes["z"] * (l / 2), name="shoulder")
    elbow = ph.Pivot(
        lower,
        at=lower_axes["z"] * (l / 2),
        to=upper.point(upper_axes["z"] * (-l / 2)),
        name="elbow",
    )
    coupled = ph.System(
        shoulder, elbow, ph.Constraint(2 * beta - alpha, on=(upper, lower)), ph.Gravity(g)
    )
    equations = ph.derive(coupled)
    assert len(equations.speeds) == 1
    # Lagrange's equation of the system with α = 2β put in, which knows no reactions
    free = ph.derive(ph.System(shoulder, elbow, ph.Gravity(g))).lagrangian
    (a, v), (b, w) = ((as_symbol(q), as_symbol(q.dt())) for q in (alpha, beta))
    lagrangian = free.subs({a: 2 * beta, v: 2 * beta.dt()})
    row = lagrangian.diff(w).dt() - lagrangian.diff(b)
    found = equations.on_shell(equations.kinetics.on_speeds(beta.dt()).dt())
    acceleration = found.subs({a: 2 * beta, v: 2 * beta.dt()})
    assert row.subs({as_symbol(beta.dt().dt()): acceleration}).is_zero


def test_equation_with_prescribed_time():
    (lift,) = ph.functions("s")
    bead = ph.point_mass("bead", mass=m, axes=LAB)
    z = ph.coordinate("z")
    equations = ph.derive(
        ph.System(ph.Pivot(bead, only="x y"), ph.Constraint(z - lift, on=bead), ph.Gravity(g))
    )
    assert (equations.components["Q"] - m * (g + lift.dt().dt())).is_zero


def test_bead_on_a_parabola_agrees_with_its_lagrangian():
    x, z = ph.coordinates("x z")
    k = ph.symbol("k", positive=True)
    bead = ph.point_mass("bead", mass=m, axes=LAB)
    wire = ph.Constraint(z - k * x**2, on=bead)
    system = ph.System(ph.Pivot(bead, only="y"), wire, ph.Gravity(g))
    run = ph.simulate(system, {"m": 1, "k": 0.7, "g": 9.81}, {"x": 0.5}, "3 s")
    assert run.drift.energy < 1e-12
    assert np.abs(run["z"] - 0.7 * run["x"] ** 2).max() < 1e-12
    # (1 + 4k²x²) ẍ + 4k²x ẋ² + 2gkx = 0
    equations = ph.derive(system)
    v = equations.kinetics.on_speeds(x.dt())
    a = equations.on_shell(equations.rate(v))
    assert ((1 + 4 * k**2 * x**2) * a + 4 * k**2 * x * v**2 + 2 * g * k * x).is_zero


def test_spin_angle_and_position():
    """A disk whose spin about 3 is tied to its height, like a yo-yo held upright."""
    psi, z = ph.coordinates("psi z")
    disk = ph.Body("disk", mass=m, inertia=(J, J, J), axes=LAB, spin=ph.About("z"))
    held = (ph.Pivot(disk, only="x y"), ph.Hinge(disk, axis="z"))
    parts = (*held, ph.Constraint(z - R * psi, on=disk))
    equations = ph.derive(ph.System(*parts, ph.Gravity(g)))
    value = equations.on_shell(equations.components["Q"])
    assert (value - m * g * J / (J + m * R**2)).is_zero
    assert equations.dimensions[as_symbol(R)] == LENGTH


def test_normal_force_of_a_circular_wire():
    L = ph.symbol("L", positive=True)
    x, z = ph.coordinates("x z")
    bead = ph.point_mass("bead", mass=m, axes=LAB)
    wire = ph.Constraint(x**2 + z**2 - L**2, on=bead)
    equations = ph.derive(ph.System(ph.Pivot(bead, only="y"), wire, ph.Gravity(g)))
    at = {as_symbol(x): L, as_symbol(z): 0}
    # the gradient points outwards: at the height of the centre the wire pulls with m v²/L
    speed = equations.kinetics.on_speeds(z.dt()).subs(at)
    force = equations.on_shell(equations.components["Q"]).subs(at)
    assert (force + m * speed**2 / L).is_zero
    assert equations.dimensions[as_symbol(L)] == LENGTH


def test_impossible_equations_are_refused():
    with pytest.raises(DeclarationError, match="coordinates or speeds"):
        ph.Constraint(R - m, on=WHEEL)
    with pytest.raises(ParseError):
        ph.Constraint("x - Q*theta = 0", on=WHEEL)
    with pytest.raises(DeclarationError, match="no body"):
        ph.Constraint(THETA - 1, on=())
    with pytest.raises(DeclarationError, match="linear in speeds"):
        ph.derive(ph.System(*GUIDED, ph.Constraint(THETA.dt() ** 2 - 1, on=WHEEL)))
    with pytest.raises(DeclarationError, match="no body moves"):
        ph.derive(ph.System(*GUIDED, ph.Constraint(ph.coordinate("chi") - THETA, on=WHEEL)))
    for text in ("x - = 0", "", "="):
        with pytest.raises(ParseError):
            ph.Constraint(text, on=WHEEL)
    with pytest.raises(DeclarationError, match="one equation"):
        ph.Constraint("x = y = z", on=WHEEL)
    with pytest.raises(DeclarationError, match="no body"):
        ph.Constraint("x - R*theta = 0")
    for wrong in (3, "wheel", [WHEEL, 3]):
        with pytest.raises(DeclarationError, match="expected a Body"):
            ph.Constraint(THETA - 1, on=wrong)
    with pytest.raises(DeclarationError, match="R in 'constraint'"):
        ph.Constraint("x - R*theta = 0", on=WHEEL, where={"R": "3 cm"})
    with pytest.raises(DeclarationError):
        ph.Constraint(float("nan"), on=WHEEL)


def test_an_angle_measured_from_a_frame_that_turns_with_time():
    """Its rate, not the rotation in space, is what the equation ties to the height."""
    (turn,) = ph.functions("f")
    z = ph.coordinate("z")
    for base in (LAB.rotated(turn, "z"), ph.earth(ph.symbol("Omega"), colatitude=0)):
        body = ph.Body("body", mass=m, inertia=(J, J, J), axes=base.rotated(THETA, "z"))
        held = (ph.Pivot(body, only="x y"), ph.Hinge(body, axis="z"))
        tied = ph.Constraint(z - R * THETA, on=body)
        equations = ph.derive(ph.System(*held, tied, ph.Gravity(g)))
        assert equations.kinetics.on_speeds(z.dt() - R * THETA.dt()).is_zero
        change = equations.rate(equations.energy) - equations.power
        assert equations.on_shell(change).is_zero


@pytest.mark.parametrize(
    "text", ["x**2 - R*R*theta = 0", "x**2 - R*x*sin(theta) - R**2*theta**2 = 0"]
)
def test_equations_between_positions_and_angles_have_dimensions(text):
    equations = _slope(ph.Constraint(text, on=WHEEL, where={"R": R}))
    assert equations.dimensions[as_symbol(R)] == LENGTH
    change = equations.rate(equations.energy) - equations.power
    assert equations.on_shell(change).is_zero


def test_the_sleeve_of_a_governor_by_its_distance_along_the_shaft():
    """Watt's: (m + M) g = m l φ̇² cos θ, for two balls and a sleeve on two links of each length."""
    M, l = ph.symbols("M l", positive=True)
    spin = LAB.rotated(ph.coordinate("phi"), "z")
    shaft = ph.Body("shaft", mass=m, inertia=(J, J, J), axes=spin)
    sleeve = ph.point_mass("sleeve", mass=M, axes=spin, tag="w")
    parts = [ph.Pivot(shaft, name="bearing", force="B"), ph.Hinge(shaft, axis="z", name="axle")]
    parts += [ph.Slider(sleeve, axis="z", to=shaft.point(), force="S"), ph.Gravity(g)]
    for name, angle in (("left", THETA), ("right", -THETA)):
        axes = spin.rotated(angle, "y")
        ball = ph.Body(name, mass=m, axes=axes, tag=name[0])
        parts.append(ph.Pivot(ball, at=axes["z"] * l, to=shaft.point(), name=f"{name} arm"))
        parts.append(ph.Hinge(ball, axis="y", to=shaft, name=f"{name} hinge"))
    linked = ph.Constraint("s_w + 2*l*cos(theta) = 0", on=(sleeve, shaft, ball), where={"l": l})
    equations = ph.derive(ph.System(*parts, linked))
    family = next(f for f in ph.steady(equations) if f.relations)
    turning = ph.coordinate("phi").dt()
    relation = (m + M) * g - m * l * turning**2 * ph.cos(THETA)
    assert (family.relations[0] / relation).rational is not None
    assert str(ph.stability(family)) == "stable"
