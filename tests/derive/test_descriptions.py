"""One body described in several ways moves in one way: axes, angles, speeds, parts, symbols."""

from collections.abc import Callable
from functools import cache

import numpy as np
import pytest

import polhode as ph
from derive import declarations as declared
from derive.declarations import I_1, I_3, LAB, a, g, m, phi, psi, theta
from derive.states import Numeric, agree, draw
from oracles.parts import turn_x, turn_y, turn_z
from polhode.derive import Equations

seeds = pytest.mark.parametrize("seed", range(6))
EULER = ("phi", "theta", "psi")
AIRCRAFT = ("alpha", "beta", "gamma")
FORCES = ["F_x", "F_y", "F_z"]
SPINS = ["omega_1_dot", "omega_2_dot", "omega_3_dot"]


# -- axes fixed in the body instead of axes that follow it -----------------------------------------


def test_a_wheel_rolls_the_same_by_axes_that_spin_with_it() -> None:
    following = declared.rolling(LAB)
    fixed = rolling_with(declared.euler(LAB))
    spun = {"omega_3": psi.dt() + phi.dt() * ph.cos(theta)}
    on_rates = {ph.speeds("omega_3")[0]: spun["omega_3"], _dot("omega_3"): spun["omega_3"].dt()}
    for name, force in following.components.items():
        assert fixed.components[name] == force.subs(on_rates)
    for row in following.rows:
        assert fixed.on_shell(row.subs(on_rates)).is_zero
    assert fixed.energy == following.energy.subs(on_rates)


def _dot(name: str) -> ph.Expr:
    return ph.speeds(name)[0].dt()


def rolling_with(axes: ph.Frame) -> Equations:
    """The wheel with axes that are fixed in it: no spin of its own."""
    body = declared.wheel(axes, spin_about="", rim=None, surface=ph.Rim(a, "3"))
    return ph.derive(ph.System(ph.Rolling(body, on=ph.Plane(LAB)), ph.Gravity(g)))


# -- other angles ----------------------------------------------------------------------------------


@cache
def pebble(angles: tuple[str, str, str]) -> Numeric:
    axes = {EULER: declared.euler, AIRCRAFT: declared.aircraft}[angles](LAB)
    return Numeric(declared.pebble(axes, angles))


@cache
def rock(angles: tuple[str, str, str]) -> Numeric:
    axes = {EULER: declared.euler, AIRCRAFT: declared.aircraft}[angles](LAB)
    return Numeric(declared.rock(axes, angles))


BODIES = {
    "pebble": (pebble, "m g b_1 b_2 b_3 I_1 I_2 I_3"),
    "rock": (rock, "m g c_1 c_2 c_3 I_1 I_2 I_3"),
}


@seeds
@pytest.mark.parametrize("name", BODIES)
def test_motion_does_not_depend_on_the_angles_that_describe_the_attitude(
    name: str, seed: int
) -> None:
    body, parameters = BODIES[name]
    state = draw(f"{parameters} omega_1 omega_2 omega_3", seed)
    by_euler = draw("phi theta psi", seed + 100)
    attitude = turn_z(by_euler["phi"]) @ turn_x(by_euler["theta"]) @ turn_z(by_euler["psi"])
    first = body(EULER).at(**state, **by_euler)
    second = body(AIRCRAFT).at(**state, **aircraft_angles(attitude))
    agree(first, second, SPINS)
    agree(first, second, FORCES)
    agree(first, second, ["T", "V", "T_dot", "V_dot"])


def aircraft_angles(attitude: np.ndarray) -> dict[str, float]:
    """Yaw, pitch and roll that make this attitude."""
    angles = {
        "alpha": np.arctan2(attitude[1, 0], attitude[0, 0]),
        "beta": -np.arcsin(attitude[2, 0]),
        "gamma": np.arctan2(attitude[2, 1], attitude[2, 2]),
    }
    made = turn_z(angles["alpha"]) @ turn_y(angles["beta"]) @ turn_x(angles["gamma"])
    assert made == pytest.approx(attitude, abs=1e-14)
    return {name: float(angle) for name, angle in angles.items()}


# -- other speeds ----------------------------------------------------------------------------------


