"""Disks and balls on tilted, turning and moving supports, with friction and without."""

from fractions import Fraction
from functools import cache

import pytest

import polhode as ph
from derive import declarations as declared
from derive import scenarios
from derive.declarations import LAB, a, g, m
from derive.states import Numeric, Values, agree, draw
from oracles import balls
from polhode.algebra import as_symbol

seeds = pytest.mark.parametrize("seed", range(6))
WHEEL = "m a g I_1 I_3 theta phi theta_dot phi_dot omega_3 x y"
BALL = "m a k g x y v_x v_y omega_z"
SHEET = "X Y chi X_dot Y_dot chi_dot X_ddot Y_ddot chi_ddot"
FORCES = ["F_x", "F_y", "F_z"]
TURNING = ["theta_ddot", "phi_ddot", "omega_3_dot"]
ENERGIES = ["T_dot", "V_dot"]
mu, k = ph.symbols("mu k", positive=True)


def moved() -> ph.Sheet:
    x, y, chi = ph.functions("X Y chi")
    return ph.Sheet(LAB, motion=(x, y), angle=chi)


def for_oracle(state: Values) -> dict[str, float]:
    """With the name that the oracles give to the angle of the sheet."""
    return {name.replace("chi", "angle"): value for name, value in state.items()}


# -- disks -----------------------------------------------------------------------------------------


@cache
def wheel_on(kind: str, support: str) -> Numeric:
    """A wheel rolling or sliding on a slope or a moved sheet."""
    plane = {
        "slope": lambda: ph.Plane(LAB, tilt=ph.symbol("alpha")),
        "pulled": lambda: ph.Sheet(LAB, motion=ph.functions("X Y")),
        "sheet": moved,
    }[support]()
    wheel = declared.wheel(declared.following(plane.axes))
    contact = {
        "rolling": lambda: ph.Rolling(wheel, on=plane),
        "sliding": lambda: ph.Coulomb(wheel, on=plane, mu=mu),
    }[kind]()
    return Numeric(ph.derive(ph.System(contact, ph.Gravity(g))))


PULLED = "X Y X_dot Y_dot X_ddot Y_ddot"
STATES = {
    "slope": f"{WHEEL} alpha",
    "pulled": f"{WHEEL} {PULLED}",
    "sheet": f"{WHEEL} {SHEET}",
}


@seeds
@pytest.mark.parametrize("support", STATES)
def test_wheel_rolling(support: str, seed: int) -> None:
    state = draw(STATES[support], seed)
    expected = scenarios.rolling_on_sheet(**for_oracle(state))
    found = wheel_on("rolling", support).at(**state)
    agree(found, expected, TURNING)
    agree(found, expected, FORCES)
    agree(found, expected, ENERGIES)
    assert found["T_dot"] + found["V_dot"] == pytest.approx(found["power"], abs=1e-10)


@seeds
@pytest.mark.parametrize("support", ["slope", "pulled"])
def test_wheel_sliding_with_friction(support: str, seed: int) -> None:
    state = draw(f"{STATES[support]} mu v_x v_y", seed)
    expected = scenarios.sliding_on_sheet(**for_oracle(state))
    found = wheel_on("sliding", support).at(**state)
    agree(found, expected, TURNING)
    agree(found, expected, [*FORCES, "v_x_dot", "v_y_dot"])
    agree(found, expected, ENERGIES)
    assert found["T_dot"] + found["V_dot"] == pytest.approx(found["power"], rel=1e-11)


# -- balls -----------------------------------------------------------------------------------------


@cache
def sliding_ball() -> Numeric:
    ball = ph.sphere("ball", mass=m, radius=a, inertia=k * m * a**2, axes=LAB)
    return Numeric(ph.derive(ph.System(ph.Coulomb(ball, on=moved(), mu=mu), ph.Gravity(g))))


@seeds
def test_ball_sliding_on_paper(seed: int) -> None:
    state = draw(f"{BALL} mu omega_x omega_y {SHEET}", seed)
    expected = balls.sliding_on_paper(**for_oracle(state))
    found = sliding_ball().at(**state)
    agree(found, expected, ["v_x_dot", "v_y_dot"])
    agree(found, expected, ["omega_x_dot", "omega_y_dot", "omega_z_dot"])
    agree(found, expected, FORCES)
    agree(found, expected, ENERGIES)
    assert found["T_dot"] == pytest.approx(found["power"], rel=1e-11)


def test_friction_takes_the_power_that_slipping_makes() -> None:
    """On a plane at rest, exactly: the friction mu m g times the speed of slip."""
    ball = ph.sphere("ball", mass=m, radius=a, axes=LAB)
    sliding = ph.derive(ph.System(ph.Coulomb(ball, on=ph.Plane(LAB), mu=mu), ph.Gravity(g)))
    v_x, v_y, omega_x, omega_y = ph.speeds("v_x v_y omega_x omega_y")
    squared = (v_x - a * omega_y) ** 2 + (v_y + a * omega_x) ** 2
    assert sliding.power**2 == (mu * m * g) ** 2 * squared
    assert sliding.components["F_z"] == m * g
    along = (sliding.components[name] for name in ("F_x", "F_y"))
    assert sum(force**2 for force in along) == (mu * m * g) ** 2


@cache
def marble() -> Numeric:
    """On a table whose rate of turning is any function of time."""
    slope = ph.upright(LAB).rotated(-ph.symbol("alpha"), "3")
    ball = ph.sphere("marble", mass=m, radius=a, inertia=ph.symbol("I", positive=True), axes=slope)
    table = ph.Turntable(slope, ph.functions("Omega")[0], normal="1")
    return Numeric(ph.derive(ph.System(ph.Rolling(ball, on=table), ph.Gravity(g))))


@seeds
def test_marble_on_a_turntable_that_speeds_up(seed: int) -> None:
    state = draw("m a I g alpha Omega Omega_dot x_2 x_3 v_2 v_3 omega_1", seed)
    expected = balls.tilted_turntable(**state)
    found = marble().at(**state)
    agree(found, expected, ["v_2_dot", "v_3_dot", "omega_1_dot"])
    agree(found, expected, ["omega_2_dot", "omega_3_dot"])
    agree(found, expected, ["F_1", "F_2", "F_3"])
    agree(found, expected, ENERGIES)


def test_a_ball_slides_down_a_smooth_slope_without_turning() -> None:
    slope = ph.Plane(LAB, tilt=ph.symbol("alpha"))
    ball = ph.sphere("ball", mass=m, radius=a, axes=slope.axes)
    equations = ph.derive(ph.System(ph.Smooth(ball, on=slope), ph.Gravity(g)))
    alpha = ph.symbol("alpha")
    found = {s.published: e for s, e in equations.accelerations.items()}
    assert found.pop("v_y_dot") == -g * ph.sin(alpha)
    assert not any(found.values())
    assert equations.components["F_z"] == m * g * ph.cos(alpha)


@pytest.mark.parametrize(("shape", "moment"), [(ph.disk, Fraction(1, 2)), (ph.hoop, Fraction(1))])
def test_a_wheel_rolls_straight_down_a_slope_slower_than_it_would_slide(shape, moment) -> None:
    """Upright and along the slope it gains g sin α / (1 + I/ma²)."""
    alpha = ph.symbol("alpha")
    slope = ph.Plane(LAB, tilt=alpha)
    wheel = shape("wheel", mass=m, radius=a, axes=declared.following(slope.axes))
    equations = ph.derive(ph.System(ph.Rolling(wheel, on=slope), ph.Gravity(g)))
    velocity = equations.dependent[as_symbol(ph.speed("v_y"))]
    acceleration = equations.on_shell(velocity.chain(equations.kinetics.rate))
    theta, phi = declared.theta, declared.phi
    straight = {theta: ph.pi / 2, phi: ph.pi / 2, theta.dt(): 0, phi.dt(): 0}
    assert acceleration.subs(straight) == -g * ph.sin(alpha) / (1 + moment)