@cache
def wheel_by(*speeds: ph.Expr) -> Numeric:
    """A rolling wheel described by these speeds."""
    contact = ph.Rolling(declared.wheel(declared.following(LAB)), on=ph.Plane(LAB))
    return Numeric(ph.derive(ph.System(contact, ph.Gravity(g), independent=speeds)))


@seeds
def test_a_wheel_may_be_described_by_the_velocity_of_its_centre(seed: int) -> None:
    """Its spin and steering made dependent instead, the wheel does the same."""
    by_path = wheel_by(*ph.speeds("v_x v_y"), phi.dt())
    assert {s.published for s in by_path.equations.speeds} == {"v_x", "v_y", "phi_dot"}
    state = draw("m a g I_1 I_3 theta phi theta_dot phi_dot omega_3", seed)
    expected = wheel_by().at(**state)
    given = ["m", "a", "g", "I_1", "I_3", "theta", "phi", "phi_dot", "v_x", "v_y"]
    found = by_path.at(**{name: expected[name] for name in given})
    agree(found, expected, ["theta_dot", "omega_3"], tolerance=1e-11)
    agree(found, expected, ["theta_ddot", "phi_ddot", "omega_3_dot", "v_x_dot"], tolerance=1e-11)
    agree(found, expected, FORCES, tolerance=1e-11)


# -- parts of one rigid body -----------------------------------------------------------------------


def test_a_top_in_two_parts_welded_together_moves_as_one() -> None:
    """Mass and inertia may be moved between parts that are fixed to one another."""
    m_1, m_2, d = ph.symbols("m_1 m_2 d", positive=True)
    A_1, A_3, B_1, B_3 = ph.symbols("A_1 A_3 B_1 B_3", positive=True)
    parts = welded_top(m_1, (A_1, A_3), m_2, (B_1, B_3), d)
    away = m_1 * m_2 / (m_1 + m_2) * d**2
    centre = {
        m: m_1 + m_2,
        a: a + m_2 * d / (m_1 + m_2),
        I_1: A_1 + B_1 + away,
        I_3: A_3 + B_3,
    }
    whole = declared.top(LAB)
    assert parts.speeds == whole.speeds
    assert parts.rows == tuple(row.subs(centre) for row in whole.rows)
    for name in FORCES:
        assert parts.components[name] == whole.components[name].subs(centre)
    assert parts.energy == whole.energy.subs(centre)


def test_inertia_moved_between_welded_parts_changes_the_weld_alone() -> None:
    m_1, m_2, d, moved = ph.symbols("m_1 m_2 d K", positive=True)
    A_1, A_3, B_1, B_3 = ph.symbols("A_1 A_3 B_1 B_3", positive=True)
    before = welded_top(m_1, (A_1, A_3), m_2, (B_1, B_3), d)
    after = welded_top(m_1, (A_1 + moved, A_3), m_2, (B_1 - moved, B_3), d)
    assert after.rows == before.rows
    assert after.energy == before.energy
    changed = {n for n, force in after.components.items() if force != before.components[n]}
    assert changed == {"tau_1", "tau_2"}


def welded_top(m_1: ph.Expr, first: tuple, m_2: ph.Expr, second: tuple, d: ph.Expr) -> Equations:
    """A top whose rotor carries another at a distance d up the axle."""
    axes = declared.following(LAB)
    lower, upper = (
        ph.Body(name, mass=mass, inertia=(across, across, along), axes=axes, spin_about="3")
        for name, mass, (across, along) in (("lower", m_1, first), ("upper", m_2, second))
    )
    pivot = ph.Pivot(lower, at=axes["3"] * -a)
    tip = lower.point(axes["3"] * d)
    weld = ph.Weld(upper, to=tip, along=axes, force="S")
    return ph.derive(ph.System(pivot, weld, ph.Gravity(g)))


# -- shape put in sooner or later ------------------------------------------------------------------


SHAPES: list[tuple[Callable[..., ph.Body], dict[ph.Expr, ph.Expr]]] = [
    (ph.disk, {I_1: m * a**2 / 4, I_3: m * a**2 / 2}),
    (ph.hoop, {I_1: m * a**2 / 2, I_3: m * a**2}),
]


@pytest.mark.parametrize(("shape", "moments"), SHAPES, ids=["disk", "hoop"])
def test_moments_of_a_shape_may_be_substituted_before_or_after(shape, moments) -> None:
    body = shape("wheel", mass=m, radius=a, axes=declared.following(LAB))
    before = ph.derive(ph.System(ph.Rolling(body, on=ph.Plane(LAB)), ph.Gravity(g)))
    after = declared.rolling(LAB)
    assert before.rows == tuple(row.subs(moments) for row in after.rows)
    assert before.energy == after.energy.subs(moments)
    for symbol, acceleration in after.accelerations.items():
        assert before.accelerations[symbol] == acceleration.subs(moments)
    for name, force in after.components.items():
        assert before.components[name] == force.subs(moments)


def test_numbers_may_be_substituted_before_or_after() -> None:
    values = {m: 2, a: ph.Expr.of(3) / 10, g: ph.Expr.of(981) / 100}
    body = ph.disk("wheel", mass=2, radius=0.3, axes=declared.following(LAB))
    before = ph.derive(ph.System(ph.Rolling(body, on=ph.Plane(LAB)), ph.Gravity(9.81)))
    moments = {I_1: m * a**2 / 4, I_3: m * a**2 / 2}
    after = declared.rolling(LAB)
    assert before.rows == tuple(row.subs(moments).subs(values) for row in after.rows)


def test_a_full_inertia_matrix_is_a_body_turned() -> None:
    """Principal moments along turned axes, or the matrix along the axes that are not."""
    axes = declared.euler(LAB)
    first, second, third = ph.symbols("A B C", positive=True)
    turned = axes.rotated(ph.symbol("beta"), "3", labels="1 2 3")
    principal = ph.Body("rock", mass=m, inertia=(first, second, third), axes=turned)
    cos, sin = ph.cos(ph.symbol("beta")), ph.sin(ph.symbol("beta"))
    mixed = (first - second) * sin * cos
    matrix = (
        (first * cos**2 + second * sin**2, mixed, 0),
        (mixed, first * sin**2 + second * cos**2, 0),
        (0, 0, third),
    )
    full = ph.Body("rock", mass=m, inertia=matrix, axes=axes)
    pair = [
        ph.derive(ph.System(ph.Pivot(body, at=axes["3"] * -a), ph.Gravity(g)))
        for body in (principal, full)
    ]
    assert pair[0].rows == pair[1].rows
    assert pair[0].components == pair[1].components


def test_components_of_a_body_that_another_carries():
    """Both by the components of their angular velocities: the rates of the angles of the second
    contain those of the first. Against Lagrange's rates of angles."""
    A, C = ph.symbols("A C", positive=True)

    def chain(spin):
        axes, parts, carrier = LAB, [], None
        for tag in ("", "2"):
            names = [f"{name}_{tag}" if tag else name for name in ("phi", "theta", "psi")]
            for name, axis in zip(names, "zxz", strict=True):
                axes = axes.rotated(ph.coordinate(name), axis)
            body = ph.Body(
                f"b{tag}", mass=m, inertia=(A, A, C), axes=axes, spin=spin(names), tag=tag
            )
            end = None if carrier is None else carrier.point(carrier.axes["z"] * -a)
            held = {} if end is None else {"to": end}
            parts.append(ph.Pivot(body, at=axes["z"] * a, name=f"p{tag}", **held))
            carrier = body
        return ph.System(*parts, ph.Gravity(g))

    numbers = {"m": 1.0, "a": 0.3, "A": 0.02, "C": 0.01, "g": 9.81}
    start = {"theta": 0.6, "theta_2": 0.5, "omega_x": 0.2, "omega_z": 0.5, "omega_y_2": 0.4}
    run = ph.simulate(chain(ph.Components), numbers, start, "0.5 s", samples=3)
    rates = {f"{q}_dot": run[f"{q}_dot"][0] for q in ("phi", "theta", "psi", "phi_2", "theta_2")}
    rates["psi_2_dot"] = run["psi_2_dot"][0]
    angles = {"theta": 0.6, "theta_2": 0.5}
    other = ph.simulate(
        chain(lambda names: ph.WithAxes()), numbers, angles | rates, "0.5 s", samples=3
    )
    for name in ("phi", "theta", "psi", "phi_2", "theta_2", "psi_2"):
        assert run.final[name] == pytest.approx(other.final[name], abs=1e-10)
